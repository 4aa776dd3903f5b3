"""Pages say what the calls on them print, because they are run."""

from __future__ import annotations

import doctest
from pathlib import Path

import pytest

from tests.cli.harness import ROOT
from tests.docs.blocks import pages_with

RUN_AT_HOME = {"python-reference.md"}
"""Its examples are those of docstrings, run where they stand."""
PAGES = [x for x in pages_with("python", ">>> ") if x.name not in RUN_AT_HOME]


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_the_examples_print_what_the_page_says(page: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Every example of the page, in order."""
    monkeypatch.chdir(ROOT)
    text = page.read_text(encoding="utf-8")
    # a closing fence is no output
    examples = text.replace("```python\n", "").replace("```\n", "")
    test = doctest.DocTestParser().get_doctest(examples, {}, page.name, str(page), 0)
    assert test.examples
    report: list[str] = []
    result = doctest.DocTestRunner(verbose=False).run(test, out=report.append)
    assert result.failed == 0, "".join(report)
