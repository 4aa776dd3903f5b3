"""Embedded weights, polynomials of dense output, and weights that predict stages.

They belong to the stages of the method and share stage vectors; with them as b the method is a
tableau of its own, with the same blocks.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import TypeAlias

from garkcli.errors import ShapeMismatch
from garkcli.exact.field import ZERO, Number
from garkcli.exact.matrix import Matrix, Vector
from garkcli.frozen import Frozen, replace
from garkcli.tableau.stages import PointSpace
from garkcli.tableau.tableau import Tableau

Weights: TypeAlias = tuple[Vector, ...]


class DenseOutput(Frozen):
    """Weights that are polynomials: x(t + θh) ≈ x + h Σ b_i(θ) k_i, summed over the colours too.

    Attributes:
        weights: ``weights[l][i]`` are the coefficients of θ, θ², … in b_i(θ) of colour l, all of
            one length. There is no constant coefficient: at θ = 0 the output is x.
    """

    weights: tuple[tuple[Vector, ...], ...]

    @property
    def degree(self) -> int:
        """The largest power of θ with a coefficient, which may be zero."""
        return len(self.weights[0][0])

    def coefficients(self, power: int) -> Weights:
        """The coefficients of a power ≥ 1 of θ, for each colour."""

        def rows(of_colour: Sequence[Vector]) -> Vector:
            return tuple(row[power - 1] for row in of_colour)

        return tuple(map(rows, self.weights))

    def at(self, theta: Number) -> Weights:
        """The weights at one θ, for each colour."""

        def rows(of_colour: Sequence[Vector]) -> Vector:
            return tuple(_value(row, theta) for row in of_colour)

        return tuple(map(rows, self.weights))


class Predictor(Frozen):
    """Weights that predict the stages of a step: Y_i ≈ y + h Σ_j p_ij(r) k_j + h Σ_j q_ij(r) K_j,
    with the slopes k_j of the last step, those K_j of the stages of this step that are solved
    before, and the ratio r of this step size h to the last.

    Attributes:
        old: the matrices of 1, r, r², … in p, each of shape (s, s).
        new: those in q, equally many.
    """

    old: tuple[Matrix, ...]
    new: tuple[Matrix, ...]

    @property
    def degree(self) -> int:
        return len(self.old) - 1

    @property
    def parts(self) -> Iterator[tuple[str, tuple[Matrix, ...]]]:
        """``old`` and ``new`` with their matrices, unless all are zero."""
        for name, matrices in (("old", self.old), ("new", self.new)):
            if any(x for matrix in matrices for row in matrix for x in row):
                yield name, matrices

    def at(self, ratio: Number) -> tuple[Matrix, Matrix]:
        return _matrix_at(self.old, ratio), _matrix_at(self.new, ratio)

    def changed(self, change: Callable[[Matrix], Matrix]) -> Predictor:
        return Predictor(tuple(map(change, self.old)), tuple(map(change, self.new)))


class Further(Frozen):
    """Further weights of a method, None if it has none; a ``predictor`` is for one colour."""

    embedded: Weights | None = None
    dense: DenseOutput | None = None
    predictor: Predictor | None = None

    @property
    def kinds(self) -> tuple[str, ...]:
        named = {
            "embedded weights": self.embedded,
            "dense output": self.dense,
            "predictor": self.predictor,
        }
        return tuple(name for name, weights in named.items() if weights is not None)

    def __bool__(self) -> bool:
        return bool(self.kinds)

    @property
    def powers(self) -> tuple[Weights, ...]:
        if self.dense is None:
            return ()
        return tuple(self.dense.coefficients(power) for power in range(1, self.dense.degree + 1))

    @property
    def rows(self) -> tuple[Weights, ...]:
        """All rows of weights: the embedded ones, then those of the powers of θ."""
        return self.powers if self.embedded is None else (self.embedded, *self.powers)

    def changed(self, change: Callable[[Number], Number]) -> Further:
        def row(numbers: Vector) -> Vector:
            return tuple(map(change, numbers))

        def rows(weights: Weights) -> Weights:
            return tuple(map(row, weights))

        embedded, dense, predictor = self.embedded, self.dense, self.predictor
        if embedded is not None:
            embedded = rows(embedded)
        if dense is not None:
            dense = DenseOutput(tuple(map(rows, dense.weights)))
        if predictor is not None:
            predictor = predictor.changed(rows)
        return Further(embedded, dense, predictor)


NOTHING = Further()


def _value(coefficients: Vector, theta: Number) -> Number:
    """θ times the polynomial with these coefficients, by Horner's rule."""
    value: Number = ZERO
    for coefficient in reversed(coefficients):
        value = (value + coefficient) * theta
    return value


def _matrix_at(powers: Sequence[Matrix], ratio: Number) -> Matrix:
    """Σ_k M_k r^k, entry by entry."""

    def entry(coefficients: Vector) -> Number:
        value: Number = ZERO
        for coefficient in reversed(coefficients):
            value = value * ratio + coefficient
        return value

    rows = zip(*powers, strict=True)
    return tuple(tuple(map(entry, zip(*row, strict=True))) for row in rows)


def padded(rows: Sequence[Vector], degree: int) -> tuple[Vector, ...]:
    longer = []
    for row in rows:
        zeros = [ZERO] * (degree - len(row))
        longer.append((*row, *zeros))
    return tuple(longer)


def with_weights(tableau: Tableau, weights: Weights) -> Tableau:
    """The tableau with other weights at the same stages.

    Raises ShapeMismatch without one weight per stage and one row per colour, or if the stages are
    those of a family in its algebra.

    >>> from flint import fmpq
    >>> from garkcli.order.certificate import find_order
    >>> from garkcli.tableau.forms import gark
    >>> from garkcli.tableau.tableau import butcher
    >>> half, one, zero = fmpq(1, 2), fmpq(1), fmpq(0)
    >>> heun = gark([butcher(((zero, zero), (one, zero)), (half, half))], {})
    >>> euler = with_weights(heun, ((one, zero),))
    >>> find_order(heun).order, find_order(euler).order
    (2, 1)
    """
    if not all(isinstance(space, PointSpace) for space in tableau.spaces):
        message = "the weights are those of single stages, "
        message += "and a family is kept in the algebra of its nodes"
        raise ShapeMismatch(message, "spell the method out")
    colours = [replace(colour, b=row) for colour, row in zip(tableau.colours, weights, strict=True)]
    return replace(tableau, colours=tuple(colours))


def as_colours(tableau: Tableau, further: Further) -> Tableau:
    """Returns the tableau with a colour for each row of further weights, which no stage sees. So
    operations on stages, such as merging equal ones, also apply to these rows.
    """
    if not further.rows:
        return tableau
    colours = list(tableau.colours)
    for weights in further.rows:
        for colour, row in zip(tableau.colours, weights, strict=True):
            colours.append(replace(colour, b=row))
    return replace(tableau, colours=tuple(colours))


def from_colours(tableau: Tableau, further: Further) -> tuple[Tableau, Further]:
    """Inverts ``as_colours``, without the predictor, which belongs to the original stages."""
    if not further.rows:
        return tableau, replace(further, predictor=None)
    size = tableau.size // (len(further.rows) + 1)
    rows = [
        tuple(colour.b for colour in tableau.colours[start : start + size])
        for start in range(size, tableau.size, size)
    ]
    embedded, dense = None, None
    if further.embedded is not None:
        embedded = rows.pop(0)
    if further.dense is not None:
        # from a row per power of θ to a row per stage
        blocks = [tuple(zip(*of_colour, strict=True)) for of_colour in zip(*rows, strict=True)]
        dense = DenseOutput(tuple(blocks))
    return replace(tableau, colours=tableau.colours[:size]), Further(embedded, dense)
