"""docs/index.md: the pages of the documentation, in their order."""

from __future__ import annotations

from pathlib import Path

from tests.docs.test_links import links

DOCS = Path(__file__).resolve().parents[2] / "docs"
ELSEWHERE = {"index.md", "package-page.md"}
"""The index itself, and the page of the package index, which has no links."""


def test_the_index_has_every_page_once() -> None:
    """A page is in one of its parts, and in no other."""
    named = [x for x in links(DOCS / "index.md") if "/" not in x]
    exist = {page.name for page in DOCS.glob("*.md")} - ELSEWHERE
    assert sorted(named) == sorted(exist)
