"""The interval of stability on the negative real axis."""

from collections.abc import Sequence

from flint import fmpq_mpoly

from garkcli.design.minimise.intervals import fraction_in_plane, refuse_partitioned
from garkcli.design.minimise.objective import Level, Size
from garkcli.exact.cells import first_end
from garkcli.exact.parametric import Parameters
from garkcli.exact.projection import PLANE
from garkcli.stability.linear import real_set, stability_function
from garkcli.tableau.tableau import Tableau


def _value(tableau: Tableau) -> Size:
    refuse_partitioned(tableau)
    return first_end(real_set(stability_function(tableau)))


def _curves(tableau: Tableau, ring: Parameters) -> Sequence[fmpq_mpoly]:
    """Where R = ±1 and where R has a pole, at −y."""
    P, Q = fraction_in_plane(tableau, ring)
    y, t = PLANE.gens()
    P, Q = P.compose(-y, t), Q.compose(-y, t)
    return [Q - P, Q + P, Q]


OBJECTIVE = Level(
    "-real-interval",
    "the x with |R| ≤ 1 on [−x, 0], the vector fields all equal",
    _value,
    _curves,
    claim="real-stability",
)
"""E. Hairer, G. Wanner, *Solving Ordinary Differential Equations II*, section IV.2."""
