"""``gark design --search --format json``."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import get_args

from garkcli.design.design import Whose
from garkcli.design.search.run import Result
from garkcli.design.search.search import Proof, Search
from garkcli.design.search.told import Method
from garkcli.page.record import Field, Record, inside, schema_named
from garkcli.page.schema import COUNT, FLAG, POSITION, TEXT, Schema, array, nullable, published

SCHEMA = "gark/design-search/1"


@dataclass(frozen=True)
class _Written:
    """A method and the file that it was written to, if it was."""

    method: Method
    path: str | None


@dataclass(frozen=True)
class _Shown:
    """A search with what it found."""

    source: str
    search: Search
    result: Result
    methods: tuple[_Written, ...]


def render(
    source: str, search: Search, result: Result, files: Sequence[str | None], _width: int = 0
) -> str:
    """The result as JSON text.

    Args:
        source: the file.
        search: what was looked for.
        result: what was found.
        files: where each method was written, if it was.
    """
    methods = map(_Written, result.methods, files)
    shown = _Shown(source, search, result, tuple(methods))
    return _REPORT.text(shown)


def search_report_schema() -> Schema:
    """The JSON Schema of the report."""
    return published("A report of gark design --search", _REPORT.schema)


_VALUES: Schema = {
    "type": "object",
    "description": "Exact numbers; decimals where the proof is not exact.",
    "additionalProperties": TEXT,
}
_RESIDUAL: Schema = {
    **TEXT,
    "description": "A power of ten that no residual is above; 0 where all vanish.",
}
_SECONDS: Schema = {"type": "number", "minimum": 0, "description": "Of the processor."}
_METHOD: Record[Method] = Record(
    Field("proof", {"enum": [*get_args(Proof)]}, lambda x: x.proof),
    Field("order", POSITION, lambda x: x.order),
    Field("residual", _RESIDUAL, lambda x: x.residual),
    Field("start", POSITION, lambda x: x.start),
    Field("values", _VALUES, lambda x: dict(x.values)),
)
_WRITTEN: Record[_Written] = Record(
    Field("file", nullable(TEXT), lambda x: x.path), *inside(lambda x: x.method, _METHOD.fields)
)
_RESULT: Record[Result] = Record(
    Field("starts", COUNT, lambda x: x.starts),
    Field("successes", COUNT, lambda x: x.successes),
    Field("degenerate", COUNT, lambda x: x.degenerate),
    Field("interrupted", FLAG, lambda x: x.is_interrupted),
    Field("seconds", _SECONDS, lambda x: round(x.seconds, 3)),
)
_REPORT: Record[_Shown] = Record(
    schema_named(SCHEMA),
    Field("file", TEXT, lambda x: x.source),
    Field("name", TEXT, lambda x: x.search.family.name),
    Field("of", {"enum": [*get_args(Whose)]}, lambda x: x.search.whose),
    Field("unknowns", array(TEXT), lambda x: list(x.search.family.parameters)),
    Field("order", POSITION, lambda x: x.search.order),
    *inside(lambda x: x.result, _RESULT.fields),
    _WRITTEN.every("methods", lambda x: x.methods),
)
