"""``gark converge`` with several methods: one table, one plot, one verdict a method."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Sequence
from itertools import pairwise
from math import ceil, floor

from flint import arb, fmpq

from garkcli.convergence.convergence import Row
from garkcli.convergence.work import Cost
from garkcli.problems.hamiltonian import Hamiltonian
from garkcli.report.asciiplot import SEVERAL, log10, terminal_curves
from garkcli.report.convergence import (
    NO_TIME,
    WIDTH,
    WORK,
    exactly,
    predicted,
    remarks,
    verdict,
    work_cells,
    wrapped,
)
from garkcli.report.convergence_data import Entry, Result, csv_of_several, json_of_several, note
from garkcli.report.figures import scientific
from garkcli.report.paint import Paint, aligned

_LONGEST = 60  # characters of a Hamiltonian that are still shown
_GOALS = 6  # errors at which costs are compared


def render(
    entries: Sequence[Entry],
    format: str,  # noqa: A002
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


def title(results: Sequence[Result]) -> str:
    """What all of them have solved, without its split."""
    result = results[0]
    return f"{_about(result)}; to t = {result.t_end}"


def _about(result: Result) -> str:
    problem = result.problem
    if not isinstance(problem, Hamiltonian):
        return f"oscillator; q̈ = −ω²q, ω = {problem.omega}"
    text = str(problem.energy).replace("**", "^")
    return f"{problem.name}; H = {text}" if len(text) <= _LONGEST else problem.name


def _text(entries: Sequence[Entry], paint: Paint, with_work: bool, against: str) -> list[str]:
    named = list(zip(letters(len(entries)), entries, strict=True))
    tested = [(letter, x.result) for letter, x in named if x.result is not None]
    names = [entry.name for entry in entries]
    lines = [paint("strong", f"{len(entries)} methods")]
    if tested:
        lines += [f"  {line}" for line in wrapped(title([result for _, result in tested]))]
    lines.append("")
    for letter, entry in named:
        where = (
            f" ({entry.file})" if names.count(entry.name) > 1 and entry.name != entry.file else ""
        )
        lines.append(f"  {paint('strong', letter)}  {entry.name}{where}")
    for block in _blocks(tested):
        lines += ["", *(f"  {line}" for line in block)]
    lines += ["", *(f"  {line}" for line in _verdicts(named, paint)), *_notes(tested)]
    if with_work and tested:
        lines += ["", *_work(tested)]
    curves = {letter: list(curve(result, against)) for letter, result in tested}
    if any(curves.values()):
        plot = terminal_curves(curves, against)
        lines += ["", *(f"  {line}" for line in plot.splitlines())]
        lines += [f"  {SEVERAL} several methods"] * (SEVERAL in plot)
    return lines


def _blocks(tested: Sequence[tuple[str, Result]]) -> list[list[str]]:
    """Errors and slopes side by side: as few tables as fit, with as many methods each."""
    for count in range(1, len(tested) + 1):
        bounds = [round(k * len(tested) / count) for k in range(count + 1)]
        blocks = [_side_by_side(tested[a:b]) for a, b in pairwise(bounds)]
        if (
            count == len(tested)
            or max(len(line) for block in blocks for line in block) <= WIDTH - 2
        ):
            return blocks
    return []


def _side_by_side(tested: Sequence[tuple[str, Result]]) -> list[str]:
    sizes = sorted({row.h for _, result in tested for row in result.rows}, reverse=True)
    columns = [aligned([[""], ["h"], *([str(h)] for h in sizes)])]
    for letter, result in tested:
        rows = {row.h: row for row in result.rows}
        cells = [["error", "slope"], *(_cells(rows.get(h)) for h in sizes)]
        pair = aligned(cells)
        width = max(map(len, pair))
        columns.append([letter.center(width), *(line.ljust(width) for line in pair)])
    return ["   ".join(parts).rstrip() for parts in zip(*columns, strict=True)]


def _cells(row: Row | None) -> list[str]:
    if row is None:
        return ["", ""]
    return [scientific(row.error), "" if row.slope is None else f"{row.slope:.2f}"]


def _verdicts(named: Sequence[tuple[str, Entry]], paint: Paint) -> list[str]:
    """A line a method: observed, visible and predicted order, and whether they agree."""
    heads = ["order", "observed", "on this problem", "of the method"]
    rows, endings = [heads], [""]
    for letter, entry in named:
        result = entry.result
        if result is None:
            rows.append([letter, "", "", ""])
            endings.append(paint("bad", "FAILED"))
            continue
        observed = "none" if result.observed_order is None else f"{result.observed_order:.2f}"
        rows.append([letter, observed, exactly(result), predicted(result)])
        endings.append(verdict(result, paint))
    width = max(map(len, _padded(rows)))
    lines = [
        f"{line:{width}}   {end}".rstrip() for line, end in zip(_padded(rows), endings, strict=True)
    ]
    for letter, entry in named:
        if entry.result is not None:
            lines += [
                line for text in remarks(entry.result) for line in wrapped(f"{letter}: {text}")
            ]
        for fault in entry.faults:
            lines += wrapped(f"{letter}: {fault.message}")
    return lines


def _padded(rows: Sequence[Sequence[str]], gap: str = "   ") -> list[str]:
    """The first column to the left, the others to the right."""
    widths = [max(len(row[j]) for row in rows) for j in range(len(rows[0]))]
    return [
        gap.join(
            x.ljust(w) if j == 0 else x.rjust(w)
            for j, (x, w) in enumerate(zip(row, widths, strict=True))
        ).rstrip()
        for row in rows
    ]


def _notes(tested: Sequence[tuple[str, Result]]) -> list[str]:
    """What the problem can see, once for all methods with the same answer."""
    said: dict[str, list[str]] = {}
    for letter, result in tested:
        said.setdefault(note(result), []).append(letter)
    lines = []
    for text, who in said.items():
        lines += [
            f"  {line}" for line in wrapped(text if len(said) == 1 else f"{', '.join(who)}: {text}")
        ]
    for letter, result in tested:
        if count := getattr(result, "plateau", 0):
            lines.append(
                f"  {letter}: the last {count} rows show the rounding of the coefficients, and are not fitted"
            )
    return lines


def _work(tested: Sequence[tuple[str, Result]]) -> list[str]:
    """What the rows have cost, and what errors of the same size have."""
    rows = [["work", "h", "error", *WORK]]
    for letter, result in tested:
        for i, row in enumerate(result.rows):
            rows.append(
                [letter if i == 0 else "", str(row.h), scientific(row.error), *work_cells(row.cost)]
            )
    lines = [f"  {line}" for line in _padded(rows, "  ")]
    costs = [row.cost for _, result in tested for row in result.rows]
    if any(cost is None or cost.seconds is None for cost in costs):
        lines.append(f"  {NO_TIME}")
    tables = [_at_equal_errors(tested, what) for what in ("evaluations", "seconds")]
    for table in filter(None, tables):
        lines += ["", *(f"  {line}" for line in table)]
    return [*lines, "  read off between the rows, on logarithmic scales"] if any(tables) else lines


def amount(cost: Cost | None, what: str) -> float | None:
    """How much of ``what`` a row has cost: evaluations or seconds; None where that is not known."""
    if cost is None:
        return None
    return float(cost.evaluations) if what == "evaluations" else cost.seconds


def curve(result: Result, against: str) -> Iterable[tuple[float | fmpq, arb]]:
    """The points (x, error) of a plot against h, evaluations or seconds, where both are known and
    positive.
    """
    for row in result.rows:
        x = row.h if against == "h" else amount(row.cost, against)
        if x is not None and row.error > 0:
            yield x, row.error


def _at_equal_errors(tested: Sequence[tuple[str, Result]], what: str) -> list[str]:
    """A line a method: what errors of 10^k cost, where it has larger and smaller ones."""
    curves = {
        letter: [(log10(error), log10(x)) for x, error in curve(result, what)]
        for letter, result in tested
    }
    goals = _goals([[y for y, _ in points] for points in curves.values() if points])
    rows = [[f"{what} for an error of", *(f"1e{k}" for k in goals)]]
    for letter, points in curves.items():
        found = [_between(points, k) for k in goals]
        rows.append([letter, *("" if x is None else _amount(10**x, what) for x in found)])
    return _padded(rows, "  ") if goals else []


def _amount(x: float, what: str) -> str:
    return str(round(x)) if what == "evaluations" else scientific(arb(x), 2)


def _goals(errors: Sequence[Sequence[float]]) -> list[int]:
    """Whole decades, thinned out evenly, that at least two methods reach, or one where no two
    do.
    """
    spans = [(ceil(min(ys)), floor(max(ys))) for ys in errors if len(ys) > 1]
    reached = Counter(k for least, most in spans for k in range(least, most + 1))
    shared = [k for k, count in reached.items() if count > 1] or list(reached)
    decades = sorted(shared, reverse=True)
    return decades[:: max(1, -(-len(decades) // _GOALS))]


def _between(points: Sequence[tuple[float, float]], goal: float) -> float | None:
    """The second coordinate where the first is ``goal``, on the line between two neighbours."""
    for (a, x), (b, y) in pairwise(points):
        if min(a, b) <= goal <= max(a, b) and a != b:
            return x + (y - x) * (goal - a) / (b - a)
    return None
