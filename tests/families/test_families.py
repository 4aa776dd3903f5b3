"""The families: textbook coefficients at two and three stages, and what characterises them at any
number.
"""

from __future__ import annotations

import pytest
from flint import fmpq, fmpq_poly

from garkcli.errors import UnknownFamily
from garkcli.families.collocation import MOST_OF_GAUSS
from garkcli.families.family import MAX_STAGES
from garkcli.families.registry import BY_STAGES, diagonal_method
from garkcli.order.certificate import find_order
from garkcli.order.simplifying import is_symplectic, simplifying
from garkcli.tableau.conjugate import conjugate
from garkcli.tableau.forms import gark
from garkcli.tableau.polynomial_space import PolynomialSpace
from garkcli.tableau.tableau import Tableau
from tests.oracles.brute import brute_order
from tests.oracles.points import method_at, numbers
from tests.whole import in_whole

TEXTBOOK = {
    ("gauss", 1): ("1/2", "1/2", "1"),
    ("gauss", 2): (
        "1/2 - sqrt(3)/6, 1/2 + sqrt(3)/6",
        "1/4, 1/4 - sqrt(3)/6",
        "1/4 + sqrt(3)/6, 1/4",
        "1/2, 1/2",
    ),
    ("gauss", 3): (
        "1/2 - sqrt(15)/10, 1/2, 1/2 + sqrt(15)/10",
        "5/36, 2/9 - sqrt(15)/15, 5/36 - sqrt(15)/30",
        "5/36 + sqrt(15)/24, 2/9, 5/36 - sqrt(15)/24",
        "5/36 + sqrt(15)/30, 2/9 + sqrt(15)/15, 5/36",
        "5/18, 4/9, 5/18",
    ),
    ("radau-ia", 1): ("0", "1", "1"),
    ("radau-ia", 2): ("0, 2/3", "1/4, -1/4", "1/4, 5/12", "1/4, 3/4"),
    ("radau-ia", 3): (
        "0, (6 - sqrt(6))/10, (6 + sqrt(6))/10",
        "1/9, (-1 - sqrt(6))/18, (-1 + sqrt(6))/18",
        "1/9, (88 + 7*sqrt(6))/360, (88 - 43*sqrt(6))/360",
        "1/9, (88 + 43*sqrt(6))/360, (88 - 7*sqrt(6))/360",
        "1/9, (16 + sqrt(6))/36, (16 - sqrt(6))/36",
    ),
    ("radau-iia", 1): ("1", "1", "1"),
    ("radau-iia", 2): ("1/3, 1", "5/12, -1/12", "3/4, 1/4", "3/4, 1/4"),
    ("radau-iia", 3): (
        "(4 - sqrt(6))/10, (4 + sqrt(6))/10, 1",
        "(88 - 7*sqrt(6))/360, (296 - 169*sqrt(6))/1800, (-2 + 3*sqrt(6))/225",
        "(296 + 169*sqrt(6))/1800, (88 + 7*sqrt(6))/360, (-2 - 3*sqrt(6))/225",
        "(16 - sqrt(6))/36, (16 + sqrt(6))/36, 1/9",
        "(16 - sqrt(6))/36, (16 + sqrt(6))/36, 1/9",
    ),
    ("radau-ib", 2): ("0, 2/3", "1/8, -1/8", "7/24, 3/8", "1/4, 3/4"),
    ("radau-iib", 2): ("1/3, 1", "3/8, -1/24", "7/8, 1/8", "3/4, 1/4"),
    ("lobatto-iiia", 2): ("0, 1", "0, 0", "1/2, 1/2", "1/2, 1/2"),
    ("lobatto-iiia", 3): (
        "0, 1/2, 1",
        "0, 0, 0",
        "5/24, 1/3, -1/24",
        "1/6, 2/3, 1/6",
        "1/6, 2/3, 1/6",
    ),
    ("lobatto-iiib", 2): ("0, 1", "1/2, 0", "1/2, 0", "1/2, 1/2"),
    ("lobatto-iiib", 3): (
        "0, 1/2, 1",
        "1/6, -1/6, 0",
        "1/6, 1/3, 0",
        "1/6, 5/6, 0",
        "1/6, 2/3, 1/6",
    ),
    ("lobatto-iiic", 2): ("0, 1", "1/2, -1/2", "1/2, 1/2", "1/2, 1/2"),
    ("lobatto-iiic", 3): (
        "0, 1/2, 1",
        "1/6, -1/3, 1/6",
        "1/6, 5/12, -1/12",
        "1/6, 2/3, 1/6",
        "1/6, 2/3, 1/6",
    ),
    ("lobatto-iiic*", 2): ("0, 1", "0, 0", "1, 0", "1/2, 1/2"),
    ("lobatto-iiic*", 3): ("0, 1/2, 1", "0, 0, 0", "1/4, 1/4, 0", "0, 1, 0", "1/6, 2/3, 1/6"),
    ("lobatto-iiid", 2): ("0, 1", "1/4, -1/4", "3/4, 1/4", "1/2, 1/2"),
    ("lobatto-iiid", 3): (
        "0, 1/2, 1",
        "1/12, -1/6, 1/12",
        "5/24, 1/3, -1/24",
        "1/12, 5/6, 1/12",
        "1/6, 2/3, 1/6",
    ),
    ("lobatto-iiie", 2): ("0, 1", "1/4, 0", "1/2, 1/4", "1/2, 1/2"),
    ("lobatto-iiie", 3): (
        "0, 1/2, 1",
        "1/12, -1/12, 0",
        "3/16, 1/3, -1/48",
        "1/6, 3/4, 1/12",
        "1/6, 2/3, 1/6",
    ),
    ("explicit-euler", 1): ("0", "0", "1"),
    ("explicit-midpoint", 2): ("0, 1/2", "0, 0", "1/2, 0", "0, 1"),
    ("heun", 2): ("0, 1", "0, 0", "1, 0", "1/2, 1/2"),
    ("kutta", 3): ("0, 1/2, 1", "0, 0, 0", "1/2, 0, 0", "-1, 2, 0", "1/6, 2/3, 1/6"),
    ("rk4", 4): (
        "0, 1/2, 1/2, 1",
        "0, 0, 0, 0",
        "1/2, 0, 0, 0",
        "0, 1/2, 0, 0",
        "0, 0, 1, 0",
        "1/6, 1/3, 1/3, 1/6",
    ),
    ("ssp2", 3): ("0, 1/2, 1", "0, 0, 0", "1/2, 0, 0", "1/2, 1/2, 0", "1/3, 1/3, 1/3"),
    ("ssp3", 4): (
        "0, 1/2, 1, 1/2",
        "0, 0, 0, 0",
        "1/2, 0, 0, 0",
        "1/2, 1/2, 0, 0",
        "1/6, 1/6, 1/6, 0",
        "1/6, 1/6, 1/6, 1/2",
    ),
}
"""Nodes, rows of A, weights.

Radau IB, IIB and Lobatto IIIE: L. Jay, *Lobatto methods*, Encyclopedia of Applied and Computational
Mathematics, 2015, and G. Sun, J. Comput. Math. 18, 2000; the others: Hairer & Wanner, *Solving ODE II*, section IV.5; Hairer, Nørsett & Wanner, *Solving ODE I*, section
II.1.
"""

ORDERS = {
    "gauss": lambda s: 2 * s,
    "radau-ia": lambda s: 2 * s - 1,
    "radau-iia": lambda s: 2 * s - 1,
    "radau-ib": lambda s: 2 * s - 1,
    "radau-iib": lambda s: 2 * s - 1,
    "lobatto-iiia": lambda s: 2 * s - 2,
    "lobatto-iiib": lambda s: 2 * s - 2,
    "lobatto-iiic": lambda s: 2 * s - 2,
    "lobatto-iiic*": lambda s: 2 * s - 2,
    "lobatto-iiid": lambda s: 2 * s - 2,
    "lobatto-iiie": lambda s: 2 * s - 2,
    "explicit-euler": lambda _: 1,
    "explicit-midpoint": lambda _: 2,
    "heun": lambda _: 2,
    "kutta": lambda _: 3,
    "rk4": lambda _: 4,
    "ssp2": lambda _: 2,
    "ssp3": lambda _: 3,
}
"""The order of each family, from the same books."""
LOBATTO = ["lobatto-iiia", "lobatto-iiib", "lobatto-iiic", "lobatto-iiic*", "lobatto-iiid"]


def alone(name: str, stages: int) -> Tableau:
    """The method as a tableau of one colour."""
    return gark([diagonal_method(name, stages)], {})


def conditions(name: str, stages: int) -> tuple[int, int, int]:
    """The largest p, η, ζ for which B(p), C(η), D(ζ) hold."""
    found = simplifying(alone(name, stages), 60)
    C, D = found.C[0][0], found.D[0][0]
    assert C is not None
    assert D is not None
    return found.B[0], C, D


@pytest.mark.parametrize(("name", "stages"), TEXTBOOK)
def test_textbook_coefficients(name: str, stages: int) -> None:
    """Nodes, matrix and weights are, entry by entry, those of the textbooks."""
    c, *A, b = numbers(*TEXTBOOK[name, stages])
    method = diagonal_method(name, stages)
    assert method.stages == stages == len(c)
    if isinstance(method.space, PolynomialSpace):
        assert all(not _at(method.space.modulus, x) for x in c)
        method = method_at(method, c)
    assert tuple(A) == method.A
    assert method.b == b
    assert method.c == c


def _at(polynomial: fmpq_poly, x: fmpq) -> fmpq:
    total = fmpq(0)
    for k in reversed(range(polynomial.degree() + 1)):
        total = total * x + polynomial[k]
    return total


def test_every_family_has_textbook_coefficients() -> None:
    """No family of the registry is left out here."""
    assert {name for name, _ in TEXTBOOK} == set(ORDERS) == set(BY_STAGES)


@pytest.mark.parametrize("name", BY_STAGES)
@pytest.mark.parametrize("stages", range(1, 8))
def test_orders(name: str, stages: int) -> None:
    """Each family has the order of the books at every number of stages that it comes in, and
    refuses the others.
    """
    family = BY_STAGES[name]
    is_gap = name == "ssp3" and stages != 4
    if is_gap or not family.smallest <= stages <= family.largest:
        with pytest.raises(UnknownFamily, match="does not exist"):
            diagonal_method(name, stages)
        return
    order = ORDERS[name](stages)
    assert find_order(alone(name, stages)).order == order
    if order <= 8:
        assert brute_order(alone(name, stages), order + 1) == order


@pytest.mark.parametrize("name", BY_STAGES)
def test_the_order_that_people_are_told(name: str) -> None:
    """The order in terms of s that the registry lists is the true one."""
    family = BY_STAGES[name]
    stages = family.smallest if family.smallest == family.largest else 4
    told = {"2s": 2 * stages, "2s - 1": 2 * stages - 1, "2s - 2": 2 * stages - 2}
    assert told.get(family.order, family.order) in (ORDERS[name](stages), str(ORDERS[name](stages)))


@pytest.mark.parametrize("s", range(1, 8))
def test_gauss_is_characterised(s: int) -> None:
    """Gauss has B(2s), C(s), D(s); its node polynomial is orthogonal to all of lower degree; it is
    symplectic.
    """
    assert conditions("gauss", s) == (2 * s, s, s)
    space = diagonal_method("gauss", s).space
    assert isinstance(space, PolynomialSpace)
    for k in range(s):
        product = space.modulus * fmpq_poly([0, 1]) ** k
        assert product.integral()(1) - product.integral()(0) == 0
    assert is_symplectic(alone("gauss", s))


@pytest.mark.parametrize("s", range(1, 8))
def test_radau_is_characterised(s: int) -> None:
    """IA: B(2s − 1), C(s − 1), D(s), a node at 0; IIA: B(2s − 1), C(s), D(s − 1), a node at 1,
    stiffly accurate.
    """
    assert conditions("radau-ia", s) == (2 * s - 1, s - 1, s)
    assert conditions("radau-iia", s) == (2 * s - 1, s, s - 1)
    first, last = (diagonal_method("radau-ia", s).space, diagonal_method("radau-iia", s).space)
    assert isinstance(first, PolynomialSpace)
    assert isinstance(last, PolynomialSpace)
    assert first.modulus(0) == 0
    assert last.modulus(1) == 0
    method = diagonal_method("radau-iia", s)
    at_1 = tuple(sum((row[j] for row in method.A), fmpq(0)) for j in range(s))
    assert at_1 == method.b


@pytest.mark.parametrize("s", range(2, 8))
@pytest.mark.parametrize("name", LOBATTO)
def test_lobatto_is_characterised(name: str, s: int) -> None:
    """All have B(2s − 2) and the nodes 0 and 1; C and D are those of the books."""
    expected = {
        "lobatto-iiia": (s, s - 2),
        "lobatto-iiib": (s - 2, s),
        "lobatto-iiic": (s - 1, s - 1),
        "lobatto-iiic*": (s - 1, s - 1),
        "lobatto-iiid": (s - 1, s - 1),
    }
    assert conditions(name, s) == (2 * s - 2, *expected[name])
    space = diagonal_method(name, s).space
    assert isinstance(space, PolynomialSpace)
    assert space.modulus(0) == space.modulus(1) == 0
    assert is_symplectic(alone(name, s)) == (name == "lobatto-iiid")


@pytest.mark.parametrize("s", range(2, 8))
def test_conjugate_families(s: int) -> None:
    """IIIA and IIIB are conjugate, IIIC and IIIC*, and IIID is the mean of the latter two."""
    assert conjugate(alone("lobatto-iiia", s)) == alone("lobatto-iiib", s)
    assert conjugate(alone("lobatto-iiib", s)) == alone("lobatto-iiia", s)
    assert conjugate(alone("lobatto-iiic", s)) == alone("lobatto-iiic*", s)
    C, C_star, D = (
        diagonal_method(name, s).A for name in ("lobatto-iiic", "lobatto-iiic*", "lobatto-iiid")
    )
    for i in range(s):
        for j in range(s):
            assert D[i][j] == (C[i][j] + C_star[i][j]) / 2


@pytest.mark.parametrize("s", range(2, 6))
def test_lobatto_iiic_has_its_first_column(s: int) -> None:
    """IIIC: a_{i1} = b_1 and the last row is b; IIIC*: 0 in the last column and the first row."""
    method, star = (diagonal_method("lobatto-iiic", s), diagonal_method("lobatto-iiic*", s))
    space = method.space
    assert isinstance(space, PolynomialSpace)
    first = space.modulus // fmpq_poly([0, 1])
    first /= first(0)
    last = space.modulus // fmpq_poly([-1, 1])
    last /= last(1)
    image = _image(method.A, first, s)
    assert image == fmpq_poly([first.integral()(1)])
    assert _image(star.A, last, s) == 0
    for k in range(s):
        power = fmpq_poly([0, 1]) ** k
        assert _image(method.A, power, s)(1) == fmpq(1, k + 1)
        assert _image(star.A, power, s)(0) == 0


def _image(A: tuple[tuple[fmpq, ...], ...], f: fmpq_poly, s: int) -> fmpq_poly:
    return fmpq_poly([sum((A[i][j] * f[j] for j in range(s)), fmpq(0)) for i in range(s)])


@pytest.mark.parametrize("s", range(2, 9))
def test_ssp2(s: int) -> None:
    """SSPRK(s, 2) has equal weights 1/s, entries 1/(s − 1) below the diagonal, and order 2 for
    every s.
    """
    method = diagonal_method("ssp2", s)
    assert method.b == (fmpq(1, s),) * s
    assert all(
        x == (fmpq(1, s - 1) if j < i else 0)
        for i, row in enumerate(method.A)
        for j, x in enumerate(row)
    )
    assert find_order(gark([method], {})).order == brute_order(gark([method], {}), 3) == 2


@in_whole
def test_many_stages() -> None:
    """Twenty stages are as exact as two: Gauss has order 40, and the certificate says at least when
    it stops.
    """
    assert find_order(alone("gauss", 20), 100).order == 40
    assert find_order(alone("radau-iia", 14), 100).order == 27
    assert find_order(alone("gauss", 31)).is_lower_bound


def test_unknown_families() -> None:
    """A misspelt name gets the nearest one, a missing or wrong number of stages its cure."""
    with pytest.raises(UnknownFamily, match="did you mean 'gauss'"):
        diagonal_method("gaus", 2)
    with pytest.raises(UnknownFamily, match="needs its number of stages"):
        diagonal_method("gauss")
    with pytest.raises(UnknownFamily, match="does not exist"):
        diagonal_method("rk4", 3)
    for name, most in (("radau-iia", MAX_STAGES), ("gauss", MOST_OF_GAUSS)):
        with pytest.raises(UnknownFamily, match=f"at most {most}"):
            diagonal_method(name, most + 1)
    assert diagonal_method("rk4").stages == 4
