"""Spectral deferred corrections: A. Dutt, L. Greengard, V. Rokhlin, *Spectral deferred correction
methods for ordinary differential equations*, BIT 40 (2000).

From y_0 at all nodes, each sweep goes from node to node by Euler's method for the error of the
collocation equations; the first sweep is Euler's method itself. The step ends at the last node if
that is 1, else by quadrature over the nodes, which gains an order.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import TypeAlias

from flint import fmpq

from garkcli.errors import UnknownFamily
from garkcli.exact.domain import Domain
from garkcli.exact.field import ONE, ZERO, Number
from garkcli.exact.matrix import Vector, dot
from garkcli.exact.nodes import Expression, Literal
from garkcli.families.collocation import gauss, lobatto_iiia, radau_ia, radau_iia
from garkcli.families.family import MethodFamily, Option, Options, Recipe
from garkcli.families.stagelist import START, StageList, Weights, combined
from garkcli.reference import Reference
from garkcli.tableau.polynomial_space import PolynomialSpace, antiderivative, simple_nodes
from garkcli.tableau.stages import PointSpace
from garkcli.tableau.tableau import Method

_COLLOCATION: Mapping[str, Callable[[int], Method]] = {
    "radau-iia": radau_iia,
    "lobatto": lobatto_iiia,
    "gauss": gauss,
    "radau-ia": radau_ia,
}
POINTS = Option(
    "points", "How many nodes spectral deferred corrections have.", smallest=1, shown="3"
)
NODES = Option(
    "nodes",
    "Which nodes spectral deferred corrections are made on.",
    (*_COLLOCATION, "equidistant"),
    default="radau-iia",
)
SWEEPS = Option(
    "sweeps",
    "How many sweeps spectral deferred corrections make; each gains an order.",
    smallest=1,
    shown="4",
)
MAX_SLOPES = 400
SWEEP = Option(
    "sweep",
    "Whether sweeps of deferred corrections are explicit or implicit Euler's.",
    ("explicit", "implicit"),
    default="explicit",
)
_Slopes: TypeAlias = list[int]
"""For each node the stage that is its slope."""


def corrections(points: int, options: Options) -> Recipe:
    """UnknownFamily if there are no such nodes, or they have no simple radicals."""
    word = str(options["nodes"])
    sweeps = int(str(options["sweeps"]))
    is_implicit = options["sweep"] == "implicit"
    nodes = _nodes(word, points)
    kind = options["sweep"]
    name = f"SDC {word} {points}, {sweeps} {kind} sweeps"

    def make(values: Vector) -> Method:
        return _Corrections(values, is_implicit).method(name, sweeps)

    slopes = max(points - 1, 1) * sweeps
    if slopes > MAX_SLOPES:
        return Recipe(slopes, make, nodes)
    domain = Domain(nodes)
    made = make(tuple(map(domain.evaluate, nodes)))
    return Recipe(made.stages, make, nodes)


def _nodes(word: str, points: int) -> tuple[Expression, ...]:
    if word in {"equidistant", "lobatto"} and points < 2:
        cure = "it has 2 points or more"
        raise UnknownFamily(f"no {word} nodes with 1 point", cure, code="wrong-value")
    if word == "equidistant":
        last = points - 1
        return tuple(Literal(fmpq(k, last)) for k in range(points))
    space = _COLLOCATION[word](points).space
    assert isinstance(space, PolynomialSpace)
    nodes = simple_nodes(space)
    if nodes is None:
        message = f"the {points} {word} nodes have no simple radicals"
        raise UnknownFamily(message, "take fewer points, or equidistant ones", code="no-radicals")
    return nodes


class _Corrections:
    def __init__(self, nodes: Vector, is_implicit: bool) -> None:
        self.nodes = nodes
        self.is_implicit = is_implicit
        self.stages = StageList()
        self._integrals = _integrals(nodes)

    def method(self, name: str, sweeps: int) -> Method:
        slopes = [self.stages.slope_at(START)] * len(self.nodes)
        value = START
        for _ in range(sweeps):
            value, slopes = self._swept(slopes)
        if self.nodes[-1] != ONE:
            value = self._integral(len(self.nodes), slopes)
        return self.stages.method(name, value)

    def _swept(self, old: _Slopes) -> tuple[Weights, _Slopes]:
        """The value at the last node after one more sweep, and the slopes at all nodes."""
        new: _Slopes = []
        value: Weights = START
        before: Number = ZERO
        for m, node in enumerate(self.nodes):
            width = node - before
            upper = self._integral(m, old)
            increment = combined([(1, upper), (-1, self._integral(m - 1, old) if m else START)])
            if not width:  # the step begins at the first node
                new.append(old[m])
                continue
            if self.is_implicit:
                value = combined([(1, value), (1, increment), (1, {old[m]: -width})])
                slope = self.stages.implicit_slope(value, width)
                value = combined([(1, value), (1, {slope: width})])
            else:
                value = combined([(1, value), (1, increment)])
                if m:
                    change = {new[-1]: width}
                    value = combined([(1, value), (1, change), (1, {old[m - 1]: -width})])
                slope = self.stages.slope_at(value)
            new.append(slope)
            before = node
        return value, new

    def _integral(self, m: int, slopes: _Slopes) -> Weights:
        """The integral from 0 to node m, or to 1 if m is the number of nodes."""
        pairs = zip(self._integrals[m], slopes, strict=True)
        return combined((weight, {slope: ONE}) for weight, slope in pairs)


def _integrals(nodes: Sequence[Number]) -> tuple[Vector, ...]:
    """∫ L_j from 0 to each node, and to 1: one row for each end."""
    polynomials = [antiderivative(basis) for basis in PointSpace(tuple(nodes)).basis_polynomials()]
    rows = []
    for end in (*nodes, ONE):
        powers: list[Number] = [ONE]
        while len(powers) <= len(nodes):
            powers.append(powers[-1] * end)
        rows.append(tuple(dot(f, powers) for f in polynomials))
    return tuple(rows)


FAMILIES = (
    MethodFamily(
        "sdc",
        corrections,
        1,
        40,
        "sweeps",
        "spectral deferred corrections",
        POINTS,
        (NODES, SWEEPS, SWEEP),
        Reference(
            authors=("A. Dutt", "L. Greengard", "V. Rokhlin"),
            title="Spectral deferred correction methods for ordinary differential equations",
            journal="BIT",
            volume="40",
            year="2000",
        ),
    ),
)
