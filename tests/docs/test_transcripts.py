"""What the pages show is what their commands print: every page that has a session is run."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from tests.docs.blocks import pages
from tests.docs.transcripts import ROOT, agrees, brought_up_to_date, prepare, run, steps
from tests.whole import IS_RENEWED, IS_WHOLE

EMPTY = (
    "README",
    "index",
    "tutorial-student",
    "tutorial-maintainer",
    "tutorial-designer",
    "tutorial-paper",
    "howto-from-a-paper",
    "howto-other-codes",
    "howto-imex",
    "howto-multirate",
    "howto-own-problem",
    "howto-stiff",
)
"""Pages that begin in an empty folder; the others use what a checkout has."""
LONG = (
    *("rk-1214", "pep-756", "kencarp-5", "fehlberg-9", "no-resonance"),
    *("tacs-548", "ponio-548", "kencar-3", "explicit7-order5.yaml"),
)
"""Words of commands that take long: they are run in ``make whole``, and where pages
are renewed.
"""


def has_a_session(page: Path) -> bool:
    """Whether a page has a command that is run."""
    return any(step.command for step in steps(page))


PAGES = [page for page in pages() if has_a_session(page)]


@pytest.mark.skipif(os.name == "nt", reason="the pages are for a shell with sed")
@pytest.mark.every_case
@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_a_page_is_a_real_session(page: Path, tmp_path: Path) -> None:
    """Each file as shown, each command in its turn, from an empty folder or from one with nothing
    but the examples.

    Those of the README are processes.
    """
    if page.stem not in EMPTY:
        prepare(tmp_path)
    count = 0
    for step in steps(page):
        if step.file:
            (tmp_path / step.file).write_text(step.text, encoding="utf-8")
            continue
        if not IS_WHOLE and not IS_RENEWED and any(name in step.command for name in LONG):
            continue
        code, lines = run(step.command, tmp_path, as_process=page.name == "README.md")
        is_refused = code == 2 and bool(step.text)  # which a page may show
        assert code in {0, 1} or is_refused, "\n".join(lines)
        if IS_RENEWED:
            shown = brought_up_to_date(step.text, lines)
            text = page.read_text(encoding="utf-8")
            renewed = text.replace(step.block(step.text), step.block(shown), 1)
            page.write_text(renewed, encoding="utf-8")
            continue
        assert agrees(step.text, lines), f"{step.command} shows\n\n" + "\n".join(lines)
        count += 1
    assert count > 0 or IS_RENEWED


def test_the_readme_is_short() -> None:
    """It is read in a few minutes: 500 words at most, the landing page of the site 250."""
    assert len((ROOT / "README.md").read_text(encoding="utf-8").split()) <= 500
    assert len((ROOT / "docs" / "index.md").read_text(encoding="utf-8").split()) <= 250


def test_the_pages_are_short() -> None:
    """All together have 60 000 words at most, tables and transcripts included."""
    pages = (ROOT / "docs").rglob("*.md")
    assert sum(len(x.read_text(encoding="utf-8").split()) for x in pages) <= 60_000


def test_the_comparison_can_fail() -> None:
    """``...`` stands for lines left out, anything else has to be there."""
    assert agrees("a\n...\nd", ["a", "b", "c", "d"])
    assert agrees("a\n...", ["a"])
    assert not agrees("a\n...\nd", ["a", "b", "c"])
    assert not agrees("a", ["a", "b"])


def test_renewed_sessions_keep_the_lines_that_they_show() -> None:
    """A new line above the last one that is shown is shown too; what cannot be told is refused."""
    assert brought_up_to_date("a\nb\n...", ["a", "x", "b", "c"]) == "a\nx\nb\n..."
    assert brought_up_to_date("a\nb\n...", ["a", "b", "c"]) == "a\nb\n..."
    assert brought_up_to_date("a", ["b", "c"]) == "b\nc"
    for shown in ("a\nb\n...", "a\n...\nd"):
        with pytest.raises(AssertionError, match="mend it by hand"):
            brought_up_to_date(shown, ["a", "x", "c"])
