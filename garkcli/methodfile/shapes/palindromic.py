"""Symmetric methods: the same backwards."""

import re
from dataclasses import replace

from garkcli.methodfile.shapes.layout import (
    ZERO,
    Layout,
    Shape,
    Texts,
    refuse_shape,
)


def _applied(layout: Layout) -> Layout:
    """b_{s+1−i} = b_i and a_{s+1−i,s+1−j} = b_j − a_ij."""
    if layout.kind != "tableau" or "gamma" in layout.unknowns:
        raise refuse_shape(
            "palindromic goes with full, dirk and symplectic-dirk",
            "leave one of them out",
        )
    s = layout.stages
    mirrored = {}
    for i in range(s // 2, s):
        mirrored[layout.b[0][i]] = layout.b[0][s - 1 - i]

    def renamed(text: str) -> str:
        return re.sub(r"\w+", lambda x: mirrored.get(x[0], x[0]), text)

    b = tuple(renamed(text) for text in layout.b[0])
    rows = [[renamed(text) for text in row] for row in layout.A[0]]
    for i in range(s):
        for j in range(s):
            _mirror(rows, b, i, j)
    matrix: Texts = tuple(tuple(row) for row in rows)
    return replace(layout, A=(matrix,), b=(b,))


def _mirror(rows: list[list[str]], b: tuple[str, ...], i: int, j: int) -> None:
    """Write the entry at the place opposite of (i, j), where that is an unknown of its own."""
    k, l = len(b) - 1 - i, len(b) - 1 - j
    opposite = rows[k][l]
    if rows[i][j] == ZERO and opposite == ZERO:
        raise refuse_shape(
            "no explicit shape is palindromic",
            "take full, dirk or symplectic-dirk",
        )
    if not opposite.startswith("a"):
        return
    if rows[i][j] == ZERO:
        rows[k][l] = b[j]
    elif (i, j) == (k, l):
        rows[k][l] = f"{b[j]}/2"
    elif (i, j) < (k, l):
        rows[k][l] = f"{b[j]} - {rows[i][j]}"


SHAPE = Shape("palindromic", "the same method backwards", _applied)
"""G. Wanner, *Runge-Kutta-methods with expansion in even powers of h*, Computing 11, 1973."""
