"""The interval of stability on the negative real axis."""

from garkcli.design.minimise.intervals import fraction_in_plane, refuse_partitioned
from garkcli.design.minimise.objective import Level, Signs, Size
from garkcli.exact.cells import first_end
from garkcli.exact.parametric import Parameters
from garkcli.exact.projection import PLANE
from garkcli.stability.linear import real_set, stability_function
from garkcli.tableau.tableau import Tableau


def _value(tableau: Tableau) -> Size:
    refuse_partitioned(tableau)
    return first_end(real_set(stability_function(tableau)))


def _signs(tableau: Tableau, ring: Parameters) -> Signs:
    """Q² − P² at −y; it is negative at a pole."""
    P, Q = fraction_in_plane(tableau, ring)
    y, t = PLANE.gens()
    P, Q = P.compose(-y, t), Q.compose(-y, t)
    return Signs([(Q - P) * (Q + P)])


OBJECTIVE = Level(
    "-real-interval",
    "the x with |R| ≤ 1 on [−x, 0], the vector fields all equal",
    _value,
    _signs,
    claim="real-stability",
)
"""E. Hairer, G. Wanner, *Solving Ordinary Differential Equations II*, section IV.2."""
