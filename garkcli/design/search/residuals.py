"""The residuals of all trees of a family up to an order, with gradients, for many points at once.

A tree is stem ∘ branch in the tree table, and its stage vector 𝒜^[stem] ⊙ (A 𝒜^[branch]). Values
and derivatives in every unknown are computed together. The residual of a tree u of order ρ is
γ(u)/ρ b·𝒜^[u] − 1/ρ, so all conditions of one order have the same weight.
"""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING, Any, NamedTuple

from flint import fmpq, fmpq_mpoly

from garkcli.deadline import check_time
from garkcli.design.conditions import FamilyConditions
from garkcli.design.search import rational
from garkcli.design.search.flows import flows_of
from garkcli.exact.parametric import Parameters, fraction
from garkcli.ntrees.stage_vectors import StageVectors
from garkcli.order.admissible import coupling_graph
from garkcli.tableau.polynomial_space import PolynomialSpace
from garkcli.tableau.tableau import Tableau

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from garkcli.design.search.rational import Array


class Residuals:
    """The conditions of all trees up to an order, and ``more`` polynomials that should vanish."""

    def __init__(
        self, tableau: Tableau, ring: Parameters, order: int, more: Sequence[fmpq_mpoly] = ()
    ) -> None:
        from garkcli.ntrees.table import TreeTable

        self.tableau = tableau
        self.unknowns = len(ring.names)
        self.table = TreeTable.of(coupling_graph(tableau), order)
        self.blocks = {key: _functions(block, ring) for key, block in tableau.blocks.items()}
        self.weights = _functions([colour.b for colour in tableau.colours], ring)
        self.relations = tuple(more)
        self.more = rational.polynomial_functions(more, ring)

    def __len__(self) -> int:
        return len(self.table) + len(self.more)

    @property
    def numbers_a_point(self) -> int:
        """The approximate number of floats that an evaluation holds for each point."""
        stages = max(space.stages for space in self.tableau.spaces)
        lower = self.table.ids(self.table.max_order).start  # trees below the highest order
        vectors = 3 * lower * stages + 2 * (len(self.table) - lower) * stages
        return (vectors + 2 * len(self)) * (self.unknowns + 1)

    def at(self, points: Array) -> tuple[Array, Array]:
        """Values, shape (conditions, points), and derivatives, (conditions, unknowns, points).
        ``points`` have the shape (unknowns, points), of floats or of balls.
        """
        return _Evaluation(self, points).run()

    @cached_property
    def floats(self) -> tuple[Array, Array]:
        """γ(u)/ρ(u) of each tree, and the value of b·𝒜[u] times this for the exact solution."""
        import numpy as np

        table, kinds = self.table, self.table.admissible.kinds
        integrated = np.array(
            [
                kinds[int(root)].integrated(int(order))
                for root, order in zip(table.root, table.order, strict=True)
            ],
            float,
        )
        return table.gamma.astype(float) / integrated, table.is_exact / integrated

    @cached_property
    def at_one(self) -> Callable[[Array], tuple[Array, Array]]:
        """Evaluates one point in floats: as ``at`` without the last axis, but faster."""
        from garkcli.design.search.one_point import Recorded

        return Recorded(self).at


class Generators(rational.System):
    """Distinct nonzero polynomials with the common zeros of all order conditions of a family. They
    are fewer than the trees, least for compositions of flows; a proof for all of them is a proof
    for all conditions. ``denominators`` vanish at no method of the family.
    """

    def __init__(
        self, tableau: Tableau, ring: Parameters, order: int, more: Sequence[fmpq_mpoly] = ()
    ) -> None:
        conditions = FamilyConditions(tableau, ring)
        flows = flows_of(tableau, order)
        polynomials = list(more)
        if flows is None:
            for k in range(1, order + 1):
                polynomials += [x.polynomial for x in conditions.of_order(k)]
        else:
            polynomials += [fraction(x, ring)[0] for x in flows.conditions(order)]
        known: list[fmpq_mpoly] = []
        for polynomial in polynomials:
            if not polynomial:
                continue
            monic = polynomial / polynomial.leading_coefficient()
            if monic not in known:
                known.append(monic)
        super().__init__(rational.polynomial_functions(known, ring))
        self.denominators = rational.polynomial_functions(conditions.denominators, ring)


def _functions(
    rows: Sequence[Sequence[object]], ring: Parameters
) -> list[list[rational.RationalFunction]]:
    return [[rational.RationalFunction(x, ring) for x in row] for row in rows]


class _Vectors:
    """Stage vectors of trees: values (trees, stages, points), derivatives (…, unknowns, points)."""

    __slots__ = ("derivatives", "values")

    def __init__(self, values: Array, derivatives: Array) -> None:
        self.values = values
        self.derivatives = derivatives

    def __getitem__(self, which: Array) -> _Vectors:
        return _Vectors(self.values[which], self.derivatives[which])


class _Entries(NamedTuple):
    """Nonzero entries of a block, at most one of each row. ``places`` are row, unknown and column
    of each derivative that is not identically zero. Values have the shape (entries, points),
    derivatives (derivatives, points).
    """

    rows: Array
    columns: Array
    values: Array
    places: Array
    derivatives: Array


class _Evaluation(StageVectors[_Vectors]):
    def __init__(self, system: Residuals, points: Array) -> None:
        import numpy as np

        tableau, self.table = system.tableau, system.table
        super().__init__(self.table.admissible, [colour.space for colour in tableau.colours])
        self.np = np
        self.system = system
        self.points = points
        self.is_exact = points.dtype == object
        self.constant: rational.Constant = rational.as_ball if self.is_exact else rational.as_float
        self.blocks = {key: self._entries(block) for key, block in system.blocks.items()}
        self.weights = [[x.at(points, self.constant) for x in row] for row in system.weights]
        shape = len(system), points.shape[1]
        self.values = self._zeros(*shape)
        self.gradients = self._zeros(shape[0], system.unknowns, shape[1])

    def _zeros(self, *shape: int) -> Array:
        if self.is_exact:
            return self.np.full(shape, self.constant(fmpq(0)), object)
        return self.np.zeros(shape)

    def run(self) -> tuple[Array, Array]:
        for l, ids, vectors in self.everything(self.table):
            self._close(l, ids, vectors)
        more = slice(len(self.table), None)
        self.values[more], self.gradients[more] = rational.with_gradients(
            self.system.more, self.points
        )
        return self.values, self.gradients

    def _vertex(self, l: int) -> _Vectors:
        space = self.system.tableau.space(l)
        points = self.points.shape[1]
        values = self._zeros(1, space.stages, points)
        for i, x in enumerate(space.one):
            values[:, i] = self.constant(x)  # type: ignore[arg-type]
        derivatives = self._zeros(1, space.stages, self.system.unknowns, points)
        return _Vectors(values, derivatives)

    def _entries(self, block: Sequence[Sequence[rational.RationalFunction]]) -> list[_Entries]:
        """The nonzero entries of a block: the first of each row, the second, …"""
        layers: list[list[tuple[int, int, rational.Slope]]] = []
        for i, row in enumerate(block):
            places = [(j, x) for j, x in enumerate(row) if not x.is_zero]
            for k, (j, x) in enumerate(places):
                if k == len(layers):
                    layers.append([])
                layers[k].append((i, j, x.at(self.points, self.constant)))
        return [self._layer(entries) for entries in layers]

    def _layer(self, entries: Sequence[tuple[int, int, rational.Slope]]) -> _Entries:
        slopes = [
            (i, unknown, j, derivative)
            for i, j, slope in entries
            for unknown, derivative in slope.derivatives
        ]
        return _Entries(
            self.np.array([i for i, _, _ in entries]),
            self.np.array([j for _, j, _ in entries]),
            self._stacked([slope.value for _, _, slope in entries]),
            self.np.array([x[:3] for x in slopes], int).reshape(-1, 3).transpose(),
            self._stacked([derivative for _, _, _, derivative in slopes]),
        )

    def _stacked(self, numbers: Sequence[Any]) -> Array:
        """Numbers, or arrays of one for each point, as (numbers, points)."""
        stacked = self._zeros(len(numbers), self.points.shape[1])
        for k, number in enumerate(numbers):
            stacked[k] = number
        return stacked

    def _image(self, space: int, m: int, vectors: _Vectors) -> _Vectors:
        layers = self.blocks[space, m]
        trees, _, points = vectors.values.shape
        stages = self.system.tableau.spaces[space].stages
        values = self._zeros(trees, stages, points)
        derivatives = self._zeros(trees, stages, self.system.unknowns, points)
        for layer in layers:
            check_time()
            j, factors = layer.columns, layer.values
            values[:, layer.rows] += factors * vectors.values[:, j]
            derivatives[:, layer.rows] += factors[:, None] * vectors.derivatives[:, j]
            i, unknowns, j = layer.places
            derivatives[:, i, unknowns] += layer.derivatives * vectors.values[:, j]
        return _Vectors(values, derivatives)

    def _joined(self, parts: list[_Vectors]) -> _Vectors:
        join = self.np.concatenate
        return _Vectors(join([x.values for x in parts]), join([x.derivatives for x in parts]))

    def _product(self, space: int, u: _Vectors, v: _Vectors) -> _Vectors:
        check_time()
        stages = self.system.tableau.spaces[space]
        if not isinstance(stages, PolynomialSpace):
            values = u.values * v.values
            derivatives = u.derivatives * v.values[:, :, None]
            derivatives += u.values[:, :, None] * v.derivatives
            return _Vectors(values, derivatives)
        values = self._modular(stages, u.values, v.values)
        derivatives = self._modular(stages, u.derivatives, v.values[:, :, None])
        derivatives += self._modular(stages, v.derivatives, u.values[:, :, None])
        return _Vectors(values, derivatives)

    def _modular(self, space: PolynomialSpace, u: Array, v: Array) -> Array:
        s = space.stages
        trees, _, *rest = u.shape
        out = self._zeros(trees, 2 * s - 1, *rest)
        for i in range(s):
            for j in range(s):
                out[:, i + j] += u[:, i] * v[:, j]
        for k in range(2 * s - 2, s - 1, -1):
            for j in range(s):
                out[:, k - s + j] -= self.constant(space.modulus[j]) * out[:, k]
        return out[:, :s]

    def _close(self, root: int, ids: slice, vectors: _Vectors) -> None:
        values, gradients = self.values[ids], self.gradients[ids]
        for i, slope in enumerate(self.weights[root]):
            x = vectors.values[:, i]
            values += slope.value * x
            gradients += slope.value * vectors.derivatives[:, i]
            for unknown, derivative in slope.derivatives:
                gradients[:, unknown] += derivative * x
        self._normalise(root, ids)

    def _normalise(self, root: int, ids: slice) -> None:
        table = self.table
        values, gradients = self.values[ids], self.gradients[ids]
        integrated = table.admissible.kinds[root].integrated(int(table.order[ids.start]))
        for k, number in enumerate(range(ids.start, ids.stop)):
            scale: Any = self.constant(fmpq(int(table.gamma[number]), integrated))
            required = self.constant(fmpq(int(table.is_exact[number]), integrated))
            values[k] = scale * values[k] - required
            gradients[k] *= scale
