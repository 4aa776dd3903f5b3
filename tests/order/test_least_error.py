"""The least error where Theorem D of docs/pair-order.md is silent, case (c), and linear colours."""

from __future__ import annotations

import pytest
from flint import fmpq, fmpq_poly

from garkcli import loads
from garkcli.order.certificate import find_order
from garkcli.order.constants import Norms, error_constants
from garkcli.tableau.forms import pair
from garkcli.tableau.tableau import Tableau
from tests.whole import in_whole, sample

ABOVE = (
    (fmpq(0), fmpq(1, 3), fmpq(2, 3), fmpq(1)),
    (fmpq(1, 8), fmpq(3, 8), fmpq(3, 8), fmpq(1, 8)),
)
BELOW = (
    (fmpq(3, 20), fmpq(1, 4), fmpq(3, 4), fmpq(17, 20)),
    (fmpq(25, 144), fmpq(47, 144), fmpq(47, 144), fmpq(25, 144)),
)
"""Four nodes, with weights of order 4 whose integral of x⁴ is too large, and too small."""


def basis(c: tuple[fmpq, ...], b: tuple[fmpq, ...]) -> tuple[list[list[fmpq]], list[fmpq]]:
    """Orthogonal vectors that begin with 1, x − 1/2 and q = x² − x + 1/6; and their squares."""
    found: list[list[fmpq]] = []
    for j in range(4):
        v = [x**j for x in c]
        for u in found:
            part = dot(b, u, v) / dot(b, u, u)
            v = [x - part * y for x, y in zip(v, u, strict=True)]
        found.append(v)
    return found, [dot(b, u, u) for u in found]


def dot(b: tuple[fmpq, ...], u: list[fmpq], v: list[fmpq]) -> fmpq:
    return sum((w * x * y for w, x, y in zip(b, u, v, strict=True)), fmpq(0))


def block(
    of: tuple[tuple[fmpq, ...], tuple[fmpq, ...]], D: tuple[str, str], E: tuple[str, str]
) -> str:
    """The 4 × 4 block with 2 A x − x² + q = D and, of its conjugate, E: coefficients of q and of the
    last vector of the basis.
    """
    c, b = of
    p, squares = basis(c, b)
    known = {(0, 0): "1/2", (1, 0): "1", (0, 1): "-1/12"}
    for i in (2, 3):
        known[i, 1] = f"({D[i - 2]})/2"
        known[1, i] = f"-({E[i - 2]})*{squares[i] / (2 * squares[1])}"
    rows = []
    for n in range(4):
        row = []
        for m in range(4):
            terms = (
                f"({x})*({p[i][n] * p[j][m] * b[m] / squares[j]})" for (i, j), x in known.items()
            )
            row.append(f'"{"+".join(terms)}"')
        rows.append(f"[{', '.join(row)}]")
    return f"[{', '.join(rows)}]"


def two(
    of: tuple[tuple[fmpq, ...], tuple[fmpq, ...]], D: tuple[str, str], E: tuple[str, str]
) -> Tableau:
    """A method twice, the same blocks between the two."""
    own, other = block(of, ("1", "0"), ("1", "0")), block(of, D, E)
    b = "[" + ", ".join(f'"{x}"' for x in of[1]) + "]"
    return loads(f"A: [[{own}, {other}], [{other}, {own}]]\nb: [{b}, {b}]").tableau


def norms(tableau: Tableau) -> Norms:
    """The error of the pair."""
    found = error_constants(pair(tableau), 5)
    assert found is not None
    return found.all


def squared(tableau: Tableau) -> fmpq:
    """The square of its norm, a rational number."""
    found = norms(tableau).two_squared
    assert isinstance(found, fmpq)
    return found


@in_whole
def test_a_sphere_of_least_methods() -> None:
    """β > 0 and two dimensions: D and its mirror image have one error, all around have a larger one."""
    squares = basis(*ABOVE)[1]
    h = fmpq(1, 180)
    along, across = h / squares[2], f"sqrt({h * (squares[2] - h) / squares[2] / squares[3]})"
    D, mirrored = (str(along), across), (str(along), f"-{across}")
    found = two(ABOVE, D, D)
    assert find_order(pair(found)).order == 4
    least = squared(found)
    assert least == squared(two(ABOVE, mirrored, mirrored))
    others = [(D, mirrored), (D, ("1", "0")), (("1", "0"), ("1", "0"))]
    for change in ("1/20", "-1/20"):
        others += [(D, (f"{along} + {change}", across)), (D, (str(along), f"{across} + {change}"))]
    others = sample(others, 3)
    assert all(norms(found).two < norms(two(ABOVE, *other)).two for other in others)


@in_whole
def test_no_multiple_of_q_is_least() -> None:
    """β < 0: with D = c q for all edges E is a quartic in c; D = c q + z and c q − z are below it."""
    points = [fmpq(n, 2) for n in range(4, 9)]
    values = [squared(two(BELOW, (str(c), "0"), (str(c), "0"))) for c in points]
    quartic = fmpq_poly([0])
    for x, value in zip(points, values, strict=True):
        term = fmpq_poly([value])
        for y in points:
            if y != x:
                term *= fmpq_poly([-y, 1]) / (x - y)
        quartic += term
    slope = quartic.derivative()
    n = next(n for n in range(3000, 4000) if slope(fmpq(n, 1000)) > 0)
    assert slope(fmpq(n - 1, 1000)) < 0
    assert slope.derivative()(fmpq(n, 1000)) > 0
    below = squared(two(BELOW, (f"{n}/1000", "1"), (f"{n}/1000", "-1")))
    # the minimum is between the two n, no more than the slope times 1/1000 below
    assert below < quartic(fmpq(n, 1000)) - slope(fmpq(n, 1000)) / 1000
    assert quartic(fmpq(n, 1000)) < min(values)


def test_two_equal_directions_where_there_is_one() -> None:
    """Gauss 2 × Lobatto IIIA 3 has one dimension: the cubics of s and t say the same of d = t q."""
    s = fmpq_poly([-3103, 9219, -2370, 790])
    t = fmpq_poly([-1245, 2707, -1185, 395])
    u, v = s(fmpq_poly([1, 1])), t(fmpq_poly([1, fmpq(2, 3)]))
    assert u / u[3] == v / v[3]


@pytest.mark.parametrize(("linear", "order"), [("", 3), ("linear: [1]", 4)])
def test_a_linear_colour_needs_less(linear: str, order: int) -> None:
    """B(4) fails; a linear vector field does not need it."""
    method = loads(f"A: [[1/8, -1/8], [7/24, 3/8]]\nb: [1/4, 3/4]\n{linear}").tableau
    assert find_order(pair(method)).order == order
