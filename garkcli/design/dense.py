"""Wants on dense output: its order for every θ, and the continuity of its pieces.

With b_i(θ) = Σ_k B_ik θ^k the order q asks B_kᵀ 𝒜^[u] = 1/γ(u) for k = ρ(u) and 0 for every other
k, for all trees of at most q vertices (``garkcli.order.dense``). As in
``garkcli.design.conditions`` vectors that span those of all trees decide it; each condition is
linear in the weights.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import chain
from typing import Any, cast

from flint import fmpq

from garkcli.design.conditions import FamilyConditions
from garkcli.design.want import Asked, Want, WantConditions
from garkcli.errors import MethodError
from garkcli.exact.field import ONE, ZERO
from garkcli.exact.matrix import dot
from garkcli.exact.parametric import Parametric
from garkcli.frozen import replace
from garkcli.ntrees.kind import PLAIN
from garkcli.order.dense import slopes_at_ends, with_ends
from garkcli.order.equal_stages import equal_stages
from garkcli.order.functionals import Functional
from garkcli.tableau.embedded import DenseOutput
from garkcli.tableau.stages import PointSpace
from garkcli.tableau.tableau import Tableau


def _dense(asked: Asked, key: str) -> DenseOutput:
    """The dense output; MethodError if there is none, or the want is about some colours only."""
    dense = asked.further.dense
    if dense is None or len(asked.colours) < asked.tableau.size:
        message = f"design: {key} needs dense output, and is for all colours together"
        cure = 'write dense: {degree: 2, weights: [["?", "?"], ["?", "?"]]} beside b'
        raise MethodError(message, cure, code="wanted-without-meaning")
    return dense


def _order(asked: Asked) -> WantConditions:
    dense = _dense(asked, "dense-order")
    order = cast("int", asked.value)
    claims = (("dense-order", f'">= {order}"'),)
    if order > dense.degree:
        why = f"no value has dense order {order}: it is no larger than the degree {dense.degree}"
        return WantConditions((ONE,), impossible=(why,))
    tableau, ring = asked.tableau, asked.ring
    conditions = FamilyConditions(tableau, ring)
    functionals = [Functional(dense.coefficients(k), k) for k in range(1, dense.degree + 1)]
    one = ring.constant(fmpq(1))
    zeros: list[Any] = []
    for n in range(1, order + 1):
        for l, forest in conditions.members(n, tableau.roots):
            vector: Any = [ring.quotient(x * one, one) for x in forest.vector]
            scale = ring.quotient(forest.scale * one, one)
            required = scale * forest.required(tableau.colours[l].kind, n - tableau.roots[l])
            zeros += [dot(x.weights[l], vector) - x.share(n) * required for x in functionals]
    return WantConditions(tuple(zeros), conditions.denominators, claims=claims)


def _continuity(asked: Asked) -> WantConditions:
    """0: b(1) = b. 1: also the slope is f(x_0) at θ = 0 and f(x_1) at θ = 1. Weights then cancel in
    each class of stages equal to one another, or to these two values.
    """
    dense = _dense(asked, "dense-continuity")
    tableau = asked.tableau
    pairs = zip(tableau.colours, dense.at(ONE), strict=True)
    zeros: list[Any] = [x - y for colour, row in pairs for x, y in zip(colour.b, row, strict=True)]
    claims = [("dense-continuous", "true")]
    if asked.value:
        ends = _timeless(with_ends(_known(tableau)))
        classes = equal_stages(ends, ZERO)
        for l, colour in enumerate(ends.colours):
            for row in slopes_at_ends(dense):
                members = classes[colour.space]
                zeros += [sum((row[l][i] for i in x), start=ZERO) for x in members]
        claims.append(("dense-smooth", "true"))
    return WantConditions(tuple(zeros), claims=tuple(claims))


def _known(tableau: Tableau) -> Tableau:
    """Raises MethodError if stages cannot be compared: unknowns, or special vector fields."""
    entries: Sequence[object] = [*chain.from_iterable(chain.from_iterable(tableau.blocks.values()))]
    weights: Sequence[object] = [*chain.from_iterable(colour.b for colour in tableau.colours)]
    is_constant = not any(isinstance(x, Parametric) for x in (*entries, *weights))
    if is_constant and all(colour.kind == PLAIN for colour in tableau.colours):
        return tableau
    message = "design: dense-continuity: 1 needs A and b without unknowns and roots, no linear part"
    cure = "give unknowns values with --set; dense-order and dense-continuity: 0 need none"
    raise MethodError(message, cure, code="wanted-without-meaning")


def _timeless(tableau: Tableau) -> Tableau:
    # on autonomous problems nodes do not matter
    spaces = tuple(PointSpace((ZERO,) * space.stages) for space in tableau.spaces)
    return replace(tableau, spaces=spaces)


DENSE = (
    Want("dense-order", "count", "the order of the dense output for every θ", _order),
    Want(
        "dense-continuity",
        "smoothness",
        "0 for continuous dense output, 1 for a continuous slope too",
        _continuity,
    ),
)
