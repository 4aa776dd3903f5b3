"""The article in paper/: short, its session real, its numbers those of the program and the pages."""

from __future__ import annotations

import os
import re
from pathlib import Path

import pytest

from garkcli.catalogue.mapping import method_names
from tests.cli.harness import ROOT
from tests.docs.transcripts import agrees, run, steps

ARTICLE = ROOT / "paper" / "paper.md"
TEXT = ARTICLE.read_text(encoding="utf-8")
ENTRIES = (ROOT / "paper" / "paper.bib").read_text(encoding="utf-8")


def test_it_is_short() -> None:
    """As journals of research software want it."""
    assert len(TEXT.split()) <= 1200


@pytest.mark.skipif(os.name == "nt", reason="as the pages")
def test_its_session_is_real(tmp_path: Path) -> None:
    """Each command prints what the article shows."""
    commands = []
    for step in steps(ARTICLE):
        if step.file:
            (tmp_path / step.file).write_text(step.text, encoding="utf-8")
            continue
        code, lines = run(step.command, tmp_path, as_process=False)
        assert code == 0
        assert agrees(step.text, lines), "\n".join(lines)
        commands.append(step.command)
    assert commands == ["gark check ssp-33", "gark check nearly.yaml"]


def test_its_references_are_there() -> None:
    """What is cited has an entry, and each entry is cited."""
    cited = set(re.findall(r"@(\w+)", TEXT.partition("\n---\n")[2]))
    assert cited == set(re.findall(r"^@\w+\{(\w+),$", ENTRIES, re.M))


def test_its_numbers_are_those_of_the_program_and_the_pages() -> None:
    """Methods are counted; random pairs are those that the page on pairs has; conditions too."""
    (count,) = re.findall(r"more than (\d+) published methods", TEXT)
    assert int(count) < len(method_names()) < 2 * int(count)
    page = (ROOT / "docs" / "pair-order.md").read_text(encoding="utf-8")
    (pairs,) = re.findall(r"([\d ]+) random\s+pairs", TEXT)
    assert f"Theorem B on {pairs.strip()} random pairs" in page
    assert "--cases 10000" in (ROOT / "Makefile").read_text(encoding="utf-8")
    for said in ("1/(2(k+1)^2)", "n=2k+1", "n=2k+2"):
        assert said in TEXT
        assert said in page
