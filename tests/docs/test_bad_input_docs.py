"""docs/bad-input.md has every code of an error and of a finding.

What each invalid example is met with is recorded beside it, in ``tests/examples/invalid``.
"""

from __future__ import annotations

import os
import re
from pathlib import Path

from garkcli.glossary.faults import by_code, findings_of
from tests.docs.tables import codes_page, findings_table

PAGE = Path(__file__).resolve().parents[2] / "docs" / "bad-input.md"
MARK = "<!-- codes -->\n\n"
FINDINGS = """
## Findings of gark check

Every format has them: the codes are the rules of SARIF and GitHub, and `findings` of JSON.

{}
## Findings of gark audit

[The page about audits](audit.md#what-is-found) has them; `gark explain CODE` says what to do.
"""


def test_the_page_has_the_codes_of_the_program() -> None:
    """Its tables are made of the glossary; GARK_UPDATE_SNAPSHOTS writes them."""
    head, mark, found = PAGE.read_text(encoding="utf-8").partition(MARK)
    assert mark
    wanted = codes_page() + FINDINGS.format(findings_table("check"))
    if os.environ.get("GARK_UPDATE_SNAPSHOTS"):
        PAGE.write_text(head + mark + wanted, encoding="utf-8")
        return
    assert found == wanted


def test_every_code_is_there_once() -> None:
    """Nothing in a text breaks the tables; findings have a cure beside."""
    codes, findings, _ = PAGE.read_text(encoding="utf-8").partition(MARK)[2].split("## Findings")
    assert re.findall(r"`([\w-]+)`", codes) == list(by_code())
    rows = re.findall(r"^\|`.*$", findings, re.MULTILINE)
    cells = [row.replace("\\|", "").split("|")[1:-1] for row in rows]
    assert [row[0].strip("`") for row in cells] == list(findings_of("check"))
    assert all(len(row) == 3 and all(row) for row in cells)
