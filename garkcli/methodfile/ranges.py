"""Ranges of parameters whose ends are algebraic: rational ends around them, and signs."""

from __future__ import annotations

from flint import fmpq

from garkcli.errors import ExpressionError
from garkcli.exact.cells import between
from garkcli.exact.domain import Domain
from garkcli.exact.nodes import Literal
from garkcli.exact.polynomial import Polynomial
from garkcli.exact.rewriting import format_expression
from garkcli.exact.roots import RealRoot, real_roots, sign_at
from garkcli.grammar.nodes import Node
from garkcli.grammar.source import Source
from garkcli.methodfile.numbers import Between, Coefficient


def between_roots(
    source: Source, ends: tuple[Coefficient, Coefficient], node: Node, where: str
) -> Between:
    """Rational bounds, and the minimal polynomials if they have no other zero there: between the
    bounds they are nonnegative exactly between the ends.
    """
    cure = "write [1/4, 1] or [0, sqrt(2)/2], the smaller end first"
    try:
        numbers = [Domain([x.expression]).evaluate(x.expression) for x in ends]
    except ExpressionError as error:
        source.fault(node, f"{where}: {error.message}", cure, code=error.code)
        return Between()
    low, high = ends_ = [real_roots(Polynomial([-x, 1]))[0][0] for x in numbers]
    if low > high:
        message = f"{where}: the first end is larger than the second"
        source.fault(node, message, cure, code="wrong-value")
        return Between()
    if low == high and low.exact is None:
        message = f"{where}: both ends are one number"
        value, name = format_expression(ends[0].expression), where.rpartition(": ")[2]
        is_wish = where.startswith("design")
        cure = f"write fix: {{{name}: {value}}}" if is_wish else f"write {value} in its place"
        source.fault(node, message, cure, code="wrong-value")
        return Between()
    inner = RealRoot.rational(between(low, high)) if low < high else low
    around: list[fmpq] = []
    for end, is_high in ((low, False), (high, True)):
        others = [x for x, _ in real_roots(Polynomial.from_flint(end.polynomial))]
        beyond = [x for x in others if (x > end if is_high else x < end)]
        next_one = None if not beyond else beyond[0] if is_high else beyond[-1]
        outer = (end, next_one) if is_high else (next_one, end)
        around.append(between(*outer) if end.exact is None else end.exact)
    polynomials = []
    for p in {str(x.polynomial): x.polynomial for x in ends_ if x.exact is None}.values():
        polynomial = Polynomial.from_flint(p)
        zeros = [x for x, _ in real_roots(polynomial)]
        inside = [x for x in zeros if low < x < high]
        if inside:
            message = f"{where}: the polynomial of an end has another zero in the range"
            cure = "write a rational end near it, or fix the unknown"
            source.fault(node, message, cure, code="wrong-value")
            return Between()
        polynomials.append(polynomial * fmpq(sign_at(polynomial, inner)))
    entries = [Coefficient(Literal(x), node, where) for x in around]
    return Between(((entries[0], entries[1]),), tuple(polynomials))
