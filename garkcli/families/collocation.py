"""Gauss, Radau and Lobatto methods, from their node polynomials, over ℚ for any number of stages.

Gauss methods have order 2s; Radau methods 2s − 1; Lobatto methods, whose nodes include 0 and 1, 2s
− 2. Hairer, Lubich & Wanner, *Geometric Numerical Integration*, II.1.3; Hairer & Wanner, *Solving
Ordinary Differential Equations II*, IV.5; for Radau IB and IIB: G. Sun, *A simple way constructing
symplectic Runge–Kutta methods*, J. Comput. Math. 18 (2000); Jay, "Lobatto methods", *Encyclopedia
of Applied and Computational Mathematics* (2015).
"""

from __future__ import annotations

from typing import cast

from flint import fmpq, fmpq_poly

from garkcli.errors import UnknownFamily, counted
from garkcli.exact.field import ONE, ZERO
from garkcli.exact.matrix import Matrix, Vector, add, apply, dot, multiply, outer, scale, subtract
from garkcli.exact.nodes import Expression
from garkcli.families.family import MAX_STAGES, MethodFamily, Option, Options, Recipe, of_stages
from garkcli.reference import Reference
from garkcli.tableau.polynomial_space import PolynomialSpace, integral, integration
from garkcli.tableau.tableau import Method

X = fmpq_poly([0, 1])


def legendre(degree: int) -> fmpq_poly:
    """P_degree(2x − 1), the Legendre polynomial shifted to [0, 1]."""
    return fmpq_poly.legendre_p(degree)(2 * X - 1)


def monic(poly: fmpq_poly) -> fmpq_poly:
    return poly / poly.leading_coefficient()


def interpolatory(modulus: fmpq_poly) -> tuple[PolynomialSpace, Vector]:
    """ℚ[x]/(modulus) and the interpolatory weights b(f) = ∫_0^1 f for deg f < s."""
    space = PolynomialSpace(monic(modulus))
    return space, integral(space.stages)


def collocation_method(name: str, modulus: fmpq_poly) -> Method:
    """The collocation method at the roots of ``modulus``: A f = ∫_0^x f, so C(s) holds."""
    space, b = interpolatory(modulus)
    A = multiply(space.reductions(space.stages + 1), integration(space.stages))
    return Method(name, space, A, b)


def conjugate_method(name: str, method: Method) -> Method:
    """The method (Â, b, c); it satisfies D(s) if ``method`` satisfies C(s)."""
    space, b = method.space, method.b
    A = subtract(outer(space.one, b), space.adjoint(method.A, b, space, b))
    return Method(name, space, A, b)


def average(name: str, one: Method, other: Method) -> Method:
    A = scale(fmpq(1, 2), add(one.A, other.A))
    return Method(name, one.space, A, one.b)


def lagrange_at(space: PolynomialSpace, node: int) -> Vector:
    """The Lagrange polynomial of a rational ``node``: 1 there and 0 at all other nodes."""
    quotient = space.modulus // (X - node)
    quotient /= quotient(node)
    return tuple(quotient[k] for k in range(space.stages))


def with_first_column(name: str, base: Method) -> Method:
    """a_{i1} = b_1 and C(s − 1), for a ``base`` with first node 0 and C(s − 1): they differ by a
    multiple of the functional that takes the coefficient of x^(s−1).
    """
    space = base.space
    assert isinstance(space, PolynomialSpace)
    s = space.stages
    first = lagrange_at(space, 0)
    leading = (ZERO,) * (s - 1) + (ONE,)
    b_1 = dot(base.b, first)
    wanted = tuple(b_1 * x for x in space.one)
    images = apply(base.A, first)
    scale_of_first = first[s - 1]
    missing = [(x - y) / scale_of_first for x, y in zip(wanted, images, strict=True)]
    return Method(name, space, add(base.A, outer(tuple(missing), leading)), base.b)


def gauss(s: int) -> Method:
    return collocation_method(f"Gauss {s}", legendre(s))


def radau_ia(s: int) -> Method:
    """The first node is 0 and D(s) holds."""
    return conjugate_method(f"Radau IA {s}", collocation_method("", legendre(s) + legendre(s - 1)))


def radau_iia(s: int) -> Method:
    """Collocation, the last node is 1."""
    return collocation_method(f"Radau IIA {s}", legendre(s) - legendre(s - 1))


def radau_ib(s: int) -> Method:
    """The mean of IA and its symplectic conjugate, symplectic."""
    base = radau_ia(s)
    return average(f"Radau IB {s}", base, conjugate_method("", base))


def radau_iib(s: int) -> Method:
    """The mean of IIA and its symplectic conjugate, symplectic."""
    base = radau_iia(s)
    return average(f"Radau IIB {s}", base, conjugate_method("", base))


def lobatto_iiia(s: int) -> Method:
    """Collocation, C(s)."""
    return collocation_method(f"Lobatto IIIA {s}", X * (X - 1) * legendre(s - 1).derivative())


def lobatto_iiib(s: int) -> Method:
    """The symplectic conjugate of IIIA, D(s)."""
    return conjugate_method(f"Lobatto IIIB {s}", lobatto_iiia(s))


def lobatto_iiic(s: int) -> Method:
    """a_{i1} = b_1 and C(s − 1)."""
    return with_first_column(f"Lobatto IIIC {s}", lobatto_iiia(s))


def lobatto_iiic_star(s: int) -> Method:
    """Also called Lobatto III: the symplectic conjugate of IIIC."""
    return conjugate_method(f"Lobatto IIIC* {s}", lobatto_iiic(s))


def lobatto_iiid(s: int) -> Method:
    """The mean of IIIC and IIIC*, symplectic."""
    return average(f"Lobatto IIID {s}", lobatto_iiic(s), lobatto_iiic_star(s))


def lobatto_iiie(s: int) -> Method:
    """The mean of IIIA and IIIB, symplectic."""
    return average(f"Lobatto IIIE {s}", lobatto_iiia(s), lobatto_iiib(s))


SIGMA = Option(
    "sigma", "The number σ that chooses a Lobatto IIIS method: 1/2 is IIIE, 1 is IIID.", shown="1/2"
)


def lobatto_iiis(s: int, options: Options) -> Recipe:
    """Symplectic and symmetric for every σ; IIIE for σ = 1/2, IIID for σ = 1.

    R. P. K. Chan, *On symmetric Runge–Kutta methods of high order*, Computing 45 (1990).
    """

    def make(values: Vector) -> Method:
        (sigma,) = values
        one, other = lobatto_iiid(s), lobatto_iiie(s)
        of_one = 2 * sigma - ONE
        of_other = 2 * (ONE - sigma)
        A = add(scale(of_one, one.A), scale(of_other, other.A))
        return Method(f"Lobatto IIIS {s}", one.space, A, one.b)

    return Recipe(s, make, (cast("Expression", options["sigma"]),))


DEGREE = Option(
    "degree", "The degree of the polynomial that the solution of a step is.", smallest=1, shown="1"
)


def hbvm(stages: int, options: Options) -> Recipe:
    """Hamiltonian boundary value methods: the solution of a step is a polynomial whose derivative
    is f along it, projected to lower Legendre polynomials; Gauss quadrature takes the integrals.

    With exact integrals it is the average vector field method for degree 1, and otherwise the
    energy-preserving collocation of E. Hairer, *JNAIAM* 5 (2010) 73. Up to order p the integrands
    of its conditions have degrees below p times that degree, which half as many stages integrate
    exactly. UnknownFamily for fewer stages than the degree.
    """
    degree = cast("int", options["degree"])
    if degree > stages:
        message = f"hbvm with {counted(stages, 'stage')} and degree {degree} does not exist"
        raise UnknownFamily(message, "give a degree up to the stages", code="cannot-construct")

    def make(_: Vector) -> Method:
        base = gauss(stages)
        space, b = base.space, base.b
        A: Matrix = ((ZERO,) * stages,) * stages
        for j in range(degree):
            polynomial = legendre(j)
            column = space.of_polynomial(polynomial.integral().coeffs())
            row = space.times(b, space.of_polynomial(polynomial.coeffs()))
            A = add(A, scale(fmpq(2 * j + 1), outer(column, row)))
        return Method(f"HBVM({stages}, {degree})", space, A, b)

    return Recipe(stages, make)


MOST_OF_GAUSS = 500
_ORDER = "2s - 2"
STIFF = Reference(
    authors=("E. Hairer", "G. Wanner"),
    title="Solving Ordinary Differential Equations II",
    publisher="Springer",
    year="1996",
    where="section IV.5",
    doi="10.1007/978-3-642-05221-7",
)
SUN = Reference(
    authors=("G. Sun",),
    title="A simple way constructing symplectic Runge-Kutta methods",
    journal="J. Comput. Math.",
    volume="18",
    year="2000",
)
BRUGNANO = Reference(
    authors=("L. Brugnano", "F. Iavernaro", "D. Trigiante"),
    title="Hamiltonian Boundary Value Methods (energy preserving discrete line integral methods)",
    journal="JNAIAM",
    volume="5",
    pages="17-37",
    year="2010",
)
JAY = Reference(
    authors=("L. O. Jay",),
    title="Lobatto methods",
    book="Encyclopedia of Applied and Computational Mathematics",
    publisher="Springer",
    year="2015",
)
FAMILIES = (
    of_stages(
        "gauss", gauss, 1, "2s", "collocation at the Gauss nodes; symplectic", STIFF, MOST_OF_GAUSS
    ),
    of_stages("radau-ia", radau_ia, 1, "2s - 1", "first node 0, D(s)", STIFF),
    of_stages("radau-iia", radau_iia, 1, "2s - 1", "collocation, last node 1", STIFF),
    of_stages("radau-ib", radau_ib, 2, "2s - 1", "mean of IA and its conjugate; symplectic", SUN),
    of_stages(
        "radau-iib", radau_iib, 2, "2s - 1", "mean of IIA and its conjugate; symplectic", SUN
    ),
    of_stages("lobatto-iiia", lobatto_iiia, 2, _ORDER, "collocation, nodes 0 and 1", STIFF),
    of_stages("lobatto-iiib", lobatto_iiib, 2, _ORDER, "symplectic conjugate of IIIA", STIFF),
    of_stages("lobatto-iiic", lobatto_iiic, 2, _ORDER, "a_i1 = b_1, stiffly accurate", STIFF),
    of_stages("lobatto-iiic*", lobatto_iiic_star, 2, _ORDER, "conjugate of IIIC", JAY),
    of_stages("lobatto-iiid", lobatto_iiid, 2, _ORDER, "mean of IIIC and IIIC*; symplectic", JAY),
    of_stages("lobatto-iiie", lobatto_iiie, 2, _ORDER, "mean of IIIA and IIIB; symplectic", JAY),
    MethodFamily(
        "lobatto-iiis",
        lobatto_iiis,
        2,
        MAX_STAGES,
        _ORDER,
        "IIIE for sigma: 1/2, IIID for 1",
        options=(SIGMA,),
        reference=JAY,
    ),
    MethodFamily(
        "hbvm",
        hbvm,
        1,
        MAX_STAGES,
        "2 degree",
        "keeps energies of degree 2s/degree",
        options=(DEGREE,),
        reference=BRUGNANO,
    ),
)
