"""The types of arguments and options: methods, files, problems, numbers, with completion."""

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
"""Notes are kept in a context until the verbosity is known."""
_VARIABLE = "GARK_PATH"
SPELLINGS = {"color": "colour", "minimiz": "minimis", "recogniz": "recognis"}
OLD_NAMES = {"emit-all": "output-dir"}
DECADES = 50
"""Times, frequencies and errors are between 10^-50 and 10^50."""


class InputType(click.Path):
    """The command reads it and never overwrites it; errors are reported when it is read."""

    name = "file"

    def __init__(self) -> None:
        super().__init__(readable=False)

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        found = super().convert(value, param, ctx)
        note_input(str(found))
        return found


INPUT = InputType()
PATH = click.Path(readable=False)


class MethodType(InputType):
    def shell_complete(
        self, ctx: click.Context, param: click.Parameter, incomplete: str
    ) -> list[CompletionItem]:
        """The names and files that begin with a text; below a folder the shell completes."""
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
    folder, start = os.path.split(path)
    with suppress(OSError):
        for name in sorted(os.listdir(folder or ".")):
            if name.startswith(start) and name.isprintable():
                place = os.path.join(folder, name)
                yield place + os.sep if os.path.isdir(place) else place


class ProblemType(click.ParamType):  # type: ignore[type-arg]
    name = "problem"

    def get_metavar(self, param: click.Parameter, ctx: click.Context | None = None) -> str:
        return "NAME|FILE"

    def convert(self, value: str, param: click.Parameter | None, ctx: click.Context | None) -> str:
        """Fails for a text that is neither a name nor a file, before anything is read."""
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
        from click.shell_completion import CompletionItem

        from garkcli.problems.builtin import PROBLEMS

        found = [name for name in PROBLEMS if name.startswith(incomplete)]
        if not found:
            return [CompletionItem(incomplete, type="file")]
        files = (x for x in _entries_beginning(incomplete) if x.endswith((".yaml", ".yml")))
        return [CompletionItem(name) for name in (*found, *files)]


def named(place: str) -> Any:
    file, _, name = place.partition(":")
    found = getattr(import_module(f"garkcli.{file}"), name)
    return found() if callable(found) else found


def completed(place: str) -> Callable[..., list[str]]:
    return lambda _context, _parameter, start: [x for x in named(place) if x.startswith(start)]


def add_folders(context: click.Context, _: click.Parameter, folders: Sequence[str]) -> None:
    """Before those of ``GARK_PATH``, for this run and its processes; UsageProblem for files."""
    if not folders or context.resilient_parsing:
        return
    for folder in folders:
        if not os.path.isdir(folder):
            message = f"--catalogue: {folder!r} is not a folder"
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
    if os.environ.get(_VARIABLE) and not context.resilient_parsing:
        from garkcli.methodfile.naming import note_of

        given = value if isinstance(value, tuple) else (value,)
        notes = context.meta.setdefault(_NOTES, [])
        with suppress(GarkError):  # it is reported where the method is read
            notes += [note for path in given if path for note in note_of(path)]
    return value


def notes() -> list[str]:
    """The notes that were kept, which are forgotten."""
    context = click.get_current_context(silent=True)
    kept: list[str] = context.meta.pop(_NOTES, []) if context else []
    return kept


def pairs(
    context: click.Context, parameter: click.Parameter, given: tuple[str, ...]
) -> dict[str, str]:
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
    """Fails for NaN, which no range excludes."""
    if seconds is not None and seconds != seconds:
        raise click.BadParameter("nan is not a number of seconds")
    return seconds


def picture(_: click.Context, __: click.Parameter, path: str | None) -> str | None:
    if path is not None:
        from pathlib import Path

        from garkcli.plots.saving import check_suffix

        check_suffix(Path(path))
    return path


def spelled(word: str) -> str:
    """``--minimize`` becomes ``--minimise``; ``--color`` is about text and stays.

    >>> spelled("minimize"), spelled("colors-used"), spelled("color"), spelled("emit-all")
    ('minimise', 'colours-used', 'color', 'output-dir')
    """
    if word == "color":
        return word
    for american, british in SPELLINGS.items():
        word = word.replace(american, british)
    return OLD_NAMES.get(word, word)


def workers(_: click.Context, __: click.Parameter, jobs: int | None) -> int | None:
    return (os.cpu_count() or 1) if jobs == 0 else jobs


def read_by(read: Callable[[str, str], Any]) -> Callable[..., Any]:
    def callback(_: click.Context, parameter: click.Parameter, given: Any) -> Any:
        option = max(parameter.opts, key=len)
        if isinstance(given, tuple):
            return tuple(read(option, text) for text in given)
        return None if given is None else read(option, given)

    return callback


def rational(option: str, text: str, cure: str = "such as 1/2") -> fmpq:
    """UsageProblem for other texts; ``cure`` is for irrational numbers."""
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
    """A time, a frequency or an error; UsageProblem for other texts, and beyond ``DECADES``."""
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
    return tuple(positive(option, x) for x in text.split(","))


def point(option: str, text: str) -> tuple[fmpq, fmpq]:
    """The real and the imaginary part; UsageProblem unless they are rational."""
    from garkcli.exact.given import complex_parts

    real, imaginary = (rational(option, x, "such as 0.01+2i") for x in complex_parts(text))
    return real, imaginary


def ratio(option: str, text: str) -> fmpq:
    """The ratio of two radii; UsageProblem for other texts."""
    number = rational(option, text)
    if number <= 0:
        message = f"--ratio {text}: radii are positive"
        raise UsageProblem(message, "the axes are always there", code="option-value")
    return number


def square(option: str, text: str) -> fmpq:
    """A nonnegative rational number; UsageProblem for other texts."""
    number = rational(option, text)
    if number < 0:
        message = f"{option} {text}: a square is not negative"
        raise UsageProblem(message, "give 0 or more", code="option-value")
    return number
