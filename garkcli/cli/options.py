"""Declarations of options and arguments: click, help, pages and Python calls are made of them.

The options of a command are the fields of a class. Their values in the class are :class:`Option`,
which mypy takes for values of the type that the kind of the option reads::

    class Check(Options):
        max_order: int | None = option("--max-order", number("N", 1, 400), of="check_file.limit")
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import partial
from typing import TYPE_CHECKING, Any, ClassVar, Generic, TypeVar, cast

import click

from garkcli.cli import arguments
from garkcli.cli.endings import settled
from garkcli.errors import UsageProblem
from garkcli.frozen import Frozen, fields, replace

if TYPE_CHECKING:
    from garkcli.tableau.garkmethod import Derivation, GarkMethod

T = TypeVar("T")
Word = TypeVar("Word", bound=str)


class Kind(Frozen, Generic[T]):
    """``choices`` is the place of accepted words, ``holds`` the format of a written file."""

    settings: Mapping[str, Any]
    choices: str = ""
    holds: str = ""


class Option(Frozen):
    """``flags`` are as on the command line, of an argument its word in the usage; ``of`` is an
    argument of a function, whose docstring replaces ``help``; ``heading`` begins a group in the
    help.
    """

    flags: tuple[str, ...]
    kind: Kind[Any]
    of: str = ""
    help: str = ""
    heading: str = ""
    is_former: bool = False

    @property
    def is_argument(self) -> bool:
        return not self.flags[0].startswith("-")

    @property
    def key(self) -> str:
        """The long flag, or the word of an argument without brackets and dots."""
        if self.is_argument:
            return self.flags[0].strip("[].")
        return next(x for x in self.flags if x.startswith("--")).partition("/")[0]

    @property
    def is_flag(self) -> bool:
        return bool(self.kind.settings.get("is_flag"))

    def is_given(self, value: object) -> bool:
        return value not in (None, (), {}) and not (value is False and self.is_flag)


class Bundle(Frozen):
    make: Callable[[], list[click.Option]]


class Value(Frozen):
    option: Option
    value: object


class Rule(Frozen):
    """The given one of ``options`` needs one of the others if ``needs``, else excludes them all; it
    is OPTION in the message. The effective format counts for ``--format``, a file for ``--output``.
    """

    options: tuple[Option | Value, ...]
    needs: bool
    others: tuple[Option | Value, ...]
    message: str
    cure: str

    @property
    def code(self) -> str:
        return "option-alone" if self.needs else "options-clash"

    def check(self, value_of: Callable[[Option], object]) -> None:
        def is_given(each: Option | Value) -> bool:
            if isinstance(each, Value):
                return value_of(each.option) == each.value
            return each.is_given(value_of(each))

        first = next(filter(is_given, self.options), None)
        if first is not None and any(map(is_given, self.others)) is not self.needs:
            key = first.option.key if isinstance(first, Value) else first.key
            raise UsageProblem(self.message.replace("OPTION", key), self.cure, code=self.code)


def needs(given: object, others: object, message: str, cure: str) -> Rule:
    """An option, or each of several, needs another, or one of others."""
    return Rule(_options(given), True, _options(others), message, cure)


def excludes(given: object, others: object, message: str, cure: str) -> Rule:
    return Rule(_options(given), False, _options(others), message, cure)


def being(given: object, value: object) -> Value:
    first = given[0] if isinstance(given, tuple) else given
    return Value(cast("Option", first), value)


def _options(given: object) -> tuple[Option | Value, ...]:
    return given if isinstance(given, tuple) else (cast("Option", given),)


def option(
    flags: str,
    kind: Kind[T],
    help: str = "",
    *,
    of: str = "",
    heading: str = "",
    is_former: bool = False,
) -> T | None:
    """The value is None unless the option is given."""
    return cast("T", Option(tuple(flags.split()), kind, of, help, heading, is_former))


def preset(
    flags: str, kind: Kind[T], default: T, help: str = "", *, of: str = "", heading: str = ""
) -> T:
    """The default is that of the command, not of the Python argument."""
    return cast("T", option(flags, _with(kind, default=default), help, of=of, heading=heading))


def always(flags: str, kind: Kind[T], help: str = "", *, heading: str = "") -> T:
    """The kind has a value if the option is not given."""
    return cast("T", option(flags, kind, help, heading=heading))


def required(flags: str, kind: Kind[T], help: str = "", *, of: str = "", heading: str = "") -> T:
    return cast("T", option(flags, _with(kind, required=True), help, of=of, heading=heading))


def repeated(
    flags: str, kind: Kind[T], help: str = "", *, of: str = "", heading: str = ""
) -> tuple[T, ...]:
    declared: object = option(flags, _with(kind, multiple=True), help, of=of, heading=heading)
    return cast("tuple[T, ...]", declared)


def flag(flags: str, help: str = "", *, of: str = "", heading: str = "") -> bool:
    kind: Kind[bool] = Kind({"is_flag": True})
    return cast("bool", option(flags, kind, help, of=of, heading=heading))


def switch(flags: str, help: str = "", *, of: str = "") -> bool | None:
    """``--yes/--no``, None unless one is given."""
    kind: Kind[bool] = Kind({} if of else {"default": None})
    return option(flags, kind, help, of=of)


def flag_of(word: Word, help: str, of: str) -> Word | None:
    """A flag that stands for a word; ``either`` makes one field of several."""
    kind: Kind[Word] = Kind({"is_flag": True, "flag_value": word, "default": None})
    return option(f"--{word}", kind, help, of=of)


def either(first: T, *others: T, heading: str) -> T:
    return cast("T", (replace(cast("Option", first), heading=heading), *others))


def bundle(make: Callable[[], list[click.Option]]) -> Mapping[str, Any]:
    """The function makes the options when the command is made."""
    return cast("Mapping[str, Any]", Bundle(make))


def argument(written: str, kind: Kind[T]) -> T:
    return cast("T", option(written, _with(kind, required=True)))


def maybe_argument(written: str, kind: Kind[T]) -> T | None:
    return option(f"[{written}]", _with(kind, required=False))


def arguments_of(written: str, kind: Kind[T]) -> tuple[T, ...]:
    is_needed = not written.startswith("[")
    declared: object = option(written, _with(kind, required=is_needed, nargs=-1))
    return cast("tuple[T, ...]", declared)


def _with(kind: Kind[Any], **settings: Any) -> Kind[Any]:
    return Kind({**kind.settings, **settings}, kind.choices, kind.holds)


def number(metavar: str, least: int, most: int | None = None) -> Kind[int]:
    return Kind({"metavar": metavar, "type": click.IntRange(least, most)})


def text(metavar: str) -> Kind[str]:
    return Kind({"metavar": metavar})


def words(*choices: Word) -> Kind[Word]:
    return Kind({"type": click.Choice(choices)})


def words_of(place: str, metavar: str | None = None) -> Kind[Any]:
    """The words are looked up when the command is made."""
    return Kind({} if metavar is None else {"metavar": metavar}, place)


def completed(metavar: str, place: str) -> Kind[str]:
    """The shell completes texts with the words of a list."""
    return Kind({"metavar": metavar, "shell_complete": arguments.completed(place)})


def read(metavar: str, reader: Callable[[str, str], T]) -> Kind[T]:
    """A function makes the value of the option and its text."""
    return Kind({"metavar": metavar, "callback": arguments.read_by(reader)})


def file(holds: str = "", metavar: str = "FILE") -> Kind[str]:
    """A file that the command writes, in one format if ``holds`` says so."""
    settings: dict[str, Any] = {"metavar": metavar, "type": arguments.PATH}
    if holds:
        settings["callback"] = partial(_fitting_path, holds)
    return Kind(settings, holds=holds)


def _fitting_path(
    format: str, _: click.Context, parameter: click.Parameter, path: str | None
) -> str | None:
    """Checks that the ending of a file fits its content."""
    if path is not None:
        settled(path, [format], option=max(parameter.opts, key=len))
    return path


def workers(most: int) -> Kind[int]:
    return Kind({**number("N", 0, most).settings, "callback": arguments.workers})


def hidden_default(kind: Kind[T]) -> Kind[T]:
    return _with(kind, default=None)


def alone(kind: Kind[T], value: T) -> Kind[T]:
    return _with(kind, is_flag=False, flag_value=value, default=None)


def input_file(metavar: str = "FILE") -> Kind[str]:
    return Kind({"metavar": metavar, "type": arguments.INPUT})


FILE: Kind[str] = Kind({"type": arguments.PATH})
INPUT: Kind[str] = Kind({"type": arguments.INPUT})
METHOD: Kind[str] = Kind({"type": arguments.MethodType(), "callback": arguments.with_notes})
PROBLEM: Kind[str] = Kind({"type": arguments.ProblemType()})
SETTINGS: Kind[Mapping[str, str]] = Kind(
    {"multiple": True, "metavar": "NAME=VALUE", "callback": arguments.pairs}
)
SECONDS: Kind[float] = Kind(
    {"metavar": "T", "type": click.FloatRange(min=0, min_open=True), "callback": arguments.finite}
)
TWO: Kind[tuple[str, str]] = Kind({"nargs": 2, "metavar": "A B"})
FOLDER: Kind[str] = Kind(
    {
        "multiple": True,
        "metavar": "DIR",
        "type": click.Path(readable=False, file_okay=False),
        "is_eager": True,
        "expose_value": False,
        "callback": arguments.add_folders,
    }
)
PICTURE: Kind[str] = Kind({**file().settings, "callback": arguments.picture})
DECIMALS = number("N", 1, 1000)


class Options(Frozen):
    rules: ClassVar[tuple[Rule, ...]] = ()

    def of(self, function: str) -> dict[str, Any]:
        """The given options that are arguments of a function of the package."""
        found = {}
        for name, declared in declared_by(type(self)).items():
            value = getattr(self, name)
            for each in declared if isinstance(declared, tuple) else ():
                owner, _, argument = each.of.partition(".")
                if owner == function and value is not None and value is not False and value != ():
                    found[argument] = value
        return found


def declared_by(command: type) -> dict[str, tuple[Option, ...] | Bundle]:
    if not issubclass(command, Options):
        return {}
    values = zip(fields(command), command.__struct_defaults__, strict=True)
    return {name: (x,) if isinstance(x, Option) else x for name, x in values}


def rules_of(command: type) -> list[Rule]:
    return [rule for x in command.__mro__ for rule in x.__dict__.get("rules", ())]


SET = always("--set", SETTINGS, "Give a parameter of FILE a value; repeatable.", heading="Method")


class WithSettings(Options):
    settings: Mapping[str, str] = SET

    def method(self, file: str, is_any_kind: bool = False) -> GarkMethod:
        """Reads FILE; MethodFileError for faults, HasFreeParameters if a parameter has no value."""
        from garkcli.methodfile.load import load

        found: GarkMethod = load(file, self.settings)
        if not is_any_kind:
            found.tableau.demand_fields("this command")
        return found


CONJUGATE = flag("--conjugate", "Take the symplectic conjugate of FILE instead.")
PAIR = flag("--pair", "Take the symplectic pair of FILE instead, 2N colours.")


class Derivable(WithSettings):
    conjugate: bool = CONJUGATE
    pair: bool = PAIR
    rules: ClassVar[tuple[Rule, ...]] = (
        excludes(PAIR, CONJUGATE, "--pair and --conjugate are two methods", "ask for one"),
    )

    @property
    def which(self) -> Derivation | None:
        return "conjugate" if self.conjugate else "pair" if self.pair else None

    def method(self, file: str, is_any_kind: bool = False) -> GarkMethod:
        """Reads FILE, or makes its conjugate or pair; ZeroWeight if that divides by zero."""
        found = super().method(file, is_any_kind)
        return found.conjugate if self.conjugate else found.pair if self.pair else found


FORMAT: str = always("--format", Kind({}))
OUTPUT = option(
    "-o --output",
    file(),
    "Write the result to FILE, in the format that its ending names; - is standard output.",
)
QUIET = flag("-q --quiet", "Say less.")
VERBOSE = flag("-v --verbose", "Say more.")
COLOR = preset("--color", words("auto", "always", "never"), "auto")
WRITTEN: Mapping[str, object] = {"format": FORMAT, "output": OUTPUT, "quiet": QUIET, "color": COLOR}
REPORTED: Mapping[str, object] = {
    "format": FORMAT,
    "output": OUTPUT,
    "quiet": QUIET,
    "verbose": VERBOSE,
    "color": COLOR,
}
OPEN = flag("--open", "Show it in the browser.", heading="Report")
CATALOGUE = option(
    "--catalogue", FOLDER, "Add the method files below DIR to the catalogue; repeatable."
)
DIGITS = option(
    "--digits",
    DECIMALS,
    "Decimals with N digits; by default numbers with simple radicals are exact.",
    heading="Report",
)
DOCUMENT = flag(
    "--document", "With --format latex: a complete document that compiles.", heading="Report"
)
DOCUMENT_RULE = needs(
    DOCUMENT, being(FORMAT, "latex"), "--document goes with --format latex", "add --format latex"
)
PLOT_HELP = "Draw a plot into FILE: .png, .svg or .pdf."
PLOT = option("--plot", PICTURE, PLOT_HELP, heading="Report")
JOBS_HELP = "The number of processes; 0 is one per processor."
OUTPUT_DIR = option(
    "--output-dir",
    file(metavar="DIR"),
    "Write a method file for each method into DIR.",
    heading="Output",
)
FAST = option(
    "--fast",
    hidden_default(text("COLOUR")),
    "With --slow: the colour of the fast spring.",
    of="two_springs.fast",
)


def of_springs(slow: object) -> tuple[Rule, Rule]:
    said = "--slow and --fast belong together", "give both"
    return needs(slow, FAST, *said), needs(FAST, slow, *said)
