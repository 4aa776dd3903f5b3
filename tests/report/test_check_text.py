"""The report for people: numbers of every kind, colour only where it is asked for."""

import re
from pathlib import Path

import pytest

from garkcli.check.check_file import check_file
from garkcli.check.claims import verify
from garkcli.check.deciding import analyse
from garkcli.check.outcome import Outcome
from garkcli.methodfile.load import loads
from garkcli.order.blame import find_blame
from garkcli.order.constants import error_constants
from garkcli.page.paint import Paint, aligned, beside
from garkcli.report.check_text import render
from garkcli.report.hints import blame_lines

ESCAPE = re.compile(r"\x1b\[[0-9;]*m")


def outcome(text: str, file: str = "m.gark.yaml") -> Outcome:
    """What ``gark check`` finds about a text."""
    method = loads(text, file)
    analysis = analyse(method.tableau)
    return Outcome(
        file, method.name, method.structure, analysis, verify(method.claims, analysis), text=text
    )


def report(text: str) -> str:
    """The full report on a text, with no colour."""
    return render([outcome(text)], Paint())


def tableau(entry: str, weight: str = "1") -> str:
    """A method of one stage."""
    return f"tableau: {{A: [[[[{entry}]]]], b: [[{weight}]]}}"


@pytest.mark.parametrize(
    ("text", "line"),
    [
        (tableau("-1/2"), "-1/2 instead of 1/2, off by -1"),
        (tableau("0"), "0 instead of 1/2, off by -1/2"),
        (tableau("sqrt(2)/2"), "sqrt(2)/2 instead of 1/2, off by -1/2 + sqrt(2)/2"),
        (tableau("1/2", "0"), "0 instead of 1, off by -1"),
        (tableau("1/2", "-sqrt(3)"), "-sqrt(3) instead of 1, off by -1 - sqrt(3)"),
        (tableau("1/2", "cbrt(2)"), "cbrt(2) instead of 1, off by -1 + cbrt(2)"),
    ],
)
def test_a_residual_is_written_exactly(text: str, line: str) -> None:
    """Negative, zero and irrational values stand in the report as exact numbers, with their
    difference.
    """
    assert line in report(text)


def test_long_values_get_lines_of_their_own() -> None:
    """A value too long for a sentence is written as value, required, residual, one below the
    other.
    """
    found = report(tableau("123456789012345678901234567890/11"))
    assert "value    123456789012345678901234567890/11" in found
    assert "required 1/2" in found


def test_a_method_of_no_order_has_order_zero() -> None:
    """Weights that do not sum to 1 fail at order 1, at the single vertex."""
    found = report(tableau("1/2", "2"))
    assert re.search(r"^  order +0$", found, re.MULTILINE)
    assert "fails at order 1: []" in found


def test_a_zero_weight_is_named() -> None:
    """Where there is no conjugate the report says which weight is in the way, and goes on."""
    found = report("methods: [{family: explicit-midpoint}]")
    assert re.search(r"^  order +2$", found, re.MULTILINE)
    assert "b_1 = 0" in found
    assert "symplectic       no" in found


def test_an_absent_block_is_a_dash() -> None:
    """C and D of a block that does not exist are shown as -."""
    found = report(
        "tableau: {c: [[1/2], [0, 1]], A: [[null, [[1/2, 0]]], [[[0], [1]], ~]], b: [[1], [1/2, 1/2]]}"
    )
    assert re.search(r"^  C\(eta\) +-  1$", found, re.MULTILINE)


def test_inconsistent_blocks_are_named() -> None:
    """A block whose rows do not sum to the nodes is named, in the paper's terms."""
    assert "no: A{1,1}𝟙 differs from c" in report("tableau: {c: [[1/3]], A: [[[[1/2]]]], b: [[1]]}")


def test_claims_are_listed_with_their_place() -> None:
    """A claim that holds and one that fails are told apart by words, the failing one with its
    place.
    """
    found = report("methods: [{family: gauss, stages: 2}]\nexpect: {order: 4, symplectic: false}\n")
    assert re.search(r"claim holds +order: 4", found)
    assert re.search(
        r"CLAIM FAILS +symplectic: expected false, found true +\(m\.gark\.yaml:2:32\)", found
    )


def test_the_summary_counts_files_and_claims() -> None:
    """Several files get a line each and a summary."""
    good, bad = (
        "methods: [{family: gauss, stages: 2}]\nexpect: {order: 4}",
        tableau("0") + "\nexpect: {order: 2}",
    )
    assert "2 files, 1 claim: all hold" in render([outcome(good), outcome(tableau("0"))], Paint())
    found = render([outcome(good), outcome(bad)], Paint())
    assert "2 files, 2 claims: 1 file failed" in found
    assert found.startswith("ok   m.gark.yaml: order 4")
    assert "\nFAIL m.gark.yaml: order 1" in found


@pytest.mark.parametrize("verbosity", [-1, 0, 1])
def test_colour_adds_nothing_but_colour(verbosity: int) -> None:
    """Without paint there is no escape code; with paint the words are the same."""
    outcomes = [
        outcome("methods: [{family: gauss, stages: 2}]\nexpect: {order: 5}"),
        outcome(tableau("0")),
    ]
    plain, painted = (render(outcomes, Paint(color), verbosity) for color in (False, True))
    assert "\x1b" not in plain
    assert "\x1b[" in painted
    assert ESCAPE.sub("", painted) == plain


def test_paint_off_is_the_text_itself() -> None:
    """Every style leaves the text alone when colour is off, and marks it when colour is on."""
    for style in ("good", "bad", "strong", "faint", "note"):
        assert Paint()(style, "text") == "text"
        assert ESCAPE.sub("", Paint(True)(style, "text")) == "text" != Paint(True)(style, "text")
    assert Paint(True)("good", "") == ""


def test_columns_line_up() -> None:
    """Cells of a column are equally wide; a shorter block beside a longer one is filled with
    nothing.
    """
    assert aligned([["1/2", "-1"], ["0", "1/36"]], right=False) == ["1/2  -1", "0    1/36"]
    assert aligned([]) == []
    assert beside(["a", "bcd"], ["x"]) == ["a     x", "bcd"]


def test_long_requirements_are_shortened() -> None:
    """Where the value is shown in decimals, a required value of many digits is too."""
    found = report("methods: [{family: gauss, stages: 24}]")
    assert re.search(
        r"about [0-9.]+e-63 instead of about [0-9.]+e-63, off by -?[0-9.]+e-[0-9]+\n", found
    )


def test_hints_and_constants_of_one_colour() -> None:
    """One failing condition is one condition; the trees of one colour show none and no coupling."""
    text = "methods: [{A: [[0, 0], [1/3, 0]], b: [0, 1]}]\nexpect: {order: 2}\n"
    method = loads(text)
    analysis = analyse(method.tableau)
    lines = blame_lines(find_blame(method.tableau, 2, 2), method.tableau, Paint())
    assert lines[0] == "  hint: the one condition of order 2 fails"
    assert any(line.endswith("A{1,1}, row 2, entry 1, = 1/2 instead of 1/3") for line in lines)
    found = Outcome("m", "m", analysis=analysis, constants=error_constants(method.tableau, 2))
    shown = render([found], Paint())
    assert "largest 0.166667 at [[]]\n" in shown
    assert "coupling" not in shown


def test_long_hints_fit_a_screen(tmp_path: Path) -> None:
    """Sentences and lists of blocks go on in the next line, further in."""
    method = """
methods: [{family: gauss, stages: 2}, {family: lobatto-iiia, stages: 4}]
transfer: collocation
expect: {pair-order: 4}
"""
    path = tmp_path / "pair.gark.yaml"
    path.write_text(method, encoding="utf-8")
    text = render([check_file(str(path))], Paint())
    _, hint = text.split("  hint: ")
    lines = f"  hint: {hint}".rstrip().splitlines()
    assert max(map(len, lines)) <= 80
    assert lines[1] == "          conditions"
    assert " ".join(hint.split()).endswith("A{V2,V2}, A{V2,F2}")


def test_long_places_have_a_line_of_their_own() -> None:
    """Where the file is long the name of the method and the place of a failed claim go on in the
    next line, and what was found fits 80 columns.
    """
    text = "name: {}\nmethods: [{{family: gauss, stages: 2}}]\nexpect: {{symplectic: false}}\n"
    folder = "a-folder-with-a-long-name/long/"
    long = outcome(text.format("Gauss with two stages, copied by hand"), f"{folder}m.gark.yaml")
    found = render([long], Paint()).splitlines()
    assert found[:2] == [f"{folder}m.gark.yaml:", "  Gauss with two stages, copied by hand"]
    claim = found.index("  CLAIM FAILS      symplectic: expected false, found true")
    assert found[claim + 1] == " " * 19 + f"({folder}m.gark.yaml:3:22)"
    assert max(map(len, found)) <= 80
    short = outcome(text.format("Gauss"))
    assert render([short], Paint()).splitlines()[0] == "m.gark.yaml: Gauss"


DECIMALS = """\
A:
  - [0, 0, 0, 0]
  - [0.33333333333333333, 0, 0, 0]
  - [-0.33333333338333333, 1, 0, 0]
  - [1, -1, 1, 0]
b: [0.125, 0.375, 0.375, 0.125]
tolerance: 1e-12
expect: {order: 4}
"""


def test_long_decimals_fit_a_screen(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Entries are shown with the digits that a file would have, and no line is wider than 80
    columns, of a misprint and of a tolerance that is too tight.
    """
    monkeypatch.chdir(tmp_path)
    tight = DECIMALS.replace("33333338333333", "33333333333333")
    tight = tight.replace("1e-12", "1e-19")
    for text, shown in (
        (DECIMALS, "instead of -0.33333333338333333\n"),
        (tight, "the tolerance is too tight;\n"),
    ):
        Path("m.gark.yaml").write_text(text, encoding="utf-8")
        found = render([check_file("m.gark.yaml")], Paint())
        assert shown in found
        assert max(map(len, found.splitlines())) <= 80


def test_hints_fit_80_columns() -> None:
    """The line that a rounded method lacks is shown on a line of its own, and none is too long."""
    text = """
A: [[0.25, -0.0386751345948], [0.5386751345948, 0.25]]
b: [0.5, 0.5]
expect: {order: 4}
"""
    lines = report(text).splitlines()
    place = lines.index("        the coefficients look rounded;")
    assert "with the line  tolerance: 1e-13  the order is 4" in lines[place + 1]
    assert max(map(len, lines)) <= 80
