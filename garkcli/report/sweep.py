"""``gark sweep`` as text, JSON, JSON lines, CSV and Parquet."""

from __future__ import annotations

import csv
import io
import json
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from textwrap import wrap
from typing import Any

from garkcli.errors import UsageProblem, counted
from garkcli.page.json_text import to_json
from garkcli.page.plain import printable
from garkcli.page.schema import COUNT, FLAG, TEXT, Schema, array, published
from garkcli.sweep.columns import Value, columns
from garkcli.sweep.plan import Plan
from garkcli.sweep.ranking import best_first, distinct, kept, pareto_front
from garkcli.sweep.row import Row

SCHEMA = "gark/sweep/1"
WORDS = {"exact": "exact", "exists": "proved to exist", "numerical": "numerical"}
"""What is known of a find, as rows and as people have it."""
FOUND = ("seed", "proof", "values")
"""What tables have of finds beside the criteria."""


@dataclass(frozen=True)
class SweepReport:
    """What is told of a sweep.

    Attributes:
        source: the spec file.
        plan: the sweep.
        rows: all rows.
        top: how many of the best are shown in texts.
    """

    source: str
    plan: Plan
    rows: Mapping[str, Row]
    top: int

    @property
    def done(self) -> list[Row]:
        """The rows of this sweep, in its order."""
        keys = (point.key for point in self.plan.points())
        return [self.rows[key] for key in keys if key in self.rows]

    @cached_property
    def kept(self) -> list[Row]:
        """The rows that are kept, one of each method that was found several times."""
        return distinct(kept(self.done))

    @property
    def repeated(self) -> int:
        """How many more of the kept rows have a method that another has."""
        return len(kept(self.done)) - len(self.kept)

    @property
    def best(self) -> list[Row]:
        """The kept rows, best first."""
        found = self.kept
        return best_first(found, self.plan.best) if self.plan.best else found

    @property
    def front(self) -> list[Row]:
        """The Pareto front."""
        return pareto_front(self.kept, self.plan.pareto)

    @property
    def failed(self) -> list[Row]:
        """The rows of methods that could not be made."""
        return [row for row in self.done if "failure" in row]

    def __repr__(self) -> str:
        return f"<SweepReport {self.source}: {counted(len(self.done), 'row')}>"


def render_text(report: SweepReport, width: int) -> str:
    """The best methods and the front, for people."""
    plan, best, failed = report.plan, report.best, report.failed
    found = f"{counted(len(plan), 'method')}, {len(best)} kept"
    if report.repeated:
        found += f", {report.repeated} found again"
    lines = [f"{printable(plan.name)}: {found}"]
    if failed:
        reason = printable(str(failed[0]["failure"]))
        text = f"{len(failed)} cannot be made, the first: {reason}"
        lines += wrap(text, width, initial_indent="  ", subsequent_indent="    ")
    if best:
        by = f", best by {', '.join(plan.best)}" if plan.best else ""
        shown = best[: report.top]
        of = f"{len(shown)} of them" if len(shown) < len(best) else "all of them"
        lines += ["", f"  {of}{by}"]
        lines += _entries(plan, shown, width)
    if plan.pareto:
        front = report.front
        lines += ["", f"  Pareto front of {', '.join(plan.pareto)}: {len(front)}"]
        lines += _entries(plan, front[: report.top], width)
    return "\n".join(lines) + "\n"


def _entries(plan: Plan, rows: Sequence[Row], width: int) -> Iterator[str]:
    for number, row in enumerate(rows, start=1):
        head = f"{number:>5}  "
        key = printable(str(row["key"]))
        yield from wrap(key, width, initial_indent=head, subsequent_indent=" " * 9)
        values = [f"{name} {_shown(row, name)}" for name in plan.criteria.columns]
        lines = [", ".join(values)]
        if "proof" in row:
            word = WORDS[str(row["proof"])]
            lines.insert(0, f"{word}: {_values(row)}")
        for line in lines:
            yield from wrap(
                line,
                width,
                initial_indent=" " * 9,
                subsequent_indent=" " * 9,
                break_on_hyphens=False,
            )


def _values(row: Row) -> str:
    """The values of the unknowns that were found."""
    values = row["values"]
    assert isinstance(values, dict)
    return ", ".join(f"{name} = {value}" for name, value in values.items())


def _shown(row: Row, name: str) -> str:
    value = row.get(name)
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, float):
        return f"{value:.6g}"
    return "-" if value is None else str(value)


def render_json(report: SweepReport) -> str:
    """The best methods and the front, for programs."""
    plan = report.plan
    data = {
        "schema": SCHEMA,
        "file": report.source,
        "name": plan.name,
        "methods": len(plan),
        "kept": len(report.best),
        "repeated": report.repeated,
        "failed": len(report.failed),
        "columns": list(plan.criteria.columns),
        "best": report.best[: report.top],
        "pareto": report.front if plan.pareto else [],
    }
    return to_json(data) + "\n"


def render_lines(report: SweepReport) -> str:
    """The kept rows as JSON lines, best first."""
    return "".join(f"{json.dumps(row, ensure_ascii=False)}\n" for row in report.best)


def render_csv(report: SweepReport) -> str:
    """The kept rows, best first."""
    out = io.StringIO()
    names = _flat_names(report.plan)
    writer = csv.DictWriter(out, names, lineterminator="\n")
    writer.writeheader()
    for row in report.best:
        flat = _flat(report.plan, row)
        writer.writerow({name: _cell(flat[name]) for name in names})
    return out.getvalue()


def _flat_names(plan: Plan) -> list[str]:
    names = ["key", "method", *plan.grids]
    if plan.has_searches:
        names += FOUND
    return [*names, *plan.criteria.columns]


def _flat(plan: Plan, row: Row) -> dict[str, Value]:
    """A row without nesting."""
    settings = row["parameters"]
    assert isinstance(settings, dict)
    flat: dict[str, Value] = {"key": str(row["key"]), "method": str(row["method"])}
    for name in plan.grids:
        flat[name] = settings.get(name)
    if plan.has_searches:
        seed, proof = row.get("seed"), row.get("proof")
        assert not isinstance(seed, dict)
        assert not isinstance(proof, dict)
        values = _values(row) if "values" in row else None
        flat |= {"seed": seed, "proof": proof, "values": values}
    for name in plan.criteria.columns:
        value = row.get(name)
        assert not isinstance(value, dict)
        flat[name] = value
    return flat


def _cell(value: Value) -> object:
    if isinstance(value, bool):
        return "true" if value else "false"
    return "" if value is None else value


def refuse_parquet(path: str) -> None:
    """Refuse a file that could not be written, before the work is done.

    Raises:
        UsageProblem: pyarrow is not installed, or there is no such folder.
    """
    from importlib.util import find_spec

    from garkcli.page.writing import refuse_unwritable

    if find_spec("pyarrow") is None:
        raise UsageProblem(
            "--parquet needs pyarrow", "install garkcli[parquet], or take --format csv"
        )
    refuse_unwritable(path)


def write_parquet(report: SweepReport, path: str) -> None:
    """The kept rows, best first, as a Parquet file; infinite numbers are those of floats.

    Raises:
        UsageProblem: pyarrow is not installed, or the file cannot be written.
    """
    refuse_parquet(path)
    import pyarrow as pa
    import pyarrow.parquet as pq

    from garkcli.page.writing import write_whole

    rows = [_flat(report.plan, row) for row in report.best]
    table: dict[str, Any] = {}
    for name in _flat_names(report.plan):
        table[name] = _without_text(name, [row[name] for row in rows], report.plan)
    sink = io.BytesIO()
    pq.write_table(pa.table(table), sink)
    write_whole(path, [sink.getvalue()])


def _without_text(name: str, values: list[Value], plan: Plan) -> list[Value]:
    """A column of criteria with ∞ as a float, and then all of it in floats."""
    if name not in plan.criteria.columns or "infinity" not in values:
        return values
    return [None if value is None else float(value) for value in values]


_VALUE: Schema = {"type": ["boolean", "number", "string", "null"]}


def sweep_report_schema() -> Schema:
    """The JSON Schema of what ``gark sweep --format json`` writes."""
    fields: dict[str, Schema] = {
        "schema": {"const": SCHEMA},
        "file": TEXT,
        "name": TEXT,
        "methods": COUNT,
        "kept": COUNT,
        "repeated": COUNT,
        "failed": COUNT,
        "columns": array(TEXT),
        "best": array(_row_schema()),
        "pareto": array(_row_schema()),
    }
    document = {
        "type": "object",
        "required": list(fields),
        "properties": fields,
        "additionalProperties": False,
    }
    return published("report of gark sweep", document)


def _row_schema() -> Schema:
    fields: dict[str, Schema] = {
        "key": TEXT,
        "spec": TEXT,
        "kept": FLAG,
        "method": TEXT,
        "parameters": {"type": "object", "additionalProperties": TEXT},
    }
    found: dict[str, Schema] = {
        "seed": COUNT,
        "proof": {"enum": list(WORDS)},
        "values": {"type": "object", "additionalProperties": TEXT},
    }
    criteria = dict.fromkeys(columns(), _VALUE)
    return {
        "type": "object",
        "required": list(fields),
        "properties": {**fields, **found, **criteria},
        "additionalProperties": False,
    }
