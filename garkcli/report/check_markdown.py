"""``gark check --format markdown``: a table for a pull request or a page."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from garkcli.check.findings import findings
from garkcli.check.outcome import Outcome
from garkcli.order.deciding import AnyOrder
from garkcli.page.plain import printable
from garkcli.report.check_text import no_claims

if TYPE_CHECKING:
    from garkcli.check.every_value import EveryValue


def render(outcomes: Sequence[Outcome]) -> str:
    """A row a file, then the findings."""
    rows = [[*HEADS], *(_row(outcome) for outcome in outcomes)]
    embedded = [_embedded(outcome) for outcome in outcomes]
    if any(embedded):
        # few methods have embedded weights: a column where one of these has
        for row, cell in zip(rows, ["embedded", *embedded], strict=True):
            row.insert(2, cell)
    lines = [_joined(row) for row in rows]
    lines.insert(1, "|---" * len(rows[0]) + "|")
    found = [x for outcome in outcomes for x in findings(outcome)]
    if found:
        lines.append("")
    for finding in found:
        place = f"`{_code(finding.file)}:{finding.line}:{finding.column}`"
        lines.append(f"- {place}: {table_cell(finding.message)}")
        if finding.help:
            lines.append(f"  - {table_cell(finding.help)}")
    silent = sum(outcome.makes_no_claim for outcome in outcomes)
    if silent:
        lines += ["", f"{no_claims(silent)}."]
    return "\n".join(lines) + "\n"


HEADS = ["file", "order", "conjugate", "pair", "bound", "symplectic", "claims"]


def _joined(cells: Sequence[str]) -> str:
    """A row of the table."""
    return f"| {' | '.join(cells)} |"


def _embedded(outcome: Outcome) -> str:
    """The order of the embedded weights; empty where there are none."""
    if outcome.every is not None and outcome.every.embedded is not None:
        return str(outcome.every.embedded.order)
    analysis = outcome.analysis
    if analysis is None or analysis.embedded is None:
        return ""
    return _order(analysis.embedded.order)


def _row(outcome: Outcome) -> list[str]:
    analysis = outcome.analysis
    if outcome.every is not None:
        cells = _every(outcome, outcome.every)
    elif analysis is None:
        cells = [f"`{_code(outcome.file)}`", "unreadable", "", "", "", "", ""]
    else:
        claims, failed = len(outcome.claims), len(outcome.failed_claims)
        orders = (analysis.order, analysis.conjugate_order, analysis.pair_order)
        cells = [
            f"`{_code(outcome.file)}`",
            *(_order(order) for order in orders),
            str(analysis.bound),
            "yes" if analysis.symplectic else "no",
            _claims(claims, failed),
        ]
    return cells


def _every(outcome: Outcome, found: EveryValue) -> list[str]:
    """A file with free parameters: what holds for every value."""
    from garkcli.check.every_words import fact_text  # few tables have them

    name = found.parameters[0]
    bound = fact_text(found.simplifying.of(lambda x: x.bound), name)
    orders = [
        "" if order is None else str(order.order)
        for order in (found.order, found.conjugate, found.pair)
    ]
    claims, failed = len(outcome.claims), len(outcome.failed_claims)
    return [
        f"`{_code(outcome.file)}`",
        *orders,
        table_cell(bound.partition(";")[0]),
        table_cell(fact_text(found.symplectic, name)),
        _claims(claims, failed),
    ]


def _claims(claims: int, failed: int) -> str:
    if failed:
        return f"**{failed} of {claims} fail**"
    return f"{claims} hold" if claims else "none"


def _order(order: AnyOrder | None) -> str:
    return (
        ""
        if order is None
        else f"at least {order.order}"
        if order.is_lower_bound
        else str(order.order)
    )


def table_cell(text: str) -> str:
    """A text that stays in its cell of a table."""
    text = printable(text.replace("\n", " "))
    return text.replace("\\", "\\\\").replace("|", "\\|").replace("<", "&lt;")


def _code(text: str) -> str:
    text = printable(text.replace("\n", " "))
    return text.replace("`", "'").replace("|", "\\|")
