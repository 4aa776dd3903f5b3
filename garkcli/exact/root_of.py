"""Roots of polynomials as coefficients: ``root_of(6*x**3 - 18*x**2 + 9*x - 1, 0.4358665)``.

The polynomial in x has rational coefficients; the value is its real root nearest to the second
argument. gark keeps the irreducible factor with that root, so that a number has one form.
"""

from __future__ import annotations

from collections.abc import Iterator

from flint import arb, ctx, fmpq, fmpq_poly, fmpz_poly

from garkcli.errors import ExpressionError, LimitExceeded, UndefinedValue
from garkcli.exact import nodes
from garkcli.exact.enclosing import isolated
from garkcli.frozen import replace

MAX_POLYNOMIAL_DEGREE = 12
MAX_COEFFICIENT_BITS = 4_000
BITS = 128
"""First precision for comparing distances; it doubles until they differ."""
MOST_BITS = 1 << 16
"""Precision at which two roots count as equally near."""
VARIABLE = "x"


def root_nearest(
    polynomial: nodes.Expression, near: nodes.Expression, start: int, end: int
) -> nodes.Expression:
    """Returns the real root nearest to a number, as a ``Literal`` if it is rational.

    ``start`` and ``end`` are offsets. Raises ExpressionError unless given a polynomial in x and a
    number; UndefinedValue without a real root, or with two equally near; LimitExceeded.
    """
    p = polynomial_in_x(polynomial)
    if p.degree() < 1:
        raise _error("a polynomial in x is expected", polynomial)
    target = polynomial_in_x(near)
    if target.degree() > 0:
        raise _error("a number near the root is expected", near)
    factor, number = _nearest(p, target[0], polynomial, near)
    root = _root(factor, number)
    return replace(root, start=start, end=end, decimals=tuple(_decimals(polynomial)))


def _root(factor: fmpz_poly, number: int) -> nodes.Expression:
    if factor.degree() == 1:
        return nodes.Literal(fmpq(-factor[0], factor[1]))
    coefficients = tuple(int(a) for a in factor.coeffs())
    if len(coefficients) == 3:
        c, b, a = (fmpq(x) for x in coefficients)
        middle = -b / (2 * a)
        radical = nodes.Root(nodes.Literal(middle * middle - c / a), 2)
        sign = "-" if number == 0 else "+"
        return nodes.Chain(f"+{sign}", (nodes.Literal(middle), radical))
    return nodes.AlgebraicRoot(coefficients, number)


def _decimals(expression: nodes.Expression) -> Iterator[nodes.Literal]:
    if isinstance(expression, nodes.Literal) and nodes.is_decimal(expression):
        yield expression
    for part in nodes.parts(expression):
        yield from _decimals(part)


def _nearest(
    p: fmpq_poly, target: fmpq, at: nodes.Expression, near: nodes.Expression
) -> tuple[fmpz_poly, int]:
    _, factors = p.numer().factor()
    bits = BITS
    while bits <= MOST_BITS:
        with ctx.workprec(bits):
            distances = []
            for factor, _ in factors:
                roots = isolated(tuple(int(a) for a in factor.coeffs()), bits)
                distances += [(abs(x - target), factor, k) for k, x in enumerate(roots)]
            if not distances:
                message = "the polynomial has no real root"
                raise UndefinedValue(
                    message, "coefficients are real numbers", at.start, at.end, code="not-real"
                )
            distances.sort(key=lambda entry: entry[0].mid())
            if len(distances) == 1 or distances[0][0] < distances[1][0]:
                _, factor, number = distances[0]
                return factor, number
        bits *= 2
    message = "two roots are equally near to this number"
    raise UndefinedValue(
        message, "write more digits of the root", near.start, near.end, code="root-in-doubt"
    )


def polynomial_in_x(expression: nodes.Expression) -> fmpq_poly:
    match expression:
        case nodes.Literal(value=value):
            return fmpq_poly([value])
        case nodes.Name(name=name) if name == VARIABLE:
            return fmpq_poly([0, 1])
        case nodes.Name():
            raise _error("names other than x have no place in root_of", expression)
        case nodes.Chain(signs=signs, operands=operands):
            total = fmpq_poly([0 if signs[0] in "+-" else 1])
            for sign, operand in zip(signs, operands, strict=True):
                total = _joined(sign, total, polynomial_in_x(operand), operand)
                if total.degree() > MAX_POLYNOMIAL_DEGREE or _bits(total) > MAX_COEFFICIENT_BITS:
                    raise _too_large(expression)
            return total
        case nodes.Power(base=base, exponent=exponent):
            return _power(polynomial_in_x(base), exponent, expression)
    raise _error("the polynomial has rational coefficients", expression)


def _joined(sign: str, left: fmpq_poly, right: fmpq_poly, at: nodes.Expression) -> fmpq_poly:
    if sign == "+":
        return left + right
    if sign == "-":
        return left - right
    if sign == "*":
        return left * right
    if right.degree() > 0:
        raise _error("a polynomial is not divided by x", at)
    if right.degree() < 0:
        raise nodes.divided_by_zero(at)
    return left / right[0]


def _power(base: fmpq_poly, exponent: int, at: nodes.Expression) -> fmpq_poly:
    if exponent < 0:
        if base.degree() > 0:
            raise _error("a polynomial is not divided by x", at)
        if base.degree() < 0:
            raise nodes.divided_by_zero(at)
        base = fmpq_poly([1 / base[0]])
    size = abs(exponent)
    if base.degree() * size > MAX_POLYNOMIAL_DEGREE or _bits(base) * size > (MAX_COEFFICIENT_BITS):
        raise _too_large(at)
    return base**size


def _bits(p: fmpq_poly) -> int:
    return max((int(a.height_bits()) for a in p.coeffs()), default=0)


def _too_large(at: nodes.Expression) -> LimitExceeded:
    limits = f"degree {MAX_POLYNOMIAL_DEGREE}, {MAX_COEFFICIENT_BITS} bits"
    message = f"the polynomial of a root is too large (limits: {limits})"
    return LimitExceeded(message, "write a smaller one", at.start, at.end)


def _error(message: str, at: nodes.Expression) -> ExpressionError:
    cure = "write root_of(p, r): p a polynomial in x, r a decimal near the root"
    return ExpressionError(message, cure, at.start, max(at.end, at.start + 1), code="not-a-number")


def approximate(root: nodes.AlgebraicRoot) -> str:
    """Digits of a root to which no other real root of its polynomial is as near.

    >>> approximate(nodes.AlgebraicRoot((-2, 0, 0, 1), 0))
    '1.259921050'
    """
    digits = 10
    while True:
        bits = 4 * digits + BITS
        roots = isolated(root.coefficients, bits)
        text = str(roots[root.number].str(digits, radius=False))
        with ctx.workprec(bits):
            distances = [abs(x - arb(text)) for x in roots]
            mine = distances.pop(root.number)
            if all(mine < other for other in distances):
                return text
        digits *= 2
