"""Weak stage order: by functionals, by products of blocks written out, by the resolvent that the
literature has, and by the error of a step on a linear problem.
"""

from __future__ import annotations

from fractions import Fraction
from itertools import pairwise, product
from random import Random
from typing import Any

import pytest
from flint import fmpq, fmpq_mat

from garkcli import catalogue, find_property, loads
from garkcli.design.design import find_parameters
from garkcli.errors import MethodFileError
from garkcli.methodfile.family import loads_family
from garkcli.order.meant import meant
from garkcli.order.weak_stages import weak_stage_order
from garkcli.tableau.tableau import Tableau
from tests.cli.harness import gark
from tests.whole import at_most, in_whole

LIMIT = 9
EXPLICIT = "A: [[0, 0, 0], [1, 0, 0], [2, 0, 0]]\nb: [1/4, 1, -1/4]\n"
"""Order 2 and weak stage order 2: b·c = 1/2, b·c² = 0, and no stage sees another one but the first."""


def explicit(*nodes: int) -> str:
    """Blocks whose stages see the first alone."""
    return f"[{', '.join(f'[{c}, 0, 0]' for c in nodes)}]"


def by_products(tableau: Tableau, colours: list[int], limit: int = LIMIT) -> int:
    """The definition, with all products of as many blocks as there are stages, in plain fractions."""

    def rational(x: Any) -> Fraction:
        return Fraction(int(x.p), int(x.q))

    nodes = [[rational(x) for x in colour.c] for colour in tableau.colours]
    blocks = {
        (l, m): [[rational(x) for x in row] for row in tableau.block(l, m) or ()]
        for l, m in tableau.edges()
    }
    functionals = []
    most = sum(len(nodes[l]) for l in colours)
    for count in range(1, most + 1):
        for path in product(colours, repeat=count):
            w = [rational(x) for x in tableau.colours[path[0]].b]
            for edge in pairwise(path):
                block = blocks.get(edge)
                if block is None:
                    break
                w = [
                    sum((x * row[j] for x, row in zip(w, block, strict=True)), Fraction(0))
                    for j in range(len(block[0]))
                ]
            else:
                if any(w):
                    functionals.append((path[-1], w))
    for k in range(1, limit + 1):
        for l, w in functionals:
            for m in range(tableau.size):
                if (l, m) in blocks:
                    missed = [
                        sum(a * x ** (k - 1) for a, x in zip(row, nodes[m], strict=True)) - y**k / k
                        for row, y in zip(blocks[l, m], nodes[l], strict=True)
                    ]
                    if sum(x * y for x, y in zip(w, missed, strict=True)):
                        return k - 1
    return limit


def by_resolvent(tableau: Tableau, limit: int = LIMIT) -> int:
    """The largest q with bᵀ (I − z A)⁻¹ (A c^(k−1) − c^k/k) = 0 for k ≤ q at as many z as decide it:
    theorem 2 of Ketcheson, Seibold, Shirokoff and Zhou (2020).
    """
    A: Any = tableau.block(0, 0)
    colour: Any = tableau.colours[0]
    s = len(colour.b)
    for k in range(1, limit + 1):
        missed = fmpq_mat(
            [
                [sum(a * c ** (k - 1) for a, c in zip(row, colour.c, strict=True)) - y**k / k]
                for row, y in zip(A, colour.c, strict=True)
            ]
        )
        for n in range(s):
            z = fmpq(n, 97) - 1
            matrix = fmpq_mat([[(i == j) - z * A[i][j] for j in range(s)] for i in range(s)])
            (value,) = (fmpq_mat([list(colour.b)]) * matrix.solve(missed)).entries()
            if value:
                return k - 1
    return limit


@pytest.mark.parametrize(
    ("name", "wanted"),
    [
        ("wso-432", 2),
        *(pytest.param(*x, marks=in_whole) for x in (("wso-433", 3), ("wso-643", 3))),
        pytest.param("wso-744", 4, marks=in_whole),
        *(pytest.param(*x, marks=in_whole) for x in (("wso-1254", 4), ("wso-1255", 5))),
    ],
)
def test_published_tables(name: str, wanted: int) -> None:
    """The six tables of Irksome have the weak stage order that the papers give them, and no larger;
    without their rounding they have none beyond 1.
    """
    found = catalogue[name]
    assert weak_stage_order(meant(found.tableau, found.tolerance), [0], LIMIT) == wanted
    assert weak_stage_order(found.tableau, [0], LIMIT) == by_resolvent(found.tableau) == 1
    assert find_property(name, "stage-order").value == 1


@pytest.mark.parametrize(
    "name", ["rk4", "backward-euler", "implicit-midpoint", "kutta-3", "cash-karp-5"]
)
def test_the_resolvent_vanishes(name: str) -> None:
    """Rational methods of the catalogue: by the resolvent and by products of A."""
    tableau = catalogue[name].tableau
    q = weak_stage_order(tableau, [0], LIMIT)
    assert q == by_resolvent(tableau)
    assert len(tableau.colours[0].b) > 4 or q == by_products(tableau, [0])


def test_an_explicit_method() -> None:
    """Weak stage order 2 by its definition, order 2; with one weight changed it is 1."""
    tableau = loads(EXPLICIT).tableau
    assert weak_stage_order(tableau, [0], LIMIT) == by_products(tableau, [0]) == 2
    changed = loads(EXPLICIT.replace("1/4, 1, -1/4", "0, 1/2, 1/2")).tableau
    assert weak_stage_order(changed, [0], LIMIT) == by_products(changed, [0]) == 1


def random_pair(dice: Random) -> Tableau:
    """Two colours of few stages: the explicit method above and blocks that keep what it has, or do
    not; entries are small.
    """
    nodes = (0, 1, 2)
    kind = dice.randrange(3)

    def block() -> str:
        if kind == 0 or dice.random() < 0.5:
            return explicit(*nodes)
        rows = [[str(dice.randint(-1, 2)) for _ in range(3)] for _ in range(3)]
        if kind == 1:  # row sums are the nodes
            rows = [
                [*row[:2], str(c - int(row[0]) - int(row[1]))]
                for c, row in zip(nodes, rows, strict=True)
            ]
        return str(rows).replace("'", "")

    b = ["[1/4, 1, -1/4]", "[1/2, 1/2, 0]"]
    blocks = [[block(), block()], [block(), block()]]
    rows = "\n".join(f"  - [{x}, {y}]" for x, y in blocks)
    return loads(
        f"A:\n{rows}\nb: [{b[0]}, {b[dice.randrange(2)]}]\nc: [[0, 1, 2], [0, 1, 2]]\n"
    ).tableau


@in_whole
def test_random_methods_of_two_colours() -> None:
    """All products of two colours, and of each colour alone: the same as by their definition."""
    dice = Random(5)
    found = []
    for _ in range(at_most(12, 40)):
        tableau = random_pair(dice)
        for colours in ([0, 1], [0], [1]):
            q = weak_stage_order(tableau, colours, LIMIT)
            assert q == by_products(tableau, colours)
            found.append(q)
    assert {0, 1, 2} <= {*found}


def test_colours_alone_may_have_more() -> None:
    """Each colour alone has weak stage order 2; a product of two colours leaves 1."""
    mixed = "[[0, 0, 0], [1, 0, 0], [1, 1, 0]]"
    plain = explicit(0, 1, 2)
    text = (
        f"A:\n  - [{plain}, {mixed}]\n  - [{plain}, {plain}]\nb: [[1/4, 1, -1/4], [1/4, 1, -1/4]]\n"
    )
    found = find_property(loads(text), "weak-stage-order")
    tableau = loads(text).tableau
    alone = [by_products(tableau, [0]), by_products(tableau, [1])]
    assert found.value == by_products(tableau, [0, 1])
    assert found.why == f"colour 1 has {alone[0]}, colour 2 has {alone[1]}"
    assert found.value < max(alone)


def test_the_error_of_a_step() -> None:
    """With y' = L y + g with y = t^k: with matrices L₁, L₂ that do not commute one exact step is exact for
    k up to the weak stage order, and not for the next k. Quadrature is exact for these k.
    """
    block = explicit(0, 1, 2)
    text = (
        f"A:\n  - [{block}, {block}]\n  - [{block}, {block}]\nb: [[1/4, 1, -1/4], [1/4, 1, -1/4]]\n"
    )
    tableau = loads(text).tableau
    q = weak_stage_order(tableau, [0, 1], LIMIT)
    assert q == 2
    errors = [_step_error(tableau, k) for k in (1, 2, 3)]
    assert errors[:2] == [[0, 0], [0, 0]]
    assert any(errors[2])


def _step_error(tableau: Tableau, k: int) -> list[Fraction]:
    """The error of a step of size 1 from y = 0 on y' = Σ L_m y + g_m with the solution t^k v, where
    the parts f_m = L_m y + g_m are k t^(k−1) v/2 along it.
    """
    L = [[[3, -7], [5, 2]], [[-4, 1], [6, 11]]]
    v = [1, 2]
    fraction = [[Fraction(int(x.p), int(x.q)) for x in colour.b] for colour in tableau.colours]  # type: ignore[union-attr]

    def part(m: int, t: Fraction, y: list[Fraction]) -> list[Fraction]:
        off = [y[i] - t**k * v[i] for i in range(2)]
        return [
            sum((L[m][i][j] * off[j] for j in range(2)), k * t ** (k - 1) * v[i] / 2)
            for i in range(2)
        ]

    nodes = [Fraction(0), Fraction(1), Fraction(2)]
    stages: list[list[Fraction]] = []
    start = [Fraction(0), Fraction(0)]
    for c in nodes:  # each stage sees the first alone, with its node; both colours have the same
        slopes = [part(m, nodes[0], start) for m in (0, 1)]
        stages.append([start[i] + c * (slopes[0][i] + slopes[1][i]) for i in range(2)])
    new = list(start)
    for m in (0, 1):
        for j, c in enumerate(nodes):
            slope = part(m, c, stages[j])
            new = [new[i] + fraction[m][j] * slope[i] for i in range(2)]
    # b misses quadrature of c² beyond order 2, which is no matter of the stages
    missed = sum(fraction[0][j] * k * c ** (k - 1) for j, c in enumerate(nodes)) - 1
    return [new[i] - v[i] - missed * v[i] for i in range(2)]


def test_no_error_at_all() -> None:
    """Euler's explicit method: its one stage misses nothing, so that the number is a lower bound."""
    found = find_property("forward-euler", "weak-stage-order")
    assert found.is_at_least
    assert found.value == 60


def test_claims_and_families() -> None:
    """A claim that fails is told; of a family the exceptions are named."""
    assert gark("check", "-", stdin=f"{EXPLICIT}expect: {{weak-stage-order: 2}}\n").code == 0
    failing = gark("check", "-", stdin=f"{EXPLICIT}expect: {{weak-stage-order: 3}}\n")
    assert failing.code == 1
    assert "weak-stage-order: expected 3, found 2" in failing.out
    family = "parameters: {t: free}\nA: [[0, 0, 0], [1, 0, 0], [2 - t, t, 0]]\nb: [1/4, 1, -1/4]\n"
    found = gark("check", "-", stdin=f"{family}expect: {{weak-stage-order: 1}}\n")
    assert found.code == 1
    assert "weak-stage-order: expected 1, found 1; 2 where t = 0" in found.out


def test_wanted() -> None:
    """``design``: the method above is the only explicit one of three stages with its nodes, order 2
    and weak stage order 2; of DIRKs of two stages, stiffly accurate, the trapezoidal rule alone.
    """
    head = "unknown: {stages: 3, shape: explicit}\n"
    wanted = "design: {order: 2, weak-stage-order: 2, fix: {c2: 1, c3: 2}}\n"
    (one,) = find_parameters(loads_family(head + wanted)).last.found
    values = {name: str(value) for name, value in one.solution.values.items()}
    assert values == {"c2": "1", "c3": "2", "a32": "0", "b1": "1/4", "b2": "1", "b3": "-1/4"}
    head = "unknown: {stages: 2, shape: dirk}\n"
    wanted = "design: {order: 2, weak-stage-order: 2, stiffly-accurate: true}\n"
    (one,) = find_parameters(loads_family(head + wanted)).last.found
    assert {name: str(x) for name, x in one.solution.values.items()}["a22"] == "1/2"


@in_whole
def test_too_many_products() -> None:
    """Of several colours with many stages the one that is stiff has to be named."""
    text = "unknown: {stages: 8, shape: imex}\ndesign: {order: 1, weak-stage-order: 2}\n"
    with pytest.raises(MethodFileError, match="more than 200 products"):
        loads_family(text)
