"""Formulas in a problem file: expressions with known names, and their values."""

from __future__ import annotations

from collections.abc import Container, Iterable, Mapping, Sequence
from typing import Any

from flint import arb, ctx, fmpq

from garkcli.errors import ExpressionError, did_you_mean, nearest
from garkcli.exact.display import LOG10_2
from garkcli.exact.enclosing import midpoint
from garkcli.exact.formula import CONSTANTS, RESERVED, Value, parse_formula, value_of
from garkcli.exact.nodes import Expression, Literal
from garkcli.exact.rewriting import check_size, names_in, size_of
from garkcli.frozen import Frozen, Mutable, field
from garkcli.grammar.nodes import Node, is_null, shortened, unquoted
from garkcli.grammar.source import Entries, Source
from garkcli.grammar.spellings import explained, number_text
from garkcli.problems.expr import Expr, Invariants, Place, Vector, rational
from garkcli.problems.files.keys import ProblemText
from garkcli.problems.translate import MAX_SIZE, Translator, size_of_derivatives

BITS = 320
PLACES = 60
"""Decimals of an irrational initial value."""


class FormulaReader(Mutable):
    """Reads the formulas of a file; ``given`` has values for parameters in place of those there."""

    source: Source
    given: Mapping[str, fmpq] = field(default_factory=dict)
    values: dict[str, Value] = field(default_factory=dict)
    made: dict[str, Any] = field(default_factory=dict)
    _sizes: dict[str, int] = field(default_factory=dict)

    def parsed(
        self, node: Node, where: str, names: Mapping[str, str] | None, noun: str = "parameter"
    ) -> Expression | None:
        """Returns the expression, or None after a fault.

        ``names`` maps allowed names to "" and others to a cure; None allows all names. Parameters
        are always allowed; ``noun`` is the kind of name that is expected.
        """
        if is_null(node):
            message = f"{where}: nothing is here"
            self.source.fault(node, message, "write a formula", code="empty")
            return None
        text = number_text(self.source, node, where)
        if text is None:
            return None
        try:
            expression = parse_formula(text)
            check_size(size_of(expression, self._sizes), text)
        except ExpressionError as error:
            self.source.expression_fault(node, where, *explained(error, text))
            return None
        if names is None:
            return expression
        # each name without a meaning is noted at its first place
        allowed = {*self.values, *CONSTANTS, *(name for name, cure in names.items() if not cure)}
        unknown = [x for x in names_in(expression) if x.name not in allowed]
        strangers = {x.name: x for x in reversed(unknown)}
        for name, place in strangers.items():
            message = f"{where}: {shortened(name)} is not a {noun}"
            cure = names.get(name) or did_you_mean(name, sorted(allowed))
            meant = "" if names.get(name) else nearest(name, sorted(allowed))
            self.source.fault(node, message, cure, place.start, code="wrong-value", meant=meant)
        return None if strangers else expression

    def constant(self, node: Node, where: str) -> tuple[Expression, Value] | None:
        expression = self.parsed(node, where, {})
        if expression is None:
            return None
        value = self.value(expression, node, where, {})
        return None if value is None else (expression, value)

    def value(
        self, expression: Expression, node: Node, where: str, names: Mapping[str, Value]
    ) -> Value | None:
        try:
            with ctx.workprec(BITS):
                return value_of(expression, {**self.values, **names})
        except ExpressionError as error:
            self.source.expression_fault(node, where, error)
            return None

    def rational(self, node: Node, where: str) -> fmpq | None:
        """Returns a number, exact if rational and to ``PLACES`` decimals otherwise."""
        constant = self.constant(node, where)
        return None if constant is None else nearby(constant[1])

    def translator(self, symbols: Mapping[str, Any]) -> Translator:
        return Translator({**self.made, **symbols}, self.values)

    def read_parameters(self, node: Node | None) -> None:
        entries = {} if node is None else self.source.mapping(node, "parameters", ())
        for name, value_node in entries.items():
            where = f"parameters: {unquoted(name)}"
            message = bad_name(name)
            if message:
                cure = "choose another name"
                self.source.fault(value_node, f"{where} {message}", cure, code="name-taken")
            constant = self.constant(value_node, where)
            if name in self.given:
                constant = (Literal(self.given[name]), self.given[name])
            # a faulty parameter is 1, so that formulas with it are still read
            expression, value = constant or (Literal(fmpq(1)), fmpq(1))
            self.made[name] = (
                rational(value)
                if isinstance(value, fmpq)
                else self.translator({}).translate(expression)
            )
            self.values[name] = value
            self._sizes[name] = size_of(expression, self._sizes)


def bad_name(name: str) -> str:
    """Returns why a text cannot be the name of a variable or parameter; empty if it can."""
    if name in RESERVED:
        return "has a meaning already"
    if not (name.isidentifier() and name.isascii()):
        return "is not a name: names have letters, digits and _"
    return "is longer than 30 characters" if len(name) > 30 else ""


def nearby(value: Value) -> fmpq:
    """Returns the simplest fraction within 10^(−``PLACES``) of a number."""
    if isinstance(value, fmpq):
        return value
    middle, reach = midpoint(value), fmpq(1, 10**PLACES)
    return _simplest(middle - reach, middle + reach)


def _simplest(low: fmpq, high: fmpq) -> fmpq:
    """Returns the fraction with the smallest denominator in an interval, by continued fractions."""
    if low <= 0 <= high:
        return fmpq(0)
    if high < 0:
        return -_simplest(-high, -low)
    floor = low.floor()
    if fmpq(floor) == low:
        return low
    if floor + 1 <= high:
        return fmpq(floor + 1)
    # both ends have the same whole part: the rest is the inverse of a number above 1
    inverse = _simplest(1 / (high - floor), 1 / (low - floor))
    return floor + 1 / inverse


_SHOWN = 8  # most missing names that are reported
MAX_BITS = 4_000
"""The cube of a longest numerator stays below the 4300 digits that Python prints."""


class FormulaTerm(Frozen):
    node: Node
    where: str
    expression: Expression
    made: Expr


class Maker:
    """Makes the problem of a file; faults go to its source."""

    def __init__(self, formulas: FormulaReader, text: ProblemText, symbols: Iterable[Any]) -> None:
        self.source = formulas.source
        self.formulas = formulas
        self.text = text
        self.symbols: Mapping[str, Expr] = {str(x): x for x in symbols}

    def terms(
        self, items: Iterable[tuple[Node, str]], names: Mapping[str, str], noun: str
    ) -> list[FormulaTerm]:
        """Returns the formulas without faults; none if the variables have faults."""
        known = names if self.text.are_named else None
        allowed = [name for name, cure in (known or {}).items() if not cure]
        translator = self.formulas.translator({name: self.symbols[name] for name in allowed})
        terms = []
        for node, where in items:
            expression = self.formulas.parsed(node, where, known, noun)
            if expression is None or known is None:
                continue
            try:
                made = translator.translate(expression)
            except ExpressionError as error:
                self.source.expression_fault(node, where, error)
            else:
                terms.append(FormulaTerm(node, where, expression, made))
        return terms

    def invariants(self, names: Mapping[str, str], noun: str) -> list[FormulaTerm]:
        items = ((node, f"invariants: {name}") for name, node in self.text.invariants)
        return self.terms(items, names, noun)

    def check_values(self, terms: Sequence[FormulaTerm], start: Mapping[str, fmpq]) -> None:
        with ctx.workprec(BITS):
            values = {name: arb(x) for name, x in start.items()}
        for term in terms:
            if all(str(x) in start for x in term.made.free_symbols):
                where = f"{term.where} at the initial values"
                self.formulas.value(term.expression, term.node, where, values)

    def numbers(
        self, node: Node, where: str, names: Sequence[str]
    ) -> tuple[Entries, dict[str, fmpq]]:
        entries = self.source.mapping(node, where, names)
        values: dict[str, fmpq] = {}
        for name, x in entries.items():
            value = self.formulas.rational(x, f"{where}: {unquoted(name)}")
            if value is not None:
                values[name] = value
        return entries, values

    def refuse_missing(
        self, node: Node, where: str, needed: Iterable[object], given: Container[str], example: str
    ) -> None:
        """Reports names without a value; ``example`` has ``{}`` for a name."""
        missing = [name for name in map(str, needed) if name not in given]
        if missing:
            more = ", …" if len(missing) > _SHOWN else ""
            message = f"{where}: no value for {', '.join(missing[:_SHOWN])}{more}"
            self.source.fault(
                node, message, f"give each {example.format(missing[0])}", code="missing-key"
            )

    def refuse_constants(self, invariants: Sequence[FormulaTerm], noun: str) -> None:
        from garkcli.problems.vectorfield import is_constant

        for invariant in invariants:
            if is_constant(invariant.made):
                message = f"{invariant.where} is constant: it depends on no variable"
                cure = f"write a first integral in {noun}, or leave it out"
                self.source.fault(invariant.node, message, cure, code="nothing-moves")

    def check_derivatives(
        self, terms: Sequence[FormulaTerm], y: Vector, start: Mapping[str, fmpq], more: Place
    ) -> None:
        """Reports terms without a derivative at the start; ``more`` has values of further names."""
        from garkcli.problems.lagrangian import missing_derivative

        with ctx.workprec(BITS):
            at = {**{x: arb(start[str(x)]) for x in y}, **more}
        for term in terms:
            missing = missing_derivative(term.made, y, at)
            if missing is not None:
                what, cure = missing
                message = f"{term.where} at the initial values: {what}"
                self.source.fault(term.node, message, cure, code="no-formula")

    def check_size(self, terms: Sequence[FormulaTerm]) -> None:
        sizes = [size_of_derivatives(x.made) for x in terms]
        if sum(sizes) > MAX_SIZE:
            largest = terms[sizes.index(max(sizes))]
            operations = f"second derivatives of {sum(sizes)} operations"
            message = f"{largest.where}: {operations} (limit {MAX_SIZE})"
            cure = "write it shorter, or with fewer variables"
            self.source.fault(largest.node, message, cure, code="too-many")

    def check_numbers(self, terms: Sequence[FormulaTerm]) -> None:
        """Reports terms with numbers that are too long once powers are multiplied out."""
        import sympy

        for term in terms:
            rationals = term.made.atoms(sympy.Rational)
            parts = [int(part).bit_length() for x in rationals for part in (x.p, x.q)]
            longest = max(parts, default=0)
            if longest > MAX_BITS:
                digits = int(longest * LOG10_2)
                message = f"{term.where}: a coefficient of about {digits} digits"
                cure = "choose units in which coefficients are shorter"
                self.source.fault(term.node, message, cure, code="number-too-large")


def named(invariants: Sequence[FormulaTerm]) -> Invariants:
    return tuple((x.where.removeprefix("invariants: "), x.made) for x in invariants)
