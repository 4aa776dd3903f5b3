"""The tables of keys are what the program says of them, and no finding is without an entry."""

from __future__ import annotations

import os

import pytest

from garkcli.bridges.audit import CODES
from garkcli.check.findings import KINDS
from garkcli.glossary.faults import findings_of
from garkcli.glossary.key import KINDS as FILES
from garkcli.report.reference import fields_table, keys_table
from tests.cli.harness import ROOT

BEGIN, END = "<!-- keys -->\n", "<!-- end of keys -->"
FIELDS = "<!-- fields -->\n"
UPDATE = "GARK_UPDATE_SNAPSHOTS"


@pytest.mark.parametrize("kind", FILES)
def test_the_keys_of_a_page_are_those_of_the_program(kind: str) -> None:
    """The page about a kind of files has each key with its meaning, default and example."""
    _, page = FILES[kind]
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


def test_the_list_of_fields_is_that_of_the_program() -> None:
    """docs/json-fields.md has every field of every report with what it holds."""
    path = ROOT / "docs" / "json-fields.md"
    head, begin, _ = path.read_text(encoding="utf-8").partition(FIELDS)
    assert begin
    wanted = f"{head}{FIELDS}\n{fields_table()}"
    if os.environ.get(UPDATE):
        path.write_text(wanted, encoding="utf-8")
    assert path.read_text(encoding="utf-8") == wanted
    for row in fields_table().splitlines():
        assert row.replace("\\|", "").count("|") == 4, row


def test_every_row_of_keys_has_three_cells() -> None:
    """No sign in a text or an example breaks the tables."""
    for kind in FILES:
        for row in keys_table(kind).splitlines():
            assert row.replace("\\|", "").count("|") == 4, row


def test_every_finding_has_an_entry() -> None:
    """The codes that are explained are those of the commands."""
    assert list(findings_of("check")) == list(KINDS)
    assert list(findings_of("audit")) == list(CODES)
    page = (ROOT / "docs" / "audit.md").read_text(encoding="utf-8")
    _, _, table = page.partition("## What is found")
    for code in CODES:
        assert f"`{code}`" in table
    for command in ("check", "audit"):
        for found in findings_of(command).values():
            assert found.text.endswith(".")
            assert found.cure.endswith(".")
