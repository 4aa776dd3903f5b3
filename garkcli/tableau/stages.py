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
from typing import cast

from flint import fmpq, fmpq_poly

from garkcli.exact.field import Number
from garkcli.exact.matrix import Matrix, Vector, identity, multiply, transpose
from garkcli.reason import Reason


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
    def zero_weights(self, weights: Vector) -> Reason:
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
        return source.divide_by_weights(source_weights, transpose(self.form(weights, block)))

    @abstractmethod
    def divide_by_weights(self, weights: Vector, right: Matrix) -> Matrix:
        """The matrix X with G X = ``right``, where G is the ``gram`` of the weights.

        At points this is B⁻¹ ``right``.

        Raises:
            SingularMatrixError: one of the weights is zero.
        """


def in_flint(coefficients: Sequence[Number]) -> fmpq_poly:
    """The polynomial of rational ``coefficients``, lowest first, for python-flint."""
    return fmpq_poly(cast("list[fmpq]", list(coefficients)))
