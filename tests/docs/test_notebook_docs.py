"""docs/notebook.md: its cells run in order, show what stands below them, and are those of Jupyter."""

from __future__ import annotations

import os
from typing import Any

import pytest
import yaml

from tests.cli.harness import ROOT
from tests.docs.blocks import blocks
from tests.docs.notebook import Cell, brought_up_to_date, cells, run

PAGE = ROOT / "docs" / "notebook.md"


@pytest.fixture(scope="module")
def results() -> list[str]:
    """What each cell shows."""
    session: dict[str, Any] = {}
    return [run(x, session) for x in cells(PAGE.read_text(encoding="utf-8"))]


def test_cells_show_what_the_page_says(results: list[str]) -> None:
    """Each one, its output at once below it; GARK_UPDATE_SNAPSHOTS writes the page."""
    text = PAGE.read_text(encoding="utf-8")
    if os.environ.get("GARK_UPDATE_SNAPSHOTS"):
        made = brought_up_to_date(text, results)
        PAGE.write_text(made, encoding="utf-8")
        return
    assert len(results) > 7
    for cell, result in zip(cells(text), results, strict=True):
        assert cell.shown == result, cell.code
        assert max(map(len, result.splitlines()), default=0) <= 100


def test_no_block_is_passed_over() -> None:
    """Every block of the page is a cell or the output of one."""
    found = cells(PAGE.read_text(encoding="utf-8"))
    outputs = sum(bool(cell.shown) for cell in found)
    kinds = [block.language for block in blocks(PAGE)]
    assert kinds.count("{code-cell} python") == len(found)
    assert kinds.count("text") == outputs
    assert len(kinds) == len(found) + outputs


def test_jupyter_knows_the_page_as_a_notebook() -> None:
    """Its head names the format and the kernel, as jupytext reads them."""
    _, head, _ = PAGE.read_text(encoding="utf-8").split("---\n", 2)
    told = yaml.safe_load(head)
    form = told["jupytext"]["text_representation"]
    assert form == {"extension": ".md", "format_name": "myst"}
    assert told["kernelspec"]["language"] == "python"


def test_a_cell_that_shows_something_else_is_found() -> None:
    """The comparison can fail, and an update mends it."""
    text = "```{code-cell} python\nx = 2\nx\n```\n\n```text\n3\n```\n"
    (cell,) = cells(text)
    assert cell == Cell("x = 2\nx\n", "3\n")
    result = run(cell, {})
    assert result == "2\n"
    (mended,) = cells(brought_up_to_date(text, [result]))
    assert mended.shown == "2\n"
