"""Formulas of a problem as sympy expressions, and what is refused of them, whatever they are of."""

from __future__ import annotations

from collections.abc import Container, Iterable, Mapping, Sequence
from dataclasses import dataclass

from flint import arb, ctx, fmpq
from yaml.nodes import Node

from garkcli.errors import ExpressionError
from garkcli.exact.nodes import Expression
from garkcli.methodfile.formulas import BITS, Formulas
from garkcli.methodfile.nodes import unquoted
from garkcli.methodfile.problem_keys import ProblemText
from garkcli.methodfile.source import Entries, Source
from garkcli.problems.expr import Expr, Invariants, Place, Vector
from garkcli.transfer import LOG10_2

_SHOWN = 8  # most missing names that are told
MAX_BITS = 4_000
"""Longest numerator or denominator: squared and cubed it is short of the 4300 digits that Python
writes.
"""


@dataclass(frozen=True)
class Term:
    """A formula of the file, and its sympy expression."""

    node: Node
    where: str
    expression: Expression
    made: Expr


@dataclass(frozen=True)
class TermReader:
    """Reads formulas with variables; faults are noted in the source."""

    source: Source
    formulas: Formulas

    def terms(
        self,
        items: Sequence[tuple[Node, str]],
        symbols: Mapping[str, Expr],
        names: Mapping[str, str] | None,
        noun: str,
    ) -> list[Term]:
        """The formulas without faults.

        Args:
            items: each formula with what it is called in messages.
            symbols: of all names.
            names: for names that may not stand here, the cure; "" for those that may. None where
                the variables have faults: then nothing is translated.
            noun: what a name can be here.
        """
        allowed: dict[str, Expr] = {}
        for name, cure in (names or {}).items():
            if not cure:
                allowed[name] = symbols[name]
        translator = self.formulas.translator(allowed)
        found = []
        for node, where in items:
            expression = self.formulas.parsed(node, where, names, noun)
            if expression is None or names is None:
                continue
            try:
                made = translator.translate(expression)
            except ExpressionError as error:
                self.source.expression_fault(node, where, error)
            else:
                found.append(Term(node, where, expression, made))
        return found

    def check_values(self, terms: Sequence[Term], start: Mapping[str, fmpq]) -> None:
        """Note formulas that have no value at the start, as far as that is known."""
        with ctx.workprec(BITS):
            values = {name: arb(x) for name, x in start.items()}
        for term in terms:
            if all(str(x) in start for x in term.made.free_symbols):
                where = f"{term.where} at the initial values"
                self.formulas.value(term.expression, term.node, where, values)

    def numbers(
        self, node: Node, where: str, names: Sequence[str]
    ) -> tuple[Entries, dict[str, fmpq]]:
        """Values by names: what is given, and the numbers; of no names given all may stand here."""
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
        """Note names without a value; ``example`` is one, with ``{}`` for a name."""
        missing = [name for name in map(str, needed) if name not in given]
        if missing:
            more = ", …" if len(missing) > _SHOWN else ""
            message = f"{where}: no value for {', '.join(missing[:_SHOWN])}{more}"
            self.source.fault(
                node, message, f"give each {example.format(missing[0])}", code="missing-key"
            )

    def refuse_constants(self, invariants: Sequence[Term], noun: str) -> None:
        """Note first integrals that are none: they are constant for every motion."""
        from garkcli.problems.vectorfield import is_constant

        for invariant in invariants:
            if is_constant(invariant.made):
                message = f"{invariant.where} is constant: it depends on no variable"
                cure = f"write a first integral in {noun}, or leave it out"
                self.source.fault(invariant.node, message, cure, code="nothing-moves")

    def check_derivatives(
        self, terms: Sequence[Term], y: Vector, start: Mapping[str, fmpq], more: Place
    ) -> None:
        """Note terms that have no derivative at the start, where more names may have values."""
        from garkcli.problems.lagrangian import missing_derivative

        with ctx.workprec(BITS):
            at = {**{x: arb(start[str(x)]) for x in y}, **more}
        for term in terms:
            missing = missing_derivative(term.made, y, at)
            if missing is not None:
                what, cure = missing
                message = f"{term.where} at the initial values: {what}"
                self.source.fault(term.node, message, cure, code="no-formula")

    def check_size(self, terms: Sequence[Term]) -> None:
        """Note terms whose derivatives are too long."""
        from garkcli.problems.translate import MAX_SIZE, size_of_derivatives

        sizes = [size_of_derivatives(x.made) for x in terms]
        if sum(sizes) > MAX_SIZE:
            largest = terms[sizes.index(max(sizes))]
            found = f"second derivatives of {sum(sizes)} operations"
            message = f"{largest.where}: {found} (limit {MAX_SIZE})"
            cure = "write it shorter, or with fewer variables"
            self.source.fault(largest.node, message, cure, code="too-many")

    def check_numbers(self, terms: Sequence[Term]) -> None:
        """Note terms with numbers too long to be written, once powers are multiplied out."""
        import sympy

        for term in terms:
            longest = 0
            for x in term.made.atoms(sympy.Rational):
                largest = max(abs(int(x.p)), int(x.q))
                longest = max(longest, largest.bit_length())
            if longest > MAX_BITS:
                digits = int(longest * LOG10_2)
                found = f"a coefficient of about {digits} digits"
                message = f"{term.where}: {found}"
                cure = "choose units in which coefficients are shorter"
                self.source.fault(term.node, message, cure, code="number-too-large")


def formulas_of_invariants(text: ProblemText) -> list[tuple[Node, str]]:
    """The formulas of first integrals, each with what it is called in messages."""
    return [(node, f"invariants: {name}") for name, node in text.invariants]


def named(invariants: Sequence[Term]) -> Invariants:
    """First integrals with the names that the file has for them."""
    found: list[tuple[str, Expr]] = []
    for term in invariants:
        name = term.where.removeprefix("invariants: ")
        found.append((name, term.made))
    return tuple(found)
