"""The reference in docs/command-line.md is what the commands say of themselves."""

from __future__ import annotations

import os
import re
from collections import Counter
from collections.abc import Iterator
from pathlib import Path

import click
from click.testing import CliRunner

from garkcli.cli.main import gark
from garkcli.cli.table import SHOWN
from tests.docs.tables import cell, table

PAGE = Path(__file__).resolve().parents[2] / "docs" / "command-line.md"
MARK = "<!-- reference -->\n"
MOST = 2
"""An option of more commands than these is told once."""
OF_ALL = {"-o", "-q", "-v", "--color", "-h"}


def reference() -> str:
    """The options of most commands, then a section a command: usage, help, its own options."""
    group = click.Context(gark, info_name="gark")
    commands = {x: found for x in SHOWN if (found := gark.get_command(group, x))}
    records = {name: [*_records(found, group)] for name, found in commands.items()}
    times = Counter(record for found in records.values() for record in found)
    common = [x for x, count in times.items() if count > MOST and not x[0].startswith("--format")]
    parts = [f"### Options of several commands\n\n{_options(common)}"]
    for name, found in commands.items():
        context = click.Context(found, info_name=name, parent=group)
        usage = " ".join(found.collect_usage_pieces(context))
        own = [x for x in records[name] if x not in common]
        shared = [x[0].split()[0].rstrip(",") for x in records[name] if x in common]
        also = ", ".join(f"`{x}`" for x in shared if x not in OF_ALL)
        parts.append(f"### gark {name}\n\n`gark {name} {usage}`\n\n{_help(found)}\n")
        parts.append(_options(own) + (f"\nAlso {also}.\n" if also else ""))
    return "\n".join(parts)


def _records(found: click.Command, group: click.Context) -> Iterator[tuple[str, str]]:
    context = click.Context(found, parent=group)
    for param in found.get_params(context):
        if isinstance(param, click.Option) and (record := param.get_help_record(context)):
            yield record


def _options(records: list[tuple[str, str]]) -> str:
    """A table of options; words to choose from stand in the text, so that columns stay narrow."""
    rows, properties = [], []
    for name, text in records:
        flags, _, choices = (
            name.partition(" [") if re.search(r"\||--format", name) else (name, "", "")
        )
        default = re.search(r" *\[default: ([^\];]+)\]$", text)
        words = choices.rstrip("]").split("|")
        if text.startswith("The property "):
            properties.append(f"`{flags.partition(' / ')[0]}`")
            continue
        if choices and default:
            words = [f"{x} (default)" if x == default[1] else x for x in words]
            text = text.removesuffix(default[0])
        text = _RANGE.sub("", text)
        told = f"{text} One of {', '.join(words)}." if choices and text else text
        rows.append((f"`{flags}`", cell(" ".join((told or ", ".join(words)).split()))))
    if properties:
        rows.append((", ".join(properties), "The [property](properties.md); `--no-…` without it."))
    return table(("option", "what it does"), rows)


_RANGE = re.compile(r" *\[[\d.<>=x]+\]$|; [\d.<>=x]+(?=\]$)")
"""Ranges of numbers, which ``--help`` shows."""


def _help(found: click.Command) -> str:
    """The first paragraph of a help; ``--help`` shows all of it."""
    return cell(" ".join(re.split(r"\n\s*\n", (found.help or "").strip())[0].split()))


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
