"""``gark converge``, ``energy`` and ``modified``: methods at work on problems."""

from __future__ import annotations

from collections.abc import Sequence
from math import isnan
from typing import TYPE_CHECKING

from garkcli.cli import options as opt
from garkcli.cli.arguments import positive, positives
from garkcli.cli.command import declared
from garkcli.cli.output import Output, failure_code, faults_of
from garkcli.cli.streams import say_faults
from garkcli.doing import doing
from garkcli.errors import GarkError, MethodFileError, UsageProblem
from garkcli.frozen import replace
from garkcli.tell.report import FORMATS

if TYPE_CHECKING:
    from flint import fmpq

    from garkcli.backward.formulas import ModifiedFormula
    from garkcli.convergence.result import Convergence
    from garkcli.longtime.history import LongRun
    from garkcli.longtime.symplecticity import Symplecticity
    from garkcli.problems.oscillator import Oscillator
    from garkcli.problems.problem import Problem
    from garkcli.report.comparison import ConvergedMethod
    from garkcli.report.energy import RunClaim
    from garkcli.stepping.linearly_implicit import Taken
    from garkcli.tableau.garkmethod import GarkMethod
    from garkcli.tableau.tableau import Tableau

OMEGA = opt.option(
    "--omega",
    opt.read("W", positive),
    "The frequency of the oscillator; 1 by default.",
    of="Oscillator.omega",
    heading="Problem",
)
SPLIT = opt.option(
    "--split",
    opt.text("K:V,..."),
    "The oscillator's shares of kinetic and potential energy.",
    of="Oscillator.shares",
)
SEED = opt.option(
    "--seed",
    opt.hidden_default(opt.number("N", 0)),
    "The seed of random coefficients; 1 by default.",
    of="problem.seed",
)
STIFFNESS = opt.option(
    "--stiffness",
    opt.read("S", positive),
    "The stiffness of a stiff problem; in a file the parameter of this name.",
    of="problem.stiffness",
)


class OnProblem(opt.Derivable):
    omega: fmpq | None = OMEGA
    split: str | None = SPLIT
    seed: int | None = SEED
    stiffness: fmpq | None = STIFFNESS
    t_end: fmpq | None = opt.option(
        "--t-end",
        opt.read("T", positive),
        "The final time; each problem has its own.",
        of="long_run.t_end",
    )


class Converge(OnProblem):
    files: tuple[str, ...] = opt.arguments_of("FILE...", opt.METHOD)
    problem: str | None = opt.option(
        "--problem",
        opt.PROBLEM,
        "The problem to solve: a name of gark list problems, or a file; by default a random "
        "polynomial that sees every tree.",
        of="converge.problem",
    )
    steps: tuple[fmpq, ...] | None = opt.option(
        "--steps",
        opt.read("H,...", positives),
        "Step sizes, instead of a ladder of halvings that fits the errors.",
        of="converge.steps",
        heading="Steps",
    )
    jacobian: Taken | None = opt.option(
        "--jacobian",
        opt.hidden_default(opt.words("exact", "old", "diagonal")),
        "The Jacobian of a Rosenbrock method: exact; old, of the step before; or diagonal, that of "
        "any matrix.",
        of="converge.jacobian",
    )
    work: bool = opt.flag(
        "--work",
        "Count evaluations, measure time, and plot the errors against them.",
        of="converge.is_timed",
        heading="Report",
    )
    against: str | None = opt.option(
        "--against",
        opt.hidden_default(opt.words("h", "evaluations", "seconds")),
        "The horizontal axis of plots: h, or evaluations with --work; seconds depend on the "
        "machine.",
        of="plot.against",
    )
    plot: str | None = opt.PLOT


class Energy(OnProblem):
    file: str = opt.argument("FILE", opt.METHOD)
    problem: str = opt.preset(
        "--problem",
        opt.PROBLEM,
        "oscillator",
        "The problem to follow: a name of gark list problems, or a file.",
        of="long_run.problem",
    )
    step: fmpq | None = opt.option(
        "--step", opt.read("H", positive), of="long_run.step", heading="Steps"
    )
    digits: int | None = opt.option(
        "--digits",
        opt.hidden_default(opt.number("N", 1, 200)),
        "Step with N digits instead of floats.",
        of="long_run.digits",
    )
    modified: int | None = opt.option(
        "--modified",
        opt.alone(opt.number("[ORDER]", 1, 100), 5),
        "Measure the modified Hamiltonian of trees up to ORDER (by default 5) too.",
        of="modified_run.max_order",
        heading="Measured",
    )
    symplecticity: bool = opt.flag("--symplecticity", "Measure MᵀJM − J of steps, M = ∂y₁/∂y₀.")
    bounded: bool = opt.flag("--bounded", "Claim that nothing drifts, as far as this run can tell.")
    max_error: fmpq | None = opt.option(
        "--max-error", opt.read("E", positive), "Claim that no energy error is larger than E."
    )
    points: int | None = opt.option(
        "--points", opt.number("N", 10, 1_000_000), of="long_run.points", heading="Report"
    )
    plot: str | None = opt.PLOT
    rules = (
        opt.excludes(
            (OMEGA, SPLIT, STIFFNESS, digits, symplecticity, bounded, max_error, plot),
            modified,
            "OPTION does not go with --modified",
            "leave it out",
        ),
    )


class Modified(opt.Derivable):
    file: str = opt.argument("FILE", opt.METHOD)
    order: int = opt.preset(
        "--order -n",
        opt.number("n", 1, 100),
        5,
        of="backward_analysis.max_order",
        heading="Analysis",
    )
    equation: bool = opt.flag(
        "--equation", "Show rooted trees too if there is a modified Hamiltonian."
    )
    problem: str | None = opt.option(
        "--problem",
        opt.PROBLEM,
        "The formula on a problem: a name of gark list problems, or a file.",
        of="modified_formula.problem",
    )
    seed: int | None = SEED
    digits: int | None = opt.DIGITS
    document: bool = opt.DOCUMENT
    rules = (
        opt.DOCUMENT_RULE,
        opt.needs(SEED, problem, "--seed is for the problem", "give --problem too"),
    )


DRIFTING = frozenset({"drifts", "unstable"})
UNDECIDED = 3


def _refuse_misplaced(problem: str, given: OnProblem) -> None:
    """UsageProblem for options that do not apply to a problem."""
    from garkcli.problems.builtin import PROBLEMS, check_seed, check_stiffness

    for option, value in (("--omega", given.omega), ("--split", given.split)):
        if problem != "oscillator" and value:
            message = f"{option} is for the oscillator, not for {problem}"
            raise UsageProblem(message, "leave it out", code="other-problem")
    check_seed(problem, given.seed)
    if given.stiffness is not None and problem in PROBLEMS:
        check_stiffness(problem)


def note_changing(problem: Problem, output: Output) -> None:
    """Notes invariants of a problem file that the exact solution does not conserve."""
    from garkcli.convergence.reference import changing

    for name, change, time in changing(problem):
        output.note(
            f"{problem.name}: {name} is not an invariant: the exact solution changes it by "
            f"{change:.2g} to t = {time}"
        )


@declared("converge", Converge, [*FORMATS, "csv"])
def converge(given: Converge, output: Output) -> int:
    """The convergence test: errors over step sizes, observed against visible order, energy error.

    gark steps with as many digits as the errors need, so that a method of order 12 shows slope 12,
    and takes the step map of the oscillator exactly. Without --problem the problem is generic, or
    its counterpart for separable, semi-separable and Nyström methods: these see every tree, others
    may show a higher order.

    Rosenbrock methods step with the exact Jacobian, or with the matrix of --jacobian.

    Several FILEs, directories or patterns are compared in one table and one plot; with --work by
    the cost of their errors.

    Exit code: 0 every observed order is that of the method on this problem, 1 one differs, or a
    step fails, 2 a file cannot be read, or the method does not fit the problem, 3 an order is
    undecided.
    """
    paths = output.files_meant(given.files, given.settings)
    if given.problem is None and (given.omega or given.split):
        given = replace(given, problem="oscillator")
    # before anything is read
    if given.problem is not None:
        _refuse_misplaced(given.problem, given)
    elif given.stiffness is not None:
        message = "--stiffness is for a problem that has one"
        cure = "name it with --problem, such as --problem van-der-pol"
        raise UsageProblem(message, cure, code="other-problem")
    if given.against not in (None, "h") and not given.work:
        message = f"--against {given.against} is not known without measuring it"
        raise UsageProblem(message, "add --work", code="other-problem")
    return _one(paths[0], given, output) if len(paths) == 1 else _several(paths, given, output)


def _against(given: Converge) -> str:
    return given.against or ("evaluations" if given.work else "h")


def _one(path: str, given: Converge, output: Output) -> int:
    from garkcli.report.convergence import REPORT, ConvergenceReport

    name = path
    try:
        problems = Problems(given)
        method = given.method(path, is_any_kind=True)
        name = method.name
        problems.prepare([method], output)
        result = problems.tested(method)
    except GarkError as error:
        return output.tell_failure(error, name, REPORT)
    output.tell(REPORT, ConvergenceReport(result, name, given.work, _against(given)))
    if given.plot is not None:
        from garkcli.plots.convergence import errors_scene

        output.save_plot(errors_scene([(name, result)], _against(given)), given.plot)
    return result.exit_code


def _several(paths: Sequence[str], given: Converge, output: Output) -> int:
    """Tests all methods although some fail; MethodFileError for faults of the problem."""
    from garkcli.methodfile.naming import called
    from garkcli.plots.convergence import errors_scene
    from garkcli.report.comparison import REPORT, ConvergedMethod, ConvergedMethods

    problems = Problems(given)
    methods = [_loaded(path, given) for path in paths]
    files = [called(path) for path in paths]
    problems.prepare([x for x in methods if not isinstance(x, ConvergedMethod)], output)
    entries = []
    with doing("methods", len(files)) as work:
        for file, found in zip(files, methods, strict=True):
            entries.append(
                found if isinstance(found, ConvergedMethod) else _entry(file, found, problems)
            )
            work.reach(work.done + 1)
    output.tell(REPORT, ConvergedMethods(entries, given.work, _against(given)))
    results = [(x.name, x.result) for x in entries if x.result is not None]
    if given.plot is not None and results:
        output.save_plot(errors_scene(results, _against(given)), given.plot)
    elif given.plot is not None:
        output.note(f"nothing to draw into {given.plot}")
    return max(entry.exit_code for entry in entries)


def _loaded(path: str, given: Converge) -> GarkMethod | ConvergedMethod:
    try:
        return given.method(path, is_any_kind=True)
    except GarkError as error:
        return _failed(path, path, error)


def _entry(path: str, method: GarkMethod, problems: Problems) -> ConvergedMethod:
    from garkcli.report.comparison import ConvergedMethod

    try:
        with doing(path):
            result = problems.tested(method)
    except GarkError as error:
        return _failed(path, method.name, error)
    return ConvergedMethod(path, method.name, result, (), result.exit_code)


def _failed(path: str, name: str, error: GarkError) -> ConvergedMethod:
    from garkcli.check.outcome import Outcome
    from garkcli.report.comparison import ConvergedMethod

    faults = faults_of(error)
    text = error.text if isinstance(error, MethodFileError) else ""
    say_faults(Outcome(path, name, faults=faults, text=text))
    return ConvergedMethod(path, name, None, faults, failure_code(error))


class Problems:
    """A file is read once. All methods get the same sum of terms, even if its coefficients depend
    on their number. Without a name every tree of the methods matters for the problem.
    """

    def __init__(self, given: Converge) -> None:
        from garkcli.convergence.convergence import check_steps, usual_time
        from garkcli.problems.builtin import GENERIC, is_path, problem
        from garkcli.problems.files.load import load_problem
        from garkcli.problems.oscillator import Oscillator

        self._given = given
        self._name = given.problem
        self._seed = 1 if given.seed is None else given.seed
        self._tableaux: Sequence[Tableau] = ()
        self._read: Problem | None = None
        if self._name is not None and is_path(self._name):
            self._read = load_problem(self._name, given.stiffness)
        if given.steps is not None:
            # its times are those of every split
            whole: Problem | Oscillator | None = self._read
            if self._name == "oscillator":
                whole = Oscillator.default(1, given.omega or 1)
            elif whole is None:
                whole = problem(self._name or GENERIC[0], 1, stiffness=given.stiffness)
            check_steps(whole, given.t_end or usual_time(whole), given.steps)

    def prepare(self, methods: Sequence[GarkMethod], output: Output) -> None:
        """Chooses one problem for all methods; UsageProblem if none suits their structures."""
        tableaux = [self._stepped(method) for method in methods]
        self._tableaux = tableaux
        if self._name is None and tableaux:
            from garkcli.convergence.convergence import seeing_problem

            self._name = seeing_problem(tableaux, self._seed)
        if self._read is not None:
            note_changing(self._read, output)

    def _stepped(self, method: GarkMethod) -> Tableau:
        """The tableau that takes the steps; a method for a single problem names it."""
        from garkcli.api.stepped import stepped

        problem = self._read or self._name
        tableau, named, _ = stepped(method.tableau, method.tolerance, problem)
        if problem is None and isinstance(named, str):
            self._name = named
        return tableau

    def of(self, tableau: Tableau) -> Problem | Oscillator:
        """Returns the problem for a prepared method; UsageProblem if it cannot be split."""
        from garkcli.api.problems import problem_for, split_for
        from garkcli.convergence.convergence import in_common
        from garkcli.problems.builtin import PROBLEMS

        if self._read is not None:
            return split_for(self._read, tableau)
        assert self._name is not None
        if PROBLEMS[self._name].takes_seed:
            return in_common(self._name, [tableau, *self._tableaux], self._seed)[0]
        given = self._given
        return problem_for(self._name, tableau, None, given.stiffness, given.omega, given.split)

    def tested(self, method: GarkMethod) -> Convergence:
        """Tests a method; GarkError if the problem does not fit, or a step fails."""
        from garkcli.api.runs import converge

        given = self._given
        problem = self.of(self._stepped(method))
        times = given.t_end, given.steps
        taken = given.jacobian or "exact"
        return converge(method, problem, *times, is_timed=given.work, jacobian=taken)


@declared("energy", Energy, [*FORMATS, "csv"])
def energy(given: Energy, output: Output) -> int:
    """The error of the energy and of every other invariant over a long time: does it drift?

    A fit separates the drift from the oscillation and gives its uncertainty; a drift that a slow
    modulation may explain is undecided, and gark proposes a longer run. On the oscillator there is
    no rounding, and boundedness for all time is decided exactly. Other problems use floats with
    compensated summation, or --digits.

    With --modified the energy error over step sizes, of H and of its modified Hamiltonian cut off
    after each power of h.

    Exit code: 1 if --bounded or --max-error is not met, a step fails, the energy blows up, the
    orbit escapes, or --modified shows a lower order; 3 if that, or without claims a drift, is
    undecided; 2 if a file cannot be read, or the method does not fit the problem.
    """
    from garkcli.api.runs import long_run
    from garkcli.report.energy import REPORT, EnergyReport

    _refuse_misplaced(given.problem, given)
    if given.problem == "oscillator" and given.digits is not None:
        message = "--digits is not for the oscillator: its steps are exact"
        raise UsageProblem(message, "leave it out", code="other-problem")
    if given.modified is not None:
        return _in_modified(given.modified, given, output)
    name = given.file
    try:
        method = given.method(given.file)
        name = method.name
        problem = _followed(method.tableau, given, output)
        run = long_run(method, **{**given.of("long_run"), "problem": problem})
        steps = _symplecticity(method, run, given.symplecticity)
    except GarkError as error:
        return output.tell_failure(error, name, REPORT)
    claims = _claims(run, given)
    output.tell(REPORT, EnergyReport(name, run, steps, claims))
    if given.plot is not None:
        from garkcli.plots.curves import energy_scene

        output.save_plot(energy_scene(run, name), given.plot)
    answers = [claim.holds for claim in claims]
    if run.is_unstable or False in answers:
        return 1
    if not claims:
        answers = [None for x in run.invariants if x.verdict == "undecided"]
    return UNDECIDED if None in answers else 0


def _followed(tableau: Tableau, given: Energy, output: Output) -> Oscillator | Problem:
    """UsageProblem if nothing is conserved, or --symplecticity does not apply."""
    from garkcli.api.problems import problem_for
    from garkcli.problems.builtin import is_path
    from garkcli.problems.hamiltonian import Hamiltonian
    from garkcli.problems.oscillator import Oscillator
    from garkcli.problems.problem import conserved_names

    problem = problem_for(
        given.problem, tableau, given.seed, given.stiffness, given.omega, given.split
    )
    if isinstance(problem, Oscillator):
        return problem
    if not conserved_names(problem):
        message = f"{problem.name} has no energy and no invariants to follow"
        cure = "give invariants in a problem file, or choose a Hamiltonian problem"
        raise UsageProblem(message, cure, code="other-problem")
    if given.symplecticity and not isinstance(problem, Hamiltonian):
        message = f"--symplecticity is for Hamiltonian problems, and {problem.name} is not"
        raise UsageProblem(message, "leave it out", code="other-problem")
    if is_path(given.problem):
        note_changing(problem, output)
    return problem


def _symplecticity(method: GarkMethod, run: LongRun, is_measured: bool) -> Symplecticity | None:
    from garkcli.longtime.symplecticity import (
        Symplecticity,
        holds,
        is_proved,
        symplecticity_defects,
    )
    from garkcli.problems.oscillator import Oscillator
    from garkcli.problems.righthandside import RightHandSide

    tableau = method.tableau
    if isinstance(run.problem, RightHandSide):
        return None
    if isinstance(run.problem, Oscillator):
        return Symplecticity(holds(tableau, method.tolerance))
    proved = is_proved(tableau, run.problem, method.tolerance)
    if not is_measured:
        return Symplecticity(proved)
    return Symplecticity(proved, symplecticity_defects(tableau, run.problem, run.step, run.states))


def _claims(run: LongRun, given: Energy) -> tuple[RunClaim, ...]:
    from garkcli.exact.display import decimal, to_float
    from garkcli.page.figures import measured
    from garkcli.report.energy import RunClaim

    claims = []
    if given.bounded:
        wrong = [x for x in run.invariants if x.verdict in DRIFTING]
        left = [x for x in run.invariants if x.verdict == "undecided"]
        found = ", ".join(f"{x.name} {x.verdict}" for x in (*wrong, *left))
        holds = False if wrong else None if left else True
        claims.append(RunClaim("bounded", found or "bounded", holds))
    limit = given.max_error
    if limit is not None:
        # the energy, or of what else is conserved the one with the largest error
        energy = run.energy or max(run.invariants, key=lambda x: x.max_error)
        is_met = None if isnan(energy.max_error) else energy.max_error <= to_float(limit)
        if run.is_unstable:
            is_met = False
        found_error = measured(energy.max_error, energy.round_off)
        claims.append(RunClaim(f"max-error: {decimal(limit)}", found_error, is_met))
    return tuple(claims)


def _in_modified(order: int, given: Energy, output: Output) -> int:
    from garkcli.api.problems import hamiltonian_for
    from garkcli.api.runs import modified_run
    from garkcli.report.modified_energy import REPORT, ModifiedEnergyReport

    method = given.method(given.file)
    if method.tolerance is not None:
        raise UsageProblem(
            "--modified: the order in it is shown for exact coefficients, not for rounded ones",
            "give exact coefficients, without tolerance",
            code="rounded",
        )
    try:
        solved = hamiltonian_for(given.problem, method.tableau, given.seed)
        run = modified_run(method, solved, order, given.t_end, given.step)
    except GarkError as error:
        return output.tell_failure(error, method.name, REPORT)
    output.tell(REPORT, ModifiedEnergyReport(method.name, run))
    if run.is_refuted:
        return 1
    return UNDECIDED if any(x.verdict == "undecided" for x in run.energies) else 0


@declared("modified", Modified, FORMATS)
def modified(given: Modified, output: Output) -> None:
    """The modified equation of a method, in trees, exactly.

    A step follows the exact solution of another equation. gark lists its coefficients, for a
    symplectic method those of the modified Hamiltonian in free trees, and the orders that they
    tell: of symplecticity, of energy, and the effective order, in the best coordinates.

    With --problem the modified Hamiltonian or equation itself.
    """
    from garkcli.api.runs import backward_analysis
    from garkcli.backward.series import possible_order
    from garkcli.methodfile.naming import called
    from garkcli.problems.builtin import check_seed
    from garkcli.report.modified import REPORT, ModifiedReport

    method = given.method(given.file)
    order, formula = given.order, None
    if given.problem is not None:
        check_seed(given.problem, given.seed)
        formula = _formula(method, given.problem, given)
        # the problem sees fewer trees than the tableau has
        order = possible_order(method.tableau, order)
    found = backward_analysis(method, order)
    report = ModifiedReport(
        called(given.file),
        method.name,
        found,
        method.derivation,
        given.digits,
        given.equation,
        formula,
    )
    output.stream(REPORT, report, given.document)


def _formula(method: GarkMethod, problem: str, given: Modified) -> ModifiedFormula:
    """UsageProblem for rounded coefficients, or if the problem is not Hamiltonian."""
    from garkcli.api.problems import hamiltonian_for
    from garkcli.api.runs import modified_formula

    if method.tolerance is not None:
        message = "--problem: a formula has exact coefficients, and those of the file are rounded"
        raise UsageProblem(message, "give exact coefficients, without tolerance", code="rounded")
    solved = hamiltonian_for(problem, method.tableau, given.seed)
    return modified_formula(method, solved, given.order).expanded()
