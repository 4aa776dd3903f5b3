"""``gark claims``: claims that methods may make, as text for a method file."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any, NamedTuple

from garkcli.check.analysis import Analysis
from garkcli.check.true_claims import TrueClaims
from garkcli.errors import printable
from garkcli.page.lines import folded
from garkcli.properties.registry import KEYS
from garkcli.report.check import ANALYSIS, SIMPLIFYING, property_rows_of, property_verdict
from garkcli.report.other_methods import TOLD_BY
from garkcli.tell.dialect import Plain
from garkcli.tell.facts import Level, Row, Rows, Section, itself, via
from garkcli.tell.kinds import TEXT, TEXTS, TRUTH
from garkcli.tell.outputs import words
from garkcli.tell.parts import parts, rows_of
from garkcli.tell.report import Report

DATA = Level.DATA


class Claims(NamedTuple):
    found: TrueClaims
    is_written: bool


def _claim_rows(found: TrueClaims, d: Plain) -> list[tuple[str, str]]:
    if d.breadth != "page" and not d.is_brief:
        return [*_how(found, d)]
    return [(d.prose(key), d.prose(value)) for key, value in found.claims.items()]


_ROWS = {row.key: row for row in (*ANALYSIS, *SIMPLIFYING.rows)}
_ROWS_OF_OTHER_KINDS: dict[str, dict[str, Row[Any]]] = {
    kind: {row.key: row for row in rows} for kind, (_, rows) in TOLD_BY.items()
}


def _how(found: TrueClaims, d: Plain) -> Iterator[tuple[str, str]]:
    a = found.analysis
    known: Mapping[str, Row[Any]] = _ROWS
    if not isinstance(a, Analysis):
        known = _ROWS_OF_OTHER_KINDS[type(a).__name__]
    for key, value in found.claims.items():
        row = known.get(key.replace("-", "_"))
        if key in KEYS:
            yield from property_rows_of([property_verdict(a, key)], d)
        else:
            yield key, d.prose(value) if row is None else words(row.fact(a), d)


CLAIM: Section[tuple[str, str]] = Section(
    Row("claim", TEXT, lambda x: x[0]), Row("value", TEXT, lambda x: x[1])
)
OF_METHOD: Rows[TrueClaims] = (
    Row("file", TEXT, lambda x: x.file, DATA),
    Row("claims", parts(CLAIM), lambda x: list(x.claims.items()), DATA),
    itself("claims_in_words", rows_of(_claim_rows)),
    Row("not_claimed", TEXTS, lambda x: list(x.left)),
)
FILE: Section[Claims] = Section(
    via(lambda x: x.found, OF_METHOD), title=lambda x, d: d.prose(x.found.file)
)
REPORT: Report[Claims] = Report(
    "gark/claims/1",
    "report of gark claims",
    lambda: [FILE],
    lambda _: FILE,
    tail=Section(Row("written", TRUTH, lambda x: x[0].is_written)),
)


def yaml_text(claims: Sequence[Claims], width: int, is_brief: bool = True) -> str:
    lines: list[str] = []
    for found, is_written in claims:
        lines += [f"# {printable(found.file)}{': written' * is_written}", "expect:"]
        lines += [f"  {key}: {x}" for key, x in found.claims.items()]
        if not is_brief:
            d = Plain(colours=[x.name for x in found.analysis.tableau.colours])
            told = (f"{key}: {text}" for key, text in _how(found, d))
            lines += [f"# {x}" for text in told for x in folded(text, width - 2, "  ")]
        if found.left:
            left = f"not claimed, without a meaning or not decided: {', '.join(found.left)}"
            lines += [f"# {x}" for x in folded(left, width - 2, "")]
    return "\n".join(lines) + "\n"
