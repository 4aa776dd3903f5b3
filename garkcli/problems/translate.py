"""Translates formulas to sympy node by node: text never reaches sympy; no result has kinks."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from garkcli.errors import LimitExceeded, UndefinedValue
from garkcli.exact import nodes
from garkcli.exact.domain import MAX_BITS, too_many_bits
from garkcli.exact.expression import MAX_EXPONENT
from garkcli.exact.formula import CONSTANTS, FLOAT_BITS, Value, exponent_of, value_of
from garkcli.exact.nodes import parts
from garkcli.exact.rewriting import format_expression, names_in
from garkcli.frozen import Frozen
from garkcli.problems.expr import Expr, rational

MAX_SIZE = 100_000


class Translator(Frozen):
    """Makes sympy expressions of formulas; ``symbols`` has those of names, ``values`` exponents."""

    symbols: Mapping[str, Any]
    values: Mapping[str, Value]

    def check_constants(self, expression: nodes.Expression) -> None:
        """Raises UndefinedValue or LimitExceeded for constants before sympy computes with them."""
        if all(map(self._is_constant, names_in(expression))):
            value_of(expression, self.values)
            return
        if isinstance(expression, nodes.RealPower):
            self._check_exponent(expression.exponent)
        for part in parts(expression):
            self.check_constants(part)

    def _is_constant(self, name: nodes.Name) -> bool:
        return name.name in self.values or name.name in CONSTANTS

    def _check_exponent(self, exponent: nodes.Expression) -> None:
        for name in names_in(exponent):
            if not self._is_constant(name):
                message = f"the exponent depends on {name.name}"
                cure = "exponents are constants"
                raise UndefinedValue(message, cure, name.start, name.end, code="not-real")

    def translate(self, expression: nodes.Expression) -> Expr:
        """Raises UndefinedValue unless it is real, or for |x|; LimitExceeded for large numbers."""
        import sympy

        self.check_constants(expression)
        made = self._node(expression)
        start, end = expression.start, expression.end
        if made.has(sympy.I, sympy.zoo, sympy.nan, sympy.oo, -sympy.oo):
            message, cure = (
                "this is not a real number",
                "use roots and logarithms of positive numbers",
            )
            raise UndefinedValue(message, cure, start, end, code="not-real")
        if any(abs(x) > 1 << FLOAT_BITS for x in made.atoms(sympy.Rational)):
            number = f"a number above 2^{FLOAT_BITS}"
            message = f"the constants together make {number}"
            raise LimitExceeded(message, "choose other units", start, end)
        return made

    def _node(self, expression: nodes.Expression) -> Expr:
        import sympy

        match expression:
            case nodes.Literal(value=value):
                return rational(value)
            case nodes.Name(name=name):
                if name == "pi":
                    return sympy.pi
                return self.symbols[name]
            case nodes.Chain(signs=signs, operands=operands):
                made = [self._node(x) for x in operands]
                if signs[0] not in "+-":
                    return self._product(signs, made, expression)
                terms = [-x if sign == "-" else x for sign, x in zip(signs, made, strict=True)]
                return sympy.Add(*terms)
            case nodes.Power(base=base, exponent=exponent):
                return self._power(self._node(base), sympy.Integer(exponent), expression)
            case nodes.RealPower(base=base, exponent=exponent):
                fraction = rational(exponent_of(exponent, self.values))
                return self._power(self._node(base), fraction, expression)
            case nodes.Root(radicand=radicand, index=index):
                return self._root(self._node(radicand), index, expression)
            case nodes.Call(function=function, argument=argument):
                made = getattr(sympy, function)(self._node(argument))
                if not made.has(sympy.cot):
                    return made
                # sympy writes tan(x + pi/2) so
                return made.replace(sympy.cot, lambda u: 1 / sympy.tan(u))
        raise TypeError(f"no expression: {expression!r}")

    def _product(self, signs: str, factors: list[Expr], at: nodes.Expression) -> Expr:
        import sympy

        if sum(map(_bits, factors)) > 2 * MAX_BITS:
            raise too_many_bits(at)
        made = []
        for sign, factor in zip(signs, factors, strict=True):
            made.append(1 / factor if sign == "/" else factor)
        return sympy.Mul(*made)

    def _power(self, base: Expr, exponent: Expr, at: nodes.Expression) -> Expr:
        if _bits(base) * abs(exponent) > 2 * MAX_BITS:
            raise too_many_bits(at)
        made = base**exponent
        is_power = made.is_Pow and made.exp.is_Rational
        if is_power and abs(made.exp) > MAX_EXPONENT:
            what = f"the exponents are {made.exp} together"
            message = f"{what} (limit {MAX_EXPONENT})"
            raise LimitExceeded(message, "use smaller ones", at.start, at.end, code="too-many")
        return _without_kinks(made, at)

    def _root(self, radicand: Expr, index: int, at: nodes.Root) -> Expr:
        import sympy

        if index == 2:
            return _without_kinks(sympy.sqrt(radicand), at)
        if radicand.free_symbols:
            inner = _shortened(format_expression(at.radicand))
            message = "only square roots are taken of variables"
            cure = f"where it is positive, write ({inner})**(1/{index})"
            raise UndefinedValue(message, cure, at.start, at.end, code="no-formula")
        power = sympy.Rational(1, index)
        if radicand.is_negative:
            return -((-radicand) ** power)
        return radicand**power


def _without_kinks(made: Expr, at: nodes.Expression) -> Expr:
    """Refuses |x|, which sympy makes of sqrt(x**2)."""
    import sympy

    if made.has(sympy.Abs):
        kink = min(made.atoms(sympy.Abs), key=sympy.default_sort_key)
        message = f"this has |{_shortened(str(kink.args[0]))}|, which has no derivative at 0"
        cure = "write it without the root where the sign is known, "
        cure += "or add a number under the root"
        raise UndefinedValue(message, cure, at.start, at.end, code="no-formula")
    return made


def _shortened(text: str) -> str:
    return text if len(text) < 30 else "…"


def _bits(x: Expr) -> int:
    factor, _ = x.as_coeff_Mul()
    if not factor.is_Rational:
        return 1
    return int(factor.p).bit_length() + int(factor.q).bit_length()


def size_of_derivatives(expression: Expr) -> int:
    """Returns an estimate of the operations in all second derivatives, without differentiating. A
    product of n factors has n (n − 1) products there, so the length can grow like the cube of the
    text.

    >>> from sympy.abc import x, y
    >>> size_of_derivatives(x + y), size_of_derivatives(x * y)
    (0, 6)
    """
    return _sizes(expression, {}).second


class _Sizes(Frozen):
    """The lengths of an expression and of its first and second derivatives."""

    own: int
    symbols: int
    first: int
    second: int


def _sizes(x: Expr, known: dict[Expr, _Sizes]) -> _Sizes:
    if x not in known:
        known[x] = _sizes_of(x, known)
    return known[x]


def _sizes_of(x: Expr, known: dict[Expr, _Sizes]) -> _Sizes:
    n = len(x.free_symbols)
    if not x.args:
        return _Sizes(1, n, first=n, second=0)
    if not n:
        return _Sizes(1, 0, first=0, second=0)
    parts = [_sizes(y, known) for y in x.args]
    if x.is_Mul:
        return _sizes_of_product(n, parts)
    own = sum(y.own for y in parts)
    k = sum(y.symbols for y in parts)
    slopes = sum(y.first for y in parts)
    curvatures = sum(y.second for y in parts)
    if x.is_Add:
        return _Sizes(1 + own, n, slopes, curvatures)
    # f(u): f'' u_a u_b + f' u_ab, with f' and f'' three operations longer than u
    outer = 3 + own
    first = slopes + k * outer
    second = curvatures
    second += 2 * k * k * outer
    second += 2 * k * slopes
    return _Sizes(1 + own, n, first, second)


def _sizes_of_product(n: int, factors: list[_Sizes]) -> _Sizes:
    """The second derivatives of a product differentiate each pair of factors, or one twice."""
    size = 1 + sum(y.own for y in factors)
    symbols = sum(y.symbols for y in factors)
    slopes = sum(y.first for y in factors)
    first = second = 0
    for y in factors:
        k, others = y.symbols, symbols - y.symbols
        rest = size - y.own
        if k:
            first += y.first + k * rest
        if y.second:
            second += y.second + k * k * rest
        second += 2 * y.first * others
        second += k * others * max(rest - y.own, 0)
    return _Sizes(size, n, first, second if slopes else 0)
