"""``gark check``: many files in parallel, with the same outcome as one after the other."""

from __future__ import annotations

import os
import sys
from collections.abc import Callable, Iterator
from functools import partial

import click

from garkcli.check.check_file import check_file
from garkcli.check.outcome import Outcome
from garkcli.cli import options as opt
from garkcli.cli.command import declared
from garkcli.cli.endings import settled
from garkcli.cli.output import Output
from garkcli.cli.project import Project, find_project
from garkcli.crew.hiring import hired
from garkcli.crew.work import in_order
from garkcli.doing import counting, doing
from garkcli.errors import Remark
from garkcli.files import is_stream
from garkcli.frozen import replace
from garkcli.report.check_formats import FORMATS


class Check(opt.WithSettings):
    files: tuple[str, ...] = opt.arguments_of("[FILE...]", opt.METHOD)
    max_order: int | None = opt.option(
        "--max-order", opt.number("N", 1, 400), of="check_file.limit", heading="Report"
    )
    error_constants: bool = opt.flag("--error-constants", of="check_file.want_constants")
    properties: bool = opt.flag("--properties", "List every property with its reason.")
    digits: int | None = opt.DIGITS
    require_claims: bool = opt.flag(
        "--require-claims", "Fail a file without claims under `expect`.", heading="In CI"
    )
    baseline: str | None = opt.option(
        "--baseline",
        opt.input_file("REPORT"),
        "Fail only if something got worse since an earlier JSON report.",
    )
    jobs: int = opt.preset("-j --jobs", opt.workers(256), 1, opt.JOBS_HELP)
    explain: str | None = opt.option("--explain", opt.text("KEY"), is_former=True)


@declared("check", Check, ["auto", *FORMATS])
def check(given: Check, output: Output) -> int:
    """Order and properties of each method, and whether its claims hold.

    Without FILE the paths of .gark.toml, or of [tool.gark] in pyproject.toml, are checked with the
    options there.

    The exact order of the tableau, of its symplectic conjugate and of their pair, each with a tree
    whose condition fails next; B, C and D of every block with the bounds they give; consistency and
    symplecticity; the claims under `expect`. The format auto is github in GitHub Actions and text
    elsewhere.

    Exit code: 0 every claim holds, 1 a claim fails, 2 a file cannot be read as a method, 3 a claim
    is undecided.
    """
    if given.explain is not None:
        return _explain(given.explain, output)
    project = find_project()
    given = replace(given, files=given.files or project.paths)
    if not given.files:
        raise click.MissingParameter(
            ctx=click.get_current_context(), param_hint="'FILE...'", param_type="argument"
        )
    # what the project says in place of options that are not given
    source = click.get_current_context().get_parameter_source
    for name, value in project.defaults.items():
        is_said = name == "format" and output.is_by_ending
        if source(name) is click.core.ParameterSource.DEFAULT and not is_said:
            if name == "format":
                output.format = value
            else:
                given = replace(given, **{name: value})
    if given.baseline is not None:
        if output.path is not None:
            settled(output.path, ["text"])
        return _compare(project, given, given.baseline, output)
    outcomes = _outcomes(project, given, output)
    output.suit()
    text = ""
    # where all is well and nobody wants to hear it, what would tell is not even imported
    if output.format != "text" or output.verbosity >= 0 or not all(x.ok for x in outcomes):
        render = FORMATS[output.format]
        text = render(outcomes, output.look, output.verbosity, given.digits, output.width)
    output.write(text)
    return max(outcome.exit_code for outcome in outcomes)


def _explain(word: str, output: Output) -> int:
    from garkcli.cli.looking_up import tell_meaning
    from garkcli.tell.report import FORMATS as TOLD

    if output.format not in TOLD:
        output.format = (output.path and settled(output.path, TOLD)) or "text"
    tell_meaning(word, output)
    return 0


def _compare(project: Project, given: Check, baseline: str, output: Output) -> int:
    """Writes what is worse than in an earlier report; returns 1 if anything is."""
    from garkcli.check.baseline import read_baseline, regressions
    from garkcli.report.check_findings import baseline_text
    from garkcli.report.checked import REPORT

    earlier = read_baseline(baseline)
    outcomes = _outcomes(project, given, output)
    worse = regressions(REPORT.document(outcomes), earlier)
    output.write(baseline_text(worse, len(outcomes)))
    return int(bool(worse))


def _outcomes(project: Project, given: Check, output: Output) -> list[Outcome]:
    paths = output.files_meant(given.files, given.settings)
    work = partial(check_file, **given.of("check_file"), settings=given.settings)
    running = counting("files", check_files(work, paths, given.jobs), len(paths))
    return [
        replace(
            outcome,
            needs_claims=given.require_claims or project.require_claims,
            needed=project.needed,
            wants_properties=given.properties,
        )
        for outcome in running
    ]


def check_files(check: Callable[[str], Outcome], paths: list[str], jobs: int) -> Iterator[Outcome]:
    """Yields outcomes in order, by ``jobs`` processes, 0 for one per processor. A file that ends
    its worker has an outcome that says so.
    """
    jobs = min(jobs or os.cpu_count() or 1, len(paths))
    if any(map(is_stream, paths)):
        jobs = 1  # standard input is this process's, and so are other streams
    with hired(partial(_checked, check), _ended, jobs) as workers:
        yield from in_order(workers, paths)


def _checked(check: Callable[[str], Outcome], path: str) -> Outcome:
    try:
        with doing(path):
            return check(path)
    except Exception as error:
        if "--debug" in sys.argv:
            raise
        what = f"{type(error).__name__}: {error}".splitlines()[0][:200]
        return _crashed(
            path, f"internal fault: {what}", "please report it, with the file", "internal-fault"
        )


def _crashed(path: str, what: str, cure: str, code: str) -> Outcome:
    return Outcome(path, path, faults=(Remark(what, cure, code=code),), is_crash=True)


def _ended(path: str, why: str) -> Outcome:
    cure = "check it alone; where memory is short use fewer --jobs"
    return _crashed(path, f"its check was ended {why}", cure, "worker-lost")
