"""Stage spaces: the algebra in which the stage values of one method live.

Two models of the same thing. ``PointSpace`` is K^s with componentwise multiplication: one number a
stage. ``PolynomialSpace`` is ℚ[x]/(M), M the node polynomial: for the Gauss, Radau and Lobatto
families M is rational although the nodes are not, so nothing in it ever needs a root. Evaluation at
the nodes identifies the two.

A *vector* is a tuple of s coordinates, a *functional* a tuple of s coordinates in the dual basis, a
block a matrix that acts on coordinates.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import cast

from flint import fmpq, fmpq_mat, fmpq_poly

from garkcli.errors import CoincidingNodes
from garkcli.exact.field import ONE, ZERO, Number
from garkcli.exact.matrix import (
    Matrix,
    SingularMatrixError,
    Vector,
    apply,
    apply_left,
    dot,
    identity,
    is_rational,
    multiply,
    solve,
    to_flint,
    transpose,
)


class StageSpace(ABC):
    """A commutative algebra of dimension ``stages`` over the domain of the coefficients."""

    @property
    @abstractmethod
    def stages(self) -> int:
        """s, the number of stages."""

    @property
    @abstractmethod
    def one(self) -> Vector:
        """𝟙."""

    @property
    @abstractmethod
    def nodes(self) -> Vector:
        """C as an element of the algebra."""

    @abstractmethod
    def product(self, u: Vector, v: Vector) -> Vector:
        """The product u ⊙ v."""

    @abstractmethod
    def times(self, functional: Vector, v: Vector) -> Vector:
        """The functional g ↦ functional(v ⊙ g)."""

    @abstractmethod
    def reductions(self, count: int) -> Matrix:
        """The classes of 1, x, …, x^(count−1) as columns, shape (s, count)."""

    @abstractmethod
    def lifts(self) -> Matrix:
        """Coordinates to the polynomial of degree < s they stand for, lowest coefficient first, (s,
        s).

        Raises:
            CoincidingNodes: two nodes are equal.
        """

    def power(self, v: Vector, exponent: int) -> Vector:
        """The power v ⊙ … ⊙ v."""
        result = self.one
        for _ in range(exponent):
            result = self.product(result, v)
        return result

    def gram(self, weights: Vector) -> Matrix:
        """G with entries weights(e_i ⊙ e_j): the bilinear form that B^{l} is in the paper."""
        return tuple(self.times(weights, e) for e in identity(self.stages))

    @abstractmethod
    def zero_weights(self, weights: Vector) -> str:
        """Which of the weights are zero, in words; one of them is."""

    def form(self, weights: Vector, block: Matrix) -> Matrix:
        """The bilinear form (f, g) ↦ weights(f ⊙ A g), with a row for each f, of a block A that
        leads to here.

        At points this is B A.
        """
        return multiply(self.gram(weights), block)

    def adjoint(
        self, block: Matrix, weights: Vector, source: StageSpace, source_weights: Vector
    ) -> Matrix:
        """The map A* from here to ``source`` with ⟨A f, g⟩ = ⟨f, A* g⟩, for a block A from
        ``source`` to here.

        At points this is B_source⁻¹ Aᵀ B_here.

        Raises:
            SingularMatrixError: a weight of ``source`` is zero.
        """
        return solve(source.gram(source_weights), transpose(self.form(weights, block)))


@dataclass(frozen=True)
class PointSpace(StageSpace):
    """K^s: one coordinate a stage, in the order of the file. ``points`` are the nodes."""

    points: Vector

    @property
    def stages(self) -> int:
        return len(self.points)

    @property
    def one(self) -> Vector:
        return (ONE,) * self.stages

    @property
    def nodes(self) -> Vector:
        return self.points

    def product(self, u: Vector, v: Vector) -> Vector:
        return tuple(x * y for x, y in zip(u, v, strict=True))

    def times(self, functional: Vector, v: Vector) -> Vector:
        return self.product(functional, v)

    def reductions(self, count: int) -> Matrix:
        return tuple(_powers(c, count) for c in self.points)

    def lifts(self) -> Matrix:
        return self._lifts

    @cached_property
    def _lifts(self) -> Matrix:
        try:
            return solve(self.reductions(self.stages), identity(self.stages))
        except SingularMatrixError:
            i, j = next(
                (i, j)
                for j in range(self.stages)
                for i in range(j)
                if self.points[i] == self.points[j]
            )
            raise CoincidingNodes(
                f"nodes c_{i + 1} and c_{j + 1} are both {self.points[i]}: no interpolation through them",
                "spell the blocks out, or choose a method with distinct nodes",
            ) from None

    def zero_weights(self, weights: Vector) -> str:
        names = [f"b_{i}" for i, weight in enumerate(weights, start=1) if not weight]
        return f"{' = '.join([*names[:3], '…'] if len(names) > 4 else names)} = 0"

    def form(self, weights: Vector, block: Matrix) -> Matrix:
        return tuple(tuple(w * a for a in row) for w, row in zip(weights, block, strict=True))

    def adjoint(
        self, block: Matrix, weights: Vector, source: StageSpace, source_weights: Vector
    ) -> Matrix:
        if not isinstance(source, PointSpace):
            return super().adjoint(block, weights, source, source_weights)
        if not all(source_weights):
            raise SingularMatrixError
        inverses = [ONE / b for b in source_weights]  # of irrational weights they take the time
        return tuple(
            tuple(w * a * inverse for w, a in zip(weights, column, strict=True))
            for inverse, column in zip(inverses, transpose(block), strict=True)
        )


@dataclass(frozen=True)
class PolynomialSpace(StageSpace):
    """ℚ[x]/(M) with the basis 1, x, …, x^(s−1); M is monic with s distinct real roots, the
    nodes.
    """

    modulus: fmpq_poly

    def __hash__(self) -> int:
        return hash(tuple(self.modulus.coeffs()))

    @property
    def stages(self) -> int:
        return int(self.modulus.degree())

    @property
    def one(self) -> Vector:
        return self._vector(fmpq_poly([1]))

    @property
    def nodes(self) -> Vector:
        return self._vector(fmpq_poly([0, 1]) % self.modulus)

    def _vector(self, poly: fmpq_poly) -> Vector:
        return tuple(poly[k] for k in range(self.stages))

    def product(self, u: Vector, v: Vector) -> Vector:
        if is_rational((u, v)):
            f, g = (fmpq_poly(cast("list[fmpq]", list(w))) for w in (u, v))
            return self._vector(f * g % self.modulus)
        return apply(self._higher, _convolution(u, v))

    @cached_property
    def _higher(self) -> Matrix:
        return self.reductions(2 * self.stages - 1)

    @cached_property
    def _higher_in_flint(self) -> fmpq_mat:
        return to_flint(self._higher, 2 * self.stages - 1)

    def times(self, functional: Vector, v: Vector) -> Vector:
        s, moments = self.stages, self._moments(functional)
        if is_rational((moments, v)):
            turned, f = (fmpq_poly(cast("list[fmpq]", list(w))) for w in (v[::-1], moments))
            product = turned * f
            return tuple(product[s - 1 + j] for j in range(s))
        return tuple(dot(v, moments[j : j + s]) for j in range(s))

    def gram(self, weights: Vector) -> Matrix:
        s, moments = self.stages, self._moments(weights)
        return tuple(moments[i : i + s] for i in range(s))

    def _moments(self, functional: Vector) -> Vector:
        """The functional on 1, x, …, x^(2s−2)."""
        if is_rational((functional,)):
            return tuple((to_flint((functional,), self.stages) * self._higher_in_flint).entries())
        return apply_left(functional, self._higher)

    def reductions(self, count: int) -> Matrix:
        power, columns = fmpq_poly([1]) % self.modulus, []
        for _ in range(count):
            columns.append(self._vector(power))
            power = fmpq_poly([0, 1]) * power % self.modulus
        return transpose(tuple(columns))

    def lifts(self) -> Matrix:
        return identity(self.stages)

    def zero_weights(self, weights: Vector) -> str:
        if not is_rational((weights,)):
            return "one of which is 0"
        nodes = self.modulus // self._nodes_with_weight(weights)
        if nodes.degree() == 1:
            return f"which is 0 at the node {-nodes[0]}"
        return f"which are 0 at the nodes where {nodes} = 0"

    def _nodes_with_weight(self, weights: Vector) -> fmpq_poly:
        """The monic polynomial g with the nodes of nonzero weight as its roots: b(x^i g) = 0 for
        all i.
        """
        gram = to_flint(self.gram(weights), self.stages)
        degree = gram.rank()
        square = fmpq_mat(
            degree, degree, [gram[i, j] for i in range(degree) for j in range(degree)]
        )
        column = fmpq_mat(degree, 1, [-gram[i, degree] for i in range(degree)])
        return fmpq_poly([*square.solve(column).entries(), fmpq(1)])


def _powers(x: Number, count: int) -> Vector:
    powers: list[Number] = [ONE]
    while len(powers) < count:
        powers.append(powers[-1] * x)
    return tuple(powers[:count])


def _convolution(u: Sequence[Number], v: Sequence[Number]) -> Vector:
    out: list[Number] = [fmpq(0)] * (len(u) + len(v) - 1)
    for i, x in enumerate(u):
        for j, y in enumerate(v):
            if x and y:
                out[i + j] = out[i + j] + x * y
    return tuple(out)


def integral(moments: int) -> Vector:
    """∫_0^1 on 1, x, …, x^(moments−1)."""
    return tuple(fmpq(1, k) for k in range(1, moments + 1))


def integration(degree: int) -> Matrix:
    """The map f ↦ ∫_0^x f on polynomials of degree < ``degree``, shape (degree + 1, degree)."""
    return tuple(
        tuple(fmpq(1, i) if i == j + 1 else ZERO for j in range(degree)) for i in range(degree + 1)
    )
