"""Affine forms: numbers that depend on others which are known within radii.

A form is c + Σ_k g_k ε_k + ρ with |ε_k| ≤ 1 and |ρ| ≤ r: ε_k is the error of the k-th printed
number in units of its radius, c a ball of many bits, the slopes g_k floats; r bounds their rounding
and all terms of second order. A form encloses a result for all numbers within their radii, and
a − a is 0. Every operation adds a few units in the last place of the sizes that take part, and the
radius of a ball of which the middle is used, so the bounds hold however floats are rounded.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, TypeAlias

from flint import arb, arb_mat, fmpq

from garkcli import numpy_on_use as np
from garkcli.exact.display import digits_here, to_ball, to_float
from garkcli.exact.enclosing import scalar_product
from garkcli.exact.field import Algebraic

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping, Sequence

    from numpy.typing import NDArray

    Floats: TypeAlias = NDArray[np.float64]

UNIT = 2.0**-50
"""Eight units in the last place of a float: more than the rounding of a few operations."""
LEAST = 1e-300
"""Added to remainders, as products of smaller numbers may underflow."""


def size(ball: arb) -> float:
    """An upper bound of |x| over all numbers x in a ball."""
    return float(ball.abs_upper()) * (1 + UNIT)


def lost(ball: arb) -> float:
    """An upper bound of the distance between a number in a ball and the float of its centre."""
    return float(ball.rad()) * (1 + UNIT) + UNIT * size(ball)


class Affine:
    """A number c + Σ g_k ε_k + ρ; a form is never false, and equal to itself alone."""

    __slots__ = ("centre", "remainder", "slopes")

    def __init__(self, centre: arb, slopes: Mapping[int, float], remainder: float = 0.0) -> None:
        self.centre = centre
        self.slopes = slopes
        self.remainder = remainder

    @property
    def reach(self) -> float:
        """An upper bound of the distance from the centre."""
        return (sum(map(abs, self.slopes.values())) + self.remainder) * (
            1 + len(self.slopes) * UNIT
        )

    @property
    def ball(self) -> arb:
        return self.centre + arb(0, self.reach * (1 + UNIT))

    def _combined(self, factor: float, other: Affine, factor_of_other: float) -> dict[int, float]:
        slopes = {k: factor * g for k, g in self.slopes.items()}
        for k, g in other.slopes.items():
            slopes[k] = slopes.get(k, 0.0) + factor_of_other * g
        return slopes

    def height_bits(self) -> int:
        """0, as the form does not get longer with the numbers that it comes from."""
        return 0

    def __add__(self, other: Any) -> Affine:
        if not isinstance(other, Affine):
            return Affine(self.centre + constant(other), self.slopes, self.remainder)
        slopes = self._combined(1.0, other, 1.0)
        lost = UNIT * sum(map(abs, slopes.values()))
        return Affine(self.centre + other.centre, slopes, self.remainder + other.remainder + lost)

    __radd__ = __add__

    def __neg__(self) -> Affine:
        return Affine(-self.centre, {k: -g for k, g in self.slopes.items()}, self.remainder)

    def __sub__(self, other: Any) -> Affine:
        return self.__add__(-other)

    def __rsub__(self, other: Any) -> Affine:
        return (-self).__add__(other)

    def __mul__(self, other: Any) -> Any:
        if not isinstance(other, Affine):
            if not other:
                return fmpq(0)
            factor = constant(other)
            x = float(factor)
            slopes = {k: x * g for k, g in self.slopes.items()}
            rest = size(factor) * self.remainder * (1 + UNIT) + lost(factor) * self.reach + LEAST
            return Affine(self.centre * factor, slopes, rest * (1 + UNIT))
        x, y = float(self.centre), float(other.centre)
        rest = self.reach * other.reach
        rest += size(self.centre) * other.remainder + lost(self.centre) * other.reach
        rest += size(other.centre) * self.remainder + lost(other.centre) * self.reach
        slopes = self._combined(y, other, x)
        return Affine(self.centre * other.centre, slopes, rest * (1 + UNIT) + LEAST)

    __rmul__ = __mul__

    def inverse(self) -> Affine:
        """1/x = 1/c − (x − c)/c² + (x − c)²/(c² x); unbounded if x may be 0."""
        reach = self.reach
        nearest = float(self.centre.abs_lower()) * (1 - UNIT)
        if nearest <= reach * (1 + UNIT):
            return Affine(arb("nan"), self.slopes, float("inf"))
        factor = -1 / (self.centre * self.centre)
        x = float(factor)
        rest = size(factor) * (self.remainder + reach * reach / (nearest - reach))
        rest += lost(factor) * reach
        slopes = {k: x * g for k, g in self.slopes.items()}
        return Affine(1 / self.centre, slopes, rest * (1 + 8 * UNIT) + LEAST)

    def root(self, index: int) -> Affine:
        """The real root of a form by Taylor's theorem; unbounded if it may not be real."""
        if index % 2 and self.centre < 0:
            return -((-self).root(index))
        reach = self.reach
        nearest = float(self.centre.abs_lower()) * (1 - UNIT)
        if nearest <= reach * (1 + UNIT) or not self.centre > 0:
            return Affine(arb("nan"), self.slopes, float("inf"))
        root, low = self.centre.root(index), arb((nearest - reach) * (1 - UNIT))
        factor = root / (index * self.centre)
        bend = low.root(index) / (low * low) * (index - 1) / (2 * index * index)
        x = float(factor)
        rest = size(factor) * self.remainder + lost(factor) * reach + size(bend) * reach * reach
        slopes = {k: x * g for k, g in self.slopes.items()}
        return Affine(root, slopes, rest * (1 + 8 * UNIT) + LEAST)

    def __truediv__(self, other: Any) -> Any:
        return self * (other.inverse() if isinstance(other, Affine) else fmpq(1) / other)

    def __rtruediv__(self, other: Any) -> Any:
        return self.inverse() * other

    def __pow__(self, exponent: int) -> Any:
        base = self if exponent >= 0 else self.inverse()
        result: Any = fmpq(1)
        for _ in range(abs(exponent)):
            result = base * result
        return result


def constant(number: Any) -> arb:
    if isinstance(number, Algebraic):
        return to_ball(number, digits_here())
    return arb(number)


class Forms:
    """A row of forms over the same K printed numbers; ``slopes`` has the shape (forms, K)."""

    __slots__ = ("_middle", "_radii", "_reach", "centres", "remainders", "slopes")

    def __init__(self, centres: Sequence[arb], slopes: Floats, remainders: Floats) -> None:
        self.centres = centres
        self.slopes = slopes
        self.remainders = remainders
        self._middle: Floats | None = None
        self._radii: Floats | None = None
        self._reach: Floats | None = None

    @staticmethod
    def of(row: Iterable[Any], numbers: int) -> Forms:
        row = list(row)
        slopes, remainders = np.zeros((len(row), numbers)), np.zeros(len(row))
        centres = []
        for i, x in enumerate(row):
            if isinstance(x, Affine):
                centres.append(x.centre)
                for k, g in x.slopes.items():
                    slopes[i, k] = g
                remainders[i] = x.remainder
            else:
                centres.append(constant(x))
        return Forms(centres, slopes, remainders)

    @property
    def are_numbers(self) -> bool:
        return not self.slopes.shape[1]

    @property
    def middle(self) -> Floats:
        if self._middle is None:
            self._middle = np.array([float(x) for x in self.centres])
        return self._middle

    @property
    def radii(self) -> Floats:
        """Upper bounds of the distances between the numbers in the centres and their floats."""
        if self._radii is None:
            self._radii = np.array([float(x.rad()) for x in self.centres]) * (1 + UNIT)
        return self._radii

    @property
    def sizes(self) -> Floats:
        """Upper bounds of the absolute values in the centres."""
        return np.abs(self.middle) * (1 + UNIT) + self.radii

    @property
    def reach(self) -> Floats:
        """Upper bounds of Σ |g_k|, form by form, without the remainder."""
        if self._reach is None:
            count = self.slopes.shape[1]
            self._reach = np.abs(self.slopes).sum(axis=1) * (1 + (count + 8) * UNIT)
        return self._reach

    def __len__(self) -> int:
        return len(self.centres)

    def __mul__(self, other: Forms) -> Forms:
        centres = [x * y for x, y in zip(self.centres, other.centres, strict=True)]
        if self.are_numbers:
            return Forms(centres, self.slopes, self.remainders)
        x, y = self.middle, other.middle
        slopes = x[:, None] * other.slopes + y[:, None] * self.slopes
        x, y = self.sizes, other.sizes
        rest = x * other.remainders + (self.radii + UNIT * x) * other.reach
        rest += y * self.remainders + (other.radii + UNIT * y) * self.reach
        rest += (self.reach + self.remainders) * (other.reach + other.remainders)
        return Forms(centres, slopes, rest * (1 + 8 * UNIT) + LEAST)

    def scaled(self, factor: fmpq) -> Forms:
        ball, x = arb(factor), to_float(factor)
        rest = abs(x) * (self.remainders + UNIT * self.reach)
        centres = [ball * c for c in self.centres]
        if self.are_numbers:
            return Forms(centres, self.slopes, self.remainders)
        return Forms(centres, x * self.slopes, rest * (1 + UNIT) + LEAST)

    def minus(self, other: Forms, share: fmpq) -> Forms:
        ball, factor = arb(share), to_float(share)
        centres = [x - ball * y for x, y in zip(self.centres, other.centres, strict=True)]
        if self.are_numbers:
            return Forms(centres, self.slopes, self.remainders)
        rest = self.remainders + abs(factor) * other.remainders
        rest += UNIT * (self.reach + abs(factor) * other.reach)
        slopes = self.slopes - factor * other.slopes
        return Forms(centres, slopes, rest * (1 + 8 * UNIT) + LEAST)

    def dot(self, other: Forms) -> Forms:
        centre = scalar_product(self.centres, other.centres)
        if self.are_numbers:
            return Forms([centre], self.slopes[:1], self.remainders[:1])
        slopes = (self.middle @ other.slopes + other.middle @ self.slopes)[None, :]
        x, y = self.sizes, other.sizes
        unit = UNIT * (len(self) + 8)
        rest = x @ other.remainders + (self.radii + unit * x) @ other.reach
        rest += y @ self.remainders + (other.radii + unit * y) @ self.reach
        rest += (self.reach + self.remainders) @ (other.reach + other.remainders)
        return Forms([centre], slopes, np.array([rest * (1 + unit) + LEAST]))


class FormMatrix:
    """A matrix of forms with few slopes, kept as a sparse list of them; ``numbers`` is K."""

    def __init__(self, rows: Sequence[Sequence[Any]], numbers: int) -> None:
        height, width = len(rows), len(rows[0])
        self.numbers = numbers
        self.centres = arb_mat(height, width)
        self.remainders = np.zeros((height, width))
        self.reach = np.zeros((height, width))
        places: list[tuple[int, int, int]] = []
        slopes: list[float] = []
        for i, row in enumerate(rows):
            for j, x in enumerate(row):
                if isinstance(x, Affine):
                    self.centres[i, j] = x.centre
                    self.remainders[i, j] = x.remainder
                    self.reach[i, j] = x.reach
                    places += [(i, j, k) for k in x.slopes]
                    slopes += x.slopes.values()
                elif x:
                    self.centres[i, j] = constant(x)
        self.middle = np.zeros((height, width))
        if not numbers:
            return
        self._places = np.array(places, int).reshape(-1, 3).T
        self._slopes = np.array(slopes)
        rows = self.centres.tolist()
        self.middle = np.array([[float(x) for x in row] for row in rows])
        self.radii = np.array([[float(x.rad()) for x in row] for row in rows]) * (1 + UNIT)

    def times(self, v: Forms) -> Forms:
        """A v."""
        return self._times(v, self.centres, 0)

    def before(self, w: Forms) -> Forms:
        """wᵀ A."""
        return self._times(w, self.centres.transpose(), 1)

    def row(self, i: int) -> Forms:
        return self._part(0, i, self.centres.tolist()[i], self.remainders[i])

    def column(self, j: int) -> Forms:
        return self._part(1, j, self.centres.transpose().tolist()[j], self.remainders[:, j])

    def _part(self, axis: int, number: int, centres: list[arb], remainders: Floats) -> Forms:
        slopes = np.zeros((len(centres), self.numbers))
        if not self.numbers:
            return Forms(centres, slopes, remainders)
        here = self._places[axis] == number
        slopes[self._places[1 - axis][here], self._places[2][here]] = self._slopes[here]
        return Forms(centres, slopes, remainders.copy())

    def _times(self, v: Forms, centres: arb_mat, axis: int) -> Forms:
        image = (centres * arb_mat([[x] for x in v.centres])).entries()
        if v.are_numbers:
            return Forms(image, np.zeros((len(image), 0)), np.zeros(len(image)))
        parts = self.middle, self.radii, self.reach, self.remainders
        middle, radii, reach, rest = (x.T for x in parts) if axis else parts
        slopes = middle @ v.slopes
        to, of = self._places[axis], self._places[1 - axis]
        where = to * self.numbers + self._places[2]
        weights = self._slopes * v.middle[of]
        slopes += np.bincount(where, weights, slopes.size).reshape(slopes.shape)
        unit = UNIT * (len(v) + 8)
        sizes = np.abs(middle) * (1 + UNIT) + radii
        remainders = sizes @ v.remainders + (radii + unit * sizes) @ v.reach
        remainders += reach @ (v.reach + v.remainders + v.radii) + (rest + unit * reach) @ v.sizes
        return Forms(image, slopes, remainders * (1 + unit) + LEAST)
