"""Usage errors, with the same messages in all releases of click."""

from __future__ import annotations

import os
import re
from collections.abc import Iterable, Iterator

import click

from garkcli.errors import MethodFileError, did_you_mean, nearest, printable
from garkcli.files import STDIN

MEANT = {
    "order": "check",
    "orders": "check",
    "verify": "check",
    "validate": "check",
    "test": "check",
    "draw": "trees",
    "butcher": "tableau",
    "picture": "plot",
    "simulate": "converge",
    "solve": "converge",
}
CURES = {
    "FILE...": "name a file, a folder, or a method of the catalogue, such as rk4",
    "FILE": "name a file, or a method of the catalogue, such as rk4",
    "PATH...": "name a file or a folder",
    "SOURCE...": "name a file or a folder",
    "SECOND": "name two files, or methods of the catalogue",
    "FIRST": "name two files, or methods of the catalogue",
    "SPEC": "name a spec file, as docs/sweep.md shows it",
    "--to": "gark list exports shows what can be written",
}
_NUMBERS = re.compile(r"is not a valid (integer|float)( range)?")
_CHOICE = re.compile(r"'([^']*)' is not one of (.*)\.")
_EXTRA = re.compile(r"[Gg]ot unexpected extra arguments? \((\d+)\)")


def no_such_command(word: str, commands: Iterable[str]) -> str:
    """A method is for ``gark check``."""
    message = f"no such command {printable(word)!r}"
    if word == STDIN:
        return f"{message}\nhelp: it stands for a file behind a command, as in gark check -"
    if word.lower() in MEANT:
        return f"{message}\nhelp: did you mean {MEANT[word.lower()]!r}?"
    cure = did_you_mean(word, commands)
    if not cure.startswith("did you mean") and _is_a_method(word):
        cure = f"for a method: gark check {printable(word)}"
    return f"{message}\nhelp: {cure}"


def _is_a_method(word: str) -> bool:
    """Whether a word is a file, looks like one, or is a name of the catalogue."""
    if word.endswith((".yaml", ".yml")) or os.path.exists(word):
        return True
    from garkcli.methodfile.naming import look_up

    try:
        return look_up(word) is not None
    except MethodFileError:  # it means several
        return True


def usage_text(error: click.ClickException) -> str:
    context: click.Context | None = getattr(error, "ctx", None)
    message = _message(error, context)
    lines = []
    if context is not None:
        lines = [context.get_usage(), f"Try '{context.command_path} --help' for help.", ""]
    return "\n".join([*lines, f"Error: {message}"])


def _message(error: click.ClickException, context: click.Context | None) -> str:
    message = error.format_message()
    parameters = [] if context is None else context.command.params
    told = [p for p in parameters if isinstance(p, click.Option) and not p.hidden]
    options = [x for p in told for x in p.opts]
    if isinstance(error, click.NoSuchOption):
        return _no_such_option(error.option_name, options, context)
    if isinstance(error, click.MissingParameter):
        cures = [cure for word, cure in CURES.items() if word in message]
        return f"{message.rstrip('.')}\nhelp: {cures[0]}" if cures else message
    if (extra := _EXTRA.fullmatch(message.rstrip("."))) and ("--order" in options):
        return f"{message.rstrip('.')}\nhelp: an order is --order {extra[1]}"
    if choice := _CHOICE.search(message):
        words = re.findall(r"'([^']*)'", choice[2])
        cure = _cure_of_choice(choice[1], words)
        return f"{message.rstrip('.')}\nhelp: {cure}" if cure else message
    return _NUMBERS.sub(_number, message)


def _no_such_option(name: str, options: list[str], context: click.Context | None) -> str:
    message = f"no such option {printable(name)}"
    if not name.startswith("--"):
        return f"{message}\nhelp: options of several letters begin with --"
    others = [] if nearest(name, options) else list(_commands_with(name, context))
    if others:
        more = f" and {len(others) - _SHOWN} more" if len(others) > _SHOWN else ""
        return f"{message}\nhelp: it belongs to gark {', '.join(others[:_SHOWN])}{more}"
    return f"{message}\nhelp: {did_you_mean(name, options)}"


_SHOWN = 4


def _commands_with(option: str, context: click.Context | None) -> Iterator[str]:
    group = context and context.parent and context.parent.command
    if context is None or not isinstance(group, click.Group):
        return
    for name in group.list_commands(context):
        command = group.get_command(context, name)
        if command is not None and any(option in x.opts for x in command.params):
            yield name


def _cure_of_choice(word: str, words: list[str]) -> str:
    near = nearest(word, words)
    if near:
        return f"did you mean {near!r}?"
    if "methods" in words and _is_a_method(word):
        return f"for a method: gark list methods {printable(word)}"
    return ""


def _number(found: re.Match[str]) -> str:
    kind = "whole number" if found[1] == "integer" else "number"
    return f"is not a {kind}"
