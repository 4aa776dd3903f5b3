"""The Legendre transfer: its definition, its conjugates, and that the pair keeps its order."""

from __future__ import annotations

from itertools import product

import pytest
from flint import fmpq
from hypothesis import given, settings
from hypothesis import strategies as st

from garkcli import loads
from garkcli.api.construction import gark as joined
from garkcli.errors import MethodError
from garkcli.exact.field import Number
from garkcli.exact.matrix import Matrix, Vector
from garkcli.order.certificate import find_order
from garkcli.order.simplifying import simplifying
from garkcli.tableau.conjugate import conjugate
from garkcli.tableau.forms import gark, pair
from garkcli.tableau.tableau import Method, Tableau
from garkcli.transfer import legendre
from tests.oracles import samples
from tests.oracles.brute import brute_order
from tests.oracles.points import at_points, method_at, numbers, value
from tests.transfer.test_transfer import integral, point_methods

LOBATTO = "{A: [[0, 0, 0], [5/24, 1/3, -1/24], [1/6, 2/3, 1/6]], b: [1/6, 2/3, 1/6]}"
THREE_EIGHTHS = (
    "{A: [[0, 0, 0, 0], [1/3, 0, 0, 0], [-1/3, 1, 0, 0], [1, -1, 1, 0]], b: [1/8, 3/8, 3/8, 1/8]}"
)


def polynomials(degree: int) -> list[Vector]:
    """P_0, …, by Rodrigues: the coefficients of (−1)^j Σ_i C(j, i) C(j + i, i) (−x)^i."""
    found = []
    for j in range(degree + 1):
        row = [fmpq((-1) ** j)]
        for i in range(j):
            row.append(row[-1] * fmpq(-(j - i) * (j + i + 1), (i + 1) ** 2))
        found.append(tuple(row))
    return found


def by_moments(l: Method, m: Method, degree: int) -> Matrix:
    """P_l X P_mᵀ B_m with X_ij = ∫ p_i ∫_0^x p_j by integrals of products, at points."""
    P = polynomials(degree)
    every = range(degree + 1)

    def moment(i: int, j: int) -> fmpq:
        """(2i + 1)(2j + 1) ∫ P_i ∫_0^x P_j."""
        total = fmpq(0)
        for (r, a), (s, b) in product(enumerate(P[i]), enumerate(P[j])):
            total += a * b / ((s + 1) * (r + s + 2))
        return total * (2 * i + 1) * (2 * j + 1)

    X = [[moment(i, j) for j in every] for i in every]

    def entry(c: Number, d: Number, weight: Number) -> Number:
        terms = (value(P[i], c) * X[i][j] * value(P[j], d) for i in every for j in every)
        return sum(terms, fmpq(0)) * weight

    return tuple(tuple(entry(c, d, w) for d, w in zip(m.c, m.b, strict=True)) for c in l.c)


@given(point_methods(), point_methods(), st.integers(0, 5))
def test_the_block_is_its_definition(l: Method, m: Method, degree: int) -> None:
    """P_l X P_mᵀ B_m, entry by entry, also with more polynomials than stages."""
    assert legendre(l, m, degree) == by_moments(l, m, degree)


def test_irrational_nodes_and_stage_algebras() -> None:
    """In a number field, and in ℚ[x]/(M) after it is taken to its points."""
    (gauss,) = numbers("1/2 - sqrt(3)/6, 1/2 + sqrt(3)/6")
    lobatto = (fmpq(0), fmpq(1, 2), fmpq(1))
    nodes = [gauss, lobatto]
    l, m = (method_at(samples.method(x), c) for x, c in zip(PAIR, nodes, strict=True))
    tableau = at_points(samples.everywhere(lambda x, y: legendre(x, y, 2), *PAIR), nodes)
    for here, other, block in ((l, m, tableau.blocks[0, 1]), (m, l, tableau.blocks[1, 0])):
        assert legendre(here, other, 2) == by_moments(here, other, 2)
        assert block == by_moments(here, other, 2)


PAIR = ("gauss 2", "lobatto-iiia 3")
NAMES = [
    *("gauss 1", "gauss 2", "gauss 3", "gauss 4", "rk4", "heun", "kutta", "ssp3 4", "radau-iia 2"),
    *("radau-ia 3", "lobatto-iiia 3", "lobatto-iiia 4", "lobatto-iiib 3", "lobatto-iiic 4"),
]


def pair_order(name: str) -> int:
    """That of one method, by the certificate."""
    return find_order(pair(gark([samples.method(name)], {}))).order


@given(st.lists(st.sampled_from(NAMES), min_size=2, max_size=3))
@settings(deadline=None)
def test_the_pair_keeps_the_least_order(names: list[str]) -> None:
    """The least pair order p of the diagonal methods, and not p + 1; the blocks off the diagonal
    are their own conjugates and have C(K) and D(K).
    """
    p = min(map(pair_order, names))
    tableau = samples.everywhere(legendre, *names)
    K = p // 2
    explicit = samples.everywhere(lambda l, m: legendre(l, m, K), *names)
    assert find_order(pair(explicit)).order == p
    assert find_order(pair(tableau)).order == p
    conjugated = conjugate(explicit)
    found = simplifying(explicit, 20)
    for l, m in explicit.edges():
        if l != m:
            assert conjugated.block(l, m) == explicit.block(l, m)
            eta, zeta = found.C[l][m], found.D[l][m]
            assert eta is not None
            assert zeta is not None
            assert min(eta, zeta) >= K


def of_file(*methods: str, transfer: str = "legendre", more: str = "") -> Tableau:
    """The tableau of a file."""
    return loads(f"methods: [{', '.join(methods)}]\ntransfer: {transfer}\n{more}").tableau


def test_without_a_degree_it_is_that_of_the_least_order() -> None:
    """⌊p/2⌋ with the least of all diagonal methods, in a file and in Python."""
    gauss, lobatto, ssp = "gauss 3", "lobatto-iiia 4", "ssp3 4"
    texts = [
        "{family: gauss, stages: 3}",
        "{family: lobatto-iiia, stages: 4}",
        "{family: ssp3, stages: 4}",
    ]
    least = samples.everywhere(lambda l, m: legendre(l, m, 1), gauss, lobatto, ssp)
    assert pair_order(ssp) == 2
    assert of_file(*texts) == least
    assert of_file(*texts, transfer="{rule: legendre, degree: 1}") == least
    two = of_file(*texts[:2])
    assert two == samples.everywhere(lambda l, m: legendre(l, m, 3), gauss, lobatto)
    made = joined(list(map(alone, texts[:2])), "legendre")
    assert made.tableau.blocks == two.blocks
    other = joined(list(map(alone, texts[:2])), "legendre", degree=2)
    assert other.tableau.blocks != two.blocks
    with pytest.raises(MethodError, match="collocation has no degree"):
        joined(list(map(alone, texts[:2])), "collocation", degree=2)


def alone(text: str) -> Tableau:
    """A diagonal method on its own."""
    return loads(f"methods: [{text}]").tableau


def test_a_degree_beyond_the_bound_can_lose_the_order() -> None:
    """Lobatto IIIA 3 with the 3/8 rule keep order 4 for K = 1, 2, 3 and have order 2 for K = 4 =
    r − k + 1; every tree agrees.
    """
    methods = [LOBATTO, THREE_EIGHTHS]
    orders = {}
    for K in range(1, 5):
        tableau = pair(of_file(*methods, transfer=f"{{rule: legendre, degree: {K}}}"))
        orders[K] = find_order(tableau).order
    assert orders == {1: 4, 2: 4, 3: 4, 4: 2}
    assert brute_order(tableau, 4) == 2


def test_a_rounded_file_has_the_degree_of_what_it_is_a_rounding_of() -> None:
    """Decimals within a tolerance: K = 2 as with exact numbers, where exactly they would have
    K = 1 or 0.
    """
    rounded = "{A: [[0, 0, 0], [0.5, 0, 0], [-1, 2, 0]], b: [0.166666666666667, 0.666666666666667, 0.166666666666667]}"
    text = f"methods: [{rounded}, {{family: gauss, stages: 2}}]\ntransfer: legendre\n"
    within = loads(f"{text}tolerance: 1e-14\n").tableau
    methods = [
        Method("", within.spaces[k], within.blocks[k, k], within.colours[k].b) for k in (0, 1)
    ]
    assert within.blocks[0, 1] == legendre(methods[0], methods[1], 1)
    assert loads(text).tableau.blocks[0, 1] == legendre(methods[0], methods[1], 0)


def test_zero_weights_are_no_obstacle() -> None:
    """The explicit midpoint rule has b_1 = 0 and no conjugate; the block exists."""
    midpoint, gauss = samples.method("explicit-midpoint"), samples.method("gauss 2")
    blocks = {(0, 1): legendre(midpoint, gauss), (1, 0): legendre(gauss, midpoint)}
    assert find_order(gark([midpoint, gauss], blocks)).order == 2


def test_in_combinations_it_has_its_degree() -> None:
    """Half Legendre and half interpolation, as matrices."""
    texts = ["{family: gauss, stages: 2}", "{family: lobatto-iiia, stages: 4}"]
    both = of_file(*texts, transfer="{legendre: 1/2, interpolation: 1/2}").blocks
    parts = [of_file(*texts, transfer=x).blocks for x in ("legendre", "interpolation")]
    for edge in ((0, 1), (1, 0)):
        for row, *rows in zip(both[edge], *(part[edge] for part in parts), strict=True):
            assert row == tuple((x + y) / 2 for x, y in zip(*rows, strict=True))


def integral_of(f: Vector) -> fmpq:
    """∫_0^1 f, by the oracle of the other rules."""
    return integral(f, fmpq(1))


def test_the_polynomials_of_the_oracle_are_orthogonal() -> None:
    """∫ P_i P_j = 0 for i ≠ j, and 1/(2i + 1)."""
    P = polynomials(4)
    for i, j in product(range(5), repeat=2):
        row = [fmpq(0)] * (len(P[i]) + len(P[j]) - 1)
        for (r, a), (s, b) in product(enumerate(P[i]), enumerate(P[j])):
            row[r + s] += a * b
        assert integral_of(tuple(row)) == (fmpq(1, 2 * i + 1) if i == j else 0)
