"""Number fields one root at a time: ℚ ⊂ ℚ(θ₁) ⊂ ℚ(θ₂) ⊂ …, each with a primitive element.

To adjoin a root y of a polynomial f over K = ℚ(θ), such as yⁿ − a, look at the algebra K[y]/(f), of
dimension n·deg K over ℚ. Its element η = y + kθ generates it as soon as its characteristic
polynomial c is squarefree, and then θ and y are polynomials in η. If c is irreducible the algebra
is the new field ℚ(η); if not, it is a product of fields, one for each factor of c, and the right
factor vanishes at the real number y + kθ. (Cohen, *A Course in Computational Algebraic Number
Theory*, sections 2.1 and 3.6.)
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from itertools import count

from flint import arb, ctx, fmpq, fmpq_mat, fmpq_poly

from garkcli.deadline import check_time
from garkcli.exact.enclosing import value
from garkcli.frozen import Frozen

_X = fmpq_poly([0, 1])


class Tower(Frozen):
    """A field ℚ(θ) with the real numbers adjoined so far; θ = Σ combination[i] · elements[i].
    ``modulus`` is the minimal polynomial of θ, x for ℚ; ``elements`` are polynomials in θ.
    """

    modulus: fmpq_poly
    elements: tuple[fmpq_poly, ...]
    combination: tuple[int, ...]

    @property
    def degree(self) -> int:
        return int(self.modulus.degree())

    def adjoin(self, relation: Sequence[fmpq_poly], values: Callable[[], list[arb]]) -> Tower:
        """The field with a real root y of yⁿ = r_0 + r_1 y + … adjoined, n ≥ 2, no double root.
        ``relation`` has the r_j as polynomials in θ; ``values`` encloses all elements, then y, at
        the precision of ``flint.ctx``.
        """
        multiply_y, multiply_theta = self._multiplications(relation)
        for k in count():
            check_time()
            generator = multiply_y + multiply_theta * k
            characteristic = fmpq_poly(generator.charpoly().coeffs())
            if characteristic.gcd(characteristic.derivative()).degree() == 0:
                break
        combination = (*[k * x for x in self.combination], 1)
        factor = _vanishing_factor(characteristic, combination, values)
        old_theta, y = _as_polynomials(generator, [multiply_theta, multiply_y])
        elements = tuple(f(old_theta) % factor for f in self.elements)
        return Tower(factor, (*elements, y % factor), combination)

    def _multiplications(self, relation: Sequence[fmpq_poly]) -> tuple[fmpq_mat, fmpq_mat]:
        """The matrices of multiplication by y and by θ, on the basis θ^i y^j, i running first."""
        d = self.degree
        n = len(relation)
        size = d * n
        y = fmpq_mat(size, size)
        theta = fmpq_mat(size, size)
        for i in range(d):
            raised = _X ** (i + 1) % self.modulus  # θ · θ^i
            for j in range(n):
                # y · θ^i y^(n−1) = Σ θ^i r_j y^j
                wrapped = _X**i * relation[j] % self.modulus
                for row in range(d):
                    y[row + d * j, i + d * (n - 1)] = wrapped[row]
                column = i + d * j
                for row in range(d):
                    theta[row + d * j, column] = raised[row]
                if j + 1 < n:
                    y[column + d, column] = fmpq(1)
        return y, theta


RATIONALS = Tower(_X, (), ())


def _as_polynomials(generator: fmpq_mat, wanted: list[fmpq_mat]) -> list[fmpq_poly]:
    """Elements, as multiplication matrices, in powers of the generator."""
    size = generator.nrows()
    one = fmpq_mat(size, 1)
    one[0, 0] = fmpq(1)
    power = one
    powers = []
    for _ in range(size):
        powers.append(power.entries())
        power = generator * power
    targets = [(matrix * one).entries() for matrix in wanted]
    solution = fmpq_mat(powers).transpose().solve(fmpq_mat(targets).transpose())
    return [fmpq_poly(row) for row in solution.transpose().tolist()]


def _vanishing_factor(
    characteristic: fmpq_poly, combination: tuple[int, ...], values: Callable[[], list[arb]]
) -> fmpq_poly:
    """Returns the factor that vanishes at Σ combination·values. Factors have no common root, so
    enough digits exclude all except one.
    """
    _, factors = characteristic.factor()
    candidates = [fmpq_poly(factor) for factor, _ in factors]
    with ctx.workprec(ctx.prec):
        while len(candidates) > 1:
            ctx.prec *= 2
            theta = arb(0)
            for k, x in zip(combination, values(), strict=True):
                theta += k * x
            candidates = [f for f in candidates if value(f.coeffs(), theta).contains(0)]
    [factor] = candidates
    return factor / factor.leading_coefficient()
