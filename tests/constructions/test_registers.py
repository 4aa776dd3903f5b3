"""Schemes of few registers, the form of Shu and Osher and Nyström methods as tableaus: by their
orders, and by steps that are taken as the scheme says.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from fractions import Fraction
from typing import Any

import pytest
from flint import fmpq
from hypothesis import given
from hypothesis import strategies as st

from garkcli.constructions.registers import (
    Steps,
    ahead,
    in_two_registers,
    minus_two_registers,
    nystrom,
    shu_osher,
    three_registers,
    two_registers,
    van_der_houwen,
)
from garkcli.errors import MethodError
from garkcli.methodfile.load import loads
from garkcli.order.certificate import find_order

F = Fraction
START, H = F(2, 3), F(1, 5)
A2N = [F(0), F(-5, 9), F(-153, 128)]
B2N = [F(1, 3), F(15, 16), F(8, 15)]
G1, G2, G3 = [F(0), F(1, 4), F(2, 3)], [F(1), F(0), F(0)], [F(0), F(3, 4), F(1, 3)]
DELTA, BETA = [F(1), F(0), F(0)], [F(1), F(1, 4), F(2, 3)]
DIAGONAL, WEIGHTS = [F(1, 2), F(3, 4), F(1)], [F(1, 6), F(1, 3), F(1, 3), F(1, 6)]
ALPHA = [[F(1)], [F(3, 4), F(1, 4)], [F(1, 3), F(0), F(2, 3)]]
SHU = [[F(1)], [F(0), F(1, 4)], [F(0), F(0), F(2, 3)]]


def slope(y: F) -> F:
    """No polynomial of low degree would tell all trees apart; this one does not vanish early."""
    return y * y - y / 3 + 1


def _two(A: Sequence[F], B: Sequence[F], y: F, sign: int = 1) -> F:
    dy = F(0)
    for a, b in zip(A, B, strict=True):
        dy = sign * a * dy + H * slope(y)
        y += b * dy
    return y


def _three(y: F) -> F:
    first = y
    other = F(0)
    for g1, g2, g3, d, b in zip(G1, G2, G3, DELTA, BETA, strict=True):
        other += d * y
        y = g1 * y + g2 * other + g3 * first + b * H * slope(y)
    return y


def _houwen(y: F) -> F:
    """Two registers: the stage, and the value with the weights of what is done."""
    stage = y
    for i, b in enumerate(WEIGHTS):
        k = slope(stage)
        if i < len(DIAGONAL):
            stage = y + DIAGONAL[i] * H * k
        y += b * H * k
    return y


def _ahead(y: F) -> F:
    k = slope(y)
    y += WEIGHTS[0] * H * k
    for a, b in zip(DIAGONAL, WEIGHTS[1:], strict=True):
        k = slope(y + a * H * k)
        y += b * H * k
    return y


def _shu(y: F) -> F:
    values = [y]
    for alpha, beta in zip(ALPHA, SHU, strict=True):
        pairs = zip(alpha, beta, values, strict=True)
        values.append(sum((a * v + H * b * slope(v) for a, b, v in pairs), F(0)))
    return values[-1]


def exact(row: Sequence[Any]) -> list[Any]:
    """Fractions of Python as those of flint."""
    if row and isinstance(row[0], list):
        return [exact(x) for x in row]
    return [fmpq(x.numerator, x.denominator) for x in row]


def _q(x: Any) -> F:
    value = fmpq(1) * x
    return F(int(value.p), int(value.q))


SCHEMES: dict[str, tuple[Steps, Callable[[F], F]]] = {
    "2N": (two_registers(exact(A2N), exact(B2N)), lambda y: _two(A2N, B2N, y)),
    "2N, A[0] left out": (two_registers(exact(A2N[1:]), exact(B2N)), lambda y: _two(A2N, B2N, y)),
    "2N with -A": (minus_two_registers(exact(A2N), exact(B2N)), lambda y: _two(A2N, B2N, y, -1)),
    "3S*": (three_registers(*map(exact, (G1, G2, G3, DELTA, BETA))), _three),
    "van der Houwen": (van_der_houwen(exact(WEIGHTS), exact(DIAGONAL)), _houwen),
    "2C": (ahead(exact(WEIGHTS), exact(DIAGONAL)), _ahead),
    "Shu-Osher": (shu_osher(exact(ALPHA), exact(SHU)), _shu),
}


@pytest.mark.parametrize("name", SCHEMES)
def test_a_step_of_the_scheme_is_one_of_the_tableau(name: str) -> None:
    """With exact fractions, on a problem that is not linear."""
    found, by_hand = SCHEMES[name]
    slopes: list[F] = []
    for row in found.A:
        seen = zip(row, slopes, strict=False)
        slopes.append(slope(START + H * sum((_q(a) * k for a, k in seen), F(0))))
    end = START + H * sum((_q(b) * k for b, k in zip(found.b, slopes, strict=True)), F(0))
    assert end == by_hand(START)
    assert {_q(x) for x in found.starts} == {F(1)}


def order_of(found: Steps) -> int:
    """The order of a tableau, by the certificate."""
    matrix = [[str(x) for x in row] for row in found.A]
    text = f"{{A: {matrix}, b: {[str(x) for x in found.b]}}}".replace("'", "")
    return find_order(loads(text).tableau, 5).order


def test_the_orders_of_the_papers() -> None:
    """Williamson's method has order 3 and not 4; so has that of Shu and Osher, in both forms."""
    assert order_of(SCHEMES["2N"][0]) == 3
    assert order_of(SCHEMES["3S*"][0]) == 3
    assert order_of(SCHEMES["Shu-Osher"][0]) == 3
    assert order_of(SCHEMES["2N with -A"][0]) < 3


def test_several_diagonals() -> None:
    """3R: two entries of a row are its own, the others are weights."""
    b = exact([F(1, 4)] * 4)
    found = van_der_houwen(b, [fmpq(1), fmpq(2), fmpq(3)], [fmpq(0), fmpq(5), fmpq(6)])
    assert [[int(4 * x) for x in row] for row in found.A] == [
        [0, 0, 0, 0],
        [4, 0, 0, 0],
        [20, 8, 0, 0],
        [1, 24, 12, 0],
    ]


def test_what_is_no_such_method() -> None:
    """Rows of other lengths, and values that need later ones."""
    with pytest.raises(MethodError, match="a row of 1 for 3 stages"):
        two_registers([fmpq(1)], exact(B2N))
    with pytest.raises(MethodError, match="alpha has 3 rows, beta has 2"):
        shu_osher(exact(ALPHA), exact(SHU[:2]))
    with pytest.raises(MethodError, match="implicit"):
        shu_osher([[fmpq(1), fmpq(1)]], [[fmpq(1), fmpq(0)]])


NYSTROM = [[F(0)] * 3, [F(1, 8), F(0), F(0)], [F(0), F(1, 2), F(0)]]
B_Q, B_P, NODES = [F(1, 6), F(1, 3), F(0)], [F(1, 6), F(2, 3), F(1, 6)], [F(0), F(1, 2), F(1)]


def test_a_step_of_a_nystrom_method() -> None:
    """The positions of the pair are those of the method: its velocities are p + h g_j."""
    q, p = F(1, 2), F(1, 3)
    forces: list[F] = []
    for row, c in zip(NYSTROM, NODES, strict=True):
        seen = zip(row, forces, strict=False)
        forces.append(slope(q + c * H * p + H * H * sum((a * g for a, g in seen), F(0))))
    pairs = list(zip(B_Q, B_P, forces, strict=True))
    seen_by, weights = nystrom(exact(NYSTROM), exact(B_Q), exact(NODES))
    velocities, known = [p], []
    for row in seen_by:
        weighted = zip(map(_q, row), velocities, strict=False)
        known.append(slope(q + H * sum((x * v for x, v in weighted), F(0))))
        velocities.append(p + H * known[-1])
    weighted = zip(map(_q, weights), velocities, strict=True)
    assert known == forces
    assert q + H * sum((x * v for x, v in weighted), F(0)) == q + H * p + H * H * sum(
        (x * g for x, _, g in pairs), F(0)
    )


def test_the_order_of_nystroms_method() -> None:
    """His method with three stages has order 4 and not 5, as a pair with linear velocities."""
    seen, weights = nystrom(exact(NYSTROM), exact(B_Q), exact(NODES))
    of_p = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]

    def told(rows: Sequence[Sequence[Any]]) -> str:
        return str([[str(x) for x in row] for row in rows]).replace("'", "")

    text = f"""
prk:
  q: {{A: {told(seen)}, b: {told([weights])[1:-1]}}}
  p: {{A: {told(of_p)}, b: {told([exact(B_P)])[1:-1]}}}
structure: nystrom
"""
    found = find_order(loads(text).tableau, 6)
    assert (found.order, found.is_lower_bound) == (4, False)


FRACTIONS = st.fractions(min_value=-2, max_value=2, max_denominator=9)


@given(st.lists(st.tuples(FRACTIONS, FRACTIONS), min_size=1, max_size=5))
def test_a_method_of_two_registers_has_that_form(numbers: list[tuple[F, F]]) -> None:
    """Also where some of them are 0: the form that is found makes the same method."""
    A, B = [F(0), *(a for a, _ in numbers[1:])], [b for _, b in numbers]
    made = two_registers(A, B)
    form = in_two_registers(made.A, made.b)
    assert not isinstance(form, int)
    again = two_registers(*form)
    assert (again.A, again.b) == (made.A, made.b)


@given(st.lists(st.tuples(FRACTIONS, FRACTIONS), min_size=2, max_size=4))
def test_a_rounded_method_has_that_form_within_its_rounding(numbers: list[tuple[F, F]]) -> None:
    """Its coefficients cut after 20 digits: exactly there is none but by chance, and that which is
    found makes the coefficients again, to 12 digits.
    """
    made = two_registers([F(0), *(a for a, _ in numbers[1:])], [b for _, b in numbers])
    A, b = (
        [[fmpq(int(x * 10**20), 10**20) for x in row] for row in rows]
        for rows in (made.A, [made.b])
    )
    form = in_two_registers(A, b[0], fmpq(1, 10**12))
    assert not isinstance(form, int)
    again = two_registers(*form)
    pairs = zip([*A, *b], [*again.A, again.b], strict=True)
    assert all(
        abs(x - y) <= fmpq(1, 10**12)
        for row, other in pairs
        for x, y in zip(row, other, strict=True)
    )


@given(st.lists(FRACTIONS, min_size=6, max_size=6))
def test_a_form_is_that_of_the_method_or_there_is_none(entries: list[F]) -> None:
    """Of three stages: what is found makes the method; where nothing is found Williamson's equation
    for one of three stages fails, or a slope is not used.
    """
    a21, a31, a32, b1, b2, b3 = entries
    A = [[F(0)] * 3, [a21, F(0), F(0)], [a31, a32, F(0)]]
    form = in_two_registers(A, [b1, b2, b3])
    ratio = (a31 - a21) * (b2 - a32) == (b1 - a31) * a32
    if isinstance(form, int):
        assert not (ratio and a32 and b3)
    else:
        assert ratio
        made = two_registers(*form)
        assert (made.A, made.b) == (A, [b1, b2, b3])
