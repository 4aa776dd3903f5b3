"""The JSON Schema of what families of methods have: unknowns, parameters, and what is wanted."""

from __future__ import annotations

from garkcli.design.wants.registry import WANTS, find_want
from garkcli.methodfile.coefficient_schema import RANGE, Schema, closed
from garkcli.methodfile.shaped import MAX_STAGES as MOST_UNKNOWN_STAGES
from garkcli.methodfile.shapes.registry import SHAPES, find_shape
from garkcli.methodfile.wishes import MOST


def unknown() -> Schema:
    """The key ``unknown``: how many stages, and which shape."""
    summaries = [{"const": x, "description": find_shape(x).summary} for x in SHAPES]
    shape: Schema = {"oneOf": summaries}
    shapes = {"type": "array", "items": shape, "minItems": 1}
    stages = {"type": "integer", "minimum": 1, "maximum": MOST_UNKNOWN_STAGES}
    return {
        **closed({"stages": stages, "shape": {"anyOf": [shape, shapes]}}, "stages", "shape"),
        "description": "A tableau of unknowns with a shape, for gark design.",
    }


def design() -> Schema:
    """The key ``design``: what is wanted, for all colours or for those that are named."""
    number: Schema = {"$ref": "#/definitions/number"}
    count: Schema = {"type": "integer", "minimum": 1, "maximum": MOST}
    by_kind: dict[str, Schema] = {"flag": {"type": "boolean"}, "count": count, "number": number}
    properties: Schema = {
        "order": {**count, "description": "the order that is looked for"},
        "fix": {
            "description": "values for unknowns, or relations between them",
            "type": "object",
            "additionalProperties": number,
        },
        "range": {
            "description": "between which numbers unknowns are",
            "type": "object",
            "additionalProperties": RANGE,
        },
    }
    for key in WANTS:
        want = find_want(key)
        value = by_kind[want.kind]
        colours = {
            "type": "object",
            "propertyNames": {"pattern": "^[1-9][0-9]*$"},
            "additionalProperties": value,
        }
        properties[key] = {"description": want.summary, "anyOf": [value, colours]}
    return {
        **closed(properties),
        "description": "What gark design looks for, with the order of --order.",
    }


def parameters() -> Schema:
    """The key ``parameters``: values, or free ones."""
    number = {"$ref": "#/definitions/number"}
    free = closed({"free": {"const": True}, "range": RANGE}, "free")
    return {
        "description": "Names used in coefficients, each with a value, or free.",
        "type": "object",
        "additionalProperties": {"anyOf": [number, free]},
    }
