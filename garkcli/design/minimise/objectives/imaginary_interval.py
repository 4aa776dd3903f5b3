"""The interval of stability on the imaginary axis."""

from garkcli.design.minimise.intervals import fraction_in_plane, refuse_partitioned
from garkcli.design.minimise.objective import Level, Signs, Size
from garkcli.design.stability_kinds import squared_modulus
from garkcli.exact.cells import first_end
from garkcli.exact.parametric import Parameters
from garkcli.stability.linear import imaginary_set, stability_function
from garkcli.tableau.tableau import Tableau


def _value(tableau: Tableau) -> Size:
    refuse_partitioned(tableau)
    return first_end(imaginary_set(stability_function(tableau)))


def _signs(tableau: Tableau, ring: Parameters) -> Signs:
    """|Q|² − |P|² in the square of the imaginary part; it is negative at a pole."""
    P, Q = fraction_in_plane(tableau, ring)
    return Signs([squared_modulus(Q) - squared_modulus(P)])


OBJECTIVE = Level(
    "-imaginary-interval",
    "the y with |R| ≤ 1 on [−iy, iy], the vector fields all equal",
    _value,
    _signs,
    is_square=True,
    claim="imaginary-stability",
)
"""E. Hairer, G. Wanner, *Solving Ordinary Differential Equations II*, section IV.2."""
