"""Number fields one root at a time: ℚ ⊂ ℚ(θ₁) ⊂ ℚ(θ₂) ⊂ …, each with a primitive element.

To adjoin a root y of yⁿ = a to K = ℚ(θ), look at the algebra K[y]/(yⁿ − a), of dimension n·deg K
over ℚ. Its element η = y + kθ generates it as soon as its characteristic polynomial c is
squarefree, and then θ and y are polynomials in η. If c is irreducible the algebra is the new field
ℚ(η); if not, it is a product of fields, one for each factor of c, and the right one is that whose
factor vanishes at the real number y + kθ. (Cohen, *A Course in Computational Algebraic Number
Theory*, sections 2.1 and 3.6.)
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from itertools import count

from flint import arb, ctx, fmpq, fmpq_mat, fmpq_poly

_X = fmpq_poly([0, 1])


@dataclass(frozen=True)
class Tower:
    """ℚ(θ) with some real numbers in it.

    Attributes:
        modulus: the minimal polynomial of θ; x for ℚ itself, with θ = 0.
        elements: the adjoined numbers, as polynomials in θ.
        combination: θ = Σ combination[i] · elements[i].
    """

    modulus: fmpq_poly
    elements: tuple[fmpq_poly, ...]
    combination: tuple[int, ...]

    @property
    def degree(self) -> int:
        """The dimension over ℚ."""
        return int(self.modulus.degree())

    def adjoin(
        self, index: int, radicand: fmpq_poly, values: Callable[[], list[arb]]
    ) -> Tower:
        """The field with the real root y of y^index = radicand as a further element.

        Args:
            index: n ≥ 2.
            radicand: a as a polynomial in θ; not zero.
            values: enclosures of all elements and of y last, at the current precision of flint.
        """
        multiply_y, multiply_theta = self._multiplications(index, radicand)
        for k in count():
            generator = multiply_y + multiply_theta * k
            characteristic = fmpq_poly(generator.charpoly().coeffs())
            if characteristic.gcd(characteristic.derivative()).degree() == 0:
                break
        combination = (*(k * x for x in self.combination), 1)
        factor = _vanishing_factor(characteristic, combination, values)
        old_theta, y = _as_polynomials(generator, [multiply_theta, multiply_y])
        elements = tuple(f(old_theta) % factor for f in self.elements)
        return Tower(factor, (*elements, y % factor), combination)

    def _multiplications(
        self, index: int, radicand: fmpq_poly
    ) -> tuple[fmpq_mat, fmpq_mat]:
        """The matrices of multiplication by y and by θ, on the basis θ^i y^j, i running first."""
        d, n = self.degree, index
        y, theta = fmpq_mat(d * n, d * n), fmpq_mat(d * n, d * n)
        for i in range(d):
            wrapped = _X**i * radicand % self.modulus
            shifted = _X ** (i + 1) % self.modulus
            for j in range(n):
                if j + 1 < n:
                    y[i + d * (j + 1), i + d * j] = fmpq(1)
                else:
                    for row in range(d):
                        y[row, i + d * j] = wrapped[row]
                for row in range(d):
                    theta[row + d * j, i + d * j] = shifted[row]
        return y, theta


RATIONALS = Tower(_X, (), ())
"""ℚ."""


def _as_polynomials(generator: fmpq_mat, wanted: list[fmpq_mat]) -> list[fmpq_poly]:
    """Elements of an algebra as polynomials in its generator, all given by their multiplication
    matrices.
    """
    size = generator.nrows()
    power = fmpq_mat([[fmpq(int(i == 0))] for i in range(size)])
    columns = []
    for _ in range(size):
        columns.append(power.entries())
        power = generator * power
    ones = [[int(i == 0)] for i in range(size)]
    targets = [(matrix * fmpq_mat(ones)).entries() for matrix in wanted]
    solution = fmpq_mat(columns).transpose().solve(fmpq_mat(targets).transpose())
    return [
        fmpq_poly([solution[i, j] for i in range(size)]) for j in range(len(wanted))
    ]


def _vanishing_factor(
    characteristic: fmpq_poly,
    combination: tuple[int, ...],
    values: Callable[[], list[arb]],
) -> fmpq_poly:
    """The irreducible factor that has the real number Σ combination·values as a root.

    The factors have no common root, so all but one are told from zero by enough digits.
    """
    candidates = [fmpq_poly(factor) for factor, _ in characteristic.factor()[1]]
    precision = ctx.prec
    try:
        while len(candidates) > 1:
            ctx.prec *= 2
            theta = sum(
                (k * x for k, x in zip(combination, values(), strict=True)),
                start=arb(0),
            )
            candidates = [
                factor for factor in candidates if _at(factor, theta).contains(0)
            ]
    finally:
        ctx.prec = precision
    return candidates[0] / candidates[0].leading_coefficient()


def _at(poly: fmpq_poly, x: arb) -> arb:
    total = arb(0)
    for coefficient in reversed(poly.coeffs()):
        total = total * x + arb(coefficient)
    return total
