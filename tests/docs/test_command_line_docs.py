"""The reference in docs/command-line.md is what the commands say of themselves."""

from __future__ import annotations

import os
import re
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

import click
from click.testing import CliRunner

from garkcli.cli.command import GroupedCommand
from garkcli.cli.endings import ENDINGS
from garkcli.cli.main import gark
from garkcli.cli.table import COMMANDS
from tests.docs.tables import cell, table

PAGE = Path(__file__).resolve().parents[2] / "docs" / "command-line.md"
MARK = "<!-- reference -->\n"
OF_ALL = {"-o", "-q", "-v", "--color", "-h", "--catalogue"}
USUAL = "text (default), json, markdown, latex"
"""The formats of most commands, which the head of the page tells."""


def reference() -> str:
    """The options of several commands, then a section per command: usage, help, its own options."""
    group = click.Context(gark, info_name="gark")
    commands = {x: found for x in COMMANDS if (found := gark.get_command(group, x))}
    records = {name: [*_records(found, group)] for name, found in commands.items()}
    times = Counter(record for found in records.values() for record in found)
    common = [x for x, count in times.items() if count > 1 and not x[0].startswith("--format")]
    parts = [f"### Options of several commands\n\n{_options(common)}"]
    for name, found in commands.items():
        context = click.Context(found, info_name=name, parent=group)
        usage = " ".join([f"gark {name}", *found.collect_usage_pieces(context)[1:]])
        own = [x for x in records[name] if x not in common and _choices(*x) != USUAL]
        shared = [x[0].split()[0].rstrip(",") for x in records[name] if x in common]
        also = ", ".join(f"`{x}`" for x in shared if x not in OF_ALL)
        assert isinstance(found, GroupedCommand)
        lines = "\n".join(["```sh", *found.examples, "```"])
        parts.append(f"### gark {name}\n\n`{usage}`\n\n{_help(found)}\n\n{lines}\n")
        headings = _headings(found, group)
        tables = [_options(own, headings)] if own else []
        parts.append("\n".join([*tables, f"Also {also}.\n"] if also else tables))
    return "\n".join(filter(None, parts))


def _choices(flags: str, text: str) -> str:
    """The words that an option chooses from, the default marked; empty where it takes others."""
    if not re.search(r"\||--format", flags):
        return ""
    default = re.search(_DEFAULT, text)
    words = flags.partition(" [")[2].rstrip("]").split("|")
    return ", ".join(f"{x} (default)" if default and x == default[1] else x for x in words)


_DEFAULT = r" *\[default: ([^\];]+)\]$"


def _records(found: click.Command, group: click.Context) -> Iterator[tuple[str, str]]:
    yield from _headings(found, group)


def _headings(found: click.Command, group: click.Context) -> dict[tuple[str, str], str]:
    """The options with their help, and the heading of each."""
    assert isinstance(found, GroupedCommand)
    groups = found.groups(click.Context(found, parent=group))
    return {record: heading for heading, records in groups.items() for record in records}


def _options(
    records: list[tuple[str, str]], headings: Mapping[tuple[str, str], str] | None = None
) -> str:
    """A table of options, below their headings if there are several; words to choose from stand in
    the text, so that columns stay narrow.
    """
    rows, properties = [], []
    told = [headings[x] for x in records] if headings else []
    before = "" if len({*told}) > 1 else None
    for name, text in records:
        if headings and before is not None and (heading := headings[name, text]) != before:
            rows.append((f"**{heading}**", ""))
            before = heading
        choices = _choices(name, text)
        flags = name.partition(" [")[0] if choices else name
        if not text:
            properties.append(f"`{flags.partition(' / ')[0].partition(' ')[0]}`")
            continue
        if choices:
            text = re.sub(_DEFAULT, "", text)
            names = "|".join(re.findall(r"[\w-]+(?=,|$| \()", choices))
            text = re.sub(rf"(?i)^([\w ]+)?:? *(?:(?:{names})(?:, | or |\.))+$", r"\1", text)
            before = ". One of" if re.search("[:;]", text) else ":"
            text = f"{text.rstrip('.:')}{before} {choices}" if text else choices
        text = _RANGE.sub("", text)
        rows.append((f"`{flags}`".replace("|", r"\|"), cell(" ".join(text.split()))))
    if properties:
        about = "By a [property](properties.md); `--no-…` without it, sizes take a RANGE."
        rows.append((", ".join(properties), about))
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
    head, _, _ = PAGE.read_text(encoding="utf-8").partition(MARK)
    rows = "".join(x for x in head.splitlines() if x.startswith("| `gark"))
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
