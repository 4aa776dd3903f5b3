"""``gark schema``."""

from __future__ import annotations

import json
from typing import Any

import click

from garkcli.cli.options import CONTEXT, Output, common
from garkcli.errors import UsageProblem


def _reports(
    context: click.Context,  # noqa: ARG001 -- what click gives
    option: click.Parameter,  # noqa: ARG001
    beginning: str,
) -> list[str]:
    """The reports that begin so, for completion in the shell."""
    from garkcli.report.schemas import REPORTS

    return [name for name in REPORTS if name.startswith(beginning)]


@click.command("schema", context_settings=CONTEXT)
@click.option("--problem", is_flag=True, help="Of problem files, instead.")
@click.option("--sweep", is_flag=True, help="Of spec files of gark sweep, instead.")
@click.option(
    "--report",
    is_flag=False,
    flag_value="check",
    metavar="[COMMAND]",
    shell_complete=_reports,
    help="Of what a command writes with --format json, instead; gark check where none is named.",
)
@common(["json"])
def command(problem: bool, sweep: bool, report: str | None, output: Output) -> int:
    """The JSON Schema (draft-07) of method files, for editors; or of problem files, or of reports.

    With the YAML extension of an editor, name it in the first line of a method file:
    # yaml-language-server: $schema=gark.schema.json
    """
    asked = {"--problem": problem, "--sweep": sweep, "--report": report is not None}
    named = [name for name, is_asked in asked.items() if is_asked]
    if len(named) > 1:
        raise UsageProblem(
            f"{' and '.join(named)} are {len(named)} schemas", "ask for one at a time"
        )
    schema = _sweep_schema() if sweep else _schema(problem, report)
    output.write(json.dumps(schema, indent=2, ensure_ascii=False) + "\n")
    return 0


def _schema(of_problems: bool, report: str | None) -> dict[str, Any]:
    if report is not None:
        from garkcli.report.schemas import report_schema

        return report_schema(report)
    if of_problems:
        from garkcli.methodfile.problem_schema import problem_file_schema

        return problem_file_schema()
    from garkcli.methodfile.schema import method_file_schema

    return method_file_schema()


def _sweep_schema() -> dict[str, Any]:
    from garkcli.sweep.load import sweep_schema

    return sweep_schema()
