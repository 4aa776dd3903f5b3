"""Rational functions of parameters, as coefficients of a family of methods.

A number here is a quotient of polynomials over ℚ in the parameters, in python-flint. A rational
number is a plain ``fmpq``. Zero is falsy, so the same constructions work for methods with
parameters and with numbers.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager
from math import comb, prod
from typing import Any, TypeAlias, cast

from flint import Ordering, fmpq, fmpq_mpoly, fmpq_mpoly_ctx, fmpz, fmpz_mpoly

from garkcli.deadline import check_time
from garkcli.errors import TooManyTerms
from garkcli.exact.rewriting import name_latex
from garkcli.frozen import Frozen

MAX_TERMS = 500_000
_NAME = r"[A-Za-z_]\w*"
Mixed: TypeAlias = "fmpq | Parametric"


class Rule(Frozen):
    """A power of an unknown and its value, as sqrt(3)² = 3; no unknowns of later rules in it."""

    index: int
    degree: int
    instead: fmpq_mpoly


class Parameters:
    """The ring ℚ[t_1, …, t_k], or a quotient of it by ``rules``.

    ``shown`` has text and LaTeX of unknowns that are not parameters, such as sqrt(3).

    >>> ring = Parameters(["t"])
    >>> t = ring.parameter("t")
    >>> (t * t - 1) / (t - 1) - t
    1
    """

    def __init__(self, names: Sequence[str]) -> None:
        self.names = tuple(names)
        self.context = fmpq_mpoly_ctx.get(self.names, Ordering.lex)
        self.rules: tuple[Rule, ...] = ()
        self.shown: dict[str, tuple[str, str]] = {}
        self._told_apart: dict[str, fmpq_mpoly] | None = None

    def parameter(self, name: str) -> Parametric:
        return Parametric(self, self.context.gen(self.names.index(name)), self.constant(fmpq(1)))

    def text(self, polynomial: fmpq_mpoly | fmpz_mpoly) -> str:
        text = str(polynomial)
        if not self.shown:
            return text
        return re.sub(_NAME, lambda name: self.shown.get(name[0], (name[0], ""))[0], text)

    def latex(self, polynomial: fmpq_mpoly) -> str:
        text = ""
        for exponents, a in polynomial.to_dict().items():
            powers = ""
            for name, exponent in zip(self.names, exponents, strict=True):
                if int(exponent):
                    exponent = int(exponent)
                    letter = name_latex(name)
                    if name in self.shown:
                        _, letter = self.shown[name]
                    factor = letter if exponent == 1 else f"{letter}^{{{exponent}}}"
                    powers += factor
            sign = "-" if a < 0 else "+"
            a = abs(a)
            top = f"{a.p}{powers}"
            if powers and a.p == 1:
                top = powers
            term = top if a.q == 1 else rf"\frac{{{top}}}{{{a.q}}}"
            text += sign + term
        return text.removeprefix("+") or "0"

    def constant(self, number: fmpq) -> fmpq_mpoly:
        return self.context.constant(number)

    def quotient(self, numerator: fmpq_mpoly, denominator: fmpq_mpoly) -> Mixed:
        """The quotient in lowest terms, with a monic denominator; raises NotDecided if the time is
        over.
        """
        check_time()
        if self.rules:
            numerator = self.reduced(numerator)
            denominator = self.reduced(denominator)
        if not denominator.is_one():
            common = numerator.gcd(denominator)
            if not common.is_one():
                numerator, denominator = numerator // common, denominator // common
            leading = denominator.leading_coefficient()
            if leading != 1:
                numerator, denominator = numerator / leading, denominator / leading
        if numerator.is_constant() and denominator.is_one():
            return numerator.leading_coefficient() if numerator else fmpq(0)
        return Parametric(self, numerator, denominator)

    def reduced(self, polynomial: fmpq_mpoly) -> fmpq_mpoly:
        for rule in reversed(self.rules):
            while polynomial.degrees()[rule.index] >= rule.degree:
                parts: dict[int, dict[tuple[int, ...], fmpq]] = {}
                for exponents, a in polynomial.to_dict().items():
                    powers = [int(e) for e in exponents]
                    count, powers[rule.index] = divmod(powers[rule.index], rule.degree)
                    parts.setdefault(count, {})[tuple(powers)] = a
                polynomial = self.constant(fmpq(0))
                for count, terms in parts.items():
                    rest = self.context.from_dict(dict(terms))
                    polynomial += times(rest, power(rule.instead, count))
        return polynomial

    @contextmanager
    def telling_apart(self) -> Iterator[dict[str, fmpq_mpoly]]:
        """Collects the polynomials that are taken to be different from 0.

        Decisions meanwhile hold for all parameters at which none of them vanishes (D. Duval,
        *Algebraic numbers: an example of dynamic evaluation*, J. Symb. Comput. 18, 1994).
        """
        before, self._told_apart = self._told_apart, {}
        try:
            yield self._told_apart
        finally:
            self._told_apart = before

    def tell_apart(self, polynomial: fmpq_mpoly) -> None:
        if self._told_apart is not None and not polynomial.is_constant():
            self._told_apart[str(polynomial)] = polynomial


class Parametric:
    """A rational function in lowest terms; its denominator has leading coefficient 1."""

    __slots__ = ("denominator", "numerator", "ring")

    def __init__(self, ring: Parameters, numerator: fmpq_mpoly, denominator: fmpq_mpoly) -> None:
        self.ring = ring
        self.numerator = numerator
        self.denominator = denominator

    def _parts(self, other: object) -> tuple[fmpq_mpoly, fmpq_mpoly]:
        if not isinstance(other, Parametric):
            return self.ring.constant(fmpq(cast("fmpq", other))), self.ring.constant(fmpq(1))
        if other.ring is not self.ring:
            raise TypeError("functions of different parameters")
        return other.numerator, other.denominator

    def __add__(self, other: object) -> Mixed:
        p, q = self._parts(other)
        if self.denominator == q:
            return self.ring.quotient(self.numerator + p, q)
        total = times(self.numerator, q) + times(p, self.denominator)
        return self.ring.quotient(total, times(self.denominator, q))

    __radd__ = __add__

    def __neg__(self) -> Parametric:
        return Parametric(self.ring, -self.numerator, self.denominator)

    def __sub__(self, other: object) -> Mixed:
        return self + (-cast("fmpq", other))

    def __rsub__(self, other: object) -> Mixed:
        return -self + other

    def __mul__(self, other: object) -> Mixed:
        p, q = self._parts(other)
        return self.ring.quotient(times(self.numerator, p), times(self.denominator, q))

    __rmul__ = __mul__

    def inverse(self) -> Mixed:
        self.ring.tell_apart(self.numerator)
        return self.ring.quotient(self.denominator, self.numerator)

    def __truediv__(self, other: object) -> Mixed:
        p, q = self._parts(other)
        self.ring.tell_apart(p)
        return self.ring.quotient(times(self.numerator, q), times(self.denominator, p))

    def __rtruediv__(self, other: object) -> Mixed:
        return self.inverse() * cast("fmpq", other)

    def __pow__(self, exponent: int) -> Mixed:
        base: Mixed = self if exponent >= 0 else self.inverse()
        result: Mixed = fmpq(1)
        for _ in range(abs(exponent)):
            result = base * result
        return result

    def __bool__(self) -> bool:
        self.ring.tell_apart(self.numerator)
        return True  # zero is a plain number

    def __eq__(self, other: object) -> bool:
        return isinstance(other, (Parametric, fmpq, fmpz, int)) and not self - other

    def __hash__(self) -> int:
        return hash((str(self.numerator), str(self.denominator)))

    def height_bits(self) -> int:
        return max(map(_height_bits, [*self.numerator.coeffs(), *self.denominator.coeffs()]))

    def latex(self) -> str:
        numerator = self.ring.latex(self.numerator)
        if self.denominator.is_one():
            return numerator
        return rf"\frac{{{numerator}}}{{{self.ring.latex(self.denominator)}}}"

    def __repr__(self) -> str:
        numerator = self.ring.text(self.numerator)
        if self.denominator.is_one():
            return numerator
        return f"({numerator})/({self.ring.text(self.denominator)})"


_height_bits: Callable[[fmpq], int] = fmpq.height_bits


def times(p: fmpq_mpoly, q: fmpq_mpoly) -> fmpq_mpoly:
    if q.is_one():  # most denominators
        return p
    refuse_long(p, q)
    return p * q


def refuse_long(p: fmpq_mpoly, q: fmpq_mpoly) -> None:
    """Raises TooManyTerms if a product would fill the memory."""
    if len(p) * len(q) > MAX_TERMS and terms_of_product(p, q) > MAX_TERMS:
        raise _too_many_terms()


def power(p: fmpq_mpoly, exponent: int) -> fmpq_mpoly:
    """A power; raises TooManyTerms if it would fill the memory."""
    if terms_of_power(p, exponent) > MAX_TERMS:
        raise _too_many_terms()
    return p**exponent


def _too_many_terms() -> TooManyTerms:
    message = f"a polynomial of more than {MAX_TERMS} terms in the free parameters"
    return TooManyTerms(message, "give values to some of them: --set NAME=1/2")


def terms_of_product(p: fmpq_mpoly, q: fmpq_mpoly) -> int:
    """An upper bound of the number of terms of a product.

    >>> x, y = Parameters(["x", "y"]).context.gens()
    >>> terms_of_product((1 + x) ** 5, (1 + x) ** 6), len((1 + x) ** 11)
    (12, 12)
    """
    if not p or not q:
        return 0
    degrees = [a + b for a, b in zip(p.degrees(), q.degrees(), strict=True)]
    return min(len(p) * len(q), monomials(degrees, p.total_degree() + q.total_degree()))


def terms_of_sum(p: fmpq_mpoly, q: fmpq_mpoly) -> int:
    if not p or not q:
        return len(p) + len(q)
    degrees = [max(pair) for pair in zip(p.degrees(), q.degrees(), strict=True)]
    return min(len(p) + len(q), monomials(degrees, max(p.total_degree(), q.total_degree())))


def terms_of_power(p: fmpq_mpoly, exponent: int) -> int:
    """An upper bound of the number of terms of a power with an exponent ≥ 0."""
    if not p:
        return 1
    degrees = [exponent * a for a in p.degrees()]
    each = comb(len(p) + exponent - 1, exponent)
    return min(each, monomials(degrees, exponent * p.total_degree()))


def monomials(degrees: Sequence[int], total: int) -> int:
    """An upper bound of the monomials with degrees limited in each variable and in total.

    >>> monomials([1, 1, 0], 2), monomials([9, 9], 2)
    (4, 6)
    """
    used = sum(map(bool, degrees))
    return min(prod(int(a) + 1 for a in degrees), comb(int(total) + used, used))


def factors(polynomials: Iterable[fmpq_mpoly]) -> list[fmpq_mpoly]:
    """The distinct irreducible factors that are not constant, of polynomials ≠ 0."""
    found: dict[str, fmpq_mpoly] = {}
    for p in polynomials:
        for factor, _ in p.factor()[1]:
            found[str(factor)] = factor
    return list(found.values())


def unknowns_of(p: fmpq_mpoly) -> list[int]:
    return [k for k, degree in enumerate(p.degrees()) if degree > 0]  # of 0 they are −1


def evaluated(p: fmpq_mpoly, values: Sequence[Any]) -> Any:
    total: Any = fmpq(0)
    for exponents, a in p.to_dict().items():
        term: Any = a
        for value, exponent in zip(values, exponents, strict=True):
            if exponent:
                term = term * value ** int(exponent)
        total = total + term
    return total


def fraction(number: object, ring: Parameters) -> tuple[fmpq_mpoly, fmpq_mpoly]:
    if isinstance(number, Parametric):
        return number.numerator, number.denominator
    return ring.constant(cast("fmpq", number)), ring.constant(fmpq(1))


def common_denominator(numbers: Iterable[object], ring: Parameters) -> fmpq_mpoly:
    common = ring.constant(fmpq(1))
    for x in numbers:
        _, d = fraction(x, ring)
        common = common * d // common.gcd(d)
    return common
