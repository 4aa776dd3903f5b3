"""``gark converge``."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from garkcli.cli.companion import companion
from garkcli.cli.converging import Problems, Wanted, compared, hint_rounding, tested
from garkcli.cli.options import (
    Output,
    check_plot,
    declared,
    files_meant,
    refuse_settings_of_several,
    save_plot,
)
from garkcli.cli.problems import note_changing
from garkcli.cli.stepping import given_positive, positive, refuse_misplaced, tell_failure
from garkcli.errors import GarkError, UsageProblem
from garkcli.tell.report import FORMATS

if TYPE_CHECKING:
    from garkcli.convergence.result import Convergence
    from garkcli.plots.scene import Scene
    from garkcli.report.comparison import Entry


@declared("converge", [*FORMATS, "csv"])
def command(
    files: tuple[str, ...], settings: dict[str, str], output: Output, **options: Any
) -> int:
    """The convergence test: errors over step sizes, observed against predicted order, energy error.

    Steps are taken with as many digits as the errors need, so that a method of order 12 shows slope
    12 and not rounding; the step map of the oscillator is linear and taken exactly. Without
    --problem it is generic, or its counterpart for separable, semi-separable and Nyström methods:
    these see every tree, others may show a higher order than the method has.

    The method of FILE steps as it is given, whatever form it has; its symplectic pair with --pair.

    Several FILEs, directories (all *.gark.yaml below them) or patterns are compared, in one table
    and one plot. With --work they are compared by what their errors cost.

    Exit code: 0 every observed order is the one the method has on this problem, 1 one is not, or a
    step fails, 2 a file cannot be read, or its method is not for this problem, 3 one is undecided:
    no order is seen.
    """
    paths = files_meant(files, output)
    refuse_settings_of_several(settings, paths)
    asked = Asked(**options)
    _check(asked)
    wanted = _wanted(asked)
    against = asked.against or ("evaluations" if asked.work else "h")
    shown = Shown(asked.work, against, asked.plot)
    if len(paths) == 1:
        return _one(paths[0], settings, wanted, shown, output)
    return _several(paths, wanted, shown, output)


@dataclass(frozen=True)
class Asked:
    """What the options say, by their names; None where they were not given."""

    which: str | None
    problem: str | None
    omega: str | None
    split: str | None
    seed: int | None
    stiffness: str | None
    t_end: str | None
    steps: str | None
    work: bool
    against: str | None
    plot: str | None

    @property
    def named(self) -> str | None:
        """The problem, also where an option says which one it is."""
        is_oscillator = self.omega or self.split
        if self.problem is None and is_oscillator:
            return "oscillator"
        return self.problem


def _check(asked: Asked) -> None:
    """Refuse options that do not go together, before anything is read.

    Raises:
        UsageProblem: two of them do not.
    """
    if asked.named is not None:
        of_oscillator = {"--omega": asked.omega, "--split": asked.split}
        refuse_misplaced(asked.named, asked.seed, asked.stiffness, of_oscillator)
    elif asked.stiffness is not None:
        raise UsageProblem(
            "--stiffness is for a problem that has one",
            "name it with --problem, such as --problem van-der-pol",
            code="other-problem",
        )
    if asked.omega:
        positive("--omega", asked.omega)
    if asked.against not in (None, "h") and not asked.work:
        option = f"--against {asked.against}"
        message = f"{option} is not known without measuring it"
        raise UsageProblem(message, "add --work", code="other-problem")
    check_plot(asked.plot)


def _wanted(asked: Asked) -> Wanted:
    """What to test on."""
    t_end = given_positive("--t-end", asked.t_end)
    steps = None
    if asked.steps is not None:
        steps = tuple(positive("--steps", h) for h in asked.steps.split(","))
    return Wanted(
        asked.which,
        asked.named,
        asked.omega,
        asked.split,
        asked.seed,
        given_positive("--stiffness", asked.stiffness),
        t_end,
        steps,
        asked.work,
    )


@dataclass(frozen=True)
class Shown:
    """What of the results is shown.

    Attributes:
        work: whether costs are.
        against: the horizontal axis of plots.
        plot: the file to draw into, if any.
    """

    work: bool
    against: str
    plot: str | None


def _one(
    path: str, settings: Mapping[str, str], wanted: Wanted, shown: Shown, output: Output
) -> int:
    """The test of one method."""
    from garkcli.methodfile.load import load
    from garkcli.report.convergence import REPORT, ConvergenceReport

    name = path
    try:
        problems = Problems(wanted)
        method = companion(load(path, settings), wanted.which)
        name = method.name
        problems.prepare([method.tableau])
        if problems.read is not None:
            note_changing(problems.read, output)
        result = tested(method, wanted, problems)
    except GarkError as error:
        return tell_failure(error, name, REPORT, output)
    output.tell(REPORT, [ConvergenceReport(result, method.name, shown.work, shown.against)])
    hint_rounding(method, result, output)
    if shown.plot is not None:
        save_plot(_scene(result, method.name, shown), shown.plot, output)
    return result.exit_code


def _scene(result: Convergence, name: str, shown: Shown) -> Scene:
    """The errors of one method: over step sizes with their slopes, or over their costs."""
    from garkcli.plots.convergence import comparison_scene, convergence_scene

    if shown.against == "h" and not shown.work:
        return convergence_scene(result, name)
    return comparison_scene([(name, result)], shown.against)


def _several(paths: list[str], wanted: Wanted, shown: Shown, output: Output) -> int:
    """The comparison; what fails is told, and stops nothing."""
    from garkcli.report.comparison import REPORT, Compared

    entries = compared(paths, wanted, output)
    output.tell(REPORT, [Compared(entries, shown.work, shown.against)])
    if shown.plot is not None:
        _draw(entries, shown.plot, shown.against, output)
    return max(entry.exit_code for entry in entries)


def _draw(entries: list[Entry], path: str, against: str, output: Output) -> None:
    """The results in one figure, unless every test failed."""
    results = [(x.name, x.result) for x in entries if x.result is not None]
    if not results:
        output.note(f"nothing to draw into {path}")
        return
    from garkcli.plots.convergence import comparison_scene

    save_plot(comparison_scene(results, against), path, output)
