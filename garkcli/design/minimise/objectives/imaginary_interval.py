"""The interval of stability on the imaginary axis."""

from collections.abc import Sequence

from flint import fmpq_mpoly

from garkcli.design.minimise.intervals import fraction_in_plane, refuse_partitioned
from garkcli.design.minimise.objective import Level, Size
from garkcli.design.stability_kinds import squared_modulus
from garkcli.exact.cells import first_end
from garkcli.exact.parametric import Parameters
from garkcli.stability.linear import imaginary_set, stability_function
from garkcli.tableau.tableau import Tableau


def _value(tableau: Tableau) -> Size:
    refuse_partitioned(tableau)
    return first_end(imaginary_set(stability_function(tableau)))


def _curves(tableau: Tableau, ring: Parameters) -> Sequence[fmpq_mpoly]:
    """Where |R| = 1 and where R has a pole, in the square of the imaginary part."""
    P, Q = fraction_in_plane(tableau, ring)
    under = squared_modulus(Q)
    return [under - squared_modulus(P), under]


OBJECTIVE = Level(
    "-imaginary-interval",
    "the y with |R| ≤ 1 on [−iy, iy], the vector fields all equal",
    _value,
    _curves,
    is_square=True,
    claim="imaginary-stability",
)
"""E. Hairer, G. Wanner, *Solving Ordinary Differential Equations II*, section IV.2."""
