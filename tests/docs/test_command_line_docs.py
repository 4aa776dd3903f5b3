"""The reference in docs/command-line.md is what the commands say of themselves."""

from __future__ import annotations

import os
from pathlib import Path

from click.testing import CliRunner

from garkcli.cli.main import gark
from garkcli.cli.table import SHOWN

PAGE = Path(__file__).resolve().parents[2] / "docs" / "command-line.md"
MARK = "<!-- reference -->\n"


def reference() -> str:
    """The help of every command, in 80 columns."""
    runner = CliRunner()
    parts = []
    for name in SHOWN:
        result = runner.invoke(
            gark, [name, "--help"], prog_name="gark", terminal_width=80, max_content_width=80
        )
        assert result.exit_code == 0, result.output
        parts.append(f"### gark {name}\n\n```text\n{result.output.rstrip()}\n```\n")
    return "\n".join(parts)


def test_reference_is_the_help() -> None:
    """Every option that the reference shows exists, and every option that exists is shown."""
    page = PAGE.read_text(encoding="utf-8")
    head, mark, found = page.partition(MARK)
    assert mark
    wanted = "\n" + reference()
    if os.environ.get("GARK_UPDATE_SNAPSHOTS"):
        PAGE.write_text(head + mark + wanted, encoding="utf-8")
        return
    assert found == wanted


def test_every_command_is_in_the_table() -> None:
    """The head of the page has each command there is."""
    head, _, _ = PAGE.read_text(encoding="utf-8").partition(MARK)
    rows = "".join(x for x in head.splitlines() if x.startswith("| `gark"))
    assert [x for x in SHOWN if f"`gark {x}" not in rows] == []


def test_no_help_shows_a_mark_of_its_layout() -> None:
    """The sign that keeps lines as they are does its work and is not seen; the example keeps its
    lines.
    """
    runner = CliRunner()
    texts = [
        runner.invoke(gark, [*name, "--help"], terminal_width=80).output
        for name in ([], *([x] for x in SHOWN))
    ]
    assert not any("\\" in text or "\b" in text for text in texts)
    assert "      methods:\n        - {family: gauss, stages: 2}\n" in texts[0]
