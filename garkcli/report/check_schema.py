"""The JSON Schema (draft-07) of ``gark check --format json``."""

from __future__ import annotations

from typing import Any, TypeAlias

from garkcli.report.check_json import SCHEMA

Schema: TypeAlias = dict[str, Any]

_EXACT: Schema = {
    "type": "string",
    "description": "An exact number, such as 1/2 - sqrt(3)/6.",
}
_COUNT: Schema = {"type": "integer", "minimum": 0}
_BLOCK: Schema = {
    "type": "array",
    "items": {"type": "integer", "minimum": 1},
    "minItems": 1,
    "maxItems": 2,
}
_TABLE: Schema = {
    "type": "array",
    "items": {"type": "array", "items": {"type": ["integer", "null"]}},
}


def check_report_schema() -> Schema:
    """The schema as plain data. Fields may be added to reports; those here never change their
    meaning.
    """
    return {
        "$schema": "http://json-schema.org/draft-07/schema#",
        "title": "report of gark check",
        "type": "object",
        "required": ["schema", "files", "summary"],
        "properties": {
            "schema": {"const": SCHEMA},
            "files": {"type": "array", "items": {"oneOf": [_unreadable(), _checked()]}},
            "summary": _object(
                {"files": _COUNT, "failed": _COUNT, "without_claims": _COUNT}
            ),
        },
    }


def _object(required: Schema, optional: Schema | None = None) -> Schema:
    return {
        "type": "object",
        "required": list(required),
        "properties": {**required, **(optional or {})},
        "additionalProperties": False,
    }


def _unreadable() -> Schema:
    error = {
        "line": {"type": ["integer", "null"], "minimum": 1},
        "column": {"type": ["integer", "null"], "minimum": 1},
        "message": {"type": "string"},
        "help": {"type": "string"},
    }
    return _object(
        {
            "file": {"type": "string"},
            "name": {"type": "string"},
            "ok": {"const": False},
            "errors": {"type": "array", "minItems": 1, "items": _object(error)},
        }
    )


def _checked() -> Schema:
    orders: Schema = {}
    bounds: Schema = {}
    for prefix in ("", "conjugate_", "pair_", "nonautonomous_"):
        orders[f"{prefix}order"] = {
            "type": ["integer", "null"] if prefix else "integer",
            "minimum": 0,
        }
        orders[f"{prefix}witness"] = {"oneOf": [{"type": "null"}, _witness()]}
        bounds[f"{prefix}order_is_lower_bound"] = {"const": True}
        bounds[f"{prefix}order_largest_residual"] = {"type": "number", "minimum": 0}
        bounds[f"{prefix}order_tolerance"] = {"type": "string"}
        bounds[f"{prefix}order_undecided"] = {"const": True}
    required = {
        "file": {"type": "string"},
        "name": {"type": "string"},
        "ok": {"type": "boolean"},
        "structure": {"enum": ["general", "semi-separable", "separable", "nystrom"]},
        "exact": {"type": "boolean"},
        "tolerance": {"type": ["string", "null"]},
        "colours": {
            "type": "array",
            "items": _object(
                {
                    "name": {"type": "string"},
                    "stages": {"type": "integer", "minimum": 1},
                }
            ),
        },
        "consistent": {"type": "boolean"},
        "inconsistent_blocks": {"type": "array", "items": _BLOCK},
        "conjugate_consistent": {"type": ["boolean", "null"]},
        "symplectic": {"type": "boolean"},
        **orders,
        "simplifying": _simplifying(),
        "pair_bound": {"type": ["integer", "null"], "minimum": 0},
        "claims": {"type": "array", "items": _claim()},
    }
    size = {"type": "number", "minimum": 0}
    suggestion = _object(
        {"line": {"type": "string"}, "order": _COUNT, "rounding": size, "genuine": size}
    )
    misprint = _object(
        {
            "order": _COUNT,
            "residual": size,
            "explained": size,
            "repairs": {"type": "array", "items": _repair()},
        }
    )
    optional = {
        "blame": _blame(),
        "error_constants": _constants(),
        "suggestion": suggestion,
        "misprint": misprint,
    }
    return _object(required, {**bounds, **optional})


def _witness() -> Schema:
    numbers = {"value": _EXACT, "required": _EXACT, "residual": _EXACT}
    return _object(
        {
            "order": {"type": "integer", "minimum": 1},
            "tree": {"type": "string"},
            **numbers,
        }
    )


def _simplifying() -> Schema:
    numbers = dict.fromkeys(("r", "eta", "zeta", "xi", "bound"), _COUNT)
    return _object(
        {"B": {"type": "array", "items": _COUNT}, "C": _TABLE, "D": _TABLE, **numbers}
    )


def _claim() -> Schema:
    texts = {key: {"type": "string"} for key in ("claim", "expected", "found")}
    return _object(
        {
            **texts,
            "holds": {"type": "boolean"},
            "line": {"type": "integer", "minimum": 1},
        }
    )


def _repair() -> Schema:
    place = {
        "row": {"type": ["integer", "null"]},
        "entry": {"type": "integer", "minimum": 1},
        "old": _EXACT,
        "new": _EXACT,
    }
    return _object(place, {"A": _BLOCK, "b": _BLOCK})


def _blame() -> Schema:
    return _object(
        {
            "of": {"enum": ["order", "conjugate-order", "pair-order"]},
            "order": {"type": "integer", "minimum": 1},
            "failing": _COUNT,
            "conditions": _COUNT,
            "only_coupling": {"type": "boolean"},
            "culprit": {"oneOf": [{"type": "null"}, _BLOCK]},
            "in_every": {"type": "array", "items": _BLOCK},
            "in_none": {"type": "array", "items": _BLOCK},
            "repairs": {"type": "array", "items": _repair()},
        }
    )


def _constants() -> Schema:
    norms = _object(
        {
            "trees": _COUNT,
            "two_norm_squared": {"type": ["string", "null"]},
            "two_norm": {"type": "number", "minimum": 0},
            "inf_norm": {"type": "number", "minimum": 0},
            "worst": {"type": ["string", "null"]},
            "worst_value": {"type": ["string", "null"]},
        }
    )
    return _object(
        {
            "order": {"type": "integer", "minimum": 1},
            "exact": {"type": "boolean"},
            "all": norms,
            "coupling": norms,
        }
    )
