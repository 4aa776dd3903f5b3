"""Two models of one method: polynomials modulo M, and one number per stage."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from random import Random
from time import process_time

import pytest
from flint import arb, ctx, fmpq, fmpq_poly
from hypothesis import given
from hypothesis import strategies as st

from garkcli.errors import CoincidingNodes, ShapeMismatch
from garkcli.exact.display import to_ball, to_float
from garkcli.exact.field import Algebraic, Number
from garkcli.exact.matrix import Vector, apply, dot
from garkcli.families.registry import diagonal_method
from garkcli.order.certificate import find_order
from garkcli.order.meant import meant
from garkcli.order.simplifying import simplifying
from garkcli.tableau import polynomial_space
from garkcli.tableau.conjugate import conjugate
from garkcli.tableau.forms import gark, pair, spelled_out
from garkcli.tableau.pointwise import Cell, entries, in_points, numeric_entries
from garkcli.tableau.polynomial_space import PolynomialSpace, coordinates_at_nodes, powers_of_nodes
from garkcli.tableau.stages import PointSpace
from garkcli.tableau.tableau import Colour, Tableau, butcher
from garkcli.transfer import collocation
from tests.oracles import samples
from tests.oracles.draws import fractions
from tests.oracles.points import at_points, method_at, numbers, value
from tests.oracles.stages import product
from tests.whole import in_whole

NODES = numbers("1/2 - sqrt(3)/6, 1/2 + sqrt(3)/6", "0, 1/2, 1", "1/3, 1", "0, 2/3", "0, 1")
"""Over ℚ(√3), the nodes of Gauss 2, Lobatto 3, Radau IIA 2, Radau IA 2, Lobatto 2."""
NODES_OF = {
    "gauss 2": NODES[0],
    "lobatto-iiia 3": NODES[1],
    "lobatto-iiib 3": NODES[1],
    "radau-iia 2": NODES[2],
    "radau-ia 2": NODES[3],
    "lobatto-iiic 2": NODES[4],
    "lobatto-iiid 2": NODES[4],
}
names = st.sampled_from(sorted(NODES_OF))
seeds = st.integers(0, 10**6)
rationals = fractions(-9, 9, 12).map(lambda x: fmpq(x.numerator, x.denominator))


def both_models(one: str, other: str, seed: int) -> tuple[Tableau, Tableau]:
    """A random combination of the rules, in polynomials and at points."""
    dice = Random(seed)
    weights = [samples.small(dice) for _ in range(3)]
    rule = samples.mixture(*(str(x) for x in (*weights, 1 - sum(weights, fmpq(0)))))
    tableau = samples.everywhere(rule, one, other)
    return tableau, at_points(tableau, [NODES_OF[one], NODES_OF[other]])


@given(names, names, seeds)
def test_order_and_simplifying_conditions_agree(one: str, other: str, seed: int) -> None:
    """Orders, B, C and D in polynomials are those of the entries, computed componentwise over
    ℚ(√3).
    """
    polynomials, points = both_models(one, other, seed)
    assert find_order(points).order == find_order(polynomials).order
    assert simplifying(points, 10) == simplifying(polynomials, 10)


@given(names, names, seeds)
def test_conjugation_agrees(one: str, other: str, seed: int) -> None:
    """The entries of the conjugate are the conjugate of the entries; the same for the pair."""
    polynomials, points = both_models(one, other, seed)
    nodes = [NODES_OF[one], NODES_OF[other]]
    assert at_points(conjugate(polynomials), nodes) == conjugate(points)
    assert at_points(pair(polynomials), nodes) == pair(points)


@given(names, names)
def test_rules_agree(l: str, m: str) -> None:
    """Each transfer rule, applied to methods given entry by entry, makes the entries of the same
    block.
    """
    for rule in samples.RULES.values():
        here, there = (
            method_at(samples.method(l), NODES_OF[l]),
            method_at(samples.method(m), NODES_OF[m]),
        )
        tableau = samples.everywhere(rule, l, m)
        spelled = at_points(tableau, [NODES_OF[l], NODES_OF[m]])
        assert spelled.block(0, 1) == rule(here, there)
        assert spelled.block(1, 0) == rule(there, here)


@given(st.lists(rationals, min_size=1, max_size=4, unique=True), st.data())
def test_evaluation_is_a_homomorphism(nodes: list[fmpq], data: st.DataObject) -> None:
    """Products, functionals and Gram matrices of ℚ[x]/(M) are those of the values at the nodes."""
    modulus = fmpq_poly([1])
    for c in nodes:
        modulus *= fmpq_poly([-c, 1])
    space, points = PolynomialSpace(modulus), PointSpace(tuple(nodes))
    vectors = st.tuples(*[rationals] * len(nodes))
    u, v, weights = data.draw(vectors), data.draw(vectors), data.draw(vectors)

    def at_nodes(f: Vector) -> Vector:
        return tuple(value(f, c) for c in nodes)

    def functional(f: Vector) -> fmpq:
        return sum((w * x for w, x in zip(weights, at_nodes(f), strict=True)), fmpq(0))

    assert at_nodes(space.product(u, v)) == points.product(at_nodes(u), at_nodes(v))
    assert space.product(u, v) == product(space)(u, v)
    assert at_nodes(space.one) == points.one
    assert at_nodes(space.nodes) == points.nodes
    assert at_nodes(space.power(u, 3)) == points.power(at_nodes(u), 3)
    unit = [tuple(fmpq(int(i == j)) for j in range(len(nodes))) for i in range(len(nodes))]
    b = tuple(functional(e) for e in unit)
    assert space.times(b, v) == tuple(functional(space.product(v, e)) for e in unit)
    assert space.gram(b) == tuple(
        tuple(functional(space.product(e, f)) for f in unit) for e in unit
    )
    assert apply(points.lifts(), at_nodes(u)) == u
    powers = [tuple(c**k for c in nodes) for k in range(2 * len(nodes))]
    columns = list(zip(*space.reductions(2 * len(nodes)), strict=True))
    assert [at_nodes(column) for column in columns] == powers
    assert list(zip(*points.reductions(2 * len(nodes)), strict=True)) == powers


def test_functionals_with_radicals() -> None:
    """With irrational functionals and vectors, products and Gram matrices are what they are by
    definition.
    """
    space = diagonal_method("gauss", 3).space
    unit = [tuple(fmpq(int(i == j)) for j in range(3)) for i in range(3)]
    (b, v) = numbers("1/2 - sqrt(3)/6, sqrt(3), 0", "sqrt(3)/7, 2, 1 - sqrt(3)")
    for functional in (b, unit[1]):
        for f in (v, unit[2]):
            assert space.times(functional, f) == tuple(
                dot(functional, space.product(f, e)) for e in unit
            )
        rows = tuple(tuple(dot(functional, space.product(e, f)) for f in unit) for e in unit)
        assert space.gram(functional) == rows


def test_radicals_are_inverted_once(monkeypatch: pytest.MonkeyPatch) -> None:
    """Inverses in number fields take the time: one for each irrational weight, and a space is
    inverted once.
    """
    (weights, nodes, row) = numbers(
        "sqrt(2), cbrt(3), 1/2", "0, sqrt(2), 1", "cbrt(3), 1, sqrt(2)/5"
    )
    space, count = PointSpace(nodes), 0
    inverse = Algebraic.inverse

    def counted(x: Algebraic) -> Number:
        nonlocal count
        count += 1
        return inverse(x)

    monkeypatch.setattr(Algebraic, "inverse", counted)
    block = (row,) * 3
    adjoint = space.adjoint(block, row, space, weights)
    assert count == 2
    for i in range(3):
        for j in range(3):
            assert adjoint[i][j] * weights[i] == row[j] * block[j][i]
    lifts = space.lifts()
    before = count
    assert space.lifts() is lifts
    assert count == before
    assert apply(lifts, nodes) == (fmpq(0), fmpq(1), fmpq(0))


def test_nodes_are_as_precise_as_asked() -> None:
    """What is kept of the nodes belongs to one precision: 60 bits after 300, and 300 after 60."""
    space = diagonal_method("gauss", 7).space
    assert isinstance(space, PolynomialSpace)
    for bits in (300, 60, 300):
        with ctx.workprec(bits):
            V, W = powers_of_nodes(space), coordinates_at_nodes(space)
            assert all((V * W)[i, j].contains(int(i == j)) for i in range(7) for j in range(7))
            assert bits - 4 < V[3, 1].rel_accuracy_bits() < bits + 4
    with ctx.workprec(16), pytest.raises(ZeroDivisionError):
        coordinates_at_nodes(diagonal_method("gauss", 40).space)


@pytest.mark.parametrize("tolerance", [fmpq(0), pytest.param(fmpq(1, 10**12), marks=in_whole)])
def test_many_stages_are_soon_checked(tolerance: fmpq) -> None:
    """Gauss with 60 stages: B, C and D to order 60 in seconds of the processor, with and without
    tolerance.
    """
    before = process_time()
    found = simplifying(meant(gark([diagonal_method("gauss", 60)], {}), tolerance), 60)
    assert (found.r, found.eta, found.zeta) == (60, 60, 60)
    assert process_time() - before < 5


@given(st.lists(rationals, min_size=1, max_size=3, unique=True), st.data())
def test_adjoint(nodes: list[fmpq], data: st.DataObject) -> None:
    """⟨A f, g⟩ = ⟨f, A* g⟩ with the two bilinear forms, in both models."""
    modulus = fmpq_poly([1])
    for c in nodes:
        modulus *= fmpq_poly([-c, 1])
    here = data.draw(st.sampled_from([PolynomialSpace(modulus), PointSpace(tuple(nodes))]))
    source = samples.method("gauss 2").space
    s = len(nodes)
    nonzero = rationals.filter(bool)
    b = data.draw(st.tuples(*[nonzero] * s))
    b_source = samples.method("gauss 2").b
    A = data.draw(st.tuples(*[st.tuples(rationals, rationals)] * s))
    f, g = (data.draw(st.tuples(rationals, rationals)), data.draw(st.tuples(*[rationals] * s)))
    adjoint = here.adjoint(A, b, source, b_source)
    left = here.product(apply(A, f), g)
    right = source.product(f, apply(adjoint, g))
    assert sum((x * y for x, y in zip(b, left, strict=True)), fmpq(0)) == sum(
        (x * y for x, y in zip(b_source, right, strict=True)), fmpq(0)
    )


def test_nodes_beyond_the_largest_field_are_decimals() -> None:
    """Where nodes and coefficients together are too much for a field, entries are enclosures, as of
    Gauss 6.
    """
    (row,) = numbers("sqrt(2) + sqrt(7) + sqrt(11) + sqrt(13), 1")
    methods = [
        butcher(((row[0],),), (row[1],)),
        diagonal_method("gauss", 2),
        diagonal_method("lobatto-iiia", 4),
    ]
    blocks = {
        (l, m): collocation(methods[l], methods[m]) for l in range(3) for m in range(3) if l != m
    }
    tableau = gark(methods, blocks)
    assert in_points(tableau) is None
    found = entries(tableau, 20)
    assert not found.is_exact
    assert found.A[0][0] is not None
    assert abs(float(found.A[0][0][0][0]) - (2**0.5 + 7**0.5 + 11**0.5 + 13**0.5)) < 1e-12
    assert abs(float(found.c[2][1]) - (0.5 - 5**0.5 / 10)) < 1e-12


def test_entries_in_radicals_are_the_definition() -> None:
    """What is printed for Gauss 2 with Lobatto 3 is (A L_j)(c_i), as exact text."""
    tableau = samples.everywhere(collocation, "gauss 2", "lobatto-iiia 3")
    found, wanted = entries(tableau), at_points(tableau, NODES[:2])
    assert found.is_exact
    for l in range(2):
        assert [str(x) for x in found.c[l]] == [str(x) for x in wanted.colours[l].c]
        assert [str(x) for x in found.b[l]] == [str(x) for x in wanted.colours[l].b]
        for m in range(2):
            block, exact = found.A[l][m], wanted.block(l, m)
            assert block is not None
            assert exact is not None
            assert [[str(x) for x in row] for row in block] == [
                [str(x) for x in row] for row in exact
            ]


def test_printing_mixes_the_fields_of_nodes_and_coefficients() -> None:
    """A block with √5 between nodes with √3 is printed in ℚ(√3, √5), and has the same order."""
    tableau = samples.everywhere(
        samples.mixture("sqrt(5)", "1 - sqrt(5)", "0", "0"), "gauss 2", "lobatto-iiia 3"
    )
    found = in_points(tableau)
    assert found is not None
    assert found.field is not None
    assert found.field.degree == 4
    assert find_order(found).order == find_order(tableau).order
    numeric = numeric_entries(tableau, 17)
    for l in range(2):
        for m in range(2):
            block, enclosed = found.block(l, m), numeric.A[l][m]
            assert block is not None
            assert enclosed is not None
            for row, balls in zip(block, enclosed, strict=True):
                for x, ball in zip(row, balls, strict=True):
                    assert abs(to_float(x) - float(ball)) < 1e-14


@pytest.mark.parametrize(
    "names", [("gauss 3", "radau-iia 2"), ("lobatto-iiia 4", "gauss 2"), ("radau-ia 3",)]
)
def test_numeric_entries_enclose_the_exact_ones(names: tuple[str, ...]) -> None:
    """Enclosures hold the exact entries, are as narrow as asked, and are in ascending order of the
    nodes.
    """
    tableau = samples.everywhere(collocation, *names)
    exact, numeric = entries(tableau, 30), numeric_entries(tableau, 30)
    assert exact.is_exact
    assert not numeric.is_exact
    for l in range(tableau.size):
        nodes = [float(x) for x in numeric.c[l] if isinstance(x, arb)]
        assert nodes == sorted(nodes)
        assert_enclosed([exact.c[l], exact.b[l]], [numeric.c[l], numeric.b[l]])
        for m in range(tableau.size):
            assert_enclosed(exact.A[l][m] or (), numeric.A[l][m] or ())


def assert_enclosed(exact: Sequence[Sequence[Cell]], enclosures: Sequence[Sequence[Cell]]) -> None:
    """Each ball is narrow and meets a much narrower ball around the exact number."""
    assert len(exact) == len(enclosures) > 0
    for row, balls in zip(exact, enclosures, strict=True):
        for x, ball in zip(row, balls, strict=True):
            assert isinstance(ball, arb)
            assert not isinstance(x, arb)
            assert float(ball.rad()) < 1e-30
            assert ball.overlaps(to_ball(x, 60))


def test_nodes_without_simple_radicals_are_enclosed() -> None:
    """Gauss 6 has no simple radicals: entries are enclosures of the known first node."""
    found = entries(gark([samples.method("gauss 6")], {}), 20)
    assert not found.is_exact
    (first, *_), *_ = found.c
    assert isinstance(first, arb)
    assert abs(float(first) - 0.033765242898423986) < 1e-16


def test_coinciding_nodes_cannot_be_interpolated() -> None:
    """Two equal nodes leave no interpolating polynomial; the error names them."""
    with pytest.raises(CoincidingNodes, match="c_1 and c_3 are both 1/2"):
        PointSpace((fmpq(1, 2), fmpq(0), fmpq(1, 2))).lifts()


def test_blocks_have_the_shape_of_their_colours() -> None:
    """Wrong weights or blocks are refused when the tableau is made."""
    one = fmpq(1)
    with pytest.raises(ShapeMismatch, match="block 1,1"):
        spelled_out([[((one, one),)]], [(one,)], [(one,)])
    with pytest.raises(ShapeMismatch, match=r"b\^\{1\}"):
        Tableau((PointSpace((one,)),), (Colour("1", 0, (one, one), (one,)),), {})


@given(st.fractions(0, 1, max_denominator=9))
def test_nodes_default_to_row_sums(x: Fraction) -> None:
    """Without nodes, c^{l} are the row sums of A^{l,l}."""
    a = fmpq(x.numerator, x.denominator)
    tableau = spelled_out([[((a, 1 - a), (a, a))]], [(a, 1 - a)], [None])
    assert tableau.colours[0].c == (fmpq(1), 2 * a)


@in_whole
def test_many_stages_need_more_precision() -> None:
    """The nodes of Gauss 60 are too close for the first precision: it is doubled; rows of A sum to
    c.
    """
    found = numeric_entries(gark([diagonal_method("gauss", 60)], {}))
    A = found.A[0][0]
    assert A is not None
    for row, c in zip(A, found.c[0], strict=True):
        total = sum((x for x in row if isinstance(x, arb)), arb(0))
        assert total.overlaps(arb(c))


def test_nodes_are_isolated_once() -> None:
    """Entries of many stages need more precision than they are printed with; the roots, which take
    longest, are found once with enough of it.
    """
    tableau = gark([diagonal_method("radau-iia", 30)], {})
    polynomial_space._nodes.cache_clear()
    polynomial_space._powers_of_nodes.cache_clear()
    numeric_entries(tableau)
    assert polynomial_space._powers_of_nodes.cache_info().misses > 1
    assert polynomial_space._nodes.cache_info().misses == 1
