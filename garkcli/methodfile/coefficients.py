"""Coefficients as files have them: a number, a row of them, a matrix."""

from __future__ import annotations

from garkcli.methodfile.grammar import Schema, defined
from garkcli.methodfile.unknowns import UNKNOWN

NUMBER = defined("number", lambda at, node, where: at.numbers.entry(node, where))
"""One coefficient."""
ROW = defined("row", lambda at, node, where: at.numbers.row(node, where))
"""Weights or nodes; a single value is a row of one."""
MATRIX = defined("matrix", lambda at, node, where: at.numbers.matrix(node, where))
"""A matrix, whose rows may still be of different lengths."""
SIGNS = r"^[-+*/^(),.\sA-Za-z0-9_]+$"
"""What a number is written with."""
_NUMBER: Schema = {
    "description": "A coefficient: a number, or text such as 1/2 - sqrt(3)/6,"
    " read exactly as written.",
    "type": ["number", "string"],
    "pattern": SIGNS,
}
_ENTRY: Schema = {
    "anyOf": [_NUMBER, {"const": UNKNOWN, "description": "Unknown: gark design finds values."}]
}
DEFINITIONS: Schema = {
    "number": _NUMBER,
    "row": {"anyOf": [{"type": "array", "items": _ENTRY, "minItems": 1}, _ENTRY]},
    "matrix": {
        "description": "Row by row; the rows of a triangle may end at the diagonal or before it.",
        "type": "array",
        "items": {"anyOf": [{"$ref": "#/definitions/row"}, {"type": "array", "maxItems": 0}]},
        "minItems": 1,
    },
}
"""What they are in a schema."""
