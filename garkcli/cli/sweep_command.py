"""``gark sweep``."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from garkcli.cli.options import Output, declared
from garkcli.doing import doing
from garkcli.tell.report import FORMATS

if TYPE_CHECKING:
    from garkcli.sweep.plan import Plan
    from garkcli.sweep.run import Progress


@declared("sweep", [*FORMATS, "jsonl", "csv"])
def command(
    spec: str,
    rows: str | None,
    resume: bool,
    jobs: int,
    scheduler: str,
    top: int,
    parquet: str | None,
    plot: str | None,
    output: Output,
) -> int:
    """Many methods side by side: families, stages, transfer rules, values of parameters.

    SPEC says which, which criteria are told of each, which methods are kept, and what is better;
    see docs/sweep.md. Each criterion is decided exactly, as gark check and gark stability do. The
    rows are written one by one: a sweep that is ended at any moment goes on with --resume.
    """
    from garkcli.report.sweep import REPORT, SweepReport, json_lines, refuse_parquet, write_parquet
    from garkcli.sweep.plan import load_plan
    from garkcli.sweep.run import sweep
    from garkcli.sweep.store import RowStore

    plan = load_plan(spec)
    if plot is not None:
        _refuse_plot(plan, plot)
    if parquet is not None:
        refuse_parquet(parquet)
    path = rows if rows is not None else str(Path(spec).with_suffix(".jsonl"))
    with RowStore(path, resume) as store:
        with doing("methods") as work:
            for last in sweep(plan, store, jobs, scheduler):
                work.total = last.total
                work.reach(last.before + last.done)
        report = SweepReport(spec, plan, store.rows, top)
    _tell(last, path, output)
    if output.format == "jsonl":
        output.write(json_lines(report))
    else:
        verbosity = max(output.verbosity, 0)  # what -q leaves out is on stderr
        text = REPORT.render([report], output.format, output.paint, verbosity, width=output.width)
        output.write(text)
    if parquet is not None:
        write_parquet(report, parquet)
    if plot is not None:
        from garkcli.plots.saving import save_scene
        from garkcli.plots.sweep import sweep_scene

        save_scene(sweep_scene(report, *plan.pareto[:2]), Path(plot))
    return 0


def _refuse_plot(plan: Plan, path: str) -> None:
    """Refuse a plot without axes or without a place, before the work is done."""
    from garkcli.errors import UsageProblem
    from garkcli.plots.saving import check_suffix

    if len(plan.pareto) < 2:
        raise UsageProblem(
            "--plot needs two columns",
            "write pareto: [error, stages] into the spec",
            code="option-alone",
        )
    check_suffix(Path(path))


def _tell(progress: Progress, path: str, output: Output) -> None:
    before = f", {progress.before} were there" if progress.before else ""
    output.note(f"{progress.done} rows added to {path}{before}")
    if output.verbosity > 0:
        output.note(f"processor time of the methods: {progress.seconds:.2f} s")
