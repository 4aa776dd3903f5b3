"""``gark energy --modified``: what the command does then."""

from __future__ import annotations

from collections.abc import Mapping

from garkcli.cli.options import Output
from garkcli.cli.problems import find_hamiltonian
from garkcli.cli.stepping import given_positive, tell_failure
from garkcli.errors import GarkError, UsageProblem
from garkcli.tableau.garkmethod import GarkMethod


def measure_modified(
    method: GarkMethod,
    problem: str,
    seed: int | None,
    times: tuple[str | None, str | None],
    order: int,
    others: Mapping[str, object],
    output: Output,
) -> int:
    """Measure the energy error in the modified Hamiltonian, and return the exit code.

    Args:
        method: whose steps are taken.
        problem: a name or the path of a problem file.
        seed: of random problems.
        times: --t-end and --step, as they were written.
        order: of the largest trees.
        others: further options with their values, which do not go with --modified.
        output: where the report goes.

    Raises:
        UsageProblem: an option does not go with --modified, or the coefficients are rounded.
    """
    from garkcli.api.modified import modified_run
    from garkcli.report.modified_energy import REPORT, ModifiedEnergyReport

    for option, value in others.items():
        if value:
            raise UsageProblem(
                f"{option} does not go with --modified", "leave it out", code="options-clash"
            )
    t_end = given_positive("--t-end", times[0])
    longest = given_positive("--step", times[1])
    if method.tolerance is not None:
        raise UsageProblem(
            "--modified: the order in it is shown for exact coefficients, not for rounded ones",
            "give exact coefficients, without tolerance",
            code="rounded",
        )
    try:
        solved = find_hamiltonian(problem, method.tableau, seed)
        run = modified_run(method, solved, order, t_end, longest)
    except GarkError as error:
        return tell_failure(error, method.name, REPORT, output)
    output.tell(REPORT, [ModifiedEnergyReport(method.name, run)])
    return 1 if run.is_refuted else 0
