"""A Butcher tableau pasted as text: rows of numbers, with or without bars.

    0   |
    1/2 | 1/2
    ----+--------
        | 0   1

Rows are lines; zeros at their ends may be left out. A bar, or & as in LaTeX, parts the node from
the row. Without one a column more than there are stages is that of the nodes. Cells of a table,
parted by &, by tabs as pages and spreadsheets give them, or by commas, may be empty: zeros.
"""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Sequence
from itertools import takewhile
from typing import TypeAlias

from garkcli.errors import MethodError, counted
from garkcli.frozen import Frozen

_MINUS = dict.fromkeys("\N{MINUS SIGN}\N{EN DASH}", "-")
_BLANKS = dict.fromkeys(
    "\N{NO-BREAK SPACE}\N{THIN SPACE}\N{NARROW NO-BREAK SPACE}\N{EM SPACE}", " "
)
_SIGNS = str.maketrans({**_MINUS, **_BLANKS, "\N{FRACTION SLASH}": "/", "\N{DIVISION SLASH}": "/"})
_ROOT = "\N{SQUARE ROOT}"
_OF_LATEX = (
    (r"\\(?:begin|end)\{\w+\*?\}(?:\{[^{}]*\})?", "\n"),
    (r"\\(?:hline|[ct]?midrule|toprule|bottomrule)\b|\\cline\{[^{}]*\}", "\n"),
    (r"\\\\(?:\[[^\]]*\])?", "\n"),
    (r"\\[dt]?frac\s*([0-9])\s*([0-9])", r"\1/\2"),
    (r"\\[dt]?frac\s*\{([0-9]+)\}\s*\{([0-9]+)\}", r"\1/\2"),
    (r"\\[dt]?frac\s*\{([^{}]*)\}\s*\{([^{}]*)\}", r"(\1)/(\2)"),
    (r"\\sqrt\s*\{([^{}]*)\}|\\sqrt\s*([0-9])", r"sqrt(\1\2)"),
    (r"\\left|\\right|\\displaystyle|\\phantom\{[^{}]*\}|\$|\\[,;!:]", ""),
)
"""LaTeX commands and their replacements, applied repeatedly from the inside out."""


def plain(text: str) -> str:
    r"""The text in ASCII characters.

    >>> plain("½ − √3/6"), plain(r"$\frac{1}{2}$ & \frac12 \\ \hline")
    ('1/2 - sqrt(3)/6', '1/2 & 1/2 \n \n')
    """
    text = "".join(map(_fraction, " " + text, text)).translate(_SIGNS)
    text = re.sub(rf"{_ROOT}\s*([0-9]+)", r"sqrt(\1)", text)
    text = re.sub(rf"{_ROOT}\s*\(", "sqrt(", text)
    if "\\" not in text and "$" not in text:
        return text
    before = ""
    while text != before:
        before = text
        # a root may be in a fraction, and a fraction in a root
        for pattern, instead in _OF_LATEX:
            text = re.sub(pattern, instead, text)
    return text


def _fraction(before: str, sign: str) -> str:
    """A one-character fraction written out, except after a digit."""
    written = unicodedata.normalize("NFKC", sign)
    is_fraction = "\N{FRACTION SLASH}" in written and sign != written
    return written if is_fraction and not before.isdigit() else sign


_Row: TypeAlias = tuple[str, ...]
MOST_LINES = 1000
_RULE = re.compile(r"[\s|+=─│┼,&-]*")
_BAR = re.compile(r"\|\|?|│|&")
_BETWEEN = re.compile(r"[\s,;&]+")
_EMPTY_CELL = re.compile(r"^,|,\s*,|,\s*$", re.MULTILINE)
_OF_TABLES = ("\t", ",")
_EXAMPLE = "for instance: 0 | 0 0, below it 1/2 | 1/2 0, below it | 0 1"
_IN_BRACKETS = "a list in brackets belongs into a file: A: [[0, 0], [1/2, 0]]"


class Pasted(Frozen):
    """The rows of A are filled with zeros."""

    A: tuple[_Row, ...]
    b: _Row
    c: _Row | None = None
    embedded: _Row | None = None


class _PastedLine(Frozen):
    """``node`` is None if no bar separates one from the row."""

    node: str | None
    row: _Row


def read_pasted(text: str) -> Pasted:
    r"""Lines of stages, of weights, perhaps of embedded weights; MethodError for other texts.

    >>> read_pasted("0 |\n1/2 | 1/2\n---\n | 0 1").A
    (('0', '0'), ('1/2', '0'))
    """
    text = plain(text)
    sign = _between_cells(text)
    lines = [_line(x, sign) for x in text.splitlines() if not _is_rule(x)]
    if len(lines) > MOST_LINES:
        raise MethodError("the tableau has too many lines", "paste one", code="too-many")
    if len(lines) < 2:
        message = "no tableau: a line per stage and a line of weights are expected"
        raise MethodError(message, _IN_BRACKETS if "[" in text else _EXAMPLE, code="pasted-tableau")
    if sign in _OF_TABLES and lines[-1].node:
        # the first column is none of nodes: weights have an entry there
        rows = [(line.node or "0", *line.row) for line in lines]
        longest = max(map(len, rows))
        lines = [_PastedLine(None, _filled(row, longest)) for row in rows]
    has_bars = any(line.node is not None for line in lines)
    return _with_nodes(lines) if has_bars else _without_bars(lines)


def _is_rule(text: str) -> bool:
    return _RULE.fullmatch(text.strip()) is not None


def _between_cells(text: str) -> str:
    """The separator of the cells of a table; empty for numbers side by side."""
    rows = [x for x in text.splitlines() if not _is_rule(x)]
    if any(x.count("&") > 1 for x in rows):
        return "&"
    if not rows or any(_BAR.search(x) for x in rows):
        return ""
    if any("\t" in x.rstrip() for x in rows):
        return "\t"
    return "," if _EMPTY_CELL.search("\n".join(rows)) else ""


def _filled(row: _Row, length: int) -> _Row:
    return row + ("0",) * (length - len(row))


def _line(text: str, sign: str) -> _PastedLine:
    """``sign`` separates cells, the first of which is the node; it is empty for blanks."""
    if sign:
        node, *cells = (x.strip() for x in text.split(sign))
        while cells and not cells[-1]:
            cells.pop()
        return _PastedLine(node, tuple(x or "0" for x in cells))
    *before, numbers = _BAR.split(text.strip().removesuffix(";").strip(), maxsplit=1)
    row = tuple(filter(None, _BETWEEN.split(numbers.strip(" |"))))
    return _PastedLine(before[0].strip() if before else None, row)


def _with_nodes(lines: list[_PastedLine]) -> Pasted:
    """Stages have a node before the bar; the first explicit one may be its node 0 alone."""
    first = lines[0]
    if first.node is None and len(first.row) == 1 and not first.row[0].strip("0."):
        lines = [_PastedLine(first.row[0], ()), *lines[1:]]
    nodes = tuple(takewhile(bool, (line.node or "" for line in lines)))
    rows = [line.row for line in lines]
    return _made(rows[: len(nodes)], rows[len(nodes) :], nodes)


def _without_bars(lines: list[_PastedLine]) -> Pasted:
    rows = [line.row for line in lines]
    longest = max(map(len, rows))
    weights = [rows.pop()]
    if len(rows) > 1 and len(rows[-1]) == len(weights[0]) == len(rows) - 1:
        weights.insert(0, rows.pop())
    stages = len(rows)
    if stages > 1 and [len(row) for row in rows] == list(range(1, stages + 1)):
        message = "rows of 1, 2, … numbers: nodes may come first, or the diagonal last"
        cure = "part nodes from their rows by |, or write the zeros"
        raise MethodError(message, cure, code="pasted-tableau")
    if longest == stages + 1 == len(rows[-1]):
        return _made([row[1:] for row in rows], weights, tuple(row[0] for row in rows))
    return _made(rows, weights, None)


def _made(rows: Sequence[_Row], weights: Sequence[_Row], nodes: _Row | None) -> Pasted:
    stages = len(rows)
    if not weights or not stages:
        message = "the tableau has no line of weights"
        cure = "a line below the stages, with nothing before the bar"
        raise MethodError(message, cure, code="pasted-tableau")
    if len(weights) > 2:
        message = f"{len(weights)} lines follow the stages"
        cure = "one of weights, and another of embedded ones"
        raise MethodError(message, cure, code="pasted-tableau")
    of_stages = counted(stages, "stage")
    for i, row in enumerate(rows, start=1):
        if len(row) > stages:
            message = f"row {i} has {len(row)} entries, for {of_stages}"
            cure = "a line per stage, and a line of weights below"
            raise MethodError(message, cure, code="pasted-tableau")
    for row in weights:
        if len(row) != stages:
            message = f"{counted(len(row), 'weight')} for {of_stages}"
            raise MethodError(message, "a weight per stage, zeros too", code="pasted-tableau")
    return Pasted(tuple(_filled(row, stages) for row in rows), weights[0], nodes, *weights[1:])
