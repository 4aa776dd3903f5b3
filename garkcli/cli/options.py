"""What the commands share: how they are made of the table of calls, where the report goes, whether
it has colour.
"""

from __future__ import annotations

import inspect
import sys
from collections.abc import Callable, Iterable, Mapping, Sequence, Sized
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from garkcli.cli.method_argument import INPUT, METHOD, notes, with_notes
from garkcli.cli.streams import put, safe_pieces, say, wants_colour
from garkcli.cli.table import COMMANDS, OPTIONS, PATH, Option
from garkcli.doing import hush
from garkcli.errors import UsageProblem
from garkcli.files import note_input
from garkcli.page.paint import Paint

if TYPE_CHECKING:
    from garkcli.plots.scene import Scene
    from garkcli.tell.report import Report

CONTEXT = {"help_option_names": [], "max_content_width": 100}
"""Settings of every command; ``-h`` and ``--help`` are an option of each."""


def _show_help(context: click.Context, _: click.Parameter, wanted: bool) -> None:
    if wanted and not context.resilient_parsing:
        put(context.get_help() + "\n")
        context.exit()


def help_option() -> click.Option:
    """The option that shows the help of its command."""
    return click.Option(
        ["-h", "--help"],
        is_flag=True,
        is_eager=True,
        expose_value=False,
        callback=_show_help,
        help="Show this message and exit.",
    )


class _Argument(click.Option):
    """An option that is an argument of a function of the package: its help and its default are
    those of the argument, and looked up when they are needed.
    """

    def __init__(self, flags: list[str], of: str, **settings: Any) -> None:
        self._of = of
        self._help: str | None = None
        self._has_default = "default" in settings
        if settings.get("required"):
            self._has_default = True
        super().__init__(flags, **settings)
        if not self._has_default:
            self.show_default = True

    @property
    def help(self) -> str | None:
        """What the option says itself, or the documentation of the argument."""
        return self._help or told(self._of)

    @help.setter
    def help(self, text: str | None) -> None:
        self._help = text

    def get_default(self, ctx: click.Context, call: bool = True) -> Any:
        """That of the argument, unless the command has its own."""
        if self._has_default:
            return super().get_default(ctx, call)
        default = parameter_of(self._of).default
        # an empty text is not worth a word of help
        is_none = default is inspect.Parameter.empty or (default == "" and not call)
        return None if is_none else default


def parameter_of(of: str) -> inspect.Parameter:
    """The argument that is called ``function.argument`` in the package."""
    import garkcli

    function, _, name = of.partition(".")
    return inspect.signature(getattr(garkcli, function)).parameters[name]


def told(of: str) -> str:
    """What the docstring of a function says of an argument."""
    import garkcli

    function, _, name = of.partition(".")
    lines = iter((inspect.getdoc(getattr(garkcli, function)) or "").splitlines())
    found = ""
    for line in lines:
        if found and not line.startswith("        "):
            break
        if found or line.startswith(f"    {name}: "):
            found = f"{found} {line.strip()}".strip()
    text = found.removeprefix(f"{name}: ").replace("``", "")
    return text[:1].upper() + text[1:]


ARGUMENTS: dict[str, dict[str, Any]] = {
    "FILE": {"type": METHOD, "callback": with_notes},
    "FIRST": {"type": METHOD, "callback": with_notes},
    "SECOND": {"type": METHOD, "callback": with_notes},
    "PLACE": {"type": PATH, "name": "file", "metavar": "[FILE]"},
    "SPEC": {"type": INPUT},
    "SOURCE": {"type": INPUT},
    "PATH": {"type": INPUT},
}
"""What commands take, by the words of their usage; what is not here is given by the command."""


def declared(name: str, formats: Sequence[str] = (), **more: Any) -> Callable[..., click.Command]:
    """The command that the table of calls has by that name.

    ``--format``, ``-o``, ``-q``, ``-v`` and ``--color`` arrive as one ``Output``, ``--conjugate``
    and ``--pair`` as ``which``.

    Args:
        name: of the command.
        formats: that it writes, the first one by default.
        more: settings of its arguments that it knows itself; ``options``, those that are made.
    """
    row = COMMANDS[name]

    def decorate(function: Callable[..., Any]) -> click.Command:
        own = row.options.split()
        common = row.common.split()
        run = function
        if "--conjugate" in own and name != "design":
            run = _with_companion(run)
        if "--format" in common and "--verbose" in common and name != "import":
            run = _with_output(run)
        arguments = [_argument(word, more) for word in row.arguments.split()]
        if "FILE" in row.arguments or "FIRST" in row.arguments:
            common.insert(0, "--catalogue")
        options = [_option(name, flag, formats) for flag in own]
        shared = [help_option() if x == "--help" else _option(name, x, formats) for x in common]
        return click.Command(
            name,
            callback=run,
            params=[*arguments, *options, *more.get("options", ()), *shared],
            help=inspect.getdoc(function),
            context_settings=CONTEXT,
        )

    return decorate


def _argument(word: str, more: Mapping[str, Any]) -> click.Argument:
    """An argument as it stands in the usage: [FILE...] for several that may be left out."""
    required, several = not word.startswith("["), word.endswith(("...", "...]"))
    bare = word.strip("[].")
    settings = {**ARGUMENTS.get(bare, {}), **more.get(bare, {})}
    name = settings.pop("name", f"{bare.lower()}s" if several else bare.lower())
    settings = {"required": required, "metavar": word, **settings}
    return click.Argument([name], nargs=-1 if several else 1, **settings)


def _option(command: str, flag: str, formats: Sequence[str]) -> click.Option:
    row: Option = OPTIONS.get(f"{command} {flag}") or OPTIONS[flag]
    settings = dict(row.settings or {})
    if flag == "--format":
        settings |= {"type": click.Choice(formats), "default": formats[0]}
    if flag in {"--format", "--color"}:
        settings["show_default"] = True
    if "choices" in settings:
        settings["type"] = click.Choice(settings.pop("choices")())
    flags = [*row.flags, settings.pop("name")] if "name" in settings else row.flags
    if row.of:
        return _Argument(flags, row.of, help=row.help or None, **settings)
    return click.Option(flags, help=row.help or None, **settings)


def _with_companion(function: Callable[..., Any]) -> Callable[..., Any]:
    """``--conjugate`` and ``--pair`` as ``which``, None for the method itself."""

    def run(is_conjugate: bool, is_pair: bool, **rest: Any) -> Any:
        if is_conjugate and is_pair:
            raise UsageProblem(
                "--pair and --conjugate are two methods", "ask for one", code="options-clash"
            )
        which = "conjugate" if is_conjugate else "pair" if is_pair else None
        return function(which=which, **rest)

    return run


def _with_output(function: Callable[..., Any]) -> Callable[..., Any]:
    """Where the report goes and how it looks as one ``Output``."""

    def run(
        format: str, output: str | None, quiet: bool, verbose: bool, color: str, **rest: Any
    ) -> Any:
        chosen = Output(format, output, verbose - quiet, color)
        for note in notes():
            chosen.note(note)
        return function(output=chosen, **rest)

    return run


def refuse_settings_of_several(settings: Mapping[str, str], paths: Sized) -> None:
    """``--set`` is about the parameters of one file.

    Raises:
        UsageProblem: it is given with several.
    """
    if settings and len(paths) > 1:
        raise UsageProblem(
            "--set is for one FILE", "give the files one by one", code="options-clash"
        )


def check_document(is_document: bool, format: str) -> None:
    """Refuse ``--document`` where no LaTeX is written.

    Raises:
        UsageProblem: it would change nothing.
    """
    if is_document and format != "latex":
        message = "--document goes with --format latex"
        raise UsageProblem(message, "add --format latex", code="option-alone")


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


def check_plot(path: str | None) -> None:
    """Refuse a picture of another kind, before the work.

    Raises:
        UsageProblem: its suffix is none of those that can be drawn.
    """
    if path is not None:
        from garkcli.plots.saving import check_suffix

        check_suffix(Path(path))


def save_plot(scene: Scene, path: str, output: Output) -> None:
    """Draw the scene into a file, and say so."""
    from garkcli.plots.saving import save_scene

    save_scene(scene, Path(path))
    output.note(f"wrote {path}")
