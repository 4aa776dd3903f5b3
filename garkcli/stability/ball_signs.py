"""Signs, roots and common factors of polynomials whose coefficients are balls.

Each question is answered for all polynomials in the balls at once, or with None: it is not decided.
Coefficients come from the lowest.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from flint import arb, arb_mat, arb_poly, fmpq

MOST_PIECES = 4000
"""Pieces of an interval on which a sign is tried before it is left undecided."""


def both(first: bool | None, second: bool | None) -> bool | None:
    """Whether both hold, where one that fails decides."""
    if first is False or second is False:
        return False
    if first and second:
        return True
    return None


def mirrored(coefficients: Iterable[arb]) -> list[arb]:
    """p(−z)."""
    found = []
    for k, a in enumerate(coefficients):
        is_odd = k % 2 == 1
        found.append(-a if is_odd else a)
    return found


def squared_on_axis(p: Sequence[arb]) -> list[arb]:
    """|p(iy)|² as a polynomial in x = y²: the squares of the real part and of the imaginary one."""
    even = mirrored(p[0::2])
    odd = mirrored(p[1::2])
    x = arb_poly([0, 1])
    real = arb_poly(even)
    imaginary = arb_poly(odd)
    total = real * real
    total += x * imaginary * imaginary
    return [total[k] for k in range(len(total))]


def difference(a: Sequence[arb], b: Sequence[arb]) -> list[arb]:
    """The coefficients of a − b, as many as the longer one has."""
    size = max(len(a), len(b))
    pairs = zip(_padded(a, size), _padded(b, size), strict=True)
    return [x - y for x, y in pairs]


def _padded(p: Sequence[arb], size: int) -> list[arb]:
    """So many coefficients, zeros at the end."""
    missing = size - len(p)
    zeros = [arb(0)] * missing
    return [*p, *zeros]


def is_positive(coefficients: Sequence[arb]) -> bool | None:
    """Whether a polynomial is positive for all x > 0: on (0, 1], and reversed on (0, 1]."""
    near = _is_positive_on_unit_interval(coefficients)
    far = _is_positive_on_unit_interval(coefficients[::-1])
    return both(near, far)


def _is_positive_on_unit_interval(coefficients: Sequence[arb]) -> bool | None:
    """Whether it is positive on [0, 1]: True, False where a value is negative, None undecided.

    Pieces are halved until the enclosure of the polynomial on each has a sign.
    """
    p = arb_poly(coefficients)
    pieces = [(fmpq(0), fmpq(1))]
    tried = 0
    while pieces:
        low, high = pieces.pop()
        tried += 1
        if tried > MOST_PIECES:
            return None
        middle = (low + high) / 2
        radius = (high - low) / 2
        piece = arb(middle, radius)
        if p(piece) > 0:
            continue
        if p(arb(middle)) < 0:
            return False
        pieces += [(low, middle), (middle, high)]
    return True


def poles_are_right(Q: Sequence[arb]) -> bool | None:
    """Whether all roots of Q have positive real parts, by Routh's scheme of Q(−z)."""
    rest = mirrored(Q)[::-1]
    while rest and rest[0].is_zero():
        rest.pop(0)
    upper, lower = rest[0::2], rest[1::2]
    column = [upper[0]]
    while lower:
        if lower[0].contains(0):
            return None
        column.append(lower[0])
        upper, lower = lower, _next_row(upper, lower)
    if all(x > 0 for x in column):
        return True
    if all(x < 0 for x in column):
        return True
    if any(x.contains(0) for x in column):
        return None
    return False


def _next_row(upper: list[arb], lower: list[arb]) -> list[arb]:
    """The row of Routh's scheme after two others."""
    factor = upper[0] / lower[0]
    others = upper[1:]
    below = _padded(lower[1:], len(others))
    pairs = zip(others, below, strict=True)
    return [x - factor * y for x, y in pairs]


def are_coprime(P: list[arb], Q: list[arb]) -> bool:
    """Whether P and Q have no common root for any of the numbers in the balls.

    That is what a resultant without zero says: the determinant of the Sylvester matrix.
    """
    degree_p = len(P) - 1
    degree_q = len(Q) - 1
    size = degree_p + degree_q
    if size == 0:
        return True
    rows = _shifted(P, degree_q, size)
    rows += _shifted(Q, degree_p, size)
    resultant = arb_mat(rows).det()
    return not resultant.contains(0)


def _shifted(p: list[arb], count: int, size: int) -> list[list[arb]]:
    """Rows with the coefficients of p, each a column further to the right."""
    rows = []
    for k in range(count):
        before = [arb(0)] * k
        rows.append(_padded(before + p, size))
    return rows
