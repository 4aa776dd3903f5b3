"""The reference of docs/command-line.md on the site: what the commands say of themselves."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator, Mapping

import click

from garkcli.cli.command import GroupedCommand
from garkcli.cli.main import gark
from garkcli.cli.table import COMMANDS
from tests.docs.tables import cell, table

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
