"""Convergence tests of one or several method files, as the options ask for them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import click

from garkcli.cli.options import Output
from garkcli.cli.problems import find_problem, is_path, note_changing
from garkcli.cli.stepping import rational, stepped_tableau
from garkcli.errors import Fault, GarkError, MethodFileError

if TYPE_CHECKING:
    from flint import fmpq

    from garkcli.convergence.reference import Watch
    from garkcli.methodfile.build import MethodFile
    from garkcli.problems.hamiltonian import Hamiltonian
    from garkcli.problems.oscillator import Oscillator
    from garkcli.report.convergence_data import Entry, Result
    from garkcli.tableau.tableau import Tableau


@dataclass(frozen=True)
class Wanted:
    """What to test on, by the names of the options.

    Attributes:
        problem: a name or the path of a problem file.
        omega, split, seed: of the problems that take them.
        t_end: the final time, or None for that of the problem.
        steps: step sizes, or None for the default ladder.
        work: whether the cost of the steps is measured.
    """

    problem: str
    omega: str | None
    split: str | None
    seed: int | None
    t_end: fmpq | None
    steps: tuple[fmpq, ...] | None
    work: bool


class Problems:
    """The problem, split for each of the methods that are tested on it.

    A file is read once. A random H, as that of ``generic``, depends on its number of terms: all
    methods get that of the method with the most, with terms added up where they have fewer.

    Args:
        wanted: names the problem.
        tableaux: of all methods.

    Attributes:
        read: the problem of a file, as it was read.

    Errors:
        MethodFileError: the problem file has faults.
    """

    def __init__(self, wanted: Wanted, tableaux: Sequence[Tableau]) -> None:
        from garkcli.problems.oscillator import terms_of
        from garkcli.stepping.dependency import with_joined_terms

        self._wanted = wanted
        self.read: Hamiltonian | None = None
        self._widest = max(map(with_joined_terms, tableaux), key=terms_of, default=None)
        if is_path(wanted.problem):
            from garkcli.methodfile.problem import load_problem

            self.read = load_problem(wanted.problem)

    def of(self, tableau: Tableau) -> Hamiltonian:
        """The problem for one method.

        Raises:
            UsageProblem: it cannot be split for it.
        """
        from garkcli.problems.builtin import built_in
        from garkcli.problems.comparison import merge_terms
        from garkcli.problems.oscillator import terms_of
        from garkcli.stepping.matching import split_into

        terms = terms_of(tableau)
        if self.read is not None:
            return split_into(self.read, terms)
        name, seed = self._wanted.problem, self._wanted.seed
        if not built_in(name).takes_seed or self._widest is None:
            return find_problem(name, tableau, seed)
        return merge_terms(find_problem(name, self._widest, seed), terms)


def tested(
    method: MethodFile, tableau: Tableau, wanted: Wanted, problems: Problems, watch: Watch
) -> Result:
    """The convergence test of one method.

    Raises:
        GarkError: the method is not for the problem, or a step fails.
    """
    if wanted.problem == "oscillator":
        return _on_oscillator(method, tableau, wanted)
    from garkcli.convergence.nonlinear import observe
    from garkcli.stepping.dependency import with_joined_terms

    tableau = with_joined_terms(tableau)
    return observe(
        tableau,
        problems.of(tableau),
        wanted.t_end,
        wanted.steps,
        method.tolerance,
        wanted.work,
        watch,
    )


def hint_rounding(
    method: MethodFile, tableau: Tableau, result: Result, output: Output, path: str = ""
) -> None:
    """Where observed and exact order disagree because coefficients look rounded: the line that is
    missing.
    """
    if result.verdict != "disagree" or method.tolerance is not None:
        return
    from garkcli.order.certificate import find_order
    from garkcli.order.suggestion import suggest_tolerance

    found = suggest_tolerance(tableau, find_order(tableau))
    if found is not None:
        where = f"{path}: " if path else ""
        output.note(
            f"{where}hint: the coefficients look rounded; with the line  {found.line}  the order is {found.order}"
        )


def _on_oscillator(method: MethodFile, tableau: Tableau, wanted: Wanted) -> Result:
    from garkcli.convergence.convergence import converge

    predicted, tolerance = None, 0.0
    if method.tolerance is not None:
        from garkcli.exact.display import to_float
        from garkcli.order.rounded import find_order_within

        predicted, tolerance = (
            find_order_within(tableau, method.tolerance).order,
            to_float(method.tolerance),
        )
    result = converge(
        tableau, oscillator(wanted, tableau), wanted.t_end, wanted.steps, predicted, tolerance
    )
    if wanted.work:
        from garkcli.convergence.work import timed

        result = timed(tableau, result)
    return result


def oscillator(wanted: Wanted, tableau: Tableau) -> Oscillator:
    """The oscillator for one method.

    Raises:
        UsageProblem: the options do not make one.
    """
    from garkcli.problems.oscillator import Oscillator, parse_shares, terms_of

    terms, frequency = terms_of(tableau), rational("--omega", wanted.omega or "1")
    if wanted.split:
        return Oscillator(frequency, parse_shares(wanted.split, terms))
    return Oscillator.default(terms, frequency)


def compared(paths: Sequence[str], wanted: Wanted, output: Output) -> list[Entry]:
    """The tests of all files, in order. What fails is told on stderr at once, and stops none of the
    others.

    Raises:
        MethodFileError: the problem file has faults.
    """
    from garkcli.methodfile.load import load
    from garkcli.report.progress import watching

    methods: list[tuple[MethodFile, Tableau] | Entry] = []
    for path in paths:
        try:
            method = load(path)
            methods.append((method, stepped_tableau(method, output, path)))
        except GarkError as error:
            methods.append(_failed(path, path, error))
    problems = Problems(wanted, [found[1] for found in methods if isinstance(found, tuple)])
    if problems.read is not None:
        note_changing(problems.read, output)
    entries = []
    with watching(output.verbosity >= 0) as watch:
        for k, (path, found) in enumerate(zip(paths, methods, strict=True), start=1):
            prefixed = _prefixed(watch, f"{k}/{len(paths)}")
            entries.append(
                _entry(path, *found, wanted, problems, prefixed)
                if isinstance(found, tuple)
                else found
            )
    for path, found, entry in zip(paths, methods, entries, strict=True):
        if isinstance(found, tuple) and entry.result is not None:
            hint_rounding(*found, entry.result, output, path)
    return entries


def _prefixed(watch: Watch, prefix: str) -> Watch:
    return lambda what, done, total: watch(f"{prefix} {what}", done, total)


def _entry(
    path: str,
    method: MethodFile,
    tableau: Tableau,
    wanted: Wanted,
    problems: Problems,
    watch: Watch,
) -> Entry:
    from garkcli.report.convergence_data import Entry

    try:
        result = tested(method, tableau, wanted, problems, watch)
    except GarkError as error:
        return _failed(path, method.name, error)
    return Entry(path, method.name, result, (), int(result.verdict == "disagree"))


def _failed(path: str, name: str, error: GarkError) -> Entry:
    """Tell an error; a step that fails has exit code 1, everything else 2."""
    import sys

    from garkcli.check.outcome import Outcome
    from garkcli.report.check_text import faults_text
    from garkcli.report.convergence_data import Entry
    from garkcli.report.paint import Paint
    from garkcli.stepping.step import StepFailed

    if isinstance(error, MethodFileError):
        faults, text = error.faults, error.text
    else:
        faults, text = (Fault(error.message, error.help),), ""
    click.echo(
        faults_text(Outcome(path, name, faults=faults, text=text), Paint(sys.stderr.isatty())),
        err=True,
    )
    return Entry(path, name, None, faults, 1 if isinstance(error, StepFailed) else 2)
