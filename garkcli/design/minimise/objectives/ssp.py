"""The SSP coefficient."""

from itertools import chain

from garkcli.design.minimise.objective import Level, Signs, Size
from garkcli.design.minimise.sampled import in_plane
from garkcli.errors import UsageProblem
from garkcli.exact.parametric import Parameters
from garkcli.stability.ssp import conditions_at, ssp_coefficient
from garkcli.tableau.point_space import PointSpace
from garkcli.tableau.tableau import Tableau


def _value(tableau: Tableau) -> Size:
    found = ssp_coefficient(tableau)
    if found is None:
        raise UsageProblem(
            "-ssp: some blocks are missing, or the nodes have no simple radicals",
            "spell the tableau out",
            code="no-radicals",
        )
    return found.value


def _signs(tableau: Tableau, ring: Parameters) -> Signs:
    """det(I + rK) and det(I + rK) (I + rK)⁻¹ v are of degree one in each row of K."""
    if not all(isinstance(x, PointSpace) for x in tableau.spaces):
        raise UsageProblem(
            "-ssp: families by name have no rational entries",
            "spell the tableau out, stage by stage",
            code="no-radicals",
        )
    rows = chain.from_iterable(tableau.blocks.values())
    entries = list(chain.from_iterable(rows))
    for colour in tableau.colours:
        entries += colour.b
    size = 2 + sum(space.stages for space in tableau.spaces)
    return Signs([p for p in in_plane(tableau, ring, entries, size, conditions_at) if p])


OBJECTIVE = Level("-ssp", "the SSP coefficient", _value, _signs, claim="ssp-coefficient")
"""J. F. B. M. Kraaijevanger, *Contractivity of Runge–Kutta methods*, BIT 31, 1991."""
