"""The orders of embedded weights and of dense output, against every tree one by one and against
steps as power series, which know no trees.
"""

from __future__ import annotations

import json
from collections.abc import Sequence
from pathlib import Path
from random import Random
from typing import TypeVar

import pytest
from flint import fmpq
from hypothesis import given, settings
from hypothesis import strategies as st

from garkcli.check.analysis import Analysis, analyse
from garkcli.errors import ShapeMismatch
from garkcli.exact.field import Number
from garkcli.exact.matrix import Matrix, Vector
from garkcli.families.registry import diagonal_method
from garkcli.frozen import replace
from garkcli.methodfile.build import MethodFile
from garkcli.methodfile.load import loads
from garkcli.order.admissible import elementary_weight
from garkcli.order.certificate import find_order
from garkcli.order.dense import DenseOrder, dense_order, ends_at_step, slopes
from garkcli.order.meant import meant
from garkcli.tableau.embedded import DenseOutput, Further, with_weights
from garkcli.tableau.forms import gark, spelled_out
from garkcli.tableau.tableau import Tableau
from tests.oracles import samples
from tests.oracles.brute import Trees, Weights, brute_order, density, order_of, plain
from tests.oracles.series import random_problem, series_order, step
from tests.whole import at_most, in_whole, sample

T = TypeVar("T")
PAIRS = json.loads((Path(__file__).parent / "pairs.json").read_text())
"""Published tables with their orders, from the code libraries that run them."""
TOLERANCE = fmpq(1, 10**11)
ROUNDED = 16


@pytest.fixture(scope="module")
def judged() -> dict[str, tuple[MethodFile, Analysis]]:
    """Each of the published tables with what is found of it."""
    found = {}
    for name, pair in PAIRS.items():
        method = loads(pair["file"])
        analysis = analyse(method.tableau, 12, method.tolerance, further=method.further)
        found[name] = method, analysis
    return found


@pytest.mark.parametrize("name", PAIRS)
def test_published_pairs_have_the_orders_that_are_known(
    name: str, judged: dict[str, tuple[MethodFile, Analysis]]
) -> None:
    """Order, embedded order, and the order with time where a printed node is wrong."""
    _, found = judged[name]
    pair = PAIRS[name]
    assert found.order.order == pair["order"]
    assert found.nonautonomous_order is not None
    assert found.nonautonomous_order.order == pair["time"]
    embedded = None if found.embedded is None else found.embedded.order.order
    assert embedded == pair["embedded"]


EXACT = [
    name for name, pair in PAIRS.items() if pair["embedded"] and "tolerance" not in pair["file"]
]


@pytest.mark.parametrize("name", EXACT)
def test_the_embedded_order_is_that_of_the_oracles(
    name: str, judged: dict[str, tuple[MethodFile, Analysis]]
) -> None:
    """Trees one by one say the same order, a step as a power series does where it is small, and
    the witness fails by what is said.
    """
    method, found = judged[name]
    assert found.embedded is not None
    assert method.embedded is not None
    order = found.embedded.order
    tableau = with_weights(method.tableau, method.embedded)
    assert brute_order(tableau, order.order + 1) == order.order
    if order.order < 4:
        assert series_order(tableau, order.order + 1) == order.order
    assert order.witness is not None
    tree = plain(order.witness.tree)
    assert Weights(tableau).weight(tree) == order.witness.value
    assert order.witness.required == fmpq(1, density(tree))
    assert order_of(tree) == order.order + 1


@pytest.mark.parametrize("name", EXACT)
def test_the_estimate_is_that_of_all_trees(
    name: str, judged: dict[str, tuple[MethodFile, Analysis]]
) -> None:
    """The leading order is the first at which a weight differs, and the norm is that of the
    differences over σ, summed tree by tree.
    """
    method, found = judged[name]
    assert found.embedded is not None
    assert method.embedded is not None
    estimate = found.embedded.estimator
    tableau = method.tableau
    other = with_weights(tableau, method.embedded)
    trees = Trees(tableau)
    squares: Number = fmpq(0)
    for order in range(1, 9):
        for u in trees.of_order(order):
            gap = Weights(tableau).weight(u) - Weights(other).weight(u)
            gap = gap / symmetry(u)
            squares = squares + gap * gap
        if squares:
            break
    assert estimate.order == order
    assert estimate.constants is not None
    assert estimate.constants.all.two_squared == squares
    assert not estimate.is_zero
    assert list(estimate.sums) == [fmpq(0)] * tableau.size


def symmetry(u: object) -> int:
    """σ(u), by counting equal branches."""
    _, branches = u  # type: ignore[misc]
    result, run = 1, 0
    for number, branch in enumerate(branches):
        is_again = number > 0 and branch == branches[number - 1]
        run = run + 1 if is_again else 1
        result *= run * symmetry(branch)
    return result


@pytest.mark.parametrize("name", sample(EXACT, 3))
def test_rounding_within_a_tolerance_changes_no_order(
    name: str, judged: dict[str, tuple[MethodFile, Analysis]]
) -> None:
    """Coefficients rounded to 16 digits have the same orders, estimate and sums within it."""
    method, exact = judged[name]
    assert method.embedded is not None
    tableau = rounded_tableau(method.tableau)
    further = Further(tuple(map(rounded, method.embedded)))
    found = analyse(tableau, 12, TOLERANCE, further=further)
    assert found.embedded is not None
    assert exact.embedded is not None
    assert found.embedded.order.order == exact.embedded.order.order
    one, other = found.embedded.estimator, exact.embedded.estimator
    assert one.order == other.order
    assert one.sums == other.sums
    assert one.constants is not None
    assert other.constants is not None
    assert one.constants.all.two == pytest.approx(other.constants.all.two)


def rounded(row: Vector) -> Vector:
    """The numbers of a row to 16 decimals."""
    scale = 10**ROUNDED
    return tuple(fmpq(round(float(str_of(x)) * scale), scale) for x in row)


def str_of(number: Number) -> str:
    """A number in enough digits for a float."""
    from garkcli.exact.display import to_decimal

    return to_decimal(number, 17)


def rounded_tableau(tableau: Tableau) -> Tableau:
    """The tableau with rounded blocks and weights."""
    blocks: dict[tuple[int, int], Matrix] = {}
    for key, block in tableau.blocks.items():
        blocks[key] = tuple(map(rounded, block))
    colours = tuple(replace(x, b=rounded(x.b)) for x in tableau.colours)
    return replace(tableau, blocks=blocks, colours=colours)


def test_weights_that_are_b_estimate_nothing() -> None:
    """The estimate of b against itself is zero, and said so; so is its order not a number."""
    method = loads("A: [[0, 0], [1, 0]]\nb: [1/2, 1/2]\nembedded: [1/2, 1/2]")
    found = analyse(method.tableau, further=method.further)
    assert found.embedded is not None
    assert found.embedded.order == found.order
    assert found.embedded.estimator.is_zero
    assert found.embedded.estimator.order is None


ALIKE = """A: [[0, 0, 0], [1/3, 0, 0], [0, 1/3, 0]]
b: [0, 1, 0]
embedded: [0, 0, 1]
"""


def test_equal_orders_may_agree_beyond_them() -> None:
    """Of two rows of the same order the estimate begins at the first tree that tells them apart,
    here two orders further on; b of order 1 misses order 2 with both alike.
    """
    method = loads(ALIKE)
    for tolerance in (None, TOLERANCE):
        found = analyse(method.tableau, 60, tolerance, further=method.further)
        assert found.embedded is not None
        assert (found.order.order, found.embedded.order.order) == (1, 1)
        assert found.embedded.estimator.order == 3


def test_an_unknown_space_has_no_weights_of_stages() -> None:
    """The stages of a family in its algebra have no weights one by one, and that is refused."""
    tableau = gark([diagonal_method("gauss", 3)], {})
    with pytest.raises(ShapeMismatch, match="single stages"):
        with_weights(tableau, ((fmpq(1), fmpq(0), fmpq(0)),))


# dense output

HERMITE = """A: [[], [1/2], [0, 3/4], [2/9, 1/3, 4/9]]
b: [2/9, 1/3, 4/9, 0]
dense: {degree: 3, weights: [[1, -4/3, 5/9], [0, 1, -2/3], [0, 4/3, -8/9], [0, -1, 1]]}
"""
RK4 = """A: [[], [1/2], [0, 1/2], [0, 0, 1]]
b: [1/6, 1/3, 1/3, 1/6]
dense: {degree: 3, weights: [[1, -3/2, 2/3], [0, 1, -2/3], [0, 1, -2/3], [0, -1/2, 2/3]]}
"""
DORMAND_PRINCE = """A: [[], [1/5], [3/40, 9/40], [44/45, -56/15, 32/9],
  [19372/6561, -25360/2187, 64448/6561, -212/729],
  [9017/3168, -355/33, 46732/5247, 49/176, -5103/18656],
  [35/384, 0, 500/1113, 125/192, -2187/6784, 11/84]]
b: [35/384, 0, 500/1113, 125/192, -2187/6784, 11/84, 0]
dense:
  degree: 4
  weights:
    - [1, -8048581381/2820520608, 8663915743/2820520608, -12715105075/11282082432]
    - [0, 0, 0, 0]
    - [0, 131558114200/32700410799, -68118460800/10900136933, 87487479700/32700410799]
    - [0, -1754552775/470086768, 14199869525/1410260304, -10690763975/1880347072]
    - [0, 127303824393/49829197408, -318862633887/49829197408, 701980252875/199316789632]
    - [0, -282668133/205662961, 2019193451/616988883, -1453857185/822651844]
    - [0, 40617522/29380423, -110615467/29380423, 69997945/29380423]
"""
BLOCKS = """tableau:
  A: [[[[0, 0], [1, 0]], [[0], [1]]], [[[1/4, 1/4]], [[1/2]]]]
  b: [[1/2, 1/2], [1]]
  dense: {degree: 2, weights: [[[1, -1/2], [0, 1/2]], [[1, 0]]]}
"""
LINEAR = """A: [[0, 0], [1, 0]]
b: [1/2, 1/2]
linear: [1]
dense: {degree: 2, weights: [[1, -1/2], [0, 1/2]]}
"""
DENSE = {
    "Hermite on Bogacki-Shampine": (HERMITE, 3, True, True),
    "RK4 with order 3": (RK4, 3, True, False),
    "Dormand-Prince": (DORMAND_PRINCE, 4, True, True),
    "two colours": (BLOCKS, 1, True, False),
    "a linear colour": (LINEAR, 2, True, False),
}


def scaled(tableau: Tableau, dense: DenseOutput, theta: fmpq) -> Tableau:
    """The method with steps of θh whose result is the dense output at θ."""
    weights = [tuple(x / theta for x in row) for row in dense.at(theta)]
    blocks = {
        key: tuple(tuple(x / theta for x in row) for row in block)
        for key, block in tableau.blocks.items()
    }
    return with_weights(replace(tableau, blocks=blocks), tuple(weights))


def order_by_values(tableau: Tableau, dense: DenseOutput, limit: int) -> int:
    """The order for all θ, by so many values of θ that polynomials of the degree are told apart."""
    count = max(dense.degree, limit)
    thetas = [fmpq(k, 2) for k in range(1, count + 1)]
    orders = [brute_order(scaled(tableau, dense, x), limit) for x in thetas]
    return min(orders)


@pytest.mark.parametrize("name", DENSE)
def test_dense_output_has_its_order_for_every_theta(name: str) -> None:
    """The identities in θ hold up to the order and fail after it: so say the spans, and all trees
    at as many θ as the degree asks for.
    """
    text, order, _, _ = DENSE[name]
    method = loads(text)
    assert method.dense is not None
    found = dense_order(method.tableau, method.dense, 20)
    assert found.order == order
    limit = order + 1
    assert order_by_values(method.tableau, method.dense, limit) == order


@pytest.mark.parametrize("name", DENSE)
def test_the_witness_of_dense_output_fails_as_it_says(name: str) -> None:
    """The coefficient of the power of θ in the condition of the tree is the value that is told."""
    method = loads(DENSE[name][0])
    assert method.dense is not None
    witness = dense_order(method.tableau, method.dense, 20).witness
    assert witness is not None
    tree, power = witness.witness.tree, witness.power
    value: Number = fmpq(0)
    if power <= method.dense.degree:
        row = with_weights(method.tableau, method.dense.coefficients(power))
        value = elementary_weight(row, tree)
    assert value == witness.witness.value
    required = fmpq(int(power == tree.order), tree.density)
    assert required == witness.witness.required
    assert value != required


def test_dense_output_as_a_power_series() -> None:
    """Steps of θh as power series, without trees, have the order of the dense output at each θ."""
    for name, (text, order, _, _) in DENSE.items():
        method = loads(text)
        assert method.dense is not None
        thetas = [fmpq(1, 3), fmpq(2, 3), fmpq(4, 3)]
        stepped = [scaled(method.tableau, method.dense, x) for x in thetas]
        least = min(series_order(x, order + 1) for x in stepped)
        assert least == order, name


@pytest.mark.parametrize("name", DENSE)
def test_ends_and_slopes(name: str) -> None:
    """Dense output ends at the step where b(1) = b, and has slopes that fit where its first and
    last stages see x_0 and x_1; one coefficient changed, and neither holds.
    """
    text, _, ends, smooth = DENSE[name]
    method = loads(text)
    assert method.dense is not None
    tableau, dense = method.tableau, method.dense
    assert ends_at_step(tableau, dense) == ends
    assert slopes(tableau, dense).are_continuous is smooth
    near = slopes(meant(tableau, TOLERANCE), dense)
    assert near == slopes(tableau, dense)
    first = ((dense.weights[0][0][0] + 1, *dense.weights[0][0][1:]),)
    rows = (*first, *dense.weights[0][1:])
    changed = DenseOutput((rows, *dense.weights[1:]))
    assert not ends_at_step(tableau, changed)
    assert slopes(tableau, changed).at_start is False


@pytest.mark.parametrize("name", DENSE)
def test_the_slope_at_the_start_as_a_power_series(name: str) -> None:
    """Σ b'(0) k is f(x_0) where its power series in h has no further terms, and only there."""
    method = loads(DENSE[name][0])
    assert method.dense is not None
    slope = with_weights(method.tableau, method.dense.coefficients(1))
    problem = random_problem(slope, 3, Random(5))
    series = step(slope, problem, 4)
    is_constant = not any(x for row in series.values() for x in row[2:])
    start = slopes(method.tableau, method.dense).at_start
    assert start is is_constant


@st.composite
def outputs(draw: st.DrawFn) -> tuple[Tableau, DenseOutput]:
    """A tableau of random colours, with dense output that is nearly that of Heun's method."""
    seed = draw(st.integers(0, 10**6))
    dice = Random(seed)
    degree = draw(st.integers(1, 3))
    heun = loads(BLOCKS if draw(st.booleans()) else LINEAR)
    if draw(st.booleans()):
        tableau = samples.random_additive(dice)
        blocks = [
            tuple(tuple(samples.small(dice) for _ in range(degree)) for _ in colour.b)
            for colour in tableau.colours
        ]
        return tableau, DenseOutput(tuple(blocks))
    assert heun.dense is not None
    rows = [list(row) for row in heun.dense.weights[0]]
    if draw(st.booleans()):
        rows[draw(st.integers(0, 1))][draw(st.integers(0, 1))] += 1
    changed = tuple(tuple(row) for row in rows)
    return heun.tableau, DenseOutput((changed, *heun.dense.weights[1:]))


@in_whole
@given(outputs())
@settings(max_examples=at_most(8, 180), deadline=None)
def test_random_dense_output_has_the_order_of_its_values(
    drawn: tuple[Tableau, DenseOutput],
) -> None:
    """Whatever the polynomials, the order by identities is the least one at enough θ."""
    tableau, dense = drawn
    found = dense_order(tableau, dense, 4)
    assert found.order == order_by_values(tableau, dense, 4)
    rounded = meant(tableau, fmpq(1, 10**30), Further(dense=dense))
    near = dense_order(rounded, dense, 4)
    assert near.order == found.order


def test_the_order_of_dense_output_ends_with_its_degree() -> None:
    """A linear interpolant has order 1 with any method of order 1, and fails at θ² for want of a
    coefficient; where no tree is that large, every condition holds.
    """
    euler = spelled_out([[((fmpq(0),),)]], [(fmpq(1),)], [None])
    line = DenseOutput((((fmpq(1),),),))
    found = dense_order(euler, line, 10)
    assert isinstance(found, DenseOrder)
    assert (found.order, found.is_lower_bound) == (1, False)
    assert found.witness is not None
    assert found.witness.power == 2
    alone = spelled_out([[None]], [(fmpq(1),)], [(fmpq(0),)])
    assert dense_order(alone, line, 10).is_lower_bound


@given(st.integers(0, 10**6))
@settings(max_examples=at_most(25, 200), deadline=None)
def test_random_embedded_weights_have_the_order_of_the_oracles(seed: int) -> None:
    """Weights with any sums have the order that trees one by one say, with time too."""
    dice = Random(seed)
    tableau = samples.changed(dice)
    if not all(has_points(tableau, l) for l in range(tableau.size)):
        return
    rows = [drawn_row(colour.b, dice) for colour in tableau.colours]
    found = analyse(tableau, 4, further=Further(tuple(rows)))
    assert found.embedded is not None
    changed = with_weights(tableau, tuple(rows))
    assert found.embedded.order.order == brute_order(changed, 4)
    assert found.embedded.order == find_order(changed, 4)


def has_points(tableau: Tableau, l: int) -> bool:
    """Whether a colour has one coordinate a stage."""
    return hasattr(tableau.space(l), "points")


def drawn_row(b: Sequence[Number], dice: Random) -> Vector:
    """Weights that are b, or b with one entry changed."""
    row = list(b)
    if dice.random() < 0.7:
        row[dice.randrange(len(row))] += samples.small(dice)
    return tuple(row)


@in_whole
def test_too_many_trees_leave_dense_output_open(monkeypatch: pytest.MonkeyPatch) -> None:
    """Within a tolerance an order with more trees than are looked at is undecided, the ones below
    it stand, and so does what needs no trees; the estimate then has no leading order.
    """
    monkeypatch.setattr("garkcli.order.functionals.MOST_TREES", 1)
    method = loads(HERMITE)
    assert method.dense is not None
    tableau = rounded_tableau(method.tableau)
    found = dense_order(meant(tableau, TOLERANCE, method.further), method.dense, 9)
    assert (found.order, found.is_lower_bound) == (2, True)
    assert found.undecided == "order 3 is too much to decide"
    alike = loads(ALIKE)
    analysis = analyse(alike.tableau, 9, TOLERANCE, further=alike.further)
    assert analysis.embedded is not None
    assert analysis.embedded.estimator.order is None
    assert not analysis.embedded.estimator.is_zero


@in_whole
@given(st.integers(0, 10**6))
@settings(max_examples=at_most(15, 120), deadline=None)
def test_renumbering_colours_changes_no_order(seed: int) -> None:
    """The orders of embedded weights and of dense output do not depend on the order of colours."""
    dice = Random(seed)
    tableau = samples.random_additive(dice)
    count = tableau.size
    order = list(range(count))
    dice.shuffle(order)
    rows = [drawn_row(colour.b, dice) for colour in tableau.colours]
    blocks = [tuple((w, samples.small(dice)) for w in row) for row in rows]
    one = analyse(tableau, 4, further=Further(tuple(rows), DenseOutput(tuple(blocks))))
    moved = samples.renumbered(tableau, order)
    further = Further(
        tuple(row_of(moved, tableau, rows)), DenseOutput(tuple(row_of(moved, tableau, blocks)))
    )
    other = analyse(moved, 4, further=further)
    assert one.embedded is not None
    assert other.embedded is not None
    assert one.dense is not None
    assert other.dense is not None
    assert one.embedded.order.order == other.embedded.order.order
    assert one.embedded.estimator.order == other.embedded.estimator.order
    assert one.dense.order.order == other.dense.order.order


def row_of(moved: Tableau, tableau: Tableau, rows: Sequence[T]) -> list[T]:
    """What belongs to each colour of a renumbered tableau, by the terms that colours keep."""
    by_term = {colour.term: row for colour, row in zip(tableau.colours, rows, strict=True)}
    return [by_term[colour.term] for colour in moved.colours]
