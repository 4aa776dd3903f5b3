"""How a notebook shows runs: a table, what was found, and a picture."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from contextlib import suppress
from html import escape
from typing import TypeVar

from garkcli.convergence.result import Convergence, Row
from garkcli.longtime.history import InvariantHistory, LongRun
from garkcli.page.figures import measured, rounded
from garkcli.page.plain import printable
from garkcli.plots.scene import Panel
from garkcli.plots.svg import svg
from garkcli.report.convergence import order_text, predicted, remarks
from garkcli.tableau.garkmethod import word_for
from garkcli.webpage.pictures import NotDrawn, energy, errors

T = TypeVar("T")
_WIDE = 'style="max-width:32rem"'


def convergence_html(result: Convergence) -> str:
    """Errors and slopes by step size, the orders, and the errors in a picture."""
    heads = ["h", "error", "slope"]
    has_energy = any(row.energy_error is not None for row in result.rows)
    if has_energy:
        heads.append("energy error")
    rows = [_step(row) for row in result.rows]
    observed = order_text(result.observed_order)
    whose = word_for(result.method)
    said = f"observed order {observed}, order of the {whose} {predicted(result)}: {result.verdict}"
    name = getattr(result.problem, "name", "oscillator")
    table = _table(f"{name}, to t = {result.t_end}", heads, rows)
    texts = _texts([said, *remarks(result)])
    return _shown([table, *texts], errors, result)


def _step(row: Row) -> list[str]:
    """The cells of a step size; the last one where there is an energy."""
    slope = "" if row.slope is None else f"{row.slope:.3f}"
    cells = [str(row.h), rounded(row.error), slope]
    if row.energy_error is not None:
        cells.append(rounded(row.energy_error))
    return cells


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


def _texts(texts: Iterable[str]) -> list[str]:
    return [f"<p>{_text(text)}</p>" for text in texts]


def _text(text: str) -> str:
    return escape(printable(text))
