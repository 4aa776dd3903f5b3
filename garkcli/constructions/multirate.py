"""Multirate methods: small steps of a fast method within one step of a slow one.

The first colour is the fast part, the others are slow ones. With polynomials between the slow
stages: A. Sandu, *A class of multirate infinitesimal GARK methods*, SIAM J. Numer. Anal. 57 (2019);
R. Chinomona, D. Reynolds (2021) with two slow parts, O. Knoth, R. Wolke (1998) for constant ones;
the fast problem is solved by small steps of a method. With coupling matrices: M. Günther, A. Sandu,
*Multirate generalized additive Runge–Kutta methods*, Numer. Math. 133 (2016).
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from itertools import pairwise
from typing import TypeAlias

from flint import fmpq

from garkcli.constructions.composition import Substep, composed, in_turn, refuse_large
from garkcli.errors import MethodError
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
"""A stage of a colour, both counted from 0."""
Value: TypeAlias = Mapping[Slope, Number]
"""How much of each slope is in a value."""
START: Value = {}
"""The value at the beginning of the step."""


def summed(*values: Value) -> Value:
    """The sum of combinations of slopes."""
    total: dict[Slope, Number] = {}
    for value in values:
        for slope, weight in value.items():
            total[slope] = total.get(slope, ZERO) + weight
    return total


def of_slopes(colour: int, stages: Iterable[int], weights: Iterable[Number]) -> Value:
    """Weights for stages of one colour."""
    return {(colour, i): weight for i, weight in zip(stages, weights, strict=True)}


class Program:
    """The stages of a method, space by space.

    Args:
        spaces: for each colour the space of its stages.
    """

    def __init__(self, spaces: Sequence[int]) -> None:
        self.spaces = tuple(spaces)
        count = max(spaces) + 1
        self._rows: list[list[Value]] = [[] for _ in range(count)]
        self._nodes: list[list[Number]] = [[] for _ in range(count)]

    def count(self, space: int) -> int:
        """How many stages a space has so far."""
        return len(self._rows[space])

    def add(self, space: int, value: Value, node: Number) -> None:
        """One stage more."""
        self._rows[space].append(value)
        self._nodes[space].append(node)

    def tableau(self, result: Value) -> Tableau:
        """The method whose step ends at a value; every colour sees every other."""
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
"""The colours of the parts."""
_SMALLER = "take fewer steps, or methods of fewer stages"


class Coupling(Frozen):
    """How slow slopes act between slow stages, as polynomials in τ from 0 to 1.

    Attributes:
        nodes: of the slow stages, from 0 to 1; the last one is the end of the step.
        matrices: for each slow part the matrices of τ⁰, τ¹, …; row i leads from stage i to the
            next, with a column for each node.
    """

    nodes: Vector
    matrices: tuple[tuple[Matrix, ...], ...]


def mis_coupling(base: Method) -> Coupling:
    """The constant coupling of multirate infinitesimal steps: differences of rows of a method."""
    rows = [*base.A, base.b]
    differences = []
    for before, row in pairwise(rows):
        row_of_differences = [x - y for x, y in zip(row, before, strict=True)]
        differences.append((*row_of_differences, ZERO))
    return Coupling((*base.c, ONE), ((tuple(differences),),))


def mri(coupling: Coupling, fast: Method, steps: int) -> Tableau:
    """The multirate infinitesimal method, its fast problems solved by small steps.

    Args:
        coupling: between the slow stages.
        fast: the method of the small steps, its stages at points.
        steps: how many between two slow stages that are apart in time.

    Raises:
        MethodError: the nodes are not from 0 to 1, or there are too many stages.
    """
    first, last = coupling.nodes[0], coupling.nodes[-1]
    if first:
        message = f"the slow stages begin at {first}, not at 0"
        raise MethodError(message, "take a slow method with c_1 = 0", code="cannot-construct")
    if last != ONE:
        message = f"the slow stages end at {last}, not at 1"
        raise MethodError(message, "give the end of the step as last node", code="cannot-construct")
    refuse_large((len(coupling.nodes) - 1) * (steps * fast.stages + 2), _SMALLER)
    return merged(_Infinitesimal(coupling, fast, steps).tableau())


class _Infinitesimal:
    """One such method, from stage to stage."""

    def __init__(self, coupling: Coupling, fast: Method, steps: int) -> None:
        self.coupling = coupling
        self.fast = fast
        self.steps = steps
        self.program = Program([FAST, *[SLOW] * len(coupling.matrices)])

    def tableau(self) -> Tableau:
        """The whole; a last slow stage that nothing looks at is left out."""
        nodes = self.coupling.nodes
        value = START
        self.program.add(SLOW, value, nodes[0])
        for i in range(len(nodes) - 1):
            value = self._after(i, value)
            is_last = i + 2 == len(nodes)
            if not is_last or self._looks_at_end():
                self.program.add(SLOW, value, nodes[i + 1])
        return self.program.tableau(value)

    def _looks_at_end(self) -> bool:
        """Whether the slow slope at the end of the step is used: the last row is implicit."""
        every = [x for powers in self.coupling.matrices for x in powers]
        return any(row[-1] for matrix in every for row in matrix)

    def _after(self, i: int, value: Value) -> Value:
        """The value at slow stage i + 1, from that at stage i."""
        nodes = self.coupling.nodes
        if nodes[i + 1] == nodes[i]:
            return summed(value, self._integrated(i))
        length = fmpq(1, self.steps)
        for n in range(self.steps):
            value = self._small_step(i, value, n * length, length)
        return value

    def _small_step(self, i: int, value: Value, begin: Number, length: fmpq) -> Value:
        """One step of the fast method from τ = ``begin``."""
        nodes = self.coupling.nodes
        width = nodes[i + 1] - nodes[i]
        first = self.program.count(FAST)
        stages = range(first, first + self.fast.stages)
        times = [begin + length * c for c in self.fast.c]
        for row, time in zip(self.fast.A, times, strict=True):
            inner = self._moved(i, row, times, stages, length)
            self.program.add(FAST, summed(value, inner), nodes[i] + width * time)
        return summed(value, self._moved(i, self.fast.b, times, stages, length))

    def _moved(
        self, i: int, weights: Vector, times: Sequence[Number], stages: range, length: fmpq
    ) -> Value:
        """The fast slopes and the slow ones at their times, with the weights of the fast method."""
        nodes = self.coupling.nodes
        width = nodes[i + 1] - nodes[i]
        own = [length * width * w for w in weights]
        scaled = [length * w for w in weights]
        moved = of_slopes(FAST, stages, own)
        for colour, powers in enumerate(self.coupling.matrices, start=SLOW):
            for j in range(len(nodes)):
                total = dot(scaled, [_polynomial(powers, i, j, time) for time in times])
                moved = summed(moved, {(colour, j): total})
        return moved

    def _integrated(self, i: int) -> Value:
        """The slow slopes with the integrals of their polynomials from 0 to 1."""
        moved = START
        for colour, powers in enumerate(self.coupling.matrices, start=SLOW):
            for j in range(len(self.coupling.nodes)):
                row = tuple(matrix[i][j] for matrix in powers)
                moved = summed(moved, {(colour, j): sum(antiderivative(row), ZERO)})
        return moved


def _polynomial(powers: Sequence[Matrix], i: int, j: int, time: Number) -> Number:
    """Σ γ^k_ij τ^k."""
    total: Number = ZERO
    for matrix in reversed(powers):
        total = total * time + matrix[i][j]
    return total


def small_steps(fast: Method, steps: int) -> Method:
    """So many equal steps of a method as one.

    Raises:
        MethodError: there are too many stages.
    """
    refuse_large(steps * fast.stages, _SMALLER)
    one = Substep(gark([fast], {}), fmpq(1, steps))
    return _alone(composed([one] * steps))


def _alone(tableau: Tableau) -> Method:
    """The method of one colour that a tableau is."""
    return Method("", tableau.spaces[0], tableau.blocks[0, 0], tableau.colours[0].b)


def by_rule(slow: Method, fast: Method, steps: int, rule: Rule) -> Tableau:
    """Small steps and a slow step, coupled both ways by a transfer rule.

    Raises:
        MethodError: the rule asks for distinct nodes, or there are too many stages.
    """
    whole = small_steps(fast, steps)
    return gark([whole, slow], {(FAST, SLOW): rule(whole, slow), (SLOW, FAST): rule(slow, whole)})


def slowest_first(slow: Method, fast: Method, steps: int) -> Tableau:
    """The slow method takes the whole step for both parts; then the fast part is taken again in
    small steps, with the slow slopes interpolated.

    Raises:
        CoincidingNodes: two nodes of the slow method are equal.
        MethodError: there are too many stages.
    """
    refuse_large(2 * slow.stages + steps * fast.stages, _SMALLER)
    program = Program([FAST, SLOW])
    every = range(slow.stages)
    for row, node in zip(slow.A, slow.c, strict=True):
        coarse = summed(of_slopes(FAST, every, row), of_slopes(SLOW, every, row))
        program.add(FAST, coarse, node)
        program.add(SLOW, coarse, node)
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
    """Coupling matrices, one of each for every small step.

    Attributes:
        fast_slow: A^{f,s,λ}, a row for each fast stage.
        slow_fast: A^{s,f,λ}, a row for each slow stage; its entries are in small steps.
    """

    fast_slow: tuple[Matrix, ...]
    slow_fast: tuple[Matrix, ...]


def by_blocks(slow: Method, fast: Method, blocks: Blocks) -> Tableau:
    """Small steps and a slow step with coupling matrices for each small step.

    Raises:
        MethodError: there are too many stages.
    """
    steps = len(blocks.fast_slow)
    refuse_large(slow.stages + steps * fast.stages, _SMALLER)
    length = fmpq(1, steps)
    one = Substep(gark([fast], {}), length)
    whole = _alone(in_turn([one] * steps))
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
