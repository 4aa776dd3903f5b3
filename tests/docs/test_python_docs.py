"""docs/python.md says what the calls on it print, because they are run."""

from __future__ import annotations

import doctest
from pathlib import Path

PAGE = Path(__file__).resolve().parents[2] / "docs" / "python.md"


def test_the_examples_print_what_the_page_says() -> None:
    """Every example of the page, in order."""
    text = PAGE.read_text(encoding="utf-8")
    # a closing fence is no output
    examples = text.replace("```python\n", "").replace("```\n", "")
    test = doctest.DocTestParser().get_doctest(
        examples, {}, "python.md", str(PAGE), 0
    )
    assert len(test.examples) > 10
    report: list[str] = []
    result = doctest.DocTestRunner(verbose=False).run(test, out=report.append)
    assert result.failed == 0, "".join(report)
