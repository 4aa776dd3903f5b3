"""docs/python.md says what the calls on it print, because they are run."""

from __future__ import annotations

import doctest
from pathlib import Path

import pytest

DOCS = Path(__file__).resolve().parents[2] / "docs"


@pytest.mark.parametrize(
    ("name", "least"), [("python", 11), ("conversion", 3)]
)
def test_the_examples_print_what_the_page_says(name: str, least: int) -> None:
    """Every example of the page, in order."""
    page = DOCS / f"{name}.md"
    text = page.read_text(encoding="utf-8")
    # a closing fence is no output
    examples = text.replace("```python\n", "").replace("```\n", "")
    test = doctest.DocTestParser().get_doctest(
        examples, {}, page.name, str(page), 0
    )
    assert len(test.examples) >= least
    report: list[str] = []
    result = doctest.DocTestRunner(verbose=False).run(test, out=report.append)
    assert result.failed == 0, "".join(report)
