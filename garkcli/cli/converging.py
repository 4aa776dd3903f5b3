"""Convergence tests of one or several method files, as the options ask for them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from garkcli.cli.companion import companion
from garkcli.cli.options import Output
from garkcli.cli.problems import find_problem, is_path, note_changing
from garkcli.cli.stepping import failure_code, faults_of, oscillator, rational
from garkcli.cli.streams import say_faults
from garkcli.doing import doing
from garkcli.errors import GarkError, MethodFileError

if TYPE_CHECKING:
    from flint import fmpq

    from garkcli.convergence.result import Convergence
    from garkcli.problems.oscillator import Oscillator
    from garkcli.problems.problem import Problem
    from garkcli.report.comparison import Entry
    from garkcli.tableau.garkmethod import GarkMethod
    from garkcli.tableau.tableau import Tableau


@dataclass(frozen=True)
class Wanted:
    """What to test on, by the names of the options.

    Attributes:
        which: "conjugate" or "pair" where these are to step; None for the methods themselves.
        problem: a name or the path of a problem file, or None for one that sees every tree.
        omega, split, seed, stiffness: of the problems that take them.
        t_end: the final time, or None for that of the problem.
        steps: step sizes, or None for the default ladder.
        work: whether the cost of the steps is measured.
    """

    which: str | None
    problem: str | None
    omega: str | None
    split: str | None
    seed: int | None
    stiffness: fmpq | None
    t_end: fmpq | None
    steps: tuple[fmpq, ...] | None
    work: bool


class Problems:
    """The problem, split for each of the methods that are tested on it.

    A file is read once. All methods get the same sum of terms, also where its coefficients depend
    on their number. Where no problem is named it is one that sees every tree of the methods.

    Args:
        wanted: names the problem, or none.

    Attributes:
        read: the problem of a file, as it was read.

    Errors:
        MethodFileError: the problem file has faults.
        UsageProblem: the steps that are wanted do not fit the time.
    """

    def __init__(self, wanted: Wanted) -> None:
        self._wanted = wanted
        self._name = wanted.problem
        self._tableaux: Sequence[Tableau] = ()
        self.read: Problem | None = None
        if self._name is not None and is_path(self._name):
            from garkcli.methodfile.problem import load_problem

            self.read = load_problem(self._name, wanted.stiffness)
        self._check_steps()

    def _check_steps(self) -> None:
        """Refuse steps that do not divide the time, before methods are read."""
        wanted = self._wanted
        if wanted.steps is None:
            return
        from garkcli.convergence.convergence import check_steps, usual_time

        problem = self._unsplit()
        check_steps(problem, wanted.t_end or usual_time(problem), wanted.steps)

    def _unsplit(self) -> Problem | Oscillator:
        """The problem in one term: its times are those of every split."""
        from garkcli.problems.builtin import GENERIC, problem
        from garkcli.problems.oscillator import Oscillator

        if self.read is not None:
            return self.read
        if self._name == "oscillator":
            return Oscillator.default(1, rational("--omega", self._wanted.omega or "1"))
        return problem(self._name or GENERIC[0], 1, stiffness=self._wanted.stiffness)

    def prepare(self, tableaux: Sequence[Tableau]) -> None:
        """Make the problem one for all of these methods.

        Raises:
            UsageProblem: none is named, and there is none for their structures.
        """
        self._tableaux = tableaux
        if self._name is None and tableaux:
            from garkcli.convergence.convergence import seeing_problem

            self._name = seeing_problem(tableaux, self._seed)

    @property
    def _seed(self) -> int:
        return 1 if self._wanted.seed is None else self._wanted.seed

    def of(self, tableau: Tableau) -> Problem | Oscillator:
        """The problem for one of the methods that it was prepared for.

        Raises:
            UsageProblem: it cannot be split for it.
        """
        from garkcli.convergence.convergence import in_common
        from garkcli.problems.builtin import built_in
        from garkcli.problems.oscillator import terms_of
        from garkcli.stepping.fields import split_into, with_joined_terms

        if self._name == "oscillator":
            return oscillator(tableau, self._wanted.omega, self._wanted.split)
        if self.read is not None:
            return split_into(self.read, terms_of(with_joined_terms(tableau)))
        assert self._name is not None
        if not built_in(self._name).takes_seed:
            return find_problem(self._name, tableau, stiffness=self._wanted.stiffness)
        first, *_ = in_common(self._name, [tableau, *self._tableaux], self._seed)
        return first


def tested(method: GarkMethod, wanted: Wanted, problems: Problems) -> Convergence:
    """The convergence test of one method.

    Raises:
        GarkError: the method is not for the problem, or a step fails.
    """
    from garkcli.api.runs import converge

    problem = problems.of(method.tableau)
    return converge(method, problem, wanted.t_end, wanted.steps, is_timed=wanted.work)


def hint_rounding(method: GarkMethod, result: Convergence, output: Output, path: str = "") -> None:
    """Where the exact order shows late or not at all because coefficients look rounded: the line
    that is missing.
    """
    is_late = result.verdict == "disagree" or result.short_time is not None
    if not is_late or method.tolerance is not None:
        return
    from garkcli.order.certificate import find_order
    from garkcli.order.suggestion import suggest_tolerance

    found = suggest_tolerance(method.tableau, find_order(method.tableau))
    if found is not None:
        where = f"{path}: " if path else ""
        output.note(
            f"{where}hint: the coefficients look rounded; with the line  {found.line}  "
            f"the order is {found.order}"
        )


def compared(paths: Sequence[str], wanted: Wanted, output: Output) -> list[Entry]:
    """The tests of all files, in order. What fails is told on stderr at once, and stops none of the
    others.

    Raises:
        MethodFileError: the problem file has faults.
        UsageProblem: the steps that are wanted do not fit the time.
    """
    from garkcli.methodfile.naming import called
    from garkcli.report.comparison import Entry

    problems = Problems(wanted)
    methods = [_loaded(path, wanted) for path in paths]
    paths = [called(path) for path in paths]
    problems.prepare([found.tableau for found in methods if not isinstance(found, Entry)])
    if problems.read is not None:
        note_changing(problems.read, output)
    entries = []
    with doing("methods", len(paths)) as work:
        for path, found in zip(paths, methods, strict=True):
            if isinstance(found, Entry):
                entries.append(found)
            else:
                entries.append(_entry(path, found, wanted, problems))
            work.reach(work.done + 1)
    for path, found, entry in zip(paths, methods, entries, strict=True):
        if not isinstance(found, Entry) and entry.result is not None:
            hint_rounding(found, entry.result, output, path)
    return entries


def _loaded(path: str, wanted: Wanted) -> GarkMethod | Entry:
    """The method that steps, or what its failure leaves."""
    from garkcli.methodfile.load import load

    try:
        return companion(load(path), wanted.which)
    except GarkError as error:
        return _failed(path, path, error)


def _entry(path: str, method: GarkMethod, wanted: Wanted, problems: Problems) -> Entry:
    from garkcli.report.comparison import Entry

    try:
        with doing(path):
            result = tested(method, wanted, problems)
    except GarkError as error:
        return _failed(path, method.name, error)
    return Entry(path, method.name, result, (), result.exit_code)


def _failed(path: str, name: str, error: GarkError) -> Entry:
    """Tell an error with the name of the file."""
    from garkcli.check.outcome import Outcome
    from garkcli.report.comparison import Entry

    faults = faults_of(error)
    text = error.text if isinstance(error, MethodFileError) else ""
    say_faults(Outcome(path, name, faults=faults, text=text))
    return Entry(path, name, None, faults, failure_code(error))
