"""Coefficients with free parameters: rational functions, with unknowns for radicals."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from itertools import chain
from math import prod
from typing import Any, cast

from flint import fmpq, fmpq_mpoly, fmpz_poly

from garkcli.errors import ExpressionError, LimitExceeded
from garkcli.exact import parametric
from garkcli.exact.domain import Domain, perfect_root
from garkcli.exact.field import Number
from garkcli.exact.nodes import AlgebraicRoot, Expression, Name, Root
from garkcli.exact.rewriting import format_expression, names_in, roots_in
from garkcli.exact.roots import RealRoot
from garkcli.frozen import replace
from garkcli.methodfile.numbers import Coefficient, Free, Numbers
from garkcli.methodfile.values import Values
from garkcli.tableau.family import Radical, reducing
from garkcli.tableau.tableau import Method, Tableau

MAX_DEGREE = 200
MAX_TERMS = 2_000
MAX_TERMS_TOGETHER = 200_000
ROOT = "_root"


class FamilyValues(Values):
    """Values in which each radical is an unknown with a relation; ``change`` comes first."""

    def __init__(
        self, numbers: Numbers, change: Callable[[Expression], Expression] | None = None
    ) -> None:
        self.numbers = numbers
        self.printed = ()
        self._values: dict[int, Number] = {}
        expressions = [entry.expression for entry in numbers.entries]
        names = dict.fromkeys(numbers.free)
        if change is not None:
            expressions = [change(x) for x in expressions]
            names |= dict.fromkeys(x.name for y in expressions for x in names_in(y))
        self.domain = _FamilyDomain(list(names), expressions, change)
        self._evaluate(numbers, self.domain)

    def alone(self, method: Method) -> Tableau:
        """The tableau with reduced roots, so that zeros are recognised."""
        tableau = super().alone(method)
        if not self.domain.radicals:
            return tableau
        from garkcli.design.member import member  # few files have such roots

        ring = reducing(self.domain.ring.names, self.domain.radicals)
        values: Any = {name: ring.parameter(name) for name in ring.names}
        return member(tableau, ring, values)

    def ends(self, free: Free) -> tuple[fmpq | None, fmpq | None]:
        """Rational numbers around all ranges; other ends and void ranges are faults."""
        least = greatest = None
        for ends in free.ranges:
            smallest, largest = map(self._end, ends)
            if smallest is None or largest is None:
                continue
            if smallest > largest:
                message = f"{ends[1].where}: no number is in [{smallest}, {largest}]"
                cure = f"write the smaller end first: [{largest}, {smallest}]"
                self.numbers.source.fault(ends[1].node, message, cure, code="wrong-value")
                continue
            before = f"[{least}, {greatest}]"
            least = smallest if least is None else max(least, smallest)
            greatest = largest if greatest is None else min(greatest, largest)
            if least > greatest:
                message = (
                    f"{ends[1].where}: no number is in [{smallest}, {largest}] and in {before}"
                )
                cure = "change one of the two ranges of the parameter"
                self.numbers.source.fault(ends[1].node, message, cure, code="wrong-value")
                return None, None
        return least, greatest

    def _end(self, entry: Coefficient) -> fmpq | None:
        value = self._plain(entry.expression)
        if value is None:
            message = f"{entry.where}: a rational number is expected"
            self.numbers.source.fault(entry.node, message, "write [1/4, 1]", code="wrong-value")
        return value

    def _plain(self, expression: Expression) -> fmpq | None:
        if any(roots_in(expression)):
            return None
        try:
            value = self.domain.evaluate(expression)
        except ExpressionError:
            return None
        return value if isinstance(value, fmpq) else None


class _FamilyDomain(Domain):
    def __init__(
        self,
        names: list[str],
        expressions: list[Expression],
        change: Callable[[Expression], Expression] | None = None,
    ) -> None:
        self._change = change
        roots = dict.fromkeys(chain.from_iterable(map(roots_in, expressions)))
        self._names = {root: f"{ROOT}{i}" for i, root in enumerate(roots, start=1)}
        self.ring = parametric.Parameters([*names, *self._names.values()])
        self.radicals: list[Radical] = []
        self.divisors: list[fmpq_mpoly] = []
        self._values = {}
        self._are_real = True
        self._size = self._terms = 0
        self.field = None
        for root in roots:  # the inner ones first
            self._values[root] = self._root(root)

    def _root(self, root: Root | AlgebraicRoot) -> Number:
        if isinstance(root, AlgebraicRoot):
            return self._root_of_polynomial(root)
        radicand = self.evaluate(root.radicand)
        if isinstance(radicand, fmpq):
            rational = perfect_root(root, radicand)
            if rational is not None:
                return rational
        name = self._names[root]
        unknown = self.ring.parameter(name)
        # θ^n = r; of an even root the positive θ is meant
        difference = unknown**root.index - cast("Any", radicand)
        relation = cast("parametric.Parametric", difference).numerator
        is_even = root.index % 2 == 0
        self._add(root, Radical(name, relation, is_even))
        return cast("Number", unknown)

    def _add(self, root: Root | AlgebraicRoot, radical: Radical) -> None:
        text, latex = format_expression(root), format_expression(root, latex=True)
        self.radicals.append(replace(radical, text=text, latex=latex))

    def _root_of_polynomial(self, root: AlgebraicRoot) -> Number:
        name = self._names[root]
        unknown = self.ring.parameter(name).numerator
        relation = self.ring.constant(fmpq(0))
        for coefficient in reversed(root.coefficients):
            relation = relation * unknown + coefficient
        meant = RealRoot(fmpz_poly(list(root.coefficients)), root.number)
        self._add(root, Radical(name, relation, meant=meant))
        return cast("Number", self.ring.parameter(name))

    def coefficient(self, expression: Expression) -> Number:
        changed = expression if self._change is None else self._change(expression)
        value = super().coefficient(changed)
        parts = parametric.fraction(value, self.ring)
        self._limit(max(map(self._terms_of, parts)), 0, expression)
        self._terms += sum(map(len, parts))
        if self._terms > MAX_TERMS_TOGETHER:
            message = f"the coefficients have more than {MAX_TERMS_TOGETHER} terms together"
            cure = "give values to some of the free parameters: --set NAME=1/2"
            raise LimitExceeded(message, cure, expression.start, expression.end)
        return value

    def evaluate(self, expression: Expression) -> Number:
        if isinstance(expression, Name) and expression.name in self.ring.names:
            return cast("Number", self.ring.parameter(expression.name))
        return super().evaluate(expression)

    def _apply(self, sign: str, left: Number, right: Number, at: Expression) -> Number:
        p, q = parametric.fraction(left, self.ring)
        u, v = parametric.fraction(right, self.ring)
        if sign == "/":
            self._note_divisor(right)
            u, v = v, u
        if sign in "*/":
            lengths = [parametric.terms_of_product(p, u), parametric.terms_of_product(q, v)]
        elif q == v:
            lengths = [parametric.terms_of_sum(p, u)]
        else:
            lengths = [
                parametric.terms_of_product(p, v) + parametric.terms_of_product(u, q),
                parametric.terms_of_product(q, v),
            ]
        degree = sum(max(0, x.total_degree()) for x in (p, q, u, v))
        self._limit(max(lengths), 0 if sign in "+-" and q == v else degree, at)
        return super()._apply(sign, left, right, at)

    def _terms_of(self, polynomial: fmpq_mpoly) -> int:
        """A bound on the number of terms once powers of radicals are written out."""
        if not self.radicals:
            return len(polynomial)

        def written_out(radical: Radical, exponents: Sequence[int]) -> int:
            place = self.ring.names.index(radical.name)
            index = radical.relation.degrees()[place]
            return parametric.terms_of_power(radical.relation, exponents[place] // index)

        every = polynomial.monoms()
        return sum(prod(written_out(x, exponents) for x in self.radicals) for exponents in every)

    def _limit(self, terms: int, degree: int, at: Expression) -> None:
        """Raises LimitExceeded before the multiplication."""
        if degree > MAX_DEGREE:
            message = f"a degree of more than {MAX_DEGREE} in the parameters"
            raise LimitExceeded(message, "write it smaller", at.start, at.end)
        if terms > MAX_TERMS:
            message = f"more than {MAX_TERMS} terms in the parameters, multiplied out"
            cure = "give values to some of them: --set NAME=1/2"
            raise LimitExceeded(message, cure, at.start, at.end)

    def _note_divisor(self, number: Number) -> None:
        p, _ = parametric.fraction(number, self.ring)
        if not p.is_constant():
            self.divisors.append(p)

    def _power(self, number: Number, exponent: int, at: Expression) -> Number:
        if exponent < 0:
            self._note_divisor(number)
        numerator, denominator = parametric.fraction(number, self.ring)
        degree = abs(exponent) * (max(0, numerator.total_degree()) + denominator.total_degree())
        terms = [parametric.terms_of_power(p, abs(exponent)) for p in (numerator, denominator)]
        self._limit(max(terms), degree, at)
        return super()._power(number, exponent, at)
