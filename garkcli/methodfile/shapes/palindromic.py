"""Symmetric methods: the same backwards."""

import re
from dataclasses import replace

from garkcli.methodfile.shapes.layout import ZERO, Layout, Shape, Texts, refuse_shape


def _applied(layout: Layout) -> Layout:
    """b_{s+1−i} = b_i and a_{s+1−i,s+1−j} = b_j − a_ij."""
    if layout.kind != "tableau" or "gamma" in layout.unknowns:
        raise refuse_shape(
            "palindromic goes with full, dirk and symplectic-dirk", "leave one of them out"
        )
    s = layout.stages
    (weights,) = layout.b
    (matrix,) = layout.A
    mirrored: dict[str, str] = {}
    for i in range(s // 2, s):
        mirrored[weights[i]] = weights[s - 1 - i]

    def name_of(found: re.Match[str]) -> str:
        name = found[0]
        return mirrored.get(name, name)

    def renamed(text: str) -> str:
        return re.sub(r"\w+", name_of, text)

    b = tuple(map(renamed, weights))
    rows = [[renamed(text) for text in row] for row in matrix]
    for i in range(s):
        for j in range(s):
            _mirror(rows, b, i, j)
    made: Texts = tuple(map(tuple, rows))
    return replace(layout, A=(made,), b=(b,))


def _mirror(rows: list[list[str]], b: tuple[str, ...], i: int, j: int) -> None:
    """Write the entry at the place opposite of (i, j), where that is an unknown of its own."""
    last = len(b) - 1
    k, l = last - i, last - j
    entry, opposite = rows[i][j], rows[k][l]
    if entry == ZERO and opposite == ZERO:
        raise refuse_shape("no explicit shape is palindromic", "take full, dirk or symplectic-dirk")
    if not opposite.startswith("a"):
        return
    weight = b[j]
    if entry == ZERO:
        rows[k][l] = weight
    elif (i, j) == (k, l):
        rows[k][l] = f"{weight}/2"
    elif (i, j) < (k, l):
        rows[k][l] = f"{weight} - {entry}"


SHAPE = Shape("palindromic", "the same method backwards", _applied)
"""G. Wanner, *Runge-Kutta-methods with expansion in even powers of h*, Computing 11, 1973."""
