"""All transfers whose pair is P-stable, with roots among the coefficients: against interpolation
(Theorem E of docs/pair-order.md) and traces in floats that know nothing of gark.
"""

from __future__ import annotations

import json
from collections.abc import Iterator, Sequence
from pathlib import Path
from random import Random

import numpy as np
import pytest
from flint import fmpq

from garkcli import find_parameters, loads_family, minimise
from garkcli.design.ideal import Ideal
from garkcli.design.member import is_admissible, member, method_at
from garkcli.design.minimise.squared_error import squared_error
from garkcli.design.pairs import PairConditions
from garkcli.design.solutions import Solution, solutions, value_at
from garkcli.design.stable_transfers import operator_of, stable_zeros
from garkcli.design.steps import Step
from garkcli.errors import NotDecided
from garkcli.exact.field import Number
from garkcli.exact.matrix import characteristic_coefficients
from garkcli.exact.polynomial import Polynomial
from garkcli.exact.roots import RealRoot
from garkcli.frozen import replace
from garkcli.stability.oscillator import usual_oscillator
from garkcli.tableau.family import Family, RequiredStability
from garkcli.tableau.forms import pair, spelled_out
from tests.cli.harness import gark
from tests.whole import in_whole, sample

ANY = '"?"'


def p_stable(methods: str, transfer: str = ANY) -> Family:
    """A family of which P-stability is wanted."""
    family = loads_family(f"methods: [{methods}]\ntransfer: {transfer}")
    return replace(family, stable=(RequiredStability("p-stable"),))


def last(family: Family, order: int) -> Step:
    """What the order asks."""
    return find_parameters(family, order, "pair").last


def some(family: Family, ideal: Ideal, seed: int) -> tuple[Solution, RealRoot]:
    """A method of an ideal whose free unknowns are random."""
    dice = Random(seed)
    for gen in family.ring.context.gens()[: len(family.parameters)]:
        smaller = ideal.with_zeros([gen - fmpq(dice.randint(-9, 9), 7)])
        ideal = ideal if smaller.is_everything else smaller
    admitted = ((x, root) for x in solutions(ideal) for root in x.real)
    return next((x, root) for x, root in admitted if is_admissible(family, x, root))


class Floats:
    """A method in floats: colour 1, and all others as one."""

    def __init__(self, family: Family, solution: Solution, root: RealRoot) -> None:
        tableau = member(family.tableau, family.ring, solution.values)

        def floats(row: Sequence[Number]) -> np.ndarray:
            return np.array([float(value_at(x, root)) for x in row])

        def block(l: int, m: int) -> np.ndarray:
            rows = tableau.block(l, m)
            assert rows is not None
            return np.array([floats(row) for row in rows])

        first, *others = tableau.colours
        self.b1, self.c1 = floats(first.b), floats(first.c)
        self.b2 = np.concatenate([floats(x.b) for x in others]) / len(others)
        self.c2 = np.concatenate([floats(x.c) for x in others])
        self.A11 = block(0, 0)
        self.A21 = np.concatenate([block(m, 0) for m in range(1, tableau.size)])

    @property
    def traces(self) -> Iterator[float]:
        """Traces of the pair on the oscillator: velocities at the stages of colour 1, forces at those
        of the others.
        """
        b1, b2, A21 = self.b1, self.b2, self.A21
        conjugate = (b2[:, None] - b2[:, None] * A21 / b1[None, :]).T
        for z in np.geomspace(0.01, 1e4, 2000):
            # Q = q 𝟙 + h A21 P, P = p 𝟙 − h ω² Â12 Q, in ωq and p
            inside = np.linalg.inv(np.eye(len(b1)) + z * z * conjugate @ A21)
            P_of_q = -z * inside @ conjugate.sum(axis=1)
            Q_of_p = z * A21 @ inside @ np.ones(len(b1))
            yield 2 + z * (b1 @ P_of_q - b2 @ Q_of_p)

    @property
    def interpolated(self) -> np.ndarray:
        """The stages of colour 1 at the nodes of colour 2."""
        rows = [
            [np.prod([(x - c) / (d - c) for c in self.c1 if c != d]) for d in self.c1]
            for x in self.c2
        ]
        return np.array(rows) @ self.A11


def some_of_both(
    family: Family, order: int, dimension: int
) -> Iterator[tuple[Solution, RealRoot, Floats, bool]]:
    """Random stable methods of an order, and random others that are not, by traces in floats."""
    step = last(family, order)
    assert step.known.is_real
    assert step.ideal is not None
    assert step.known.of_stable is not None
    assert step.known.of_stable.ideal.dimension == dimension
    assert all(not step.ideal.contains(p) for p in step.known.of_stable.polynomials)
    for seed in range(3):
        for ideal, is_stable in ((step.known.of_stable.ideal, True), (step.ideal, False)):
            solution, root = some(family, ideal, seed)
            method = Floats(family, solution, root)
            assert (max(map(abs, method.traces)) <= 2 + 1e-5) == is_stable
            yield solution, root, method, is_stable


@in_whole
@pytest.mark.parametrize(
    ("methods", "order", "dimension"),
    sample(
        [
            ("gauss-2, lobatto-iiia-3", 4, 1),
            ("gauss-2, gauss-3", 4, 1),
            ("gauss-2, lobatto-iiia-4", 4, 2),
            ("gauss-1, lobatto-iiia-3", 2, 2),
            ("gauss-3, lobatto-iiia-4", 6, 1),
            ("gauss-2, lobatto-iiia-4", 3, 3),
            ("gauss-2, lobatto-iiia-3", 3, 2),
        ],
        7,
    ),
)
def test_the_stable_transfers(methods: str, order: int, dimension: int) -> None:
    """They are those with A^{2,1} by interpolation: random ones of them are stable, random others
    are not, by traces in floats and, where the field is small, by the engine for one method.
    """
    family = p_stable(methods)
    for solution, root, method, is_stable in some_of_both(family, order, dimension):
        assert np.allclose(method.A21, method.interpolated) is is_stable
        exact = method_at(family.tableau, family.ring, solution, root)
        oscillator = None if exact is None else usual_oscillator(pair(exact))
        assert oscillator is None or oscillator.is_p_stable is is_stable


@pytest.mark.parametrize(
    ("methods", "order", "least"),
    [
        pytest.param("gauss-2, gauss-3", 4, fmpq(793, 46656), marks=in_whole),
        pytest.param("gauss-2, lobatto-iiia-4", 4, fmpq(793, 46656), marks=in_whole),
        ("gauss-1, lobatto-iiia-3", 2, fmpq(133, 288)),
    ],
)
def test_the_least_error_of_the_stable_transfers(methods: str, order: int, least: fmpq) -> None:
    """By a theorem it is the table's in docs/found.md; the method found has it by its trees, and
    random stable ones have more.
    """
    family = p_stable(methods)
    design = find_parameters(family, order, "pair")
    best = minimise(design, "error")
    assert best.extent == "all"
    assert best.value == RealRoot.rational(least)
    [one] = best.minimisers
    assert one.found.order is not None
    assert one.found.order.order == order
    assert design.last.known.of_stable is not None
    ideal = design.last.known.of_stable.ideal
    at = one.found.solution, one.found.solution.real[one.index]
    assert max(map(abs, Floats(family, *at).traces)) <= 2 + 1e-5
    assert error(family, *at, order) == RealRoot.rational(least)
    for seed in range(2):
        assert error(family, *some(family, ideal, seed), order) > RealRoot.rational(least)


def error(family: Family, solution: Solution, root: RealRoot, order: int) -> RealRoot:
    """Σ e(u)² of the pair, over the trees of the next order."""
    tableau = pair(member(family.tableau, family.ring, solution.values))
    quotient = squared_error(tableau, order + 1, None)
    return value_at(quotient.numerator / quotient.denominator, root)


@in_whole
def test_one_of_them_by_gröbner_bases() -> None:
    """Gauss 2 and Lobatto IIIA 3, where no theorem says it: 0.1737 in docs/found.md."""
    design = find_parameters(p_stable("gauss-2, lobatto-iiia-3"), 4, "pair")
    best = minimise(design, "error")
    assert isinstance(best.value, RealRoot)
    assert float(best.value) ** 0.5 == pytest.approx(0.1737, abs=5e-5)
    assert best.extent == "critical-points"


def test_all_or_none_of_them() -> None:
    """Where the file fixes the block on which the step depends."""
    blocks = '{{default: {}, blocks: {{"1,2": "?"}}}}'
    every = last(p_stable("gauss-2, lobatto-iiia-4", blocks.format("interpolation")), 4)
    assert every.known.of_stable is not None
    assert every.known.of_stable.polynomials == ()
    assert every.known.is_real
    none = last(p_stable("gauss-2, lobatto-iiia-3", blocks.format("collocation")), 4)
    assert none.known.of_stable is not None
    assert none.known.of_stable.ideal.is_everything
    assert [str(p) for p in none.known.of_stable.polynomials] == ["1"]
    assert none.known.is_real is False


KUTTA = "{A: [[0, 0, 0, 0], [1/2, 0, 0, 0], [0, 1/2, 0, 0], [0, 0, 1, 0]], b: [1/6, 1/3, 1/3, 1/6]}"


@pytest.mark.parametrize(
    ("methods", "order", "dimension"),
    [
        # A^{2,1} on a cone of dimension 2 or on a plane, A^{1,2} free in 5 numbers
        pytest.param(f"{KUTTA}, gauss-3", 4, 7, marks=in_whole),
        # on two lines or on a plane, the other blocks free in 6 numbers
        pytest.param("gauss-2, gauss-1, lobatto-iiia-2", 2, 8, marks=in_whole),
        pytest.param("radau-iia-2, gauss-2", 3, 1, marks=in_whole),
        ("gauss-1, lobatto-iiia-2", 1, 2),
    ],
)
def test_the_stable_transfers_that_depend_on_several_numbers(
    methods: str, order: int, dimension: int
) -> None:
    """Random ones of them are stable, and random ones of the order are not, by traces in floats."""
    assert len([*some_of_both(p_stable(methods), order, dimension)]) == 6


def test_the_singular_values_of_a_step() -> None:
    """D(2 + tr M) = 4 det(I − xS*S) and D(2 − tr M) = x det(I − xR*R): (2 + tr M)/(2 − tr M) by the
    step of the pair.
    """
    dice = Random(7)
    for _ in range(20):
        s, t = dice.randint(1, 4), dice.randint(1, 4)
        b1, b2 = ([fmpq(dice.randint(1, 9)) for _ in range(k)] for k in (s, t))
        b1, b2 = ([x / sum(b) for x in b] for b in (b1, b2))
        A = tuple(tuple(fmpq(dice.randint(-9, 9), 7) for _ in b1) for _ in b2)
        other = tuple(tuple(fmpq(0) for _ in b2) for _ in b1)
        tableau = spelled_out([[None, other], [A, None]], [tuple(b1), tuple(b2)], [None, None])
        found = usual_oscillator(pair(tableau))
        assert found is not None
        S = operator_of(tableau)
        left = Polynomial(characteristic_coefficients(S.square))
        right = Polynomial(characteristic_coefficients(S.across.square))
        N, D = found.trace.numerator, found.trace.denominator
        x = Polynomial([0, 1])
        assert (D * 2 + N) * x * right == (D * 2 - N) * left * 4


def test_a_set_of_one_coordinate() -> None:
    """A rational family of one coordinate has a set of values."""
    step = last(p_stable("gauss-1, lobatto-iiia-2"), 2)
    assert step.known.of_stable is None
    [values] = step.known.stable
    assert values.has_values


def test_few_terms_that_are_much_work() -> None:
    """Generators that python-flint takes very long to autoreduce; methods on the set and off it
    are P-stable or not by the engine for one method.
    """
    given = """
    parameters: {p1: free, p2: free, p3: free}
    b: [[1/9, 4/9, 4/9], [1/9, 4/9, 4/9]]
    A:
    - - [[1/18, 2/9, 2/9], [1/18, 2/9, 2/9], [1/18, 2/9, 2/9]]
      - [[1/18, 2/9, 2/9], [1/18, 2/9, 2/9], [1/18, 2/9, 2/9]]
    - - - [-7/18 + 2/3*p1 - p2/3 - 2/9*p3, -2/9 - 8/9*p3, 10/9 - 2/3*p1 + 4/3*p2 - 8/9*p3]
        - [-1/18 + p1/3 + p2/3 - p3/18, 1/9 - p1/3 + 2/3*p2 - 2/9*p3, 4/9 - 2/9*p3]
        - [5/18 + p3/9, 4/9 - 2/3*p1 + p2/3 + 4/9*p3, -2/9 + 2/3*p1 + 2/3*p2 + 4/9*p3]
      - [[1/18, 2/9, 2/9], [1/18, 2/9, 2/9], [1/18, 2/9, 2/9]]
    """
    family = replace(loads_family(given), stable=(RequiredStability("p-stable"),))
    found = find_parameters(family, 1, "pair", seconds=60).last.known.of_stable
    assert found is not None
    ideal = found.ideal
    for point in ((1, 0, 1), (-1, 0, 1), (2, 0, 1), (1, 0, 2), (1, 1, 1), (0, 0, 0), (0, 1, 0)):
        values = dict(zip(("p1", "p2", "p3"), map(fmpq, point), strict=True))
        oscillator = usual_oscillator(pair(member(family.tableau, family.ring, values)))
        assert oscillator is not None
        there = ideal.with_values(dict(enumerate(values.values())))
        assert oscillator.is_p_stable is not there.is_everything


def test_what_is_not_decided() -> None:
    """Where the step may not see some of four stages."""
    family = p_stable(f"{KUTTA}, {KUTTA}")
    ideal = last(replace(family, stable=()), 4).ideal
    assert ideal is not None
    with pytest.raises(NotDecided):
        stable_zeros(PairConditions(family), ideal, 4)


def test_only_p_stable_transfers_are_decided() -> None:
    """Those of Gauss and Lobatto are decided where P-stability is wanted, and not where
    I-stability is wanted too.
    """
    family = p_stable("gauss-2, lobatto-iiia-3")
    ideal = last(replace(family, stable=()), 4).ideal
    assert ideal is not None
    assert stable_zeros(PairConditions(family), ideal, 4) is not None
    both = replace(family, stable=(*family.stable, RequiredStability("i-stable")))
    with pytest.raises(NotDecided):
        stable_zeros(PairConditions(both), ideal, 4)


def test_the_report(tmp_path: Path) -> None:
    """In words and as JSON; exit code 1 where none is stable."""
    path = tmp_path / "pair.yaml"
    path.write_text('methods: [gauss-2, lobatto-iiia-3]\ntransfer: "?"\n', encoding="utf-8")
    wanted = ("design", str(path), "--pair", "--order", "4", "--p-stable")
    run = gark(*wanted)
    assert run.code == 0
    assert "P-stable for exactly the real values of a part of dimension 1" in " ".join(
        run.out.split()
    )
    assert "P-stable for exactly a21_11 = 1/12*sqrt(3); a21_12" in " ".join(run.out.split())
    data = json.loads(gark(*wanted, "--format", "json").out)
    assert data["reached"] is True
    assert data["stable_ideal"][0] == "12*a21_11 - sqrt(3)"
    assert "add --order P, which takes roots" in gark(*wanted[:3], "--p-stable").err
    none = 'transfer: {default: collocation, blocks: {"1,2": "?"}}\n'
    path.write_text(f"methods: [gauss-2, lobatto-iiia-3]\n{none}", encoding="utf-8")
    run = gark(*wanted)
    assert run.code == 1
    assert "order 4 for no method of the file" in " ".join(run.out.split())
