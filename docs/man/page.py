"""The manual page: ``gark.1`` beside this file, made from what the commands say of themselves.

    python docs/man/page.py

``make man`` does it; a test holds the page against the commands. The exit codes are those of
docs/command-line.md.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path
from textwrap import dedent

import click

from garkcli import __version__
from garkcli.cli.command import GroupedCommand
from garkcli.cli.main import gark
from garkcli.cli.table import COMMANDS

FILE = Path(__file__).parent / "gark.1"
COMMAND_LINE = FILE.parents[1] / "command-line.md"
KEPT = "\b"
"""Where click keeps the lines of a paragraph as they are."""
ENVIRONMENT = {
    "GARK_PATH": "Folders whose method files have names too, separated as in PATH.",
    "NO_COLOR, FORCE_COLOR": "No colour, or colour without a terminal; --color is stronger.",
}
FILES = {
    ".gark.toml": "What a project always wants of gark check; also [tool.gark] in pyproject.toml."
}
COMPLETION = """
    The names of commands, options, files, problems and methods of the catalogue are completed
    after a line in the file that the shell reads at its start:
"""
SHELLS = {
    "~/.bashrc": 'eval "$(_GARK_COMPLETE=bash_source gark)"',
    "~/.zshrc": 'eval "$(_GARK_COMPLETE=zsh_source gark)"',
    "~/.config/fish/config.fish": "_GARK_COMPLETE=fish_source gark | source",
}


def page() -> str:
    """The whole page, in the macros of man.

    >>> page().splitlines()[1].startswith('.TH GARK 1 "" "gark ')
    True
    """
    context = click.Context(gark, info_name="gark")
    lines = [
        r".\" made by docs/man/page.py",
        f'.TH GARK 1 "" "gark {__version__}"',
        ".SH NAME",
        escaped("gark - Runge-Kutta methods judged and designed, exactly"),
        ".SH SYNOPSIS",
        r"\fBgark\fR \fICOMMAND\fR [\fIFILE\fR...] [\fIOPTIONS\fR]",
        ".SH DESCRIPTION",
        *described(gark),
        ".SH OPTIONS",
        *options(context),
        ".SH COMMANDS",
    ]
    for name in COMMANDS:
        lines += command(name, context)
    lines += [".SH EXIT STATUS", *listed(exit_codes())]
    lines += [".SH ENVIRONMENT", *listed(ENVIRONMENT)]
    lines += [".SH FILES", *listed(FILES)]
    lines += [".SH COMPLETION", escaped(" ".join(COMPLETION.split()))]
    lines += listed(SHELLS)
    return "\n".join(lines) + "\n"


def command(name: str, group: click.Context) -> Iterator[str]:
    """The section of one command: usage, help, options."""
    found = gark.get_command(group, name)
    assert found is not None
    context = click.Context(found, info_name=name, parent=group)
    usage = " ".join(found.collect_usage_pieces(context))
    yield f'.SS "{escaped(f"gark {name} {usage}")}"'
    if isinstance(found, GroupedCommand):
        yield from [".PP", ".nf", *map(escaped, found.examples), ".fi"]
    yield from described(found)
    yield from options(context)


def described(found: click.Command) -> Iterator[str]:
    """The paragraphs of a help; those whose lines are kept stand as they are."""
    for paragraph in re.split(r"\n\s*\n", (found.help or "").strip()):
        yield ".PP"
        if paragraph.lstrip(" ").startswith(KEPT):
            kept = paragraph.lstrip(" ").removeprefix(KEPT).strip("\n")
            yield ".nf"
            yield from map(escaped, dedent(kept).splitlines())
            yield ".fi"
        else:
            yield escaped(" ".join(paragraph.split()))


def options(context: click.Context) -> Iterator[str]:
    """The options of a command, below their headings as in its help."""
    if isinstance(context.command, GroupedCommand):
        for heading, records in context.command.groups(context).items():
            yield ".PP"
            yield rf"\fI{escaped(heading)}\fR"
            yield from listed(dict(records))
        return
    yield from listed(
        dict(
            record
            for param in context.command.get_params(context)
            if (record := param.get_help_record(context))
        )
    )


def listed(entries: dict[str, str]) -> Iterator[str]:
    """Names in bold, each with its text below."""
    for name, text in entries.items():
        yield ".TP"
        yield rf"\fB{escaped(name)}\fR"
        if text:
            yield escaped(" ".join(text.split()))


def exit_codes() -> dict[str, str]:
    """The rows of the table in docs/command-line.md."""
    text = COMMAND_LINE.read_text(encoding="utf-8")
    table = text.partition("## Exit codes")[2].partition("\n## ")[0]
    rows = re.findall(r"^\| (\d+) \| (.*) \|$", table, re.MULTILINE)
    return {code: meaning.replace("`", "") for code, meaning in rows}


def escaped(text: str) -> str:
    r"""A line that says what ``text`` does: nothing in it is taken for a request.

    >>> print(escaped(".a -b \\c"))
    \&.a \-b \ec
    """
    plain = text.replace("\\", r"\e").replace("-", r"\-").replace('"', r"\(dq")
    return rf"\&{plain}" if plain.startswith((".", "'")) else plain


if __name__ == "__main__":
    FILE.write_text(page(), encoding="utf-8")
