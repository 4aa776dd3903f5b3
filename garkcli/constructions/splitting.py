"""Splitting methods: the flows of the parts of a problem in turn, as tableaus.

For q̇ = v(p), ṗ = f(q) the flows of the parts are exact, as they are Euler steps: drifts of q and
kicks of p. For ẏ = Σ f^{l}(y) each flow is one step of a method.
"""

from __future__ import annotations

from collections.abc import Sequence

from garkcli.constructions.composition import Substep, composed
from garkcli.exact.field import ONE, ZERO, Number
from garkcli.exact.matrix import Matrix, Vector
from garkcli.tableau.forms import separable_prk, with_linear
from garkcli.tableau.point_space import PointSpace
from garkcli.tableau.tableau import Colour, Edge, Method, Tableau

Flow = tuple[int, Number]
"""A part of the problem, counted from 0, and for which fraction of the step it flows."""


def drift_and_kick(flows: Sequence[Flow], is_nystrom: bool = False) -> Tableau:
    """A splitting method of a separable Hamiltonian: part 0 moves q, part 1 moves p.

    Args:
        flows: one after the other; those of length 0 are left out.
        is_nystrom: whether velocities are linear in the momenta.
    """
    nothing: Vector = ()
    drift = separable_prk(((), (ONE,), ()), (((),), nothing, (ZERO,)))
    kick = separable_prk((((),), nothing, (ZERO,)), ((), (ONE,), ()))
    parts = [drift, kick]
    substeps = [Substep(parts[l], g) for l, g in flows if g]
    made = composed(substeps)
    return with_linear(made, ["q"]) if is_nystrom else made


def split(methods: Sequence[Method], flows: Sequence[Flow]) -> Tableau:
    """A splitting method for ẏ = Σ f^{l}(y), a colour each part.

    Args:
        methods: what takes the steps of each part, its stages at points.
        flows: one after the other; those of length 0 are left out.
    """
    parts = [alone(methods, l) for l in range(len(methods))]
    return composed([Substep(parts[l], g) for l, g in flows if g])


def alone(methods: Sequence[Method], l: int) -> Tableau:
    """The step of one part: the other colours have no stages."""
    own = methods[l]
    spaces = []
    colours = []
    blocks: dict[Edge, Matrix] = {}
    for k in range(len(methods)):
        nodes = own.c if k == l else ()
        weights = own.b if k == l else ()
        spaces.append(PointSpace(nodes))
        name = str(k + 1)
        colours.append(Colour(name, k, weights, nodes, k))
        for m in range(len(methods)):
            rows = len(nodes)
            is_own = k == m == l
            blocks[k, m] = own.A if is_own else ((),) * rows
    return Tableau(tuple(spaces), tuple(colours), blocks)
