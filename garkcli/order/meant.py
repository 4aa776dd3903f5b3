"""Exact and rounded methods: the methods that printed coefficients may mean."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, TypeAlias

from flint import fmpq

from garkcli.tableau.conjugate import conjugate
from garkcli.tableau.embedded import NOTHING, Further, Weights, with_weights
from garkcli.tableau.forms import pair
from garkcli.tableau.tableau import Tableau

if TYPE_CHECKING:
    from garkcli.exact.field import Number
    from garkcli.exact.nodes import Expression
    from garkcli.order.rounded import RoundedTableau
    from garkcli.tableau.box import Box
    from garkcli.tableau.garkmethod import GarkMethod

AnyTableau: TypeAlias = "Tableau | RoundedTableau"
Radii: TypeAlias = "Callable[[Sequence[tuple[Expression, Number]]], Sequence[fmpq]]"
"""The radii of printed numbers, from how they are written."""
ByRadii: TypeAlias = "Callable[[Radii], tuple[Box, Further]]"


def meant(tableau: Tableau, tolerance: fmpq | None, further: Further | None = None) -> AnyTableau:
    """The tableau itself if exact, else the rounded tableau within its tolerance, computed once."""
    if not tolerance:
        return tableau
    base, which = tableau.__dict__.get("made of", (None, ""))
    if base is not None:
        return derived(meant(base.tableau, tolerance, base.further), which)
    known: dict[fmpq, RoundedTableau] = tableau.__dict__.setdefault("meant", {})
    found = known.get(tolerance)
    if found is None or (further and found.search.printed_further != further):
        from garkcli.order.rounded import RoundedTableau

        of_tolerance, box = tableau.__dict__.get("box", (None, None))
        by_radii: ByRadii | None = tableau.__dict__.get("digits")
        if of_tolerance == tolerance and box is not None:
            found = RoundedTableau.of(tableau, tolerance, *box())
        else:
            made = by_radii and by_radii(lambda numbers: [tolerance] * len(numbers))
            if made and (not further or made[1] == further):
                found = RoundedTableau.of(tableau, tolerance, *made)
            else:  # numbers that no file prints
                found = RoundedTableau.within(tableau, tolerance, further or NOTHING)
        known[tolerance] = found
    return found


def within_digits(tableau: Tableau, radii: Radii) -> RoundedTableau | None:
    box: ByRadii | None = tableau.__dict__.get("digits")
    if box is None:
        return None
    made, further = box(radii)
    if not made.numbers:
        return None
    from garkcli.order.rounded import RoundedTableau

    return RoundedTableau.of(tableau, max(made.radii), made, further)


def remember_digits(tableau: Tableau, box: ByRadii) -> None:
    """Stores how a tableau depends on its printed numbers."""
    tableau.__dict__["digits"] = box


def remember(
    tableau: Tableau, tolerance: fmpq | None, box: Callable[[], tuple[Box, Further]]
) -> None:
    """Stores which numbers are rounded; without it ``meant`` takes each coefficient for printed."""
    tableau.__dict__["box"] = tolerance, box


def remembered(tableau: Tableau) -> Callable[[], tuple[Box, Further]]:
    box: Callable[[], tuple[Box, Further]] = tableau.__dict__["box"][1]
    return box


def remembered_digits(tableau: Tableau) -> ByRadii:
    box: ByRadii = tableau.__dict__["digits"]
    return box


def remember_base(tableau: Tableau, base: GarkMethod, which: str) -> None:
    """Stores the base of a ``conjugate`` or ``pair``, which is as uncertain as its numbers."""
    tableau.__dict__["made of"] = base, which


def keep(method: RoundedTableau) -> None:
    """Stores a rounded tableau that was derived from another, for ``meant``."""
    method.tableau.__dict__.setdefault("meant", {})[method.tolerance] = method


def with_further(method: AnyTableau) -> RoundedTableau | None:
    if not isinstance(method, Tableau):
        return method
    of_tolerance, box = method.__dict__.get("box", (None, None))
    if of_tolerance is not None or box is None:
        return None
    if "with further" not in method.__dict__:
        from garkcli.order.rounded import RoundedTableau

        whole, further = box()
        largest = max(whole.radii, default=None)
        found = largest and RoundedTableau.of(method, largest, whole, further)
        method.__dict__["with further"] = found
    known: RoundedTableau | None = method.__dict__["with further"]
    return known


def as_embedded(method: AnyTableau, weights: Weights) -> AnyTableau:
    rounded = with_further(method)
    found = None if rounded is None else rounded.with_embedded()
    return with_weights(printed(method), weights) if found is None else found


def as_dense(method: AnyTableau) -> AnyTableau:
    rounded = with_further(method)
    found = None if rounded is None else rounded.with_dense()
    return printed(method) if found is None else found


def as_meant(method: GarkMethod) -> AnyTableau:
    return meant(method.tableau, method.tolerance, method.further)


def derived(method: AnyTableau, which: str | None) -> AnyTableau:
    """The symplectic conjugate or pair of a method, or the method itself; rounding carries over.
    ``which`` is ``conjugate`` or ``pair``, a claim about their order, or for a rounded method
    ``embedded-order``; else it is the method. Raises ZeroWeight.
    """
    which = (which or "").removesuffix("-order")
    if which == "embedded" and not isinstance(method, Tableau):
        return as_embedded(method, method.search.printed_further.embedded or ())
    if which == "conjugate":
        return conjugate(method) if isinstance(method, Tableau) else method.conjugate()
    if which == "pair":
        return pair(method) if isinstance(method, Tableau) else method.pair()
    return method


def printed(method: AnyTableau) -> Tableau:
    return method if isinstance(method, Tableau) else method.tableau


def tolerance_of(method: AnyTableau) -> fmpq | None:
    return None if isinstance(method, Tableau) else method.tolerance
