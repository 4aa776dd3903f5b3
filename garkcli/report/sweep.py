"""``gark sweep``: the best methods, the front, and the rows as a table."""

from __future__ import annotations

import io
import json
from collections.abc import Callable, Iterable, Mapping, Sequence

from garkcli.errors import UsageProblem, counted
from garkcli.page import schema as S  # noqa: N812 -- its names are those of kinds too
from garkcli.plots.curves import drawn, sweep_scene
from garkcli.report.search import with_root
from garkcli.sweep.columns import Value, columns
from garkcli.sweep.plan import Plan
from garkcli.sweep.report import SweepReport
from garkcli.sweep.row import Row as Judged
from garkcli.tell.dialect import Plain
from garkcli.tell.facts import Json, Kind, Level, Row, Section, Words, via
from garkcli.tell.kinds import COUNT, TEXT, TEXTS, record
from garkcli.tell.parts import answer, plot, shown, told
from garkcli.tell.report import Report

HEADLINE, USUAL, DETAIL, DATA = Level
WORDS = {"exact": "exact", "exists": "proved to exist", "numerical": "numerical"}


def _answer(report: SweepReport, _: Plain) -> str:
    """``12 methods, 5 kept``."""
    again = f", {report.repeated} found again" if report.repeated else ""
    return f"{counted(len(report.plan), 'method')}, {len(report.best)} kept{again}"


def _failed_words(failed: Sequence[Judged], d: Plain) -> str:
    who = counted(len(failed), "method") + (", the first" if len(failed) > 1 else "")
    return f"{who}: {d.prose(str(failed[0]['failure']))}"


def _value_words(value: Value, d: Plain) -> str:
    if isinstance(value, bool):
        return "yes" if value else "no"
    return f"{value:.6g}" if isinstance(value, float) else d.prose(str(value))


def _values(
    row: Judged, form: Callable[[Mapping[str, str]], Mapping[str, str]] = dict
) -> str | None:
    values = row.get("values")
    if not isinstance(values, dict):
        return None
    return ", ".join(f"{name} = {value}" for name, value in form(values).items())


def _method(row: Judged) -> str:
    proof = f"; {WORDS[str(row['proof'])]}: {_values(row, with_root)}" if "proof" in row else ""
    return f"{row['key']}{proof}"


OF_VALUE: S.Schema = {"type": ["boolean", "number", "string", "null"]}
VALUE: Kind[Value] = Kind(Json(OF_VALUE), Words(_value_words, absent="-"))


def _value(row: Judged, name: str) -> Value:
    value = row.get(name)
    assert not isinstance(value, dict)
    return value


def _column(name: str) -> Row[Judged]:
    return Row(name, VALUE, lambda row: _value(row, name), label=name)


def _table(
    plan: Plan | None, label: str, get: Callable[[SweepReport], Sequence[Judged]], most: int = 10
) -> Row[SweepReport]:
    criteria = [] if plan is None else [_column(name) for name in plan.criteria.columns]
    line: Section[tuple[int, Judged]] = Section(
        Row("number", COUNT, lambda x: x[0]),
        via(lambda x: x[1], [*criteria, Row("method", TEXT, _method)]),
    )
    return Row("lines", shown(line, most), lambda x: [*enumerate(get(x), start=1)], label=label)


ROW: S.Schema = record(
    key=S.TEXT,
    spec=S.TEXT,
    kept=S.FLAG,
    method=S.TEXT,
    parameters={"type": "object", "additionalProperties": S.TEXT},
)
ROW["properties"] |= {
    "seed": S.COUNT,
    "proof": {"enum": list(WORDS)},
    "values": {"type": "object", "additionalProperties": S.TEXT},
    **dict.fromkeys(columns(), OF_VALUE),
}
ROWS: Kind[Sequence[Judged]] = Kind(Json(S.array(ROW), lambda rows, _: list(rows)))


def section(report: SweepReport | None = None) -> Section[SweepReport]:
    plan = None if report is None else report.plan
    by, front = ("", "") if plan is None else (", ".join(plan.best), ", ".join(plan.pareto))
    most = 10 if report is None else report.top
    return Section(
        Row("file", TEXT, lambda x: x.source, DATA),
        Row("name", TEXT, lambda x: x.plan.name, DATA),
        answer(_answer),
        Row("methods", COUNT, lambda x: len(x.plan), DATA),
        Row("kept", COUNT, lambda x: len(x.best), DATA),
        Row("repeated", COUNT, lambda x: x.repeated, DATA),
        Row("failed", COUNT, lambda x: len(x.failed), DATA),
        Row("failures", told(_failed_words), lambda x: x.failed, label="failed"),
        Row("columns", TEXTS, lambda x: list(x.plan.criteria.columns), DATA),
        Row("best", ROWS, lambda x: x.best[: x.top], DATA),
        _table(plan, f"best by {by}" if by else "first rows", lambda x: x.best, most),
        Row("pareto", ROWS, lambda x: x.front if x.plan.pareto else [], DATA),
        _table(
            plan,
            f"Pareto front of {front}" if front else "pareto",
            lambda x: x.front if x.plan.pareto else [],
            most,
        ),
        plot(sweep_scene, lambda x: len(x.plan.pareto) > 1 and bool(drawn(x))),
        title=lambda x, d: d.prose(x.plan.name),
    )


def flat(plan: Plan) -> Section[Judged]:
    """Returns the columns without nesting, for CSV and Parquet."""

    def setting(name: str) -> Row[Judged]:
        def get(row: Judged) -> str | None:
            settings = row["parameters"]
            return settings.get(name) if isinstance(settings, dict) else None

        return Row(name, TEXT, get)

    found = [_column("seed"), _column("proof"), Row("values", TEXT, _values)]
    return Section(
        Row("key", TEXT, lambda row: str(row["key"])),
        Row("method", TEXT, lambda row: str(row["method"])),
        map(setting, plan.grids),
        (found if plan.has_searches else []),
        map(_column, plan.criteria.columns),
    )


def _lines(report: SweepReport) -> tuple[Section[Judged], Iterable[Judged]]:
    return flat(report.plan), report.best


REPORT: Report[SweepReport] = Report(
    "gark/sweep/1", "report of gark sweep", lambda: [section()], section, key="", lines=_lines
)


def json_lines(report: SweepReport) -> str:
    return "".join(f"{json.dumps(row, ensure_ascii=False)}\n" for row in report.best)


def refuse_parquet(path: str) -> None:
    """UsageProblem before the work if pyarrow is not installed, or there is no such folder."""
    from importlib.util import find_spec

    from garkcli.page.writing import refuse_unwritable

    if find_spec("pyarrow") is None:
        message = "--parquet needs pyarrow"
        cure = "install garkcli[parquet], or take --format csv"
        raise UsageProblem(message, cure, code="missing-package")
    refuse_unwritable(path)


def write_parquet(report: SweepReport, path: str) -> None:
    """The kept rows, best first; infinite numbers are floats. UsageProblem if that fails."""
    refuse_parquet(path)
    import pyarrow as pa
    import pyarrow.parquet as pq

    from garkcli.page.writing import write_whole

    found: dict[str, list[Value]] = {}
    for row in flat(report.plan).rows:
        values = [row.fact(x).value for x in report.best]
        found[row.key] = _without_text(row.key, values, report.plan)
    sink = io.BytesIO()
    pq.write_table(pa.table(found), sink)
    write_whole(path, [sink.getvalue()])


def _without_text(name: str, values: list[Value], plan: Plan) -> list[Value]:
    """A column of criteria with ∞ is all in floats."""
    if name not in plan.criteria.columns or "infinity" not in values:
        return values
    return [None if value is None else float(value) for value in values]
