"""How a notebook shows runs: a table, what was found, and a picture."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from contextlib import suppress
from html import escape
from typing import TypeVar

from garkcli.convergence.result import Convergence
from garkcli.longtime.history import InvariantHistory, LongRun
from garkcli.page.figures import measured
from garkcli.page.plain import printable
from garkcli.plots.scene import Panel
from garkcli.plots.svg import svg
from garkcli.report.convergence import REPORT, ConvergenceReport
from garkcli.webpage.pictures import NotDrawn, energy, errors

T = TypeVar("T")
_WIDE = 'style="max-width:32rem"'


def convergence_html(result: Convergence) -> str:
    """What ``gark converge`` tells, and the errors in a picture."""
    return _shown([REPORT.html(ConvergenceReport(result, ""))], errors, result)


def long_run_html(run: LongRun) -> str:
    """What became of each invariant, and the error of the first in a picture."""
    heads = ["", "at the start", "largest error", "verdict"]
    rows = [_invariant(history) for history in run.invariants]
    name = getattr(run.problem, "name", "oscillator")
    title = f"{name}: {run.steps} steps of {run.step} to t = {run.t_end}"
    table = _table(title, heads, rows)
    return _shown([table], energy, run)


def _invariant(history: InvariantHistory) -> list[str]:
    largest = "0"
    if history.verdict != "exact":
        largest = measured(history.max_error, history.round_off)
    start = f"{history.initial:.6g}"
    return [history.name, start, largest, history.verdict]


def _shown(parts: list[str], draw: Callable[[T], Panel], result: T) -> str:
    """The parts, and below them the picture where there is one."""
    with suppress(NotDrawn):
        parts.append(f"<div {_WIDE}>{svg(draw(result))}</div>")
    return "\n".join(parts)


def _table(title: str, heads: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    head = [f'<th scope="col">{_text(x)}</th>' for x in heads]
    lines = [_row(head)]
    for row in rows:
        cells = [f"<td>{_text(x)}</td>" for x in row]
        lines.append(_row(cells))
    body = "\n".join(lines)
    beside = "white-space:nowrap;text-align:left"
    caption = f'<caption style="{beside}">{_text(title)}</caption>'
    return f"<table>{caption}<tbody>\n{body}\n</tbody></table>"


def _row(cells: Sequence[str]) -> str:
    joined = "".join(cells)
    return f"<tr>{joined}</tr>"


def _text(text: str) -> str:
    return escape(printable(text))
