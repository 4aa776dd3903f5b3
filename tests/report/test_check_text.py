"""The report for people: numbers of every kind, colour only where it is asked for."""

import re
from pathlib import Path

import pytest

from garkcli.check.analysis import analyse
from garkcli.check.check_file import check_file
from garkcli.check.claims import verify
from garkcli.check.findings import blame_text
from garkcli.check.outcome import Outcome
from garkcli.methodfile.load import loads
from garkcli.order.blame import MissedOrder, blame_of
from garkcli.order.constants import error_constants
from garkcli.page.lines import aligned
from garkcli.page.look import Look
from garkcli.report.check_text import render
from garkcli.tell.terminal import Coloured
from tests.cli.harness import gark
from tests.whole import in_whole

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
    return render([outcome(text)], Look())


def tableau(entry: str, weight: str = "1") -> str:
    """A method of one stage."""
    return f"tableau: {{A: [[[[{entry}]]]], b: [[{weight}]]}}"


def everything(text: str) -> str:
    """The same with every fact, each on lines of its own."""
    return render([outcome(text)], Look(), verbosity=1)


def words(text: str) -> str:
    """A text without its line ends and margins."""
    return " ".join(text.split())


@pytest.mark.parametrize(
    ("text", "value", "residual"),
    [
        (tableau("-1/2"), "-1/2 instead of 1/2", "-1"),
        (tableau("0"), "0 instead of 1/2", "-1/2"),
        (tableau("sqrt(2)/2"), "sqrt(2)/2 instead of 1/2", "-1/2 + sqrt(2)/2"),
        (tableau("1/2", "0"), "0 instead of 1", "-1"),
        (tableau("1/2", "-sqrt(3)"), "-sqrt(3) instead of 1", "-1 - sqrt(3)"),
        (tableau("1/2", "cbrt(2)"), "cbrt(2) instead of 1", "-1 + cbrt(2)"),
    ],
)
def test_a_residual_is_written_exactly(text: str, value: str, residual: str) -> None:
    """Negative, zero and irrational residuals end the first line as exact numbers; with details
    the value and what it should be are there too.
    """
    assert report(text).splitlines()[0].endswith(f"] by {residual}")
    assert re.search(
        rf"^  order fails at \[.*\]: {re.escape(value)}$", everything(text), re.MULTILINE
    )


def test_long_values_are_whole_and_fit_a_screen() -> None:
    """A number of thirty digits is shown whole, in lines of at most 80 columns."""
    entry = "123456789012345678901234567890/11"
    found = report(tableau(entry))
    assert "by 246913578024691357802469135769/22 SDIRK" in words(found)
    assert f"γ {entry}" in words(found)
    assert f"[[]]: {entry} instead of 1/2\n" in everything(tableau(entry))
    assert max(map(len, (found + everything(tableau(entry))).splitlines())) <= 80


def test_a_method_of_no_order_has_order_zero() -> None:
    """Weights that do not sum to 1 fail at order 1, at the single vertex."""
    found = report(tableau("1/2", "2"))
    assert found.startswith("m.gark.yaml: order 0, proved; order 1 fails at [] by 1\n")


def test_a_zero_weight_is_named() -> None:
    """Where there is no conjugate the report says so at once, and with details which weight is in
    the way; the order of the method is told all the same.
    """
    text = "methods: [{family: explicit-midpoint}]"
    found = report(text)
    assert found.startswith("m.gark.yaml: order 2, proved; ")
    assert "not symplectic; not all weights positive\n" in found
    for label in ("conjugate order", "symplectic pair"):
        reason = "none: the symplectic conjugate divides by the weights b, b_1 = 0"
        assert f" {label} {reason} " in words(everything(text))


def test_an_absent_block_is_a_dash() -> None:
    """C and D of a block that does not exist are shown as -."""
    found = everything(
        "tableau: {c: [[1/2], [0, 1]], A: [[null, [[1/2, 0]]], [[[0], [1]], ~]], b: [[1], [1/2, 1/2]]}"
    )
    assert re.search(r"^    C\(η\) +- 1 / 2 -$", found, re.MULTILINE)
    assert re.search(r"^    D\(ζ\) +- 2 / 1 -$", found, re.MULTILINE)


def test_inconsistent_blocks_are_named() -> None:
    """A block whose rows do not sum to the nodes is named: of one colour A, of several with its
    place.
    """
    found = report("tableau: {c: [[1/3]], A: [[[[1/2]]]], b: [[1]]}")
    assert "consistent            no: A𝟙 differs from c: row" in found
    both = (
        "tableau: {c: [[1/2], [1/3]], A: [[[[1/2]], [[1/2]]], [[[1/2]], [[1/3]]]], b: [[1], [1]]}"
    )
    assert "no: A{2,1}𝟙 differs from c" in words(report(both))


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
    assert "2 files, 1 claim: all hold" in render([outcome(good), outcome(tableau("0"))], Look())
    found = render([outcome(good), outcome(bad)], Look())
    assert "2 files, 2 claims: 1 file failed" in found
    assert found.startswith("ok   m.gark.yaml: order 4")
    assert "\nFAIL m.gark.yaml: order 1" in found


@pytest.mark.parametrize("verbosity", [-1, 0, 1])
def test_colour_adds_nothing_but_colour(verbosity: int) -> None:
    """Without colour there is no escape code; with it the words are the same."""
    outcomes = [
        outcome("methods: [{family: gauss, stages: 2}]\nexpect: {order: 5}"),
        outcome(tableau("0")),
    ]
    plain, painted = (render(outcomes, Look(color), verbosity) for color in (False, True))
    assert "\x1b" not in plain
    assert "\x1b[" in painted
    assert ESCAPE.sub("", painted) == plain


def test_colours_are_in_the_text_where_they_are_wanted() -> None:
    """Every style leaves the text alone without colour, and marks it with colour."""
    for name in ("good", "bad", "strong", "note"):
        assert getattr(Coloured(), name)("text") == "text"
        marked = getattr(Coloured(look=Look(True)), name)("text")
        assert ESCAPE.sub("", marked) == "text" != marked
    assert Coloured(look=Look(True)).good("") == ""


def test_columns_line_up() -> None:
    """Cells of a column are equally wide."""
    assert aligned([["1/2", "-1"], ["0", "1/36"]], right=False) == ["1/2  -1", "0    1/36"]
    assert aligned([]) == []


@in_whole
def test_long_requirements_are_shortened() -> None:
    """Where the value is shown in decimals, a required value of many digits is too; no line is
    wider than 80 columns but a tree that is.
    """
    text = "methods: [{family: gauss, stages: 20}]"
    assert re.search(r"by about -2\.1685790e-61\n", report(text))
    found = everything(text)
    assert re.search(r"\]: about [0-9.]+e-50 instead of about [0-9.]+e-50 ", words(found))
    assert all(len(line) <= 80 for line in found.splitlines() if "[" * 30 not in line)


ONE_ENTRY = "methods: [{A: [[0, 0], [1/3, 0]], b: [0, 1]}]\nexpect: {order: 2}\n"


def test_hints_and_constants_of_one_colour() -> None:
    """One failing condition is one condition, an entry has no block; the trees of one colour show
    no colours and no coupling.
    """
    method = loads(ONE_ENTRY)
    analysis = analyse(method.tableau)
    blame = blame_of(method.tableau, MissedOrder(2, 2))
    assert blame is not None
    hint = str(blame_text(blame, ["1"]))
    assert hint.startswith("the one condition of order 2 fails; ")
    assert "would hold with a[2,1] = 1/2 instead of 1/3, or a[2,2] = 1/6 instead of 0" in hint
    found = Outcome("m", "m", analysis=analysis, constants=error_constants(method.tableau, 2))
    shown = words(render([found], Look()))
    assert "of order 2: 2-norm 0.166667, largest 0.166667 at [[]], of 1 tree" in shown
    assert "coupling" not in shown


def test_hints_of_several_colours_name_blocks(tmp_path: Path) -> None:
    """Blocks have the names of the colours; sentences go on in the next line, below the first."""
    method = """
methods: [{family: gauss, stages: 2}, {family: lobatto-iiia, stages: 4}]
transfer: collocation
expect: {pair-order: 4}
"""
    path = tmp_path / "pair.gark.yaml"
    path.write_text(method, encoding="utf-8")
    for verbosity in (0, 1):
        text = render([check_file(str(path))], Look(), verbosity)
        _, _, hint = text.partition("  hint ")
        assert max(len(line) for line in text.splitlines() if str(path) not in line) <= 80
        assert "all of them coupling conditions; all of them involve A{V2,F1}" in words(hint)
    told, _, _ = words(hint).partition(" (failing-conditions) help ")
    assert told.endswith("A{V2,V2}, A{V2,F2}")


def test_long_places_fit_a_screen() -> None:
    """Where the folder is long the answer and the place of a failed claim go on in the next line,
    below what they belong to.
    """
    text = "methods: [{family: gauss, stages: 2}]\nexpect: {symplectic: false}\n"
    file = "a-folder-with-a-long-name/long/and-deeper/m.gark.yaml"
    found = render([outcome(text, file)], Look()).splitlines()
    assert max(map(len, found)) <= 80
    assert found[0].startswith(f"{file}: order 4")
    assert found[1].startswith("  ")
    (claim,) = [i for i, line in enumerate(found) if line.startswith("  CLAIM FAILS  symplectic: ")]
    assert found[claim + 1] == " " * 15 + f"({file}:2:22)"


def test_the_name_of_a_method_is_a_detail() -> None:
    """Usually the file says which method it is; with details its name is there too."""
    text = "name: Gauss, by hand\nmethods: [{family: gauss, stages: 2}]\n"
    assert "by hand" not in report(text)
    assert re.search(r"^  name +Gauss, by hand$", everything(text), re.MULTILINE)


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


@in_whole
def test_long_decimals_fit_a_screen(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Entries are shown with the digits that a file would have, of a misprint; a tolerance that is
    too tight is told with the line that would do, and so are coefficients that look rounded. No
    line is wider than 80 columns.
    """
    monkeypatch.chdir(tmp_path)
    tight = DECIMALS.replace("33333338333333", "33333333333333").replace("1e-12", "1e-19")
    gauss = "A: [[0.25, -0.0386751345948], [0.5386751345948, 0.25]]\nb: [0.5, 0.5]\n"
    for text, shown in (
        (DECIMALS, "a[3,1] = -0.33333333333333333 instead of -0.33333333338333333"),
        (
            tight,
            "the tolerance 1e-19 is too tight: the coefficients look rounded to 17 decimal places;"
            " with the line tolerance: 1e-17 order 4 holds",
        ),
        (
            f"{gauss}expect: {{order: 4}}",
            "rounded to 13 decimal places; with the line tolerance: 1e-13 order 4 holds",
        ),
    ):
        Path("m.gark.yaml").write_text(text, encoding="utf-8")
        found = render([check_file("m.gark.yaml")], Look())
        assert shown in words(found)
        assert max(map(len, found.splitlines())) <= 80


def test_norms_have_words_not_fields() -> None:
    """Labels are those of people: names of fields stay in JSON."""
    told = gark("check", "-v", "dopri5", "--error-constants").out
    for field in ("two norm", "inf norm", "worst value"):
        assert field not in told
    assert re.search(r"^ +2-norm +0\.0011", told, re.MULTILINE)


def test_one_condition_fails(tmp_path: Path) -> None:
    """In the singular; where a row stands for a tree of one colour too, that tree is named."""
    text = """
ark:
  A:
    - [[0, 0], [1/2, 0]]
    - [[0, 0], [0, 1/3]]
  b: [0, 1]
expect: {order: 2}
"""
    (tmp_path / "one.yaml").write_text(text, encoding="utf-8")
    told = " ".join(gark("check", "one.yaml", cwd=tmp_path).out.split())
    assert "1 of the 2 conditions of order 2 fails; it involves A{1,2}" in told
    assert "of them" not in told
    told = " ".join(gark("conditions", "one.yaml", "-n", "2", cwd=tmp_path).out.split())
    assert "(also of [[]_2]_2: diagonal condition)" in told
