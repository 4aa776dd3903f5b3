"""docs/catalogue.md is made from the catalogue."""

from __future__ import annotations

import os
from pathlib import Path

from tests.docs.catalogue_page import FOLDERS, entries, tables

PAGE = Path(__file__).resolve().parents[2] / "docs" / "catalogue.md"
MARK = "<!-- tables -->\n\n"
METHODS = entries()


def test_the_page_is_made_from_the_files() -> None:
    """Its tables are those of the files and the index; GARK_UPDATE_SNAPSHOTS writes them."""
    page = PAGE.read_text(encoding="utf-8")
    head, mark, found = page.partition(MARK)
    assert mark
    made = tables(METHODS)
    if os.environ.get("GARK_UPDATE_SNAPSHOTS"):
        PAGE.write_text(head + mark + made, encoding="utf-8")
        return
    assert found == made


def test_every_method_is_on_the_page() -> None:
    """A row each: no folder is left out."""
    folders = {x["file"].partition("/")[0] for x in METHODS}
    assert folders <= set(FOLDERS)
    page = PAGE.read_text(encoding="utf-8")
    missing = [x["name"] for x in METHODS if f"|`{x['name']}`|" not in page]
    assert missing == []


def test_orders_of_the_page_are_what_people_know() -> None:
    """Rows that can be looked up in any textbook, against the index."""
    known = {x["name"]: (x["order"], x["embedded_order"]) for x in METHODS}
    assert known["dormand-prince-5"] == (5, "4")
    assert known["bogacki-shampine-3"] == (3, "2")
    assert known["gauss-3"] == (6, "")
    assert known["radau-iia-3"] == (5, "")
    assert known["dop853"] == (8, "3")
