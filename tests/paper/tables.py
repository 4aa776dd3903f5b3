"""The tableaus that the paper prints, entry by entry, and its misprints.

A. Zanna, *Discrete Variational Methods and Symplectic Generalized Additive Runge–Kutta Methods*:
Gauss 2 and Lobatto IIIA 3 by collocation and by interpolation, their symplectic conjugates, and eq.
(rectangular).
"""

from __future__ import annotations

from collections.abc import Mapping

from garkcli.exact.domain import Domain
from garkcli.exact.expression import parse
from garkcli.exact.matrix import Matrix, Vector
from garkcli.tableau.forms import spelled_out
from garkcli.tableau.tableau import Tableau

FIELD = Domain([parse("sqrt(3)")])
"""All numbers of the paper's tableaus come from ℚ(√3)."""


def row(text: str) -> Vector:
    """Numbers with commas between them."""
    return tuple(FIELD.evaluate(parse(entry)) for entry in text.split(","))


c_1 = row("1/2 - sqrt(3)/6, 1/2 + sqrt(3)/6")
c_2 = row("0, 1/2, 1")
b_1 = row("1/2, 1/2")
b_2 = row("1/6, 2/3, 1/6")

COLLOCATION_AS_PRINTED = """
1/4,              1/4 - sqrt(3)/6,  1/6 - sqrt(3)/108, 1/3 + 4*sqrt(3)/27, sqrt(3)/108
1/4 + sqrt(3)/6,  1/4,              1/6 + sqrt(3)/108, 1/3 - 4*sqrt(3)/27, -sqrt(3)/108
0,                0,                0,                 0,                  0
1/4 + sqrt(3)/8,  1/4 - sqrt(3)/8,  5/24,              1/3,                -1/24
1/2,              1/2,              1/6,               2/3,                1/6
"""
COLLOCATION_CONJUGATE_AS_PRINTED = """
1/4,              1/4 - sqrt(3)/6,  1/6,               1/3 - sqrt(3)/6,    0
1/4 + sqrt(3)/6,  1/4,              1/6,               1/3 + sqrt(3)/6,    0
sqrt(3)/36,       -sqrt(3)/36,      1/6,               -1/6,               0
1/4 + sqrt(3)/9,  1/4 - sqrt(3)/9,  1/6,               1/3,                0
1/2,              1/2,              1/6,               5/6,                0
"""
INTERPOLATION = """
1/4,              1/4 - sqrt(3)/6,  1/6 - sqrt(3)/36,  1/3 - sqrt(3)/9,    -sqrt(3)/36
1/4 + sqrt(3)/6,  1/4,              1/6 + sqrt(3)/36,  1/3 + sqrt(3)/9,    sqrt(3)/36
sqrt(3)/12,       -sqrt(3)/12,      0,                 0,                  0
1/4 + sqrt(3)/12, 1/4 - sqrt(3)/12, 5/24,              1/3,                -1/24
1/2 + sqrt(3)/12, 1/2 - sqrt(3)/12, 1/6,               2/3,                1/6
"""
INTERPOLATION_CONJUGATE = """
1/4,              1/4 - sqrt(3)/6,  1/6 - sqrt(3)/36,  1/3 - sqrt(3)/9,    -sqrt(3)/36
1/4 + sqrt(3)/6,  1/4,              1/6 + sqrt(3)/36,  1/3 + sqrt(3)/9,    sqrt(3)/36
sqrt(3)/12,       -sqrt(3)/12,      1/6,               -1/6,               0
1/4 + sqrt(3)/12, 1/4 - sqrt(3)/12, 1/6,               1/3,                0
1/2 + sqrt(3)/12, 1/2 - sqrt(3)/12, 1/6,               5/6,                0
"""
RECTANGULAR_Q = """
0,                0
1/4 + sqrt(3)/8,  1/4 - sqrt(3)/8
1/2,              1/2
"""
RECTANGULAR_P = """
1/6,              1/3 - sqrt(3)/6,  0
1/6,              1/3 + sqrt(3)/6,  0
"""

COLLOCATION_MISPRINTS: Mapping[tuple[int, int], str] = {
    (1, 4): "1/3 - 4*sqrt(3)/27",
    (1, 5): "-sqrt(3)/108",
    (2, 4): "1/3 + 4*sqrt(3)/27",
    (2, 5): "sqrt(3)/108",
}
"""What stands at (row, column), counted from 1, in the collocation example when its misprints are
put right.
"""
CONJUGATE_MISPRINTS: Mapping[tuple[int, int], str] = {
    (5, 1): "1/2 + sqrt(3)/36",
    (5, 2): "1/2 - sqrt(3)/36",
}
"""The same for its conjugate."""


def matrix(text: str, corrections: Mapping[tuple[int, int], str] | None = None) -> Matrix:
    """A printed matrix, with some entries put right."""
    rows = [[x.strip() for x in line.split(",")] for line in text.strip().splitlines()]
    for (i, j), entry in (corrections or {}).items():
        rows[i - 1][j - 1] = entry
    return tuple(tuple(FIELD.evaluate(parse(entry)) for entry in line) for line in rows)


def tableau(entries: Matrix) -> Tableau:
    """The GARK tableau with two and three stages, eq. (GARK), from its five rows and columns."""
    upper, lower = entries[:2], entries[2:]
    A = [
        [tuple(line[:2] for line in upper), tuple(line[2:] for line in upper)],
        [tuple(line[:2] for line in lower), tuple(line[2:] for line in lower)],
    ]
    return spelled_out(A, [b_1, b_2], [c_1, c_2])
