"""``gark schema``."""

from __future__ import annotations

import json
from typing import Any

from garkcli.cli.options import Output, declared
from garkcli.errors import UsageProblem


@declared("schema", ["json"])
def command(problem: bool, sweep: bool, report: str | None, output: Output) -> int:
    """The JSON Schema (draft-07) of method files, for editors; or of problem files, or of reports.

    With the YAML extension of an editor, name it in the first line of a method file:
    # yaml-language-server: $schema=gark.schema.json
    """
    asked = {"--problem": problem, "--sweep": sweep, "--report": report is not None}
    named = [name for name, is_asked in asked.items() if is_asked]
    if len(named) > 1:
        raise UsageProblem(
            f"{' and '.join(named)} are {len(named)} schemas",
            "ask for one at a time",
            code="options-clash",
        )
    schema = _sweep_schema() if sweep else _schema(problem, report)
    output.write(json.dumps(schema, indent=2, ensure_ascii=False) + "\n")
    return 0


def _schema(of_problems: bool, report: str | None) -> dict[str, Any]:
    if report is not None:
        from garkcli.report.schemas import report_schema

        return report_schema(report)
    if of_problems:
        from garkcli.methodfile.problem_keys import problem_file_schema

        return problem_file_schema()
    from garkcli.methodfile.file_keys import method_file_schema

    return method_file_schema()


def _sweep_schema() -> dict[str, Any]:
    from garkcli.sweep.plan import sweep_schema

    return sweep_schema()
