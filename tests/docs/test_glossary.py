"""docs/glossary.md is made from the terms, and every line of a report has one."""

from __future__ import annotations

import os
import re
from collections.abc import Iterator
from importlib import import_module
from pathlib import Path

import pytest

from garkcli.check.meanings import explain, known_words
from garkcli.errors import UsageProblem
from garkcli.glossary.faults import findings_of
from garkcli.glossary.labels import label_of
from garkcli.glossary.term import TOPICS, Term, by_word, plain, terms_of
from garkcli.report.schemas import REPORTS as SCHEMAS
from garkcli.tell.facts import (
    Labels,
    Level,
    ManyParts,
    OnePart,
    Plot,
    Row,
    Section,
    Stream,
    TextPicture,
)
from garkcli.tell.kinds import COUNT
from garkcli.tell.parts import part
from garkcli.tell.report import Report
from tests.cli.harness import gark
from tests.docs.tables import terms_tables
from tests.whole import in_whole

ROOT = Path(__file__).resolve().parents[2]
PAGE = ROOT / "docs" / "glossary.md"
MARK = "<!-- terms -->\n\n"
TERMS = [term for topic in TOPICS for term in terms_of(topic)]
COLLOCATION = "methods/collocation.gark.yaml"
VERLET = "methods/stoermer-verlet.gark.yaml"
ARS = "methods/ark-ars222.gark.yaml"
REPORTS = [
    ("check", COLLOCATION, "--error-constants"),
    ("check", ARS, "--properties"),
    ("stability", COLLOCATION),
    ("stability", ARS),
    ("stability", VERLET),
    ("modified", COLLOCATION),
    ("energy", VERLET, "--t-end", "20"),
]
LABEL = re.compile(r"^ {2,6}([A-Za-zΑ-ω][^ ]*(?: [^ ]+){0,4}?),?  +\S")
FORMULA = re.compile(r".*[|{}=/].*|[A-Z]|sqrt.*|(H )?h\^\d+")
"""What stands before two blanks and is no label: formulas, and letters for methods."""


def is_head(line: str) -> bool:
    """Whether a list of methods begins."""
    return line.startswith("  name ") and ("order" in line or line.endswith("  notes"))


def labels(text: str) -> Iterator[str]:
    """What stands before two blanks at the beginning of lines, but for names of methods."""
    is_list = False
    for line in text.splitlines():
        is_list = line.startswith("  ") and (is_list or is_head(line))
        found = LABEL.match(line)
        if found and (not is_list or is_head(line)):
            yield found[1].rstrip(",:")


def test_the_page_is_made_from_the_terms() -> None:
    """docs/glossary.md has every term with its other names; gark explain tells more of each."""
    page = PAGE.read_text(encoding="utf-8")
    head, mark, found = page.partition(MARK)
    assert mark
    if os.environ.get("GARK_UPDATE_SNAPSHOTS"):
        PAGE.write_text(head + mark + terms_tables(), encoding="utf-8")
        return
    assert found == terms_tables()


@pytest.mark.parametrize("term", TERMS, ids=lambda x: x.name)
def test_a_term_is_whole(term: Term) -> None:
    """A sentence, a source, and words near it that exist."""
    assert term.text.endswith(".")
    assert term.source
    for name in term.see:
        assert by_word()[name].name == name, name
    for label in term.labels:
        assert any(x.kind == "term" for x in explain(label)), label


def test_no_two_terms_have_one_name() -> None:
    """Each name and label leads to one term."""
    words = [x for term in TERMS for x in (term.name, *term.labels)]
    assert len(words) == len(set(words))
    assert explain("b")[0].name == "weight"
    assert explain("B")[0].name == "B(r)"
    several = {plain(x) for x in words if len(x) > 1}
    assert len(several) == sum(len(x) > 1 for x in words)


def recorded() -> Iterator[tuple[str, str]]:
    """Every report that is recorded: in the pages, and for the tests of the command line."""
    fence = re.compile(r"^```console\n(.*?)^```", re.MULTILINE | re.DOTALL)
    for path in (ROOT / "README.md", *sorted((ROOT / "docs").rglob("*.md"))):
        for block in fence.findall(path.read_text(encoding="utf-8")):
            yield path.name, block
    for path in sorted((ROOT / "tests/cli/snapshots").glob("*.txt")):
        if not path.name.startswith("help"):
            yield path.name, path.read_text(encoding="utf-8")


def unexplained(text: str) -> list[str]:
    """The labels of a report that nobody can ask for."""
    named = [x for x in labels(text) if not FORMULA.fullmatch(x)]
    return [label for label in named if not known(label)]


def known(word: str) -> bool:
    """Whether a word has a meaning."""
    try:
        return bool(explain(word))
    except UsageProblem:
        return False


def test_every_line_that_is_recorded_is_explained() -> None:
    """What a line of a report is called is a word of gark explain, in every report that the pages
    show, which are of all commands, and that are recorded.
    """
    texts = list(recorded())
    assert len(texts) > 100
    wrong = {(name, label) for name, text in texts for label in unexplained(text)}
    assert wrong == set()
    count = sum(len(set(labels(text))) for _, text in texts)
    assert count > 200


@pytest.mark.parametrize("arguments", REPORTS, ids=" ".join)
def test_every_line_of_a_report_is_explained(arguments: tuple[str, ...]) -> None:
    """So is every line of reports that say much."""
    shown = gark(*arguments).out
    assert len(list(labels(shown))) >= 3
    assert unexplained(shown) == []


def row_labels(section: Section) -> Iterator[str]:
    """What people read in front of the rows of a report and of its parts, and above columns."""
    for row in section.rows:
        is_seen = callable(row.level) or row.level < Level.DATA or row.key in section.columns
        shown = row.kind.shown
        if not is_seen:
            continue
        if not isinstance(shown, (Labels, TextPicture, Plot)):
            yield label_of(row.key) if row.label is None else row.label
        if isinstance(shown, (OnePart, ManyParts, Stream)):
            yield from row_labels(shown.section)


def declared_forms() -> Iterator[Section]:
    """The sections of every report that is declared."""
    for place in SCHEMAS.values():
        module, name = place.split(":")
        report = getattr(import_module(module), name)
        if isinstance(report, Report):
            yield from report.forms()


def test_every_label_of_the_renderers_is_explained() -> None:
    """The label of each row of a declared report that people see is a word of gark explain, and so
    are labels that are written out where other reports are made, whether or not a recorded report
    has them.
    """
    found = {label for form in declared_forms() for label in row_labels(form)}
    assert {"order", "A-stable", "2-norm", "R(z1, z2, …)", "claims", "dense output"} <= found
    written = re.compile(r'^\s+\(\s*"([a-z][^"{}]*)",\s+[a-z]', re.MULTILINE)
    for path in sorted((ROOT / "garkcli/report").glob("*_text.py")):
        found |= {*written.findall(path.read_text(encoding="utf-8"))}
    assert {x for x in found if x and not known(x.partition(": ")[0])} == set()


def test_a_row_that_nobody_explains_is_found() -> None:
    """A new row with a label that is no word fails, in a part too; one for programs alone does not."""
    inner = Section(Row("wibble", COUNT, len), Row("wobble", COUNT, len, Level.DATA))
    whole = Section(Row("order", COUNT, len), Row("all", part(inner), lambda x: x))
    assert [x for x in row_labels(whole) if not known(x)] == ["wibble"]


def test_a_label_that_nobody_explains_is_found() -> None:
    """A line with a new label fails; those of the reports do not."""
    assert unexplained("  wibble    3\n  order     4\n") == ["wibble"]
    assert unexplained("      fails at order 5: [[]]    ●\n") == []


@in_whole
def test_every_word_has_a_meaning() -> None:
    """Keys, claims, families, rules, schemes and findings are known words, each with a text."""
    words = known_words()
    some = {"transfer", "a-stable", "gauss", "collocation", "yoshida-6"}
    assert {*some, *findings_of("check")} <= {*words}
    for word in words:
        assert all(meaning.text.strip() for meaning in explain(word)), word


def test_words_are_told() -> None:
    """One word in several senses; an unknown one has a neighbour."""
    run = gark("explain", "stage", "order")
    assert run.code == 0
    assert "stage order: term" in run.out
    assert "stage-order: claim under expect" in run.out
    assert max(map(len, run.out.splitlines())) <= 80
    run = gark("explain", "densty")
    assert (run.code, "did you mean 'density'" in run.err) == (2, True)
    assert "elementary weight" in gark("explain").out


@pytest.mark.parametrize(
    ("word", "names"),
    [
        ("ξ", ["bound"]),
        ("even condition", ["even condition"]),
        ("within t", ["tolerance"]),
        ("[]", ["tree"]),
        ("B(2)", ["B(r)"]),
        ("C(1)", ["C(η)"]),
        ("D(0)", ["D(ζ)"]),
        ("A-stability", ["A-stable"]),
        ("L-stability", ["L-stable"]),
        ("γ", ["gamma", "density"]),
    ],
)
def test_words_as_reports_and_books_have_them(word: str, names: list[str]) -> None:
    """With a number, an ending or a letter for the word itself; γ has two usual meanings."""
    assert [x.name for x in explain(word)][: len(names)] == names


def test_keys_name_the_page_of_their_key() -> None:
    """What is under design has the page of design, not that of all method files."""
    for word, page in (("design.stage-order", "design"), ("compose.steps", "method-file")):
        (meaning,) = explain(word)
        assert meaning.source == f"docs/{page}.md"
