"""How coefficients are meant: exactly, or rounded by the tolerance of their file."""

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
"""A tableau as it is, or with all methods that it may be a rounding of."""
Radii: TypeAlias = "Callable[[Sequence[tuple[Expression, Number]]], Sequence[fmpq]]"
"""By how much printed numbers may be off, as they are written."""
ByRadii: TypeAlias = "Callable[[Radii], tuple[Box, Further]]"
"""All methods that a file may mean, with its further weights, where its numbers may be off so."""


def meant(tableau: Tableau, tolerance: fmpq | None, further: Further | None = None) -> AnyTableau:
    """The tableau itself, or with the method that it may be a rounding of; that is sought once.

    Args:
        tableau: the method.
        tolerance: the rounding of its coefficients; None or 0 for exact ones.
        further: its embedded weights and dense output, which are rounded too; None where they do
            not matter.
    """
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
    """The tableau with what its printed numbers leave open; None where all are exact, or nobody
    knows how they are printed.

    Args:
        tableau: the method.
        radii: by how much its numbers may be off.
    """
    box: ByRadii | None = tableau.__dict__.get("digits")
    if box is None:
        return None
    made, further = box(radii)
    if not made.numbers:
        return None
    from garkcli.order.rounded import RoundedTableau

    return RoundedTableau.of(tableau, max(made.radii), made, further)


def remember_digits(tableau: Tableau, box: ByRadii) -> None:
    """Keep how a tableau is made of its printed numbers, for other radii than the file has."""
    tableau.__dict__["digits"] = box


def remember(
    tableau: Tableau, tolerance: fmpq | None, box: Callable[[], tuple[Box, Further]]
) -> None:
    """Keep which numbers of a tableau are rounded, and how it is made of them: ``meant`` takes each
    coefficient that is not 0 for one of them where nobody knows better.

    Args:
        tableau: the method.
        tolerance: its rounding; None where only further weights are rounded.
        box: all methods that it may be, with its further weights.
    """
    tableau.__dict__["box"] = tolerance, box


def remembered(tableau: Tableau) -> Callable[[], tuple[Box, Further]]:
    """What ``remember`` kept of a tableau."""
    box: Callable[[], tuple[Box, Further]] = tableau.__dict__["box"][1]
    return box


def remembered_digits(tableau: Tableau) -> ByRadii:
    """What ``remember_digits`` kept of a tableau."""
    box: ByRadii = tableau.__dict__["digits"]
    return box


def remember_base(tableau: Tableau, base: GarkMethod, which: str) -> None:
    """Keep what a tableau is made of: it is as uncertain as the numbers of that make it.

    Args:
        tableau: the conjugate or the pair.
        base: the method that has it.
        which: ``conjugate`` or ``pair``.
    """
    tableau.__dict__["made of"] = base, which


def keep(method: RoundedTableau) -> None:
    """Keep of a rounded tableau that was made of another what it is a rounding of."""
    method.tableau.__dict__.setdefault("meant", {})[method.tolerance] = method


def with_further(method: AnyTableau) -> RoundedTableau | None:
    """A method with its further weights, where any of its numbers is rounded; an exact method may
    have rounded ones.
    """
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
    """A method with its embedded weights in place of its own, rounded where these or A are."""
    rounded = with_further(method)
    found = None if rounded is None else rounded.with_embedded()
    return with_weights(printed(method), weights) if found is None else found


def as_dense(method: AnyTableau) -> AnyTableau:
    """A method with the rounding that its dense output depends on."""
    rounded = with_further(method)
    found = None if rounded is None else rounded.with_dense()
    return printed(method) if found is None else found


def as_meant(method: GarkMethod) -> AnyTableau:
    """The tableau of a method, with its rounding where it has a tolerance."""
    return meant(method.tableau, method.tolerance, method.further)


def derived(method: AnyTableau, which: str | None) -> AnyTableau:
    """The symplectic conjugate or the symplectic pair of a method, or the method itself.

    Args:
        method: rounded or not; what is made of it is rounded by what its rounding does.
        which: ``conjugate`` or ``pair``, or the order that is claimed of them; of a rounded method
            also ``embedded-order``. Anything else is the method.

    Raises:
        ZeroWeight: a weight that it divides by is 0.
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
    """The tableau as it is printed."""
    return method if isinstance(method, Tableau) else method.tableau


def tolerance_of(method: AnyTableau) -> fmpq | None:
    """The rounding of its coefficients; None where they are exact."""
    return None if isinstance(method, Tableau) else method.tolerance
