"""``gark check``."""

from __future__ import annotations

import os
from collections.abc import Sequence
from typing import TYPE_CHECKING

import click

from garkcli.cli.options import CONTEXT, PATH, Output, common

if TYPE_CHECKING:
    from garkcli.check.outcome import Outcome

FORMATS = ["auto", "text", "json", "sarif", "junit", "github", "markdown"]


@click.command("check", context_settings=CONTEXT)
@click.argument("files", nargs=-1, required=True, type=PATH, metavar="FILE...")
@click.option(
    "--max-order",
    type=click.IntRange(1, 400),
    default=60,
    show_default=True,
    metavar="N",
    help="Where the search for orders stops; then the order is a lower bound.",
)
@click.option(
    "--error-constants",
    is_flag=True,
    help="The norms of the principal error coefficients, over all trees of the first failing order.",
)
@click.option(
    "--baseline",
    type=PATH,
    metavar="REPORT",
    help="Fail only on what is worse than in an earlier JSON report.",
)
@click.option(
    "-j",
    "--jobs",
    type=click.IntRange(0, 256),
    default=1,
    show_default=True,
    metavar="N",
    help="Check N files at a time; 0 for as many as there are processors.",
)
@common(FORMATS)
def command(
    files: tuple[str, ...],
    max_order: int,
    error_constants: bool,
    baseline: str | None,
    jobs: int,
    output: Output,
) -> int:
    """Everything known about each method, and its claims.

    FILE is a method file, a directory (all *.gark.yaml below it), a pattern (in quotes, ** for any
    directories), or - for standard input.

    The exact order of the tableau, of its symplectic conjugate and of their pair, each with a tree
    whose condition fails next; B, C and D of every block and the bound they give; consistency and
    symplecticity; the claims under `expect`. The format auto is github in GitHub Actions and text
    elsewhere.

    Exit code: 0 every claim holds, 1 a claim fails, 2 a file cannot be read as a method.
    """
    from garkcli.cli.parallel import check_files
    from garkcli.methodfile.finding import find_files
    from garkcli.report.progress import tracked

    earlier = None
    if baseline is not None:
        from garkcli.check.baseline import read_baseline

        earlier = read_baseline(baseline)
    paths = list(find_files(files))
    running = check_files(paths, max_order, error_constants, jobs or os.cpu_count() or 1)
    outcomes = list(tracked(running, len(paths), "checking", output.verbosity >= 0))
    if earlier is not None:
        from garkcli.check.baseline import regressions
        from garkcli.report import check_baseline
        from garkcli.report.check_json import as_data

        worse = regressions(as_data(outcomes), earlier)
        output.write(check_baseline.render(worse, len(outcomes)))
        return int(bool(worse))
    output.write(_rendered(outcomes, output))
    return max(outcome.exit_code for outcome in outcomes)


def _rendered(outcomes: Sequence[Outcome], output: Output) -> str:
    """The report in the format asked for."""
    format = output.format  # noqa: A001 -- the option's name
    if format == "auto":
        format = "github" if os.environ.get("GITHUB_ACTIONS") == "true" else "text"  # noqa: A001
    if format == "text":
        from garkcli.report import check_text

        return check_text.render(outcomes, output.paint, output.verbosity)
    from importlib import import_module

    text: str = import_module(f"garkcli.report.check_{format}").render(outcomes)
    return text
