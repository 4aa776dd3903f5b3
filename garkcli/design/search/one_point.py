"""Rational functions and residuals at one point in floats, with derivatives, for an optimiser.

They are products of arrays, whose last bits depend on the machine.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any, Protocol, TypeAlias

from garkcli import numpy_on_use as np
from garkcli.deadline import check_time
from garkcli.design.search.rational import RationalFunction, SparsePolynomial, as_float
from garkcli.ntrees.stage_vectors import StageVectors
from garkcli.tableau.polynomial_space import PolynomialSpace

if TYPE_CHECKING:
    from garkcli.design.search.rational import Array
    from garkcli.ntrees.table import TreeTable
    from garkcli.tableau.tableau import Tableau


class Functions:
    """Rational functions at one point, each monomial once; sums depend on the machine."""

    def __init__(self, functions: Sequence[RationalFunction], unknowns: int) -> None:
        self.shape = len(functions), unknowns
        parts: list[SparsePolynomial] = []
        widths = {"p": 2, "q": 2, "dp": 3, "dq": 3}
        places: dict[str, list[tuple[int, ...]]] = {kind: [] for kind in widths}

        def add(kind: str, polynomial: SparsePolynomial | None, *place: int) -> None:
            if polynomial is not None and polynomial.terms:
                places[kind].append((len(parts), *place))
                parts.append(polynomial)

        for k, function in enumerate(functions):
            add("p", function.numerator, k)
            add("q", function.denominator, k)
            for unknown, (of_p, of_q) in function.derivatives:
                add("dp", of_p, k, unknown)
                add("dq", of_q, k, unknown)
        self._places = {
            kind: tuple(np.array(places[kind], int).reshape(-1, width).transpose())
            for kind, width in widths.items()
        }
        monomials: dict[tuple[int, ...], int] = {}
        terms = [
            (as_float(a), monomials.setdefault(factors, len(monomials)))
            for part in parts
            for a, factors in part.terms
        ]
        self._coefficients = np.array([a for a, _ in terms])
        self._monomials = np.array([monomial for _, monomial in terms], int)
        self._first = np.cumsum([0, *(len(part.terms) for part in parts)])[:-1]
        degree = max(map(len, monomials), default=0)
        padded = [(*factors, *[unknowns] * (degree - len(factors))) for factors in monomials]
        self._factors = np.array(padded, int).reshape(len(padded), degree)

    def at(self, point: Array) -> tuple[Array, Array]:
        """Values, shape (functions,), and derivatives, (functions, unknowns)."""
        values, gradients = np.zeros(self.shape[0]), np.zeros(self.shape)
        if not len(self._first):
            return values, gradients
        monomials = np.append(point, 1.0)[self._factors].prod(1)
        sums = np.add.reduceat(self._coefficients * monomials[self._monomials], self._first)
        of_p, k = self._places["p"]
        values[k] = sums[of_p]
        of_dp, k, unknown = self._places["dp"]
        gradients[k, unknown] = sums[of_dp]
        of_q, k = self._places["q"]
        if len(of_q):
            q = np.ones(self.shape[0])
            q[k] = sums[of_q]
            values /= q
            of_dq, k, unknown = self._places["dq"]
            gradients[k, unknown] -= values[k] * sums[of_dq]
            gradients /= q[:, None]
        return values, gradients


class Matrix:
    def __init__(self, rows: Sequence[Sequence[RationalFunction]], unknowns: int) -> None:
        self.shape = len(rows), len(rows[0]) if rows else 0
        places = [(i, j) for i, row in enumerate(rows) for j, x in enumerate(row) if not x.is_zero]
        self._rows = np.array([i for i, _ in places], int)
        self._columns = np.array([j for _, j in places], int)
        self._functions = Functions([rows[i][j] for i, j in places], unknowns)

    def at(self, point: Array) -> Array:
        """The matrix with its derivatives, shape (1 + unknowns, rows, columns)."""
        values, gradients = self._functions.at(point)
        matrix = np.zeros((1 + gradients.shape[1], *self.shape))
        matrix[0, self._rows, self._columns] = values
        matrix[1:, self._rows, self._columns] = gradients.transpose()
        return matrix


Steps: TypeAlias = "list[Array]"
"""The arrays of all steps so far at a point."""


class ConditionsOfFamily(Protocol):
    """The order conditions of a family, as ``Residuals`` has them."""

    tableau: Tableau
    table: TreeTable
    unknowns: int
    blocks: dict[tuple[int, int], list[list[RationalFunction]]]
    weights: list[list[RationalFunction]]
    more: list[RationalFunction]

    @property
    def floats(self) -> tuple[Array, Array]: ...

    def __len__(self) -> int: ...


class Recorded(StageVectors[int]):
    """The steps that compute the stage vectors of all trees, recorded once, by their numbers.
    Vectors of trees have the shape (trees, 1 + unknowns, stages): values and derivatives, to which
    matrices are applied together.
    """

    def __init__(self, system: ConditionsOfFamily) -> None:
        colours = [colour.space for colour in system.tableau.colours]
        super().__init__(system.table.admissible, colours)
        n = self.unknowns = system.unknowns
        self._spaces = system.tableau.spaces
        self._powers = {
            k: _multiplication(space)
            for k, space in enumerate(self._spaces)
            if isinstance(space, PolynomialSpace)
        }
        self._blocks = {key: Matrix(block, n) for key, block in system.blocks.items()}
        self._weights = [Matrix([row], n) for row in system.weights]
        self._more = Functions(system.more, n)
        self._floats = system.floats
        self._size = len(system)
        self._applied: dict[tuple[int, int], Array] = {}
        self._steps: list[Callable[[Steps], Array]] = []
        self._closing = [(root, ids, number) for root, ids, number in self.everything(system.table)]

    def at(self, point: Array) -> tuple[Array, Array]:
        """Values, shape (conditions,), and derivatives, (conditions, unknowns)."""
        check_time()
        self._applied = {key: block.at(point) for key, block in self._blocks.items()}
        weights = [row.at(point) for row in self._weights]
        made: Steps = []
        for step in self._steps:
            made.append(step(made))
        residuals = np.zeros((self._size, 1 + self.unknowns))
        scale, required = self._floats
        for root, ids, number in self._closing:
            residuals[ids] = scale[ids, None] * _applied(weights[root], made[number])[:, :, 0]
            residuals[ids, 0] -= required[ids]
        trees = len(scale)
        residuals[trees:, 0], residuals[trees:, 1:] = self._more.at(point)
        return residuals[:, 0], residuals[:, 1:]

    def _add(self, step: Callable[[Steps], Array]) -> int:
        self._steps.append(step)
        return len(self._steps) - 1

    def _vertex(self, l: int) -> int:
        one = self._spaces[self.rows[l]].one
        vertex = np.zeros((1, 1 + self.unknowns, len(one)))
        vertex[0, 0] = [as_float(x) for x in one]  # type: ignore[arg-type]
        return self._add(lambda _: vertex)

    def _image(self, space: int, m: int, vectors: int) -> int:
        return self._add(lambda made: _applied(self._applied[space, m], made[vectors]))

    def _part(self, vectors: int, places: Any) -> int:
        return self._add(lambda made: made[vectors][places])

    def _joined(self, parts: list[int]) -> int:
        return self._add(lambda made: np.concatenate([made[k] for k in parts]))

    def _product(self, space: int, stems: int, branches: int) -> int:
        powers = self._powers.get(space)
        return self._add(lambda made: _multiplied(made[stems], made[branches], powers))


def _applied(matrix: Array, vectors: Array) -> Array:
    transposed = matrix.transpose(0, 2, 1)
    images: Array = vectors @ transposed[0]
    images[:, 1:] += (vectors[:, 0] @ transposed[1:]).transpose(1, 0, 2)
    return images


def _multiplied(u: Array, v: Array, powers: Array | None) -> Array:
    if powers is None:
        product: Array = u * v[:, :1]
        other = u[:, :1] * v
    else:
        product = u @ np.tensordot(v[:, 0], powers, 1)
        other = v @ np.tensordot(u[:, 0], powers, 1)
    product[:, 1:] += other[:, 1:]
    return product


def _multiplication(space: PolynomialSpace) -> Array:
    """Multiplication by each power of x, as matrices to the right of row vectors."""
    s = space.stages
    rows = space.reductions(2 * s - 1)
    reductions = np.array([[as_float(x) for x in row] for row in rows])  # type: ignore[arg-type]
    return np.array([reductions[:, k : k + s].transpose() for k in range(s)])
