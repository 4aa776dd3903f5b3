"""``gark claims``: what may be claimed of methods. As text it is what a method file has."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from garkcli.check.true_claims import TrueClaims
from garkcli.page.paint import folded
from garkcli.page.plain import printable
from garkcli.tell.dialect import Plain
from garkcli.tell.facts import Level, Row, Section
from garkcli.tell.kinds import TEXT, TEXTS, TRUTH
from garkcli.tell.parts import parts, rows_of
from garkcli.tell.report import Report

DATA = Level.DATA


class Claims(NamedTuple):
    """What the report says of a file."""

    found: TrueClaims
    is_written: bool


def _claim_rows(found: TrueClaims, d: Plain) -> list[tuple[str, str]]:
    return [(d.prose(key), d.prose(value)) for key, value in found.claims.items()]


CLAIM = Section(Row("claim", TEXT, "0"), Row("value", TEXT, "1"))
FILE = Section(
    *(
        row.of(lambda x: x.found)
        for row in (
            Row("file", TEXT, level=DATA),
            Row("claims", parts(CLAIM), lambda x: list(x.claims.items()), DATA),
            Row("claims_in_words", rows_of(_claim_rows), "."),
            Row("not_claimed", TEXTS, lambda x: list(x.left)),
        )
    ),
    title=lambda x, d: d.prose(x.found.file),
)
REPORT: Report[Claims] = Report(
    "gark/claims/1",
    "report of gark claims",
    lambda: [FILE],
    lambda _: FILE,
    tail=Section(Row("written", TRUTH, "0.is_written")),
)


def yaml_text(claims: Sequence[Claims], width: int) -> str:
    """The claims as they are in a method file; each file's below its name in a comment."""
    lines: list[str] = []
    for found, is_written in claims:
        lines += [f"# {printable(found.file)}{': written' * is_written}", "expect:"]
        lines += [f"  {key}: {x}" for key, x in found.claims.items()]
        if found.left:
            left = f"not claimed, without a meaning or not decided: {', '.join(found.left)}"
            lines += [f"# {x}" for x in folded(left, width - 2, "")]
    return "\n".join(lines) + "\n"
