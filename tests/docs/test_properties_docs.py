"""docs/properties.md is made from the definitions that ``gark explain`` shows."""

from __future__ import annotations

import os
from pathlib import Path

from tests.docs.tables import claims_tables

PAGE = Path(__file__).resolve().parents[2] / "docs" / "properties.md"
MARK = "<!-- definitions -->\n\n"


def test_the_page_has_the_definitions() -> None:
    """Every claim has its row, with the words of the registry."""
    head, mark, found = PAGE.read_text(encoding="utf-8").partition(MARK)
    assert mark
    wanted = claims_tables()
    if os.environ.get("GARK_UPDATE_SNAPSHOTS"):
        PAGE.write_text(head + mark + wanted, encoding="utf-8")
        return
    assert found == wanted
