"""``gark check``."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import click

from garkcli.cli.options import Output, declared, files_meant, refuse_settings_of_several
from garkcli.cli.project import Project, find_project
from garkcli.doing import counting
from garkcli.report.check_formats import FORMATS

if TYPE_CHECKING:
    from garkcli.check.baseline import Earlier
    from garkcli.check.outcome import Outcome


@declared("check", ["auto", *FORMATS])
def command(
    files: tuple[str, ...],
    explain: str | None,
    baseline: str | None,
    digits: int | None,
    settings: dict[str, str],
    output: Output,
    **options: Any,
) -> int:
    """Everything known about each method, and its claims.

    FILE is a method file, a directory (all *.gark.yaml below it), a pattern (in quotes, ** for any
    directories), or - for standard input.

    The exact order of the tableau, of its symplectic conjugate and of their pair, each with a tree
    whose condition fails next; B, C and D of every block and the bounds they give; consistency and
    symplecticity; the claims under `expect`. The format auto is github in GitHub Actions and text
    elsewhere.

    Without FILE the paths of .gark.toml, or of [tool.gark] in pyproject.toml, are meant; what else
    they say holds where no option says otherwise.

    Exit code: 0 every claim holds, 1 a claim fails, 2 a file cannot be read as a method.
    """
    if explain is not None:
        return _explain(explain, output)
    project = find_project()
    files = files or project.paths
    if not files:
        raise _no_file()
    _take_defaults(project, options, output)
    earlier = None
    if baseline is not None:
        from garkcli.check.baseline import read_baseline

        earlier = read_baseline(baseline)
    wanted = Wanted(needed=project.needed, **options)
    outcomes = _outcomes(files, settings, wanted, output)
    if earlier is not None:
        return _compare(outcomes, earlier, output)
    chosen = _format(output)
    render = FORMATS[chosen]
    report = render(outcomes, output.paint, output.verbosity, digits, output.width)
    output.write(report, chosen)
    return max(outcome.exit_code for outcome in outcomes)


@dataclass(frozen=True)
class Wanted:
    """What is found of each file, by the names of the options.

    Attributes:
        max_order: where the search for orders stops.
        error_constants: whether the norms of the principal error are found.
        wants_properties: whether every property is told, not only those that are claimed.
        require_claims: whether a file without a claim fails.
        jobs: how many files at a time; 0 for as many as there are processors.
        needed: claims without which a file fails.
    """

    max_order: int
    error_constants: bool
    wants_properties: bool
    require_claims: bool
    jobs: int
    needed: tuple[str, ...] = ()


def _take_defaults(project: Project, options: dict[str, Any], output: Output) -> None:
    """What the project says in place of options that are not given."""
    source = click.get_current_context().get_parameter_source
    for name, value in project.defaults.items():
        if source(name) is not click.core.ParameterSource.DEFAULT:
            continue
        if name == "format":
            output.format = value
        else:
            options[name] = value
    options["require_claims"] |= project.require_claims


def _outcomes(
    files: tuple[str, ...], settings: Mapping[str, str], wanted: Wanted, output: Output
) -> list[Outcome]:
    """The outcome of each file that is meant, in order."""
    from garkcli.cli.parallel import check_files

    paths = files_meant(files, output)
    refuse_settings_of_several(settings, paths)
    jobs = wanted.jobs or os.cpu_count() or 1
    running = check_files(paths, wanted.max_order, wanted.error_constants, jobs, settings)
    outcomes = counting("files", running, len(paths))
    return [_as_wanted(outcome, wanted) for outcome in outcomes]


def _as_wanted(outcome: Outcome, wanted: Wanted) -> Outcome:
    """The outcome with what it is to tell, and what fails it."""
    return replace(
        outcome,
        needs_claims=wanted.require_claims,
        needed=wanted.needed,
        wants_properties=wanted.wants_properties,
    )


def _compare(outcomes: Sequence[Outcome], earlier: Earlier, output: Output) -> int:
    """Write what is worse than in an earlier report."""
    from garkcli.check.baseline import regressions
    from garkcli.report import check_baseline
    from garkcli.report.checked import REPORT

    worse = regressions(REPORT.document(outcomes), earlier)
    output.write(check_baseline.render(worse, len(outcomes)))
    return int(bool(worse))


def _no_file() -> click.MissingParameter:
    """What click says where a required argument is missing."""
    return click.MissingParameter(
        ctx=click.get_current_context(), param_hint="'FILE...'", param_type="argument"
    )


def _explain(key: str, output: Output) -> int:
    """Write what a claim means."""
    from garkcli.check.meanings import claim_meaning
    from garkcli.report.meaning import REPORT, told
    from garkcli.tell.report import FORMATS

    if output.format not in FORMATS:
        output.format = "text"
    output.tell(REPORT, told(key, [claim_meaning(key)]))
    return 0


def _format(output: Output) -> str:
    """The format asked for; auto is what suits where the command runs."""
    if output.format != "auto":
        return output.format
    return "github" if os.environ.get("GITHUB_ACTIONS") == "true" else "text"
