"""JSON and CSV: every number as exact text, nothing lost."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from typing import Any, Literal

from flint import fmpq

from garkcli.bridges.comments import HASH, head, problem_class
from garkcli.bridges.couplings import coupling_of, keys_of
from garkcli.bridges.numbers import EXACT, Style
from garkcli.bridges.payload import SCHEMA, Payload
from garkcli.bridges.readers.rows import COLUMNS
from garkcli.bridges.registry import EVERYTHING, PREDICTOR, STEPPED, Bridge
from garkcli.exact.display import decimal
from garkcli.frozen import replace
from garkcli.page import schema as S  # noqa: N812 -- its names are those of kinds too
from garkcli.page.record import Field, Record, schema_named
from garkcli.tableau.tableau import Colour

DIGITS = 40
_EXACT = replace(EXACT, digits=DIGITS)
_PRINTED = replace(_EXACT, is_fraction_first=False)
"""The style for rounded coefficients: decimals stay decimals."""


def _json(payload: Payload) -> str:
    return _REPORT.text(payload)


def export_schema() -> S.Schema:
    return S.published("method of gark export, with --to json", _REPORT.schema)


def style_of(payload: Payload) -> Style:
    return _EXACT if payload.tolerance is None else _PRINTED


def _array(name: str) -> Callable[[Payload], Any]:
    """The texts of an array, colour by colour; for one vector field without the outer list."""

    def texts(payload: Payload) -> Any:
        if payload.own is not None:
            return _texts(payload, payload.own.get(name))
        if payload.kind == "mri":
            return None
        cells = getattr(payload, name)
        if payload.kind in {"rk", "row"} and payload.size == 1 and cells is not None:
            cells = cells[0][0] if name == "A" else cells[0]
        return _texts(payload, cells)

    return texts


def _nodes(payload: Payload) -> Any:
    if payload.kind != "mri":
        return _array("c")(payload)
    return _texts(payload, coupling_of(payload).nodes)


def _multirate(payload: Payload) -> Any:
    if payload.kind != "mri":
        return None
    return _nested_texts(payload, keys_of(coupling_of(payload)))


def _predictor(payload: Payload) -> Any:
    """The matrices of 1, r, r², … that predict stages."""
    matrices = payload.predictor
    return matrices and {"old": _texts(payload, matrices.old), "new": _texts(payload, matrices.new)}


def _nested_texts(payload: Payload, value: Any) -> Any:
    if isinstance(value, Mapping):
        return {key: _nested_texts(payload, x) for key, x in value.items()}
    return value if isinstance(value, str) else _texts(payload, value)


def _own(name: str) -> Callable[[Payload], Any]:
    return lambda payload: _texts(payload, payload.own.get(name)) if payload.own else None


def _texts(payload: Payload, cells: Any) -> Any:
    if isinstance(cells, tuple):
        return [_texts(payload, x) for x in cells]
    return None if cells is None else payload.number(cells, style_of(payload))


def _linear(payload: Payload, name: Literal["alpha", "gamma", "d"]) -> Any:
    method = payload.rosenbrock
    if method is None:
        return None
    cells = method.nodes[1] if name == "d" else getattr(method, name)
    if payload.size == 1:
        cells = cells[0] if name == "d" else cells[0][0]
    return _texts(payload, cells)


_COLOUR: Record[Colour] = Record(
    Field("name", S.TEXT, lambda x: x.name),
    Field("term", S.POSITION, lambda x: x.term + 1),
    Field("drives", S.TEXT, lambda x: x.part),
    Field("linear", S.FLAG, lambda x: x.is_linear),
    Field("space", S.POSITION, lambda x: x.space + 1),
)
_NUMBERS = S.array(S.NUMERAL)
_MATRIX = S.array(_NUMBERS)
_ONE_ROW = S.one_of(_NUMBERS, _MATRIX)
_ONE_BLOCK = S.one_of(_MATRIX, S.array(S.array(_MATRIX)))
_MATRICES = S.array(_MATRIX)
_PREDICTOR: S.Schema = {
    "type": "object",
    "properties": {"old": _MATRICES, "new": _MATRICES},
    "required": ["old", "new"],
    "additionalProperties": False,
}
_MULTIRATE: S.Schema = {
    "type": "object",
    "properties": {
        "mri": {
            "type": "object",
            "properties": {
                "restart": S.TEXT,
                "c": _NUMBERS,
                "omega": _MATRICES,
                "gamma": _MATRICES,
                "embedded": S.one_of(_MATRIX, {"type": "object", "additionalProperties": _MATRIX}),
            },
            "required": ["c"],
            "additionalProperties": False,
        },
        "mis": {
            "type": "object",
            "properties": dict.fromkeys(("alpha", "beta", "gamma"), _MATRIX),
            "required": ["alpha", "beta", "gamma"],
            "additionalProperties": False,
        },
    },
    "additionalProperties": False,
}


def _decimal(tolerance: fmpq | None) -> str | None:
    return None if tolerance is None else decimal(tolerance)


_REPORT: Record[Payload] = Record(
    schema_named(SCHEMA),
    Field("written_by", S.TEXT, lambda x: f"gark {x.version}"),
    Field("name", S.TEXT, lambda x: x.name),
    Field("derivation", S.DERIVATION, lambda x: x.derivation),
    Field("kind", S.TEXT, lambda x: x.kind),
    Field("structure", S.TEXT, lambda x: x.structure),
    Field("problems", S.TEXT, problem_class),
    Field("order", S.COUNT, lambda x: x.orders.order),
    Field("embedded_order", S.nullable(S.COUNT), lambda x: x.orders.embedded),
    Field("nonautonomous_order", S.nullable(S.COUNT), lambda x: x.orders.nonautonomous),
    Field("w_order", S.COUNT, lambda x: x.orders.w_order, is_optional=True),
    Field("tolerance", S.nullable(S.TEXT), lambda x: _decimal(x.tolerance)),
    Field("embedded_tolerance", S.nullable(S.TEXT), lambda x: _decimal(x.embedded_tolerance)),
    Field("dense_tolerance", S.nullable(S.TEXT), lambda x: _decimal(x.dense_tolerance)),
    Field("moved_within", S.nullable(S.TEXT), lambda x: _decimal(x.moved_within)),
    Field("reference", S.nullable(S.TEXT), lambda x: x.reference or None),
    Field("exact", S.FLAG, lambda x: x.is_exact and x.digits is None),
    _COLOUR.every("colours", lambda x: x.tableau.colours),
    Field("c", _ONE_ROW, _nodes),
    Field("Abar", _MATRIX, _own("Abar"), is_optional=True),
    Field("a", _MATRICES, _own("a"), is_optional=True),
    Field(
        "A",
        S.one_of(_MATRIX, _MATRICES, S.array(S.array(S.nullable(_MATRIX)))),
        lambda x: None if x.rosenbrock else _array("A")(x),
        is_optional=True,
    ),
    Field("alpha", _ONE_BLOCK, lambda x: _linear(x, "alpha"), is_optional=True),
    Field("gamma", _ONE_BLOCK, lambda x: _linear(x, "gamma"), is_optional=True),
    Field("d", _ONE_ROW, lambda x: _linear(x, "d"), is_optional=True),
    Field("bbar", _NUMBERS, _own("bbar"), is_optional=True),
    Field("b", S.nullable(_ONE_ROW), _array("b")),
    Field("embedded_bbar", _NUMBERS, _own("embedded_bbar"), is_optional=True),
    Field("embedded", _ONE_ROW, _array("embedded"), is_optional=True),
    Field("dense_bbar", _MATRIX, _own("dense_bbar"), is_optional=True),
    Field("dense", S.one_of(_MATRIX, S.array(_MATRIX)), _array("dense"), is_optional=True),
    Field("predictor", _PREDICTOR, _predictor, is_optional=True),
    Field("multirate", _MULTIRATE, _multirate, is_optional=True),
)


def _csv(payload: Payload) -> str:
    """A row for each entry; colours and stages count from 1; ``dense`` has powers of theta as j."""
    notes = [] if payload.predictor is None else [f"Left out: {PREDICTOR}."]
    return (
        "\n".join([*HASH.lines(head(payload, *notes)), ",".join(COLUMNS), *_lines(payload)]) + "\n"
    )


def _lines(payload: Payload) -> Iterator[str]:
    for part in ("A", "b", "c", "embedded", "dense"):
        for l, m, rows in payload.parts[part]:
            for i, row in enumerate(rows, start=1):
                for j, text in enumerate(payload.numbers(row, style_of(payload)), start=1):
                    place = f"{i},{j}" if part in {"A", "dense"} else f"{j},"
                    # for the comma of root(x, n)
                    value = f'"{text}"' if "," in text else text
                    yield f"{part},{l},{m},{place},{value}"


BRIDGES = (
    Bridge(
        name="json",
        summary="JSON, every number as exact text",
        kinds=(*STEPPED, "mri"),
        suffix=".json",
        has_predictor=True,
        write=_json,
        reads_back=True,
    ),
    Bridge(
        name="csv",
        summary="CSV, a row an entry, every number as exact text",
        kinds=EVERYTHING,
        suffix=".csv",
        write=_csv,
        reads_back=True,
    ),
)
