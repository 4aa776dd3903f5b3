"""``gark schema``."""

from __future__ import annotations

import json

import click

from garkcli.cli.options import CONTEXT, Output, common
from garkcli.errors import UsageProblem


@click.command("schema", context_settings=CONTEXT)
@click.option("--problem", is_flag=True, help="Of problem files, instead.")
@click.option(
    "--report", is_flag=True, help="Of the JSON that gark check writes, instead."
)
@common(["json"])
def command(problem: bool, report: bool, output: Output) -> int:
    """The JSON Schema (draft-07) of method files, for editors.

    With the YAML extension of an editor, name it in the first line of a method file:
    # yaml-language-server: $schema=gark.schema.json
    """
    from garkcli.methodfile.problem_schema import problem_file_schema
    from garkcli.methodfile.schema import method_file_schema
    from garkcli.report.check_schema import check_report_schema

    if problem and report:
        raise UsageProblem(
            "--problem and --report are two schemas", "ask for one at a time"
        )
    make = (
        problem_file_schema
        if problem
        else check_report_schema
        if report
        else method_file_schema
    )
    schema = make()
    output.write(json.dumps(schema, indent=2, ensure_ascii=False) + "\n")
    return 0
