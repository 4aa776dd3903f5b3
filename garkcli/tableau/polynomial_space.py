"""The stage space ℚ[x]/(M) of a family whose node polynomial M is rational.

Nodes with simple radicals are written out; otherwise Vandermonde matrices in balls map coordinates
to values at the nodes, and back.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import cached_property, lru_cache
from typing import Any

from flint import arb, arb_mat, ctx, fmpq, fmpq_mat, fmpq_poly

from garkcli.exact import matrix
from garkcli.exact.domain import square_free
from garkcli.exact.enclosing import enclose
from garkcli.exact.field import ONE, ZERO, Number
from garkcli.exact.nodes import Chain, Expression, Literal, Root
from garkcli.reason import Formula, Reason
from garkcli.tableau.stages import StageSpace, in_flint

MAX_BITS_OF_ROW = 20_000
"""Largest size of the denominators of a row that elimination may multiply with each other."""
MAX_MOMENTS = 8


class PolynomialSpace(StageSpace):
    """ℚ[x]/(M) with the basis 1, x, …, x^(s−1); M is monic with distinct real roots."""

    modulus: fmpq_poly

    def __hash__(self) -> int:
        # of integers: flint hashes fractions by Python's, a slow import
        return hash((tuple(self.modulus.numer()), self.modulus.denom()))

    @property
    def stages(self) -> int:
        return int(self.modulus.degree())

    @property
    def one(self) -> matrix.Vector:
        return self._vector(fmpq_poly([1]))

    @property
    def nodes(self) -> matrix.Vector:
        return self._vector(fmpq_poly([0, 1]) % self.modulus)

    def _vector(self, poly: fmpq_poly) -> matrix.Vector:
        return tuple(poly[k] for k in range(self.stages))

    def product(self, u: matrix.Vector, v: matrix.Vector) -> matrix.Vector:
        if matrix.is_rational((u, v)):
            f, g = in_flint(u), in_flint(v)
            return self._vector(f * g % self.modulus)
        return matrix.apply(self._higher, convolution(u, v))

    @cached_property
    def _higher(self) -> matrix.Matrix:
        return self.reductions(2 * self.stages - 1)

    @cached_property
    def _higher_in_flint(self) -> fmpq_mat:
        return matrix.to_flint(self._higher, 2 * self.stages - 1)

    def times(self, functional: matrix.Vector, v: matrix.Vector) -> matrix.Vector:
        s = self.stages
        moments = self._moments(functional)
        if matrix.is_rational((moments, v)):
            # Σ_i v_i m_{i+j} are coefficients of the product with v turned round.
            product = in_flint(v[::-1]) * in_flint(moments)
            return tuple(product[s - 1 + j] for j in range(s))
        return tuple(matrix.dot(v, moments[j : j + s]) for j in range(s))

    def gram(self, weights: matrix.Vector) -> matrix.Matrix:
        s = self.stages
        moments = self._moments(weights)
        return tuple(moments[i : i + s] for i in range(s))

    def _moments(self, functional: matrix.Vector) -> matrix.Vector:
        """The functional on 1, x, …, x^(2s−2), cached, as weights are requested again."""
        known = self._known_moments
        # compared, not hashed: flint hashes fractions by Python's, which takes longer
        for kept, moments in known:
            if kept == functional:
                return moments
        if len(known) >= MAX_MOMENTS:
            known.clear()
        moments = self._new_moments(functional)
        known.append((functional, moments))
        return moments

    @cached_property
    def _known_moments(self) -> list[tuple[matrix.Vector, matrix.Vector]]:
        return []

    def _new_moments(self, functional: matrix.Vector) -> matrix.Vector:
        if matrix.is_rational((functional,)):
            return tuple(
                (matrix.to_flint((functional,), self.stages) * self._higher_in_flint).entries()
            )
        return matrix.apply_left(functional, self._higher)

    def reductions(self, count: int) -> matrix.Matrix:
        x = fmpq_poly([0, 1])
        power = fmpq_poly([1]) % self.modulus
        columns = []
        for _ in range(count):
            columns.append(self._vector(power))
            power = x * power % self.modulus
        return matrix.transpose(tuple(columns))

    def of_polynomial(self, coefficients: Sequence[Number]) -> matrix.Vector:
        if matrix.is_rational((coefficients,)):
            return self._vector(in_flint(coefficients) % self.modulus)
        return matrix.apply(self.reductions(len(coefficients)), coefficients)

    def basis_polynomials(self) -> Iterator[matrix.Vector]:
        yield from matrix.identity(self.stages)

    def lifts(self) -> matrix.Matrix:
        return matrix.identity(self.stages)

    def divide_by_weights(self, weights: matrix.Vector, right: matrix.Matrix) -> matrix.Matrix:
        # Elimination puts each row of right over one denominator. Where a row holds entries of many
        # stages whose denominators have nothing in common, the inverse is used instead.
        if not any(_has_long_denominators(row) for row in right):
            return matrix.solve(self.gram(weights), right)
        return matrix.multiply(_inverse_gram(self, weights), right)

    def zero_weights(self, weights: matrix.Vector) -> Reason:
        if not matrix.is_rational((weights,)):
            return Reason("one of which is 0")
        nodes = self.modulus // self._nodes_with_weight(weights)
        if nodes.degree() == 1:
            return Reason("which is 0 at the node {}", Formula(str(-nodes[0])))
        return Reason("which are 0 at the nodes where {} = 0", Formula(str(nodes)))

    def _nodes_with_weight(self, weights: matrix.Vector) -> fmpq_poly:
        """The monic polynomial whose roots are the nodes with nonzero weight."""
        gram = self.gram(weights)
        degree = matrix.to_flint(gram, self.stages).rank()
        rows = gram[:degree]
        square = matrix.to_flint([row[:degree] for row in rows], degree)
        last = [(-row[degree],) for row in rows]
        lower = square.solve(matrix.to_flint(last, 1)).entries()
        return fmpq_poly([*lower, fmpq(1)])


@lru_cache(maxsize=32)
def _inverse_gram(space: PolynomialSpace, weights: matrix.Vector) -> matrix.Matrix:
    """G⁻¹ of the weights, which the conjugation of all blocks to one colour needs."""
    return matrix.solve(space.gram(weights), matrix.identity(space.stages))


def _has_long_denominators(row: matrix.Vector) -> bool:
    return sum(int(x.q).bit_length() for x in row if isinstance(x, fmpq)) > MAX_BITS_OF_ROW


def convolution(u: Sequence[Number], v: Sequence[Number]) -> matrix.Vector:
    """The product of two polynomials, lowest coefficients first."""
    out: list[Number] = [ZERO] * (len(u) + len(v) - 1)
    for i, x in enumerate(u):
        for j, y in enumerate(v):
            if x and y:
                out[i + j] = out[i + j] + x * y
    return tuple(out)


def integral(moments: int) -> matrix.Vector:
    """∫_0^1 on 1, x, …, x^(moments−1)."""
    return tuple(fmpq(1, k) for k in range(1, moments + 1))


def antiderivative(coefficients: Sequence[Number]) -> matrix.Vector:
    """∫_0^x of a polynomial, lowest coefficient first.

    >>> antiderivative((fmpq(1), fmpq(1)))
    (0, 1, 1/2)
    """
    integrated: list[Number] = [ZERO]
    for k, a in enumerate(coefficients, start=1):
        integrated.append(a * fmpq(1, k))
    return tuple(integrated)


def integration(degree: int) -> matrix.Matrix:
    """Returns the map f ↦ ∫_0^x f for degrees < ``degree``, shape (degree + 1, degree)."""
    columns = [
        antiderivative((ZERO,) * j + (ONE,)) + (ZERO,) * (degree - 1 - j) for j in range(degree)
    ]
    return matrix.transpose(tuple(columns))


def simple_nodes(space: PolynomialSpace) -> tuple[Expression, ...] | None:
    """Returns ascending nodes with at most one square root each; None if they need more."""
    nodes: list[Expression] = []
    _, factors = space.modulus.factor()
    for factor, _ in factors:
        if factor.degree() > 2:
            return None
        nodes += _roots(fmpq_poly(factor))
    return tuple(sorted(nodes, key=lambda node: float(enclose(node))))


def _roots(factor: fmpq_poly) -> list[Expression]:
    """Returns the root of a linear factor, or m ± r√d with rational m, r, d of a quadratic one."""
    if factor.degree() == 1:
        return [Literal(-factor[0] / factor[1])]
    constant, linear, leading = factor.coeffs()
    middle = -linear / (2 * leading)
    radicand = middle * middle - constant / leading
    d = square_free(radicand)
    scale = Literal((radicand / d).sqrt())
    operands = (Literal(middle), Chain("**", (scale, Root(Literal(d), 2))))
    return [Chain("+-", operands), Chain("++", operands)]


_BITS_OF_A_STAGE = 16


def powers_of_nodes(space: PolynomialSpace) -> arb_mat:
    """The Vandermonde matrix of the nodes in ascending order."""
    return _powers_of_nodes(space, ctx.prec)


def coordinates_at_nodes(space: PolynomialSpace) -> arb_mat:
    """Returns the inverse Vandermonde matrix, which maps values at the nodes to coordinates. Raises
    ZeroDivisionError if the precision is too low.
    """
    inverse = _coordinates_at_nodes(space, ctx.prec)
    if inverse is None:
        raise ZeroDivisionError
    return inverse


@lru_cache(maxsize=32)
def _powers_of_nodes(space: PolynomialSpace, bits: int) -> arb_mat:
    # isolating the roots takes long, and hardly longer with the bits that the inverse needs
    nodes = _nodes(space, max(bits, _BITS_OF_A_STAGE * space.stages))
    exponents = range(space.stages)
    return arb_mat([[node**k for k in exponents] for node in nodes])


@lru_cache(maxsize=32)
def _nodes(space: PolynomialSpace, bits: int) -> list[arb]:
    with ctx.workprec(bits):
        roots: list[tuple[Any, int]] = space.modulus.numer().complex_roots()  # type: ignore[assignment]
        return sorted((root.real for root, _ in roots), key=float)


@lru_cache(maxsize=32)
def _coordinates_at_nodes(space: PolynomialSpace, bits: int) -> arb_mat | None:
    try:
        return _powers_of_nodes(space, bits).inv()
    except ZeroDivisionError:
        return None
