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
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property, lru_cache
from itertools import combinations
from math import prod
from typing import cast

from flint import fmpq, fmpq_mat, fmpq_poly, fmpz

from garkcli.errors import CoincidingNodes
from garkcli.exact.field import ONE, ZERO, Algebraic, Number
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

MAX_BITS_OF_ROW = 20_000
"""Bits of all denominators of a row up to which elimination may multiply them with each other."""
MAX_BITS_COMPARED = 5_000_000
"""Longest denominators that are compared with each other only to tell what they share."""


MAX_MOMENTS = 8
"""So many functionals of a stage space have their moments kept."""


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
    def of_polynomial(self, coefficients: Sequence[Number]) -> Vector:
        """The element that a polynomial is, its coefficients given from the lowest to the highest.

        At points these are its values at the nodes.
        """

    @abstractmethod
    def basis_polynomials(self) -> Iterator[Vector]:
        """The polynomial of degree < s that each basis vector stands for, lowest coefficient first.

        At points these are the Lagrange polynomials of the nodes. One is made at a time: together
        they can be far larger than what is made from them.

        Raises:
            CoincidingNodes: two nodes are equal.
        """

    @abstractmethod
    def lifts(self) -> Matrix:
        """Coordinates to the polynomial of degree < s they stand for, shape (s, s).

        The columns are the ``basis_polynomials``.

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
        right = transpose(self.form(weights, block))
        return source.divide_by_weights(source_weights, right)

    @abstractmethod
    def divide_by_weights(self, weights: Vector, right: Matrix) -> Matrix:
        """The matrix X with G X = ``right``, where G is the ``gram`` of the weights.

        At points this is B⁻¹ ``right``.

        Raises:
            SingularMatrixError: one of the weights is zero.
        """


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

    def of_polynomial(self, coefficients: Sequence[Number]) -> Vector:
        if is_rational((coefficients, self.points)):
            polynomial = _in_flint(coefficients)
            return tuple(polynomial(c) for c in cast("tuple[fmpq, ...]", self.points))
        return tuple(_value(coefficients, c) for c in self.points)

    def interpolation_bits(self, enough: int) -> int:
        """About how long the common denominator of the Lagrange polynomials of the nodes is.

        Args:
            enough: a bound that is not larger than this is returned as it is; otherwise it is looked
                at closer, at what the polynomials have in common.

        Returns:
            Bits, summed over the coordinates of irrational nodes.
        """
        pairs = combinations(self.points, 2)
        bound = sum(_bits(x - y) for x, y in pairs)
        if (
            bound <= enough
            or bound > MAX_BITS_COMPARED
            or not is_rational((self.points,))
        ):
            return bound
        common = fmpz(1)
        for c in cast("tuple[fmpq, ...]", self.points):
            others = prod((c - x for x in self.points if x != c), start=ONE)
            common = common.lcm(cast("fmpq", others).p)
        return common.bit_length()

    def basis_polynomials(self) -> Iterator[Vector]:
        self._check_distinct()
        if is_rational((self.points,)):
            yield from _rational_lagrange(cast("tuple[fmpq, ...]", self.points))
        else:
            yield from _lagrange(self.points)

    def _check_distinct(self) -> None:
        first: dict[Number, int] = {}
        for j, c in enumerate(self.points):
            i = first.setdefault(c, j)
            if i != j:
                raise CoincidingNodes(
                    f"nodes c_{i + 1} and c_{j + 1} are both {c}: no interpolation through them",
                    "spell the blocks out, or choose a method with distinct nodes",
                )

    def lifts(self) -> Matrix:
        return self._lifts

    @cached_property
    def _lifts(self) -> Matrix:
        return transpose(tuple(self.basis_polynomials()))

    def zero_weights(self, weights: Vector) -> str:
        names = [f"b_{i}" for i, weight in enumerate(weights, start=1) if not weight]
        return f"{' = '.join([*names[:3], '…'] if len(names) > 4 else names)} = 0"

    def form(self, weights: Vector, block: Matrix) -> Matrix:
        return tuple(
            tuple(w * a for a in row) for w, row in zip(weights, block, strict=True)
        )

    def divide_by_weights(self, weights: Vector, right: Matrix) -> Matrix:
        if not all(weights):
            raise SingularMatrixError
        inverses = [
            ONE / b for b in weights
        ]  # of irrational weights they take the time
        return tuple(
            tuple(inverse * x for x in row)
            for inverse, row in zip(inverses, right, strict=True)
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
            turned, f = (
                fmpq_poly(cast("list[fmpq]", list(w))) for w in (v[::-1], moments)
            )
            product = turned * f
            return tuple(product[s - 1 + j] for j in range(s))
        return tuple(dot(v, moments[j : j + s]) for j in range(s))

    def gram(self, weights: Vector) -> Matrix:
        s, moments = self.stages, self._moments(weights)
        return tuple(moments[i : i + s] for i in range(s))

    def _moments(self, functional: Vector) -> Vector:
        """The functional on 1, x, …, x^(2s−2); kept for weights, which are asked for again."""
        if functional not in self._known_moments:
            if len(self._known_moments) >= MAX_MOMENTS:
                self._known_moments.clear()
            self._known_moments[functional] = self._new_moments(functional)
        return self._known_moments[functional]

    @cached_property
    def _known_moments(self) -> dict[Vector, Vector]:
        return {}

    def _new_moments(self, functional: Vector) -> Vector:
        if is_rational((functional,)):
            return tuple(
                (to_flint((functional,), self.stages) * self._higher_in_flint).entries()
            )
        return apply_left(functional, self._higher)

    def reductions(self, count: int) -> Matrix:
        power, columns = fmpq_poly([1]) % self.modulus, []
        for _ in range(count):
            columns.append(self._vector(power))
            power = fmpq_poly([0, 1]) * power % self.modulus
        return transpose(tuple(columns))

    def of_polynomial(self, coefficients: Sequence[Number]) -> Vector:
        if is_rational((coefficients,)):
            return self._vector(_in_flint(coefficients) % self.modulus)
        return apply(self.reductions(len(coefficients)), coefficients)

    def basis_polynomials(self) -> Iterator[Vector]:
        yield from identity(self.stages)

    def lifts(self) -> Matrix:
        return identity(self.stages)

    def divide_by_weights(self, weights: Vector, right: Matrix) -> Matrix:
        # Elimination puts each row of right over one denominator. Where a row holds entries of many
        # stages whose denominators have nothing in common, the inverse is used instead.
        if not any(_has_long_denominators(row) for row in right):
            return solve(self.gram(weights), right)
        return multiply(_inverse_gram(self, weights), right)

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


@lru_cache(maxsize=32)
def _inverse_gram(space: PolynomialSpace, weights: Vector) -> Matrix:
    """G⁻¹ of the weights: all blocks that lead to one colour are conjugated with the same."""
    return solve(space.gram(weights), identity(space.stages))


def _has_long_denominators(row: Vector) -> bool:
    lengths = (int(x.q).bit_length() for x in row if isinstance(x, fmpq))
    return sum(lengths) > MAX_BITS_OF_ROW


def _in_flint(coefficients: Sequence[Number]) -> fmpq_poly:
    return fmpq_poly(cast("list[fmpq]", list(coefficients)))


def _bits(number: Number) -> int:
    if isinstance(number, Algebraic):
        return sum(int(x.height_bits()) for x in number.poly.coeffs())
    return int(number.height_bits())


def _value(coefficients: Sequence[Number], x: Number) -> Number:
    """A polynomial at x, by Horner's scheme."""
    total: Number = ZERO
    for coefficient in reversed(coefficients):
        total = total * x + coefficient
    return total


def _rational_lagrange(nodes: Sequence[fmpq]) -> Iterator[Vector]:
    """L_j = w/(x − c_j) / w'(c_j) for w = ∏ (x − c_k), each with one common denominator.

    Elimination in the Vandermonde matrix would carry the common denominator of all of them.
    """
    x = fmpq_poly([0, 1])
    w = fmpq_poly([1])
    for c in nodes:
        w *= x - c
    for c in nodes:
        others = w // (x - c)
        polynomial = others / others(c)
        yield tuple(polynomial[k] for k in range(len(nodes)))


def _lagrange(nodes: Sequence[Number]) -> Iterator[Vector]:
    """The same in any domain, dividing w by x − c_j with Horner's scheme."""
    w: list[Number] = [ONE]
    for c in nodes:
        shifted = [ZERO, *w]
        w = [a - c * b for a, b in zip(shifted, [*w, ZERO], strict=True)]
    for c in nodes:
        others: list[Number] = []
        carried: Number = ZERO
        for coefficient in reversed(w[1:]):
            carried = carried * c + coefficient
            others.append(carried)
        others.reverse()
        factor = ONE / _value(others, c)
        yield tuple(factor * coefficient for coefficient in others)


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


def antiderivative(coefficients: Sequence[Number]) -> Vector:
    """∫_0^x of a polynomial, lowest coefficient first.

    >>> antiderivative((fmpq(1), fmpq(1)))
    (0, 1, 1/2)
    """
    return (ZERO, *(a * fmpq(1, k) for k, a in enumerate(coefficients, start=1)))


def integration(degree: int) -> Matrix:
    """The map f ↦ ∫_0^x f on polynomials of degree < ``degree``, shape (degree + 1, degree)."""
    return tuple(
        tuple(fmpq(1, i) if i == j + 1 else ZERO for j in range(degree))
        for i in range(degree + 1)
    )
