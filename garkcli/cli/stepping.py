"""What the commands share that put a method to work: the problem and the numbers of their options,
and what they do with a run that fails.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from garkcli.cli.options import Output
from garkcli.cli.streams import complain
from garkcli.errors import Fault, GarkError, MethodFileError, UsageProblem, did_you_mean

if TYPE_CHECKING:
    from flint import fmpq

    from garkcli.problems.oscillator import Oscillator
    from garkcli.tableau.tableau import Tableau
    from garkcli.tell.report import Report

DECADES = 50
"""Times, frequencies and errors are numbers from 10^-50 to 10^50."""


def tell_failure(error: GarkError, name: str, report: Report[Any], output: Output) -> int:
    """Tell people why a run has no result, and programs in the report; and return the exit code: a
    step that fails has 1, everything else 2.

    Args:
        error: what has failed.
        name: of the method.
        report: of the command.
        output: where it goes.
    """
    from garkcli.report.failure import Failure

    complain(error)
    if output.format in ("json", "csv"):
        output.tell(report, [Failure(name, faults_of(error))])
    return failure_code(error)


def faults_of(error: GarkError) -> tuple[Fault, ...]:
    """What is wrong: the faults of a file, or one fault."""
    if isinstance(error, MethodFileError):
        return error.faults
    return (Fault(error.message, error.help, code=error.code),)


def failure_code(error: GarkError) -> int:
    """The exit code of a run that has failed."""
    from garkcli.stepping.integrator import StepFailed

    return 1 if isinstance(error, StepFailed) else 2


def refuse_misplaced(
    problem: str, seed: int | None, stiffness: str | None, of_oscillator: Mapping[str, object]
) -> None:
    """Refuse options of another problem: they would change nothing.

    Args:
        problem: the one that was named.
        seed: the value of --seed, which is for problems with random coefficients.
        stiffness: the value of --stiffness, which is for stiff problems and problem files.
        of_oscillator: the options that are for the oscillator alone, with their values.

    Raises:
        UsageProblem: one of them was given.
    """
    from garkcli.problems.builtin import PROBLEMS, check_seed, check_stiffness

    given = [option for option, value in of_oscillator.items() if value]
    if problem != "oscillator" and given:
        message = f"{given[0]} is for the oscillator, not for {problem}"
        raise UsageProblem(message, "leave it out", code="other-problem")
    check_seed(problem, seed)
    if stiffness is not None and problem in PROBLEMS:
        check_stiffness(problem)


def given_positive(option: str, text: str | None) -> fmpq | None:
    """The ``positive`` number that was given for ``option``, if any was."""
    return None if text is None else positive(option, text)


def oscillator(tableau: Tableau, omega: str | None, split: str | None) -> Oscillator:
    """The oscillator of ``--omega`` and ``--split``, for one method.

    Raises:
        UsageProblem: the options do not make one.
    """
    from garkcli.problems.oscillator import Oscillator, parse_shares, terms_of

    terms = terms_of(tableau)
    frequency = positive("--omega", omega or "1")
    if split:
        return Oscillator(frequency, parse_shares(split, terms))
    return Oscillator.default(terms, frequency)


def positive(option: str, text: str | None) -> fmpq:
    """The positive rational number that was given for ``option``, a time, a frequency or an error.

    Raises:
        UsageProblem: it is none, or beyond what such things are.
    """
    from flint import fmpq

    number = rational(option, text or "")
    if number <= 0:
        raise UsageProblem(f"{option} {text}: a positive number is expected", code="option-value")
    if not fmpq(1, 10**DECADES) <= number <= 10**DECADES:
        raise UsageProblem(
            f"{option} {text}: a number from 1e-{DECADES} to 1e{DECADES} is expected",
            code="option-value",
        )
    return number


def rational(option: str, text: str) -> fmpq:
    """The rational number that was given for ``option``.

    Raises:
        UsageProblem: it is none.
    """
    from garkcli.errors import ExpressionError
    from garkcli.exact.domain import Domain
    from garkcli.exact.expression import parse
    from garkcli.exact.field import Algebraic

    try:
        expression = parse(text)
        number = Domain([expression]).evaluate(expression)
    except ExpressionError as error:
        raise UsageProblem(
            f"{option} {text}: {error.message}", error.help, code=error.code
        ) from None
    if isinstance(number, Algebraic):
        raise UsageProblem(
            f"{option} {text}: a rational number is expected", "such as 1/2", code="option-value"
        )
    return number


def square(option: str, text: str) -> fmpq:
    """The rational number, not negative, that was given for ``option``.

    Raises:
        UsageProblem: it is none.
    """
    number = rational(option, text)
    if number < 0:
        raise UsageProblem(
            f"{option} {text}: a square is not negative", "give 0 or more", code="option-value"
        )
    return number


def colour_named(tableau: Tableau, colour: str) -> int:
    """The colour that was given for --fast, counted from 0.

    Raises:
        UsageProblem: there is no such colour.
    """
    names = [x.name for x in tableau.colours]
    if colour not in names:
        message = f"--fast: no colour {colour!r}"
        raise UsageProblem(message, did_you_mean(colour, names), code="wrong-value")
    return names.index(colour)
