"""What the commands share: how they are made of the table of calls, what they are given, where the
report goes, whether it has colour.
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
from garkcli.cli.table import COMMANDS, HIDDEN, Option, Rule, option_of, options_of, rules_of
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
"""What commands take, by the words of their usage; the command gives the others."""
METHOD = (
    "a method file, a name of the catalogue such as rk4, a family with its stages such as gauss-3, "
    "or - for standard input"
)
"""Words for one method on the command line."""
SEVERAL = (
    "a directory stands for all *.gark.yaml below it, a pattern (in quotes, ** for any "
    "directories) for the files that match"
)
"""Words for several methods."""
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
"""What values of options are, by the words of the table."""
WORDS = {"forms": "cli.options:forms", "kinds": "ntrees.symplectic:KINDS"}
"""Where the words are that an option takes one of."""


REDUCED = "reduced"
"""What ``--to`` takes besides the forms: the smallest method that does the same."""


def forms() -> list[str]:
    """What ``gark convert --to`` takes."""
    from garkcli.conversion.targets import TARGETS

    return [*TARGETS, REDUCED]


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
    """An option that is an argument of a function of the package. Its help and its default are
    those of the argument, looked up for the help alone: where it is not given, it is not handed
    over.
    """

    def __init__(self, flags: list[str], of: str, **settings: Any) -> None:
        self._of = of
        self._help: str | None = None
        self._has_default = "default" in settings or bool(settings.get("required"))
        super().__init__(flags, **settings)

    @property
    def help(self) -> str | None:
        """What the option says itself, or the documentation of the argument."""
        return self._help or told(self._of)

    @help.setter
    def help(self, text: str | None) -> None:
        self._help = text

    def get_default(self, ctx: click.Context, call: bool = True) -> Any:
        """For the help that of the argument, unless the command has its own."""
        if self._has_default:
            return super().get_default(ctx, call)
        default = None if call else parameter_of(self._of).default
        # an empty text is not worth a word of help
        return None if default in (inspect.Parameter.empty, "") else default


def parameter_of(of: str) -> inspect.Parameter:
    """The argument that is called ``function.argument`` in the package."""
    function, _, name = of.partition(".")
    return inspect.signature(getattr(import_module("garkcli"), function)).parameters[name]


def told(of: str) -> str:
    """What the docstring of a function says of an argument."""
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
    """The function is what the command of that name in the table of calls does.

    It takes what the command is ``Given`` and its ``Output``, and returns the exit code, or nothing
    where all is well.

    Args:
        name: of the command.
        formats: that it writes, the first one by default.
        more: settings of its arguments that it knows itself; ``options``, a function that makes
            further ones.
    """

    def declare(function: Callable[..., Any]) -> Callable[..., Any]:
        _DECLARED[name] = partial(_made, name, function, formats, more)
        return function

    return declare


@cache
def command_of(name: str) -> click.Command:
    """The command of that name, from the file that the table says."""
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
    """The arguments of a command that stand for methods."""
    return [x for x in arguments.split() if ARGUMENTS.get(x.strip("[].")) is _FILE]


def hint_rounding(methods: Iterable[MethodFile], output: Output) -> None:
    """Say of which methods the coefficients look rounded, with the line that is missing; check has
    it in its report. To find them takes as long as a check: with -q nobody reads them.
    """
    if output.verbosity < 0:
        return
    from garkcli.check.deciding import looks_rounded

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
    """The help of a command; a paragraph of it says what stands for a method."""
    words = takes_methods(arguments)
    if not words:
        return text
    names = " and ".join(x.strip("[].") for x in words)
    meant = f"{names} {'is' if len(words) == 1 else 'are each'} {METHOD}"
    if "..." in arguments:
        meant += f"; {SEVERAL}"
    first, *rest = text.split("\n\n")
    return "\n\n".join([first, f"{meant}.", *rest])


def _check(rules: Iterable[Rule], command: str, values: Mapping[str, Any]) -> None:
    """Refuse options that do not go together, before anything is read.

    Raises:
        UsageProblem: some do not.
    """

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
    """An argument as it is in the usage: [FILE...] for several that may be left out."""
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
    """A file to be written whose ending says nothing else than what it holds."""
    if path is not None:
        settled(path, [format], option=max(parameter.opts, key=len))
    return path


class Given(SimpleNamespace):
    """What a command is given: its arguments and options by their names.

    ``which`` is ``"conjugate"`` or ``"pair"`` where one of these is meant, else None.

    Args:
        values: by their names.
        calls: the functions and arguments of the package that options are, by the same names.
    """

    def __init__(self, values: Mapping[str, Any], calls: Mapping[str, str]) -> None:
        super().__init__(**values)
        self._calls = calls
        self.which: Any = next((x for x in ("conjugate", "pair") if values.get(x)), None)

    def of(self, function: str) -> dict[str, Any]:
        """The options that are given and are arguments of a function of the package, by their
        names there.
        """
        found = {}
        for name, of in self._calls.items():
            owner, _, argument = of.partition(".")
            value = getattr(self, name) if owner == function else None
            if value is not None and value is not False and value != ():
                found[argument] = value
        return found

    def method(self, file: str = "", is_any_kind: bool = False) -> GarkMethod:
        """The method of FILE with the values of --set, or its conjugate or its pair.

        Args:
            file: another one.
            is_any_kind: whether it may be another than a GARK method.

        Raises:
            MethodFileError: it is none.
            HasFreeParameters: a parameter has no value.
            ZeroWeight: a conjugate would divide by zero.
        """
        from garkcli.methodfile.load import load

        method: GarkMethod = load(file or self.file, self.settings)
        if not is_any_kind:
            method.tableau.demand_fields("this command")
        return getattr(method, self.which) if self.which else method

    def files_meant(self, output: Output) -> list[str]:
        """The files that FILE... means: folders and patterns are searched, and none of the files
        is written over.

        Raises:
            UsageProblem: the report is to go to one of them, or --set is given with several.
        """
        from garkcli.methodfile.finding import find_files

        found = list(find_files(self.files, output.note))
        for path in found:
            note_input(path)
        output.check_place()
        if len(found) > 1 and getattr(self, "settings", None):
            message = "--set is for one FILE"
            raise UsageProblem(message, "give the files one by one", code="options-clash")
        return found


class Output:
    """Where a report goes and how it may look.

    Attributes:
        format: the chosen format.
        path: the file of ``-o``, or None.
        verbosity: −1, 0 or 1.
        is_streamed: whether ``-o -`` asks for standard output.
        is_by_ending: whether the ending of the file says the format.

    Raises:
        UsageProblem: the report will have no place; said before any work is done.
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
        """What ``--format``, ``-o``, ``-q``, ``-v`` and ``--color`` say, taken out of the values of
        options.

        Args:
            values: by their names.
            formats: that the command writes; empty where the ending of the file is its own matter.

        Raises:
            UsageProblem: the ending of the file is that of something else.
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
        """Look whether the report, or another file, may be written where it is to go.

        Raises:
            UsageProblem: it may not.
        """
        path = self.path if path is None else path
        if path is not None:
            from garkcli.page.writing import refuse_unwritable

            refuse_unwritable(path)

    @property
    def paint(self) -> Paint:
        """Colour, where it is wanted, and the encoding of where the report goes."""
        from garkcli.page.paint import Paint

        encoding = None if self.path else getattr(sys.stdout, "encoding", None)
        return Paint(self._has_colour, encoding or "utf-8")

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
        coloured = self._has_colour
        if self.path is None:
            for piece in pieces:
                put(piece, format, coloured)
            return
        self.save(self.path, safe_pieces(pieces, format, coloured))

    def write_exactly(self, text: str) -> None:
        """Write a text that has to keep every sign and line end, such as a patch."""
        if self.path is None:
            put_exactly(text)
        else:
            self.save(self.path, [text.encode()])

    def save(self, path: str, pieces: Iterable[str | bytes]) -> None:
        """Write a file, and say so where it is one."""
        from garkcli.page.writing import write_whole

        if write_whole(path, pieces):
            self.note(f"wrote {path}")

    def tell(self, report: Report[Any], *wholes: Any) -> None:
        """Write results in the format that is requested."""
        self.write(report.render(wholes, self.format, self.paint, self.verbosity, width=self.width))

    def stream(self, report: Report[Any], whole: Any, is_document: bool | None = None) -> None:
        """Write a result while it is found.

        Args:
            report: its rows.
            whole: the result.
            is_document: whether LaTeX has its preamble, or names it; None for neither.
        """
        pieces = report.pieces(whole, self.format, self.paint, self.verbosity, width=self.width)
        if self.format == "latex" and is_document is not None:
            from garkcli.page.latex import fragment

            pieces = fragment(pieces, is_document)
        self.write(pieces)

    def suit(self) -> None:
        """Take for the format ``auto`` the one that suits where the command runs."""
        if self.format == "auto":
            is_job = os.environ.get("GITHUB_ACTIONS") == "true"
            self.format = "github" if is_job else "text"

    def note(self, text: str) -> None:
        """A remark beside the report, on stderr."""
        if self.verbosity >= 0:
            say(text)

    def save_plot(self, scene: Scene, path: str) -> None:
        """Draw the scene into a file, and say so."""
        from pathlib import Path

        from garkcli.plots.saving import save_scene

        save_scene(scene, Path(path))
        self.note(f"wrote {path}")

    def tell_failure(self, error: GarkError, name: str, report: Report[Any]) -> int:
        """Tell people why a run has no result, and programs in the report; and return the exit
        code.

        Args:
            error: what has failed.
            name: of the method.
            report: of the command.
        """
        from garkcli.report.remarks import FailedRun

        complain(error)
        if self.format in ("json", "csv"):
            self.tell(report, FailedRun(name, faults_of(error)))
        return failure_code(error)


def _chosen(format: str) -> str | None:
    """The format, where the command line says one."""
    source = click.get_current_context().get_parameter_source("format")
    is_said = source is not click.core.ParameterSource.DEFAULT
    return format if is_said and format != AUTO else None


def faults_of(error: GarkError) -> tuple[Remark, ...]:
    """What is wrong: the faults of a file, or one fault."""
    if isinstance(error, MethodFileError):
        return error.faults
    return (Remark(error.message, error.help, code=error.code),)


def failure_code(error: GarkError) -> int:
    """The exit code of a run that has failed: of a step 1, of everything else 2."""
    from garkcli.stepping.integrator import StepFailed

    return 1 if isinstance(error, StepFailed) else 2
