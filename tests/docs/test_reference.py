"""The tables of keys are what the program says of them, and no finding is without an entry."""

from __future__ import annotations

import os
import re

import pytest

from garkcli.bridges.finding import CODES
from garkcli.check.meanings import explain
from garkcli.glossary.faults import findings_of
from garkcli.glossary.key import KINDS as FILES
from garkcli.glossary.key import keys_of
from tests.cli.harness import ROOT
from tests.docs.tables import IN_SECTIONS, OF_DESIGNS, fields_page, keys_table

BEGIN, END = "<!-- keys -->\n", "<!-- end of keys -->"
UPDATE = "GARK_UPDATE_SNAPSHOTS"


@pytest.mark.parametrize("kind", FILES)
def test_the_keys_of_a_page_are_those_of_the_program(kind: str) -> None:
    """The page about a kind of files has each key with its meaning and default."""
    page = FILES[kind].page
    path = ROOT / page
    text = path.read_text(encoding="utf-8")
    head, begin, rest = text.partition(BEGIN)
    found, end, tail = rest.partition(END)
    assert begin
    assert end
    wanted = f"\n{keys_table(kind)}\n"
    if os.environ.get(UPDATE):
        whole = head + begin + wanted + end + tail
        path.write_text(whole, encoding="utf-8")
        return
    assert found == wanted


def test_keys_without_a_row_are_in_their_sections() -> None:
    """The pages of method files and of designs name each key that the table leaves to them."""
    text, _, table = (ROOT / "docs" / "method-file.md").read_text(encoding="utf-8").partition(BEGIN)
    of_designs = (ROOT / "docs" / "design.md").read_text(encoding="utf-8")
    left_out = {x.path for x in keys_of("method").values() if f"`{x.path}`" not in table}
    assert {path.partition(".")[0] for path in left_out} == {*IN_SECTIONS, *OF_DESIGNS}
    for path in left_out:
        first, _, name = path.rpartition(".")
        page = of_designs if path.startswith(OF_DESIGNS) else text
        names = {name, name.removeprefix("embedded-")} if first == "design" else {name}
        assert any(re.search(rf"(?<![\w-]){x}(:|`|, |}})", page) for x in names), path


def test_every_field_is_defined() -> None:
    """A field has a row, or is a claim, a column or a key that gark explain knows."""
    reports, _, table = fields_page().partition("\n## Fields\n")
    rows = re.findall(r"^\|`([^`]+)`", table, re.MULTILINE)
    named = re.sub(r"^#.*|\bas [\w-]+|each \[.*?\)", "", reports, flags=re.MULTILINE)
    others = set(re.findall(r"[\w-]+", named)) - {*rows}
    assert len(rows) == len(set(rows)) > 80
    assert others
    assert all(explain(name) for name in others)
    assert all(row.replace("\\|", "").count("|") == 3 for row in table.splitlines() if row)


def test_every_row_of_keys_has_two_cells() -> None:
    """No sign in a text breaks the tables."""
    for kind in FILES:
        for row in keys_table(kind).splitlines():
            assert row.replace("\\|", "").count("|") == 3, row


def test_every_finding_has_an_entry() -> None:
    """The codes that are explained are those of the commands."""
    assert list(findings_of("audit")) == list(CODES)
    page = (ROOT / "docs" / "audit.md").read_text(encoding="utf-8")
    _, _, table = page.partition("## What is found")
    for code in CODES:
        assert f"`{code}`" in table
    for command in ("check", "audit"):
        for found in findings_of(command).values():
            assert found.text.endswith(".")
            assert found.cure.endswith(".")
