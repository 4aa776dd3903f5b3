"""The place and the appearance of reports."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

import click

from garkcli.cli import arguments
from garkcli.cli.endings import AUTO, settled
from garkcli.cli.streams import complain, look_of, put, put_exactly, safe_pieces, say, wants_colour
from garkcli.doing import hush
from garkcli.errors import GarkError, MethodFileError, Remark, UsageProblem
from garkcli.files import STDIN, note_input
from garkcli.terminal import TERMINAL, width_of_terminal

if TYPE_CHECKING:
    from garkcli.page.look import Look
    from garkcli.plots.scene import Scene
    from garkcli.tell.report import Report


class Output:
    """``path`` is the file of ``-o``, or None; ``verbosity`` −1, 0 or 1; ``is_streamed``: ``-o -``
    was given, ``is_by_ending``: the ending determines the format, ``is_default``: nothing does.
    UsageProblem, before any work, if nothing can be written.
    """

    def __init__(
        self,
        format: str = "text",
        path: str | None = None,
        verbosity: int = 0,
        color: str = "never",
    ) -> None:
        self.format = format
        self.path = path
        self.verbosity = verbosity
        self.is_streamed = False
        self.is_by_ending = False
        self.is_default = False
        is_wanted = color == "auto" and path is None and wants_colour(sys.stdout)
        self._has_colour = color == "always" or is_wanted
        if verbosity < 0:
            hush()
        self.check_place()

    @classmethod
    def of(cls, values: Mapping[str, Any], formats: Sequence[str] = ()) -> Output:
        """A command that checks endings itself has no ``formats``; UsageProblem if the ending of
        the file belongs to another format.
        """
        verbosity = values.get("verbose", False) - values.get("quiet", False)
        format, path = values.get("format", "text"), values.get("output")
        is_streamed = path == STDIN
        path = None if is_streamed else path
        named = None
        if path is not None and formats:
            named = settled(path, formats, _chosen(format))
        is_default = named is None and (not formats or _chosen(format) is None)
        output = cls(named or format, path, verbosity, values.get("color", "never"))
        output.is_by_ending = named is not None
        output.is_streamed = is_streamed
        output.is_default = is_default
        for note in arguments.notes():
            output.note(note)
        return output

    def check_place(self, path: str | None = None) -> None:
        """UsageProblem if the report, or another file, cannot be written."""
        path = self.path if path is None else path
        if path is not None:
            from garkcli.page.writing import refuse_unwritable

            refuse_unwritable(path)

    def files_meant(
        self, files: Sequence[str], settings: Mapping[str, str] | None = None
    ) -> list[str]:
        """Returns the files, which are never overwritten. Raises UsageProblem if one is the output
        too, or for several with --set.
        """
        from garkcli.methodfile.naming import find_files

        found = list(find_files(files, self.note))
        for path in found:
            note_input(path)
        self.check_place()
        if len(found) > 1 and settings:
            message = "--set is for one FILE"
            raise UsageProblem(message, "give the files one by one", code="options-clash")
        return found

    @property
    def look(self) -> Look:
        from garkcli.page.look import Look

        if self.path is not None:
            return Look(self._has_colour)
        return look_of(sys.stdout, self._has_colour)

    @property
    def width(self) -> int:
        return width_of_terminal() if self.path is None else TERMINAL

    def write(self, text: str | Iterable[str], format: str = "") -> None:
        """A file appears whole or not at all; ``format`` overrides ``--format``."""
        pieces = [text] if isinstance(text, str) else text
        format = format or self.format
        coloured = self._has_colour
        if self.path is None:
            for piece in pieces:
                put(piece, format, coloured)
            return
        self.save(self.path, safe_pieces(pieces, format, coloured))

    def write_exactly(self, text: str) -> None:
        if self.path is None:
            put_exactly(text)
        else:
            self.save(self.path, [text.encode()])

    def save(self, path: str, pieces: Iterable[str | bytes]) -> None:
        from garkcli.page.writing import write_whole

        if write_whole(path, pieces):
            self.note(f"wrote {path}")

    def tell(self, report: Report[Any], *wholes: Any) -> None:
        self.write(report.render(wholes, self.format, self.look, self.verbosity, width=self.width))

    def stream(self, report: Report[Any], whole: Any, is_document: bool | None = None) -> None:
        """Writes a report; LaTeX has its preamble if ``is_document``, else names it, neither if
        None.
        """
        pieces = report.pieces(whole, self.format, self.look, self.verbosity, width=self.width)
        if self.format == "latex" and is_document is not None:
            from garkcli.page.latex import fragment

            pieces = fragment(pieces, is_document)
        self.write(pieces)

    def suit(self) -> None:
        """Replaces ``auto`` by the format that suits the environment."""
        if self.format == "auto":
            is_job = os.environ.get("GITHUB_ACTIONS") == "true"
            self.format = "github" if is_job else "text"

    def note(self, text: str) -> None:
        if self.verbosity >= 0:
            say(text)

    def save_plot(self, scene: Scene, path: str) -> None:
        from pathlib import Path

        from garkcli.plots.saving import save_scene

        save_scene(scene, Path(path))
        self.note(f"wrote {path}")

    def demand_file(self) -> None:
        """UsageProblem if --open is given with -o -."""
        if self.is_streamed:
            message = "--open shows a file, and -o - writes none"
            raise UsageProblem(message, "leave one of them out", code="options-clash")

    def show(self, path: str) -> None:
        import webbrowser
        from pathlib import Path

        if not webbrowser.open(Path(path).resolve().as_uri()):
            self.note(f"no browser was found: open {path} yourself")

    def tell_failure(self, error: GarkError, name: str, report: Report[Any]) -> int:
        """Reports why a run has no result, also to programs; returns the exit code."""
        from garkcli.report.remarks import FailedRun

        complain(error)
        if self.format in ("json", "csv"):
            self.tell(report, FailedRun(name, faults_of(error)))
        return failure_code(error)


def _chosen(format: str) -> str | None:
    source = click.get_current_context().get_parameter_source("format")
    is_said = source is not click.core.ParameterSource.DEFAULT
    return format if is_said and format != AUTO else None


def faults_of(error: GarkError) -> tuple[Remark, ...]:
    if isinstance(error, MethodFileError):
        return error.faults
    return (Remark(error.message, error.help, code=error.code),)


def failure_code(error: GarkError) -> int:
    """1 for a step, 2 for anything else."""
    from garkcli.stepping.integrator import StepFailed

    return 1 if isinstance(error, StepFailed) else 2
