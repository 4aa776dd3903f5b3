"""The solutions of a system of finitely many, as numbers of number fields.

In the algebra ℚ[t]/I a linear form u that separates the solutions has a characteristic polynomial
with a root for each, as often as its multiplicity. With its square-free part f of degree n every
unknown is a rational function of u at the solutions (F. Rouillier, *Solving zero-dimensional
systems through the rational univariate representation*, 1999):

    v = g_v(u) / g_1(u),   g_v(T) = Σ_{i<n} Tr(v uⁱ) H_{n−i−1}(T),   H_j(T) = Σ_{k≤j} f_k T^{j−k},

f = Σ f_k T^{n−k}. How many solutions there are is the rank of the form (v, w) ↦ Tr(v w).
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import count

from flint import ctx, fmpq, fmpq_mat, fmpq_poly

from garkcli.design.ideal import Ideal
from garkcli.exact.field import Algebraic, Number, NumberField
from garkcli.exact.polynomial import Polynomial
from garkcli.exact.roots import FIRST_BITS, RealRoot, real_roots


@dataclass(frozen=True)
class Solution:
    """Solutions that are conjugate over ℚ: one irreducible polynomial, and each of its roots.

    Attributes:
        modulus: the minimal polynomial of u, monic.
        field: ℚ[u]/modulus; None where the solution is rational.
        values: each unknown as an element of it.
        multiplicity: of each in the ideal.
        real: the roots that are real, in ascending order; none where no solution is.
    """

    modulus: fmpq_poly
    field: NumberField | None
    values: dict[str, Number]
    multiplicity: int
    real: tuple[RealRoot, ...]

    @property
    def degree(self) -> int:
        """How many solutions it stands for, complex ones included."""
        return int(self.modulus.degree())


def value_at(value: Number, root: RealRoot) -> RealRoot:
    """The real number that an element of ℚ[u]/modulus is where u is a real root of the modulus."""
    if not isinstance(value, Algebraic):
        return RealRoot.rational(value)
    candidates = [x for x, _ in real_roots(_minimal_polynomial(value))]
    element = Polynomial.from_flint(value.poly)
    bits = FIRST_BITS
    while len(candidates) > 1:
        with ctx.workprec(bits):
            ball = element.enclosed_at(root.ball(bits))
            candidates = [x for x in candidates if x.ball(bits).overlaps(ball)]
        bits *= 2
    return candidates[0]


def _minimal_polynomial(value: Algebraic) -> Polynomial:
    """A polynomial over ℚ without multiple roots that is zero at an element of a field."""
    field = value.field
    columns = []
    for k in range(field.degree):
        power = fmpq_poly([0] * k + [1])
        image = value.poly * power % field.modulus
        columns.append([image[i] for i in range(field.degree)])
    multiplication = fmpq_mat(columns)  # its transpose has the same polynomial
    return Polynomial.from_flint(_square_free(multiplication.charpoly()))


def solutions(ideal: Ideal) -> list[Solution]:
    """All solutions of an ideal of dimension 0, those with real ones first."""
    matrices = ideal.quotient()
    distinct = _trace_form(matrices).rank()
    found = []
    for form in _linear_forms(ideal.variables):
        u = _combined(form, matrices)
        characteristic = u.charpoly()
        square_free = _square_free(characteristic)
        if square_free.degree() == distinct:
            found = list(_at(u, matrices, characteristic, square_free, ideal))
            break
    return sorted(found, key=lambda x: (not x.real, x.degree))


def _linear_forms(variables: int) -> Iterator[list[int]]:
    """(1, c, c², …) for c = 0, 1, 2, …: all but finitely many of these separate the solutions."""
    for c in count():
        yield [c**i for i in range(variables)]


def _combined(form: Sequence[int], matrices: Sequence[fmpq_mat]) -> fmpq_mat:
    size = matrices[0].nrows()
    total = fmpq_mat(size, size)
    for a, matrix in zip(form, matrices, strict=True):
        total += a * matrix
    return total


def _trace(matrix: fmpq_mat) -> fmpq:
    return sum((matrix[i, i] for i in range(matrix.nrows())), start=fmpq(0))


def _trace_form(matrices: Sequence[fmpq_mat]) -> fmpq_mat:
    """Tr(v w) for the elements v, w of a basis of the algebra.

    The trace is a linear function of what an element does to 1: its coordinates, the first column
    of its matrix.
    """
    basis = list(_basis_matrices(matrices))
    size = len(basis)
    coordinates = fmpq_mat([[x[i, 0] for x in basis] for i in range(size)])
    trace = fmpq_mat([[_trace(x) for x in basis]]) * coordinates.inv()
    images = [trace * x for x in basis]
    return fmpq_mat([[x[0, k] for k in range(size)] for x in images]) * coordinates


def _basis_matrices(matrices: Sequence[fmpq_mat]) -> Iterator[fmpq_mat]:
    """Multiplication by the elements of a basis of the algebra that the matrices generate."""
    size = matrices[0].nrows()
    unit = fmpq_mat(size, size, [fmpq(i == j) for i in range(size) for j in range(size)])
    columns: list[list[fmpq]] = []
    waiting = [unit]
    while waiting:
        matrix = waiting.pop(0)
        # an element is known by what it does to 1, the first monomial
        image = [matrix[i, 0] for i in range(size)]
        if fmpq_mat([*columns, image]).rank() == len(columns):
            continue
        columns.append(image)
        yield matrix
        waiting += [matrix * generator for generator in matrices]


def _square_free(polynomial: fmpq_poly) -> fmpq_poly:
    return polynomial // polynomial.gcd(polynomial.derivative())


def _at(
    u: fmpq_mat, matrices: Sequence[fmpq_mat], characteristic: fmpq_poly, f: fmpq_poly, ideal: Ideal
) -> Iterator[Solution]:
    """The solutions, one a factor of f."""
    n = f.degree()
    horner = [fmpq_poly([f[n - k] for k in range(j, -1, -1)]) for j in range(n)]
    size = u.nrows()
    powers = [fmpq_mat(size, size, [fmpq(i == j) for i in range(size) for j in range(size)])]
    for _ in range(n - 1):
        powers.append(powers[-1] * u)

    def representation(v: fmpq_mat | None) -> fmpq_poly:
        total = fmpq_poly()
        for i, power in enumerate(powers):
            trace = _trace(power if v is None else v * power)
            total += trace * horner[n - i - 1]
        return total

    denominator = representation(None)
    numerators = [representation(matrix) for matrix in matrices]
    _, factors = f.factor()
    for factor, _ in factors:
        modulus = factor / factor[factor.degree()]
        _, inverse, _ = (denominator % modulus).xgcd(modulus)
        field = NumberField(modulus, ()) if modulus.degree() > 1 else None
        values: dict[str, Number] = {}
        for name, numerator in zip(ideal.ring.names, numerators, strict=False):
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
