"""Low-storage, Shu–Osher and Nyström coefficients of a source as tables of Runge–Kutta methods.

The algebra of ``garkcli.constructions.registers`` is done twice: with the printed numbers, and with
balls around them. An entry affected by rounding is written with its correct digits.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any, TypeAlias

from flint import arb, ctx, fmpq

from garkcli.constructions.registers import (
    FORMS,
    Steps,
    nystrom,
    shu_osher,
    three_registers,
    van_der_houwen,
)
from garkcli.errors import ExpressionError, MethodError
from garkcli.exact.display import to_ball, to_decimal
from garkcli.exact.domain import Domain
from garkcli.exact.expression import parse
from garkcli.exact.field import Number
from garkcli.frozen import Frozen
from garkcli.methodfile.printed import approximant_units
from garkcli.order.tolerance import rounded_up
from garkcli.sources.found import Row, Rows, Units, Unreadable

BITS = 1_000
"""Precision of balls around printed numbers."""
DIGITS = 300
"""Digits of balls around irrational numbers."""
COARSE = fmpq(1, 10**16)
"""Fractions with worse approximations are exact."""
WRAY = "Wray"
"""A form of two rows, applied one after the other in each stage."""


def _of_wray(A: Sequence[Any], b: Sequence[Any]) -> Steps:
    """Executes y ← y + h (b_i f(y) + a_i f of the stage before)."""
    both = [x + y for x, y in zip(b, [*A[1:], 0], strict=True)]
    rows = [[*both[: i - 1], *b[max(i - 1, 0) : i], *[0] * (len(b) - i)] for i in range(len(b))]
    return Steps([*([0] * len(b) for _ in rows[:1]), *rows[1:]], both, [1] * (len(b) + 1))


SCHEMES: Mapping[str, Callable[..., Steps]] = {
    **FORMS,
    WRAY: _of_wray,
    "3S*": three_registers,
    "Shu–Osher": shu_osher,
    "Nyström": lambda A, b, c: Steps(*nystrom(A, b, c), ()),
}
"""Other forms, such as 2R, are van der Houwen's, with b behind their diagonals."""
Nested: TypeAlias = "str | Sequence[Nested]"


class ConvertedScheme(Frozen):
    """Coefficients computed from printed ones.

    Attributes:
        A: the matrix.
        b: the weights.
        units: error bounds of their texts.
    """

    A: Rows
    b: Row
    units: Units


def converted(form: str, *printed: Nested) -> ConvertedScheme:
    """The matrix and the weights of a scheme.

    Args:
        form: the name of the scheme.
        printed: its coefficients: A and b of 2N and similar forms, α and β of the form of Shu and
            Osher, γ₁, γ₂, γ₃, δ, β of 3S*, Ā, b̄, c of Nyström, for the velocities that positions
            see.

    Raises:
        Unreadable: they give no method, or stages do not begin at the value before the step.
    """
    texts = list(_flat(printed))
    try:
        expressions = [parse(x) for x in texts]
        domain = Domain(expressions)
        values = [domain.evaluate(x) for x in expressions]
    except ExpressionError as error:
        raise Unreadable(error.message) from None
    units = approximant_units(list(zip(expressions, values, strict=True)))
    for text, value in zip(texts, values, strict=True):
        if "." not in text and units.get(value, 0) > COARSE:
            units[value] = fmpq(0)
    with ctx.workprec(BITS):
        balls = [_ball(x) + arb(0, arb(units.get(x, 0)).abs_upper()) for x in values]
        try:
            exact, rounded = (_steps(form, _nested(printed, iter(x))) for x in (values, balls))
        except MethodError as error:
            raise Unreadable(error.message) from None
        for i, (start, ball) in enumerate(zip(exact.starts, rounded.starts, strict=True), start=1):
            if start != 1 and not abs(_ball(start - 1)) <= 10 * ball.rad():
                raise Unreadable(f"stage {i} begins at {to_decimal(start, 8)} y, not at y")
        off: dict[str, fmpq] = {}
        *A, b = (
            tuple(written(x, ball, off) for x, ball in zip(*row, strict=True))
            for row in zip((*exact.A, exact.b), (*rounded.A, rounded.b), strict=True)
        )
    return ConvertedScheme(tuple(A), b, tuple(off.items()))


def _steps(form: str, rows: Sequence[Any]) -> Steps:
    scheme = SCHEMES.get(form)
    return scheme(*rows) if scheme else van_der_houwen(rows[-1], *rows[:-1])


def _flat(rows: Sequence[Nested]) -> Iterator[str]:
    for row in rows:
        yield from [row] if isinstance(row, str) else _flat(row)


def _nested(rows: Sequence[Nested], numbers: Iterator[Any]) -> list[Any]:
    return [next(numbers) if isinstance(x, str) else _nested(x, numbers) for x in rows]


def _ball(x: Number | int) -> arb:
    return arb(x) if isinstance(x, int | fmpq) else to_ball(x, DIGITS)


def written(x: Number | int, ball: arb | int, units: dict[str, fmpq]) -> str:
    """The correct digits of a number; ``units`` gets its error bound."""
    if not isinstance(ball, arb) or not isinstance(x, fmpq) or not x or ball.rad() < 1e-200:
        return str(x)
    sizes = abs(float(ball.mid())), float(ball.rad())
    if not all(0 < size < math.inf for size in sizes):
        raise Unreadable("a number beyond those of floats")
    first, last = (math.floor(math.log10(size)) for size in sizes)
    text = to_decimal(x, max(1, 1 + first - last))
    unit = rounded_up(arb(ball.rad()) + arb(10) ** min(last, first))
    units[text] = max(unit, units.get(text, unit))
    return text
