"""Common parts of the commands: their construction from the table of calls, their arguments, and
the output.
"""

from __future__ import annotations

import inspect
import os
import sys
from collections.abc import Callable, Iterable, Mapping, Sequence
from functools import cache, partial
from importlib import import_module
from types import SimpleNamespace
from typing import TYPE_CHECKING, Any

import click

from garkcli.cli import arguments
from garkcli.cli.arguments import INPUT, PATH, completed, named, read_by
from garkcli.cli.endings import AUTO, settled
from garkcli.cli.streams import complain, put, put_exactly, safe_pieces, say, wants_colour
from garkcli.cli.table import COMMANDS, HIDDEN, Option, OptionRule, option_of, options_of, rules_of
from garkcli.doing import hush
from garkcli.errors import GarkError, MethodFileError, Remark, UsageProblem
from garkcli.files import STDIN, note_input

if TYPE_CHECKING:
    from garkcli.methodfile.build import MethodFile
    from garkcli.page.paint import Paint
    from garkcli.plots.scene import Scene
    from garkcli.tableau.garkmethod import GarkMethod
    from garkcli.tell.report import Report

CONTEXT = {
    "help_option_names": [],
    "max_content_width": 100,
    "token_normalize_func": arguments.spelled,
}
"""Settings of every command; ``-h`` and ``--help`` are an option of each."""
_FILE = {"type": arguments.MethodType(), "callback": arguments.with_notes}
ARGUMENTS: dict[str, dict[str, Any]] = {
    "FILE": _FILE,
    "FIRST": _FILE,
    "SECOND": _FILE,
    "ORDER": {"type": click.IntRange(1, 10_000), "name": "order_asked"},
    "PLACE": {"type": PATH, "name": "file", "metavar": "[FILE]"},
    "SPEC": {"type": INPUT},
    "SOURCE": {"type": INPUT},
    "PATH": {"type": INPUT},
}
"""The arguments of commands, by the words of the usage."""
METHOD = (
    "a method file, a name of the catalogue such as rk4, a family with its stages such as gauss-3, "
    "or - for standard input"
)
"""The description of one method on the command line."""
SEVERAL = (
    "a directory stands for all *.gark.yaml below it, a pattern (in quotes, ** for any "
    "directories) for the files that match"
)
"""The description of several methods."""
KINDS: dict[str, dict[str, Any]] = {
    "written": {"type": PATH},
    "picture": {"type": PATH, "callback": arguments.picture},
    "read": {"type": INPUT},
    "many": {"multiple": True},
    "pairs": {"multiple": True, "metavar": "NAME=VALUE", "callback": arguments.pairs},
    "folders": {
        "multiple": True,
        "metavar": "DIR",
        "type": click.Path(readable=False, file_okay=False),
        "is_eager": True,
        "expose_value": False,
        "callback": arguments.add_folders,
    },
    "problem": {"type": arguments.ProblemType()},
    "positive": {"callback": read_by(arguments.positive)},
    "positives": {"callback": read_by(arguments.positives)},
    "points": {"callback": read_by(arguments.point)},
    "ratios": {"callback": read_by(arguments.ratio)},
    "jobs": {"callback": arguments.workers},
    "two": {"nargs": 2, "metavar": "A B"},
    "square": {"callback": read_by(arguments.square)},
    "seconds": {"type": click.FloatRange(min=0, min_open=True), "callback": arguments.finite},
    "target": {"required": True, "shell_complete": completed("bridges.registry:bridges")},
    "report": {"shell_complete": completed("report.schemas:REPORTS")},
}
"""The types of values of options, by the words of the table."""
WORDS = {"forms": "cli.options:forms", "kinds": "ntrees.symplectic:KINDS"}
"""The places of the words that options accept."""


REDUCED = "reduced"
"""The value of ``--to`` for the smallest equivalent method, besides the forms."""


def forms() -> list[str]:
    from garkcli.conversion.targets import TARGETS

    return [*TARGETS, REDUCED]


def _show_help(context: click.Context, _: click.Parameter, wanted: bool) -> None:
    if wanted and not context.resilient_parsing:
        put(context.get_help() + "\n")
        context.exit()


def help_option() -> click.Option:
    """Returns the option that shows the help of its command."""
    return click.Option(
        ["-h", "--help"],
        is_flag=True,
        is_eager=True,
        expose_value=False,
        callback=_show_help,
        help="Show this message and exit.",
    )


class _Argument(click.Option):
    """An option for an argument of a function of the package.

    Its help and its default are those of the argument, looked up only for the help; if it is not
    given, it is not passed.
    """

    def __init__(self, flags: list[str], of: str, **settings: Any) -> None:
        self._of = of
        self._help: str | None = None
        self._has_default = "default" in settings or bool(settings.get("required"))
        super().__init__(flags, **settings)

    @property
    def help(self) -> str | None:
        """The text of the option, or the documentation of the argument."""
        return self._help or told(self._of)

    @help.setter
    def help(self, text: str | None) -> None:
        self._help = text

    def get_default(self, ctx: click.Context, call: bool = True) -> Any:
        """Returns the default of the argument for the help, unless the command has its own."""
        if self._has_default:
            return super().get_default(ctx, call)
        default = None if call else parameter_of(self._of).default
        # an empty text is not worth a word of help
        return None if default in (inspect.Parameter.empty, "") else default


def parameter_of(of: str) -> inspect.Parameter:
    """Returns the argument ``function.argument`` of the package."""
    function, _, name = of.partition(".")
    return inspect.signature(getattr(import_module("garkcli"), function)).parameters[name]


def told(of: str) -> str:
    """Returns the text about an argument in the docstring of a function."""
    function, _, name = of.partition(".")
    lines = iter((inspect.getdoc(getattr(import_module("garkcli"), function)) or "").splitlines())
    found = ""
    for line in lines:
        if found and not line.startswith("        "):
            break
        if found or line.startswith(f"    {name}: "):
            found = f"{found} {line.strip()}".strip()
    text = found.removeprefix(f"{name}: ").replace("``", "")
    return text[:1].upper() + text[1:]


_DECLARED: dict[str, Callable[[], click.Command]] = {}


def declared(
    name: str, formats: Sequence[str] = (), **more: Any
) -> Callable[[Callable[..., Any]], Callable[..., Any]]:
    """Makes the function the implementation of a command in the table of calls.

    It takes the arguments as ``Given`` and the ``Output``, and returns the exit code, or None for
    0. ``formats`` are those it writes, the first by default; ``more`` has settings of its
    arguments, and under ``options`` a function that makes further ones.
    """

    def declare(function: Callable[..., Any]) -> Callable[..., Any]:
        _DECLARED[name] = partial(_made, name, function, formats, more)
        return function

    return declare


@cache
def command_of(name: str) -> click.Command:
    """Returns the command of that name, from the file in the table."""
    import_module(f"garkcli.cli.{COMMANDS[name].file}")
    return _DECLARED[name]()


def _made(
    name: str, function: Callable[..., Any], formats: Sequence[str], more: Mapping[str, Any]
) -> click.Command:
    row = COMMANDS[name]
    own, shared = row.options.split(), row.common.split()
    if takes_methods(row.arguments):
        shared = ["--catalogue", *shared]
    further = more["options"]() if "options" in more else ()
    calls = {option.name: option.of for option in options_of(name) if option.of}
    rules = rules_of(name)

    def run(**values: Any) -> Any:
        output = Output.of(values, formats)
        if rules:
            told = {"format": output.format, "output": output.path}
            _check(rules, name, {**values, **told, "verbose": output.verbosity > 0})
        if name == "check" or not takes_methods(row.arguments):
            return function(Given(values, calls), output)
        from garkcli.methodfile.load import noting

        with noting() as read:
            code = function(Given(values, calls), output)
        hint_rounding(read, output)
        return code

    return click.Command(
        name,
        callback=run,
        params=[
            *(_argument(word, more) for word in row.arguments.split()),
            *(_option(option_of(name, flag), formats) for flag in own),
            *further,
            *(_option(option_of(name, flag), formats) for flag in shared if flag != "--help"),
            help_option(),
        ],
        help=_help(inspect.getdoc(function) or "", row.arguments),
        context_settings=CONTEXT,
        hidden=row.group == HIDDEN,
    )


def takes_methods(arguments: str) -> list[str]:
    """Returns the arguments of a command that stand for methods."""
    return [x for x in arguments.split() if ARGUMENTS.get(x.strip("[].")) is _FILE]


def hint_rounding(methods: Iterable[MethodFile], output: Output) -> None:
    """Notes methods whose coefficients look rounded, with the missing line.

    ``gark check`` has this in its report. It takes as long as a check and is skipped with -q.
    """
    if output.verbosity < 0:
        return
    from garkcli.check.analysis import looks_rounded

    several = len({method.source for method in methods}) > 1
    said = []
    for method in methods:
        found = looks_rounded(method)
        if found is not None:
            where = f"{method.source}: " if several else ""
            said.append(
                f"{where}hint: the coefficients look rounded; with the line  {found.line}  "
                f"order {found.order} holds"
            )
    for text in dict.fromkeys(said):
        output.note(text)


def _help(text: str, arguments: str) -> str:
    """Returns the help of a command, with a paragraph about its methods."""
    words = takes_methods(arguments)
    if not words:
        return text
    names = " and ".join(x.strip("[].") for x in words)
    meant = f"{names} {'is' if len(words) == 1 else 'are each'} {METHOD}"
    if "..." in arguments:
        meant += f"; {SEVERAL}"
    first, *rest = text.split("\n\n")
    return "\n\n".join([first, f"{meant}.", *rest])


def _check(rules: Iterable[OptionRule], command: str, values: Mapping[str, Any]) -> None:
    """Raises UsageProblem for options that exclude each other, before anything is read."""

    def is_given(word: str) -> bool:
        flag, _, wanted = word.partition("=")
        if not flag.startswith("-"):
            return values[ARGUMENTS[flag].get("name", flag.lower())] is not None
        row = option_of(command, flag)
        value = values[row.name]
        wanted = next((x[6:] for x in row.kind if x.startswith("value=")), wanted)
        if wanted:
            return bool(value == wanted)
        is_left_out = value is None or value == () or value == {}
        return not (is_left_out or (value is False and "/" not in row.written))

    for rule in rules:
        option = next(filter(is_given, rule.options), "").partition("=")[0]
        if option and any(map(is_given, rule.others)) is not rule.needs:
            raise UsageProblem(rule.message.replace("OPTION", option), rule.cure, code=rule.code)


def _argument(word: str, more: Mapping[str, Any]) -> click.Argument:
    """Returns an argument from its usage: [FILE...] stands for several that may be left out."""
    required, several = not word.startswith("["), word.endswith(("...", "...]"))
    bare = word.strip("[].")
    settings = {**ARGUMENTS.get(bare, {}), **more.get(bare, {})}
    name = settings.pop("name", f"{bare.lower()}s" if several else bare.lower())
    settings = {"required": required, "metavar": word, **settings}
    return click.Argument([name], nargs=-1 if several else 1, **settings)


def _option(row: Option, formats: Sequence[str]) -> click.Option:
    settings: dict[str, Any] = {"is_flag": True} if row.is_flag and "/" not in row.written else {}
    for word in row.kind:
        key, sign, value = word.partition("=")
        if word == "formats":
            settings |= {"type": click.Choice(formats), "default": formats[0]}
        elif word[0].isdigit():
            least, _, most = word.partition("..")
            settings["type"] = click.IntRange(int(least), int(most) if most else None)
        elif word in KINDS:
            settings |= KINDS[word]
        elif key == "words":
            settings["type"] = click.Choice(
                named(WORDS[value]) if value in WORDS else value.split(",")
            )
        elif key == "default":
            settings["default"] = value or None
        elif key == "value":
            settings["flag_value"] = value
        elif key == "holds":
            settings["callback"] = partial(_held, value)
        elif key == "alone":
            flag_value = int(value) if value.isdigit() else value
            settings |= {"is_flag": False, "flag_value": flag_value, "default": None}
        elif not sign:
            settings["metavar"] = word
    settings["help"] = row.help or None
    is_of_argument = bool(row.of) and "default" not in settings
    settings["show_default"] = is_of_argument or settings.get("default") is not None
    flags = [*row.flags, row.name]
    return _Argument(flags, row.of, **settings) if row.of else click.Option(flags, **settings)


def _held(
    format: str, _: click.Context, parameter: click.Parameter, path: str | None
) -> str | None:
    """Checks that the ending of a file fits its content."""
    if path is not None:
        settled(path, [format], option=max(parameter.opts, key=len))
    return path


class Given(SimpleNamespace):
    """The arguments and options of a command by their names.

    ``which`` is ``"conjugate"``, ``"pair"`` or None. ``calls`` has the functions and arguments of
    the package for the options.
    """

    def __init__(self, values: Mapping[str, Any], calls: Mapping[str, str]) -> None:
        super().__init__(**values)
        self._calls = calls
        self.which: Any = next((x for x in ("conjugate", "pair") if values.get(x)), None)

    def of(self, function: str) -> dict[str, Any]:
        """Returns the given options that are arguments of a function of the package, by their names
        there.
        """
        found = {}
        for name, of in self._calls.items():
            owner, _, argument = of.partition(".")
            value = getattr(self, name) if owner == function else None
            if value is not None and value is not False and value != ():
                found[argument] = value
        return found

    def method(self, file: str = "", is_any_kind: bool = False) -> GarkMethod:
        """Returns the method of FILE with the values of --set, or its conjugate or its pair.

        Raises MethodFileError if it is not a method, HasFreeParameters if a parameter has no value,
        ZeroWeight if a conjugate would divide by zero.
        """
        from garkcli.methodfile.load import load

        method: GarkMethod = load(file or self.file, self.settings)
        if not is_any_kind:
            method.tableau.demand_fields("this command")
        return getattr(method, self.which) if self.which else method

    def files_meant(self, output: Output) -> list[str]:
        """Returns the files that FILE... stands for, and protects them from being overwritten.

        Raises UsageProblem if the report would go to one of them, or if --set is given with
        several.
        """
        from garkcli.methodfile.naming import find_files

        found = list(find_files(self.files, output.note))
        for path in found:
            note_input(path)
        output.check_place()
        if len(found) > 1 and getattr(self, "settings", None):
            message = "--set is for one FILE"
            raise UsageProblem(message, "give the files one by one", code="options-clash")
        return found


class Output:
    """The place and the appearance of a report.

    ``path`` is the file of ``-o``, or None; ``verbosity`` −1, 0 or 1; ``is_streamed`` says that
    ``-o -`` was given, ``is_by_ending`` that the ending of the file determines the format. Raises
    UsageProblem, before any work, if the report cannot be written.
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
        is_wanted = color == "auto" and path is None and wants_colour(sys.stdout)
        self._has_colour = color == "always" or is_wanted
        if verbosity < 0:
            hush()
        self.check_place()

    @classmethod
    def of(cls, values: dict[str, Any], formats: Sequence[str] = ()) -> Output:
        """Returns the output for ``--format``, ``-o``, ``-q``, ``-v`` and ``--color``, which are
        removed from ``values``.

        ``formats`` are those that the command writes, empty if it checks the ending itself. Raises
        UsageProblem if the ending of the file belongs to another format.
        """
        verbosity = values.pop("verbose", False) - values.pop("quiet", False)
        format, path = values.pop("format", "text"), values.pop("output", None)
        is_streamed = path == STDIN
        path = None if is_streamed else path
        named = None
        if path is not None and formats:
            named = settled(path, formats, _chosen(format))
        output = cls(named or format, path, verbosity, values.pop("color", "never"))
        output.is_by_ending = named is not None
        output.is_streamed = is_streamed
        for note in arguments.notes():
            output.note(note)
        return output

    def check_place(self, path: str | None = None) -> None:
        """Raises UsageProblem if the report, or another file, cannot be written."""
        path = self.path if path is None else path
        if path is not None:
            from garkcli.page.writing import refuse_unwritable

            refuse_unwritable(path)

    @property
    def paint(self) -> Paint:
        """The colours and the encoding of the report."""
        from garkcli.page.paint import Paint

        encoding = None if self.path else getattr(sys.stdout, "encoding", None)
        return Paint(self._has_colour, encoding or "utf-8")

    @property
    def width(self) -> int:
        """The width of the terminal in columns, or 80."""
        from shutil import get_terminal_size

        return get_terminal_size((80, 24)).columns if self.path is None else 80

    def write(self, text: str | Iterable[str], format: str = "") -> None:
        """Writes the report; a file appears whole or not at all.

        ``format`` overrides that of ``--format``.
        """
        pieces = [text] if isinstance(text, str) else text
        format = format or self.format
        coloured = self._has_colour
        if self.path is None:
            for piece in pieces:
                put(piece, format, coloured)
            return
        self.save(self.path, safe_pieces(pieces, format, coloured))

    def write_exactly(self, text: str) -> None:
        """Writes a text with all its characters and line ends, such as a patch."""
        if self.path is None:
            put_exactly(text)
        else:
            self.save(self.path, [text.encode()])

    def save(self, path: str, pieces: Iterable[str | bytes]) -> None:
        """Writes a file, and notes it."""
        from garkcli.page.writing import write_whole

        if write_whole(path, pieces):
            self.note(f"wrote {path}")

    def tell(self, report: Report[Any], *wholes: Any) -> None:
        self.write(report.render(wholes, self.format, self.paint, self.verbosity, width=self.width))

    def stream(self, report: Report[Any], whole: Any, is_document: bool | None = None) -> None:
        """Writes a result while it is computed.

        ``is_document`` says whether LaTeX has its preamble or only names it; None for neither.
        """
        pieces = report.pieces(whole, self.format, self.paint, self.verbosity, width=self.width)
        if self.format == "latex" and is_document is not None:
            from garkcli.page.latex import fragment

            pieces = fragment(pieces, is_document)
        self.write(pieces)

    def suit(self) -> None:
        """Replaces the format ``auto`` by the one that suits the environment."""
        if self.format == "auto":
            is_job = os.environ.get("GITHUB_ACTIONS") == "true"
            self.format = "github" if is_job else "text"

    def note(self, text: str) -> None:
        """Writes a remark to stderr unless -q is given."""
        if self.verbosity >= 0:
            say(text)

    def save_plot(self, scene: Scene, path: str) -> None:
        from pathlib import Path

        from garkcli.plots.saving import save_scene

        save_scene(scene, Path(path))
        self.note(f"wrote {path}")

    def tell_failure(self, error: GarkError, name: str, report: Report[Any]) -> int:
        """Reports on stderr, and in reports for programs, why a run has no result; returns the exit
        code.
        """
        from garkcli.report.remarks import FailedRun

        complain(error)
        if self.format in ("json", "csv"):
            self.tell(report, FailedRun(name, faults_of(error)))
        return failure_code(error)


def _chosen(format: str) -> str | None:
    """Returns the format if the command line has one."""
    source = click.get_current_context().get_parameter_source("format")
    is_said = source is not click.core.ParameterSource.DEFAULT
    return format if is_said and format != AUTO else None


def faults_of(error: GarkError) -> tuple[Remark, ...]:
    if isinstance(error, MethodFileError):
        return error.faults
    return (Remark(error.message, error.help, code=error.code),)


def failure_code(error: GarkError) -> int:
    """Returns the exit code of a failed run: 1 for a step, 2 for anything else."""
    from garkcli.stepping.integrator import StepFailed

    return 1 if isinstance(error, StepFailed) else 2
