"""One method within the rounding of a printed one: what is recovered has what is said of it, and what
is refuted fails for every method of the box.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from fractions import Fraction
from functools import cache
from itertools import product
from random import Random
from typing import Any

import numpy as np
import pytest
from flint import arb, fmpq
from hypothesis import example, given, settings
from hypothesis import strategies as st
from scipy.optimize import lsq_linear

from garkcli import loads
from garkcli.check.analysis import analyse
from garkcli.exact.affine import Forms
from garkcli.ntrees.table import TreeTable
from garkcli.order.admissible import coupling_graph
from garkcli.order.bounded import bounded_least_squares, excludes, nearest
from garkcli.order.certificate import find_order
from garkcli.order.conditions import conditions
from garkcli.order.meant import as_meant
from garkcli.order.place import MOST_ROWS, BoxPlace
from garkcli.order.recovering import Recovery
from garkcli.order.rounded import RoundedTableau, find_order_within
from garkcli.order.simplifying import simplifying
from garkcli.order.suspects import without
from garkcli.tableau.box import plain_box
from garkcli.tableau.forms import gark
from garkcli.tableau.tableau import Tableau, butcher
from tests.order import own_trees
from tests.order.random_rounded import (
    DATA,
    OFF,
    Case,
    Judged,
    Rounding,
    Source,
    analysis,
    document,
    fraction,
    judged,
    misprinted,
    source,
)
from tests.whole import at_most, in_whole, sample

ZERO = 1e-33
"""What counts as zero: M* is known to 120 bits at least."""


def known(*names: str) -> list[Source]:
    """Methods of the catalogue."""
    found = [source(next(DATA.glob(f"*/{name}.gark.yaml"))) for name in names]
    return [x for x in found if x is not None]


def rounded(kind: str, names: str, digits: int, rule: str = "") -> Case:
    """A file made of methods of the catalogue."""
    chosen = known(*names.split())
    text = document(kind, chosen, rule, Rounding(digits)) + f"tolerance: 5e-{digits + 1}\n"
    return Case(kind, names, digits, document(kind, chosen, rule, str), text)


CASES = [
    ("plain", "rk4", 3, ""),
    ("plain", "radau-iia-3", 8, ""),
    ("plain", "lobatto-iiic-3", 16, ""),
    ("conjugate", "lobatto-iiia-3", 3, ""),
    ("adjoint", "kutta-3", 4, ""),
    ("adjoint", "lobatto-iiib-3", 12, ""),
    ("transfer", "heun-3 radau-iia-2", 6, "collocation"),
    ("transfer", "ssp-33 gauss-2", 8, "interpolation"),
    ("structure", "lobatto-iiia-3 implicit-midpoint", 4, "legendre"),
    ("two colours", "imex-gark-2a", 6, ""),
    ("two colours", "gauss-2 lobatto-iiic-2", 10, "legendre"),
    ("three colours", "heun-3 implicit-midpoint ssp-33", 5, "legendre"),
    ("embedded", "bogacki-shampine-3", 5, ""),
    ("dense", "bogacki-shampine-3", 6, ""),
]


@cache
def judged_of(case: tuple[str, str, int, str]) -> Judged:
    """What is said of a file."""
    return judged(rounded(*case))


def ids(case: tuple[str, str, int, str]) -> str:
    return f"{case[0]} {case[1]} {case[2]}".replace(" ", "-")


@pytest.mark.parametrize("case", sample(CASES, 2), ids=ids)
def test_no_true_order_is_refuted(case: tuple[str, str, int, str]) -> None:
    """What is true of the exact method is true within the rounding, order of the method, its
    conjugate, its pair, its embedded weights and dense output, B, C, D, symplecticity; and from six
    digits on nothing else is.
    """
    found = judged_of(case)
    assert not found.lower
    assert not found.open
    if found.case.digits >= 6:
        assert found.said == found.true


class Own:
    """The method that a file is taken to be, in fractions, with what its own text says."""

    def __init__(self, of: Case) -> None:
        self.rounded: Any = as_meant(loads(of.text))
        self.search = self.rounded.search
        self.place = self.search.settled
        near = self.place.exact("method")
        self.colours = range(near.size)
        self.b = [list(map(fraction, colour.b)) for colour in near.colours]
        self.A = {
            (l, m): [list(map(fraction, row)) for row in near.blocks[near.colours[l].space, m]]
            for l in self.colours
            for m in self.colours
            if near.block(l, m) is not None
        }
        self.method = own_trees.Method(self.A, self.b)

    def numbers(self) -> list[Fraction]:
        """The printed numbers at their place, in the order in which the file has them."""
        return [
            fraction(x + t * shift)
            for x, t, shift in zip(
                self.search.box.numbers, self.search.box.radii, self.place.shifts, strict=True
            )
        ]


@pytest.mark.parametrize("case", sample(CASES, 2), ids=ids)
def test_recovered_numbers_have_the_order_by_another_program(
    case: tuple[str, str, int, str],
) -> None:
    """The numbers of the method that is found meet all conditions up to the order, those of no tree
    forgotten, and miss one of the next order, by trees and fractions that know nothing of gark; each
    is off by the tolerance at most. Of embedded weights and dense output likewise.
    """
    found = judged_of(case)
    of, order = found.case, found.said["order"]
    own = Own(of)
    assert not own.place.slack
    for n in range(1, order + 1):
        assert own.method.largest(n) < ZERO
    assert own.method.largest(order + 1) > ZERO
    tolerance = Fraction(5, 10 ** (of.digits + 1))
    texts = [Fraction(x) for x in re.findall(r"-?\d+\.\d+", of.text.split("tolerance:")[0])]
    printed = [fraction(x) for x in own.search.box.numbers]
    assert sorted(printed) == sorted(texts)
    assert all(abs(x - y) <= tolerance for x, y in zip(own.numbers(), printed, strict=True))
    further = own.place.further
    if further.embedded is not None:
        weights = [list(map(fraction, row)) for row in further.embedded]
        true = found.true["embedded order"]
        for n in range(1, true + 1):
            assert own.method.largest(n, weights) < ZERO
        assert own.method.largest(true + 1, weights) > ZERO
    if further.dense is not None:
        powers = [[list(map(fraction, row)) for row in power] for power in further.powers]
        for n in range(1, found.true["dense order"] + 1):
            for power, weights in enumerate(powers, start=1):
                assert own.method.largest(n, weights, int(power == n)) < ZERO


@pytest.mark.parametrize("kind", ["conjugate", "adjoint"])
def test_what_is_made_of_recovered_numbers(kind: str) -> None:
    """The tableau of a conjugate or an adjoint is made of the numbers that are printed: by its
    formula from these in fractions, not from entries with a rounding of their own.
    """
    of = rounded(kind, "radau-iia-3", 7)
    own = Own(of)
    numbers = iter(own.numbers())
    A = [[next(numbers) for _ in range(3)] for _ in range(3)]
    b = list(numbers)
    wanted = (own_trees.conjugated if kind == "conjugate" else own_trees.adjoint)(A, b)
    one, other = (sorted(map(sorted, rows)) for rows in (own.A[0, 0], wanted))
    assert all(
        abs(x - y) < Fraction(1, 10**60)
        for rows in zip(one, other, strict=True)
        for x, y in zip(*rows, strict=True)
    )


@pytest.mark.parametrize(
    ("kind", "names", "digits", "wrong"),
    [
        ("plain", "rk4", 4, 2),
        pytest.param("plain", "lobatto-iiic-3", 12, 10, marks=in_whole),
        ("two colours", "imex-gark-2a", 6, 3),
        ("embedded", "bogacki-shampine-3", 10, 9),
    ],
)
def test_misprints_are_seen(kind: str, names: str, digits: int, wrong: int) -> None:
    """A number that is off by a thousand tolerances costs the order that the file claims, up or
    down, and the right entry is named.
    """
    chosen = known(*names.split())
    for units in (OFF, -OFF) if names == "lobatto-iiic-3" else (OFF,):
        text = document(kind, chosen, "", Rounding(digits, wrong, units))
        text += f"tolerance: 5e-{digits + 1}\n"
        exact = document(kind, chosen, "", str)
        found = misprinted(Case(kind, names, digits, exact, text, wrong, units))
        assert not found.is_free
        assert found.is_found
        assert found.place in found.named


def test_equal_digits_may_mean_two_numbers() -> None:
    """B = (0.331056, 0.334544, 0.3344) with nodes 0, 1/2, 199/200 has order 2 and is printed as 0.33
    three times. Of one number three times it would be 1/3, which has not. A parameter is one number.
    """
    text = "A: [[0, 0, 0], [1/2, 0, 0], [0, 199/200, 0]]\nb: [{0}, {0}, {0}]\ntolerance: 5e-3\n"
    b, c = (
        [Fraction(x, 1000000) for x in (331056, 334544, 334400)],
        [0, Fraction(1, 2), Fraction(199, 200)],
    )
    assert (sum(b), sum(x * y for x, y in zip(b, c, strict=True))) == (1, Fraction(1, 2))
    assert order_of_text(text.format("0.33")) == 2
    assert order_of_text("parameters: {w: 0.33}\n" + text.format("w")) == 1


def order_of_text(text: str) -> int:
    found = find_order_within(as_meant(loads(text)), 8)  # type: ignore[arg-type]
    assert not found.undecided
    return found.order


def row(*forms: tuple[str, Sequence[float]]) -> Forms:
    """Forms c + Σ g_k ε_k."""
    slopes = np.array([g for _, g in forms], float)
    return Forms([arb(c) for c, _ in forms], slopes, np.zeros(len(forms)))


def test_two_rows_that_exclude_each_other() -> None:
    """ε₁ + ε₂ = 1.5 and ε₁ − ε₂ = 1 each have a solution in the box, and together ε₁ = 5/4. Their sum
    proves it, and so does what the bounded least squares leave; with 0.5 in place of 1 there is a
    solution, which no combination denies.
    """
    rows = row(("-1.5", (1, 1)), ("-1", (1, -1)))
    assert not excludes(rows, np.array([1.0, 0]))
    assert not excludes(rows, np.array([0, 1.0]))
    assert excludes(rows, np.array([1.0, 1]))
    left = rows.middle + rows.slopes @ bounded_least_squares(rows.slopes, rows.middle)
    assert np.allclose(left, (-0.25, -0.25))
    assert excludes(rows, left)
    loose = row(("-1.5", (1, 1)), ("-0.5", (1, -1)))
    for y in product(np.linspace(-1, 1, 21), repeat=2):
        assert not excludes(loose, np.array(y))
    x = nearest(loose.slopes, loose.middle, 1e-10)
    assert x is not None
    assert np.allclose(x, (1, 0.5), atol=1e-7)


@pytest.mark.parametrize("seed", range(30))
def test_least_squares_within_bounds_are_those_of_scipy(seed: int) -> None:
    """Rows of random numbers, more and fewer than unknowns, of which many end at a bound: the sum
    of squares is the least that scipy's ``lsq_linear`` finds.
    """
    dice = np.random.default_rng(seed)
    G = dice.normal(size=(int(dice.integers(1, 7)), int(dice.integers(1, 7))))
    c = dice.normal(size=len(G)) * 3
    x = bounded_least_squares(G, c)
    assert np.abs(x).max() <= 1
    least = lsq_linear(G, -c, (-1, 1), method="bvls", tol=1e-14).cost
    assert np.sum((c + G @ x) ** 2) / 2 == pytest.approx(least, rel=1e-9, abs=1e-12)


def test_rows_without_a_direction_are_orthogonal_to_it() -> None:
    """Of rows and of one column nothing is left in a direction, and all that is across it."""
    dice = np.random.default_rng(1)
    rows, direction = dice.normal(size=(5, 3)), dice.normal(size=5)
    for part in (rows, rows[:, 0]):
        left = without(part, direction)
        assert np.allclose(direction @ left, 0)
        across = np.linalg.svd(direction[None, :])[2][1:]
        assert np.allclose(across @ left, across @ part)


SIMPSON = "A: [[], [1/2], [1/4, 1/4], [0, 0, 1]], b: [1/6, 1/3, 1/3, 1/6]"
"""Quadrature of order 4 in nodes of Simpson's rule, and other conditions of order 3 fail."""


@pytest.mark.parametrize("order", [1, 2, 3, 4])
def test_what_is_missed_is_seen_by_spans_as_by_trees(
    order: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Orders with many trees are judged by spans: these miss an order where its trees do, also one
    whose quadrature conditions hold.
    """
    texts = (
        "A: [[], [0.5], [0, 0.5], [0, 0, 1]], b: [0.166667, 0.333333, 0.333333, 0.166667]",
        SIMPSON.replace("1/6, 1/3, 1/3, 1/6", "0.166667, 0.333333, 0.333333, 0.166667"),
    )
    for text in texts:
        box = as_meant(loads(f"{{{text}, tolerance: 5e-7}}"))
        assert isinstance(box, RoundedTableau)
        listed = box.search.settled.missed("method", order)
        monkeypatch.setattr("garkcli.order.place.MOST_TREES", 0)
        spanned = BoxPlace(box.search, box.search.settled.shifts).missed("method", order)
        monkeypatch.undo()
        assert bool(listed) == bool(spanned)
        assert not any(box.meets(tree) for tree in spanned)


def test_a_certificate_counts_remainders() -> None:
    """What is of second order may make up for what the sum of two rows lacks."""
    rows = row(("-1.5", (1, 1)), ("-1", (1, -1)))
    for rest, proves in ((0.2, True), (0.25, False), (0.3, False)):
        wide = Forms(rows.centres, rows.slopes, np.array([rest, rest]))
        assert excludes(wide, np.array([1.0, 1])) == proves


def test_numbers_halfway_between_two_decimals() -> None:
    """ε₁ = 1 and ε₁ + ε₂ = 2 have the corner alone; with 1.1 they have nothing."""
    corner = row(("-1", (1, 0)), ("-2", (1, 1)))
    x = nearest(corner.slopes, corner.middle, 1e-10)
    assert x is not None
    assert list(x) == [1, 1]
    beyond = row(("-1.1", (1, 0)), ("-2", (1, 1)))
    assert nearest(beyond.slopes, beyond.middle, 1e-10) is None
    # 5/64 and 37/64 end in 5 with five digits: both are rounded up by all of the tolerance
    method = "A: [[0, 0], [0.57813, -0.07812]]\nb: [1/2, 1/2]\nc: [0, 1/2]\ntolerance: 5e-6\n"
    assert judged_C(method) == 1
    assert judged_C(method.replace("5e-6", "4.9e-6")) == 0


def judged_C(text: str) -> int:  # noqa: N802 -- the paper's letter
    """η of a method with one colour."""
    (row,) = analysis(loads(text)).simplifying.C
    assert row[0] is not None
    return row[0]


def pairwise(tableau: Tableau, radius: fmpq) -> RoundedTableau:
    """The method with radii for its weights alone."""
    weights = set(tableau.colours[0].b)
    box = plain_box(tableau, lambda x: radius if x in weights else fmpq(0), 1)
    return RoundedTableau(tableau, radius, Recovery(box))


@given(st.integers(0, 2**32 - 1))
@settings(max_examples=at_most(20, 200))
@example(275)
def test_orders_that_fail_fail_everywhere(seed: int) -> None:
    """Random weights with a radius each at exact stages: the conditions are linear in them. Where an
    order is said to fail, no solution of its conditions, all of which are known by elimination, is
    in the box; where it is said to hold, the one that is found is.
    """
    dice = Random(seed)
    c = dice.sample([fmpq(k, 4) for k in range(5)], 2)
    radius = fmpq(1, dice.choice((3, 5, 10, 20)))
    b = [fmpq(1, 2) + fmpq(dice.randint(-40, 40), 100) for _ in range(2)]
    for i in range(2):
        while b[i] in {*c, fmpq(0), b[1 - i]}:  # equal numbers have one radius
            b[i] += fmpq(1, 7)
    A = ((c[0], fmpq(0)), (fmpq(0), c[1]))
    found = find_order_within(pairwise(gark([butcher(A, tuple(b))], {}), radius), 2)
    # b₁ + b₂ = 1 leaves a line; with b · c = 1/2 a point
    lowest = max(b[0] - radius, 1 - b[1] - radius)
    highest = min(b[0] + radius, 1 - b[1] + radius)
    b_1 = (fmpq(1, 2) - c[1]) / (c[0] - c[1])
    true = 0 if lowest > highest else 2 if lowest <= b_1 <= highest else 1
    # a condition that holds beside a corner of the box alone may stay open
    ends = [[x - radius, x + radius] for x in b]
    at = [(x + y - 1, c[0] * x + c[1] * y - fmpq(1, 2)) for x, y in product(*ends)]
    extremes = [x for row in zip(*at, strict=True) for x in (min(row), max(row))]
    assert not found.undecided or min(map(abs, extremes)) < fmpq(1, 50)
    assert found.order == true or found.undecided
    assert found.order <= true


def test_what_fails_fails_on_a_grid() -> None:
    """Kutta's third-order method with four digits and a wrong last digit but two: order 3 is refuted
    by a certificate; on a grid of all methods of the box the largest residual of orders 1 to 3 is
    never less than a bound that the grid leaves for the methods between its points.
    """
    text = "A: [[0, 0, 0], [1/2, 0, 0], [-1, 2, 0]]\nb: [{}, 2/3, {}]\ntolerance: 5e-3\n"
    assert order_of_text(text.format("0.17", "0.17")) == 3
    assert order_of_text(text.format("0.19", "0.15")) == 1
    step, radius = Fraction(1, 2000), Fraction(5, 1000)
    A = [[Fraction(0)] * 3, [Fraction(1, 2), 0, 0], [Fraction(-1), Fraction(2), 0]]
    least = Fraction(1)
    for i, j in product(range(-10, 11), repeat=2):
        b = [Fraction(19, 100) + i * step, Fraction(2, 3), Fraction(15, 100) + j * step]
        own = own_trees.Method({(0, 0): A}, [b])
        least = min(least, Fraction(max(own.largest(1), own.largest(2))))
    assert 10 * step == radius
    # γ-fold residuals change by 4 steps at most between two points
    assert least > 4 * step


def test_digits_that_are_zero_are_structure() -> None:
    """An entry that is printed as 0 is 0: of a method with 1/3000 there and three digits gark says
    what is true with 0. The method found has zeros where the file has.
    """
    text = "A: [[0, 0], [0.500, {}]]\nb: [0, 1.000]\ntolerance: 5e-4\n"
    zero = as_meant(loads(text.format("0.000")))
    assert isinstance(zero, RoundedTableau)
    assert len(zero.search.box.numbers) == 2
    assert find_order_within(zero).order == 2
    assert zero.near.blocks[0, 0][1][1] == 0
    assert analysis(loads(text.format("0.000"))).subject.verdict("explicit").value is True
    assert analysis(loads(text.format("0.001"))).subject.verdict("explicit").value is False
    # c₂ = 1/2 + 1/1000 within twice the tolerance: one half is feasible, 0 + 0.501 is not
    assert order_of_text(text.format("0.001").replace("0.500", "0.501")) == 1
    assert order_of_text(text.format("0.001")) == 2
    assert order_of_text(text.format("0").replace("0.500", "0.501")) == 1


def test_exact_methods_of_the_catalogue_are_theirs() -> None:
    """With a tolerance a method that needs none is found where it is: nothing moves."""
    for name in ("rk4", "radau-iia-3"):
        (one,) = known(name)
        box = RoundedTableau.within(one.method.tableau, fmpq(1, 10**9))
        assert find_order_within(box, 8).order == find_order(one.method.tableau, 8).order
        assert box.search.place.distance < 1e-20


def test_what_is_met_to_second_order_counts_as_met_everywhere() -> None:
    """A method that misses its conditions by 10⁻⁹ of the radii, where Newton's method went no
    further, has B like one that meets them; without slack it has none.
    """
    box = as_meant(loads(rounded("plain", "rk4", 6).text))
    assert isinstance(box, RoundedTableau)
    place = box.search.settled
    box.search.place = BoxPlace(box.search, [x + fmpq(1, 10**9) for x in place.shifts])
    assert simplifying(box, 8, "B").B == (0,)
    box.search.place.slack = 1e-8
    assert simplifying(box, 8, "B").B == (4,)


@in_whole
def test_a_method_beyond_the_box_is_none_to_second_order() -> None:
    """a[2,3] of this Gauss method is 1.08 t from the exact one, the only method of three stages with
    order 6, which is its own conjugate: neither the method nor its conjugate has order 6 within t,
    whichever of them is judged first.
    """
    text = "{A: [[0.13889, -0.03598, 0.00979], [0.30026, 0.22222, -0.02248],"
    text += " [0.26799, 0.48042, 0.13889]], b: [0.27778, 0.44444, 0.27778], tolerance: 5e-6}"
    method = loads(text)
    found = analyse(method.conjugate.tableau, 6, method.tolerance)
    assert found.conjugate_order is not None
    assert (found.order.order, found.conjugate_order.order) == (5, 5)


@pytest.mark.parametrize("slack", [0.0, 1e-30])
def test_trees_are_made_of_the_conditions_that_are_taken(
    slack: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Of thousands of conditions that fail as many trees are made as there are rows, those missed by
    most; a place that gives its conditions slack has the same.
    """
    box = as_meant(
        loads("{tolerance: 1e-6, A: [[0.25, -0.03867513], [0.53867513, 0.25]], b: [0.4, 0.6]}")
    )
    assert isinstance(box, RoundedTableau)
    search = box.search
    place = BoxPlace(search, [fmpq(0)] * len(search.box.numbers))
    monkeypatch.setattr(place, "slack", slack)
    made: list[int] = []
    whole = TreeTable.tree
    monkeypatch.setattr(TreeTable, "tree", lambda table, u: made.append(u) or whole(table, u))
    found = place.missed("method", 10)
    assert len(found) == MOST_ROWS
    monkeypatch.undo()
    tableau = place.exact("method")
    table = TreeTable.of(coupling_graph(tableau), 10)
    every = [abs(x.residual) for x in conditions(tableau, map(table.tree, table.ids(10)))]
    taken = [abs(x.residual) for x in conditions(tableau, found)]
    assert taken == sorted(every, reverse=True)[:MOST_ROWS]
    assert len(made) < len(every) / 2
