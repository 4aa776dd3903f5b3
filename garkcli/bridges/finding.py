"""Every kind of finding about a table."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Literal, TypeAlias

from garkcli.frozen import Frozen, field

Level: TypeAlias = Literal["error", "warning", "note"]
"""Errors fail an audit; warnings and notes are reported."""
EXPLAINED = "careless rounding explains it"


class AuditFinding(Frozen):
    """A fault of a table, or a doubt about it.

    Attributes:
        code: a key of ``CODES``.
        message: what is wrong.
        help: which entry may be the culprit; empty where none is known.
        level: how bad it is.
        claims: what the source declares and is not true, as a method file claims it.
    """

    code: str
    message: str
    help: str = ""
    level: Level = "error"
    claims: Mapping[str, str] = field(default_factory=dict)


CODES = {
    "order": "the order is lower than the source declares",
    "transposed": "the matrix is transposed",
    "embedded-order": "the embedded order is lower than the source declares",
    "nodes": "nodes are not the row sums",
    "weights": "the weights have another sum than 1",
    "embedded-weights": "the embedded weights have another sum than 1",
    "fsal": "the last stage is not the first of the next step",
    "shape": "arrays of a table do not fit together",
    "order-higher": "the order is higher than the source declares",
    "embedded-order-higher": "the embedded order is higher than declared",
    "open": "the digits leave open whether the order is as declared",
    "sign": "nothing decides the sign of the error estimate",
    "stored": "the numbers of a table say how it is stored",
    "idle": "an array beside a table has no role in it",
    "unread": "coefficients are not written out",
    "unjudged": "judging a table takes too long",
    "other-kind": "the table is not one of a Runge–Kutta method",
}
"""Every kind of finding."""
