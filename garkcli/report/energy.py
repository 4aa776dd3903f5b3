"""``gark energy``: conserved quantities over a long time, as text, JSON or CSV."""

from __future__ import annotations

import csv
import io
from math import isnan

from garkcli.longtime.history import LongRun
from garkcli.page.paint import Paint
from garkcli.page.plain import csv_cell
from garkcli.report.energy_text import Report, text_of
from garkcli.report.fault_json import Failure


def render(report: Report, format: str, paint: Paint, is_long: bool = True) -> str:
    """The report as text, JSON or CSV; see ``text_of``."""
    if format == "json":
        from garkcli.report.energy_json import json_of

        return json_of(report)
    if format == "csv":
        return _csv(report.run)
    return "\n".join(text_of(report, paint, is_long)) + "\n"


def render_failure(failure: Failure, format: str) -> str:
    """A run that has no result, for programs: its errors, or a table without rows. People are told
    elsewhere.
    """
    if format == "json":
        from garkcli.report.energy_json import json_of_failure

        return json_of_failure(failure)
    return "t\n" if format == "csv" else ""


def _csv(run: LongRun) -> str:
    stream = io.StringIO()
    writer = csv.writer(stream, lineterminator="\n")
    names = [csv_cell(history.name.replace(" ", "_")) for history in run.invariants]
    writer.writerow(["t", *(f"{name}_error" for name in names)])
    columns = [history.errors for history in run.invariants]
    for t, *errors in zip(run.times, *columns, strict=True):
        # an invariant without a value has an empty cell
        writer.writerow([repr(t), *("" if isnan(x) else repr(x) for x in errors)])
    return stream.getvalue()
