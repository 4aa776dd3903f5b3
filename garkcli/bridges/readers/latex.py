"""A pasted LaTeX array: nodes, a bar, the matrix; below a line the weights."""

from __future__ import annotations

import re
from collections import deque
from collections.abc import Iterator
from itertools import pairwise

from garkcli.bridges.readers import printed
from garkcli.bridges.readers.latex_numbers import number_of, without_letters
from garkcli.sources import ir
from garkcli.sources.found import MAX_STAGES, Unreadable

_BEGIN = re.compile(r"\\begin\{(?:array|tabular|butchertable)\}")
_END = re.compile(r"\\end\{(?:array|tabular|butchertable)\}")
_LINE = re.compile(r"\\(?:hline|midrule|cline\{[^{}]*\}|cmidrule\{[^{}]*\})")
_NOTHING = re.compile(
    r"\\(?:toprule|bottomrule|smallskip|medskip|bigskip|strut)(?![A-Za-z])"
    r"|\\(?:noalign|rule|vspace|hspace|phantom)\*?\{[^{}]*\}(?:\{[^{}]*\})?"
)
_BETWEEN = re.compile(rf"({_LINE.pattern})|\\\\(?:\[[^\[\]]*\])?|\\tabularnewline")
_COLUMNS = re.compile(r"[^{]*\{((?:[^{}]|\{(?:[^{}]|\{[^{}]*\})*\})*)\}")
_COMMENT = re.compile(r"(?<!\\)%[^\n]*")
_GENERAL = "q' = f(q, p)"
"""A comment with this says that both parts depend on both."""
MAX_ARRAY = 400_000


_Grid = tuple[list[int], list[list[list[str]]], list[list[str]]]
"""The columns of each vector field, the rows of each set of stages, the rows of weights."""


def _tableaus(text: str) -> Iterator[tuple[int, printed.Values]]:
    comments = [x.group()[1:].strip() for x in _COMMENT.finditer(text)]
    is_general = any(_GENERAL in comment for comment in comments)
    arrays = deque(_arrays(without_letters(_COMMENT.sub("", text))))
    while arrays:
        line, before, inside = arrays.popleft()
        values: printed.Values = {}
        try:
            read = _read(inside)
            if _letter(before) == "Q" and arrays:
                values = _pair(read, _read(arrays[0][2]), is_general)
                if values:
                    arrays.popleft()
            values = values or printed.grid(*read)
        except Unreadable:
            continue
        if values:
            yield line, values


def _arrays(text: str) -> Iterator[tuple[int, str, str]]:
    """The line of each array, the text before it and the text in it."""
    line = 1
    for before, inside in pairwise(_BEGIN.split(text)):
        line += before.count("\n")
        end = _END.search(inside)
        if end and end.start() <= MAX_ARRAY:
            yield line, before[-60:], inside[: end.start()]


def _letter(before: str) -> str:
    words = re.findall(r"\b([QP])\s*:", before)
    return words[-1] if words else ""


def _groups(columns: str) -> list[int]:
    repeated = re.sub(
        r"\*\{([0-9]{1,3})\}\{([clr|]{1,9})\}", lambda x: x[2] * min(int(x[1]), MAX_STAGES), columns
    )
    without = re.sub(r"[@!><]\{[^{}]*\}|[^clr|]", "", repeated)
    parts = [len(part) for part in without.split("|")]
    return [count for count in parts[1:] if count]


def _parts(body: str) -> list[list[list[str]]]:
    parts: list[list[list[str]]] = [[]]
    for piece in filter(None, _BETWEEN.split(_NOTHING.sub(" ", body))):
        if _LINE.fullmatch(piece):
            parts.append([])
        elif piece.strip():
            parts[-1].append([cell.strip() for cell in piece.split("&")])
    return [part for part in parts if part]


def _read(inside: str) -> _Grid:
    """The columns, stages and weights of an array; Unreadable if it is no tableau."""
    columns = _COLUMNS.match(inside[:2_000])
    parts = _parts(inside[columns.end() :] if columns else inside)
    # weights have no node; embedded ones may be below another line
    first = len(parts)
    while first > 1 and not any(row[0] for row in parts[first - 1]):
        first -= 1
    width = max((len(row) for part in parts for row in part), default=0) - 1
    if first == len(parts) or not 0 < width <= MAX_STAGES:
        raise Unreadable("there are no weights below a line")
    groups = _groups(columns[1] if columns else "")
    rows = [[_numbers(row, width + 1) for row in part] for part in parts]
    weights = [row[1:] for part in rows[first:] for row in part]
    return groups if sum(groups) == width else [width], rows[:first], weights


def _numbers(cells: list[str], count: int) -> list[str]:
    """The numbers of ``count`` cells; an empty one stays empty."""
    return [number_of(cell) if cell else "" for cell in cells] + [""] * (count - len(cells))


def _pair(of_q: _Grid, of_p: _Grid, is_general: bool) -> printed.Values:
    """Returns the values of a partitioned method; empty if the arrays Q and P do not fit."""
    if len(of_q[1]) == len(of_p[0]) == 2 and len(of_p[1]) == 1:
        return _semi_separable(of_q, of_p)
    if len(of_q[1]) != 1 or len(of_p[1]) != 1:
        return {}
    (A_q,), (A_p,) = (printed.blocks([sum(x[0])], x[1][0]) for x in (of_q, of_p))
    b_q, b_p = (printed.filled(x[2][0]) for x in (of_q, of_p))
    c_q, c_p = (printed.nodes(x[1][0]) for x in (of_q, of_p))
    if len(c_q) != len(b_p) or len(c_p) != len(b_q):
        return {}
    both: printed.Values = {"b": [b_q, b_p], "parts": ir.Text("q p")}
    if is_general and c_q == c_p and len(b_q) == len(b_p):
        return {**both, "A": [[A_q, A_p]], "c": [c_q], "structure": ir.Text("general")}
    A: printed.Nested = [[None, A_p], [A_q, None]]
    return {**both, "A": A, "c": [c_p, c_q], "structure": ir.Text("separable")}


def _semi_separable(of_q: _Grid, of_p: _Grid) -> printed.Values:
    """The second Hamiltonian depends on q alone, so the stages of F2 depend on V1 alone."""
    groups, _, weights = of_p
    first, last = of_q[1]
    all_columns = [sum(of_q[0])]
    shared = [*printed.blocks(all_columns, first), *printed.blocks(groups, of_p[1][0])]
    of_forces = list(map(printed.filled, printed.split(weights[0], groups)))
    if [len(x) for x in of_forces] != [len(first), len(last)]:
        return {}
    A: printed.Nested = [shared, shared, [*printed.blocks(all_columns, last), None, None]]
    c = [printed.nodes(x) for x in (first, first, last)]
    return {"A": A, "b": [printed.filled(of_q[2][0]), *of_forces], "c": c}


READER = printed.reader(
    "latex",
    "LaTeX: an array with nodes, a bar, the matrix, a line, the weights",
    (".tex", ".ltx", ".md"),
    _tableaus,
)
