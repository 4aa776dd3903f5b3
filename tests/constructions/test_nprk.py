"""Nonlinearly partitioned methods: spans, all trees, and power series that know neither trees nor
gark; files with them.
"""

from __future__ import annotations

from collections import Counter
from fractions import Fraction
from pathlib import Path
from random import Random

import pytest
from flint import fmpq

from garkcli import all_conditions, analyse, claims_of, load, loads, render
from garkcli.check.check_file import check_file, check_method
from garkcli.constructions.nprk import nprk
from garkcli.errors import MethodError, MethodFileError
from garkcli.order.certificate import find_order
from garkcli.order.constants import _in_floats, error_constants
from tests.cli.harness import gark
from tests.constructions.test_rosenbrock import RUNGE_KUTTA, engine
from tests.oracles import nprk_series as series
from tests.oracles.brute import brute_order
from tests.oracles.rosenbrock_series import Matrix
from tests.whole import at_most

LIMIT = 4
MIDPOINT = "nprk: {a: [[], [[0, 1/2]]], b: [[], [0, 1]]}\n"


def random_method(seed: int) -> tuple[list[Matrix], Matrix]:
    """Runge–Kutta methods on the diagonal, one entry moved off it or none; small fractions, most
    of which meet the conditions of order 2.
    """
    dice = Random(seed)
    if dice.random() < 0.4:
        a, b = series.diagonal(*dice.choice(RUNGE_KUTTA))
        if dice.random() < 0.6:
            moved = dice.choice([*a[1:], b])
            rows = [list(row) for row in moved]
            s = len(rows)
            j = dice.choice([j for j in range(s) if rows[j][j]])
            k = dice.choice([k for k in range(s) if k != j])
            rows[j][k], rows[j][j] = rows[j][j], Fraction(0)
            moved[:] = rows  # type: ignore[index]
        return a, b
    s = dice.choice([2, 3])

    def number() -> Fraction:
        return Fraction(dice.randint(-2, 3), dice.randint(1, 3))

    def entry(i: int, j: int, k: int) -> Fraction:
        is_early = max(j, k) < i or (min(j, k) < i and dice.random() < 0.3)
        return number() if is_early else Fraction(0)

    a = [[[entry(i, j, k) for k in range(s)] for j in range(s)] for i in range(s)]
    b = [[number() if dice.random() < 0.5 else Fraction(0) for _ in range(s)] for _ in range(s)]
    b[-1][-1] += 1 - sum(map(sum, b))
    c = [sum(map(sum, x), Fraction(0)) for x in a]
    if c[-1] != c[0] and dice.random() < 0.8:
        for side in (0, 1):
            seen = sum(b[j][k] * c[(j, k)[side]] for j in range(s) for k in range(s))
            off = (Fraction(1, 2) - seen) / (c[-1] - c[0])
            b[0][0] -= off
            (b[-1] if side == 0 else b[0])[0 if side == 0 else -1] += off
    return a, b


def test_random_methods_three_ways() -> None:
    """Spans, all trees and power series find one order; each up to 4 occurs."""
    orders = Counter[int]()
    for seed in range(at_most(70, 250)):
        a, b = random_method(seed)
        tableau, _ = nprk(engine(a), engine(b))
        found = find_order(tableau, LIMIT).order
        assert found == brute_order(tableau, LIMIT) == series.order(a, b, LIMIT, seed)
        orders[found] += 1
    assert {1, 2, 3, 4} <= orders.keys()
    assert orders[2] > 5


def test_arguments_at_different_stages() -> None:
    """RK4 with F(Y_2, Y_3) + F(Y_3, Y_2) in place of F(Y_2, Y_2) + F(Y_3, Y_3) at the end keeps
    order 4; with the stages 1 and 4 so exchanged a product of branches in both arguments fails.
    """
    a, b = series.diagonal(*RUNGE_KUTTA[2])
    for (j, k), order in (((1, 2), 4), ((0, 3), 2)):
        mixed = [list(row) for row in b]
        mixed[j][k], mixed[k][j] = b[j][j], b[k][k]
        mixed[j][j] = mixed[k][k] = Fraction(0)
        found = find_order(nprk(engine(a), engine(mixed))[0], 5)
        assert found.order == series.order(a, mixed, 5) == order
    assert found.witness is not None
    assert {x.root for x in found.witness.tree.branches} == {0, 1}


def test_each_tree_counts_once() -> None:
    """Euler's method F(y, y) misses y'' = F_1 F + F_2 F, two trees, by 1/2 each: what the root's
    colour would be says nothing. Exact norms and floats agree.
    """
    tableau, _ = nprk([[]], [[fmpq(1)]])
    found = error_constants(tableau, 2)
    assert found is not None
    assert (found.all.trees, found.all.two_squared) == (2, fmpq(1, 2))
    in_floats = _in_floats(tableau, 2, 1)
    assert (in_floats.all.trees, in_floats.all.two) == (2, found.all.two)
    assert len(list(all_conditions(tableau, 2))) == 2
    text = gark("conditions", "imex-nprk-42b", "--order", "3").out
    assert "times" not in text
    assert "1 and 2 are the arguments of F that branches are in" in text
    assert "10 conditions, 7 fail" in text


def test_reports_name_the_pairs() -> None:
    """``gark diff`` and ``gark show`` have the pairs of stages once; Python renders the report."""
    text = gark("diff", "imex-nprk-42b", "imex-nprk-42a").out
    assert "nonlinearly partitioned, 2 pairs of stages" in text
    assert [x for x in ("b{1}", "b{2}") if x in text] == ["b{1}"]
    assert gark("diff", "imex-nprk-42b", "rk4").code == 2
    assert "nprk, 1 colour, stages 2\n" in gark("show", "imex-nprk-42b").out
    assert "2 pairs of stages" in render(analyse("imex-nprk-42b"))


def test_files(tmp_path: Path) -> None:
    """Rows and matrices may end early; claims hold, and none larger; embedded weights have theirs;
    digits are rounded by the tolerance.
    """
    text = MIDPOINT.replace("}", ", embedded: [[1]]}") + "expect: {order: 2, embedded-order: 1}"
    path = tmp_path / "method.gark.yaml"
    path.write_text(text, encoding="utf-8")
    assert check_file(str(path)).exit_code == 0
    path.write_text(text.replace("order: 2,", "order: 3,"), encoding="utf-8")
    assert [x.claim for x in check_file(str(path)).failed_claims] == ["order"]
    full = "nprk: {a: [[[0, 0], [0, 0]], [[0, 1/2], [0, 0]]], b: [[0, 0], [0, 1]]}"
    assert loads(full).tableau == loads(MIDPOINT).tableau
    rounded = MIDPOINT.replace("1/2", "0.50001") + "tolerance: 1e-4\nexpect: {order: 2}"
    assert check_method(loads(rounded)).exit_code == 0
    assert claims_of(str(path)) == {"order": "2", "embedded-order": "1"}


@pytest.mark.parametrize("name", ["imex-nprk-32a", "imex-nprk-32b", "imex-nprk-42a"])
def test_published_methods_have_order_two(name: str) -> None:
    """Those of Buvoli and Southworth have order 2 and not 3."""
    found = find_order(load(name).tableau, 5)
    assert (found.order, found.is_lower_bound) == (2, False)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("nprk: {a: [[]]}", "b"),
        ("nprk: {a: [[], [[0, 0, 1]]], b: [[1]]}", "a, stage 2 has 3 entries for 2 stages"),
        ("nprk: {a: [[[1]]], b: [[g]]}\nparameters: {g: free}", "needs numbers, and g is free"),
        (f"conjugate: true\n{MIDPOINT}", "conjugate"),
    ],
)
def test_faults(text: str, message: str) -> None:
    """What is wrong is said, with its place."""
    with pytest.raises(MethodFileError, match=message):
        loads(text)


def test_what_is_for_others_is_refused() -> None:
    """Conjugates and pairs have no meaning for arguments of one field."""
    with pytest.raises(MethodError, match="GARK methods"):
        loads(MIDPOINT).conjugate  # noqa: B018
