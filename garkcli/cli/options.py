"""What the commands share: options, where the report goes, whether it has colour."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterable, Mapping, Sequence, Sized
from typing import TYPE_CHECKING, Any, TypeVar

import click

from garkcli.cli.method_argument import notes
from garkcli.cli.streams import put, safe_pieces, say, wants_colour
from garkcli.doing import hush
from garkcli.errors import UsageProblem
from garkcli.files import note_input
from garkcli.page.paint import Paint

if TYPE_CHECKING:
    from garkcli.tell.report import Report

F = TypeVar("F", bound=Callable[..., Any])
CONTEXT = {"help_option_names": [], "max_content_width": 100}
"""Settings of every command; ``-h`` and ``--help`` are options of ``common``."""
PATH = click.Path(readable=False)
"""The type of options that are places to write to; ``INPUT`` is that of files that are read."""


def _show_help(context: click.Context, _: click.Parameter, wanted: bool) -> None:
    if wanted and not context.resilient_parsing:
        put(context.get_help() + "\n")
        context.exit()


help_option: Callable[[F], F] = click.option(
    "-h",
    "--help",
    is_flag=True,
    is_eager=True,
    expose_value=False,
    callback=_show_help,
    help="Show this message and exit.",
)
"""The option that shows the help of its command."""


def digits_option(help: str, default: int | None = None) -> Callable[[F], F]:
    """``--digits``; without a default the command shows numbers exactly unless it is given."""
    return click.option(
        "--digits",
        type=click.IntRange(1, 1000),
        default=default,
        show_default=default is not None,
        metavar="N",
        help=help,
    )


def _settings(
    context: click.Context, parameter: click.Parameter, given: tuple[str, ...]
) -> dict[str, str]:
    """``NAME=VALUE`` of ``--set``, each name once."""
    settings: dict[str, str] = {}
    for text in given:
        name, sign, value = text.partition("=")
        if not sign or not name.strip() or not value.strip():
            raise click.BadParameter(f"{text!r} is not NAME=VALUE", context, parameter)
        if name.strip() in settings:
            raise click.BadParameter(f"{name.strip()!r} is given twice", context, parameter)
        settings[name.strip()] = value.strip()
    return settings


choices_option: Callable[[F], F] = click.option(
    "--choose",
    "choices",
    multiple=True,
    metavar="NAME=VALUE",
    callback=_settings,
    help="As --set, and say what each choice leaves; repeatable.",
)
"""``--choose``; it arrives as a mapping."""


def settings_named(help: str) -> Callable[[F], F]:
    """``--set``, with what it is for; it arrives as a mapping."""
    return click.option(
        "--set", "settings", multiple=True, metavar="NAME=VALUE", callback=_settings, help=help
    )


settings_option: Callable[[F], F] = settings_named(
    "A value for a parameter of FILE, in place of the one in it."
)
"""``--set``; it arrives as a mapping."""


def refuse_settings_of_several(settings: Mapping[str, str], paths: Sized) -> None:
    """``--set`` is about the parameters of one file.

    Raises:
        UsageProblem: it is given with several.
    """
    if settings and len(paths) > 1:
        raise UsageProblem("--set is for one FILE", "give the files one by one")


document_option: Callable[[F], F] = click.option(
    "--document", is_flag=True, help="With --format latex: a document that compiles as it stands."
)
"""The option of commands that write LaTeX."""


def check_document(is_document: bool, format: str) -> None:
    """Refuse ``--document`` where no LaTeX is written.

    Raises:
        UsageProblem: it would change nothing.
    """
    if is_document and format != "latex":
        message = "--document goes with --format latex"
        raise UsageProblem(message, "add --format latex")


def common(formats: Sequence[str]) -> Callable[[F], F]:
    """``--format``, ``-o``, ``-q``, ``-v``, ``--color``; they arrive as one ``Output``."""

    def decorate(function: F) -> F:
        def run(
            format: str, output: str | None, quiet: bool, verbose: bool, color: str, **rest: Any
        ) -> Any:
            verbosity = verbose - quiet
            chosen = Output(format, output, verbosity, color)
            for note in notes():
                chosen.note(note)
            return function(output=chosen, **rest)

        decorated = wrapping(function, run)
        for option in reversed(_common_options(formats)):
            decorated = option(decorated)
        return decorated

    return decorate


def wrapping(function: F, run: Callable[..., Any]) -> F:
    """``run`` in the place of ``function``, with its name, its help and its options."""
    made: Any = run
    made.__doc__ = function.__doc__
    made.__name__ = function.__name__
    made.__click_params__ = getattr(function, "__click_params__", [])
    return made  # type: ignore[no-any-return]


def _common_options(formats: Sequence[str]) -> list[Callable[[Any], Any]]:
    """The options of every command that writes a report, in the order of the help."""
    return [
        click.option("--format", type=click.Choice(formats), default=formats[0], show_default=True),
        click.option("-o", "--output", type=PATH, metavar="FILE", help="Write the report to FILE."),
        click.option("-q", "--quiet", is_flag=True, help="Say less."),
        click.option("-v", "--verbose", is_flag=True, help="Say more."),
        click.option(
            "--color",
            type=click.Choice(["auto", "always", "never"]),
            default="auto",
            show_default=True,
        ),
        help_option,
    ]


class Output:
    """Where a report goes and how it may look.

    Attributes:
        format: the chosen format.
        path: the file of ``-o``, or None.
        verbosity: −1, 0 or 1.

    Raises:
        UsageProblem: the report will have no place; said before any work is done.
    """

    def __init__(self, format: str, path: str | None, verbosity: int, color: str) -> None:
        self.format = format
        self.path = path
        self.verbosity = verbosity
        self._color = color
        if verbosity < 0:
            hush()
        self.check_place()

    def check_place(self) -> None:
        """Look whether the report may be written where it is to go.

        Raises:
            UsageProblem: it may not.
        """
        if self.path is not None:
            from garkcli.page.writing import refuse_unwritable

            refuse_unwritable(self.path)

    @property
    def paint(self) -> Paint:
        """Colour, where it is asked for or the report goes to a terminal."""
        if self._color != "auto":
            return Paint(self._color == "always")
        return Paint(self.path is None and wants_colour(sys.stdout))

    @property
    def width(self) -> int:
        """Columns to fill: the terminal's; 80 without one."""
        from shutil import get_terminal_size

        return get_terminal_size((80, 24)).columns if self.path is None else 80

    def write(self, text: str | Iterable[str], format: str = "") -> None:
        """Write the report; a file appears whole or not at all.

        Args:
            text: the report, or its pieces.
            format: where it is not that of ``--format``.
        """
        pieces = [text] if isinstance(text, str) else text
        format = format or self.format
        coloured = self.paint.color
        if self.path is None:
            for piece in pieces:
                put(piece, format, coloured)
            return
        from garkcli.page.writing import write_whole

        write_whole(self.path, safe_pieces(pieces, format, coloured))

    def tell(self, report: Report[Any], wholes: Sequence[Any], **signs: Any) -> None:
        """Write results in the format that is asked for."""
        signs["width"] = self.width
        self.write(report.render(wholes, self.format, self.paint, self.verbosity, **signs))

    def note(self, text: str) -> None:
        """A remark beside the report, on stderr."""
        if self.verbosity >= 0:
            say(text)


def files_meant(arguments: Sequence[str], output: Output) -> list[str]:
    """The files that FILE... means: folders and patterns are looked into, and none of the files is
    written over.

    Raises:
        UsageProblem: the report is to go to one of them.
    """
    from garkcli.methodfile.finding import find_files

    paths = list(find_files(arguments, output.note))
    for path in paths:
        note_input(path)
    output.check_place()
    return paths
