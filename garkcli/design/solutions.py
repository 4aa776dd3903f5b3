"""The solutions of a zero-dimensional system, as elements of number fields.

In the algebra ℚ[t]/I a linear form u that separates the solutions has a characteristic polynomial
with a root for each solution, with its multiplicity. With its square-free part f of degree n every
unknown is a rational function of u at the solutions (F. Rouillier, *Solving zero-dimensional
systems through the rational univariate representation*, 1999):

    v = g_v(u) / g_1(u),   g_v(T) = Σ_{i<n} Tr(v uⁱ) H_{n−i−1}(T),   H_j(T) = Σ_{k≤j} f_k T^{j−k},

f = Σ f_k T^{n−k}. The number of solutions is the rank of the form (v, w) ↦ Tr(v w).
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import cached_property
from itertools import count

from flint import arb, ctx, fmpq, fmpq_mat, fmpq_poly

from garkcli.deadline import check_time
from garkcli.design.ideal import Ideal, characteristic_polynomial, lowered
from garkcli.exact.field import Algebraic, Number, NumberField
from garkcli.exact.polynomial import Polynomial
from garkcli.exact.roots import RealRoot, real_roots, root_within
from garkcli.frozen import Frozen


class Solution(Frozen):
    """Solutions that are conjugate over ℚ, one for each root of an irreducible polynomial.
    ``modulus`` is the minimal polynomial of u, monic; ``field`` is ℚ[u]/modulus, None for ℚ;
    ``real`` has the real roots in ascending order. Each has ``multiplicity`` in the ideal.
    """

    modulus: fmpq_poly
    field: NumberField | None
    values: dict[str, Number]
    multiplicity: int
    real: tuple[RealRoot, ...]

    @property
    def degree(self) -> int:
        return int(self.modulus.degree())

    @cached_property
    def real_values(self) -> tuple[dict[str, RealRoot], ...]:
        names = self.values.items()
        return tuple({key: value_at(x, root) for key, x in names} for root in self.real)


def value_at(value: Number, root: RealRoot) -> RealRoot:
    if not isinstance(value, Algebraic):
        return RealRoot.rational(value)
    element = Polynomial.from_flint(value.poly)

    def ball(bits: int) -> arb:
        with ctx.workprec(bits):
            return element.enclosed_at(root.ball(bits))

    return root_within(Polynomial.from_flint(Polynomial([-value, 1]).norm()), ball)


def solutions(ideal: Ideal) -> list[Solution]:
    """The solutions of an ideal of dimension 0, those with real roots first."""
    algebra = _Algebra(ideal.closure)
    distinct = algebra.trace_form.rank()
    for c in count():
        # almost all of the forms (1, c, c², …) separate the solutions
        u = algebra.combined([c**i for i in range(len(ideal.ring.names))])
        characteristic = characteristic_polynomial(u)
        square_free = characteristic // characteristic.gcd(characteristic.derivative())
        if square_free.degree() == distinct:
            conjugates = algebra.solutions(u, characteristic, square_free)
            return sorted(conjugates, key=lambda x: (not x.real, x.degree))
    raise AssertionError("all but finitely many linear forms separate the solutions")


class _Algebra:
    """ℚ[t]/I in the basis of the monomials not divisible by leading ones; elements are columns."""

    def __init__(self, ideal: Ideal) -> None:
        self.names = ideal.ring.names
        self.monomials = ideal.monomials
        self.matrices = ideal.multiplications
        self.size = len(self.monomials)
        self.one = fmpq_mat(self.size, 1, [fmpq(k == 0) for k in range(self.size)])

    @cached_property
    def _products(self) -> list[fmpq_mat]:
        size = range(self.size)
        known = {self.monomials[0]: fmpq_mat([[fmpq(i == j) for j in size] for i in size])}
        for e in self.monomials[1:]:
            check_time()
            i, lower = next(lowered(e))
            known[e] = self.matrices[i] * known[lower]
        return list(known.values())

    @cached_property
    def _traces(self) -> fmpq_mat:
        """The traces of multiplication by each monomial, as a row."""
        diagonal = range(self.size)
        return fmpq_mat([[sum((M[i, i] for i in diagonal), fmpq(0)) for M in self._products]])

    @property
    def trace_form(self) -> fmpq_mat:
        """Tr(v w) for the monomials v, w: v w is the column of w in multiplication by v."""
        return fmpq_mat([(self._traces * matrix).entries() for matrix in self._products])

    def combined(self, form: Sequence[int]) -> fmpq_mat:
        total = fmpq_mat(self.size, self.size)
        for a, matrix in zip(form, self.matrices, strict=True):
            total += a * matrix
        return total

    def solutions(self, u: fmpq_mat, characteristic: fmpq_poly, f: fmpq_poly) -> Iterator[Solution]:
        # one for each factor of f
        n = f.degree()
        horner = [fmpq_poly([f[n - k] for k in range(j, -1, -1)]) for j in range(n)]
        powers = [self.one]
        for _ in range(n - 1):
            powers.append(u * powers[-1])

        def representation(row: fmpq_mat) -> fmpq_poly:
            total = fmpq_poly()
            for i, power in enumerate(powers):
                check_time()
                total += (row * power)[0, 0] * horner[n - i - 1]
            return total

        denominator = representation(self._traces)
        numerators = [representation(self._traces * matrix) for matrix in self.matrices]
        for factor, _ in f.factor()[1]:
            check_time()
            modulus = factor / factor[factor.degree()]
            _, inverse, _ = (denominator % modulus).xgcd(modulus)
            field = NumberField(modulus, ()) if modulus.degree() > 1 else None
            values: dict[str, Number] = {}
            for name, numerator in zip(self.names, numerators, strict=True):
                value = numerator * inverse % modulus
                values[name] = value[0] if field is None else field.element(value)
            roots = real_roots(Polynomial.from_flint(modulus))
            yield Solution(
                modulus=modulus,
                field=field,
                values=values,
                multiplicity=_multiplicity(characteristic, modulus),
                real=tuple(root for root, _ in roots),
            )


def _multiplicity(characteristic: fmpq_poly, modulus: fmpq_poly) -> int:
    times = 0
    while True:
        quotient, rest = divmod(characteristic, modulus)
        if rest:
            return times
        characteristic, times = quotient, times + 1
