"""Methods from arrays, through the text of a method file, so that both have the same meaning."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Set
from operator import index
from typing import Any, SupportsIndex

from garkcli.errors import MethodError
from garkcli.exact.given import number_text
from garkcli.grammar.editing import quoted
from garkcli.methodfile.build import MethodFile
from garkcli.methodfile.load import loads

SOURCE = "<arrays>"


def from_arrays(
    A: Any, b: Any, c: Any = None, embedded: Any = None, *, name: str = "", tolerance: Any = None
) -> MethodFile:
    """The method with the coefficients ``A``, ``b`` and, where they are not the row sums, ``c``.

    Arrays are lists, tuples, NumPy arrays or matrices of SymPy or FLINT. Their entries are ints,
    Fractions, Decimals, floats, texts such as ``"1/2 - sqrt(3)/6"``, or numbers of NumPy, SymPy or
    FLINT. They are taken exactly; a float stands for its shortest decimal, so 0.1 is one tenth, and
    floats of more than 15 digits need a ``tolerance``.

    Args:
        A: the matrix, shape (s, s); the rows of a triangle may end at the diagonal or before it,
            and an explicit method may lack the last column. For N colours N rows of N blocks, shape
            (s_l, s_m), None if colour l does not depend on m; or a mapping of pairs (l, m), counted
            from 1, to blocks.
        b: the weights, length s; for N colours a row each, or a mapping of colours to rows.
        c: the nodes, length s; for N colours a row each.
        embedded: embedded weights, as b.
        name: the name of the method.
        tolerance: the rounding of the coefficients, for instance ``"1e-13"``.

    Raises:
        MethodError: an entry is not an exact number.
        MethodFileError: the numbers do not make a method.

    >>> from_arrays([[0, 0], [1, 0]], [0.5, "1/2"], name="Heun", embedded=[1, 0])
    <MethodFile Heun: 1 colour, stages 2>
    """
    if b is None:
        raise MethodError("b is missing", "give the weights: from_arrays(A, b)", code="missing-key")
    writer = _ArrayWriter(is_rounded=tolerance is not None)
    A = _triangle(_listed(_in_rows(A, "A")))
    entries: dict[str, str] = {}
    if name:
        entries["name"] = _quoted(name)
    entries["A"] = writer.text(A, "A")
    for key, rows in (("b", b), ("c", c), ("embedded", embedded)):
        listed = _listed(_in_rows(rows, key))
        if _depth(A) <= 2:
            listed = _one_row(listed)
        if listed is not None:
            entries[key] = writer.text(listed, key)
    if tolerance is not None:
        entries["tolerance"] = number_text(tolerance, "tolerance", is_rounded=True)
    return loads("".join([f"{key}: {text}\n" for key, text in entries.items()]), SOURCE)


_PLAIN = re.compile(r"-?(0|[1-9][0-9]*)([./][0-9]+)?(e-?[0-9]+)?", re.ASCII)
"""Numbers that every YAML reader takes for the same."""


class _ArrayWriter:
    def __init__(self, is_rounded: bool) -> None:
        self.is_rounded = is_rounded

    def text(self, value: Any, where: str, *place: int) -> str:
        if value is None:
            return "null"
        if isinstance(value, list):
            items = [self.text(x, where, *place, i) for i, x in enumerate(value, start=1)]
            return f"[{', '.join(items)}]"
        return _quoted(number_text(value, _called(where, place), self.is_rounded))


def _called(where: str, place: tuple[int, ...]) -> str:
    """Returns the name of an entry in messages, counted from 1.

    >>> _called("A", (1, 2)), _called("b", (3,)), _called("A", (1, 2, 3, 4)), _called("b", (2, 1))
    ('A, row 1, entry 2', 'b, entry 3', 'A{1,2}, row 3, entry 4', 'b{2}, entry 1')
    """
    inner = 2 if where == "A" else 1
    colours, entry = place[:-inner], place[-inner:]
    if colours:
        where += f"{{{','.join(map(str, colours))}}}"
    words = ("row", "entry")[-len(entry) :] if entry else ()
    parts = [f"{word} {i}" for word, i in zip(words, entry, strict=True)]
    return ", ".join([where, *parts])


def _in_rows(value: Any, where: str) -> Any:
    """Returns nested lists for a mapping by colours from 1; MethodError for other keys."""
    if not isinstance(value, Mapping):
        return value
    is_of_blocks = where == "A"
    for key in value:
        parts = key if is_of_blocks and isinstance(key, tuple) else (key,)
        is_right = len(parts) == (2 if is_of_blocks else 1)
        if not is_right or not all(_is_colour(x) for x in parts):
            what = "pair of colours" if is_of_blocks else "colour"
            example = "{(1, 2): [[1]]}" if is_of_blocks else "{1: [1]}"
            message = f"{where}: {key!r} is not a {what}"
            raise MethodError(message, f"colours count from 1, as in {example}", code="wrong-value")
    if not is_of_blocks:
        colours = range(1, max(value, default=0) + 1)
        missing = [l for l in colours if l not in value]
        if missing:
            message = f"{where}: nothing for colour {missing[0]}"
            raise MethodError(message, "give every colour a row", code="pasted-tableau")
        return [value[l] for l in colours]
    size = range(1, max(map(max, value), default=0) + 1)
    return [[value.get((l, m)) for m in size] for l in size]


def _is_colour(x: object) -> bool:
    if isinstance(x, bool) or not isinstance(x, SupportsIndex):
        return False
    return index(x) >= 1


def _listed(value: Any) -> Any:
    if value is None or isinstance(value, str):
        return value
    if hasattr(value, "tolist"):
        value = value.tolist()
    if isinstance(value, Mapping):
        raise MethodError(
            "a mapping is not an array", "give A, b and c as lists", code="list-expected"
        )
    if isinstance(value, Set):
        message = "a set is not an array; it has no order, and no entry twice"
        raise MethodError(message, "give A, b and c as lists", code="list-expected")
    if isinstance(value, Iterable) and not isinstance(value, str):
        return [_listed(item) for item in value]
    return value


def _depth(value: Any) -> int:
    if not isinstance(value, list):
        return 0
    return 1 + max(map(_depth, value), default=0)


def _triangle(A: Any) -> Any:
    if _depth(A) != 2 or not all(isinstance(row, list) for row in A):
        return A
    lengths = {len(row) for row in A}
    if lengths != {len(A) - 1}:
        return A
    above = [x for i, row in enumerate(A) for x in row[i:]]
    is_explicit = not any(isinstance(x, str) or x != 0 for x in above)
    return [row[:i] for i, row in enumerate(A)] if is_explicit else A


def _one_row(value: Any) -> Any:
    """Returns the row in a matrix with one row or one column, as SymPy and FLINT have them."""
    if _depth(value) != 2:
        return value
    if len(value) == 1:
        return value[0]
    if all(isinstance(row, list) and len(row) == 1 for row in value):
        return [row[0] for row in value]
    return value


def _quoted(text: str) -> str:
    if _PLAIN.fullmatch(text):
        return text
    return quoted(text)
