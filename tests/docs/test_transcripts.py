"""What the README and the tour show is what their commands print."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from tests.docs.transcripts import (
    ROOT,
    agrees,
    brought_up_to_date,
    prepare,
    run,
    steps,
)

PAGES = [
    ROOT / "README.md",
    ROOT / "docs" / "tour.md",
    ROOT / "docs" / "tutorial-student.md",
    ROOT / "docs" / "tutorial-maintainer.md",
    ROOT / "docs" / "tutorial-designer.md",
    ROOT / "docs" / "stability.md",
    ROOT / "docs" / "modified-equation.md",
    ROOT / "docs" / "energy.md",
    ROOT / "docs" / "certificate.md",
    ROOT / "docs" / "design.md",
    ROOT / "docs" / "sweep.md",
    ROOT / "docs" / "search.md",
    ROOT / "docs" / "found.md",
    ROOT / "docs" / "conversion.md",
    ROOT / "docs" / "import.md",
    ROOT / "docs" / "audit.md",
    ROOT / "docs" / "comparison.md",
]


@pytest.mark.skipif(
    os.name == "nt", reason="the pages are for a shell with sed"
)
@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_a_page_is_a_real_session(page: Path, tmp_path: Path) -> None:
    """From a folder with nothing but the examples: each file as shown, each command in its turn.

    Those of the README are processes.
    """
    prepare(tmp_path)
    count = 0
    for step in steps(page):
        if step.file:
            (tmp_path / step.file).write_text(step.text, encoding="utf-8")
            continue
        code, lines = run(
            step.command, tmp_path, as_process=page.name == "README.md"
        )
        assert code in {0, 1}, "\n".join(lines)
        if os.environ.get("GARK_UPDATE_SNAPSHOTS") == "1":
            shown = brought_up_to_date(step.text, lines)
            text = page.read_text(encoding="utf-8")
            page.write_text(
                text.replace(step.text, shown, 1), encoding="utf-8"
            )
            continue
        assert agrees(step.text, lines), (
            f"{step.command} shows\n\n" + "\n".join(lines)
        )
        count += 1
    assert count > 0 or "GARK_UPDATE_SNAPSHOTS" in os.environ


def test_the_readme_is_short() -> None:
    """It is read in a few minutes: 8 KB at most."""
    assert len((ROOT / "README.md").read_bytes()) <= 8 * 1024


def test_the_comparison_can_fail() -> None:
    """``...`` stands for lines left out, anything else has to be there."""
    assert agrees("a\n...\nd", ["a", "b", "c", "d"])
    assert agrees("a\n...", ["a"])
    assert not agrees("a\n...\nd", ["a", "b", "c"])
    assert not agrees("a", ["a", "b"])
