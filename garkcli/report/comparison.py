"""``gark converge`` with several methods: one table, one plot, one verdict a method."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import chain, pairwise
from string import ascii_lowercase, ascii_uppercase
from textwrap import wrap

from garkcli.convergence.result import Convergence, Row
from garkcli.page.asciiplot import SEVERAL, terminal_curves
from garkcli.page.figures import scientific
from garkcli.page.paint import Paint, aligned, indented, padded
from garkcli.problems.oscillator import Oscillator
from garkcli.problems.righthandside import RightHandSide
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
from garkcli.report.convergence_data import Entry, csv_of_several
from garkcli.report.costs import Tested, costs_of, curve
from garkcli.tableau.garkmethod import word_for

_LONGEST = 60  # characters of a Hamiltonian that are still shown
_INDENT = 2
_GAP = "   "


def render(
    entries: Sequence[Entry],
    format: str,
    paint: Paint,
    with_work: bool = False,
    against: str = "h",
    says_all: bool = True,
) -> str:
    """The comparison as text, JSON or CSV.

    Args:
        entries: at least one.
        format: text, json or csv.
        paint: of the text.
        with_work: whether to show what the steps have cost.
        against: the horizontal axis of the plot: h, evaluations or seconds.
        says_all: whether the text ends with a plot.
    """
    if format == "json":
        from garkcli.report.convergence_json import json_of_several

        return json_of_several(entries, with_work)
    if format == "csv":
        return csv_of_several(entries, with_work)
    named = list(zip(letters(len(entries)), entries, strict=True))
    tested = [(x, entry.result) for x, entry in named if entry.result]
    lines = _text(named, tested, paint, with_work)
    if says_all:
        lines += _plot(tested, against)
    return "\n".join(lines) + "\n"


def letters(count: int) -> list[str]:
    """A, B, …, Z, a, …, z, and numbers beyond: short names of methods."""
    numbers = [str(k) for k in range(1, count + 1)]
    single = [*ascii_uppercase, *ascii_lowercase]
    names = single + numbers[len(single) :]
    return names[:count]


def title(results: Sequence[Convergence]) -> str:
    """What all of them have solved, without its split."""
    first = results[0]
    return f"{_about(first)}; to t = {first.t_end}"


def _about(result: Convergence) -> str:
    problem = result.problem
    if isinstance(problem, Oscillator):
        return f"oscillator; q̈ = −ω²q, ω = {problem.omega}"
    if isinstance(problem, RightHandSide):
        if problem.stiffness is None:
            return problem.name
        return f"{problem.name}, stiffness {problem.stiffness}"
    text = str(problem.energy).replace("**", "^")
    if len(text) > _LONGEST:
        return problem.name
    return f"{problem.name}; H = {text}"


def _text(
    named: Sequence[tuple[str, Entry]], tested: Tested, paint: Paint, with_work: bool
) -> list[str]:
    lines = [paint("strong", f"{len(named)} methods")]
    if tested:
        results = [result for _, result in tested]
        lines += indented(wrapped(title(results)))
    lines.append("")
    lines += _names(named, paint)
    for block in _blocks(tested):
        lines.append("")
        lines += indented(block)
    lines.append("")
    lines += indented(_verdicts(named, paint))
    lines += _notes(tested)
    if with_work and tested:
        lines.append("")
        lines += costs_of(tested)
    return lines


def _plot(tested: Tested, against: str) -> list[str]:
    """All curves in one plot, after an empty line; none where there is nothing to draw."""
    curves = {}
    for letter, result in tested:
        curves[letter] = list(curve(result, against))
    if not any(curves.values()):
        return []
    plot = terminal_curves(curves, against)
    lines = [""]
    lines += indented(plot.splitlines())
    if SEVERAL in plot:
        lines.append(f"  {SEVERAL} several methods")
    return lines


def _names(named: Sequence[tuple[str, Entry]], paint: Paint) -> list[str]:
    """A line a method; with its file where another one has the same name."""
    names = [entry.name for _, entry in named]
    lines = []
    for letter, entry in named:
        text = entry.name
        is_twin = names.count(text) > 1
        if is_twin and text != entry.file:
            text = f"{text} ({entry.file})"
        margin = " " * (_INDENT + len(letter) + _INDENT)
        left = WIDTH - len(margin)
        first, *others = wrap(text, left) or [""]
        painted = paint("strong", letter)
        head = f"  {painted}  {first}"
        lines.append(head.rstrip())
        lines += indented(others, margin)
    return lines


def _blocks(tested: Tested) -> list[list[str]]:
    """Errors and slopes side by side: as few tables as fit, with as many methods each."""
    methods = len(tested)
    for count in range(1, methods + 1):
        bounds = [round(k * methods / count) for k in range(count + 1)]
        parts = [tested[a:b] for a, b in pairwise(bounds)]
        blocks = [_side_by_side(part) for part in parts]
        lines = chain(*blocks)
        widest = max(map(len, lines))
        if widest <= WIDTH - _INDENT or count == methods:
            return blocks
    return []


def _side_by_side(tested: Tested) -> list[str]:
    found = {row.h for _, result in tested for row in result.rows}
    sizes = sorted(found, reverse=True)
    steps = ["", "h", *map(str, sizes)]
    columns = [aligned([[step] for step in steps])]
    for letter, result in tested:
        rows = {row.h: row for row in result.rows}
        pair = [["error", "slope"]]
        pair += [_cells(rows.get(h)) for h in sizes]
        lines = aligned(pair)
        width = max(map(len, lines))
        column = [letter.center(width)]
        column += [line.ljust(width) for line in lines]
        columns.append(column)
    rows_of_cells = zip(*columns, strict=True)
    return [_GAP.join(cells).rstrip() for cells in rows_of_cells]


def _cells(row: Row | None) -> list[str]:
    if row is None:
        return ["", ""]
    slope = ""
    if row.slope is not None:
        slope = f"{row.slope:.2f}"
    return [scientific(row.error), slope]


def _verdicts(named: Sequence[tuple[str, Entry]], paint: Paint) -> list[str]:
    """A line a method: observed, visible and predicted order, and whether they agree; then what
    there is to say about it.
    """
    stepped = next((entry.result.method for _, entry in named if entry.result), None)
    rows = [["order", "observed", "on this problem", f"of the {word_for(stepped)}"]]
    endings = [""]
    said: list[str] = []
    for letter, entry in named:
        result = entry.result
        if result is None:
            rows.append([letter, "", "", ""])
            endings.append(paint("bad", "FAILED"))
            texts = [fault.message for fault in entry.faults]
        else:
            observed = order_text(result.observed_order)
            visible = exactly(result)
            rows.append([letter, observed, visible, predicted(result)])
            endings.append(verdict(result, paint))
            texts = [hidden(result)] if result.hides_failure else []
            texts += remarks(result)
        said += [f"{letter}: {text}" for text in texts]
    table = padded(rows)
    width = max(map(len, table))
    lines = []
    for line, ending in zip(table, endings, strict=True):
        whole = line.ljust(width) + _GAP + ending
        lines.append(whole.rstrip())
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
        note = text
        if len(said) > 1:
            names = ", ".join(who)
            note = f"{names}: {text}"
        lines += indented(wrapped(note))
    return lines
