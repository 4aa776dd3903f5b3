"""The singly diagonally implicit methods of two stages with c = (γ, 1 − γ).

E. Hairer, S. P. Nørsett, G. Wanner, *Solving Ordinary Differential Equations I*, II.7: order 2, and
order 3 for γ = (3 ± √3)/6.
"""

from __future__ import annotations

from typing import cast

from flint import fmpq

from garkcli.exact.field import ONE, ZERO
from garkcli.exact.matrix import Vector
from garkcli.exact.nodes import Expression
from garkcli.families.family import NONSTIFF, MethodFamily, Option, Options, Recipe
from garkcli.tableau.tableau import Method, butcher

GAMMA = Option(
    "gamma", "The diagonal entry γ that chooses a method of the family.", shown="(3 + sqrt(3))/6"
)


def sdirk2(_: int, options: Options) -> Recipe:
    return Recipe(2, _method, (cast("Expression", options["gamma"]),))


def _method(values: Vector) -> Method:
    (gamma,) = values
    A = (gamma, ZERO), (ONE - 2 * gamma, gamma)
    half = fmpq(1, 2)
    return butcher(A, (half, half), name="SDIRK(gamma)")


FAMILIES = (
    MethodFamily(
        "sdirk2",
        sdirk2,
        2,
        2,
        "2",
        "order 3 for gamma: (3 + sqrt(3))/6",
        options=(GAMMA,),
        reference=NONSTIFF,
    ),
)
