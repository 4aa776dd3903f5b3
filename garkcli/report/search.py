"""``gark design --search``: methods from random starts."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from typing import NamedTuple, get_args

from flint import ctx

from garkcli.design.member import Whose
from garkcli.design.minimise.objective import LevelObjective, Single, WeightedSum
from garkcli.design.search.run import Ending, FoundMethod, SearchResult
from garkcli.design.search.run import decimals as decimals_of
from garkcli.design.search.search import Proof, Search
from garkcli.errors import ExpressionError, counted
from garkcli.exact.enclosing import enclose
from garkcli.exact.expression import parse
from garkcli.exact.rewriting import names_in
from garkcli.page import schema as S  # noqa: N812 -- its names are those of kinds too
from garkcli.tell.dialect import Plain
from garkcli.tell.facts import Json, Kind, Level, Row, Rows, Section, itself, maybe, optional, via
from garkcli.tell.kinds import COUNT, POSITION, TEXT, TEXTS, TRUTH, choice
from garkcli.tell.parts import answer, parts, rows_of
from garkcli.tell.report import Report

HEADLINE, USUAL, DETAIL, DATA = Level
SHOWN = 24
LONG = 50
"""Signs of a number that nobody reads."""
PRECISION = 1000
ROOT = re.compile(r"root_of\([^()]*\)")
ENDINGS: dict[Ending, str] = {
    "interrupt": "interrupted",
    "time": "the time of --seconds was over",
    "worker": "a process was lost",
}


class SearchReport(NamedTuple):
    """``files`` has None for methods that are not written."""

    file: str
    search: Search
    result: SearchResult
    files: Sequence[str | None]
    start: str | None = None

    @property
    def methods(self) -> list[tuple[FoundMethod, str | None]]:
        return list(zip(self.result.methods, self.files, strict=True))


def _summary(x: SearchReport, d: Plain) -> str:
    search, result = x.search, x.result
    order = f"order {search.order}" + f" of the {search.whose}" * (search.whose != "method")
    found = f"{counted(len(result.methods), 'method')} of {order} found"
    if not result.methods:
        found = f"no method of {order} found, which does not say that there is none"
    starts = counted(result.starts, "start")
    at = "" if x.start is None else f", the first at {x.start}"
    if result.objective is not None and result.methods:
        which = "greatest" if isinstance(result.objective, LevelObjective) else "least"
        best = f"{which} {_of(result.objective)} found {result.methods[0].objective}"
        found = f"{order}; {best}, the best of {starts}{at}"
        at = ""
    end = "" if result.ending is None else f", then {ENDINGS[result.ending]}"
    return d.prose(f"{found}; {solved(result.successes, result.starts)}{at}{end}")


def solved(successes: int, starts: int) -> str:
    """The starts that succeed.

    >>> solved(1, 3)
    '1 of 3 starts solves the conditions in floats'
    """
    verb = "solves" if successes == 1 else "solve"
    return f"{successes} of {counted(starts, 'start')} {verb} the conditions in floats"


def _verdict(method: FoundMethod) -> str:
    orders = f"order {'at least ' * (method.proof == 'exists')}{method.order}"
    if method.embedded is not None:
        orders += f" and embedded order {method.embedded}"
    match method.proof:
        case "exact":
            return f"exact: {orders}, by the certificate"
        case "exists":
            return f"proved to exist: {orders}, by Krawczyk's test"
        case "numerical":
            return f"numerical: residuals below {method.residual} up to {orders}"


def with_root(values: Mapping[str, str]) -> Mapping[str, str]:
    """Names the one long root in the values ``r``.

    >>> with_root({"a": "root_of(x**3 - 2, 1.25)", "b": "1 - root_of(x**3 - 2, 1.25)"})
    {'r': 'root_of(x**3 - 2, 1.25)', 'a': 'r', 'b': '1 - r'}
    """
    roots = {root for x in values.values() for root in ROOT.findall(x)}
    if len(roots) != 1 or "r" in values:
        return values
    (root,) = roots
    return {"r": root, **{name: x.replace(root, "r") for name, x in values.items()}}


def _values(method: FoundMethod, d: Plain) -> Iterator[str]:
    if not method.is_exact:
        for name, value in method.values.items():
            whole, _, decimals = value.partition(".")
            yield f"{d.expression(name)} = {d.prose(f'{whole}.{decimals[:SHOWN]}…')}"
        return
    for name, value in with_root(method.values).items():
        yield f"{d.expression(name)} = {_shown(value, d)}"


def _shown(value: str, d: Plain) -> str:
    """Decimals for a long number, unless it has a root with a name."""
    if len(value) < LONG or ROOT.search(value):
        return d.expression(value)
    try:
        parsed = parse(value)
    except ExpressionError:  # its numbers are too long
        return d.expression(value)
    if any(True for _ in names_in(parsed)):
        return d.expression(value)
    with ctx.workprec(PRECISION):
        number = enclose(parsed)
    whole, _, decimals = decimals_of(number).partition(".")
    return d.prose(f"{whole}.{decimals[:SHOWN]}…")


def method_rows(report: SearchReport, d: Plain) -> list[tuple[str, str]]:
    objective = report.result.objective
    rows = []
    for number, (method, path) in enumerate(report.methods, start=1):
        what = "" if objective is None else f"{_of(objective)} {method.objective}; "
        where = "" if path is None else f", written to {path}"
        head = d.prose(f"{what}{_verdict(method)}; start {method.start}{where}")
        rows.append((str(number), f"{head}: {', '.join(_values(method, d))}"))
    return rows


def _of(objective: Single | WeightedSum) -> str:
    return objective.key if isinstance(objective, WeightedSum) else objective.key.removeprefix("-")


def _objective_rows(report: SearchReport, d: Plain) -> list[tuple[str, str]]:
    objective = report.result.objective
    if objective is None:
        return []
    return [("objective", d.prose(objective.summary.format(next=report.search.order + 1)))]


def _key(objective: Single | WeightedSum | None) -> str | None:
    return None if objective is None else objective.key


RESIDUAL: Kind[str] = Kind(
    Json({**S.TEXT, "description": "A power of ten that no residual is above; 0 where all vanish."})
)
VALUES: S.Schema = {
    "type": "object",
    "description": "Exact numbers; decimals where the proof is not exact.",
    "additionalProperties": S.TEXT,
}
OF_METHOD: Rows[FoundMethod] = [
    Row("proof", choice(*get_args(Proof)), lambda x: x.proof),
    Row("order", POSITION, lambda x: x.order),
    Row("residual", RESIDUAL, lambda x: x.residual),
    Row("start", POSITION, lambda x: x.start),
    Row("values", Kind(Json(VALUES, lambda values, _: dict(values))), lambda x: x.values),
    maybe("objective", TEXT, lambda x: x.objective),
    maybe("embedded_order", COUNT, lambda x: x.embedded),
]
METHOD: Section[tuple[FoundMethod, str | None]] = Section(
    maybe("file", TEXT, lambda x: x[1]), via(lambda x: x[0], OF_METHOD)
)
SECONDS: Kind[float] = Kind(
    Json({"type": "number", "minimum": 0, "description": "Of the processor."})
)
WHOLE: Section[SearchReport] = Section(
    Row("file", TEXT, lambda x: x.file, DATA),
    Row("name", TEXT, lambda x: x.search.family.name, DETAIL),
    Row("of", choice(*get_args(Whose)), lambda x: x.search.whose, DATA),
    answer(_summary),
    Row("unknowns", TEXTS, lambda x: list(x.search.family.parameters)),
    Row("order", POSITION, lambda x: x.search.order, DATA),
    optional("objective", TEXT, lambda x: _key(x.result.objective), DATA),
    itself("objective_in_words", rows_of(_objective_rows)),
    Row("starts", COUNT, lambda x: x.result.starts, DATA),
    optional("first_start", TEXT, lambda x: x.start, DATA),
    Row("successes", COUNT, lambda x: x.result.successes, DATA),
    Row(
        "degenerate",
        COUNT,
        lambda x: x.result.degenerate,
        level=lambda a: USUAL if a.value else DATA,
    ),
    Row("unstable", COUNT, lambda x: x.result.unstable, level=lambda a: USUAL if a.value else DATA),
    Row("interrupted", TRUTH, lambda x: x.result.is_interrupted, DATA),
    Row("seconds", SECONDS, lambda x: round(x.result.seconds, 3), DATA),
    Row("methods", parts(METHOD), lambda x: x.methods, DATA),
    itself("methods_in_words", rows_of(method_rows)),
    title=lambda x, d: d.prose(x.file),
)
REPORT: Report[SearchReport] = Report.only(
    "gark/design-search/1", "A report of gark design --search", WHOLE
)
