"""How coefficients are meant: exactly, or rounded by the tolerance of their file."""

from __future__ import annotations

from typing import TYPE_CHECKING, TypeAlias

from flint import fmpq

from garkcli.tableau.conjugate import conjugate
from garkcli.tableau.forms import pair
from garkcli.tableau.tableau import Tableau

if TYPE_CHECKING:
    from garkcli.tableau.rounded import RoundedTableau

AnyTableau: TypeAlias = "Tableau | RoundedTableau"
"""What conditions are decided of: a tableau as it is, or all that it may be a rounding of."""


def meant(tableau: Tableau, tolerance: fmpq | None) -> AnyTableau:
    """The tableau itself, or with the box that a tolerance gives it."""
    if not tolerance:
        return tableau
    from garkcli.tableau.rounded import RoundedTableau

    return RoundedTableau.within(tableau, tolerance)


def derived(method: AnyTableau, which: str | None) -> AnyTableau:
    """The symplectic conjugate or the symplectic pair of a method, or the method itself.

    Args:
        method: rounded or not; what is made of it is rounded by what its rounding does.
        which: ``conjugate`` or ``pair``; empty or None for the method.

    Raises:
        ZeroWeight: a weight that it divides by is 0.
    """
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
