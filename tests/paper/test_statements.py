"""Lemmas, propositions and examples of the paper, as they are true."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from random import Random

import pytest
from flint import fmpq
from hypothesis import given
from hypothesis import strategies as st

from garkcli.exact.matrix import Matrix
from garkcli.methodfile.load import loads
from garkcli.order.certificate import find_order
from garkcli.order.simplifying import consistent_blocks, is_symplectic, simplifying
from garkcli.tableau.conjugate import conjugate
from garkcli.tableau.forms import gark, pair, symplectic_pair
from garkcli.tableau.tableau import Tableau
from garkcli.transfer import collocation, interpolation
from tests.oracles import samples
from tests.oracles.brute import brute_order
from tests.oracles.points import at_points
from tests.oracles.stages import image, one
from tests.paper import tables
from tests.whole import sample

METHODS = [
    "gauss 1",
    "gauss 2",
    "gauss 3",
    "gauss 4",
    "radau-ia 2",
    "radau-ia 3",
    "radau-iia 1",
    "radau-iia 2",
    "radau-iia 3",
    "lobatto-iiia 2",
    "lobatto-iiia 3",
    "lobatto-iiia 4",
    "lobatto-iiib 3",
    "lobatto-iiic 2",
    "lobatto-iiic 3",
    "lobatto-iiic* 3",
    "lobatto-iiid 3",
]
PAIRS = [(l, m) for l in METHODS for m in METHODS if l != m]


def others(m: str) -> list[str]:
    """All methods but one."""
    return [l for l in METHODS if l != m]


def C(tableau: Tableau, l: int, m: int) -> int:  # noqa: N802 -- the paper's letter
    """η^{l,m} of a block that exists."""
    found = simplifying(tableau, 20).C[l][m]
    assert found is not None
    return found


@pytest.mark.parametrize("m", METHODS)
def test_lemma_stage_order(m: str) -> None:
    """C^{l,m} holds up to s_m by collocation, and up to min(η^{m,m}, s_m − 1) by interpolation."""
    stages = samples.method(m).stages
    for l in others(m):
        by_collocation = samples.everywhere(collocation, l, m)
        assert C(by_collocation, 0, 1) >= stages, l
        by_interpolation = samples.everywhere(interpolation, l, m)
        promised = min(C(by_interpolation, 1, 1), stages - 1)
        assert C(by_interpolation, 0, 1) >= promised, l


def test_lemma_stage_order_at_general_and_special_nodes() -> None:
    """Collocation on Gauss 2 has C(2) at general nodes, C(3) at 0, 1/2, 1, and C(4) at 0, 1."""
    assert C(samples.everywhere(collocation, "radau-iia 2", "gauss 2"), 0, 1) == 2
    assert C(samples.everywhere(collocation, "lobatto-iiia 3", "gauss 2"), 0, 1) == 3
    assert C(samples.everywhere(collocation, "lobatto-iiia 2", "gauss 2"), 0, 1) == 4
    assert C(samples.everywhere(interpolation, "lobatto-iiia 3", "gauss 2"), 0, 1) == 1


@pytest.mark.parametrize("rule", [collocation, interpolation])
@pytest.mark.parametrize("m", METHODS)
def test_proposition_row_sums(rule: Callable[..., Matrix], m: str) -> None:
    """A^{l,m} 𝟙 = c^{l}, by interpolation only where m has two stages or more."""
    there = samples.method(m)
    is_excepted = rule is interpolation and there.stages == 1
    for l in others(m):
        here = samples.method(l)
        block = rule(here, there)
        sums = image(block, one(there.space))
        assert (sums == here.c) == (not is_excepted), l


@given(st.sampled_from(PAIRS), st.fractions(-5, 5, max_denominator=20))
def test_corollary_on_combinations(names: tuple[str, str], tau: Fraction) -> None:
    """Any τ interpolation + (1 − τ) collocation satisfies C^{l,m}(min(η^{m,m}, s_m − 1))."""
    tableau = samples.everywhere(samples.mixture(str(1 - tau), str(tau), "0", "0"), *names)
    for l, m in ((0, 1), (1, 0)):
        stages = tableau.space(m).stages
        assert C(tableau, l, m) >= min(C(tableau, m, m), stages - 1)


@pytest.mark.parametrize("name", samples.NAMED)
def test_simplifying_assumption_theorem(name: str) -> None:
    """The printed bound min{r, 2η+2, ξ+1, η+ζ+1} is never above the order, and ξ + 1 is never the
    smallest.
    """
    tableau = samples.NAMED[name]()
    found = simplifying(tableau, 12)
    assert found.bound <= find_order(tableau, 12).order
    assert found.xi >= found.eta + found.zeta


@pytest.mark.parametrize("seed", range(40))
def test_simplifying_assumption_theorem_on_random_mixtures(seed: int) -> None:
    """The same for random combinations of the rules, changed at random."""
    tableau = samples.changed(Random(seed))
    assert simplifying(tableau, 8).bound <= find_order(tableau, 8).order


def test_the_bound_is_not_sharp() -> None:
    """The theorem promises order 4 for the collocation example, and order 3 for its pair, which has
    order 4.
    """
    tableau = samples.everywhere(collocation, "gauss 2", "lobatto-iiia 3")
    assert simplifying(tableau).bound == find_order(tableau).order == 4
    assert simplifying(pair(tableau)).bound == 3
    assert find_order(pair(tableau)).order == 4


def test_the_pair_of_superconvergent_methods_may_have_a_lower_order() -> None:
    """Gauss 2 with Lobatto IIIA 4 by collocation: Q has order 4, its conjugate and their pair order
    2.
    """
    Q = samples.everywhere(collocation, "gauss 2", "lobatto-iiia 4")
    assert find_order(Q).order == brute_order(Q, 5) == 4
    assert find_order(pair(Q)).order == brute_order(pair(Q), 3) == 2


@pytest.mark.parametrize("rule", [collocation, interpolation])
def test_blocks_conjugate_to_each_other_keep_the_order(rule: Callable[..., Matrix]) -> None:
    """Built on the method of smaller order, with the opposite block its conjugate, the same pair
    has order 4.
    """
    Q = samples.by_conjugates(rule, "gauss 2", "lobatto-iiia 4")
    assert find_order(Q).order == find_order(pair(Q)).order == brute_order(pair(Q), 5) == 4
    assert conjugate(Q).block(0, 1) == Q.block(0, 1)
    assert conjugate(Q).block(1, 0) == Q.block(1, 0)


@pytest.mark.parametrize(("rule", "order"), [("collocation", 2), ("interpolation", 3)])
def test_blocks_conjugate_to_each_other_may_lose_the_order(rule: str, order: int) -> None:
    """The 3/8 rule, of order 4, with Gauss 3, of order 6."""
    methods = "[{A: [[0,0,0,0],[1/3,0,0,0],[-1/3,1,0,0],[1,-1,1,0]], b: [1/8,3/8,3/8,1/8]}, "
    methods += "{family: gauss, stages: 3}]"
    tableau = loads(f"methods: {methods}\ntransfer: symplectic-{rule}").tableau
    assert find_order(pair(tableau)).order == order


@pytest.mark.parametrize("rule", [collocation, interpolation])
@pytest.mark.parametrize(("l", "m"), sample([(l, m) for l, m in PAIRS if l < m], 4))
def test_nodes_of_the_conjugate(rule: Callable[..., Matrix], l: str, m: str) -> None:
    """Â^{l,m} 𝟙 = c^{l} exactly where D^{m,l}(1) holds."""
    Q = samples.everywhere(rule, l, m)
    D = simplifying(Q, 3).D
    for (k, n), is_consistent in consistent_blocks(conjugate(Q)).items():
        assert is_consistent == (D[n][k] != 0)


def test_the_bracket_of_the_semi_separable_conjugate() -> None:
    """(𝟙 − (B¹)⁻¹ (A^{2,1})ᵀ) B² is Â^{1,2}, with the row sums c¹; as printed, with B² inside, it
    has others.
    """
    Q = samples.everywhere(collocation, "gauss 2", "lobatto-iiia 3")
    A = tables.matrix(tables.RECTANGULAR_Q)
    b, b_other = tables.b_1, tables.b_2
    quotient = [[A[j][i] / b[i] for j in range(3)] for i in range(2)]
    printed = [[1 - quotient[i][j] * b_other[j] for j in range(3)] for i in range(2)]
    correct = tuple(tuple((1 - quotient[i][j]) * b_other[j] for j in range(3)) for i in range(2))
    assert tuple(sum(line, fmpq(0)) for line in correct) == tables.c_1
    assert tuple(sum(line, fmpq(0)) for line in printed) != tables.c_1
    made = at_points(symplectic_pair(Q, [0], [0, 1]), [tables.c_1, tables.c_2])
    assert made.block(0, 2) == correct


@pytest.mark.parametrize(
    ("velocities", "forces", "colours", "edges"),
    [
        ([0, 1], [0, 1], ["V1", "V2", "F1", "F2"], {(l, m) for l in range(4) for m in range(4)}),
        ([0], [0, 1], ["V1", "F1", "F2"], {(0, 0), (0, 1), (0, 2), (1, 0), (1, 1), (1, 2), (2, 0)}),
        ([0], [1], ["V1", "F2"], {(0, 1), (1, 0)}),
    ],
    ids=["general", "semi-separable", "separable"],
)
def test_special_cases(
    velocities: list[int], forces: list[int], colours: list[str], edges: set[tuple[int, int]]
) -> None:
    """Each special case has the colours and blocks of its tableau in the paper, is symplectic, and
    has order 4.
    """
    tableau = symplectic_pair(
        samples.everywhere(collocation, "gauss 2", "lobatto-iiia 3"), velocities, forces
    )
    assert [colour.name for colour in tableau.colours] == colours
    assert set(tableau.edges()) == edges
    assert is_symplectic(tableau)
    assert find_order(tableau).order == brute_order(tableau, 5) == 4


def test_the_pair_has_the_blocks_of_eq_vargark() -> None:
    """Rows l and l + N are the same; columns m and m + N hold A^{l,m} and Â^{l,m}."""
    Q = samples.everywhere(interpolation, "gauss 2", "lobatto-iiia 3", "radau-iia 2")
    P, both = conjugate(Q), pair(Q)
    assert both.size == 6
    for l in range(3):
        assert both.colours[l].b == both.colours[l + 3].b == Q.colours[l].b
        for m in range(3):
            assert both.block(l, m) == both.block(l + 3, m) == Q.block(l, m)
            assert both.block(l, m + 3) == both.block(l + 3, m + 3) == P.block(l, m)


def test_symplectic_diagonal_methods_are_their_own_conjugates() -> None:
    """Gauss and Lobatto IIID are symplectic; IIIA and IIIB, IIIC and IIIC*, are conjugate to each
    other.
    """
    for name in ("gauss 3", "lobatto-iiid 3"):
        alone = gark([samples.method(name)], {})
        assert is_symplectic(alone)
        assert conjugate(alone) == alone
    for name, other in (
        ("lobatto-iiia 3", "lobatto-iiib 3"),
        ("lobatto-iiic 3", "lobatto-iiic* 3"),
    ):
        alone = gark([samples.method(name)], {})
        assert not is_symplectic(alone)
        assert conjugate(alone) == gark([samples.method(other)], {})
