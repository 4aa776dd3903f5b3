"""Two methods held against each other: the same in every sense that is claimed, or different with
proof.
"""

from __future__ import annotations

import json
import re
from pathlib import Path
from typing import Any

import jsonschema
import pytest
from flint import arb, fmpq
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from garkcli.comparison.comparison import Comparison, compare
from garkcli.comparison.differences import MAX_CONDITIONS, conditions_met
from garkcli.comparison.grid import Likeness, grid_of
from garkcli.comparison.sameness import find_matching
from garkcli.conversion.convert import convert
from garkcli.conversion.sheet import Sheet, each_its_own, sheet_of
from garkcli.errors import LimitExceeded
from garkcli.frozen import replace
from garkcli.methodfile.load import load, loads
from garkcli.methodfile.writer import write_tableau_file
from garkcli.order.admissible import elementary_weight
from garkcli.properties.reduction import reduced
from garkcli.report.diff import REPORT, ComparedPair
from garkcli.report.schemas import report_schema
from garkcli.tableau.garkmethod import GarkMethod
from tests.cli.harness import ROOT, gark
from tests.conversion.renumbered import orders_of, renumbered
from tests.conversion.test_conversion import PAIR, of_sheet, with_stage_twice
from tests.methodfile.test_further import further_of
from tests.methodfile.test_writer import tableaus
from tests.whole import at_most, in_whole

RK4 = loads((ROOT / "methods/rk4.gark.yaml").read_text(encoding="utf-8"))
HEUN = "{A: [[0, 0], [1, 0]], b: [1/2, 1/2]}"
MISPRINT = (
    "{A: [[0, 0, 0, 0], [1/2, 0, 0, 0], [0, 1/2, 0, 0], [0, 0, 2, 0]], b: [1/6, 1/3, 1/3, 1/6]}"
)


@in_whole
@given(st.data())
@settings(max_examples=at_most(25, 200))
def test_renumbered_methods_are_the_same(data: st.DataObject) -> None:
    """Stages in any order: the renumbering that is named turns one into the other."""
    tableau = data.draw(tableaus())
    stages = [len(colour.b) for colour in tableau.colours]
    further = data.draw(further_of(stages, 1))
    one = GarkMethod(tableau=tableau, embedded=further.embedded, dense=further.dense)
    sheet = sheet_of(one)
    other = renumbered(sheet, data.draw(orders_of(sheet)))
    first, second = grid_of(sheet), grid_of(other)
    images = find_matching(first, second, Likeness())
    assert images is not None
    turned = grid_of(renumbered(other, images))
    assert turned == first


@in_whole
@given(st.data())
@settings(max_examples=at_most(12, 90))
def test_doubled_stages_and_other_colours_are_seen_through(data: st.DataObject) -> None:
    """A stage that appears twice, stages and colours in another order: the same method."""
    sheet = each_its_own(sheet_of(GarkMethod(tableau=data.draw(tableaus()))))
    turned = renumbered(sheet, data.draw(orders_of(sheet)))
    twice = with_stage_twice(turned, 0)
    found = compare(of_sheet(sheet), of_sheet(twice), limit=2)
    assert found.relation == "same"
    assert found.sameness is not None
    assert found.sameness.is_reduced
    order = data.draw(st.permutations(range(sheet.tableau.size)))
    colours = with_colours(turned, order)
    assert compare(of_sheet(sheet), of_sheet(colours), limit=2).relation in {"identical", "same"}


def with_colours(sheet: Sheet, order: list[int]) -> Sheet:
    """The colours in another order, their stages with them."""
    old = sheet.tableau
    place = {l: k for k, l in enumerate(order)}
    colours = [replace(old.colours[l], space=k) for k, l in enumerate(order)]
    blocks = {(place[l], place[m]): x for (l, m), x in old.blocks.items()}
    spaces = tuple(old.spaces[l] for l in order)
    made = replace(old, spaces=spaces, colours=tuple(colours), blocks=blocks)
    return Sheet(made)


@given(st.data())
@settings(max_examples=at_most(12, 90))
def test_one_changed_entry_is_found(data: st.DataObject) -> None:
    """One entry of a block is another number: it is the only gap, with its place and its size, and
    the conditions that are named are met by one method alone.
    """
    tableau = data.draw(tableaus())
    keys = sorted(tableau.blocks)
    assume(keys)
    k, m = data.draw(st.sampled_from(keys))
    block = [list(row) for row in tableau.blocks[k, m]]
    i = data.draw(st.integers(0, len(block) - 1))
    j = data.draw(st.integers(0, len(block[0]) - 1))
    step = fmpq(1, data.draw(st.integers(1, 9)))
    block[i][j] = block[i][j] + step
    blocks = {**tableau.blocks, (k, m): tuple(map(tuple, block))}
    changed = replace(tableau, blocks=blocks)
    found = compare(GarkMethod(tableau=tableau), GarkMethod(tableau=changed), limit=3)
    (gap,) = found.gaps
    (entry,) = gap.gaps
    assert (gap.kind, gap.colour, gap.seen) == ("A", k, m)
    assert (entry.row, entry.entry, entry.gap) == (i, j, step)
    if found.met is not None:
        assert_met(found.met, tableau, changed)


def assert_met(met: Any, one: Any, other: Any) -> None:
    """Each condition is met by the method that is said to meet it, and not by the other one."""
    for pairs, holds in ((met.first_only, one), (met.second_only, other)):
        fails = other if holds is one else one
        for condition, _ in pairs:
            required = fmpq(1, condition.tree.density)
            assert elementary_weight(holds, condition.tree) == required
            assert elementary_weight(fails, condition.tree) != required


def test_a_misprint_is_shown_with_what_it_costs() -> None:
    """The last row of RK4 with 2 in place of 1: its order, its conditions, its properties."""
    found = compare(RK4, loads(MISPRINT))
    assert found.relation == "different"
    orders = {pair.name: pair for pair in found.orders}
    order = orders["order"]
    assert order.one is not None
    assert order.other is not None
    assert (order.one.order, order.other.order) == (4, 1)
    assert found.met is not None
    assert_met(found.met, RK4.tableau, loads(MISPRINT).tableau)
    assert len(found.met.first_only) == 7
    keys = [pair.key for pair in found.properties]
    assert "nodes-in-unit-interval" in keys
    assert "explicit" not in keys
    assert "imaginary-stability" in keys


def test_forms_do_not_matter() -> None:
    """An additive method against itself as a GARK method, and a partitioned one likewise."""
    for name in ("ark-ars222", "stoermer-verlet", "prk-lobatto-iiia-iiib"):
        method = load(str(ROOT / "methods" / f"{name}.gark.yaml"))
        found = compare(method, convert(method, "gark").method)
        assert found.relation == "same"
        assert found.forms[0] != found.forms[1]
        assert found.gaps == ()


def test_what_alone_is_different_is_said() -> None:
    """Nodes that are printed otherwise, and a colour that is linear: entries of A and b are the
    same.
    """
    midpoint = "{A: [[0, 0], [1/2, 0]], b: [0, 1]}"
    other = loads(midpoint.replace("]}", "], c: [0, 1/3]}"))
    found = compare(loads(midpoint), other)
    assert (found.relation, found.remark) == ("different", "nodes alone differ")
    path = ROOT / "methods/stoermer-verlet.gark.yaml"
    verlet = path.read_text(encoding="utf-8")
    nystrom = verlet.replace("structure: separable", "structure: nystrom")
    found = compare(loads(verlet), loads(nystrom))
    assert found.relation == "different"
    assert found.remark.endswith("which colours are linear is not")
    run = gark("diff", str(path), "-", stdin=nystrom)
    assert found.remark in " ".join(run.out.split())
    assert compare(loads(nystrom), loads(midpoint)).remark == ""


def test_families_are_compared_with_what_they_are_spelled_out() -> None:
    """In number fields of their own the entries are equal exactly."""
    method = load(str(ROOT / "methods/collocation.gark.yaml"))
    spelled = convert(method).method
    found = compare(method, spelled)
    assert found.relation == "identical"
    assert found.sameness is not None
    assert not found.sameness.allowed


@in_whole
def test_nodes_without_radicals() -> None:
    """Gauss 5 is itself, is not Radau IIA 5, and its decimals agree within their rounding."""
    gauss = loads("methods: {family: gauss, stages: 5}")
    radau = loads("methods: {family: radau-iia, stages: 5}")
    assert compare(gauss, gauss).relation == "identical"
    assert compare(gauss, radau, limit=1).relation == "different"
    run = gark(*("tableau", "-", "--format", "yaml", "--digits", "25"), stdin=gauss.text)
    decimals = loads(run.out)
    assert compare(gauss, decimals, limit=1).relation == "within-rounding"
    exact = replace(decimals, tolerance=None)
    assert compare(gauss, exact, limit=1).relation == "different"


def test_enclosures_that_overlap_prove_nothing() -> None:
    """They are neither alike nor different."""
    wide = arb(1, 1e-70)
    assert Likeness().cells(wide, fmpq(1)) is None
    assert Likeness(fmpq(1, 10)).cells(wide, fmpq(1)) is True
    assert Likeness(fmpq(1, 10)).cells(wide, fmpq(2)) is False


def test_rounding_is_as_large_as_both_files_admit() -> None:
    """Decimals of 1/3 agree with it within their tolerance, and in no less."""
    exact = loads("{A: [[1/3]], b: [1]}")
    rounded = loads("{A: [[0.33333]], b: [1], tolerance: 1e-5}")
    found = compare(exact, rounded)
    assert found.relation == "within-rounding"
    assert found.allowed == fmpq(1, 10**5)
    tight = loads("{A: [[0.33333]], b: [1], tolerance: 1e-6}")
    assert compare(exact, tight).relation == "different"


def test_embedded_weights_are_part_of_the_method() -> None:
    """The step is the same, the estimate of its error is not; without them neither."""
    other = loads(PAIR.replace("7/24, 1/4, 1/3, 1/8", "0, 1, 0, 0"))
    plain = replace(other, embedded=None, dense=None)
    for changed, relation in ((other, "different"), (plain, "same-step")):
        found = compare(loads(PAIR), changed)
        assert found.relation == relation
        assert found.sameness is not None
        assert found.sameness.step_only
        assert "embedded weights" in found.remark
        kinds = {gap.kind for gap in found.gaps}
        assert "embedded" in kinds
        assert kinds <= {"embedded", "dense"}
    orders = {pair.name: pair for pair in compare(loads(PAIR), other).orders}
    pair = orders["order of the embedded weights"]
    assert (pair.one.order, pair.other.order) == (2, 2)  # type: ignore[union-attr]


def test_a_method_without_estimate_is_the_same_step(tmp_path: Path) -> None:
    """Heun's method under another name is that of the catalogue, which has embedded weights; with
    other ones, and with --strict, it is not.
    """
    plain = "name: mine\nA: [[0, 0], [1, 0]]\nb: [1/2, 1/2]\n"
    mine = tmp_path / "mine.yaml"
    cases = (("", 0, 1), ("embedded: [0, 1]\n", 1, 1), ("embedded: [1, 0]\n", 0, 0))
    for further, code, strict in cases:
        mine.write_text(plain + further, encoding="utf-8")
        command = "diff", str(mine), "heun"
        assert (gark(*command).code, gark(*command, "--strict").code) == (code, strict)
        assert compare(load(str(mine)), load("heun")).is_same_step is (code == 0)
        data = json.loads(gark(*command, "--format", "json").out)
        jsonschema.validate(data, report_schema("diff"))
        wanted = {"": "same-step", "embedded: [0, 1]\n": "different"}
        assert data["relation"] == wanted.get(further, "identical")
    assert not compare(load("rk4"), load("heun")).is_same_step


def test_the_title_has_the_names_as_typed() -> None:
    """An alias is written as it was typed; the row of the method and JSON have its name."""
    run = gark("diff", "lobatto-iiia-2", "Trapezoid")
    first, row, *_ = run.out.splitlines()
    assert first.startswith("lobatto-iiia-2 against Trapezoid: identical")
    assert row.startswith("  first   implicit-trapezoidal, trapezoidal rule: 1 colour")
    data = json.loads(gark("diff", "lobatto-iiia-2", "Trapezoid", "--format", "json").out)
    assert data["first"]["file"] == "implicit-trapezoidal"


def test_a_stage_for_the_estimate_is_not_left_out() -> None:
    """The last stage of the pair has no weight, but an embedded one; without it the step alone is
    that of the method of three stages.
    """
    plain = loads("{A: [[0, 0, 0], [1/2, 0, 0], [0, 3/4, 0]], b: [2/9, 1/3, 4/9]}")
    found = compare(loads(PAIR), plain)
    assert found.relation == "same-step"
    assert found.sameness is not None
    assert (found.sameness.is_reduced, found.sameness.step_only) == (True, True)


def test_many_alike_stages_end_the_search() -> None:
    """Where nothing tells stages apart by themselves a search does; as all of them are equal in
    both methods, these are the same once reduced.
    """
    size = 8
    ring = tuple(
        tuple(fmpq(j in {(i + 1) % size, (i - 1) % size}) for j in range(size)) for i in range(size)
    )
    squares = tuple(
        tuple(fmpq(i // 4 == j // 4 and (i - j) % 4 in {1, 3}) for j in range(size))
        for i in range(size)
    )
    grids = [grid_of(sheet_of(loads(graph(rows)))) for rows in (ring, squares)]
    assert find_matching(grids[0], grids[1], Likeness()) is None
    found = compare(loads(graph(ring)), loads(graph(squares)), limit=1)
    assert found.sameness is not None
    assert found.sameness.is_reduced
    assert found.sameness.stages == ((0,),)


def graph(rows: Any) -> str:
    """A method whose matrix is that of a graph."""
    text = ", ".join(f"[{', '.join(map(str, row))}]" for row in rows)
    weights = ", ".join(["1/8"] * len(rows))
    return f"{{A: [{text}], b: [{weights}]}}"


def test_the_search_gives_up_honestly(monkeypatch: Any) -> None:
    """What is not decided is said so, with exit code 3."""
    matching = "garkcli.comparison.sameness.MAX_TRIALS"
    monkeypatch.setattr(matching, 0)
    one = grid_of(sheet_of(loads(HEUN)))
    with pytest.raises(LimitExceeded):
        find_matching(one, one, Likeness())
    run = gark("diff", "-", "methods/rk4.gark.yaml", stdin=HEUN)
    assert run.code == 1  # other numbers of stages need no search
    turned = "{A: [[0, 1], [0, 0]], b: [1/2, 1/2]}"
    assert compare(loads(HEUN), loads(turned)).relation == "undecided"


def test_few_conditions_are_compared_of_many() -> None:
    """No more than so many; which orders are complete is said."""
    side = load(str(ROOT / "methods/three-colours.gark.yaml")).tableau
    found = conditions_met(side, side, (0, 11))
    assert found.pairs == ()
    assert 3 <= found.order < 12
    assert MAX_CONDITIONS >= 1000


def shown(found: Comparison, format: str = "text", verbosity: int = 0) -> str:
    """A report of gark diff."""
    compared = ComparedPair(found, ("first.gark.yaml", "second.gark.yaml"))
    return REPORT.render([compared], format, verbosity=verbosity)


@in_whole
def test_reports() -> None:
    """Text of 80 columns, JSON after its schema, Markdown with a verdict, for every relation."""
    schema = report_schema("diff")
    texts = {
        "different": MISPRINT,
        "same": RENUMBERED,
        "identical": RK4.text,
        "more colours": PAIR_OF_COLOURS,
        "within-rounding": ROUNDED,
    }
    for name, text in texts.items():
        found = compare(RK4, loads(text))
        assert found.relation == name or name == "more colours"
        lines = shown(found).splitlines()
        assert lines[0].startswith("first.gark.yaml against second.gark.yaml: ")
        assert max(map(len, lines)) <= 80
        assert len(lines) <= 24
        assert max(map(len, shown(found, verbosity=1).splitlines())) <= 80
        data = json.loads(shown(found, "json"))
        jsonschema.validate(data, schema)
        assert data["relation"] == found.relation
        assert shown(found, "markdown").count("**") == 2
        assert r"\subsection*{first.gark.yaml against" in shown(found, "latex")


def test_a_tolerance_is_a_difference_of_the_files_alone() -> None:
    """With another tolerance and the same entries the tolerances are shown, and what the rounding
    leaves open is no difference of the methods.
    """
    found = compare(RK4, loads(f"{RK4.text}\ntolerance: 1e-3\n"))
    text = shown(found)
    assert re.search(r"  tolerance +none against 1e-3\n", text)
    assert "  properties" not in text
    assert "decided of one alone" in text
    assert "not decided" in text
    assert "| tolerance | none against 1e-3 |" in shown(found, "markdown")
    data = json.loads(shown(found, "json"))
    assert (data["first"]["tolerance"], data["second"]["tolerance"]) == (None, "1e-3")


@in_whole
def test_what_rounding_allows_is_said_in_every_format() -> None:
    """A verdict on rounded methods and their orders have the tolerance beside them; it is written
    as in all other reports.
    """
    alike, other = (compare(RK4, loads(text)) for text in (ROUNDED, OTHER_ROUNDED))
    for format in ("text", "markdown", "latex"):
        assert "the same method within 1e-11" in shown(alike, format)
        assert "orders" in shown(other, format)
        assert "4 against 2 within 1e-9" in " ".join(shown(other, format).split())
    data = json.loads(shown(alike, "json"))
    assert (data["second"]["tolerance"], data["same"]["within"]) == ("1e-11", "1e-11")
    assert json.loads(shown(other, "json"))["second"]["tolerance"] == "1e-9"
    itself = compare(loads(ROUNDED), loads(MISPRINT))
    assert "4 within 1e-11 against 1" in shown(itself, "markdown")


@in_whole
def test_exit_codes() -> None:
    """0 where the methods are the same, with --strict where every entry is."""
    for text, code, strict in ((MISPRINT, 1, 1), (RENUMBERED, 0, 1), (RK4.text, 0, 0)):
        arguments = ("diff", "methods/rk4.gark.yaml", "-")
        assert gark(*arguments, stdin=text).code == code
        assert gark(*arguments, "--strict", stdin=text).code == strict


RENUMBERED = write_tableau_file(renumbered(sheet_of(RK4), [[2, 0, 1, 3]]).tableau, "turned")
PAIR_OF_COLOURS = "ark: {A: [[[0]], [[1]]], b: [1]}"
OTHER_ROUNDED = "{A: [[0, 0], [0.333333333, 0]], b: [-0.5, 1.5], tolerance: 1e-9}"
ROUNDED = RK4.text.split("expect")[0].replace("1/6", "0.166666666667") + "tolerance: 1e-11\n"


def test_trees_and_entries_in_words() -> None:
    """What is said of a misprint: the entry, the orders, the conditions, with their trees."""
    run = gark("diff", "methods/rk4.gark.yaml", "-", stdin=MISPRINT)
    rows = [line.split("  ") for line in re.sub("   +", "  ", run.out).splitlines()]
    assert ["", "A", "1 of 16", "row 4, entry 3", "1", "2", "1"] in rows
    assert ["", "[[]]", "2", "1/2", "1/2", "2/3"] in rows
    assert "to order 5 the first alone meets 7, the second none" in run.out
    found = compare(RK4, loads(MISPRINT))
    text = REPORT.render([ComparedPair(found, ("a|b", "second"))], "markdown")
    assert r"**a\|b against second: different methods**" in text
    assert "| `[[]]` | 2 | 1/2 | 1/2 | 2/3 |" in text
    everything = gark("diff", "methods/rk4.gark.yaml", "-", "-v", stdin=MISPRINT).out
    assert "[[[[]]]]" in everything
    assert "more with -v" in run.out
    assert "more with -v" not in everything


def test_renumberings_in_words() -> None:
    """Which stage is which, and in which form."""
    turned = "{A: [[0, 1], [0, 0]], b: [1/2, 1/2]}"
    run = gark("diff", "-", "methods/rk4.gark.yaml", stdin=turned)
    assert "shape" in run.out
    found = compare(loads(HEUN), loads(turned))
    assert found.sameness is not None
    assert found.sameness.stages == ((1, 0),)
    ark = "ark: {A: [[[0, 0], [1, 0]], [[1, 0], [0, 1]]], b: [1/2, 1/2], c: [0, 1]}"
    other = "ark: {A: [[[1, 0], [0, 1]], [[0, 0], [1, 0]]], b: [1/2, 1/2], c: [0, 1]}"
    exchanged = compare(loads(ark), loads(other))
    assert exchanged.sameness is not None
    assert exchanged.sameness.colours == (1, 0)


def test_families_need_values(tmp_path: Path) -> None:
    """A value goes to the file that has the parameter, or to both; an unknown one is refused."""
    family = "parameters: {t: free}\nA: [[0, 0], [t, 0]]\nb: [0, 1]\n"
    path = tmp_path / "family.gark.yaml"
    path.write_text(family, encoding="utf-8")
    plain = "{A: [[0, 0], [1/2, 0]], b: [0, 1]}"
    arguments = ("diff", str(path), "-")
    assert gark(*arguments, "--set", "t=1/2", stdin=plain).code == 0
    assert gark(*arguments, "--set", "t=1/3", stdin=plain).code == 1
    assert gark(*arguments, "--set", "t=1/3", stdin=family).code == 0
    refused = gark(*arguments, "--set", "tau=1", stdin=plain)
    assert refused.code == 2
    assert "t is free" in refused.err
    unknown = gark(*arguments, "--set", "t=1", "--set", "s=1", stdin=plain)
    assert unknown.code == 2
    assert "neither file has such a parameter" in unknown.err


def test_files_that_cannot_be_read() -> None:
    """One that is not there is a mistake of the call."""
    run = gark("diff", "methods/rk4.gark.yaml", "nowhere.gark.yaml")
    assert run.code == 2
    assert "no such file" in run.err


def test_orders_that_neither_has_are_no_rows() -> None:
    """In Markdown as in text: a conjugate of neither is left out, one of one alone is none."""
    midpoint = loads("A: [[0, 0], [1/2, 0]]\nb: [0, 1]\n")
    assert "of the conjugate" not in shown(compare(midpoint, midpoint), "markdown")
    assert "; of the conjugate none against 4;" in shown(compare(midpoint, RK4), "markdown")


def test_a_stage_without_influence_is_no_difference() -> None:
    """A colour of weight 0 that nobody sees: methods that differ in its row alone are the same once
    reduced, and `gark reduce` writes zeros there.
    """
    text = "tableau: {A: [[[[1/2]], [[0]]], [[[ROW]], [[OWN]]]], b: [[1], [0]]}"
    one, other = (
        loads(text.replace("ROW", row).replace("OWN", own))
        for row, own in (("1/4", "3/4"), ("1/3", "1/5"))
    )
    found = compare(one, other)
    assert found.sameness is not None
    assert found.sameness.is_reduced
    smaller = reduced(one.tableau)
    assert smaller is not None
    assert smaller.blocks[1, 0] == smaller.blocks[1, 1] == ((0,),)
    assert reduced(smaller) is smaller


@in_whole
def test_properties_of_rounded_coefficients_say_so() -> None:
    """What is an equation holds within the tolerance; what rounding does not change holds as it is."""
    run = gark("diff", "tests/examples/valid/rounded.gark.yaml", "rk4", "-v")
    rows = {x.split()[0]: x.split()[1:] for x in run.out.splitlines() if x.startswith("  ")}
    assert rows["symmetric"] == rows["symplectic"] == ["yes", "within", "1e-14", "no"]
    assert rows["stage-order"] == ["2", "within", "1e-14", "1"]
    assert rows["fully-implicit"] == ["yes", "no"]
