"""The order on problems ẏ = f(t, y) with nodes as they are printed: against steps as power series
in the step size, which know no trees.
"""

from __future__ import annotations

from random import Random

import pytest
from flint import fmpq, fmpq_poly
from hypothesis import given, settings
from hypothesis import strategies as st

from garkcli import loads
from garkcli.check.analysis import analyse
from garkcli.order.certificate import find_order
from garkcli.tableau.forms import gark, with_time
from garkcli.tableau.tableau import Tableau, butcher
from tests.oracles import samples
from tests.oracles.brute import brute_order
from tests.whole import at_most, in_whole

DEGREE = 5
"""Powers of h up to which steps are compared."""
Monomials = list[tuple[fmpq, int, int]]
"""The terms a t^i y^j of a right-hand side."""


def right_hand_side(f: Monomials, t: fmpq_poly, y: fmpq_poly) -> fmpq_poly:
    """F at truncated power series."""
    modulus = fmpq_poly([0] * (DEGREE + 1) + [1])
    total = fmpq_poly([0])
    for a, i, j in f:
        total = total + a * (t**i % modulus) * (y**j % modulus)
    return total % modulus


def step(method: Tableau, f: Monomials, start: fmpq) -> fmpq_poly:
    """One step of a method of one colour from t = 0, its nodes where it says."""
    (colour,), A = method.colours, method.blocks[0, 0]
    h, stages = fmpq_poly([0, 1]), [fmpq_poly([start])] * len(colour.b)
    for _ in range(DEGREE + 1):  # each round is right for one power of h more
        slopes = [right_hand_side(f, c * h, y) for c, y in zip(colour.c, stages, strict=True)]
        stages = [
            fmpq_poly([start])
            + h * sum((a * k for a, k in zip(row, slopes, strict=True)), fmpq_poly([0]))
            for row in A
        ]
    end = sum((b * k for b, k in zip(colour.b, slopes, strict=True)), fmpq_poly([0]))
    return fmpq_poly([start]) + h * end


def solution(f: Monomials, start: fmpq) -> fmpq_poly:
    """The Taylor polynomial of the solution, by Picard iteration."""
    y = fmpq_poly([start])
    for _ in range(DEGREE + 1):
        y = fmpq_poly([start]) + right_hand_side(f, fmpq_poly([0, 1]), y).integral()
    return y


def order_seen(method: Tableau, dice: Random) -> int:
    """The order on a random problem: the powers of h in which a step is right."""
    f = [
        (fmpq(dice.randint(1, 9), dice.randint(1, 5)), i, j)
        for i in range(DEGREE)
        for j in range(DEGREE)
    ]
    start = fmpq(dice.randint(1, 5))
    found, true = step(method, f, start), solution(f, start)
    return next(k for k in range(DEGREE + 2) if k > DEGREE or found[k] != true[k]) - 1


def with_nodes(A: str, b: str, c: list[fmpq]) -> Tableau:
    """A method with nodes of its own."""
    rows = samples.runge_kutta(*A.split(";"), b)
    return gark([butcher(rows.blocks[0, 0], rows.colours[0].b, tuple(c))], {})


METHODS = [
    ("0, 0, 0; 1/2, 0, 0; -1, 2, 0", "1/6, 2/3, 1/6"),
    ("0, 0; 2/3, 0", "1/4, 3/4"),
    ("5/12, -1/12; 3/4, 1/4", "3/4, 1/4"),
]


@settings(max_examples=at_most(10, 200))
@given(st.sampled_from(METHODS), st.integers(0, 2**32 - 1))
def test_the_order_is_that_of_steps_as_power_series(
    coefficients: tuple[str, str], seed: int
) -> None:
    """Nodes that are the row sums, or some of them changed: the certificate and all trees say what
    a scalar problem shows, which is no less than the order, and with time first seen so.
    """
    dice = Random(seed)
    method = samples.runge_kutta(*coefficients[0].split(";"), coefficients[1])
    c = [x + dice.choice([fmpq(0), fmpq(0), fmpq(1, 7)]) for x in method.colours[0].c]
    changed = with_nodes(*coefficients, c)
    timed = with_time(changed)
    assert timed is not None
    found = find_order(timed).order
    assert found == brute_order(timed, 5)
    assert found <= find_order(changed).order
    assert order_seen(changed, dice) == found


@in_whole
def test_consistent_methods_keep_their_order() -> None:
    """Where c = A𝟙 time is as any other leaf: for every sample the order is what it was."""
    for name, make in samples.NAMED.items():
        method = make()
        found = analyse(method, 8)
        if any(colour.is_linear for colour in method.colours):
            assert found.nonautonomous_order is None, name
        elif not found.inconsistent:
            timed = with_time(method)
            assert timed is not None
            assert find_order(timed, 8).order == found.order.order, name


@pytest.mark.parametrize(
    ("c", "order"), [("[0, 1/2]", 2), ("[0, 1/3]", 1), ("[1/9, 1/2]", 2), ("[1/9, 2/3]", 1)]
)
def test_a_check_says_the_order_with_the_nodes_as_printed(c: str, order: int) -> None:
    """The midpoint rule: its second node counts, the first has no weight."""
    method = loads(f"methods: [{{A: [[0, 0], [1/2, 0]], b: [0, 1], c: {c}}}]")
    found = analyse(method.tableau)
    assert found.order.order == 2
    assert found.nonautonomous_order is not None
    assert found.nonautonomous_order.order == order
