"""Node polynomials and the maps that families are made of, over ℚ for any number of stages."""

from __future__ import annotations

from flint import fmpq, fmpq_poly

from garkcli.exact.field import ONE, ZERO
from garkcli.exact.matrix import Vector, add, apply, dot, multiply, outer, scale, subtract
from garkcli.tableau.polynomial_space import PolynomialSpace, integral, integration
from garkcli.tableau.tableau import Method

X = fmpq_poly([0, 1])


def legendre(degree: int) -> fmpq_poly:
    """P_degree(2x − 1), the Legendre polynomial shifted to [0, 1]."""
    return fmpq_poly.legendre_p(degree)(2 * X - 1)


def monic(poly: fmpq_poly) -> fmpq_poly:
    """``poly`` with leading coefficient 1."""
    return poly / poly.leading_coefficient()


def interpolatory(modulus: fmpq_poly) -> tuple[PolynomialSpace, Vector]:
    """ℚ[x]/(modulus) and the interpolatory weights b(f) = ∫_0^1 f for deg f < s."""
    space = PolynomialSpace(monic(modulus))
    return space, integral(space.stages)


def collocation_method(name: str, modulus: fmpq_poly) -> Method:
    """The collocation method at the roots of ``modulus``: A f = ∫_0^x f, so that C(s) holds."""
    space, b = interpolatory(modulus)
    A = multiply(space.reductions(space.stages + 1), integration(space.stages))
    return Method(name, space, A, b)


def conjugate_method(name: str, method: Method) -> Method:
    """The method (Â, b, c); D(s) holds for it where C(s) holds for ``method``."""
    space, b = method.space, method.b
    adjoint = space.adjoint(method.A, b, space, b)
    A = subtract(outer(space.one, b), adjoint)
    return Method(name, space, A, b)


def average(name: str, one: Method, other: Method) -> Method:
    """The method with the mean of both matrices; space and weights are those of ``one``."""
    A = scale(fmpq(1, 2), add(one.A, other.A))
    return Method(name, one.space, A, one.b)


def lagrange_at(space: PolynomialSpace, node: int) -> Vector:
    """The Lagrange polynomial of a rational ``node``: 1 there and 0 at all other nodes."""
    quotient = space.modulus // (X - node)
    quotient /= quotient(node)
    return tuple(quotient[k] for k in range(space.stages))


def with_first_column(name: str, base: Method) -> Method:
    """The method with a_{i1} = b_1 and C(s − 1), the first node being 0; ``base`` satisfies C(s −
    1).

    It differs from ``base`` by a multiple of the functional that takes the coefficient of x^(s−1).
    """
    space = base.space
    assert isinstance(space, PolynomialSpace)
    s = space.stages
    first = lagrange_at(space, 0)
    leading = (ZERO,) * (s - 1) + (ONE,)
    b_1 = dot(base.b, first)
    wanted = tuple(b_1 * x for x in space.one)
    found = apply(base.A, first)
    scale_of_first = first[s - 1]
    missing = []
    for x, y in zip(wanted, found, strict=True):
        missing.append((x - y) / scale_of_first)
    correction = outer(tuple(missing), leading)
    return Method(name, space, add(base.A, correction), base.b)
