"""A pasted LaTeX array: nodes, a bar, the matrix; below a line the weights."""

from __future__ import annotations

import re
from collections import deque
from collections.abc import Iterator, Mapping
from itertools import pairwise

from garkcli.bridges.readers.latex_numbers import number_of
from garkcli.bridges.readers.printed import Nested, found_in, printed
from garkcli.sources import ir
from garkcli.sources.found import MAX_STAGES, FoundTable, Reader, Unreadable

NAME = "latex"
_BEGIN = re.compile(r"\\begin\{(?:array|tabular|butchertable)\}")
_END = re.compile(r"\\end\{(?:array|tabular|butchertable)\}")
_LINE = re.compile(r"\\(?:hline|midrule|cline\{[^{}]*\}|cmidrule\{[^{}]*\})")
_NOTHING = re.compile(
    r"\\(?:toprule|bottomrule|smallskip|medskip|bigskip|strut)(?![A-Za-z])"
    r"|\\(?:noalign|rule|vspace|hspace|phantom)\*?\{[^{}]*\}(?:\{[^{}]*\})?"
)
_COMMENT = re.compile(r"(?<!\\)%[^\n]*")
_GENERAL = "q' = f(q, p)"
"""In a comment: both parts see both."""
MAX_ARRAY = 400_000
"""Longest text of one array."""


def find(text: str, source: str) -> list[FoundTable]:
    """The arrays of a text that are tableaus."""
    return found_in(source, NAME, _tableaus(text))


def _tableaus(text: str) -> Iterator[ir.Statement]:
    comments = [x.group()[1:].strip() for x in _COMMENT.finditer(text)]
    is_general = any(_GENERAL in comment for comment in comments)
    arrays = deque(_arrays(_COMMENT.sub("", text)))
    while arrays:
        line, before, columns, body = arrays.popleft()
        values: Mapping[str, Nested] = {}
        try:
            read = _read(columns, body)
            if _letter(before) == "Q" and arrays:
                values = _pair(read, _read(*arrays[0][2:]), is_general)
                if values:
                    arrays.popleft()
            values = values or _table(read)
        except Unreadable:
            continue
        if values:
            yield printed(line, **values)


_Parts = tuple[list[int], list[list[list[str]]], list[list[str]]]
_Array = tuple[int, str, str, str]


def _arrays(text: str) -> Iterator[_Array]:
    """The line of each array, what is before it, its columns and its rows."""
    line = 1
    for before, inside in pairwise(_BEGIN.split(text)):
        line += before.count("\n")
        end = _END.search(inside)
        columns, body = _columns(inside[: end.start()]) if end else ("", "")
        if end and len(body) <= MAX_ARRAY:
            yield line, before[-60:], columns, body


def _columns(inside: str) -> tuple[str, str]:
    """The column specification in braces, and what is behind it."""
    start = inside.find("{")
    if start < 0:
        return "", inside
    depth = 0
    for place in range(start, min(len(inside), start + 2_000)):
        if inside[place] == "{":
            depth += 1
        elif inside[place] == "}":
            depth -= 1
            if not depth:
                return inside[start + 1 : place], inside[place + 1 :]
    return "", inside


def _letter(before: str) -> str:
    """The Q or P that is written before an array of a pair."""
    words = re.findall(r"\b([QP])\s*:", before)
    return words[-1] if words else ""


def _groups(columns: str) -> list[int]:
    """How many columns are between the bars, without that of the nodes."""
    repeated = re.sub(
        r"\*\{([0-9]{1,3})\}\{([clr|]{1,9})\}", lambda x: x[2] * min(int(x[1]), MAX_STAGES), columns
    )
    without = re.sub(r"[@!><]\{[^{}]*\}|[^clr|]", "", repeated)
    parts = [len(part) for part in without.split("|")]
    return [count for count in parts[1:] if count]


def _parts(body: str) -> list[list[list[str]]]:
    """The cells of each row, the rows between horizontal lines together."""
    parts: list[list[list[str]]] = [[]]
    clean = _NOTHING.sub(" ", body)
    for piece in re.split(r"\\\\(?:\[[^\[\]]*\])?|\\tabularnewline", clean):
        rest = piece
        while True:
            line = _LINE.search(rest)
            if line is None or rest[: line.start()].strip():
                break
            if parts[-1]:
                parts.append([])
            rest = rest[line.end() :]
        if rest.strip():
            line = _LINE.search(rest)
            row = rest if line is None else rest[: line.start()]
            parts[-1].append([cell.strip() for cell in row.split("&")])
    return [part for part in parts if part]


def _numbers(cells: list[str]) -> list[str]:
    """The numbers of cells; an empty one stays empty."""
    return [number_of(cell) if cell else "" for cell in cells]


def _read(columns: str, body: str) -> _Parts:
    """The columns of each vector field, the rows of each set of stages, the rows of weights.

    Raises:
        Unreadable: it is no tableau.
    """
    parts = _parts(body)
    if len(parts) < 2:
        raise Unreadable("there is no line above the weights")
    # weights have no node; embedded ones may be below a line of their own
    first = len(parts)
    while first > 1 and not any(row[0] for row in parts[first - 1]):
        first -= 1
    below = [row for part in parts[first:] for row in part]
    above = parts[:first]
    if not below or not above:
        raise Unreadable("there are no weights")
    width = max(len(row) for part in parts for row in part) - 1
    if not 0 < width <= MAX_STAGES:
        raise Unreadable("there are no columns")
    groups = _groups(columns)
    if sum(groups) != width:
        groups = [width]
    stages = [[_padded(row, width) for row in part] for part in above]
    weights = [_padded(row, width)[1:] for row in below]
    return groups, stages, weights


def _padded(row: list[str], width: int) -> list[str]:
    missing = width + 1 - len(row)
    return _numbers(row + [""] * missing)


def _split(row: list[str], groups: list[int]) -> list[list[str]]:
    found = []
    start = 0
    for count in groups:
        found.append(row[start : start + count])
        start += count
    return found


def _filled(row: list[str]) -> list[str]:
    return [x or "0" for x in row]


def _blocks(groups: list[int], rows: list[list[str]]) -> list[Nested]:
    """The blocks of a set of stages; an empty one of several is none."""
    columns = [_split(row[1:], groups) for row in rows]
    blocks: list[Nested] = []
    for m in range(len(groups)):
        cells = [row[m] for row in columns]
        is_empty = len(groups) > 1 and not any(map(any, cells))
        blocks.append(None if is_empty else list(map(_filled, cells)))
    return blocks


def _nodes(rows: list[list[str]]) -> list[str]:
    return _filled([row[0] for row in rows])


def _table(read: _Parts) -> Mapping[str, Nested]:
    groups, stages, weights = read
    if len(stages) == 1 and len(groups) > 1:
        # colours that share their stages, or a bar that means nothing
        is_shared = len(set(groups)) == 1 and groups[0] == len(stages[0])
        groups = groups if is_shared else [sum(groups)]
    elif len(stages) not in (1, len(groups)):
        return {}
    due = groups if len(stages) > 1 else groups[:1]
    if [len(rows) for rows in stages] != due:
        return {}
    below = [list(map(_filled, _split(row, groups))) for row in weights]
    return {
        "A": [_blocks(groups, rows) for rows in stages],
        "b": below[0],
        "c": list(map(_nodes, stages)),
        "embedded": below[1] if len(below) == 2 else None,
    }


def _pair(of_q: _Parts, of_p: _Parts, is_general: bool) -> Mapping[str, Nested]:
    """The arrays Q and P of a partitioned method, with columns of one vector field each."""
    if len(of_q[1]) == len(of_p[0]) == 2 and len(of_p[1]) == 1:
        return _semi_separable(of_q, of_p)
    if len(of_q[1]) != 1 or len(of_p[1]) != 1:
        return {}
    (A_q,), (A_p,) = (_blocks([sum(x[0])], x[1][0]) for x in (of_q, of_p))
    (b_q, c_q), (b_p, c_p) = ((_filled(x[2][0]), _nodes(x[1][0])) for x in (of_q, of_p))
    if len(c_q) != len(b_p) or len(c_p) != len(b_q):
        return {}
    both: Mapping[str, Nested] = {"b": [b_q, b_p], "parts": ir.Text("q p")}
    if is_general and c_q == c_p and len(b_q) == len(b_p):
        return {**both, "A": [[A_q, A_p]], "c": [c_q], "structure": ir.Text("general")}
    A: Nested = [[None, A_p], [A_q, None]]
    return {**both, "A": A, "c": [c_p, c_q], "structure": ir.Text("separable")}


def _semi_separable(of_q: _Parts, of_p: _Parts) -> Mapping[str, Nested]:
    """A pair whose second Hamiltonian is of q alone: vector fields V1, F1 and F2.

    V1 and F1 have the stages of the first rows of Q, which are those of P; F2 has the others,
    which see V1 alone.
    """
    groups, _, weights = of_p
    first, last = of_q[1]
    whole = [sum(of_q[0])]
    shared = [*_blocks(whole, first), *_blocks(groups, of_p[1][0])]
    of_forces = list(map(_filled, _split(weights[0], groups)))
    if [len(x) for x in of_forces] != [len(first), len(last)]:
        return {}
    nodes = [_nodes(first), _nodes(first), _nodes(last)]
    A: Nested = [shared, shared, [*_blocks(whole, last), None, None]]
    return {"A": A, "b": [_filled(of_q[2][0]), *of_forces], "c": nodes}


READER = Reader(
    NAME,
    "LaTeX: an array with nodes, a bar, the matrix, a line, the weights",
    (".tex", ".ltx", ".md"),
    find,
)
