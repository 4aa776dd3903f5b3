"""When a symplectic pair keeps its order (docs/pair-order.md), against the certificate, which knows
nothing of B, C and D.
"""

from __future__ import annotations

import re
from collections import Counter
from pathlib import Path
from random import Random

import pytest
from flint import fmpq

from garkcli import load, loads
from garkcli.check.analysis import Analysis, analyse
from garkcli.check.check_file import check_method
from garkcli.check.pair_reasons import pair_reason, rule_reasons
from garkcli.methodfile.build import MethodFile
from garkcli.order.certificate import find_order
from garkcli.order.meant import as_meant
from garkcli.order.pair_order import pair_criterion
from garkcli.properties.reduction import is_plainly_irreducible
from garkcli.report.checked import REPORT
from garkcli.tableau.forms import gark, pair
from garkcli.tableau.tableau import Tableau
from tests.cli.harness import gark as command
from tests.oracles.brute import brute_order
from tests.oracles.points import numbers
from tests.order import random_pairs
from tests.order.own_pairs import compare
from tests.whole import at_most, in_whole

VALID = Path(__file__).parents[1] / "examples" / "valid"
THREE_EIGHTHS = (
    "{A: [[0, 0, 0, 0], [1/3, 0, 0, 0], [-1/3, 1, 0, 0], [1, -1, 1, 0]], b: [1/8, 3/8, 3/8, 1/8]}"
)
QUARTERS = "{A: [[0, 0, 0, 0], [1/4, 0, 0, 0], [-3/4, 3/2, 0, 0], [5, -6, 2, 0]], b: [1/18, 4/9, 4/9, 1/18]}"
NINTHS = "{A: [[0, 0, 0], [5/9, 0, 0], [-7/5, 12/5, 0]], b: [1/5, 27/40, 1/8]}"
LOBATTO = "{family: lobatto-iiia, stages: 3}"


def gauss(stages: int) -> str:
    """A member as it stands in a file."""
    return f"{{family: gauss, stages: {stages}}}"


def of_file(methods: tuple[str, ...], transfer: str) -> MethodFile:
    """A method with one rule."""
    return loads(f"methods: [{', '.join(methods)}]\ntransfer: {transfer}")


def analysis(method: MethodFile) -> Analysis:
    """All that ``gark check`` finds."""
    return analyse(method.tableau, tolerance=method.tolerance)


TABLE = [
    ((THREE_EIGHTHS, gauss(3)), "symplectic-collocation", 4, 2),
    ((THREE_EIGHTHS, gauss(3)), "symplectic-interpolation", 4, 3),
    ((THREE_EIGHTHS, LOBATTO), "interpolation", 4, 3),
    ((LOBATTO, THREE_EIGHTHS), "{rule: legendre, degree: 4}", 4, 2),
    ((LOBATTO, QUARTERS), "collocation", 4, 4),
    (("{family: kutta}", LOBATTO), "collocation", 3, 3),
    (("{family: radau-iia, stages: 2}", NINTHS), "collocation", 3, 3),
]


@pytest.mark.parametrize(("methods", "transfer", "least", "order"), TABLE)
def test_the_table_of_the_page(
    methods: tuple[str, ...], transfer: str, least: int, order: int
) -> None:
    """P of the diagonal methods and the order of their pair, by the certificate and the criterion."""
    alone = [loads(f"methods: [{text}]").tableau for text in methods]
    assert min(find_order(pair(x)).order for x in alone) == least
    tableau = of_file(methods, transfer).tableau
    assert find_order(pair(tableau)).order == order
    assert pair_criterion(tableau).order == order


def test_random_pairs_agree() -> None:
    """A part of ``make pairs``: the criterion, the rules, the space of all transfers."""
    dice, methods = Random(1), random_pairs.pool()
    orders = Counter()
    for _ in range(60):
        case = random_pairs.tableau(dice, methods)
        by_certificate, by_criterion = random_pairs.criterion_holds(case)
        assert by_certificate == by_criterion
        orders[by_certificate] += 1
    assert len(orders) >= 4
    said = Counter()
    for _ in range(20):
        said += random_pairs.rules_hold(dice, methods)
    assert said["collocation keeps"]
    assert said["collocation loses"]
    for _ in range(10):
        random_pairs.space_holds(dice, methods)


def test_the_criterion_tree_by_tree() -> None:
    """With all trees of order up to 4 in place of the certificate."""
    dice, methods = Random(2), random_pairs.pool()
    spelled = methods[-len(random_pairs.SPELLED) :]
    for _ in range(4):
        case = random_pairs.tableau(dice, spelled)
        found = min(pair_criterion(case).order, 4)
        assert brute_order(pair(case), 4) == found


@pytest.mark.parametrize(
    ("source", "orders"),
    [
        pytest.param("compose: {scheme: yoshida-6, of: implicit-midpoint}", (6, 4), marks=in_whole),
        pytest.param(
            "compose: {scheme: triple-jump, order: 6, of: implicit-midpoint}",
            (6, 4),
            marks=in_whole,
        ),
        (VALID / "negative-weights.gark.yaml", (3, 2)),
        (VALID / "negative-weights-order4.gark.yaml", (4, 2)),
    ],
)
def test_negative_weights(source: str | Path, orders: tuple[int, int]) -> None:
    """Irreducible methods whose pair has a higher order than the criterion says."""
    method = loads(source) if isinstance(source, str) else load(source)
    found = analysis(method)
    why = pair_reason(found)
    assert found.pair_order is not None
    assert why is not None
    assert (found.pair_order.order, why.order) == orders
    assert why.text.endswith("a larger order is not excluded: not all weights are positive")
    assert not why.is_sharp
    assert is_plainly_irreducible(method.tableau)


@pytest.mark.parametrize(("name", "order"), [("", 3), ("-order4", 4)])
def test_negative_weights_tree_by_tree(name: str, order: int) -> None:
    """The pair has its order and no higher one by all trees; D(1) fails by its definition."""
    tableau = load(VALID / f"negative-weights{name}.gark.yaml").tableau
    assert brute_order(pair(tableau), order + 1) == order
    A, b = tableau.block(0, 0), tableau.colours[0].b
    assert A is not None
    nodes = [sum(row, fmpq(0)) for row in A]
    columns = [sum((b[i] * A[i][j] for i in range(len(b))), fmpq(0)) for j in range(len(b))]
    assert columns != [b[j] * (1 - nodes[j]) for j in range(len(b))]


def test_a_reducible_method_with_negative_weights() -> None:
    """Its pair has order 4, where the criterion says 2."""
    rows = numbers(
        *("0,0,0,0,0", "5/24,1/3,-1/24,0,0", "1/6,2/3,1/6,0,0", "1/2,0,0,0,0", "1/2,0,0,0,0"),
        "1/6,2/3,1/6,1,-1",
    )
    *A, b = rows
    tableau = gark([random_pairs.butcher(tuple(A), b)], {})
    assert find_order(pair(tableau)).order == 4
    assert pair_criterion(tableau).order == 2


def reason(text: str | Tableau) -> str:
    """Why the pair of a file has its order."""
    found = pair_reason(analysis(loads(text)) if isinstance(text, str) else analyse(text))
    assert found is not None
    return found.text


def test_why_a_pair_has_its_order() -> None:
    """In words, for each case of the theorem."""
    two = "{family: gauss, stages: 2}, {family: lobatto-iiia, stages: 4}"
    assert reason(f"methods: [{two}]\ntransfer: collocation") == (
        "B(2) and the even condition; order 3 needs D(1) on block (1,2)"
    )
    assert reason(f"methods: [{two}]\ntransfer: legendre") == (
        "B(4), C(1), D(1) on every block and the even condition; order 5 needs B(5) on colour 1"
    )
    assert reason("A: [[0, 0], [1, 0]]\nb: [1/2, 1/2]") == (
        "B(2) and the even condition; order 3 needs B(3)"
    )
    assert reason("A: [[1/3]]\nb: [1]\nc: [1/2]") == "the nodes of colour 1 are not row sums"


def test_a_criterion_that_is_not_sharp_says_at_least(tmp_path: Path) -> None:
    """B(4) fails, and the order for a linear vector field is 4 all the same."""
    file = tmp_path / "lin.yaml"
    file.write_text('A: [["1/8", "-1/8"], ["7/24", "3/8"]]\nb: [1/4, 3/4]\nlinear: [1]\n')
    shown = command("check", "-v", str(file)).out
    assert re.search(r"symplectic pair +4, proved", shown)
    assert re.search(r"why this pair order +at least 3: B\(3\)", shown)


def test_which_hypothesis_does_not_hold() -> None:
    """Negative weights, and blocks that see and are not seen."""
    found = pair_reason(analyse(negative()))
    assert found is not None
    assert found.order == 2
    assert found.text.endswith("a larger order is not excluded: not all weights are positive")
    one_way = loads("tableau: {A: [[[[1/2]], [[1/2]]], [null, [[1/2]]]], b: [[1], [1]]}").tableau
    assert reason(one_way) == "colour 1 sees colour 2, which does not see it"


def negative() -> Tableau:
    """Weights (−1/2, 2, −1/2) at 0, 1/2, 1."""
    *A, b = numbers("0,0,0", "1/4,1/2,-1/4", "0,1,0", "-1/2,2,-1/2")
    return gark([random_pairs.butcher(tuple(A), b)], {})


def test_rules_that_keep_and_lose_the_order() -> None:
    """In words, by the numbers that decide it."""

    def said(methods: tuple[str, ...], transfer: str) -> list[str]:
        method = of_file(methods, transfer)
        return list(rule_reasons(analysis(method), method.rules))

    both = (gauss(2), "{family: lobatto-iiia, stages: 4}")
    assert said(both, "collocation") == [
        "collocation on (1,2): s = 4 > r − k = 3, loses symplectic pair order 4",
        "collocation on (2,1): s = 2 ≤ r − k = 3, keeps symplectic pair order 4",
    ]
    assert said(both, "legendre") == [
        "legendre on (1,2), (2,1): k = 1 ≤ K = 2 ≤ r − k = 3, keeps symplectic pair order 4"
    ]
    assert said((LOBATTO, THREE_EIGHTHS), "{rule: legendre, degree: 4}") == [
        "legendre on (1,2), (2,1): K = 4 > r − k = 3, C(1) and D(1) fail, loses symplectic pair order 4"
    ]
    assert said((LOBATTO, QUARTERS), "collocation") == [
        "collocation on (1,2): s = 4 = r − k + 1 and k E_l + s E_m = 0, keeps symplectic pair order 4",
        "collocation on (2,1): s = 3 ≤ r − k = 3, keeps symplectic pair order 4",
    ]
    assert said((THREE_EIGHTHS, LOBATTO), "interpolation") == [
        "interpolation on (1,2): degree 2, ρ − k = 3, keeps symplectic pair order 4",
        "interpolation on (2,1): degree 3, ρ − k = 3, loses symplectic pair order 4",
    ]
    assert said(both, "{collocation: 1/2, interpolation: 1/2}") == []


@pytest.mark.parametrize(
    "methods", [(LOBATTO, THREE_EIGHTHS), (gauss(2), LOBATTO), (gauss(3), THREE_EIGHTHS)]
)
@pytest.mark.parametrize(
    "transfer", [*(f"{{rule: legendre, degree: {K}}}" for K in range(5)), "interpolation"]
)
def test_every_rule_keeps_or_loses_what_the_trees_say(
    methods: tuple[str, ...], transfer: str
) -> None:
    """What numbers leave open the blocks decide: all rules keep pair order p exactly where the
    pair has it by the conditions of all trees.
    """
    method = of_file(methods, transfer)
    found = analysis(method)
    said = list(rule_reasons(found, method.rules))
    assert said
    assert all(re.search(r" (keeps|loses) symplectic pair order \d$", x) for x in said)
    p = int(said[0][-1])
    assert found.pair is not None
    assert all(" keeps " in x for x in said) == (find_order(found.pair, p).order == p)


def test_weights_of_the_pair_that_are_rounded() -> None:
    """Within a tolerance the criterion is that of the methods that the file may mean."""
    b = "[0.166666666666667, 0.666666666666667, 0.166666666666667]"
    text = f"A: [[0, 0, 0], [0.5, 0, 0], [-1, 2, 0]]\nb: {b}\n"
    rounded, exact = loads(f"{text}tolerance: 1e-14"), loads(text)
    assert pair_criterion(as_meant(rounded)).order == 3
    assert pair_criterion(as_meant(exact)).order == 0
    assert sum(exact.tableau.colours[0].b, fmpq(0)) != 1


def test_a_degree_that_loses_the_order_is_told_without_being_asked_for() -> None:
    """Legendre with K > r − k, in the usual report; what keeps the order is told with -v."""
    methods = (LOBATTO, THREE_EIGHTHS)
    text = render_check(of_file(methods, "{rule: legendre, degree: 4}"))
    assert "legendre on (1,2), (2,1): K = 4 > r − k = 3, C(1) and D(1) fail, loses" in " ".join(
        text.split()
    )
    assert "legendre on" not in render_check(of_file(methods, "{rule: legendre, degree: 3}"))


def render_check(method: MethodFile) -> str:
    """What gark check prints of it."""
    return REPORT.render([check_method(method)], "text")


def test_many_blocks_are_not_looked_at() -> None:
    """Thirteen methods have 156 blocks: more than the limit, which is said."""
    method = of_file((gauss(1),) * 13, "collocation")
    found = list(rule_reasons(analysis(method), method.rules))
    assert found == ["156 blocks were not examined for the order (limit 150)"]


@in_whole
def test_the_criterion_by_a_program_of_its_own() -> None:
    """Random methods in plain fractions: the criterion, written once more from the page, against the
    certificate, and some against all trees up to order 4; ``make pairs`` has more.
    """
    assert {1, 2, 3, 4} <= {*compare(at_most(15, 60), at_most(5, 12), seed=3)}
