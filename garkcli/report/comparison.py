"""``gark converge`` with several methods: one table, one plot, one verdict a method."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise
from textwrap import wrap

from garkcli.convergence.result import Convergence, Row
from garkcli.problems.oscillator import Oscillator
from garkcli.report.asciiplot import SEVERAL, terminal_curves
from garkcli.report.convergence import (
    WIDTH,
    exactly,
    hidden,
    order_text,
    predicted,
    remarks,
    verdict,
    wrapped,
)
from garkcli.report.convergence_data import Entry, csv_of_several, json_of_several
from garkcli.report.costs import Tested, costs_of, curve
from garkcli.report.figures import scientific
from garkcli.report.paint import Paint, aligned, padded

_LONGEST = 60  # characters of a Hamiltonian that are still shown
_INDENT = 2
_GAP = "   "


def render(
    entries: Sequence[Entry],
    format: str,
    paint: Paint,
    with_work: bool = False,
    against: str = "h",
) -> str:
    """The comparison as text, JSON or CSV.

    Args:
        entries: at least one.
        format: text, json or csv.
        paint: of the text.
        with_work: whether to show what the steps have cost.
        against: the horizontal axis of the plot: h, evaluations or seconds.
    """
    if format == "json":
        return json_of_several(entries, with_work)
    if format == "csv":
        return csv_of_several(entries, with_work)
    return "\n".join(_text(entries, paint, with_work, against)) + "\n"


def letters(count: int) -> list[str]:
    """A, B, …, Z, a, …, z, and numbers beyond: short names of methods."""
    alphabet = [chr(ord(first) + k) for first in "Aa" for k in range(26)]
    return [alphabet[k] if k < len(alphabet) else str(k + 1) for k in range(count)]


def title(results: Sequence[Convergence]) -> str:
    """What all of them have solved, without its split."""
    return f"{_about(results[0])}; to t = {results[0].t_end}"


def _about(result: Convergence) -> str:
    problem = result.problem
    if isinstance(problem, Oscillator):
        return f"oscillator; q̈ = −ω²q, ω = {problem.omega}"
    text = str(problem.energy).replace("**", "^")
    return f"{problem.name}; H = {text}" if len(text) <= _LONGEST else problem.name


def _text(
    entries: Sequence[Entry], paint: Paint, with_work: bool, against: str
) -> list[str]:
    named = list(zip(letters(len(entries)), entries, strict=True))
    tested = [(letter, x.result) for letter, x in named if x.result is not None]
    lines = [paint("strong", f"{len(entries)} methods")]
    if tested:
        lines += [
            f"  {line}" for line in wrapped(title([result for _, result in tested]))
        ]
    lines += ["", *_names(named, paint)]
    for block in _blocks(tested):
        lines += ["", *(f"  {line}" for line in block)]
    lines += ["", *(f"  {line}" for line in _verdicts(named, paint)), *_notes(tested)]
    if with_work and tested:
        lines += ["", *costs_of(tested)]
    curves = {letter: list(curve(result, against)) for letter, result in tested}
    if any(curves.values()):
        plot = terminal_curves(curves, against)
        lines += ["", *(f"  {line}" for line in plot.splitlines())]
        if SEVERAL in plot:
            lines.append(f"  {SEVERAL} several methods")
    return lines


def _names(named: Sequence[tuple[str, Entry]], paint: Paint) -> list[str]:
    """A line a method; with its file where another one has the same name."""
    names = [entry.name for _, entry in named]
    lines = []
    for letter, entry in named:
        is_twin = names.count(entry.name) > 1 and entry.name != entry.file
        text = f"{entry.name} ({entry.file})" if is_twin else entry.name
        margin = " " * (_INDENT + len(letter) + _INDENT)
        first, *others = wrap(text, WIDTH - len(margin)) or [""]
        lines.append(f"  {paint('strong', letter)}  {first}".rstrip())
        lines += [f"{margin}{line}" for line in others]
    return lines


def _blocks(tested: Tested) -> list[list[str]]:
    """Errors and slopes side by side: as few tables as fit, with as many methods each."""
    for count in range(1, len(tested) + 1):
        bounds = [round(k * len(tested) / count) for k in range(count + 1)]
        blocks = [_side_by_side(tested[a:b]) for a, b in pairwise(bounds)]
        widest = max(len(line) for block in blocks for line in block)
        if widest <= WIDTH - _INDENT or count == len(tested):
            return blocks
    return []


def _side_by_side(tested: Tested) -> list[str]:
    sizes = sorted({row.h for _, result in tested for row in result.rows}, reverse=True)
    columns = [aligned([[""], ["h"], *([str(h)] for h in sizes)])]
    for letter, result in tested:
        rows = {row.h: row for row in result.rows}
        cells = [["error", "slope"], *(_cells(rows.get(h)) for h in sizes)]
        pair = aligned(cells)
        width = max(map(len, pair))
        columns.append([letter.center(width), *(line.ljust(width) for line in pair)])
    return [_GAP.join(parts).rstrip() for parts in zip(*columns, strict=True)]


def _cells(row: Row | None) -> list[str]:
    if row is None:
        return ["", ""]
    return [scientific(row.error), "" if row.slope is None else f"{row.slope:.2f}"]


def _verdicts(named: Sequence[tuple[str, Entry]], paint: Paint) -> list[str]:
    """A line a method: observed, visible and predicted order, and whether they agree; then what
    there is to say about it.
    """
    rows = [["order", "observed", "on this problem", "of the method"]]
    endings = [""]
    said: list[str] = []
    for letter, entry in named:
        result = entry.result
        if result is None:
            rows.append([letter, "", "", ""])
            endings.append(paint("bad", "FAILED"))
            said += [f"{letter}: {fault.message}" for fault in entry.faults]
            continue
        observed = order_text(result.observed_order)
        rows.append([letter, observed, exactly(result), predicted(result)])
        endings.append(verdict(result, paint))
        if result.hides_failure:
            said.append(f"{letter}: {hidden(result)}")
        said += [f"{letter}: {text}" for text in remarks(result)]
    table = padded(rows)
    width = max(map(len, table))
    lines = []
    for line, ending in zip(table, endings, strict=True):
        lines.append(f"{line:{width}}{_GAP}{ending}".rstrip())
    for text in said:
        lines += wrapped(text)
    return lines


def _notes(tested: Tested) -> list[str]:
    """What the problem can see, once for all methods with the same answer."""
    said: dict[str, list[str]] = {}
    for letter, result in tested:
        said.setdefault(result.visible.trees, []).append(letter)
    lines = []
    for text, who in said.items():
        whose = f"{', '.join(who)}: " if len(said) > 1 else ""
        lines += [f"  {line}" for line in wrapped(f"{whose}{text}")]
    return lines
