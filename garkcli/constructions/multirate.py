"""Multirate methods: small steps of a fast method within one step of a slow one.

The first colour is the fast part, the others are slow ones. With coupling matrices: M. Günther, A.
Sandu, *Multirate generalized additive Runge–Kutta methods*, Numer. Math. 133 (2016). Methods with
fast problems between slow stages are in ``infinitesimal``.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import TypeAlias

from flint import fmpq

from garkcli.constructions.composition import Substep, composed, in_turn, refuse_large
from garkcli.exact.field import ONE, ZERO, Number
from garkcli.exact.matrix import Matrix, Vector, dot
from garkcli.frozen import Frozen
from garkcli.properties.reduction import merged
from garkcli.tableau.forms import gark
from garkcli.tableau.polynomial_space import antiderivative
from garkcli.tableau.stages import PointSpace
from garkcli.tableau.tableau import Colour, Edge, Method, Tableau
from garkcli.transfer import Rule

Slope: TypeAlias = tuple[int, int]
"""A stage of a colour, both from 0."""
Value: TypeAlias = Mapping[Slope, Number]
START: Value = {}


def summed(*values: Value) -> Value:
    total: dict[Slope, Number] = {}
    for value in values:
        for slope, weight in value.items():
            total[slope] = total.get(slope, ZERO) + weight
    return total


def of_slopes(colour: int, stages: Iterable[int], weights: Iterable[Number]) -> Value:
    return {(colour, i): weight for i, weight in zip(stages, weights, strict=True)}


class SmallSteps:
    def __init__(self, spaces: Sequence[int]) -> None:
        self.spaces = tuple(spaces)
        count = max(spaces) + 1
        self._rows: list[list[Value]] = [[] for _ in range(count)]
        self._nodes: list[list[Number]] = [[] for _ in range(count)]

    def count(self, space: int) -> int:
        return len(self._rows[space])

    def add(self, space: int, value: Value, node: Number) -> None:
        self._rows[space].append(value)
        self._nodes[space].append(node)

    def tableau(self, result: Value) -> Tableau:
        colours = []
        blocks: dict[Edge, Matrix] = {}
        for m, space in enumerate(self.spaces):
            b = self._row(result, m)
            nodes = tuple(self._nodes[space])
            colours.append(Colour(str(m + 1), space, b, nodes, m))
            for k, rows in enumerate(self._rows):
                blocks[k, m] = tuple(self._row(row, m) for row in rows)
        spaces = tuple(PointSpace(tuple(nodes)) for nodes in self._nodes)
        return Tableau(spaces, tuple(colours), blocks)

    def _row(self, value: Value, colour: int) -> Vector:
        stages = range(self.count(self.spaces[colour]))
        return tuple(value.get((colour, i), ZERO) for i in stages)


FAST, SLOW = 0, 1
SMALLER = "take fewer steps, or methods of fewer stages"


def small_steps(fast: Method, steps: int) -> Method:
    """Returns equal steps as one method; MethodError for too many stages."""
    refuse_large(steps * fast.stages, SMALLER)
    one = Substep(gark([fast], {}), fmpq(1, steps))
    return _as_method(composed([one] * steps))


def _as_method(tableau: Tableau) -> Method:
    return Method("", tableau.spaces[0], tableau.blocks[0, 0], tableau.colours[0].b)


def by_rule(slow: Method, fast: Method, steps: int, rule: Rule) -> Tableau:
    """Returns small steps and a slow step, coupled both ways by a transfer rule. Raises MethodError
    if the rule needs distinct nodes, or for too many stages.
    """
    whole = small_steps(fast, steps)
    return gark([whole, slow], {(FAST, SLOW): rule(whole, slow), (SLOW, FAST): rule(slow, whole)})


def add_slow_stages(program: SmallSteps, slow: Method) -> None:
    """Adds the stages of a slow method that takes the step for both parts."""
    every = range(slow.stages)
    for row, node in zip(slow.A, slow.c, strict=True):
        coarse = summed(of_slopes(FAST, every, row), of_slopes(SLOW, every, row))
        program.add(FAST, coarse, node)
        program.add(SLOW, coarse, node)


def slowest_first(slow: Method, fast: Method, steps: int) -> Tableau:
    """The slow method takes the whole step for both parts; then small steps repeat the fast part
    with slow slopes interpolated. CoincidingNodes for equal slow nodes, MethodError for too many
    stages.
    """
    refuse_large(2 * slow.stages + steps * fast.stages, SMALLER)
    program = SmallSteps([FAST, SLOW])
    every = range(slow.stages)
    add_slow_stages(program, slow)
    whole = small_steps(fast, steps)
    first = slow.stages
    stages = range(first, first + whole.stages)
    integrals = [antiderivative(x) for x in slow.space.basis_polynomials()]
    for row, node in zip(whole.A, whole.c, strict=True):
        powers: list[Number] = [ONE]
        for _ in range(slow.stages):
            powers.append(powers[-1] * node)
        seen = [dot(f, powers) for f in integrals]
        program.add(FAST, summed(of_slopes(FAST, stages, row), of_slopes(SLOW, every, seen)), node)
    result = summed(of_slopes(FAST, stages, whole.b), of_slopes(SLOW, every, slow.b))
    return merged(program.tableau(result))


class Blocks(Frozen):
    """The coupling A^{f,s,λ} and A^{s,f,λ} of each small step λ; entries are in small steps."""

    fast_slow: tuple[Matrix, ...]
    slow_fast: tuple[Matrix, ...]


def by_blocks(slow: Method, fast: Method, blocks: Blocks) -> Tableau:
    """Returns the method with a coupling for each small step; MethodError for too many stages."""
    steps = len(blocks.fast_slow)
    refuse_large(slow.stages + steps * fast.stages, SMALLER)
    length = fmpq(1, steps)
    one = Substep(gark([fast], {}), length)
    whole = _as_method(in_turn([one] * steps))
    seen_by_fast: list[Vector] = []
    for block in blocks.fast_slow:
        seen_by_fast += block
    seen_by_slow = []
    for i in range(slow.stages):
        row: list[Number] = []
        for block in blocks.slow_fast:
            row += [length * x for x in block[i]]
        seen_by_slow.append(tuple(row))
    couplings = {(FAST, SLOW): tuple(seen_by_fast), (SLOW, FAST): tuple(seen_by_slow)}
    return merged(gark([whole, slow], couplings))
