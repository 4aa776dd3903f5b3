"""Wants of a method besides its order: their conditions."""

from __future__ import annotations

from functools import partial
from itertools import chain, pairwise
from math import factorial
from typing import Any, cast

from flint import fmpq

from garkcli.design.conditions import FamilyConditions
from garkcli.design.dense import DENSE
from garkcli.design.minimise.sector import rest_of_cosine
from garkcli.design.pairs import pair_conditions
from garkcli.design.predictor import PREDICTOR
from garkcli.design.want import Asked, Want, WantConditions, stability
from garkcli.errors import MethodError
from garkcli.exact.field import ONE
from garkcli.exact.matrix import apply, characteristic_coefficients, dot
from garkcli.exact.parametric import fraction
from garkcli.frozen import replace
from garkcli.order.defects import Defects
from garkcli.tableau.conjugate import symplectic_defect
from garkcli.tableau.embedded import with_weights
from garkcli.tableau.family import Family, RequiredStability
from garkcli.tableau.forms import pair
from garkcli.tableau.tableau import Tableau

LEVELS = {
    "ssp": "the SSP coefficient",
    "real-interval": "x with |R| ≤ 1 on [−x, 0]",
    "imaginary-interval": "y with |R| ≤ 1 on [−iy, iy]",
    "sector": "α in degrees with |R| ≤ 1 where |arg(−z)| ≤ α",
    "oscillator-interval": "z with bounded powers of the oscillator's step for hω ≤ z",
}
MOST_PRODUCTS = 200


def order_meaning(tableau: Tableau, asked: Asked) -> WantConditions:
    conditions = FamilyConditions(tableau, asked.ring)
    one = asked.ring.constant(fmpq(1))
    zeros: list[object] = []
    for k in range(1, cast("int", asked.value) + 1):
        polynomials = [condition.polynomial for condition in conditions.of_order(k)]
        zeros += [asked.ring.quotient(p, one) for p in polynomials]
    return WantConditions(tuple(zeros), conditions.denominators)


def _pair_order(asked: Asked) -> WantConditions:
    parameters = asked.ring.names[: len(asked.ring.names) - len(asked.radicals)]
    criterion = pair_conditions(
        Family(
            name="",
            tableau=asked.tableau,
            ring=asked.ring,
            parameters=parameters,
            ranges={},
            radicals=asked.radicals,
        )
    )
    order = cast("int", asked.value)
    if criterion is None:
        return order_meaning(pair(asked.tableau), asked)
    one = asked.ring.constant(fmpq(1))
    zeros = chain.from_iterable(criterion.of_order(k) for k in range(1, order + 1))
    why = criterion.obstacle(order)
    return WantConditions(
        tuple(asked.ring.quotient(p, one) for p in zeros),
        real=("pair-order",) if order > 2 else (),
        impossible=(f"no value has symplectic pair order {order}: {why}",) if why else (),
    )


def as_embedded(asked: Asked, key: str) -> Tableau:
    """The method with b̂ as b; MethodError without b̂, or if only some colours are wanted."""
    embedded = asked.further.embedded
    if embedded is None or len(asked.colours) < asked.tableau.size:
        message = f"design: {key} needs embedded weights, and is for all colours together"
        cure = 'write embedded: ["?", "?"] beside b, or embedded: true under unknown'
        raise MethodError(message, cure, code="wanted-without-meaning")
    return with_weights(asked.tableau, embedded)


def _embedded_order(asked: Asked) -> WantConditions:
    return order_meaning(as_embedded(asked, "embedded-order"), asked)


def _symplectic(asked: Asked) -> WantConditions:
    """b_i^l a_ij^{l,m} + b_j^m a_ji^{m,l} − b_i^l b_j^m = 0. J. M. Sanz-Serna, BIT 28, 1988; for
    several colours A. Sandu, M. Günther, SINUM 53, 2015.
    """
    tableau = asked.tableau
    zeros: list[object] = []
    if tableau.is_partitioned:
        message = "design: symplectic is for methods without parts"
        raise MethodError(message, "ask for the symplectic pair", code="wanted-without-meaning")
    for l in asked.colours:
        for m in asked.colours:
            asked.diagonal(l, "symplectic")
            asked.block(l, m, "symplectic")
            asked.block(m, l, "symplectic")
            zeros += chain.from_iterable(symplectic_defect(tableau, l, m))
    return WantConditions(tuple(zeros))


def _stiffly_accurate(asked: Asked) -> WantConditions:
    zeros = []
    for l in asked.colours:
        A, b = asked.diagonal(l, "stiffly-accurate")
        zeros += [x - y for x, y in zip(A[-1], b, strict=True)]
    return WantConditions(tuple(zeros))


def at_infinity(asked: Asked) -> WantConditions:
    """R(z) = det(I − z(A − 𝟙bᵀ)) / det(I − zA), of the degree of almost all methods. E. Hairer, G.
    Wanner, *Solving Ordinary Differential Equations II*, IV.3 and IV.6.
    """
    zeros: list[Any] = []
    nonzero = []
    for l in asked.colours:
        A, b = asked.diagonal(l, "R-infinity")
        denominator = characteristic_coefficients(A)
        expanded = characteristic_coefficients(
            tuple(tuple(x - y for x, y in zip(row, b, strict=True)) for row in A)
        )
        degree = max(k for k, x in enumerate(denominator) if x)
        if not degree:
            message = "design: R-infinity: R(z) is a polynomial for every value"
            cure = "leave it out: explicit methods have no value at infinity"
            raise MethodError(message, cure, code="wanted-without-meaning")
        value: Any = asked.value
        zeros.append(expanded[degree] - value * denominator[degree])
        zeros += expanded[degree + 1 :]
        numerator, _ = fraction(denominator[degree], asked.ring)
        if not numerator.is_constant():
            nonzero.append(numerator)
    return WantConditions(tuple(zeros), tuple(nonzero))


def _embedded_at_infinity(asked: Asked) -> WantConditions:
    return at_infinity(replace(asked, tableau=as_embedded(asked, "embedded-R-infinity")))


def _embedded_stability(key: str, asked: Asked) -> WantConditions:
    as_embedded(asked, key)
    return stability(key.removeprefix("embedded-"), asked, is_embedded=True)


def _stability_order(asked: Asked) -> WantConditions:
    """R(z) = exp z + O(z^(p+1)): b A^(k−1) 𝟙 = 1/k! for k = 1, …, p."""
    zeros: list[Any] = []
    for l in asked.colours:
        A, b = asked.diagonal(l, "stability-order")
        v: Any = tuple(ONE for _ in b)
        for k in range(1, cast("int", asked.value) + 1):
            zeros.append(dot(b, v) - fmpq(1, factorial(k)))
            v = apply(A, v)
    return WantConditions(tuple(zeros))


def _level(key: str, asked: Asked) -> WantConditions:
    if len(asked.colours) < asked.tableau.size or not isinstance(asked.value, fmpq):
        message = f"design: {key} takes one rational number, for all colours together"
        raise MethodError(message, f"write {key}: 3/2", code="wanted-without-meaning")
    if key == "sector":
        rest_of_cosine(asked.value)
    return WantConditions(levels=((f"-{key}", asked.value),))


def _stage_order(asked: Asked) -> WantConditions:
    """Σ_i b_i^l (c_i^l)^{k−1} = 1/k, Σ_j a_ij^{l,m} (c_j^m)^{k−1} = (c_i^l)^k / k for k = 1, …, q.

    With s stages C(s + 1) is C(q) for every q > s. Let M have the d ≤ s nodes of a colour as its
    simple zeros: by C(d + 1) of the colour's own block ∫_0^x M vanishes at each node, as M does. So
    many double zeros exceed the degree d + 1, unless d = 1 and the node is 0; then the nodes of all
    colours are 0, and C(k) reads 0 = 0 for k > 1. B(2s + 1) has no solution: Hilbert's matrix is
    invertible, but its entries would be sums of s powers.
    """
    tableau = asked.tableau
    stages = max(len(tableau.colours[l].c) for l in asked.colours)
    wanted = cast("int", asked.value)
    highest = min(wanted, stages + 1)
    defects = Defects(tableau)
    zeros: list[object] = []
    for l in asked.colours:
        for k in range(1, min(wanted, 2 * stages + 1) + 1):
            zeros += defects.B(l, k)
        asked.diagonal(l, "stage-order")
        for m in asked.colours:
            asked.block(l, m, "stage-order")
            for k in range(1, highest + 1):
                zeros += defects.C(l, m, k)
    return WantConditions(tuple(zeros))


def _weak_stage_order(asked: Asked) -> WantConditions:
    """b^{l} A^{l,m} ⋯ A^{n,p} (A^{p,r} (c^{r})^{k−1} − (c^{p})^k / k) = 0 for k = 1, …, q.

    Products of as many blocks as there are stages suffice: the functionals from at most n blocks
    span a space that, once it does not grow with n, never grows again. By the node powers c^k and k
    c^k a product that vanishes for k ≤ 2s + 1 and stages s of two colours does so for every k.
    """
    tableau = asked.tableau
    defects = Defects(tableau)
    spaces = {tableau.colours[l].space for l in asked.colours}
    stages = sum(tableau.spaces[k].stages for k in spaces)
    edges = set(tableau.edges())
    most = 3 * max(space.stages for space in tableau.spaces) + 1
    orders = range(1, min(cast("int", asked.value), most) + 1)
    for l in asked.colours:
        asked.diagonal(l, "weak-stage-order")
    rows = [(l, defects.weights(l)) for l in asked.colours]
    zeros: list[object] = []
    products = 0
    for _ in range(stages + 1):
        following = []
        for l, w in rows:
            if not any(w):
                continue
            products += 1
            if products > MOST_PRODUCTS:
                raise MethodError(
                    f"design: weak-stage-order needs more than {MOST_PRODUCTS} products of blocks",
                    "name the colour that is stiff: weak-stage-order: {2: …}",
                    code="wanted-without-meaning",
                )
            for m in range(tableau.size):
                if (l, m) in edges:
                    zeros += [dot(w, defects.C(l, m, k)) for k in orders]
            following += [(m, defects.before(l, m, w)) for m in asked.colours if (l, m) in edges]
        rows = following
    return WantConditions(tuple(zeros))


def _consistent(asked: Asked) -> WantConditions:
    """A^{l,m} 𝟙 = c^l for every block of the colours l (A. Sandu, M. Günther, SINUM 53, 2015)."""
    defects = Defects(asked.tableau)
    edges = [(l, m) for l, m in asked.tableau.edges() if l in asked.colours]
    return WantConditions(tuple(x for l, m in edges for x in defects.C(l, m, 1)))


def _nodes_in_unit_interval(asked: Asked) -> WantConditions:
    nodes = [x for l in asked.colours for x in asked.tableau.colours[l].c]
    return WantConditions(not_negative=(*nodes, *(1 - x for x in nodes)))


def _nodes_ascending(asked: Asked) -> WantConditions:
    rows = [asked.tableau.colours[l].c for l in asked.colours]
    return WantConditions(not_negative=tuple(y - x for row in rows for x, y in pairwise(row)))


def _coefficients(asked: Asked) -> tuple[Any, ...]:
    blocks = [block for (_, m), block in asked.tableau.blocks.items() if m in asked.colours]
    weights = [asked.tableau.colours[l].b for l in asked.colours]
    return tuple(chain(*chain.from_iterable(blocks), *weights))


def _largest_coefficient(asked: Asked) -> WantConditions:
    most: Any = asked.value
    entries = _coefficients(asked)
    return WantConditions(not_negative=(*(most - x for x in entries), *(most + x for x in entries)))


def _oscillating(kind: str, asked: Asked) -> WantConditions:
    if len(asked.colours) < asked.tableau.size:
        message = f"design: {kind} is for all colours together"
        raise MethodError(message, f"write {kind}: true", code="wanted-without-meaning")
    return WantConditions(stable=(RequiredStability(kind),))


WANTS = {
    want.key: want
    for want in (
        Want("pair-order", "count", "the symplectic pair has that order", _pair_order),
        Want(
            "embedded-order",
            "count",
            "the method has that order with its embedded weights in place of b",
            _embedded_order,
        ),
        Want("symplectic", "flag", "the method is symplectic", _symplectic),
        Want("stiffly-accurate", "flag", "the last row of A is b", _stiffly_accurate),
        Want("R-infinity", "number", "the stability function at infinity", at_infinity),
        Want(
            "embedded-R-infinity",
            "number",
            "the same with the embedded weights in place of b",
            _embedded_at_infinity,
        ),
        Want("stability-order", "count", "R(z) = exp z + O(z^(p+1))", _stability_order),
        Want("stage-order", "count", "B(q) and C(q)", _stage_order),
        Want(
            "weak-stage-order",
            "count",
            "what the stages miss up to order q never reaches the new value",
            _weak_stage_order,
        ),
        Want("consistent", "flag", "the nodes are the row sums of every block", _consistent),
        Want(
            "positive-weights",
            "flag",
            "every weight is positive",
            lambda asked: WantConditions(
                positive=tuple(x for l in asked.colours for x in asked.tableau.colours[l].b)
            ),
        ),
        Want("nodes-in-unit-interval", "flag", "every node is in [0, 1]", _nodes_in_unit_interval),
        Want("nodes-ascending", "flag", "no node is below the one before", _nodes_ascending),
        Want(
            "nonnegative-coefficients",
            "flag",
            "no entry of A and no weight is negative",
            lambda asked: WantConditions(not_negative=_coefficients(asked)),
        ),
        Want(
            "largest-coefficient",
            "number",
            "no entry of A and no weight is larger in size",
            _largest_coefficient,
        ),
        Want(
            "a-stable", "flag", "|R(z)| ≤ 1 in the left half plane", partial(stability, "a-stable")
        ),
        Want("l-stable", "flag", "A-stable with R(∞) = 0", partial(stability, "l-stable")),
        *(
            Want(
                f"embedded-{kind}",
                "flag",
                f"{kind} with the embedded weights in place of b",
                partial(_embedded_stability, f"embedded-{kind}"),
            )
            for kind in ("a-stable", "l-stable")
        ),
        Want(
            "p-stable",
            "flag",
            "neither growth nor decay on the oscillator, for every step size",
            partial(_oscillating, "p-stable"),
        ),
        Want(
            "i-stable",
            "flag",
            "bounded on the oscillator for every step size",
            partial(_oscillating, "i-stable"),
        ),
        *(
            Want(key, "number", f"{what}, at least; for searches", partial(_level, key))
            for key, what in LEVELS.items()
        ),
        *DENSE,
        *PREDICTOR,
    )
}
