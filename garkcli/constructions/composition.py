"""Compositions of substeps as one tableau; splittings; adjoints; extrapolation.

A stage of a substep begins where the substeps before it end, so its row has their weights and then
its own row, all times the fraction of the step: E. Hairer, C. Lubich, G. Wanner, *Geometric
Numerical Integration*, II.4. The methods have the same vector fields; a colour that a method does
not use has no stages there.

In a splitting method the parts of a problem flow in turn. For q̇ = v(p), ṗ = f(q) the flows are
exact Euler steps: drifts of q and kicks of p. For ẏ = Σ f^{l}(y) each flow is one step of a method.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from flint import fmpq, fmpq_poly

from garkcli.errors import MethodError, counted
from garkcli.exact import matrix
from garkcli.exact.field import ONE, ZERO, Number
from garkcli.families.extrapolated import extrapolation_weights
from garkcli.frozen import Frozen, replace
from garkcli.properties.reduction import merged
from garkcli.tableau.forms import separable_prk, with_linear
from garkcli.tableau.polynomial_space import PolynomialSpace
from garkcli.tableau.stages import PointSpace, StageSpace
from garkcli.tableau.tableau import Colour, Edge, Method, Tableau

MAX_STAGES = 400
"""Most stages of all colours together, before equal ones are merged."""


def refuse_large(stages: int, cure: str) -> None:
    """Raises MethodError, before a method is made, for more than ``MAX_STAGES`` stages."""
    if stages > MAX_STAGES:
        message = f"a method of {stages} stages (limit {MAX_STAGES})"
        raise MethodError(message, cure, code="too-many")


class Substep(Frozen):
    """One substep: a method on point stages and its fraction of the step, which may be negative."""

    tableau: Tableau
    fraction: Number


def composed(substeps: Sequence[Substep]) -> Tableau:
    """Returns the composition with equal stages merged.

    Substeps share a stage if one ends with the value at which the next begins. Raises MethodError
    for different vector fields, or too many stages.
    """
    return merged(in_turn(substeps))


def in_turn(substeps: Sequence[Substep]) -> Tableau:
    """Returns the composition with every stage of every substep; raises as ``composed``."""
    tableaus = [substep.tableau for substep in substeps]
    for tableau in tableaus:
        tableau.demand_fields("a composition")
    first = tableaus[0]
    for number, other in enumerate(tableaus[1:], start=2):
        if other.size != first.size:
            of_first = counted(first.size, "colour")
            of_other = counted(other.size, "colour")
            message = f"substep {number} has {of_other}, the first {of_first}"
            raise MethodError(message, _CURE, code="wrong-size")
        if _fields(other) != _fields(first):
            message = f"substep {number} is for other vector fields than the first"
            raise MethodError(message, _CURE, code="wrong-size")
    stages = sum(map(count_stages, tableaus))
    refuse_large(stages, "take fewer substeps, or methods of fewer stages")
    return _Composition(substeps).tableau()


def count_stages(tableau: Tableau) -> int:
    return sum(space.stages for space in tableau.spaces)


def seen_in_nodes(tableau: Tableau, l: int) -> int | None:
    """Returns the colour whose time the nodes of colour l are: l itself if its stages see it, else
    the first that they see; None if they see none.
    """
    seen = [m for k, m in tableau.edges() if k == l]
    return l if l in seen or not seen else seen[0]


def advance(tableau: Tableau, l: int) -> Number:
    """The change of time of colour l per step; 1 for every consistent method."""
    m = seen_in_nodes(tableau, l)
    colour = tableau.colours[l if m is None else m]
    return matrix.dot(colour.b, tableau.spaces[colour.space].one)


_CURE = "compose methods of the same form and structure"


def _fields(tableau: Tableau) -> tuple[object, ...]:
    return tuple((x.part, x.term, x.kind) for x in tableau.colours), frozenset(tableau.edges())


class _Composition:
    """The tableau of a composition; colours share a stage space if they do in every method."""

    def __init__(self, substeps: Sequence[Substep]) -> None:
        self.substeps = substeps
        first = substeps[0].tableau
        self.colours = first.colours
        tableaus = [substep.tableau for substep in substeps]
        of_colours = [tuple(x.colours[l].space for x in tableaus) for l in range(first.size)]
        self.places = list(dict.fromkeys(of_colours))
        self.space_of = [self.places.index(place) for place in of_colours]

    def tableau(self) -> Tableau:
        colours = tuple(map(self._colour, range(len(self.colours))))
        nodes = (next(x.c for x in colours if x.space == k) for k in range(len(self.places)))
        blocks: dict[Edge, matrix.Matrix] = {}
        for l, m in self.substeps[0].tableau.edges():
            place = self.space_of[l], m
            if place not in blocks:
                blocks[place] = tuple(self._rows(l, m))
        return Tableau(tuple(map(PointSpace, nodes)), colours, blocks)

    def _colour(self, l: int) -> Colour:
        weights: list[Number] = []
        nodes: list[Number] = []
        begin: Number = ZERO
        for substep in self.substeps:
            g, colour = substep.fraction, substep.tableau.colours[l]
            weights += [g * x for x in colour.b]
            nodes += [begin + g * x for x in colour.c]
            begin = begin + g * advance(substep.tableau, l)
        b, c = tuple(weights), tuple(nodes)
        return replace(self.colours[l], space=self.space_of[l], b=b, c=c)

    def _rows(self, l: int, m: int) -> Iterator[matrix.Vector]:
        """The rows of A^{l,m}: weights of the substeps before, the method's own row, zeros."""
        before: list[Number] = []
        widths = [len(x.tableau.colours[m].b) for x in self.substeps]
        for number, substep in enumerate(self.substeps, start=1):
            g = substep.fraction
            after = [ZERO] * sum(widths[number:])
            for row in substep.tableau.block(l, m) or ():
                own = [g * x for x in row]
                yield (*before, *own, *after)
            before += [g * x for x in substep.tableau.colours[m].b]


Flow = tuple[int, Number]
"""A part of the problem, from 0, and the fraction of the step for which it flows."""


def drift_and_kick(flows: Sequence[Flow], is_nystrom: bool = False) -> Tableau:
    """Part 0 drifts q, part 1 kicks p; with ``is_nystrom`` velocities are linear in the momenta."""
    nothing: matrix.Vector = ()
    drift = separable_prk(((), (ONE,), ()), (((),), nothing, (ZERO,)))
    kick = separable_prk((((),), nothing, (ZERO,)), ((), (ONE,), ()))
    parts = [drift, kick]
    made = composed([Substep(parts[l], g) for l, g in flows if g])
    return with_linear(made, ["q"]) if is_nystrom else made


def split(methods: Sequence[Method], flows: Sequence[Flow]) -> Tableau:
    """Returns a splitting of ẏ = Σ f^{l}(y), with one colour and method on point stages a part."""
    parts = [alone(methods, l) for l in range(len(methods))]
    return composed([Substep(parts[l], g) for l, g in flows if g])


def alone(methods: Sequence[Method], l: int) -> Tableau:
    own = methods[l]
    spaces = []
    colours = []
    blocks: dict[Edge, matrix.Matrix] = {}
    for k in range(len(methods)):
        nodes = own.c if k == l else ()
        weights = own.b if k == l else ()
        spaces.append(PointSpace(nodes))
        colours.append(Colour(str(k + 1), k, weights, nodes, k))
        for m in range(len(methods)):
            blocks[k, m] = own.A if k == m == l else ((),) * len(nodes)
    return Tableau(tuple(spaces), tuple(colours), blocks)


def adjoint(tableau: Tableau) -> Tableau:
    """The adjoint method, the inverse of the step with −h.

    It has the same weights and the blocks 𝟙 b_mᵀ − A^{l,m}, its nodes are 1 − c: E. Hairer,
    C. Lubich, G. Wanner, *Geometric Numerical Integration*, V.2. Point stages are reversed, which
    keeps the order of a composition; a stage algebra is reflected, x → 1 − x.
    """
    tableau.demand_fields("the adjoint method")
    turns = [_turn(space) for space in tableau.spaces]
    colours = []
    for l, colour in enumerate(tableau.colours):
        turn = turns[colour.space]
        end = advance(tableau, l)
        own = tableau.spaces[colour.space].one
        rest_of_time = [end * one - c for one, c in zip(own, colour.c, strict=True)]
        b, c = matrix.apply_left(colour.b, turn), matrix.apply(turn, rest_of_time)
        colours.append(replace(colour, b=b, c=c))
    blocks: dict[Edge, matrix.Matrix] = {}
    for (k, m), block in tableau.blocks.items():
        colour = tableau.colours[m]
        rest = matrix.subtract(matrix.outer(tableau.spaces[k].one, colour.b), block)
        blocks[k, m] = matrix.multiply(turns[k], matrix.multiply(rest, turns[colour.space]))
    spaces: list[StageSpace] = []
    for k, space in enumerate(tableau.spaces):
        nodes_of = next((x.c for x in colours if x.space == k), space.nodes)
        spaces.append(_turned_space(space, nodes_of))
    return Tableau(tuple(spaces), tuple(colours), blocks)


def _turned_space(space: StageSpace, nodes: matrix.Vector) -> StageSpace:
    if isinstance(space, PolynomialSpace):
        modulus = space.modulus(fmpq_poly([1, -1]))
        return PolynomialSpace(modulus / modulus.leading_coefficient())
    return PointSpace(nodes)


def _turn(space: StageSpace) -> matrix.Matrix:
    """The reversal of stages, or f(x) → f(1 − x) on polynomials; its own inverse."""
    if not isinstance(space, PolynomialSpace):
        return tuple(reversed(matrix.identity(space.stages)))
    columns: list[list[Number]] = []
    power = fmpq_poly([1])
    for _ in range(space.stages):
        columns.append([fmpq(power[i]) for i in range(space.stages)])
        power *= fmpq_poly([1, -1])
    return tuple(zip(*columns, strict=True))


def extrapolated(base: Tableau, parts: Sequence[int], order: int, is_symmetric: bool) -> Tableau:
    """The combination of numbers of substeps that cancels powers of h; MethodError for too many
    stages.

    E. Hairer, S. P. Nørsett, G. Wanner, *Solving Ordinary Differential Equations I*, II.9: the
    error of a method of order p with n equal substeps has an expansion in h^p, h^(p+1), …, that of
    a symmetric method in h^p, h^(p+2), … ``base`` is on point stages; ``parts`` are the n.
    """
    refuse_large(count_stages(base) * sum(parts), "extrapolate fewer times, or a smaller method")
    gap = 2 if is_symmetric else 1
    powers = range(order, order + gap * (len(parts) - 1), gap)
    weights = extrapolation_weights(parts, powers)
    rows = [composed([Substep(base, fmpq(1, n))] * n) for n in parts]
    return merged(side_by_side(rows, weights))


def side_by_side(tableaus: Sequence[Tableau], weights: matrix.Vector) -> Tableau:
    """Σ w_j Φ_j: every method takes the step from the same value."""
    first = tableaus[0]
    colours = [_side_by_side(tableaus, weights, l) for l in range(first.size)]
    nodes = (next(x.c for x in colours if x.space == k) for k in range(len(first.spaces)))
    blocks: dict[Edge, matrix.Matrix] = {}
    for place in first.blocks:
        _, m = place
        widths = [len(x.colours[m].b) for x in tableaus]
        blocks[place] = tuple(_diagonal([x.blocks[place] for x in tableaus], widths))
    return Tableau(tuple(map(PointSpace, nodes)), tuple(colours), blocks)


def _side_by_side(tableaus: Sequence[Tableau], weights: matrix.Vector, l: int) -> Colour:
    b: list[Number] = []
    c: list[Number] = []
    for tableau, weight in zip(tableaus, weights, strict=True):
        colour = tableau.colours[l]
        b += [weight * x for x in colour.b]
        c += colour.c
    return replace(tableaus[0].colours[l], b=tuple(b), c=tuple(c))


def _diagonal(blocks: Sequence[matrix.Matrix], widths: Sequence[int]) -> Iterator[matrix.Vector]:
    for k, block in enumerate(blocks):
        before = [ZERO] * sum(widths[:k])
        after = [ZERO] * sum(widths[k + 1 :])
        for row in block:
            yield (*before, *row, *after)
