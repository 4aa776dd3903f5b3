"""The smallest exact domain for a set of expressions: ℚ, or a number field ℚ(θ) that holds their
radicals.

Square roots of one square class give ℚ(√d) at once; any other set of radicals is adjoined root by
root, see ``garkcli.exact.tower``.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, TypeAlias

from flint import ctx, fmpq, fmpq_poly, fmpz

from garkcli.errors import LimitExceeded, UndefinedValue
from garkcli.exact import nodes
from garkcli.exact.enclosing import OPERATIONS, enclose
from garkcli.exact.field import ONE, ZERO, Algebraic, Number, NumberField
from garkcli.exact.rewriting import roots_in

if TYPE_CHECKING:
    from garkcli.exact.tower import Tower


TRIAL_LIMIT = 1000
"""Primes below this are always found in radicands."""
MOST_BITS_FACTORED = 100
"""Cofactors without small primes are factored up to so many bits, within milliseconds."""


def square_free(number: fmpq) -> fmpq:
    """An integer of the square class of ``number`` ≠ 0, free of the square factors that are found.

    >>> square_free(fmpq(4, 3)), square_free(fmpq(12)), square_free(fmpq(-3 * 27233**2))
    (3, 3, -3)
    """
    n = number.p * number.q
    factors = abs(n).factor(trial_limit=TRIAL_LIMIT)
    kept = fmpz(1 if n > 0 else -1)
    for factor, exponent in factors:
        if exponent % 2:
            kept *= _without_squares(factor)
    return fmpq(kept)


def _without_squares(factor: fmpz) -> fmpz:
    """The square-free part of a prime, or of a cofactor without small primes."""
    if factor.bit_length() <= MOST_BITS_FACTORED:
        kept = fmpz(1)
        for prime, exponent in factor.factor():
            kept *= prime ** (exponent % 2)
        return kept
    root = factor.isqrt()
    if root * root == factor:
        return fmpz(1)
    return factor


def perfect_root(root: nodes.Root, radicand: fmpq) -> fmpq | None:
    """The value of a root of a perfect power, else None; UndefinedValue if it is not real."""
    if radicand < 0 and root.index % 2 == 0:
        raise even_root_fault(root)
    p = abs(radicand.p).root(root.index)
    q = radicand.q.root(root.index)
    if radicand < 0:
        p = -p
    candidate = fmpq(p, q)
    if candidate**root.index != radicand:
        return None
    return candidate


def even_root_fault(root: nodes.Root) -> UndefinedValue:
    message = "an even root of a negative number"
    cure = "coefficients are real numbers"
    return UndefinedValue(message, cure, root.start, root.end, code="not-real")


def rational_square_root(number: fmpq) -> fmpq | None:
    """The square root of a number ≥ 0; None if it is irrational."""
    root = fmpq(number.p.isqrt(), number.q.isqrt())
    if root**2 != number:
        return None
    return root


Radical: TypeAlias = nodes.Root | nodes.AlgebraicRoot
MAX_BITS = 60_000
"""Most bits of the numerator or denominator of a coefficient."""
MAX_BITS_TOGETHER = 20_000_000
"""Most bits of all different coefficients of one file."""
MAX_RADICALS = 32
MAX_DEGREE = 48
MAX_EFFORT = 400_000
"""Limit of bits times degree² when a radical is adjoined: about a second."""
MAX_PRECISION = 8192
"""Bits to which a nested radicand is evaluated before its sign is decided exactly."""


class Domain:
    """The field of the radicals of ``expressions``, None for ℚ; numbers of a method share a domain.

    ``only_check`` makes no field; ``are_real`` skips the check that roots are real. Raises
    UndefinedValue for an even root of a negative number, LimitExceeded for too many radicals.

    >>> from garkcli.exact.expression import parse
    >>> c = parse("1/2 - sqrt(3)/6")
    >>> number = Domain([c]).evaluate(c)
    >>> number * number
    1/3 - sqrt(3)/6
    """

    def __init__(
        self,
        expressions: Iterable[nodes.Expression],
        only_check: bool = False,
        are_real: bool = False,
    ) -> None:
        self.field: NumberField | None = None
        self._are_real = are_real
        self._size = 0
        self._values: dict[Radical, Number] = {}
        radicals: list[Radical] = []
        for expression in expressions:
            radicals += roots_in(expression)
        irrational = []
        for root in dict.fromkeys(radicals):  # each once, the inner ones first
            value = self._rational_root(root)
            if value is None:
                irrational.append(root)
            else:
                self._values[root] = value
        if len(irrational) > MAX_RADICALS:
            message = f"{len(irrational)} different radicals (limit {MAX_RADICALS})"
            first = irrational[0]
            cure = "write the coefficients in fewer"
            raise LimitExceeded(message, cure, first.start, first.end)
        if irrational and not only_check and not self._quadratic(irrational):
            self._generated(irrational)

    @property
    def degree(self) -> int:
        return self.field.degree if self.field else 1

    def coefficient(self, expression: nodes.Expression) -> Number:
        """Evaluates, and counts the size against the limit of a file; raises as ``evaluate``."""
        value = self.evaluate(expression)
        self._size += _bits(value) * (value.poly.length() if isinstance(value, Algebraic) else 1)
        if self._size > MAX_BITS_TOGETHER:
            message = f"the coefficients have more than {MAX_BITS_TOGETHER} bits together"
            raise LimitExceeded(message, "write them smaller", expression.start, expression.end)
        return value

    def evaluate(self, expression: nodes.Expression) -> Number:
        """The exact value; LimitExceeded beyond ``MAX_BITS``, UndefinedValue for 1/0 or a name."""
        match expression:
            case nodes.Literal(value=value):
                return value
            case nodes.Chain(signs=signs, operands=operands):
                total: Number = ZERO if signs[0] in "+-" else ONE
                for sign, operand in zip(signs, operands, strict=True):
                    total = self._apply(sign, total, self.evaluate(operand), operand)
                    if _bits(total) > MAX_BITS:
                        raise too_many_bits(expression)
                return total
            case nodes.Power(base=base, exponent=exponent):
                return self._power(self.evaluate(base), exponent, expression)
            case nodes.Root() | nodes.AlgebraicRoot():
                return self._values[expression]
            case nodes.Name(name=name):
                message = f"{name!r} has no value"
                cure = "write a number, such as 1/2 or sqrt(2)"
                where = expression.start, expression.end
                raise UndefinedValue(message, cure, *where, code="missing-key")
        raise TypeError(f"no expression: {expression!r}")

    def _apply(self, sign: str, left: Number, right: Number, at: nodes.Expression) -> Number:
        if sign == "/" and not right:
            raise nodes.divided_by_zero(at, "the divisor is exactly zero: write another one")
        result: Number = OPERATIONS[sign](left, right)
        return result

    def _power(self, number: Number, exponent: int, at: nodes.Expression) -> Number:
        if not number and exponent < 0:
            raise nodes.divided_by_zero(at, "a negative power of zero: write another base")
        if _bits(number) * abs(exponent) > MAX_BITS:
            raise too_many_bits(at)
        return number**exponent

    def _rational_root(self, root: Radical) -> Number | None:
        if isinstance(root, nodes.AlgebraicRoot):
            return None
        if not self._has_rational_radicand(root):
            if not self._are_real and root.index % 2 == 0 and _sign(root.radicand) < 0:
                raise even_root_fault(root)
            return None
        return perfect_root(root, self._rational_value(root.radicand))

    def _has_rational_radicand(self, root: nodes.Root) -> bool:
        return all(inner in self._values for inner in roots_in(root.radicand))

    def _rational_value(self, expression: nodes.Expression) -> fmpq:
        value = self.evaluate(expression)
        assert not isinstance(value, Algebraic)
        return value

    def _quadratic(self, roots: list[Radical]) -> bool:
        """Makes the field ℚ(√d) if all roots are square roots in one square class; else False."""
        radicands = []
        for root in roots:
            if isinstance(root, nodes.AlgebraicRoot) or root.index != 2:
                return False
            if not self._has_rational_radicand(root):
                return False
            radicands.append(self._rational_value(root.radicand))
        d = square_free(radicands[0])
        scales: list[fmpq] = []
        for radicand in radicands:
            scale = rational_square_root(radicand / d)
            if not scale:
                return False
            scales.append(scale)
        theta = fmpq_poly([0, 1])
        modulus = fmpq_poly([-d, 0, 1])
        self.field = NumberField(modulus, [(nodes.Root(nodes.Literal(d), 2), theta)])
        for root, scale in zip(roots, scales, strict=True):
            self._values[root] = self.field.element(theta * scale)
        return True

    def _generated(self, roots: list[Radical]) -> None:
        from garkcli.exact.tower import RATIONALS  # few methods have such roots

        tower = RATIONALS
        kept: list[Radical] = []
        for root in roots:
            relation = self._relation(tower, kept, root)
            if not any(relation):
                self._values[root] = ZERO
                continue
            degree = tower.degree * len(relation)
            if degree > MAX_DEGREE:
                message = f"radicals of degree {degree} together (limit {MAX_DEGREE})"
                cure = "write the coefficients in fewer or simpler radicals"
                raise LimitExceeded(message, cure, root.start, root.end)
            bits = max(map(_length, [tower.modulus, *relation]))
            if tower.degree > 1 and bits * degree**2 > MAX_EFFORT:
                most = MAX_EFFORT // degree**2
                message = f"radicals of degree {degree} from numbers of {bits} bits (limit {most})"
                cure = "use fewer radicals, or radicals of shorter numbers"
                raise LimitExceeded(message, cure, root.start, root.end)
            kept.append(root)
            tower = tower.adjoin(relation, lambda: [*map(enclose, kept)])
        elements = list(zip(kept, tower.elements, strict=True))
        if tower.degree > 1:
            self.field = NumberField(tower.modulus, elements)
        for root, poly in elements:
            self._values[root] = self.field.element(poly) if self.field else poly[0]

    def _relation(self, tower: Tower, kept: list[Radical], root: Radical) -> list[fmpq_poly]:
        """The r_j of yⁿ = r_0 + r_1 y + … for a root y, as polynomials in θ."""
        if isinstance(root, nodes.AlgebraicRoot):
            *lower, leading = root.coefficients
            return [fmpq_poly([fmpq(-a, leading)]) for a in lower]
        return [self._within(tower, kept, root.radicand)] + [fmpq_poly()] * (root.index - 1)

    def _within(
        self, tower: Tower, roots: list[Radical], expression: nodes.Expression
    ) -> fmpq_poly:
        """The value of an expression in the roots adjoined so far, as a polynomial in θ."""
        field = NumberField(tower.modulus, ())
        outer = self._values
        self._values = dict(outer)
        for root, poly in zip(roots, tower.elements, strict=True):
            self._values[root] = field.element(poly)
        try:
            value = self.evaluate(expression)
        finally:
            self._values = outer
        if isinstance(value, Algebraic):
            return value.poly
        return fmpq_poly([value])


def _sign(expression: nodes.Expression) -> int:
    with ctx.workprec(64):
        while ctx.prec <= MAX_PRECISION:
            ball = enclose(expression)
            if ball > 0 or ball < 0:
                return 1 if ball > 0 else -1
            ctx.prec *= 2
    # the roots inside were checked before this one; to check them again, each with those inside of
    # it, doubles the work with every level
    if Domain([expression], are_real=True).evaluate(expression):
        message = "a radicand too close to zero"
        start, end = expression.start, expression.end
        raise LimitExceeded(message, "write it simpler", start, end)
    return 0


def _bits(number: Number) -> int:
    if isinstance(number, Algebraic):
        return max(int(x.height_bits()) for x in number.poly.coeffs())
    return int(number.height_bits())


def _length(p: fmpq_poly) -> int:
    return max(int(p.numer().height_bits()), p.denom().bit_length())


def too_many_bits(at: nodes.Expression) -> LimitExceeded:
    message = f"a number of more than {MAX_BITS} bits"
    return LimitExceeded(message, "write it smaller", at.start, at.end)
