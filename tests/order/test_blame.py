"""Who is to blame for a failing order."""

from __future__ import annotations

from fractions import Fraction
from pathlib import Path

import pytest
from flint import fmpq
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from garkcli import Tableau, conjugate, find_order, load, loads
from garkcli.check.check_file import check_file
from garkcli.exact.field import Number
from garkcli.frozen import replace
from garkcli.ntrees.table import TreeTable
from garkcli.ntrees.tree import Tree
from garkcli.order.admissible import coupling_graph
from garkcli.order.blame import MissedOrder, blame_of, count_entries, slip_of
from garkcli.order.repair import Repair, RepairedEntry
from garkcli.order.tolerance import within
from tests.whole import at_most, in_whole

ROOT = Path(__file__).resolve().parents[2]


def example(name: str) -> Tableau:
    """A method of the distribution."""
    return load(str(ROOT / "methods" / f"{name}.gark.yaml")).tableau


def test_misprinted_collocation_example() -> None:
    """The paper's misprinted block A^{1,2} is named; no single entry repairs four wrong ones."""
    tableau = load(str(ROOT / "tests/examples/failing/collocation-misprinted.gark.yaml")).tableau
    blame = blame_of(tableau, MissedOrder(3, 4))
    assert blame is not None
    assert blame.culprit == (0, 1)
    assert blame.in_every == ((0, 1),)
    assert blame.in_none == ((1, 1),)
    assert blame.only_coupling
    assert (blame.failing, blame.total) == (4, 14)
    assert blame.repairs == ()


@pytest.mark.parametrize(
    ("key", "i", "j"), [((0, 0), 1, 0), ((0, 1), 0, 1), ((1, 0), 2, 1), ((1, 1), 2, 1)]
)
def test_single_wrong_entry(key: tuple[int, int], i: int, j: int) -> None:
    """One entry changed in any block is found again, with its true value, and its block is the
    culprit.
    """
    tableau = example("collocation-conjugate")
    block = [list(row) for row in tableau.blocks[key]]
    true = block[i][j]
    block[i][j] = true + fmpq(1, 7)
    wrong = replace(tableau, blocks={**tableau.blocks, key: tuple(map(tuple, block))})
    blame = blame_of(wrong, MissedOrder(find_order(wrong).order + 1, 4))
    assert blame is not None
    assert blame.culprit == key
    assert Repair(*key, i, j, true + fmpq(1, 7), true) in blame.repairs
    assert blame.only_coupling == (key[0] != key[1])


@pytest.mark.parametrize(
    ("name", "within_shape", "all_entries"),
    [("rk4", 6 + 4, 16 + 4), ("sdirk-2", 3 + 2, 4 + 2), ("gauss-2", 4 + 2, 4 + 2)],
)
def test_entries_of_the_shape(name: str, within_shape: int, all_entries: int) -> None:
    """Below the diagonal of an explicit method, up to it of a diagonally implicit one."""
    tableau = load(name).tableau
    assert count_entries(tableau, MissedOrder(5, 5, keeps_shape=True)) == within_shape
    assert count_entries(tableau, MissedOrder(5, 5)) == all_entries


def test_single_wrong_weight() -> None:
    """A wrong weight is found, though the sum of the weights alone would allow each of them to be
    the wrong one.
    """
    tableau = example("collocation-conjugate")
    b = tableau.colours[1].b
    colours = (tableau.colours[0], replace(tableau.colours[1], b=(b[0], fmpq(3, 5), b[2])))
    blame = blame_of(replace(tableau, colours=colours), MissedOrder(1, 4))
    assert blame is not None
    assert [(x.l, x.m, x.j, x.new) for x in blame.repairs] == [(1, None, 1, fmpq(2, 3))]


def test_entries_that_mend_one_condition_of_two_hide_no_wrong_one() -> None:
    """Merson's method with the stage of weight 0 last, whose row has 1/3 for 1/6: two conditions of
    order 4 fail. Entries of earlier rows make the first hold, and not the second.
    """
    text = """
A:
  - [0, 0, 0, 0, 0]
  - [1/3, 0, 0, 0, 0]
  - [1/8, 0, 0, 0, 3/8]
  - [1/2, 0, 2, 0, -3/2]
  - [1/6, 1/3, 0, 0, 0]
b: [1/6, 0, 2/3, 1/6, 0]
"""
    wrong = loads(text).tableau
    assert find_order(wrong).order == 3
    blame = blame_of(wrong, MissedOrder(4, 4))
    assert blame is not None
    assert Repair(0, 0, 4, 1, fmpq(1, 3), fmpq(1, 6)) in blame.repairs


def test_right_method_has_no_repair_for_more() -> None:
    """Where the method is right as it is, no change of one entry is proposed for an order it cannot
    have.
    """
    tableau = example("rectangular")
    blame = blame_of(tableau, MissedOrder(5, 6))
    assert blame is not None
    assert blame.repairs == ()


def test_too_many_conditions() -> None:
    """Beyond the limit nothing is listed and nothing is claimed."""
    tableau = example("gauss6-lobatto7")
    assert blame_of(conjugate(tableau), MissedOrder(13, 14)) is None


PRINTED = """
methods:
- A: [[0.25, -0.03867513459481288], [0.53867513459481288, 0.25]]
  b: [0.5, 0.5]
"""
WRONG = PRINTED.replace("0.53867513459", "0.53867513460")


@pytest.mark.parametrize("key", ["order", "conjugate-order", "pair-order"])
def test_blame_within_a_tolerance(key: str, tmp_path: Path) -> None:
    """One digit is wrong in the 11th place: the entry is named whatever claim shows it, and with
    the digits it should have.
    """
    file = tmp_path / "m.gark.yaml"
    file.write_text(f"{WRONG}tolerance: 1e-15\nexpect: {{{key}: 4}}\n")
    blame = check_file(str(file)).blame
    assert blame is not None
    assert (blame.of, blame.order) == (key, 2)
    (repair,) = [x for x in blame.repairs if (x.m, x.i, x.j) == (0, 1, 0)]
    assert within(repair.new - fmpq(53867513459481288, 10**17), fmpq(1, 10**15))


@in_whole
def test_what_rounding_explains_has_nobody_to_blame(tmp_path: Path) -> None:
    """Where the tolerance is too tight for all entries no single one is named."""
    file = tmp_path / "m.gark.yaml"
    file.write_text(
        "methods: [{A: [[0.25, -0.03867513], [0.53867513, 0.25]], b: [0.5, 0.5]}]\n"
        "tolerance: 1e-9\nexpect: {order: 4}\n"
    )
    found = check_file(str(file))
    assert found.blame is None
    assert found.remark is not None
    assert found.remark.line == "tolerance: 1e-8"


@pytest.mark.parametrize(("key", "j"), [("conjugate-order", 0), ("pair-order", 1)])
def test_an_exact_entry_is_found_through_the_conjugate(key: str, j: int, tmp_path: Path) -> None:
    """A wrong entry of Gauss 2 over ℚ(√3) is repaired by what the conjugate, or the pair, claims."""
    rows = [["1/4", "1/4 - sqrt(3)/6"], ["1/4 + sqrt(3)/6", "1/4"]]
    rows[1 - j][j] += " + 1/100"
    A = ", ".join(f"[{', '.join(row)}]" for row in rows)
    file = tmp_path / "m.gark.yaml"
    file.write_text(f"methods: [{{A: [{A}], b: [1/2, 1/2]}}]\nexpect: {{{key}: 4}}\n")
    blame = check_file(str(file)).blame
    assert blame is not None
    assert blame.of == key
    assert [(x.i, x.j) for x in blame.repairs] == [(1 - j, j)]
    assert blame.repairs[0].old - blame.repairs[0].new == fmpq(1, 100)


def test_an_entry_that_leaves_no_conjugate_is_passed_over(tmp_path: Path) -> None:
    """The weights of the trapezoidal rule add up to 1 as well with b₁ = 0, which has no conjugate:
    b₂ is named.
    """
    file = tmp_path / "m.gark.yaml"
    text = "methods: [{{A: [[0, 0], [1/2, 1/2]], b: [1/2, {}]}}]\nexpect: {{conjugate-order: 2}}\n"
    file.write_text(text.format("1"))
    blame = check_file(str(file)).blame
    assert blame is not None
    assert [(x.m, x.j, x.new) for x in blame.repairs] == [(None, 1, fmpq(1, 2))]
    file.write_text(text.format("1/2"))
    assert check_file(str(file)).blame is None


def test_a_colour_that_sees_nothing_hides_no_wrong_entry(tmp_path: Path) -> None:
    """Radau IIA beside a part that is constant: order 3 with the true entry of the method, found
    though the constant part has no tree above its root.
    """
    A = "[[null, null], [[[1/3], [1]], [[5/12, -1/12], [{}, 1/4]]]]"
    text = f"tableau: {{{{A: {A}, b: [[1], [3/4, 1/4]]}}}}\nexpect: {{{{order: 3}}}}\n"
    file = tmp_path / "m.gark.yaml"
    file.write_text(text.format("2/3"))
    blame = check_file(str(file)).blame
    assert blame is not None
    assert [(x.l, x.m, x.i, x.j, x.new) for x in blame.repairs] == [(1, 1, 1, 0, fmpq(3, 4))]
    file.write_text(text.format("3/4"))
    assert check_file(str(file)).blame is None


def test_without_a_claim_an_explicit_method_misses_no_diagonal_entry() -> None:
    """a₂₂ = 1/3 makes Radau I of order 3 of it, which is no slip of one who writes an explicit
    method; where a claim is missed it is named.
    """
    tableau = loads("A: [[0, 0], [1/3, 0]]\nb: [1/4, 3/4]\n").tableau
    found = find_order(tableau)
    assert found.order == 1
    assert slip_of(tableau, MissedOrder(0, 0), found) is None
    blame = blame_of(tableau, MissedOrder(2, 3))
    assert blame is not None
    assert Repair(0, 0, 1, 1, fmpq(0), fmpq(1, 3)) in blame.repairs


def weight(tableau: Tableau, tree: Tree) -> Number:
    """The elementary weight, by its definition."""

    def stages(u: Tree) -> list[Number]:
        values: list[Number] = [fmpq(1)] * len(tableau.colours[u.root].b)
        for branch in u.branches:
            inner = stages(branch)
            block = tableau.block(u.root, branch.root)
            assert block is not None
            for i, row in enumerate(block):
                values[i] *= sum((a * x for a, x in zip(row, inner, strict=True)), fmpq(0))
        return values

    b = tableau.colours[tree.root].b
    return sum((a * x for a, x in zip(b, stages(tree), strict=True)), fmpq(0))


SPOILT = {
    "kutta-3": 3,
    "radau-iia-2": 3,
    "rk4": 4,
    "merson-4": 4,
    "ark-324": 3,
    "ars-222": 2,
    "collocation-conjugate": 4,
    "rectangular": 4,
}
"""Methods with rational coefficients, and their orders."""


def spoilt(name: str, data: st.DataObject) -> Tableau:
    """One entry of a block or a weight is another number."""
    in_catalogue = name not in {"collocation-conjugate", "rectangular"}
    tableau = load(name).tableau if in_catalogue else example(name)
    l = data.draw(st.integers(0, tableau.size - 1))
    m = data.draw(st.sampled_from([None, *(m for k, m in tableau.edges() if k == l)]))
    off = data.draw(st.sampled_from([fmpq(1, 7), fmpq(-1, 2), fmpq(3)]))
    rows = [tableau.colours[l].b] if m is None else tableau.block(l, m)
    assert rows is not None
    i = data.draw(st.integers(0, len(rows) - 1))
    j = data.draw(st.integers(0, len(rows[i]) - 1))
    entry = RepairedEntry(l, m, None if m is None else i, j, rows[i][j])
    return entry.put(tableau, rows[i][j] + off)


@pytest.mark.parametrize("name", SPOILT)
@given(st.data())
@settings(max_examples=at_most(3, 25))
def test_blame_is_that_of_all_trees(name: str, data: st.DataObject) -> None:
    """Which blocks are in failing conditions, the one in most of them, and each entry whose change
    alone gives the order: by the definition of elementary weights, tree by tree.
    """
    claimed = SPOILT[name]
    wrong = spoilt(name, data)
    order = find_order(wrong).order
    assume(order < claimed)
    blame = blame_of(wrong, MissedOrder(order + 1, claimed))
    assert blame is not None
    table = TreeTable.of(coupling_graph(wrong), claimed)
    trees = [table.tree(k) for k in range(len(table))]
    spaces = [colour.space for colour in wrong.colours]

    def blocks(u: Tree) -> set[tuple[int, int]]:
        return {(spaces.index(spaces[v.root]), w.root) for v in u.vertices() for w in v.branches}

    def holds(tableau: Tableau, u: Tree) -> bool:
        return weight(tableau, u) == fmpq(1, u.density)

    seen: dict[object, Tree] = {}  # colours that share stages and weights have one condition
    for u in trees:
        if u.order == order + 1:
            below = tuple(sorted(str(x) for x in u.branches))
            seen.setdefault((spaces[u.root], wrong.colours[u.root].b, below), u)
    failing = [u for u in seen.values() if not holds(wrong, u)]
    assert (blame.order, blame.failing, blame.total) == (order + 1, len(failing), len(seen))
    every = sorted({(spaces.index(spaces[l]), m) for l, m in wrong.edges()})
    uses = {x: [u for u in failing if x in blocks(u)] for x in every}
    assert blame.in_every == tuple(x for x in every if len(uses[x]) == len(failing))
    assert blame.in_none == tuple(x for x in every if not uses[x])
    share = {
        x: Fraction(len(failing), sum(x in blocks(u) for u in seen.values()))
        for x in blame.in_every
    }
    best = [x for x in share if share[x] == max(share.values())]
    assert blame.culprit == (best[0] if len(best) == 1 else None)
    assert blame.only_coupling == all(len({v.root for v in u.vertices()}) > 1 for u in failing)

    repaired = set()
    entries = [
        RepairedEntry(l, m, i, j, old)
        for l, m in every
        for i, row in enumerate(wrong.block(l, m) or ())
        for j, old in enumerate(row)
    ]
    entries += [
        RepairedEntry(l, None, None, j, old)
        for l, colour in enumerate(wrong.colours)
        for j, old in enumerate(colour.b)
    ]
    for entry in entries:
        first = failing[0]
        at = [weight(entry.put(wrong, entry.old + k), first) for k in (0, 1, 2, 5)]
        slope = at[1] - at[0]
        if slope and at[2] - at[1] == slope and at[3] - at[0] == 5 * slope:
            new = entry.old + (fmpq(1, first.density) - at[0]) / slope
            if all(holds(entry.put(wrong, new), u) for u in trees):
                repaired.add((entry.l, entry.m, entry.i, entry.j, entry.old, new))
    assert {(x.l, x.m, x.i, x.j, x.old, x.new) for x in blame.repairs} == repaired
