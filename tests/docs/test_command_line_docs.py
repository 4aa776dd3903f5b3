"""docs/command-line.md has every command and ending, and on the site every option."""

from __future__ import annotations

import os
from collections.abc import Sequence
from pathlib import Path

import click
from click.testing import CliRunner

from garkcli.cli.endings import ENDINGS
from garkcli.cli.main import gark
from garkcli.cli.table import COMMANDS
from tests.docs.command_reference import reference
from tests.docs.tables import table

PAGE = Path(__file__).resolve().parents[2] / "docs" / "command-line.md"


def test_the_reference_has_every_option() -> None:
    """Each option of each command has a row, or is named in one; no row is broken."""
    page = reference()
    rows = [x for x in page.splitlines() if x.startswith("|")]
    assert all(x.replace(r"\|", "").count("|") == 3 for x in rows)
    for name in COMMANDS:
        command = gark.get_command(click.Context(gark), name)
        assert command is not None
        assert f"### gark {name}\n" in page
        for param in command.params:
            if isinstance(param, click.Option) and not param.hidden:
                assert f"`{param.opts[0]}" in page or f", {param.opts[0]}" in page, param.opts


def endings() -> str:
    """What files hold, by their endings; those of programs and pictures in one row each."""
    rows: dict[str, list[str]] = {}
    for ending, held in ENDINGS.items():
        rows.setdefault(_holds(held), []).append(f"`{ending}`")
    return table(("ending", "holds"), [(", ".join(x), held) for held, x in rows.items()])


def _holds(formats: Sequence[str]) -> str:
    if formats[0] in {"png", "svg", "pdf"}:
        return "pictures"
    commands = (gark.get_command(click.Context(gark), x) for x in COMMANDS)
    params = (x for found in commands if found for x in found.params if x.name == "format")
    known = {
        x for param in params if isinstance(param.type, click.Choice) for x in param.type.choices
    }
    told = [x for x in formats if x in known]
    if not told:
        return "Parquet" if formats[0] == "parquet" else "a table of `gark export`"
    return " or ".join(told)


def test_the_endings_of_files() -> None:
    """The page has what the program goes by."""
    page = PAGE.read_text(encoding="utf-8")
    head, mark, rest = page.partition("<!-- endings -->\n\n")
    found, end, rest = rest.partition("<!-- end of endings -->")
    if os.environ.get("GARK_UPDATE_SNAPSHOTS"):
        PAGE.write_text(head + mark + endings() + end + rest, encoding="utf-8")
    else:
        assert found == endings()


def test_every_command_is_in_the_table() -> None:
    """The head of the page has each command there is."""
    page = PAGE.read_text(encoding="utf-8")
    rows = "".join(x for x in page.splitlines() if x.startswith("| `gark"))
    assert [x for x in COMMANDS if f"`gark {x}" not in rows] == []


def test_no_help_shows_a_mark_of_its_layout() -> None:
    """The sign that keeps lines as they are does its work and is not seen; the example keeps its
    lines.
    """
    runner = CliRunner()
    texts = [
        runner.invoke(gark, [*name, "--help"], terminal_width=80).output
        for name in ([], *([x] for x in COMMANDS))
    ]
    assert not any("\\" in text or "\b" in text for text in texts)
    assert "      methods:\n        - {family: gauss, stages: 2}\n" in texts[0]
