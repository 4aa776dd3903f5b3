"""All transfers with a pair order, and the one of least error (docs/pair-order.md), against
conditions of trees.
"""

from __future__ import annotations

from fractions import Fraction
from random import Random

import pytest
from flint import fmpq

from garkcli import find_parameters, loads, loads_family, minimise, render
from garkcli.design import design as engine
from garkcli.design.ideal import Ideal
from garkcli.design.member import is_admissible, member
from garkcli.design.pairs import least_error, pair_conditions
from garkcli.design.solutions import Solution, solutions
from garkcli.methodfile.family import with_values
from garkcli.order.certificate import find_order
from garkcli.order.constants import error_constants
from garkcli.tableau.family import Family
from garkcli.tableau.forms import gark, pair
from garkcli.tableau.tableau import Tableau
from garkcli.transfer import legendre
from tests.oracles import samples
from tests.order.random_pairs import member as block_of
from tests.whole import in_whole


def unknown(*methods: tuple[str, int]) -> Family:
    """Members of families, every block between them unknown."""
    texts = [f"{{family: {name}, stages: {s}}}" for name, s in methods]
    return loads_family(f'methods: [{", ".join(texts)}]\ntransfer: "?"')


def test_unknown_blocks() -> None:
    """A ? in place of a block means one for each entry; all blocks, or one; the file that is
    written has the matrices.
    """
    head = "methods: [{family: gauss, stages: 1}, {family: lobatto-iiia, stages: 2}]\n"
    rows = '{"1,2": [["?", "?"]], "2,1": [["?"], ["?"]]}'
    every = loads_family(f'{head}transfer: "?"')
    spelled = loads_family(f"{head}transfer: {{blocks: {rows}}}")
    assert every.parameters == spelled.parameters == ("a12_11", "a12_12", "a21_11", "a21_21")
    assert str(every.tableau.blocks) == str(spelled.tableau.blocks)
    single = loads_family(
        f'{head}transfer: {{default: interpolation, blocks: {{"1,2": "?"}}}}\nexpect: {{order: 1}}'
    )
    assert single.parameters == ("a12_11", "a12_12")
    for family in (every, single):
        values = {name: f"{k}/8" for k, name in enumerate(family.parameters, 1)}
        written = loads(with_values(family, values, "head", "pair-order: 1"))
        assert written.tableau.block(0, 1) == ((fmpq(1, 8), fmpq(2, 8)),)
        expected = ((fmpq(3, 8),), (fmpq(4, 8),)) if family is every else ((fmpq(1, 2),),) * 2
        assert written.tableau.block(1, 0) == expected


@pytest.mark.parametrize("methods", ["gauss-2, lobatto-iiia-4", "lobatto-iiia-4, gauss-2"])
def test_legendre_beside_an_unknown_block(methods: str) -> None:
    """Its degree is that of the orders of the methods, radicals among their coefficients or not."""

    def block(rule: str) -> str:
        transfer = f'{{default: {rule}, blocks: {{"1,2": "?"}}}}'
        return str(loads_family(f"methods: [{methods}]\ntransfer: {transfer}").tableau.block(1, 0))

    assert block("legendre") == block("{rule: legendre, degree: 2}")
    assert block("legendre") != block("{rule: legendre, degree: 1}")


def dimension(stages: list[int], order: int) -> int:
    """Σ ((s_l − k)(s_m − k) − [p even]) over pairs l ≠ m."""
    k = (order - 1) // 2
    return sum(
        (s - k) * (t - k) - (order % 2 == 0)
        for l, s in enumerate(stages)
        for m, t in enumerate(stages)
        if l != m
    )


@pytest.mark.parametrize(
    ("methods", "order"),
    [
        ((("gauss", 2), ("lobatto-iiia", 4)), 4),
        ((("gauss", 2), ("lobatto-iiia", 3)), 4),
        ((("radau-iia", 2), ("gauss", 2)), 3),
        ((("gauss", 1), ("rk4", 4)), 2),
        ((("gauss", 2), ("gauss", 1), ("lobatto-iiia", 2)), 2),
    ],
)
def test_the_dimension_of_all_transfers(methods: tuple[tuple[str, int], ...], order: int) -> None:
    """For each order up to p that of the theorem; a random real member has order p by the
    certificate.
    """
    family = unknown(*methods)
    found = find_parameters(family, order, "pair")
    stages = [s for _, s in methods]
    for step in found.steps[1:]:
        assert step.ideal is not None
        assert step.ideal.dimension == dimension(stages, step.order)
    assert found.last.known.is_real
    assert [found.is_of_real_values(x) for x in found.steps] == [x.order > 2 for x in found.steps]
    assert len(found.steps) == order
    conditions, ideal = pair_conditions(family), found.last.ideal
    assert conditions is not None
    assert ideal is not None
    tableau = drawn(family, ideal, Random(1))
    assert find_order(pair(tableau)).order == order


@in_whole
def test_a_pair_order_that_is_wanted() -> None:
    """It goes by the criterion too: the dimension of the theorem, a random method whose pair has
    the order by the certificate, and words for real values. Up to order 2 and for unknown weights
    it is all conditions.
    """
    wanted = 'methods: [gauss-2, lobatto-iiia-4]\ntransfer: "?"\ndesign: {pair-order: 4}'
    family = loads_family(wanted)
    found = find_parameters(family)
    *_, last, none = found.steps
    assert (last.order, last.kind, none.kind) == (4, "family", "none")
    assert last.ideal is not None
    assert last.ideal.dimension == dimension([2, 4], 4)
    assert found.is_of_real_values(last)
    tableau = drawn(family, last.ideal, Random(2))
    assert find_order(tableau).order == find_order(pair(tableau)).order == 4
    text = " ".join(render(found).split())
    assert "the zeros, real ones by B, C, D and the even condition, of" in text
    assert "order 5 for no real value" in text
    assert "no real value: with the conditions before it, that of [[[[[]_1]_1]_1]_1]_1" in text
    unknown_weight = "A: [[1/2]]\nb: ['?']\ndesign: {pair-order: 3}"
    for text in (wanted.replace("4}", "2}"), unknown_weight):
        assert not loads_family(text).real


def drawn(family: Family, ideal: Ideal, dice: Random) -> Tableau:
    """A member with random values of the unknowns that are free."""
    conditions = pair_conditions(family)
    assert conditions is not None
    solved = conditions.solved(ideal)
    assert solved is not None
    leading = {next(i for i, k in enumerate(p.monoms()[0]) if k) for p in solved}
    free = [i for i in range(len(family.parameters)) if i not in leading]
    values = {i: fmpq(dice.randint(-9, 9), dice.randint(1, 9)) for i in free}
    return one(family, ideal.with_values(values))


def one(family: Family, ideal: Ideal) -> Tableau:
    """The method of an ideal with one admissible zero."""
    found = [x for x in solutions(ideal) if any(is_admissible(family, x, root) for root in x.real)]
    solution: Solution = found[0]
    return member(family.tableau, family.ring, solution.values)


@in_whole
def test_trees_ask_for_the_same(monkeypatch: pytest.MonkeyPatch) -> None:
    """Gauss 1 and Lobatto IIIA 2, Gauss 2 and Lobatto IIIA 3: the conditions of all trees have the
    zeros that the criterion has.
    """
    for methods, order in (
        ((("gauss", 1), ("lobatto-iiia", 2)), 2),
        ((("gauss", 2), ("lobatto-iiia", 3)), 4),
    ):
        family = unknown(*methods)
        by_criterion = find_parameters(family, order, "pair").last.ideal
        with monkeypatch.context() as patch:
            patch.setattr(engine, "pair_conditions", lambda _: None)
            by_trees = find_parameters(family, order, "pair").last.ideal
        assert by_criterion is not None
        assert by_trees is not None
        assert by_trees.dimension == by_criterion.dimension
        assert all(by_trees.contains(p) for p in by_criterion.without_unit)
        assert all(by_criterion.contains(p) for p in by_trees.without_unit)


def squared_error(tableau: Tableau, order: int) -> float:
    """Σ e(u)² over the trees of the next order, in floats."""
    found = error_constants(pair(tableau), order + 1)
    return float(found.all.two) ** 2


@in_whole
def test_the_least_error_of_gauss_2_and_lobatto_4() -> None:
    """√(31811/2332800), of all methods with order 4; at random other transfers it is larger by all
    trees, and the exact coefficients are those of the Legendre transfer.
    """
    family = unknown(("gauss", 2), ("lobatto-iiia", 4))
    design = find_parameters(family, 4, "pair")
    found = minimise(design, "error")
    assert found.value is not None
    assert found.value.exact == fmpq(31811, 2332800)
    assert found.extent == "all"
    ideal = design.last.ideal
    conditions = pair_conditions(family)
    assert ideal is not None
    assert conditions is not None
    best = least_error(conditions, 4, ideal)
    assert best is not None
    least = one(family, best)
    assert least.blocks[1, 0][3] == (fmpq(1, 2), fmpq(1, 2))
    assert least.blocks[0, 1][0][0] == fmpq(1, 12)
    wanted = float(Fraction(31811, 2332800))
    assert squared_error(samples.everywhere(legendre, "gauss 2", "lobatto-iiia 4"), 4) == (
        pytest.approx(wanted, rel=1e-9)
    )
    for seed in range(3):
        assert squared_error(other(seed, "gauss 2", "lobatto-iiia 4", 4), 4) > wanted * 1.001


def other(seed: int, first: str, second: str, order: int) -> Tableau:
    """Two methods with random transfers whose pair has an order."""
    dice, l, m = Random(seed), samples.method(first), samples.method(second)
    blocks = {(0, 1): block_of(dice, l, m, order), (1, 0): block_of(dice, m, l, order)}
    return gark([l, m], blocks)


@in_whole
def test_the_least_error_of_odd_order() -> None:
    """Radau IIA 2 and Gauss 2 with p = 3: Legendre with K = 1, and no random transfer has less."""
    design = find_parameters(unknown(("radau-iia", 2), ("gauss", 2)), 3, "pair")
    found = minimise(design, "error")
    assert found.value is not None
    assert found.extent == "all"
    least = float(found.value)
    by_rule = samples.everywhere(legendre, "radau-iia 2", "gauss 2")
    assert squared_error(by_rule, 3) == pytest.approx(least, rel=1e-9)
    for seed in range(6):
        assert squared_error(other(seed, "radau-iia 2", "gauss 2", 3), 3) > least


def test_where_the_theorem_says_nothing() -> None:
    """Case (c): with Lobatto IIIC 3, whose B(5) does not hold, Legendre is not the least; nor is
    anything said where weights are unknown, or not positive.
    """
    family = unknown(("gauss", 2), ("lobatto-iiic", 3))
    conditions = pair_conditions(family)
    assert conditions is not None
    ideal = find_parameters(family, 4, "pair").last.ideal
    assert ideal is not None
    assert least_error(conditions, 4, ideal) is None
    text = "methods: [{A: [[1/2]], b: [t]}, {A: [[1/2]], b: [1]}]\nparameters: {t: free}\ntransfer: collocation"
    assert pair_conditions(loads_family(text)) is None
    negative = "{A: [[0, 0, 0], [1/4, 1/2, -1/4], [0, 1, 0]], b: [-1/2, 2, -1/2]}"
    text = f'methods: [{negative}, {{A: [[1/2]], b: [1]}}]\ntransfer: "?"'
    assert pair_conditions(loads_family(text)) is None


def test_an_order_that_the_diagonal_methods_have_not() -> None:
    """Order 5 with Gauss 2: no real value, whatever the transfers."""
    found = find_parameters(unknown(("gauss", 2), ("lobatto-iiia", 3)), 5, "pair")
    assert found.last.kind == "none"
    assert found.reaches(4) is True
    assert found.reaches(5) is False
