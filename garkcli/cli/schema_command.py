"""``gark schema``."""

from __future__ import annotations

import json

import click

from garkcli.cli.options import CONTEXT, Output, common


@click.command("schema", context_settings=CONTEXT)
@click.option("--report", is_flag=True, help="Of the JSON that gark check writes, instead.")
@common(["json"])
def command(report: bool, output: Output) -> int:
    """The JSON Schema (draft-07) of method files, for editors.

    With the YAML extension of an editor, name it in the first line of a method file:
    # yaml-language-server: $schema=gark.schema.json
    """
    from garkcli.methodfile.schema import method_file_schema
    from garkcli.report.check_schema import check_report_schema

    schema = check_report_schema() if report else method_file_schema()
    output.write(json.dumps(schema, indent=2, ensure_ascii=False) + "\n")
    return 0
