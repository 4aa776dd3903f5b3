"""The precision of printed coefficients, from their last digits."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from fractions import Fraction
from math import isqrt
from typing import TypeAlias

from flint import arb, ctx, fmpq

from garkcli.exact.display import to_ball
from garkcli.exact.enclosing import OPERATIONS, enclose, integer_power
from garkcli.exact.field import Number
from garkcli.exact.nodes import AlgebraicRoot, Chain, Expression, Literal, Power, Root, is_decimal
from garkcli.order.tolerance import rounded_up

Printed: TypeAlias = Sequence[tuple[Expression, Number]]
Units: TypeAlias = Mapping[Number, fmpq]
FEWEST_DIGITS = 6
"""A number with fewer digits is taken as exact."""
FEW_PLACES = range(3, 6)
"""Decimals of so many places look rounded if none is longer, as on a sheet of exercises."""
SEVERAL, SEVERAL_PLACES = 3, 4
"""Fewest such decimals, and fewest places: three places are often exact."""
RARE = 15
"""About 3 n²/10 fractions below 1 have denominators up to n: one number in fifty is as close to one
as a decimal with this times n² units.
"""
SHORTENED = 4
"""Most digits by which lowest terms shorten the denominator of a decimal."""
MANY_DIGITS = 14
"""Decimals with more digits are rounded, however long the others are."""
LONG_DENOMINATOR = 10**5
"""Fractions with a smaller denominator are not approximants."""
LONG_DECIMAL = 9
"""Decimals written as fractions are exact with fewer places."""

SLACK = 10
"""Units of the last place that a number may be wrong by if it was computed in that precision."""
CARELESS = 1_000
FLOAT = fmpq(1, 2**53)
LARGEST = fmpq(2) ** 1023
SHORTER = 100
"""A decimal whose units are finer than those of a float by this factor was not a float."""
QUADRUPLE = fmpq(1, 2**113)


def printed_units(printed: Printed, many: int = MANY_DIGITS) -> dict[Number, fmpq]:
    """The largest error of each value if its last digit is rounded, one unit.

    A decimal counts as rounded if it has more than half as many digits as the longest one of the
    file: beside 0.7886751345948129 the number 0.25 is exact; one with ``many`` digits always. A
    fraction with a long denominator may be an approximant. Units are rounded up by less than a
    tenth.

    >>> from garkcli.exact.expression import parse
    >>> units = printed_units([(parse(x), fmpq(1, 2)) for x in ("0.50000000", "1/2")])
    >>> units[fmpq(1, 2)]
    11/1000000000
    """
    decimals = [x for text, _ in printed for x in _literals(text) if is_decimal(x)]
    longest = max(map(_digits, decimals), default=0)
    fewest = max(FEWEST_DIGITS, min(longest // 2 + 1, many))
    units: dict[Number, fmpq] = {}
    for expression, value in printed:
        unit = _unit_in(expression, fewest)
        # equal values may be printed to different lengths
        units[value] = max(unit, units.get(value, unit))
    return units


def left_open(printed: Printed) -> list[fmpq]:
    """The error of each number computed to its digits; 0 if it is exact."""
    fewest = max(FEWEST_DIGITS, fewest_digits(text for text, _ in printed))
    units = [(x, unit_of(text, fewest)) for text, x in printed]
    return [SLACK * max(unit, _float_unit(x, unit)) for x, unit in units]


def is_short(printed: Printed) -> bool:
    """Whether short decimals look rounded although ``left_open`` finds them exact: several, or
    simple fractions, or one alone of four places.
    """
    decimals = [x for text, _ in printed for x in _literals(text) if is_decimal(x)]
    few = [x for x in decimals if _decimals(x) in FEW_PLACES]
    if not few or max(map(_decimals, decimals)) not in FEW_PLACES:
        return False
    four = sum(_decimals(x) >= SEVERAL_PLACES for x in few)
    return four >= SEVERAL or (len(few) + four > 1 and all(map(_is_simple, few)))


def _is_simple(literal: Literal) -> bool:
    """Whether a decimal is rounded from a fraction of small denominator: rare by chance."""
    unit, value = _unit(literal), Fraction(int(literal.value.p), int(literal.value.q))
    most = isqrt(int((1 / unit).floor()) // RARE)
    return 0 < abs(value.limit_denominator(most) - value) <= Fraction(int(unit.p), 2 * int(unit.q))


def as_typed(printed: Printed) -> list[fmpq]:
    """The errors as in ``left_open``; of short decimals one unit of their last place."""
    if is_short(printed):
        return [unit_of(text, FEW_PLACES.start) for text, _ in printed]
    return left_open(printed)


def _float_unit(value: Number, unit: fmpq) -> fmpq:
    """The error of a rounded number that is a float; 0 if it is not."""
    if not unit or not _is_float(value, unit):
        return fmpq(0)
    return rounded_up(abs(to_ball(value))) * FLOAT


def at_full_length(printed: Printed) -> list[fmpq]:
    """The errors, at most the median in places or digits: zeros at the end are often dropped."""
    own = as_typed(printed)
    if is_short(printed):
        return own
    with ctx.workprec(64):
        sizes = [rounded_up(abs(to_ball(value))) for _, value in printed]
    rounded = [(unit, size) for unit, size in zip(own, sizes, strict=True) if unit and size]
    if not rounded:
        return own
    middle = len(rounded) // 2
    unit = sorted(unit for unit, _ in rounded)[middle]
    part = sorted(unit / size for unit, size in rounded)[middle]
    return [min(x, max(unit, part * size)) for x, size in zip(own, sizes, strict=True)]


def approximant_units(printed: Printed, given: Units | None = None) -> dict[Number, fmpq]:
    """The errors of numbers of a solver, where integers are exact; ``given`` has those of computed
    ones.

    A fraction with a long denominator q may be an approximant of an irrational number, as those of
    Kennedy and Carpenter are: good ones are within 1/q^2, and a hundred times that is admitted. A
    fraction that is a decimal in lowest terms counts as that decimal. Fractions with shorter
    denominators, such as 161/1000, are exact, so that a wrong digit does not count as rounding.

    >>> from garkcli.exact.expression import parse
    >>> texts = ("19372/6561", "1767732205903/4055673282236", "3/64")
    >>> values = (fmpq(19372, 6561), fmpq(1767732205903, 4055673282236), fmpq(3, 64))
    >>> units = approximant_units(list(zip(map(parse, texts), values, strict=True)))
    >>> units[values[0]], 0 < units[values[1]] < fmpq(1, 10**22), units[values[2]]
    (0, True, 0)
    """
    units = printed_units(printed)
    for value, unit in (given or {}).items():
        units[value] = max(unit, units.get(value, unit))
    return units


def careless_units(printed: Printed, given: Units | None = None) -> dict[Number, fmpq]:
    """The errors after careless rounding of decimals: ``CARELESS`` units of the last place.

    Fractions, and decimals no longer than floats, may have been computed in floats and may be wrong
    by as many units of these; longer decimals by many units of quadruple precision. A decimal that
    is short beside others is within one unit.
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
        else:
            units[value] = own.get(value, unit)
    return units


def _is_float(value: Number, unit: fmpq) -> bool:
    if not isinstance(value, fmpq) or abs(value) > LARGEST:
        return False
    return abs(fmpq(*(int(value.p) / int(value.q)).as_integer_ratio()) - value) <= unit


def _is_whole(expression: Expression) -> bool:
    """Whether all numbers of an expression are integers, including 2.0 as in C."""
    return all(x.value.q == 1 or not x.text for x in _literals(expression))


def _approximation(value: Number) -> fmpq:
    if not isinstance(value, fmpq) or value.q < LONG_DENOMINATOR:
        return fmpq(0)
    q = int(value.q)
    for places in range(len(str(q - 1)), len(str(q)) + SHORTENED):
        # a decimal that was written as a fraction, in lowest terms
        if not 10**places % q:
            return fmpq(1, 10**places) if places >= LONG_DECIMAL else fmpq(0)
    return fmpq(100, q * q)


def is_long_fraction(expression: Expression, value: Number) -> bool:
    return _is_whole(expression) and isinstance(value, fmpq) and value.q >= LONG_DENOMINATOR


def fewest_digits(texts: Iterable[Expression]) -> int:
    """Digits below which a decimal is exact: half of the longest; tables have equal lengths, so
    zeros after the point count.

    >>> from garkcli.exact.expression import parse
    >>> fewest_digits(map(parse, ("0.25", "0.7886751345948129", "1/3")))
    9
    """
    decimals = [x for text in texts for x in _literals(text) if is_decimal(x)]
    return min(max(map(_places, decimals), default=0) // 2 + 1, MANY_DIGITS)


def unit_of(expression: Expression, fewest: int) -> fmpq:
    """Returns one unit of the last digit of a decimal, 0 for an exact number.

    A root of a polynomial has the largest unit of its decimals, a long fraction that of an
    approximant.

    >>> from garkcli.exact.expression import parse
    >>> unit_of(parse("0.25"), 9), unit_of(parse("0.25"), 2)
    (0, 1/100)
    """
    if expression.decimals:
        return max(unit_of(x, fewest) for x in expression.decimals)
    if isinstance(expression, Literal) and is_decimal(expression):
        return _unit(expression) if _places(expression) >= fewest else fmpq(0)
    return _unit_in(expression, fewest)


def coarsest_unit(texts: Sequence[Expression]) -> fmpq:
    fewest = fewest_digits(texts)
    units = [fmpq(0)]
    units += [unit_of(x, fewest) for text in texts for x in _literals(text)]
    return max(units)


def _places(literal: Literal) -> int:
    return max(_digits(literal), _decimals(literal))


def _parts(chain: Chain) -> Iterator[tuple[str, Expression]]:
    """Terms or factors with their signs; a fraction of integers is one factor."""
    rest = list(zip(chain.signs, chain.operands, strict=True))
    while rest:
        sign, part = rest.pop(0)
        match (sign, part), *rest[:1]:
            case ("*", Literal(value=p)), ("/", Literal(value=q)) if q and p.q == q.q == 1:
                rest.pop(0)
                yield sign, Literal(p / q)
            case _:
                yield sign, part


def _literals(expression: Expression) -> Iterator[Literal]:
    if expression.decimals:
        yield from expression.decimals
        return
    match expression:
        case Literal():
            yield expression
        case Chain():
            for _, part in _parts(expression):
                yield from _literals(part)
        case Power(base=inner) | Root(radicand=inner):
            yield from _literals(inner)


def _digits(literal: Literal) -> int:
    return len(literal.text.lower().partition("e")[0].replace(".", "").lstrip("0"))


def _decimals(literal: Literal) -> int:
    mantissa, _, exponent = literal.text.lower().partition("e")
    return len(mantissa.partition(".")[2]) - int(exponent or 0)


def _unit(literal: Literal) -> fmpq:
    return fmpq(10) ** -_decimals(literal)


def _unit_in(expression: Expression, fewest: int) -> fmpq:
    """The error of an expression whose long numbers are rounded, rounded up."""
    longest = [x for x in _literals(expression) if _open(x, fewest)]
    if not longest:
        return fmpq(0)
    with ctx.workprec(2 * max(x.value.height_bits() for x in longest) + 128):
        return _radius(_enclosed(expression, fewest))


def _open(literal: Literal, fewest: int) -> fmpq:
    if is_decimal(literal):
        return _unit(literal) if _digits(literal) >= fewest else fmpq(0)
    return _approximation(literal.value)


def _enclosed(expression: Expression, fewest: int) -> arb:
    """Encloses the values of an expression with long numbers within one unit."""
    match expression:
        case Literal(value=value):
            return arb(value, arb(_open(expression, fewest)))
        case Chain(signs=signs):
            total = arb(0) if signs[0] in "+-" else arb(1)
            for sign, part in _parts(expression):
                total = OPERATIONS[sign](total, _enclosed(part, fewest))
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
    if not ball.is_finite():
        return fmpq(1)
    radius = ball.rad()
    return fmpq(0) if radius < arb(10) ** -1000 else rounded_up(radius)
