"""Transfer matrices: from their definitions, in combinations, and as conjugates of each other."""

from __future__ import annotations

from math import lcm
from random import Random
from time import process_time

import pytest
from flint import fmpq, fmpq_poly
from hypothesis import given
from hypothesis import strategies as st

from garkcli.errors import BlockTooLarge, CoincidingNodes, ZeroWeight
from garkcli.exact.field import Number
from garkcli.exact.matrix import Matrix, Vector
from garkcli.order.certificate import find_order
from garkcli.order.simplifying import simplifying
from garkcli.tableau.conjugate import conjugate
from garkcli.tableau.forms import gark, pair
from garkcli.tableau.polynomial_space import PolynomialSpace
from garkcli.tableau.stages import PointSpace
from garkcli.tableau.tableau import Method, butcher
from garkcli.transfer import (
    PAIR_RULES,
    RULES,
    SUMMARIES,
    build_on,
    collocation,
    combination,
    conjugate_rule,
    interpolation,
    symplectic_blocks,
)
from tests.oracles import samples
from tests.oracles.draws import fractions
from tests.oracles.points import lagrange, numbers, value
from tests.oracles.stages import image
from tests.whole import in_whole

NAMES = [
    "gauss 1",
    "gauss 2",
    "gauss 3",
    "radau-ia 2",
    "radau-iia 3",
    "lobatto-iiia 3",
    "lobatto-iiic 4",
    "kutta",
]
names = st.sampled_from(NAMES)
rationals = fractions(-5, 5, 9).map(lambda x: fmpq(x.numerator, x.denominator))


@st.composite
def point_methods(draw: st.DrawFn) -> Method:
    """A method with random rational coefficients, distinct nodes and no zero weight."""
    s = draw(st.integers(1, 4))
    c = draw(st.lists(rationals, min_size=s, max_size=s, unique=True))
    b = draw(st.lists(rationals.filter(bool), min_size=s, max_size=s))
    A = draw(
        st.lists(st.lists(rationals, min_size=s, max_size=s).map(tuple), min_size=s, max_size=s)
    )
    return butcher(tuple(A), tuple(b), tuple(c))


def integral(f: Vector, x: fmpq) -> fmpq:
    """∫_0^x f."""
    return sum((a * x ** (k + 1) / (k + 1) for k, a in enumerate(f)), fmpq(0))


@given(point_methods(), point_methods())
def test_collocation_is_its_definition(l: Method, m: Method) -> None:
    """Eq. (coll): a_ij = ∫_0^{c_i} L_j, entry by entry."""
    wanted = tuple(tuple(integral(lagrange(m.c, j), c) for j in range(m.stages)) for c in l.c)
    assert collocation(l, m) == wanted


@given(point_methods(), point_methods())
def test_interpolation_is_its_definition(l: Method, m: Method) -> None:
    """Eq. (interp): L^{m}(c^{l}) A^{m,m}, entry by entry."""
    L = tuple(tuple(value(lagrange(m.c, j), c) for j in range(m.stages)) for c in l.c)
    wanted = tuple(
        tuple(sum((x * m.A[k][j] for k, x in enumerate(row)), fmpq(0)) for j in range(m.stages))
        for row in L
    )
    assert interpolation(l, m) == wanted


@given(point_methods(), point_methods())
def test_conjugate_rules_are_their_definition(l: Method, m: Method) -> None:
    """Eq. (wAhat): â_ij = b_j − b_j a_ji / b_i, from the block A^{m,l} of the rule."""
    for rule in (collocation, interpolation):
        a = rule(m, l)
        wanted = tuple(
            tuple(m.b[j] - m.b[j] * a[j][i] / l.b[i] for j in range(m.stages))
            for i in range(l.stages)
        )
        assert conjugate_rule(rule)(l, m) == wanted


@given(names, names, st.lists(rationals, min_size=len(RULES), max_size=len(RULES)))
def test_combinations_are_sums(l: str, m: str, weights: list[fmpq]) -> None:
    """Σ τ_k A_k entry by entry, with the rules in any order."""
    here, there = samples.method(l), samples.method(m)
    if not all(here.b):
        return
    blocks = [rule(here, there) for rule in RULES.values()]
    terms = list(zip(weights, RULES.values(), strict=True))
    found = combination(terms, here, there)
    for i in range(here.stages):
        for j in range(there.stages):
            assert found[i][j] == sum(
                (w * A[i][j] for w, A in zip(weights, blocks, strict=True)), fmpq(0)
            )
    assert combination(terms[::-1], here, there) == found


@given(names, names, rationals)
def test_combinations_integrate_low_degrees(l: str, m: str, tau: fmpq) -> None:
    """τ interpolation + (1 − τ) collocation integrates what m itself integrates, below degree s_m −
    1.
    """
    here, there = samples.method(l), samples.method(m)
    block = combination([(tau, interpolation), (1 - tau, collocation)], here, there)
    if not isinstance(here.space, PolynomialSpace) or not isinstance(there.space, PolynomialSpace):
        return
    for k in range(min(there.stages - 1, _stage_order(there))):
        power = tuple(fmpq(int(i == k)) for i in range(there.stages))
        integral_of_it = fmpq_poly([0] * (k + 1) + [fmpq(1, k + 1)]) % here.space.modulus
        assert image(block, power) == tuple(integral_of_it[i] for i in range(here.stages))


def _stage_order(method: Method) -> int:
    found = simplifying(gark([method], {}), 10).C[0][0]
    assert found is not None
    return found


@given(st.sampled_from(NAMES[:-1]), st.sampled_from(NAMES[:-1]), rationals)
def test_stage_order_does_not_depend_on_tau(l: str, m: str, tau: fmpq) -> None:
    """The corollary: C^{l,m}(min(η^{m,m}, s_m − 1)) holds for every τ, and beyond it for τ alone
    where it does.
    """
    tableau = samples.everywhere(samples.mixture(str(1 - tau), str(tau), "0", "0"), l, m)
    found = simplifying(tableau, 10).C
    for k, n in ((0, 1), (1, 0)):
        own, mixed = found[n][n], found[k][n]
        assert own is not None
        assert mixed is not None
        assert mixed >= min(own, tableau.space(n).stages - 1)


@pytest.mark.parametrize("rule", RULES)
def test_at_its_own_nodes_a_rule_gives_the_diagonal_back(rule: str) -> None:
    """Where c^{l} = c^{m} all rules give A^{m,m} of a symplectic collocation method."""
    method = samples.method("gauss 3")
    assert RULES[rule](method, method) == method.A


def test_rules_differ_where_the_method_is_no_collocation_method() -> None:
    """At its own nodes interpolation gives A^{m,m}, collocation the collocation method with those
    nodes.
    """
    ia = samples.method("radau-ia 2")
    assert interpolation(ia, ia) == ia.A
    assert collocation(ia, ia) != ia.A
    iiib, iiia = (samples.method("lobatto-iiib 3"), samples.method("lobatto-iiia 3"))
    assert collocation(iiib, iiib) == iiia.A


@given(
    st.sampled_from(NAMES[:-1]), st.sampled_from(NAMES[:-1]), st.sampled_from(sorted(PAIR_RULES))
)
def test_symplectic_blocks_are_conjugate_to_each_other(base: str, other: str, rule: str) -> None:
    """A^{other,base} is by the rule, and conjugating the tableau leaves both off-diagonal blocks as
    they are.
    """
    methods = [samples.method(base), samples.method(other)]
    blocks = symplectic_blocks(PAIR_RULES[rule], methods, 0, 1)
    assert blocks[1, 0] == PAIR_RULES[rule](methods[1], methods[0])
    Q = gark(methods, blocks)
    P = conjugate(Q)
    assert (P.block(0, 1), P.block(1, 0)) == (Q.block(0, 1), Q.block(1, 0))


SYMPLECTIC = [
    ("gauss 2", "lobatto-iiia 4"),
    ("gauss 2", "lobatto-iiia 3"),
    ("radau-iia 2", "gauss 2"),
    ("gauss 1", "gauss 3"),
    ("lobatto-iiia 3", "gauss 3"),
    ("radau-ia 2", "lobatto-iiic 3"),
]


@pytest.mark.parametrize("rule", PAIR_RULES)
@pytest.mark.parametrize("names", SYMPLECTIC)
def test_symplectic_rules_keep_the_smaller_order(rule: str, names: tuple[str, str]) -> None:
    """Built on the method of smaller order, Q and its pair have the smaller of the two orders."""
    methods = [samples.method(name) for name in names]
    orders = [find_order(gark([method], {})).order for method in methods]
    base = build_on(methods, orders, 0, 1)
    assert orders[base] == min(orders)
    Q = gark(methods, symplectic_blocks(PAIR_RULES[rule], methods, base, 1 - base))
    assert find_order(Q).order == find_order(pair(Q)).order == min(orders)


def test_what_a_symplectic_rule_builds_on() -> None:
    """Smaller order first, then fewer stages, then the lower number, whichever way round it is
    asked.
    """
    methods = [samples.method(name) for name in ("lobatto-iiia 3", "gauss 2", "gauss 1", "gauss 2")]
    orders = [4, 4, 2, 4]
    assert build_on(methods, orders, 0, 2) == build_on(methods, orders, 2, 0) == 2
    assert build_on(methods, orders, 0, 1) == build_on(methods, orders, 1, 0) == 1
    assert build_on(methods, orders, 1, 3) == build_on(methods, orders, 3, 1) == 1


def test_coinciding_nodes() -> None:
    """No rule interpolates through two equal nodes; at them it does."""
    rk4, gauss = samples.method("rk4"), samples.method("gauss 2")
    for rule in (collocation, interpolation):
        with pytest.raises(CoincidingNodes, match="c_2 and c_3 are both 1/2"):
            rule(gauss, rk4)
        assert len(rule(rk4, gauss)) == 4


def test_zero_weights() -> None:
    """A conjugate rule divides by the weights of l, not by those of m."""
    midpoint, gauss = (samples.method("explicit-midpoint"), samples.method("gauss 2"))
    with pytest.raises(ZeroWeight, match="b_1 = 0"):
        conjugate_rule(collocation)(midpoint, gauss)
    block: Matrix = conjugate_rule(collocation)(gauss, midpoint)
    assert len(block) == 2
    with pytest.raises(ZeroWeight):
        symplectic_blocks(collocation, [midpoint, gauss], 0, 1)
    assert set(symplectic_blocks(collocation, [gauss, midpoint], 0, 1)) == {(0, 1), (1, 0)}


def test_every_rule_has_its_line() -> None:
    """The summaries for people cover all rules and nothing else."""
    assert set(SUMMARIES) == set(RULES) | set(PAIR_RULES)


@pytest.mark.parametrize("seed", range(10))
def test_all_combinations_are_consistent(seed: int) -> None:
    """Weights that sum to 1 give A^{l,m} 𝟙 = c^{l} where all rules do."""
    dice = Random(seed)
    weights = [samples.small(dice) for _ in range(3)]
    rule = samples.mixture(*(str(x) for x in (*weights, 1 - sum(weights, fmpq(0)))))
    tableau = samples.everywhere(rule, "gauss 2", "lobatto-iiia 3")
    found = simplifying(tableau, 3).C
    assert all(x is not None and x >= 1 for row in found for x in row)


def unrelated_nodes(count: int, first_denominator: int) -> Vector:
    """Distinct fractions whose denominators have little in common."""
    return tuple(fmpq(k, first_denominator + 2 * k) for k in range(1, count + 1))


def at_nodes(c: Vector) -> Method:
    """A method with the nodes c, of which nothing else matters."""
    s = len(c)
    A = tuple((node,) + (fmpq(0),) * (s - 1) for node in c)
    return butcher(A, (fmpq(1, s),) * s, c)


@pytest.mark.parametrize("nodes", ["0, sqrt(2), 1, 1/3", "cbrt(2), 1 - cbrt(2), sqrt(3)"])
def test_collocation_at_irrational_nodes_is_its_definition(nodes: str) -> None:
    """Eq. (coll) where the nodes lie in a number field, at rational and at these nodes."""
    (c,) = numbers(nodes)
    m = at_nodes(c)
    for l in (m, at_nodes((fmpq(1, 7), fmpq(2)))):
        block = collocation(l, m)
        for i, x in enumerate(l.c):
            for j in range(m.stages):
                powers = enumerate(lagrange(m.c, j), start=1)
                integral_to_x: Number = fmpq(0)
                for k, a in powers:
                    integral_to_x = integral_to_x + a * x**k / k
                assert block[i][j] == integral_to_x


def test_thirty_unrelated_nodes_cost_little() -> None:
    """Interpolation through fractions without a common denominator is exact, and quick.

    The block integrates 1, x, …, x^(s−1), which determines it; elimination in the Vandermonde
    matrix took a hundred times as long.
    """
    m, l = at_nodes(unrelated_nodes(30, 10**40)), samples.method("gauss 2")
    start = process_time()
    block = collocation(l, m)
    assert process_time() - start < 5
    for k in (0, 1, 17, 29):
        power = tuple(c**k for c in m.c)
        wanted = fmpq_poly([0] * (k + 1) + [fmpq(1, k + 1)]) % l.space.modulus
        assert image(block, power) == (wanted[0], wanted[1])


def test_the_estimate_is_the_common_denominator() -> None:
    """The bits that a block is refused by are those of the denominators of the Lagrange
    polynomials.
    """
    nodes = unrelated_nodes(12, 100)
    leading = [lagrange(nodes, j)[-1] for j in range(12)]
    common = lcm(*(int(x.q) for x in leading))
    space = PointSpace(nodes)
    assert space.interpolation_bits(enough=0) == common.bit_length()
    assert space.interpolation_bits(enough=10**9) >= common.bit_length()


@in_whole
def test_what_would_fill_the_memory_is_refused() -> None:
    """400 unrelated nodes are refused by an estimate, in a moment, with the reason and a cure."""
    m, l = at_nodes(unrelated_nodes(400, 10**40)), samples.method("gauss 2")
    start = process_time()
    rules = [(collocation, l, m), (interpolation, l, m), (conjugate_rule(collocation), m, l)]
    for rule, here, there in rules:
        with pytest.raises(BlockTooLarge, match=r"400 nodes .* digits: too large") as caught:
            rule(here, there)
        assert "small denominators" in caught.value.help
    assert process_time() - start < 60
    assert len(collocation(m, l)) == 400


def test_many_nodes_of_one_denominator_are_not_refused() -> None:
    """100 nodes k/100 share their denominator: the estimate knows."""
    m = at_nodes(tuple(fmpq(k, 100) for k in range(100)))
    assert image(collocation(samples.method("gauss 2"), m), (fmpq(1),) * 100) == (0, 1)


def test_the_conjugate_of_long_entries_is_an_involution() -> None:
    """Conjugated twice, blocks whose denominators have nothing in common are what they were."""
    m, l = at_nodes(unrelated_nodes(20, 10**40)), samples.method("gauss 2")
    tableau = gark([l, m], {(0, 1): collocation(l, m), (1, 0): collocation(m, l)})
    once = conjugate(tableau)
    assert once.block(0, 1) != tableau.block(0, 1)
    assert conjugate(once).blocks == tableau.blocks
