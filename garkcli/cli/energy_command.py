"""``gark energy``."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from garkcli.cli.companion import companion, exact_companion
from garkcli.cli.long_runs import Wanted, check_wanted, followed, problem_of, symplecticity_of
from garkcli.cli.options import Output, declared, save_plot
from garkcli.cli.stepping import given_positive, tell_failure
from garkcli.errors import GarkError
from garkcli.tell.report import FORMATS

if TYPE_CHECKING:
    from flint import fmpq

    from garkcli.longtime.history import LongRun
    from garkcli.report.energy import Claim


NOT_BOUNDED = frozenset({"drifts", "unstable", "undecided"})
"""Verdicts that do not meet ``--bounded``."""


@declared("energy", [*FORMATS, "csv"])
def command(settings: dict[str, str], output: Output, **options: Any) -> int:
    """The energy error over a long time, and that of every other invariant: does it drift?

    A drift is told from the oscillation around it by a fit, and has an uncertainty. The step map of
    the oscillator is linear: there the energy error has no rounding, and whether it is bounded for
    all time is decided exactly. The other problems are stepped in floats with compensated
    summation, or with --digits. The method of FILE steps as it is given, its symplectic pair with
    --pair.

    A drift that a slow modulation may explain is undecided, and a longer run proposed.

    Exit code 1 when the claim of --bounded or --max-error fails, a step fails, or the energy blows
    up or the orbit escapes. What is undecided does not meet --bounded.

    With --modified the energy error over step sizes, of H and of its modified Hamiltonian, cut off
    after each power of h: it has the order of the next one. Exit code 1 where it has a lower order.
    """
    from garkcli.methodfile.load import load
    from garkcli.report.energy import REPORT, EnergyReport

    wanted = Wanted(**options)
    check_wanted(wanted)
    if wanted.modified is not None:
        return _in_modified(wanted, wanted.modified, settings, output)
    limit = given_positive("--max-error", wanted.max_error)
    time = given_positive("--t-end", wanted.t_end)
    step = given_positive("--step", wanted.step)
    name = wanted.file
    try:
        method = companion(load(wanted.file, settings), wanted.which)
        name = method.name
        problem = problem_of(method.tableau, wanted, output)
        run = followed(method, problem, time, step, wanted)
        steps = symplecticity_of(method, run, wanted.symplecticity)
    except GarkError as error:
        return tell_failure(error, name, REPORT, output)
    claims = _claims(run, wanted.bounded, limit)
    output.tell(REPORT, [EnergyReport(method.name, run, steps, claims)])
    if wanted.plot is not None:
        from garkcli.plots.energy import energy_scene

        save_plot(energy_scene(run), wanted.plot, output)
    is_met = all(claim.holds for claim in claims)
    return 0 if is_met and not run.is_unstable else 1


def _in_modified(wanted: Wanted, order: int, settings: Mapping[str, str], output: Output) -> int:
    """The energy error in the modified Hamiltonian."""
    from garkcli.cli.modified_energy import measure_modified
    from garkcli.methodfile.load import load

    others = {
        "--omega": wanted.omega,
        "--split": wanted.split,
        "--stiffness": wanted.stiffness,
        "--digits": wanted.digits,
        "--symplecticity": wanted.symplecticity,
        "--bounded": wanted.bounded,
        "--max-error": wanted.max_error,
        "--plot": wanted.plot,
    }
    times = wanted.t_end, wanted.step
    method = exact_companion(load(wanted.file, settings), wanted.which)
    return measure_modified(method, wanted.problem, wanted.seed, times, order, others, output)


def _claims(run: LongRun, bounded: bool, limit: fmpq | None) -> tuple[Claim, ...]:
    """What the options claim. What is undecided is not shown to be bounded."""
    from garkcli.exact.display import decimal, to_float
    from garkcli.page.figures import measured
    from garkcli.report.energy import Claim

    claims = []
    if bounded:
        wrong = [x for x in run.invariants if x.verdict in NOT_BOUNDED]
        found = ", ".join(f"{x.name} {x.verdict}" for x in wrong)
        claims.append(Claim("bounded", found or "bounded", not wrong))
    if limit is not None:
        # the energy, or of what else is conserved the one with the largest error
        energy = run.energy or max(run.invariants, key=lambda x: x.max_error)
        holds = not run.is_unstable and energy.max_error <= to_float(limit)
        found_error = measured(energy.max_error, energy.round_off)
        claims.append(Claim(f"max-error: {decimal(limit)}", found_error, holds))
    return tuple(claims)
