"""Stage spaces: the algebra in which the stage values of one method live.

Two models of the same thing. ``PointSpace`` is K^s with componentwise multiplication: one number
per stage. ``PolynomialSpace`` is ℚ[x]/(M), M the node polynomial: for the Gauss, Radau and Lobatto
families M is rational although the nodes are not, so no root is needed. Evaluation at the nodes
identifies the two.

A *vector* is a tuple of s coordinates, a *functional* a tuple of s coordinates in the dual basis, a
block a matrix that acts on coordinates.
"""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Iterator, Sequence
from functools import cached_property, lru_cache
from itertools import combinations
from math import prod
from typing import ClassVar, cast

from flint import fmpq, fmpq_poly, fmpz

from garkcli.errors import CoincidingNodes
from garkcli.exact import matrix
from garkcli.exact.field import ONE, ZERO, Algebraic, Number
from garkcli.frozen import Frozen
from garkcli.reason import Formula, Reason


class StageSpace(Frozen):
    """A commutative algebra of dimension ``stages`` over the domain of the coefficients."""

    @property
    @abstractmethod
    def stages(self) -> int:
        """s, the number of stages."""

    @property
    @abstractmethod
    def one(self) -> matrix.Vector:
        """𝟙."""

    @property
    @abstractmethod
    def nodes(self) -> matrix.Vector:
        """The nodes as an element of the algebra."""

    @abstractmethod
    def product(self, u: matrix.Vector, v: matrix.Vector) -> matrix.Vector:
        """The product u ⊙ v."""

    @abstractmethod
    def times(self, functional: matrix.Vector, v: matrix.Vector) -> matrix.Vector:
        """The functional g ↦ functional(v ⊙ g)."""

    @abstractmethod
    def reductions(self, count: int) -> matrix.Matrix:
        """The classes of 1, x, …, x^(count−1) as columns, shape (s, count)."""

    @abstractmethod
    def of_polynomial(self, coefficients: Sequence[Number]) -> matrix.Vector:
        """The class of a polynomial, lowest coefficient first; at points its values."""

    @abstractmethod
    def basis_polynomials(self) -> Iterator[matrix.Vector]:
        """The polynomial of degree < s of each basis vector: at points the Lagrange polynomials.

        Coefficients begin with the lowest. They are made one at a time: together they can be far
        larger than the results. Raises CoincidingNodes if two nodes are equal.
        """

    @abstractmethod
    def lifts(self) -> matrix.Matrix:
        """``basis_polynomials`` as columns, shape (s, s); CoincidingNodes for equal nodes."""

    def power(self, v: matrix.Vector, exponent: int) -> matrix.Vector:
        result = self.one
        for _ in range(exponent):
            result = self.product(result, v)
        return result

    def gram(self, weights: matrix.Vector) -> matrix.Matrix:
        """G with entries weights(e_i ⊙ e_j): the bilinear form of B^{l} in the paper."""
        return tuple(self.times(weights, e) for e in matrix.identity(self.stages))

    @abstractmethod
    def zero_weights(self, weights: matrix.Vector) -> Reason:
        """Says which weights are zero; at least one must be."""

    def form(self, weights: matrix.Vector, block: matrix.Matrix) -> matrix.Matrix:
        """The bilinear form (f, g) ↦ weights(f ⊙ A g), one row for each f."""
        return matrix.multiply(self.gram(weights), block)

    def adjoint(
        self,
        block: matrix.Matrix,
        weights: matrix.Vector,
        source: StageSpace,
        source_weights: matrix.Vector,
    ) -> matrix.Matrix:
        """A* from here to ``source`` with ⟨A f, g⟩ = ⟨f, A* g⟩; A maps ``source`` to here. At
        points this is B_source⁻¹ Aᵀ B_here; SingularMatrixError if a weight of ``source`` is zero.
        """
        return source.divide_by_weights(source_weights, matrix.transpose(self.form(weights, block)))

    @abstractmethod
    def divide_by_weights(self, weights: matrix.Vector, right: matrix.Matrix) -> matrix.Matrix:
        """G⁻¹ ``right``, G the ``gram``: at points B⁻¹ ``right``; raises SingularMatrixError."""


def in_flint(coefficients: Sequence[Number]) -> fmpq_poly:
    return fmpq_poly(cast("list[fmpq]", list(coefficients)))


MAX_BITS_COMPARED = 5_000_000
"""Longer denominators are not compared with each other."""


class PointSpace(StageSpace):
    """K^s: one coordinate per stage, in the order of the file. ``points`` are the nodes."""

    points: matrix.Vector

    @property
    def stages(self) -> int:
        return len(self.points)

    @property
    def one(self) -> matrix.Vector:
        return (ONE,) * self.stages

    @property
    def nodes(self) -> matrix.Vector:
        return self.points

    def product(self, u: matrix.Vector, v: matrix.Vector) -> matrix.Vector:
        return tuple(x * y for x, y in zip(u, v, strict=True))

    def times(self, functional: matrix.Vector, v: matrix.Vector) -> matrix.Vector:
        return self.product(functional, v)

    def reductions(self, count: int) -> matrix.Matrix:
        return tuple(_powers(c, count) for c in self.points)

    def of_polynomial(self, coefficients: Sequence[Number]) -> matrix.Vector:
        if matrix.is_rational((coefficients, self.points)):
            polynomial = in_flint(coefficients)
            return tuple(polynomial(c) for c in cast("tuple[fmpq, ...]", self.points))
        return tuple(_value(coefficients, c) for c in self.points)

    def interpolation_bits(self, enough: int) -> int:
        """The bits of the common denominator of the Lagrange polynomials; or a simple upper bound,
        if that is at most ``enough``, or the denominator is costly.
        """
        bound = sum(_bits(x - y) for x, y in combinations(self.points, 2))
        if bound <= enough or bound > MAX_BITS_COMPARED:
            return bound
        if not matrix.is_rational((self.points,)):
            return bound
        return _common_denominator(cast("tuple[fmpq, ...]", self.points)).bit_length()

    def basis_polynomials(self) -> Iterator[matrix.Vector]:
        first: dict[Number, int] = {}
        for j, c in enumerate(self.points, start=1):
            i = first.setdefault(c, j)
            if i != j:
                message = f"nodes c_{i} and c_{j} are both {c}: no interpolation through them"
                cure = "spell the blocks out, or choose a method with distinct nodes"
                raise CoincidingNodes(message, cure)
        if matrix.is_rational((self.points,)):
            yield from _rational_lagrange(cast("tuple[fmpq, ...]", self.points))
        else:
            yield from _lagrange(self.points)

    def lifts(self) -> matrix.Matrix:
        return self._lifts

    @cached_property
    def _lifts(self) -> matrix.Matrix:
        return matrix.transpose(tuple(self.basis_polynomials()))

    def zero_weights(self, weights: matrix.Vector) -> Reason:
        numbers = [i for i, weight in enumerate(weights, start=1) if not weight]
        shown = numbers[:3] if len(numbers) > 4 else numbers
        end = "0" if shown == numbers else "… = 0"
        text = " = ".join([*(f"b_{i}" for i in shown), end])
        latex = " = ".join([*(f"b_{{{i}}}" for i in shown), end.replace("…", r"\dots")])
        return Reason("{}", Formula(text, latex))

    def form(self, weights: matrix.Vector, block: matrix.Matrix) -> matrix.Matrix:
        return _scaled_rows(weights, block)

    def divide_by_weights(self, weights: matrix.Vector, right: matrix.Matrix) -> matrix.Matrix:
        if not all(weights):
            raise matrix.SingularMatrixError
        # One inverse a row: of irrational weights they take the time.
        return _scaled_rows(tuple(ONE / b for b in weights), right)


OF_OTHERS = (
    "gark check, show, tableau, conditions, converge, diff, report and export know such methods; "
    "gark stability and plot know them but for nonlinearly partitioned ones"
)
"""The cure where a command is for GARK methods only."""


class Flow(PointSpace):
    """Collocation stages in place of the exact solution: up to ``order`` the conditions agree."""

    order: int

    why: ClassVar[str] = "the fast part is solved exactly"
    cure: ClassVar[str] = "write a fast method and steps in place of fast: exact"


class Jets(Flow):
    """Nodes on the exact solution through each stage, ``order`` of them, the first at the stage.
    ``derivatives`` is the number of f_k that the method uses.
    """

    derivatives: int

    why: ClassVar[str] = "derivatives of f are used"
    cure: ClassVar[str] = OF_OTHERS


def _scaled_rows(factors: matrix.Vector, rows: matrix.Matrix) -> matrix.Matrix:
    return tuple(tuple(factor * x for x in row) for factor, row in zip(factors, rows, strict=True))


@lru_cache(maxsize=16)  # blocks both ways, and to many colours, ask again
def _common_denominator(nodes: tuple[fmpq, ...]) -> fmpz:
    """The common divisor of the denominators of the Lagrange polynomials of rational nodes.

    L_i = ∏ (x − c_j) / ∏ (c_i − c_j) over j ≠ i: the least common multiple of the numerators of the
    lower products; the denominators of the nodes are ignored.
    """
    common = fmpz(1)
    for c in nodes:
        common = common.lcm(prod([c - x for x in nodes if x != c], start=ONE).p)
    return common


def _bits(number: Number) -> int:
    if isinstance(number, Algebraic):
        return sum(int(x.height_bits()) for x in number.poly.coeffs())
    # balls and forms are as long as their context makes them
    return int(number.height_bits()) if isinstance(number, fmpq) else 0


def _value(coefficients: Sequence[Number], x: Number) -> Number:
    total: Number = ZERO
    for coefficient in reversed(coefficients):
        total = total * x + coefficient
    return total


def _rational_lagrange(nodes: Sequence[fmpq]) -> Iterator[matrix.Vector]:
    """L_j = w/(x − c_j) / w'(c_j), w = ∏ (x − c_k), each with one denominator: elimination in the
    Vandermonde matrix would carry that of all.
    """
    x = fmpq_poly([0, 1])
    w = fmpq_poly([1])
    for c in nodes:
        w *= x - c
    for c in nodes:
        others = w // (x - c)
        polynomial = others / others(c)
        yield tuple(polynomial[k] for k in range(len(nodes)))


def _lagrange(nodes: Sequence[Number]) -> Iterator[matrix.Vector]:
    """The L_j over any domain, dividing w by x − c_j with Horner's scheme."""
    w: list[Number] = [ONE]
    for c in nodes:
        w = [a - c * b for a, b in zip([ZERO, *w], [*w, ZERO], strict=True)]
    for c in nodes:
        quotients: list[Number] = []
        quotient: Number = ZERO
        for coefficient in reversed(w[1:]):
            quotient = quotient * c + coefficient
            quotients.append(quotient)
        quotients.reverse()
        factor = ONE / _value(quotients, c)
        yield tuple(factor * coefficient for coefficient in quotients)


def _powers(x: Number, count: int) -> matrix.Vector:
    powers: list[Number] = [ONE]
    while len(powers) < count:
        powers.append(powers[-1] * x)
    return tuple(powers[:count])
