"""The symplectic pair as one method of 2N colours."""

from __future__ import annotations

from garkcli.conversion.sheet import Sheet, each_its_own, sheet_of
from garkcli.conversion.target import Target
from garkcli.conversion.targets.gark import without_parts
from garkcli.tableau.forms import pair
from garkcli.tableau.garkmethod import GarkMethod


def as_pair(method: GarkMethod) -> Sheet:
    """The pair (Q, P) of a method and its conjugate, as a GARK method: colours V¹…Vᴺ, then
    F¹…Fᴺ.

    Embedded weights and dense output are those of the method, not of the pair: they are left out.

    Raises:
        ZeroWeight: a conjugate would divide by zero.
    """
    both = GarkMethod(tableau=pair(method.tableau))
    return without_parts(each_its_own(sheet_of(both)))


TARGET = Target(
    "pair",
    "the symplectic pair as one method of 2N colours",
    as_pair,
    {"pair-order": "order", "pair-bound": "bound", "pair-sharp-bound": "sharp-bound"},
    makes_another=True,
)
