"""A pasted LaTeX array: nodes, a bar, the matrix; below a line the weights."""

from __future__ import annotations

import re
from collections.abc import Iterator

from garkcli.bridges.readers.latex_numbers import number_of
from garkcli.sources.allowance import Allowance
from garkcli.sources.found import MAX_STAGES, FoundTable, Grid, Reader, Row, Rows, Unreadable

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
    comments = [x.group()[1:].strip() for x in _COMMENT.finditer(text)]
    is_general = any(_GENERAL in comment for comment in comments)
    plain = _COMMENT.sub("", text)
    arrays = list(_arrays(plain))
    allowance = Allowance()
    found: list[FoundTable] = []
    place = 0
    while place < len(arrays):
        line, before, columns, body = arrays[place]
        pair = None
        if _letter(before) == "Q" and place + 1 < len(arrays):
            two = arrays[place], arrays[place + 1]
            pair = _pair(*two, source, is_general)
        if pair is not None:
            found.append(allowance.table(pair))
            place += 2
            continue
        table = _table(line, columns, body, source)
        if table is not None:
            found.append(allowance.table(table))
        place += 1
    return found


_Parts = tuple[list[int], list[list[list[str]]], list[list[str]]]
_Array = tuple[int, str, str, str]


def _arrays(text: str) -> Iterator[_Array]:
    """The line of each array, what stands before it, its columns and its rows."""
    place = 0
    line = 1
    counted = 0
    while True:
        begin = _BEGIN.search(text, place)
        if begin is None:
            return
        end = _END.search(text, begin.end())
        if end is None:
            return
        line += text.count("\n", counted, begin.start())
        counted = begin.start()
        inside = text[begin.end() : end.start()]
        columns, body = _columns(inside)
        if len(body) <= MAX_ARRAY:
            before = text[max(0, begin.start() - 60) : begin.start()]
            yield line, before, columns, body
        place = end.end()


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
    """How many columns stand between the bars, without that of the nodes."""
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
    # weights have no node; embedded ones may stand below a line of their own
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


def _filled(row: list[str]) -> Row:
    return tuple(x or "0" for x in row)


def _blocks(
    groups: list[int], stages: list[list[list[str]]]
) -> tuple[Grid, tuple[Row | None, ...]]:
    """The blocks of each set of stages; an empty one is none."""
    grid: list[tuple[Rows | None, ...]] = []
    nodes: list[Row | None] = []
    for rows in stages:
        nodes.append(_filled([row[0] for row in rows]))
        blocks: list[Rows | None] = []
        columns = [_split(row[1:], groups) for row in rows]
        for m in range(len(groups)):
            cells = [row[m] for row in columns]
            is_empty = len(groups) > 1 and not any(map(any, cells))
            block = tuple(_filled(row) for row in cells)
            blocks.append(None if is_empty else block)
        grid.append(tuple(blocks))
    return tuple(grid), tuple(nodes)


def _table(line: int, columns: str, body: str, source: str) -> FoundTable | None:
    try:
        groups, stages, weights = _read(columns, body)
        if len(stages) == 1 and len(groups) > 1:
            # colours that share their stages, or a bar that means nothing
            shared = len(set(groups)) == 1 and groups[0] == len(stages[0])
            groups = groups if shared else [sum(groups)]
        elif len(stages) not in (1, len(groups)):
            return None
        grid, nodes = _blocks(groups, stages)
    except Unreadable:
        return None
    if not _fits(grid, groups, len(stages) == 1):
        return None
    rows = [tuple(map(_filled, _split(row, groups))) for row in weights]
    return FoundTable(
        source, line, NAME, "", grid, rows[0], nodes, embedded=rows[1] if len(rows) == 2 else None
    )


def _fits(grid: Grid, groups: list[int], is_shared: bool) -> bool:
    """Whether each set of stages has as many rows as its columns."""
    for l, row in enumerate(grid):
        due = groups[0] if is_shared else groups[l]
        if any(block is not None and len(block) != due for block in row):
            return False
    return True


def _pair(first: _Array, second: _Array, source: str, is_general: bool) -> FoundTable | None:
    """The arrays Q and P of a partitioned method, with columns of one vector field each."""
    try:
        of_q = _read(first[2], first[3])
        of_p = _read(second[2], second[3])
    except Unreadable:
        return None
    if len(of_q[1]) == len(of_p[0]) == 2 and len(of_p[1]) == 1:
        return _semi_separable(first[0], of_q, of_p, source)
    parts = []
    for groups, stages, weights in (of_q, of_p):
        if len(stages) != 1:
            return None
        whole = [sum(groups)]
        grid, nodes = _blocks(whole, stages)
        block = grid[0][0]
        assert block is not None
        parts.append((block, _filled(weights[0]), nodes[0]))
    (A_q, b_q, c_q), (A_p, b_p, c_p) = parts
    if len(A_q) != len(b_p) or len(A_p) != len(b_q):
        return None
    is_shared = is_general and c_q == c_p and len(b_q) == len(b_p)
    grid_of_pair: Grid = ((None, A_p), (A_q, None))
    return FoundTable(
        source,
        first[0],
        NAME,
        "",
        ((A_q, A_p),) if is_shared else grid_of_pair,
        (b_q, b_p),
        (c_q,) if is_shared else (c_p, c_q),
        parts=("q", "p"),
        structure="general" if is_shared else "separable",
    )


def _semi_separable(line: int, of_q: _Parts, of_p: _Parts, source: str) -> FoundTable | None:
    """A pair whose second Hamiltonian is of q alone: vector fields V1, F1 and F2.

    V1 and F1 have the stages of the first rows of Q, which are those of P; F2 has the others,
    which see V1 alone.
    """
    groups, _, weights = of_p
    grid_q, nodes = _blocks([sum(of_q[0])], of_q[1])
    grid_p, _ = _blocks(groups, of_p[1])
    shared = (grid_q[0][0], *grid_p[0])
    of_forces = tuple(map(_filled, _split(weights[0], groups)))
    b = (_filled(of_q[2][0]), *of_forces)
    grid: Grid = (shared, shared, (grid_q[1][0], None, None))
    if [len(x) for x in b[1:]] != [len(x) for x in nodes if x]:
        return None
    c = (nodes[0], *nodes)
    return FoundTable(source, line, NAME, "", grid, b, c)


READER = Reader(
    NAME,
    "LaTeX: an array with nodes, a bar, the matrix, a line, the weights",
    (".tex", ".ltx", ".md"),
    find,
)
