"""Arrays to methods: through the text of a method file, so that both mean the same."""

from __future__ import annotations

import re
from collections.abc import Iterable
from typing import Any

from garkcli.errors import MethodError
from garkcli.exact.given import number_text
from garkcli.methodfile.build import MethodFile
from garkcli.methodfile.load import loads
from garkcli.methodfile.writer import quoted

SOURCE = "<arrays>"
"""What errors call the file that arrays are written to."""


def from_arrays(
    A: Any,
    b: Any,
    c: Any = None,
    embedded: Any = None,
    *,
    name: str = "",
    tolerance: Any = None,
) -> MethodFile:
    """The method with the coefficients ``A``, ``b`` and, where they are not the row sums, ``c``.

    Arrays are lists, tuples, NumPy arrays or matrices of SymPy or FLINT. Their entries are ints,
    Fractions, Decimals, floats, texts such as ``"1/2 - sqrt(3)/6"``, or numbers of NumPy, SymPy or
    FLINT. They are taken exactly; a float stands for the decimal that it prints, so 0.1 is one
    tenth, and one of more than 15 digits needs a ``tolerance``.

    Args:
        A: the matrix, shape (s, s); the rows of a triangle may end at the diagonal or before it. Of
            N colours a nested list ``A[l][m]`` of blocks, shape (s_l, s_m), None where colour l
            does not see colour m.
        b: the weights, length s; of N colours a row each.
        c: the nodes, length s; of N colours a row each.
        embedded: embedded weights, as b.
        name: what to call the method.
        tolerance: the rounding of the coefficients, for instance ``"1e-13"``.

    Returns:
        The method; its ``text`` is a method file that says the same.

    Raises:
        MethodError: an entry is no exact number.
        MethodFileError: the numbers do not make a method.

    >>> heun = from_arrays([[0, 0], [1, 0]], [0.5, "1/2"], name="Heun")
    >>> heun, heun.c
    (<MethodFile Heun: 1 colour, stages 2>, (0, 1))
    >>> from_arrays([[0, 0], [1, 0]], ["1/2", "1/2"], embedded=[1, 0]).embedded
    ((1, 0),)
    """
    writer = _Writer(is_rounded=tolerance is not None)
    A = _listed(A)
    entries: dict[str, str] = {}
    if name:
        entries["name"] = _quoted(name)
    entries["A"] = writer.text(A, "A")
    for key, rows in (("b", b), ("c", c), ("embedded", embedded)):
        listed = _listed(rows)
        if _depth(A) <= 2:
            listed = _one_row(listed)
        if listed is not None or key == "b":
            entries[key] = writer.text(listed, key)
    if tolerance is not None:
        entries["tolerance"] = number_text(
            tolerance, "tolerance", is_rounded=True
        )
    lines = [f"{key}: {text}\n" for key, text in entries.items()]
    return loads("".join(lines), SOURCE)


_PLAIN = re.compile(r"-?(0|[1-9][0-9]*)([./][0-9]+)?(e-?[0-9]+)?", re.ASCII)
"""Numbers that no reader of YAML takes for another."""


class _Writer:
    """Writes nested lists of numbers as YAML."""

    def __init__(self, is_rounded: bool) -> None:
        self.is_rounded = is_rounded

    def text(self, value: Any, where: str) -> str:
        if value is None:
            return "null"
        if isinstance(value, list):
            items = [
                self.text(x, f"{where}[{i}]") for i, x in enumerate(value)
            ]
            return f"[{', '.join(items)}]"
        return _quoted(number_text(value, where, self.is_rounded))


def _listed(value: Any) -> Any:
    """Arrays of any kind as nested lists; anything else as it is."""
    if value is None or isinstance(value, str):
        return value
    if hasattr(value, "tolist"):
        value = value.tolist()
    if isinstance(value, dict):
        raise MethodError("a mapping is no array", "give A, b and c as lists")
    if isinstance(value, Iterable) and not isinstance(value, str):
        return [_listed(item) for item in value]
    return value


def _depth(value: Any) -> int:
    if not isinstance(value, list):
        return 0
    inside = map(_depth, value)
    return 1 + max(inside, default=0)


def _one_row(value: Any) -> Any:
    """A row that stands in a matrix of one row or of one column, as SymPy and FLINT have them."""
    if _depth(value) != 2:
        return value
    if len(value) == 1:
        return value[0]
    if all(isinstance(row, list) and len(row) == 1 for row in value):
        return [row[0] for row in value]
    return value


def _quoted(text: str) -> str:
    """A text as YAML takes it at its word; plain where it is a plain number."""
    if _PLAIN.fullmatch(text):
        return text
    return quoted(text)
