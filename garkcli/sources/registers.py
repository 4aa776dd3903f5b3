"""Low-storage, Shu–Osher and Nyström coefficients of a source as tables of Runge–Kutta methods.

The algebra is that of ``garkcli.conversion.registers``, done twice: with the numbers as they are
printed, and with balls around them. An entry that rounding moves is written with as many digits as
it has.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Sequence
from typing import Any, TypeAlias

from flint import arb, ctx, fmpq

from garkcli.conversion.registers import (
    FORMS,
    Numbers,
    Steps,
    nystrom,
    shu_osher,
    three_registers,
    van_der_houwen,
)
from garkcli.conversion.sheet import CannotConvert
from garkcli.errors import ExpressionError
from garkcli.exact.display import to_ball, to_decimal
from garkcli.exact.domain import Domain
from garkcli.exact.expression import parse
from garkcli.exact.field import Number
from garkcli.frozen import Frozen
from garkcli.methodfile.printed import approximant_units
from garkcli.order.tolerance import rounded_up
from garkcli.sources.found import Row, Rows, Units, Unreadable

BITS = 1_000
"""Of balls around printed numbers."""
DIGITS = 300
"""Of balls around irrational ones."""
COARSE = fmpq(1, 10**16)
"""A fraction that would approximate a number no better than that is exact."""
NEAR = 1e-4
"""Nodes and sums of rows that differ by less are meant to be the same."""
Nested: TypeAlias = "str | Sequence[Nested]"
Scheme: TypeAlias = Callable[..., Steps]


class Printed:
    """Coefficients as they are printed: exact, and as balls that allow for rounding.

    Args:
        rows: lists of numbers, or lists of such lists.

    Raises:
        Unreadable: they are no numbers of one field.
    """

    def __init__(self, *rows: Nested) -> None:
        self._rows = rows
        printed = _flat(rows)
        expressions = [parse(x) for x in printed]
        try:
            domain = Domain(expressions)
            values = [domain.evaluate(x) for x in expressions]
        except ExpressionError as error:
            raise Unreadable(error.message) from None
        self._values = iter(values)
        self.exact = [self._nested(row, lambda x: x) for row in rows]
        units = approximant_units(list(zip(expressions, values, strict=True)))
        for text, value in zip(printed, values, strict=True):
            if "." not in text and units.get(value, 0) > COARSE:
                units[value] = fmpq(0)
        self._values = iter(values)
        with ctx.workprec(BITS):
            self.balls = [self._nested(row, lambda x: _ball(x, units.get(x))) for row in rows]

    def _nested(self, row: Nested, made: Callable[[Number], Any]) -> Any:
        if isinstance(row, str):
            return made(next(self._values))
        return [self._nested(x, made) for x in row]

    def steps(self, scheme: Scheme) -> tuple[Steps, Steps]:
        """The method of a scheme: exact, and as balls.

        Raises:
            Unreadable: it is none.
        """
        try:
            with ctx.workprec(BITS):
                return scheme(*self.exact), scheme(*self.balls)
        except CannotConvert as error:
            raise Unreadable(error.message) from None


def _flat(rows: Iterable[Nested]) -> list[str]:
    return [x for row in rows for x in ([row] if isinstance(row, str) else _flat(row))]


def _ball(x: Number, unit: fmpq | None) -> arb:
    middle = arb(x) if isinstance(x, fmpq) else to_ball(x, DIGITS)
    return middle + arb(0, arb(unit or 0).abs_upper())


class Converted(Frozen):
    """Coefficients made of printed ones.

    Attributes:
        A: the matrix.
        b: the weights.
        units: by how much each of their texts may be off.
    """

    A: Rows
    b: Row
    units: Units


class Writing:
    """Writes numbers with the digits that rounding leaves of them.

    Attributes:
        units: by how much each text may be off.
    """

    def __init__(self) -> None:
        self.units: dict[str, fmpq] = {}

    def row(self, exact: Numbers, balls: Numbers) -> Row:
        """A row of numbers with the balls around them."""
        return tuple(self._text(x, ball) for x, ball in zip(exact, balls, strict=True))

    def rows(self, exact: Sequence[Numbers], balls: Sequence[Numbers]) -> Rows:
        """The same of a matrix."""
        return tuple(self.row(*pair) for pair in zip(exact, balls, strict=True))

    def _text(self, x: Number | int, ball: arb | int) -> str:
        if not isinstance(x, fmpq) or isinstance(ball, int):
            return str(x)
        radius = float(ball.rad())
        if radius < 1e-200 or not x:
            return str(x)
        first, last = (math.floor(math.log10(size)) for size in (abs(float(ball.mid())), radius))
        text = to_decimal(x, max(1, 1 + first - last))
        unit = rounded_up(arb(ball.rad()) + arb(10) ** min(last, first))
        self.units[text] = max(unit, self.units.get(text, unit))
        return text


def _butcher(found: tuple[Steps, Steps]) -> Converted:
    """The matrix and the weights.

    Raises:
        Unreadable: a stage begins elsewhere than at the value before the step.
    """
    exact, balls = found
    with ctx.workprec(BITS):
        for i, (start, ball) in enumerate(zip(exact.starts, balls.starts, strict=True), start=1):
            radius = 0 if isinstance(ball, int) else 10 * ball.rad()
            if not arb(abs(to_ball(start - 1 + fmpq(0)))) <= radius:
                told = to_decimal(start + fmpq(0), 8)
                raise Unreadable(f"stage {i} begins at {told} y, not at y")
        writing = Writing()
        A, b = writing.rows(exact.A, balls.A), writing.row(exact.b, balls.b)
        return Converted(A, b, tuple(writing.units.items()))


def low_storage(form: str, A: Sequence[Row], b: Row) -> Converted:
    """The matrix and the weights of a scheme that is named: 2N, 2C, 2R and its like."""
    scheme = FORMS.get(form, van_der_houwen)
    numbers = (*A, b) if form in FORMS else (b, *A)
    return _butcher(Printed(*numbers).steps(scheme))


def recognised(A: Row, b: Row, c: Row | None) -> tuple[str, Converted]:
    """The scheme of two rows whose sums are the nodes, and whose weights have the sum 1.

    Raises:
        Unreadable: none of them, or several.
    """
    printed = Printed(A, b)
    fitting = []
    for form, scheme in FORMS.items():
        steps, _ = found = printed.steps(scheme)
        if _is_near(steps.b, fmpq(1)) and (c is None or _agree(steps, c)):
            fitting.append((form, found))
    alike = {_butcher(found): form for form, found in reversed(fitting)}
    if len(alike) > 1 and c is None:
        # the nodes are the row sums, and weights make at least order 2 with these
        better = {_butcher(found): form for form, found in fitting if _has_order_two(found[0])}
        alike = better or alike
    if len(alike) != 1:
        kind = "no low-storage method" if not alike else "more than one low-storage method"
        raise Unreadable(f"A and b are {kind} with these nodes" if c else f"A and b are {kind}")
    made, form = alike.popitem()
    return form, made


def _has_order_two(steps: Steps) -> bool:
    nodes = [sum(row, start=fmpq(0)) for row in steps.A]
    return _is_near([b * c for b, c in zip(steps.b, nodes, strict=True)], fmpq(1, 2))


def _agree(steps: Steps, c: Row) -> bool:
    nodes = [parse(x) for x in c]
    domain = Domain(nodes)
    given: list[Number] = [fmpq(0)] * (len(steps.b) - len(nodes))
    given += map(domain.evaluate, nodes)
    pairs = zip(steps.A, given, strict=False)
    return len(given) == len(steps.b) and all(_is_near(row, node) for row, node in pairs)


def _is_near(row: Numbers, total: Number) -> bool:
    return bool(abs(to_ball(sum(row, start=fmpq(0)) - total)) < NEAR)


def of_three_registers(*given: Row) -> Converted:
    """The matrix and the weights of 3S*: γ₁, γ₂, γ₃, δ and β."""
    return _butcher(Printed(*given).steps(three_registers))


def of_shu_osher(alpha: Rows, beta: Rows) -> Converted:
    """The matrix and the weights of the form of Shu and Osher."""
    return _butcher(Printed(alpha, beta).steps(shu_osher))


def of_nystrom(A: Rows, b: Row, c: Row) -> Converted:
    """The velocities that positions see, and the weights of these."""
    printed = Printed(A, b, c)
    with ctx.workprec(BITS):
        (exact, weights), (balls, ball) = nystrom(*printed.exact), nystrom(*printed.balls)
        writing = Writing()
        A, b = writing.rows(exact, balls), writing.row(weights, ball)
    return Converted(A, b, tuple(writing.units.items()))
