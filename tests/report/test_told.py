"""Reports that are told from declared rows: short, whole, and the same in every format."""

from __future__ import annotations

import json
import re
import unicodedata
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from types import SimpleNamespace
from typing import Any
from xml.etree import ElementTree as ET

import pytest
from jsonschema import Draft7Validator

from garkcli.check.check_file import check_file
from garkcli.check.outcome import Outcome
from garkcli.frozen import replace
from garkcli.glossary.labels import label_of
from garkcli.page.look import Look
from garkcli.report.check_text import render
from garkcli.report.checked import REPORT
from garkcli.tell.dialect import Plain
from garkcli.tell.facts import Row, Section, maybe, optional, via
from garkcli.tell.kinds import COUNT, EXPRESSION, INDEX, TEXT
from garkcli.tell.parts import part, rows_of, table
from garkcli.tell.report import Report
from tests.cli.harness import ROOT, gark
from tests.whole import in_whole

DATA = ROOT / "garkcli" / "catalogue" / "data"
NAMES = {x.name.removesuffix(".gark.yaml"): x for x in sorted(DATA.rglob("*.gark.yaml"))}
ROUNDED = "tests/examples/valid/rounded.gark.yaml"
VALID = ROOT / "tests" / "examples" / "valid"
SAMPLES = [
    *(NAMES[x] for x in ("rk4", "gauss-3", "tr-bdf2", "ralston-3", "kvaerno-5")),
    *(ROOT / "methods" / f"{x}.gark.yaml" for x in ("collocation", "ark-ars222", "rectangular")),
    *(VALID / f"{x}.gark.yaml" for x in ("rounded", "embedded-and-dense")),
]


@cache
def checked(path: Path) -> Outcome:
    """What is found of a file."""
    return replace(check_file(str(path)), file="m")


def everything(outcome: Outcome) -> list[tuple[int, str, str]]:
    """The rows of the report with details: margin, label and text, whole."""
    wide = render([outcome], Look(), verbosity=1, width=10_000)
    rows = (re.match(r"( +)(\S.*?)(?:  +(\S.*))?$", line) for line in wide.splitlines())
    return [(len(x[1]), x[2], x[3] or "") for x in rows if x]


def test_the_answer_is_first() -> None:
    """A check of the classical method: at most 12 lines, and the first one says its order, that it
    is proved, and the tree at which it ends.
    """
    lines = gark("check", "rk4").out.splitlines()
    assert len(lines) <= 12
    assert lines[0] == "rk4: order 4, proved; order 5 fails at [[[[[]]]]] by -1/120"
    assert gark("check", "rk4", "-v").out.splitlines()[0] == lines[0]


@pytest.mark.parametrize("path", SAMPLES, ids=lambda x: x.name.partition(".")[0])
def test_details_hold_every_number_of_the_json_report(path: Path) -> None:
    """Orders, B, C, D, the bound and the properties: each is in the row of its label, as JSON has
    it.
    """
    outcome = checked(path)
    data = REPORT.data(outcome)
    rows = everything(outcome)
    said: dict[tuple[int, str], str] = {(margin, label): text for margin, label, text in rows}
    answer = render([outcome], Look(), verbosity=1, width=10_000).partition("\n")[0]
    assert answer.startswith(f"m: order {data['order']}")
    for key in ("conjugate_order", "pair_order", "nonautonomous_order", "embedded_order"):
        if data[key] is not None:
            assert re.match(rf"{data[key]}\b", said[2, label_of(key)]), key
    simple = data["simplifying"]
    within = "" if data["tolerance"] is None else f" within {data['tolerance']}"
    for letter in "BCD":
        shown = said[4, label_of(letter)].replace("≥", "")
        assert shown.endswith(within)
        shown = shown.removesuffix(within)
        table = [simple[letter]] if letter == "B" else simple[letter]
        cells = [["-" if x is None else str(x) for x in row] for row in table]
        assert [row.split() for row in shown.split(" / ")] == cells
    assert said[4, "bound"].startswith(f"{simple['bound']}{within}: ")
    for key, value in data["properties"].items():
        text = said.get((4, label_of(key)))
        if key == "symplectic":
            assert said[2, "symplectic"].startswith("yes" if value else "no")
        elif isinstance(value, bool) and not key.endswith("is_lower_bound"):
            assert text is not None, key
            assert text.startswith("yes" if value else "no"), key
        elif isinstance(value, int) and key != "stage_order_is_lower_bound":
            assert text is not None, key
            known = within if "stage_order" in key else ""
            assert text.removeprefix("at least ") == f"{value}{known}"
        elif isinstance(value, str):
            assert text == (f"{value}{within}" if key == "gamma" else value), key
    parts = data["properties"]["by_colour"]
    if len(parts) > 1:
        told = [text for margin, label, text in rows if (margin, label) == (6, "stage order")]
        assert told == [str(x["stage_order"]) for x in parts]


@in_whole
@pytest.mark.parametrize(("format", "between"), [("markdown", "|"), ("latex", "&")])
def test_a_rounded_order_in_a_table_is_one_within_its_tolerance(format: str, between: str) -> None:
    """Each order of rounded coefficients has the tolerance beside it, also in the report of one
    file; those of an exact method have none.
    """
    lines = gark("check", ROUNDED, "rk4", "--format", format).out.splitlines()
    head, rounded, exact = (
        [x.strip() for x in line.strip("| \\").split(between)]
        for line in lines
        if between in line and "---" not in line
    )
    for key in ("order", "conjugate order", "symplectic pair"):
        at = head.index(key)
        assert (rounded[at], exact[at]) == ("4 within 1e-14", "4")
    answer, *_ = gark("check", ROUNDED, "--format", format).out.splitlines()
    assert re.search(r": order 4 within 1e-14[;,] .*order 5 fails at ", answer)
    assert "proved" not in answer


@in_whole
def test_a_rounded_order_in_a_line_is_one_within_its_tolerance() -> None:
    """The same where each of several files has a line, and where one has a report."""
    rounded, exact, *_ = gark("check", ROUNDED, "rk4").out.splitlines()
    orders = "order 4 within 1e-14, symplectic pair 4 within 1e-14"
    assert rounded == f"ok   {ROUNDED}: {orders}  (7 claims)"
    assert exact == "ok   rk4: order 4  (2 claims)"
    answer = gark("check", ROUNDED).out
    assert answer.startswith(f"{ROUNDED}: order 4 within 1e-14; order 5 fails at\n")
    assert "proved" not in answer


def test_a_rounded_stability_function_says_what_it_is_of() -> None:
    """LaTeX has R(z) and R(∞) of the digits as printed, and says so beside them."""
    text = gark("stability", ROUNDED, "--format", "latex").out
    rows = [line for line in text.splitlines() if line.startswith(("R(z) ", r"R($\infty$) "))]
    assert len(rows) == 2
    assert all("of the digits as printed, not of all methods" in line for line in rows)
    exact = gark("stability", "gauss-2", "--format", "latex").out
    assert "R(z) & " in exact
    assert "as printed" not in exact


def latex_faults(text: str) -> Iterator[str]:
    """What keeps LaTeX from setting a fragment, or lets it show another sign; comments do not."""
    bare = re.sub(r"(?m)^%.*$|\\[\\{}$%&#_]", "", text)
    has_table = re.search(r"lll|raggedright", text) is not None
    depth = 0
    for line in bare.splitlines():
        if line.count("$") % 2:
            yield f"dollars: {line}"
        for sign in re.sub(r"[^{}]", "", line):
            depth += 1 if sign == "{" else -1
            if depth < 0:
                yield f"braces: {line}"
        if depth:
            yield f"braces: {line}"
        words = re.sub(r"\$[^$]*\$", "", line)
        if re.search(r"[#%^_~]", words) or (words.count("&") > 1 and not has_table):
            yield f"signs: {line}"
    for sign in {x for x in text if ord(x) > 127}:
        if not unicodedata.name(sign).startswith("LATIN SMALL"):
            yield f"letters: {sign}"


def test_what_keeps_latex_from_setting_is_found() -> None:
    """The faults that the next test looks for."""
    assert not list(latex_faults(r"a\_b & $x_1^{2}$ \\"))
    for text in ("{", "}{", "$x", "a_b", "50%", "x^2", "a & b & c", "𝟙", "$Â$"):
        assert list(latex_faults(text)), text


@dataclass(frozen=True)
class Wobble:
    """A result for which nobody has written an output."""

    wibbles: int
    inner: tuple[int, str]


INNER = Section(Row("count", COUNT, lambda x: x[0]), Row("which", TEXT, lambda x: x[1]))


def test_a_row_is_in_every_format() -> None:
    """A row that is added to a section, and one of a part of it, are in the text with details, in
    JSON and its schema, in Markdown, LaTeX and HTML, and nothing else has to be written.
    """
    whole = Wobble(17, (23, "a_b <c>"))

    def report(*rows: Row) -> Report[Wobble]:
        section = Section(Row("answer", COUNT, lambda _: 42), *rows)
        return Report("gark/wobble/1", "wobbles", lambda: [section], lambda _: section, key="")

    without = report()
    rows = (
        Row("wibbles", COUNT, lambda x: x.wibbles),
        Row("inner_part", part(INNER), lambda x: x.inner),
    )
    added = report(*rows)
    assert "wibbles" not in str(without.schema)
    found: dict[str, Any] = json.loads(added.json([whole]))
    assert found["wibbles"] == 17
    assert found["inner_part"] == {"count": 23, "which": "a_b <c>"}
    assert not list(Draft7Validator(added.schema).iter_errors(found))
    assert list(Draft7Validator(without.schema).iter_errors(found))
    for format, wanted in (("text", "a_b <c>"), ("markdown", r"a\_b &lt;c>"), ("latex", r"a\_b")):
        told = added.render([whole], format, verbosity=1)
        assert "17" not in without.render([whole], format, verbosity=1)
        for text in ("wibbles", "17", "inner part", "23", wanted):
            assert text in told, (format, text)
    html = added.html(whole)
    cells = ["".join(cell.itertext()) for cell in ET.fromstring(html).iter("td")]
    assert "17" in cells
    assert any("23" in cell and "a_b <c>" in cell for cell in cells)
    assert "17" not in without.html(whole)


def test_a_table_shows_its_first_rows() -> None:
    """A list as a table: so many rows usually, all with details and in JSON; every format says how
    many are left out, and a column that nothing fills is left out.
    """
    flat = Section(
        Row("which", TEXT, lambda x: f"w{x}", label=""),
        Row("count", COUNT, lambda x: x),
        maybe("void", COUNT, lambda _: None),
        Row("squares", rows_of(lambda x, _: [("square", str(x * x))]), lambda x: x * 7),
    )
    whole = Section(
        Row("answer", COUNT, lambda _: 42), Row("list", table(flat, 2), lambda x: range(x))
    )
    report: Report[int] = Report.only("gark/list/1", "lists", whole)
    usual, all_of_it = report.render([5]), report.render([5], verbosity=1)
    assert usual.splitlines()[-4:] == [
        "  list  count  square",
        "  w0        0       0",
        "  w1        1      49",
        "    … 3 more with -v",
    ]
    assert "w4" in all_of_it
    assert "more" not in all_of_it
    assert "… 3 more" in report.render([5], "markdown")
    assert "… 3 more</p>" in report.html(5)
    assert r"w4 & 4 & 784 \\" in report.render([5], "latex")
    assert len(report.data(5)["list"]) == 5
    assert "void" not in all_of_it


def test_a_wide_table_continues_below() -> None:
    """Columns that do not fit stand below, beside the first one again; words are folded."""
    d = Plain(width=40)
    lines = [*d.grid(["", *"abcdefgh"], [["row", *(x * 9 for x in "abcdefgh")]])]
    assert max(map(len, lines)) <= 40
    assert [line.split() for line in lines[:2]] == [
        ["a", "b", "c"],
        ["row", *("a" * 9, "b" * 9, "c" * 9)],
    ]
    assert sum(line.startswith("row") for line in lines) == 3
    folded = [*d.grid(["name", "what"], [["x", "words " * 12]])]
    assert len(folded) == 4
    assert max(map(len, folded)) <= 40


def test_an_expression_is_one_in_every_format() -> None:
    """A product has no stars that Markdown takes for emphasis, and is a formula in LaTeX and HTML;
    what is too large to be read is there as it stands.
    """
    section = Section(Row("objective", EXPRESSION, lambda x: x))
    report: Report[str] = Report("a", "b", lambda: [section], lambda _: section, key="")
    text = "2*c21*x^2 - sqrt(3)*y"
    assert text in report.render([text])
    assert r"2\*c21\*x^2 - sqrt(3)\*y" in report.render([text], "markdown")
    for format in ("latex", "html"):
        told = report.html(text) if format == "html" else report.render([text], format)
        assert r"2c_{21}x^{2}-\sqrt{3}y" in told
    long = " + ".join([text] * 1000)
    assert rf"\texttt{{{text.replace('^', chr(92) + 'textasciicircum{}')} + " in report.render(
        [long], "latex"
    )


@pytest.mark.parametrize("format", ["text", "markdown", "latex"])
def test_a_design_says_how_its_values_are_known(format: str, tmp_path: Path) -> None:
    """Whatever the format: the answer first; that a solution is proved; that an end is a root of a
    polynomial, and no decimal; what is not decided, and why.
    """

    def told(*options: str) -> str:
        text = gark("design", "sdirk.yaml", *options, "--format", format, cwd=tmp_path).out
        return " ".join(text.split())

    path = tmp_path / "sdirk.yaml"
    path.write_text("unknown: {stages: 2, shape: sdirk}\n", encoding="utf-8")
    answer = "sdirk.yaml: order 3 for 2 solutions; order 4 for no value"
    assert told().strip("*").removeprefix(r"\subsection*{").startswith(answer)
    assert told().count("order 3 of the method, proved") == 2
    least = gark("design", "sdirk.yaml", "--minimise", "error", "--format", format, cwd=tmp_path)
    assert "least error " in " ".join(least.out.split())
    assert format != "latex" or list(latex_faults(least.out)) == []
    stable = told("--set", "c2=1/2", "--order", "1", "--a-stable")
    assert "A-stable for exactly these" in stable
    path.write_text("unknown: {stages: 3, shape: full}\n", encoding="utf-8")
    is_open = told("--order", "6", "--seconds", "0.01")
    assert re.search(r"sdirk.yaml: .*order \d is not decided", is_open)
    # how far it comes in this time depends on the machine
    assert "not decided in the time of --seconds; " in is_open
    assert "fewer unknowns make it decidable" in is_open


@pytest.mark.parametrize("format", ["markdown", "latex"])
@pytest.mark.parametrize("problem", ["kepler", "generic"])
def test_a_convergence_test_says_in_every_format_what_its_problem_may_hide(
    problem: str, format: str
) -> None:
    """The visible order is one at least where the problem may hide trees, also beside others."""
    run = ("converge", "gauss-2", "--problem", problem, "--format", format)
    text = gark(*run).out
    seen = "at least 4" if problem == "kepler" else "4"
    assert f" observed, {seen} visible: they agree" in text
    several = gark(*run[:2], "rk4", *run[2:]).out
    assert ("at least 4" in several) == (problem == "kepler")
    if format == "latex":
        tables = [line for line in text.splitlines() if line.count("&") < 2]
        assert list(latex_faults("\n".join(tables))) == []


@pytest.mark.parametrize("format", ["text", "markdown", "latex"])
def test_a_certificate_says_what_proves_each_order(format: str) -> None:
    """How many trees prove an order, and that of the pair; these trees with -v. JSON is what it
    is without an option.
    """
    data = json.loads(gark("certificate", "rk4").out)
    counts = [
        sum(len(trees) for by_colour in part["spanning"] for trees in by_colour)
        for part in (data["method"], data["pair"])
    ]
    told = " ".join(gark("certificate", "rk4", "--format", format).out.split())
    for label, count in zip(("order 4", "symplectic pair [&|]? ?4"), counts, strict=True):
        assert re.search(f"{label}, proved by {count} trees; order 5 fails", told)
    whole = gark("certificate", "rk4", "-v", "--format", format).out
    tree = r"[[[\tau^{[1]}]^{[2]}]^{[1]}]^{[2]}" if format == "latex" else "[[[[]_1]_2]_1]_2"
    assert tree in whole.replace("\\_", "_")


@pytest.mark.parametrize("format", ["markdown", "latex", "csv"])
def test_long_runs_are_told_in_every_format(format: str) -> None:
    """The verdict of the energy with its reason, and orders that are no more than bounds."""
    run = gark("energy", "rk4", "--t-end", "100", "--format", format).out
    assert ("DRIFTS: det R(h)" in run) == (format != "csv")
    modified = gark(
        *(
            "energy",
            "methods/stoermer-verlet.gark.yaml",
            "--problem",
            "pendulum",
            "--modified",
            "3",
        ),
        *("--t-end", "1", "--format", format),
    ).out
    assert (": orders agree for H, to h" in modified) == (format != "csv")
    if format == "latex":
        texts = [line for text in (run, modified) for line in text.splitlines()]
        assert not list(latex_faults("\n".join(x for x in texts if x.count("&") < 2)))


def test_parts_of_a_list_are_told_up_to_a_number() -> None:
    """A list of parts with titles: so many usually, each under its title, all with details."""
    titled = Section(Row("count", COUNT, lambda x: x), title=lambda x, _: f"part {x}")
    whole = Section(Row("answer", COUNT, lambda _: 42), Row("list", table(titled, 2), range))
    report: Report[int] = Report.only("gark/list/1", "lists", whole)
    usual, all_of_it = report.render([5]), report.render([5], verbosity=1)
    assert usual.splitlines() == [
        "  answer  42", "  part 0", "    count  0", "  part 1", "    count  1", "  … 3 more with -v",
    ]  # fmt: skip
    assert "part 4" in all_of_it
    assert "more" not in all_of_it


@pytest.mark.parametrize("format", ["markdown", "latex"])
def test_a_modified_equation_says_in_every_format_how_its_orders_are_known(format: str) -> None:
    """The order that is one at least, and the one within a tolerance."""
    text = gark("modified", "methods/stoermer-verlet.gark.yaml", "-n", "4", "--format", format).out
    assert "at least 4" in text
    rounded = gark("modified", ROUNDED, "-n", "4", "--format", format).out
    assert "order at least 4 within 1e-14" in rounded
    assert "effective order at least 4 within 1e-14" in rounded


@pytest.mark.parametrize("format", ["text", "markdown", "latex"])
def test_orders_of_one_method_are_as_they_are_known(format: str) -> None:
    """``gark show`` of rounded coefficients and ``gark import`` of decimals say within which
    tolerance each order holds; of exact coefficients there is none.
    """
    shown = gark("show", ROUNDED, "--format", format).out
    assert "order 4 within 1e-14" in shown.splitlines()[0]
    told = shown.count("4 within 1e-14") + shown.count("order 4 within\n")
    assert told >= 3
    assert "within" not in gark("show", "rk4", "--format", format).out
    imported = gark("import", "tests/bridges/sources/ralston.tsv", "--format", format).out
    assert "2 within 1e-15" in imported


def test_a_list_begins_with_how_many_there_are() -> None:
    """In every format for people, with what its letters mean; with details these are words."""
    for format in ("text", "markdown", "latex"):
        lines = gark("list", "methods", "alexander", "--format", format).out.splitlines()
        assert "2 methods" in lines[0]
        assert any("alexander-3" in line for line in lines[1:])
    assert "A: A-stable" in gark("list", "methods", "alexander").out
    assert "A-stable, L-stable" in gark("list", "methods", "alexander", "-v").out


def test_conditions_in_markdown_have_the_rows_of_their_json() -> None:
    """Each condition in a line with its values; within which tolerance they hold is above."""
    run = ("conditions", "heun", "--order", "3")
    rows = json.loads(gark(*run, "--format", "json").out)["conditions"]
    text = gark(*run, "--format", "markdown").out
    assert text.endswith("\n\n4 conditions, 2 fail.\n\n")
    lines = [line for line in text.splitlines() if line.startswith("| ")]
    assert len(lines) == 1 + len(rows)
    for line, row in zip(lines[1:], rows, strict=True):
        cells = [x.strip() for x in line.strip("|").split("|")]
        assert cells[6:10] == [
            *(row[x] for x in ("value", "required", "residual")),
            "holds" if row["holds"] else "FAILS",
        ]
    failing = gark(*run, "--failing", "--format", "markdown").out
    assert failing.endswith("4 conditions, 2 fail.\n\n")
    assert failing.count("| FAILS |") == 2
    rounded = gark("conditions", ROUNDED, "--order", "3", "--format", "markdown").out
    assert "hold within 1e-14." in rounded


def test_conjugate_and_pair_of_a_family_of_one_colour_are_details(tmp_path: Path) -> None:
    """As of a single method: usually the order is all that is looked for."""
    file = tmp_path / "two.yaml"
    weights = "['1 - 1/(2*t)', '1/(2*t)']"
    file.write_text(f"parameters: {{t: free}}\nA: [[0, 0], [t, 0]]\nb: {weights}\n")
    assert "\n  symplectic pair  " not in gark("check", str(file)).out
    assert "\n  symplectic pair  " in gark("check", str(file), "-v").out
    two = tmp_path / "tau.yaml"
    two.write_text(
        "parameters: {tau: free}\n"
        "methods: [{family: gauss, stages: 2}, {family: lobatto-iiia, stages: 3}]\n"
        "transfer: {interpolation: tau, collocation: 1 - tau}\n"
    )
    assert "\n  symplectic pair  " in gark("check", str(two)).out


def test_rows_of_a_part_are_rows_of_its_owner() -> None:
    """Without a part they have no value. What may be missing says so in the schema."""
    whole = SimpleNamespace(count=1, part=SimpleNamespace(count=3), nothing=None)
    count: Row[Any] = Row("n", COUNT, lambda x: x.count)
    assert count.answer(whole).value == 1
    assert [row.answer(whole).value for row in via(lambda x: x.part, [count])] == [3]
    assert [row.answer(whole).value for row in via(lambda x: x.nothing, [count])] == [None]
    section: Section[Any] = Section(
        maybe("null", COUNT, lambda x: x.nothing),
        optional("left", COUNT, lambda x: x.nothing),
        [Row("count", COUNT, lambda x: x.count)],
    )
    assert section.data(whole, Plain()) == {"null": None, "count": 1}
    assert section.schema["required"] == ["null", "count"]
    Draft7Validator(section.schema).validate(section.data(whole, Plain()))


def test_what_counts_from_0_is_told_from_1() -> None:
    """People and programs get the number of a stage or colour from 1."""
    section: Section[tuple[int, int | None]] = Section(
        Row("entry", INDEX, lambda x: x[0]), maybe("row", INDEX, lambda x: x[1])
    )
    assert section.data((0, None), Plain()) == {"entry": 1, "row": None}
    assert INDEX(0).words(Plain()) == "1"


@in_whole
def test_entries_that_are_one_within_the_tolerance(tmp_path: Path) -> None:
    """γ of entries that are one within the tolerance is their mean; weights of a family are positive
    beside rounded ones.
    """
    file = tmp_path / "rounded.yaml"
    sdirk = "{A: [[0.2928932188134, 0], [0.7, 0.2928932188135]], b: [0.7, 0.3]}"
    file.write_text(f"methods: [{sdirk}, gauss-2]\ntransfer: interpolation\ntolerance: 1e-10\n")
    assert "SDIRK within 1e-10, γ = 0.29289321881345" in " ".join(
        gark("check", str(file)).out.split()
    )
    text = " ".join(gark("check", str(file), "-v").out.split())
    assert "γ 0.29289321881345" in text
    assert "positive weights yes" in text


def test_what_fails_in_a_check_is_named() -> None:
    """Trees with values have the order that ends there; an order that is none says so before why."""
    lines = gark("check", "sdirk-2", "-v").out.splitlines()
    instead = [x.strip() for x in lines if " instead of " in x]
    assert instead == [
        "order fails at [[[]]]: 0 instead of 1/6",
        "embedded order fails at [[]]: 1 instead of 1/2",
    ]
    text = " ".join(gark("check", "ars-343").out.split())
    assert "conjugate order none: colour 1: the symplectic conjugate divides by" in text
