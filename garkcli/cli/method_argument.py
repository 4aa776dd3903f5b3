"""Files and names of the catalogue as arguments, with completion; ``--catalogue``."""

from __future__ import annotations

import os
from collections.abc import Iterator, Sequence
from contextlib import suppress
from typing import Any

import click
from click.shell_completion import CompletionItem

from garkcli.errors import GarkError, UsageProblem
from garkcli.files import note_input

_NOTES = "garkcli.notes"
"""Where a context keeps what is to be said once it is known how much the user wants to hear."""
_VARIABLE = "GARK_PATH"


class InputType(click.Path):
    """A path that the command reads, so that nothing is written over it; whoever reads it says what
    is wrong with it.
    """

    name = "file"

    def __init__(self) -> None:
        super().__init__(readable=False)

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        """The path as it is given, remembered as an input."""
        found = super().convert(value, param, ctx)
        note_input(str(found))
        return found


INPUT = InputType()
"""The type of arguments and options that are files which are read."""


class MethodType(InputType):
    """A path, a name or an alias."""

    def shell_complete(
        self, ctx: click.Context, param: click.Parameter, incomplete: str
    ) -> list[CompletionItem]:
        """Names that begin so with files beside them; below folders the shell goes on alone."""
        from garkcli.methodfile.naming import can_be_name

        found = []
        if incomplete and can_be_name(incomplete):
            found = list(_names_beginning(incomplete))
        if not found:
            return [CompletionItem(incomplete, type="file")]
        found += _entries_beginning(incomplete)
        return [CompletionItem(name) for name in found]


def _names_beginning(start: str) -> Iterator[str]:
    """Names of the catalogue; where none begins so, aliases without blanks."""
    from garkcli.methodfile.naming import names_beginning

    with suppress(GarkError):  # a broken catalogue is told when it is used
        yield from names_beginning(start)


def _entries_beginning(start: str) -> list[str]:
    """Files of this folder, and folders with a separator behind them."""
    found = []
    with suppress(OSError):
        for name in sorted(os.listdir()):
            if name.startswith(start) and name.isprintable():
                is_folder = os.path.isdir(name)
                found.append(name + os.sep if is_folder else name)
    return found


METHOD = MethodType()
"""The type of arguments that are method files or names."""


def add_folders(context: click.Context, _: click.Parameter, folders: Sequence[str]) -> None:
    """Put folders before those of ``GARK_PATH``, for this run and the processes that it starts.

    Raises:
        UsageProblem: one of them is no folder.
    """
    if not folders or context.resilient_parsing:
        return
    for folder in folders:
        if not os.path.isdir(folder):
            message = f"--catalogue: {folder!r} is no folder"
            raise UsageProblem(message, "name a folder with method files", code="option-value")
        if os.pathsep in folder:
            message = f"--catalogue: {folder!r} has {os.pathsep!r} in it, which is between folders"
            raise UsageProblem(message, "rename it", code="option-value")
    before = os.environ.get(_VARIABLE)
    rest = [before] if before else []
    os.environ[_VARIABLE] = os.pathsep.join([*folders, *rest])
    context.call_on_close(lambda: _restore(before))


def _restore(before: str | None) -> None:
    if before is None:
        os.environ.pop(_VARIABLE, None)
    else:
        os.environ[_VARIABLE] = before


def with_notes(context: click.Context, _: click.Parameter, value: Any) -> Any:
    """Keep what has to be said of names, until it is known how much the user wants to hear."""
    if os.environ.get(_VARIABLE) and not context.resilient_parsing:
        from garkcli.methodfile.naming import note_of

        given = value if isinstance(value, tuple) else (value,)
        notes = context.meta.setdefault(_NOTES, [])
        with suppress(GarkError):  # it is told where the method is read
            notes += [note for path in given if path for note in note_of(path)]
    return value


def notes() -> list[str]:
    """What was kept to be said, once."""
    context = click.get_current_context(silent=True)
    kept: list[str] = context.meta.pop(_NOTES, []) if context else []
    return kept
