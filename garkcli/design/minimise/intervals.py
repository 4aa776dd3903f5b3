"""What intervals of stability on the axes are decided by."""

from __future__ import annotations

from flint import fmpq_mpoly

from garkcli.design.step_plane import step_plane
from garkcli.errors import UsageProblem
from garkcli.exact.field import ONE
from garkcli.exact.matrix import Matrix
from garkcli.exact.parametric import Parameters
from garkcli.tableau.tableau import Tableau


def is_linear(tableau: Tableau) -> bool:
    """Whether the linear test equation has a meaning: every stage sees every colour, and all drive
    all unknowns.
    """
    spaces = range(len(tableau.spaces))
    colours = range(tableau.size)
    is_complete = all((k, m) in tableau.blocks for k in spaces for m in colours)
    return is_complete and not tableau.is_partitioned


def fraction_in_plane(tableau: Tableau, ring: Parameters) -> tuple[fmpq_mpoly, fmpq_mpoly]:
    """R = P/Q on the linear test equation, as polynomials in y for z and t.

    Raises:
        UsageProblem: it has no meaning for the method.
    """
    refuse_partitioned(tableau)
    fields: list[Matrix] = [((ONE,),)] * tableau.size
    plane = step_plane(tableau, ring, fields)
    return plane.numerators[0][0], plane.denominator


def refuse_partitioned(tableau: Tableau) -> None:
    """The linear test equation needs stages that see every vector field.

    Raises:
        UsageProblem: some do not.
    """
    if not is_linear(tableau):
        raise UsageProblem(
            "the linear test equation has no meaning for it: some stages do not see every"
            " vector field",
            "minimise -oscillator-interval",
            code="wanted-without-meaning",
        )
