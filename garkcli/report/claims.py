"""``gark claims``: what may be claimed of methods, for people and for programs."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from garkcli.check.true_claims import TrueClaims
from garkcli.page.paint import folded
from garkcli.page.plain import printable
from garkcli.page.record import Field, Record, schema_named
from garkcli.page.schema import FLAG, TEXT, Schema, array, published

SCHEMA = "gark/claims/1"
_WIDTH = 80


class _Told(NamedTuple):
    """A report."""

    files: Sequence[TrueClaims]
    is_written: bool


_CLAIM: Record[tuple[str, str]] = Record(
    Field("claim", TEXT, lambda x: x[0]), Field("value", TEXT, lambda x: x[1])
)
_FILE: Record[TrueClaims] = Record(
    Field("file", TEXT, lambda x: x.file),
    _CLAIM.every("claims", lambda x: list(x.claims.items())),
    Field("not_claimed", array(TEXT), lambda x: list(x.left)),
)
_REPORT: Record[_Told] = Record(
    schema_named(SCHEMA),
    Field("written", FLAG, lambda x: x.is_written),
    _FILE.every("files", lambda x: x.files),
)


def claims_report_schema() -> Schema:
    """The JSON Schema of ``gark claims --format json``."""
    return published("report of gark claims", _REPORT.schema)


def render_json(files: Sequence[TrueClaims], is_written: bool) -> str:
    """The claims as JSON: values as they are written in YAML."""
    return _REPORT.text(_Told(files, is_written))


def render_text(files: Sequence[TrueClaims], is_written: bool) -> str:
    """The claims as they stand in a method file; each file's below its name in a comment."""
    lines: list[str] = []
    for found in files:
        head = f"# {printable(found.file)}"
        if is_written:
            head += ": written"
        lines += [head, "expect:"]
        lines += [f"  {key}: {x}" for key, x in found.claims.items()]
        if found.left:
            left = "not claimed, without a meaning or not decided: "
            left += ", ".join(found.left)
            lines += [f"# {x}" for x in folded(left, _WIDTH - 2, "")]
    return "\n".join(lines) + "\n"
