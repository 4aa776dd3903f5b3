"""What the commands share: options, where the report goes, whether it has colour."""

from __future__ import annotations

import os
import sys
from collections.abc import Callable, Iterable, Sequence
from contextlib import suppress
from pathlib import Path
from typing import Any, TypeVar

import click

from garkcli.errors import UsageProblem
from garkcli.report.paint import Paint

F = TypeVar("F", bound=Callable[..., Any])
CONTEXT = {"help_option_names": ["-h", "--help"], "max_content_width": 100}


def common(formats: Sequence[str]) -> Callable[[F], F]:
    """``--format``, ``-o``, ``-q``, ``-v``, ``--color``; they arrive as one ``Output``."""

    def decorate(function: F) -> F:
        def run(
            format: str,  # noqa: A002 -- the option's name
            output: str | None,
            quiet: bool,
            verbose: bool,
            color: str,
            **rest: Any,
        ) -> Any:
            return function(output=Output(format, output, verbose - quiet, color), **rest)

        run.__doc__ = function.__doc__
        run.__name__ = function.__name__
        run.__click_params__ = getattr(function, "__click_params__", [])  # type: ignore[attr-defined]
        options = [
            click.option(
                "--format", type=click.Choice(formats), default=formats[0], show_default=True
            ),
            click.option("-o", "--output", metavar="FILE", help="Write the report to FILE."),
            click.option("-q", "--quiet", is_flag=True, help="Say less."),
            click.option("-v", "--verbose", is_flag=True, help="Say more."),
            click.option(
                "--color",
                type=click.Choice(["auto", "always", "never"]),
                default="auto",
                show_default=True,
            ),
        ]
        decorated: Any = run
        for option in reversed(options):
            decorated = option(decorated)
        return decorated  # type: ignore[no-any-return]

    return decorate


class Output:
    """Where a report goes and how it may look.

    Attributes:
        format: the chosen format.
        verbosity: −1, 0 or 1.
    """

    def __init__(self, format: str, path: str | None, verbosity: int, color: str) -> None:  # noqa: A002
        self.format = format
        self.path = path
        self.verbosity = verbosity
        self._color = color

    @property
    def paint(self) -> Paint:
        """Colour, where the report goes to a terminal or colour is asked for."""
        wanted = self._color == "always"
        if self._color == "auto":
            wanted = self.path is None and sys.stdout.isatty() and "NO_COLOR" not in os.environ
        return Paint(wanted)

    @property
    def width(self) -> int:
        """Columns to fill: the terminal's; 80 without one."""
        from shutil import get_terminal_size

        return get_terminal_size((80, 24)).columns if self.path is None else 80

    def write(self, text: str | Iterable[str]) -> None:
        """Write the report; a file appears whole or not at all."""
        pieces = [text] if isinstance(text, str) else text
        if self.path is None:
            for piece in pieces:
                sys.stdout.write(piece)
            return
        write_whole(self.path, pieces)

    @property
    def may_show_progress(self) -> bool:
        """Whether a bar on stderr disturbs nobody: not when the report itself scrolls by on the
        terminal.
        """
        return self.verbosity >= 0 and (self.path is not None or not sys.stdout.isatty())

    def note(self, text: str) -> None:
        """A remark beside the report, on stderr."""
        if self.verbosity >= 0:
            click.echo(text, err=True)


def write_whole(path: str, pieces: Iterable[str]) -> None:
    """Write a file beside its place, then rename it into place.

    Raises:
        UsageProblem: the file cannot be written; nothing is left behind.
    """
    import tempfile

    target = Path(path)
    if target.exists() and not target.is_file():  # a device or a pipe has no name to be replaced
        try:
            with target.open("w", encoding="utf-8") as stream:
                stream.writelines(pieces)
        except OSError as error:
            raise UsageProblem(
                f"cannot write {path}: {error.strerror}", "choose another place"
            ) from None
        return
    temporary = ""
    try:
        handle, temporary = tempfile.mkstemp(prefix=f".{target.name}.", dir=target.parent)
        with os.fdopen(handle, "w", encoding="utf-8") as stream:
            stream.writelines(pieces)
        umask = os.umask(0)
        os.umask(umask)
        Path(temporary).chmod(0o666 & ~umask)
        Path(temporary).replace(target)
    except OSError as error:
        raise UsageProblem(
            f"cannot write {path}: {error.strerror}", "choose another place"
        ) from None
    finally:
        if temporary:
            with suppress(OSError):
                Path(temporary).unlink()
