"""What arguments and options take: files and names of the catalogue, problems, numbers; with
completion.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Sequence
from contextlib import suppress
from importlib import import_module
from typing import TYPE_CHECKING, Any

import click

from garkcli.errors import ExpressionError, GarkError, UsageProblem, did_you_mean
from garkcli.files import note_input

if TYPE_CHECKING:
    from click.shell_completion import CompletionItem
    from flint import fmpq

_NOTES = "garkcli.notes"
"""Where a context keeps its notes until it is known how much the user wants to hear."""
_VARIABLE = "GARK_PATH"
SPELLINGS = {"color": "colour", "minimiz": "minimis", "recogniz": "recognis"}
"""American spellings in options, and the ones that the help shows."""
OLD_NAMES = {"emit-all": "output-dir"}
"""Options that had another name."""
DECADES = 50
"""Times, frequencies and errors are numbers from 10^-50 to 10^50."""


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
PATH = click.Path(readable=False)
"""That of places to write to."""


class MethodType(InputType):
    """A path, a name or an alias."""

    def shell_complete(
        self, ctx: click.Context, param: click.Parameter, incomplete: str
    ) -> list[CompletionItem]:
        """Names that begin so with files beside them; below folders the shell goes on alone."""
        from click.shell_completion import CompletionItem

        from garkcli.methodfile.naming import can_be_name, names_beginning

        found: list[str] = []
        if incomplete and can_be_name(incomplete):
            with suppress(GarkError):  # a broken catalogue is reported when it is used
                found += names_beginning(incomplete)
        if not found:
            return [CompletionItem(incomplete, type="file")]
        return [CompletionItem(name) for name in (*found, *_entries_beginning(incomplete))]


def _entries_beginning(path: str) -> Iterator[str]:
    """Files that begin so, and folders with a separator behind them."""
    folder, start = os.path.split(path)
    with suppress(OSError):
        for name in sorted(os.listdir(folder or ".")):
            if name.startswith(start) and name.isprintable():
                place = os.path.join(folder, name)
                yield place + os.sep if os.path.isdir(place) else place


class ProblemType(click.ParamType):  # type: ignore[type-arg]
    """The name of a built-in problem or the path of a problem file."""

    name = "problem"

    def get_metavar(self, param: click.Parameter, ctx: click.Context | None = None) -> str:
        """What help shows."""
        return "NAME|FILE"

    def convert(self, value: str, param: click.Parameter | None, ctx: click.Context | None) -> str:
        """Refuse what is neither, before anything is read."""
        from garkcli.problems.builtin import PROBLEMS, is_path

        if value not in PROBLEMS and not is_path(value):
            cure = did_you_mean(value, tuple(PROBLEMS))
            message = f"no problem {value!r} (a problem file ends in .yaml)"
            self.fail(f"{message}\nhelp: {cure}", param, ctx)
        note_input(value)
        return value

    def shell_complete(
        self, ctx: click.Context, param: click.Parameter, incomplete: str
    ) -> list[CompletionItem]:
        """The names, and problem files; folders are for the shell, which goes on below them."""
        from click.shell_completion import CompletionItem

        from garkcli.problems.builtin import PROBLEMS

        found = [name for name in PROBLEMS if name.startswith(incomplete)]
        if not found:
            return [CompletionItem(incomplete, type="file")]
        files = (x for x in _entries_beginning(incomplete) if x.endswith((".yaml", ".yml")))
        return [CompletionItem(name) for name in (*found, *files)]


def named(place: str) -> Any:
    """What a module of the package calls so; of a function, what it returns."""
    file, _, name = place.partition(":")
    found = getattr(import_module(f"garkcli.{file}"), name)
    return found() if callable(found) else found


def completed(place: str) -> Callable[..., list[str]]:
    """Completion: the words of that name that begin so."""
    return lambda _context, _parameter, start: [x for x in named(place) if x.startswith(start)]


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
    """Keep notes on names, until it is known how much the user wants to hear."""
    if os.environ.get(_VARIABLE) and not context.resilient_parsing:
        from garkcli.methodfile.naming import note_of

        given = value if isinstance(value, tuple) else (value,)
        notes = context.meta.setdefault(_NOTES, [])
        with suppress(GarkError):  # it is reported where the method is read
            notes += [note for path in given if path for note in note_of(path)]
    return value


def notes() -> list[str]:
    """The notes that were kept, once."""
    context = click.get_current_context(silent=True)
    kept: list[str] = context.meta.pop(_NOTES, []) if context else []
    return kept


def pairs(
    context: click.Context, parameter: click.Parameter, given: tuple[str, ...]
) -> dict[str, str]:
    """``NAME=VALUE``, each name once."""
    settings: dict[str, str] = {}
    for given_text in given:
        name, sign, value = given_text.partition("=")
        if not sign or not name.strip() or not value.strip():
            message = f"{given_text!r} is not NAME=VALUE\nhelp: write for instance t=1/2"
            raise click.BadParameter(message, context, parameter)
        if name.strip() in settings:
            raise click.BadParameter(f"{name.strip()!r} is given twice", context, parameter)
        settings[name.strip()] = value.strip()
    return settings


def finite(_: click.Context, __: click.Parameter, seconds: float | None) -> float | None:
    """A number of seconds; nan, which no limit of a range holds off, is none."""
    if seconds is not None and seconds != seconds:
        raise click.BadParameter("nan is no number of seconds")
    return seconds


def picture(_: click.Context, __: click.Parameter, path: str | None) -> str | None:
    """A file to draw into, of a kind that can be drawn.

    Raises:
        UsageProblem: its suffix is none of those.
    """
    if path is not None:
        from pathlib import Path

        from garkcli.plots.saving import check_suffix

        check_suffix(Path(path))
    return path


def spelled(word: str) -> str:
    """An option or one of its words, however the reader spells: ``--minimize`` is ``--minimise``,
    ``--colors`` is ``--colours``. ``--color`` is about text and stays.

    >>> spelled("minimize"), spelled("colors-used"), spelled("color"), spelled("emit-all")
    ('minimise', 'colours-used', 'color', 'output-dir')
    """
    if word == "color":
        return word
    for american, british in SPELLINGS.items():
        word = word.replace(american, british)
    return OLD_NAMES.get(word, word)


def workers(_: click.Context, __: click.Parameter, jobs: int | None) -> int | None:
    """How many processes: 0 is one for each processor."""
    return (os.cpu_count() or 1) if jobs == 0 else jobs


def read_by(read: Callable[[str, str], Any]) -> Callable[..., Any]:
    """What an option says, as it is read where it is given; of one that repeats, each."""

    def callback(_: click.Context, parameter: click.Parameter, given: Any) -> Any:
        option = max(parameter.opts, key=len)
        if isinstance(given, tuple):
            return tuple(read(option, text) for text in given)
        return None if given is None else read(option, given)

    return callback


def rational(option: str, text: str, cure: str = "such as 1/2") -> fmpq:
    """The rational number that was given for ``option``.

    Args:
        option: what messages call it.
        text: what was given.
        cure: for a number that is not rational.

    Raises:
        UsageProblem: it is none.
    """
    from garkcli.exact.domain import Domain
    from garkcli.exact.expression import parse
    from garkcli.exact.field import Algebraic

    try:
        expression = parse(text)
        number = Domain([expression]).evaluate(expression)
    except ExpressionError as error:
        message = f"{option} {text}: {error.message}"
        raise UsageProblem(message, error.help, code=error.code) from None
    if isinstance(number, Algebraic):
        message = f"{option} {text}: a rational number is expected"
        raise UsageProblem(message, cure, code="option-value")
    return number


def positive(option: str, text: str) -> fmpq:
    """The positive rational number that was given for ``option``, a time, a frequency or an error.

    Raises:
        UsageProblem: it is none, or beyond what such things are.
    """
    from flint import fmpq

    number = rational(option, text)
    if number <= 0:
        message = f"{option} {text}: a positive number is expected"
        raise UsageProblem(message, f"write {option} 1/10", code="option-value")
    if not fmpq(1, 10**DECADES) <= number <= 10**DECADES:
        message = f"{option} {text}: a number from 1e-{DECADES} to 1e{DECADES} is expected"
        raise UsageProblem(message, f"write {option} 1/10", code="option-value")
    return number


def positives(option: str, text: str) -> tuple[fmpq, ...]:
    """Several of them, with commas between."""
    return tuple(positive(option, x) for x in text.split(","))


def point(option: str, text: str) -> tuple[fmpq, fmpq]:
    """A complex number, by its parts.

    Raises:
        UsageProblem: they are not rational.
    """
    from garkcli.exact.given import complex_parts

    real, imaginary = (rational(option, x, "such as 0.01+2i") for x in complex_parts(text))
    return real, imaginary


def ratio(option: str, text: str) -> fmpq:
    """The ratio of two radii.

    Raises:
        UsageProblem: it is none.
    """
    number = rational(option, text)
    if number <= 0:
        message = f"--ratio {text}: radii are positive"
        raise UsageProblem(message, "the axes are always there", code="option-value")
    return number


def square(option: str, text: str) -> fmpq:
    """The rational number, not negative, that was given for ``option``.

    Raises:
        UsageProblem: it is none.
    """
    number = rational(option, text)
    if number < 0:
        message = f"{option} {text}: a square is not negative"
        raise UsageProblem(message, "give 0 or more", code="option-value")
    return number
