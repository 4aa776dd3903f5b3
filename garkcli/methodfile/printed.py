"""How exactly coefficients are printed: what their last digits leave open."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import TypeAlias

from flint import arb, ctx, fmpq

from garkcli.exact.display import to_ball
from garkcli.exact.enclosing import OPERATIONS, enclose, integer_power
from garkcli.exact.field import Number
from garkcli.exact.nodes import AlgebraicRoot, Chain, Expression, Literal, Power, Root, is_decimal
from garkcli.order.tolerance import rounded_up

Printed: TypeAlias = Sequence[tuple[Expression, Number]]
"""Coefficients as they are written, with their values."""
Units: TypeAlias = Mapping[Number, fmpq]
"""By how much values may be off."""
FEWEST_DIGITS = 6
"""A number with fewer digits is meant exactly."""
SHORTENED = 4
"""The denominator of a decimal has so many digits fewer in lowest terms, at most."""
MANY_DIGITS = 14
"""In the source of a solver a decimal of so many digits is a rounded one, however long others are:
products of two that are written out have twice as many.
"""
LONG_DENOMINATOR = 10**5
"""Fractions with a smaller denominator are no approximants."""
LONG_DECIMAL = 10**9
"""Decimals that were written as fractions with a smaller one are exact."""

CARELESS = 1_000
"""Units of the last place that a careless rounding may be off by."""
FLOAT = fmpq(1, 2**53)
"""By how much of itself the float next to a number is off."""
LARGEST = fmpq(2) ** 1023
SHORTER = 100
"""A decimal of so many times finer units than a float never was one."""
QUADRUPLE = fmpq(1, 2**113)
"""By how much of itself the number of quadruple precision next to a number is off."""


def printed_units(printed: Printed, many: int | None = None) -> dict[Number, fmpq]:
    """By how much each value may be off if its last digits are rounded, one unit of them.

    A decimal counts as rounded when it has more than half as many digits as the longest one of
    the file: beside 0.7886751345948129 the number 0.25 is exact. A long numerator or denominator
    may be off by one. Units are rounded up, by less than a tenth.

    Args:
        printed: coefficients as they are written, with their values.
        many: a decimal of so many digits counts as rounded whatever the longest has; None for no
            such number.

    >>> from garkcli.exact.expression import parse
    >>> units = printed_units([(parse(x), fmpq(1, 2)) for x in ("0.50000000", "1/2")])
    >>> units[fmpq(1, 2)]
    11/1000000000
    """
    longest = max((_digits(x) for text, _ in printed for x in _literals(text)), default=0)
    half = longest // 2 + 1
    fewest = max(FEWEST_DIGITS, half if many is None else min(half, many))
    units: dict[Number, fmpq] = {}
    with ctx.workprec(4 * longest + 128):
        for expression, value in printed:
            unit = _radius(_enclosed(expression, fewest))
            # equal values may be printed to different lengths
            units[value] = max(unit, units.get(value, unit))
    return units


def approximant_units(printed: Printed, given: Units | None = None) -> dict[Number, fmpq]:
    """The same for the source of a solver, where whole numbers are what they are.

    Of numbers that were made of printed ones it is ``given`` by how much they may be off.

    A fraction with a long denominator q may be an approximant of an irrational number, as those of
    Kennedy and Carpenter are: good ones are off by 1/q^2, and a hundred times that is admitted.
    One that is a decimal in lowest terms counts as that decimal. Every fraction with a shorter
    denominator, such as 161/1000 and 3/64, is exact, so that a wrong digit of it is no rounding.

    >>> from garkcli.exact.expression import parse
    >>> texts = ("19372/6561", "1767732205903/4055673282236", "3/64")
    >>> values = (fmpq(19372, 6561), fmpq(1767732205903, 4055673282236), fmpq(3, 64))
    >>> units = approximant_units(list(zip(map(parse, texts), values, strict=True)))
    >>> units[values[0]], 0 < units[values[1]] < fmpq(1, 10**22), units[values[2]]
    (0, True, 0)
    """
    units = printed_units([pair for pair in printed if not _is_whole(pair[0])], MANY_DIGITS)
    for expression, value in printed:
        if _is_whole(expression):
            units.setdefault(value, _approximation(value))
    for value, unit in (given or {}).items():
        units[value] = max(unit, units.get(value, unit))
    return units


def careless_units(printed: Printed, given: Units | None = None) -> dict[Number, fmpq]:
    """The same where decimals are rounded carelessly: ``CARELESS`` units of their last place. What
    may have been computed in floats before it was printed, fractions and decimals that are no
    longer than floats or are floats, may be off by so many units of these; longer decimals by many
    units of quadruple precision. A decimal that is short beside others is off by one unit.
    """
    units = approximant_units(printed, given)
    decimals = [pair for pair in printed if not _is_whole(pair[0])]
    own = printed_units(decimals, FEWEST_DIGITS)
    fractions = {value for expression, value in printed if _is_whole(expression)}
    for value, unit in units.items():
        size = rounded_up(abs(to_ball(value)))
        of_float = size * FLOAT
        if value in fractions and unit:
            units[value] = max(10 * unit, CARELESS * of_float)
        elif unit:
            is_float = unit > of_float / SHORTER or _is_float(value, unit)
            least = of_float if is_float else CARELESS * size * QUADRUPLE
            units[value] = max(CARELESS * max(unit, least), own.get(value, unit))
    return units


def _is_float(value: Number, unit: fmpq) -> bool:
    """Whether all digits of a decimal are those of a float."""
    if not isinstance(value, fmpq) or abs(value) > LARGEST:
        return False
    return abs(fmpq(*(int(value.p) / int(value.q)).as_integer_ratio()) - value) <= unit


def _is_whole(expression: Expression) -> bool:
    """Whether only whole numbers are in it, 2.0 as C has it among them."""
    return all(x.value.q == 1 for x in _literals(expression))


def _approximation(value: Number) -> fmpq:
    """By how much a fraction may be off."""
    if not isinstance(value, fmpq) or value.q < LONG_DENOMINATOR:
        return fmpq(0)
    q = int(value.q)
    for places in range(len(str(q)), len(str(q)) + SHORTENED):
        # a decimal that was written as a fraction, in lowest terms
        if not 10**places % q:
            return fmpq(1, 10**places) if q >= LONG_DECIMAL else fmpq(0)
    return fmpq(100, q * q)


def is_long_fraction(expression: Expression, value: Number) -> bool:
    """Whether a fraction of whole numbers may be an approximant: its denominator is long."""
    return _is_whole(expression) and isinstance(value, fmpq) and value.q >= LONG_DENOMINATOR


def fewest_digits(texts: Iterable[Expression]) -> int:
    """A decimal with fewer digits is exact beside others that are long: it has at most half as
    many. Zeros after the point count, as tables have decimals of one length.

    >>> from garkcli.exact.expression import parse
    >>> fewest_digits(map(parse, ("0.25", "0.7886751345948129", "1/3")))
    9
    """
    decimals = [x for text in texts for x in _literals(text) if is_decimal(x)]
    return max(map(_places, decimals), default=0) // 2 + 1


def unit_of(expression: Expression, value: Number, fewest: int) -> fmpq:
    """By how much a decimal may be off, one unit of its last digit, a fraction with a long
    denominator, or a root of a polynomial with decimals, as the coarsest of these; 0 for one that
    is exact.

    Args:
        expression: as it is written.
        value: of it.
        fewest: digits of a decimal that is no exact one, as ``fewest_digits`` has it.

    >>> from garkcli.exact.expression import parse
    >>> unit_of(parse("0.25"), fmpq(1, 4), 9), unit_of(parse("0.25"), fmpq(1, 4), 2)
    (0, 1/100)
    """
    if expression.decimals:
        return max(unit_of(x, x.value, fewest) for x in expression.decimals)
    if isinstance(expression, Literal) and is_decimal(expression):
        return _unit(expression) if _places(expression) >= fewest else fmpq(0)
    return _approximation(value)


def coarsest_unit(texts: Sequence[Expression]) -> fmpq:
    """By how much a number in some texts may be off at most, where its own digits say it."""
    fewest = fewest_digits(texts)
    units = [fmpq(0)]
    for literal in (x for text in texts for x in _literals(text)):
        if is_decimal(literal):
            units.append(unit_of(literal, literal.value, fewest))
        elif literal.value >= LONG_DENOMINATOR:
            units.append(fmpq(100) / literal.value**2)
    return max(units)


def _places(literal: Literal) -> int:
    """Digits of a decimal, with zeros between the point and the first of them."""
    mantissa, _, exponent = literal.text.lower().partition("e")
    return max(_digits(literal), len(mantissa.partition(".")[2]) - int(exponent or 0))


def _literals(expression: Expression) -> Iterator[Literal]:
    if expression.decimals:
        yield from expression.decimals
        return
    match expression:
        case Literal():
            yield expression
        case Chain(operands=operands):
            for operand in operands:
                yield from _literals(operand)
        case Power(base=inner) | Root(radicand=inner):
            yield from _literals(inner)


def _digits(literal: Literal) -> int:
    """Digits of a printed number, without zeros in front."""
    return len(literal.text.lower().partition("e")[0].replace(".", "").lstrip("0"))


def _unit(literal: Literal) -> fmpq:
    """One in the last place."""
    mantissa, _, exponent = literal.text.lower().partition("e")
    decimals = len(mantissa.partition(".")[2]) - int(exponent or 0)
    return fmpq(10) ** -decimals


def _enclosed(expression: Expression, fewest: int) -> arb:
    """All values that the expression may have, its long numbers off by one unit each."""
    match expression:
        case Literal(value=value):
            least = FEWEST_DIGITS if expression.text.isdigit() else fewest
            return arb(value) if _digits(expression) < least else arb(value, arb(_unit(expression)))
        case Chain(signs=signs, operands=operands):
            total = arb(0) if signs[0] in "+-" else arb(1)
            for sign, operand in zip(signs, operands, strict=True):
                total = OPERATIONS[sign](total, _enclosed(operand, fewest))
            return total
        case Power(base=base, exponent=exponent):
            return integer_power(_enclosed(base, fewest), exponent)
        case Root(radicand=radicand, index=index):
            inner = _enclosed(radicand, fewest)
            return -(-inner).root(index) if inner < 0 else inner.root(index)
        case AlgebraicRoot():
            return enclose(expression)
    return arb(0)


def _radius(ball: arb) -> fmpq:
    """How far the ball reaches, rounded up to a digit or two; 1 where it reaches everywhere."""
    if not ball.is_finite():
        return fmpq(1)
    radius = ball.rad()
    return fmpq(0) if radius < arb(10) ** -1000 else rounded_up(radius)
