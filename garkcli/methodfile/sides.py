"""From the text of a problem file with ``rhs`` to right-hand sides: known names, values at the
start, derivatives, and whether an exact solution is one.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import chain
from typing import TYPE_CHECKING, TypeAlias

from flint import arb, fmpq

from garkcli.methodfile.formulas import (
    Formulas,
    Term,
    TermReader,
    formulas_of_invariants,
    named,
    nearby,
)
from garkcli.methodfile.problem_keys import STIFFNESS, ProblemText, Side
from garkcli.methodfile.source import Source
from garkcli.problems.vectorfield import TIME

if TYPE_CHECKING:
    from garkcli.problems.righthandside import RightHandSide

# parts of the time, where a solution is tried
_TRIES = fmpq(1, 3), fmpq(2, 3), fmpq(1)
ByName: TypeAlias = dict[str, Term]
"""Formulas by the variables that they are of."""
Start: TypeAlias = dict[str, fmpq]
"""Initial values by the variables."""


class SidesMaker:
    """Makes the problem of one file; faults are noted in its source."""

    def __init__(self, source: Source, formulas: Formulas, text: ProblemText) -> None:
        from garkcli.problems.vectorfield import symbols

        self.source, self.formulas, self.text = source, formulas, text
        self.reader = TermReader(source, formulas)
        self.y = symbols(text.variables, "y")
        (self.t,) = symbols(text.variables, TIME)
        self._symbols = {str(x): x for x in (*self.y, self.t)}

    def problem(self) -> RightHandSide:
        """The problem.

        Raises:
            MethodFileError: there are faults; all that could be found.
        """
        from garkcli.problems.righthandside import RightHandSide

        exact = self._exact()
        start = self._initial(exact)
        names = dict.fromkeys(self._symbols, "")
        noun = "variable or parameter, nor t"
        terms = [self._by_name(side, names, noun) for side in self.text.sides]
        invariants = self._invariants()
        all_terms = list(chain(*(term.values() for term in terms)))
        if start is not None:
            self.reader.check_values([*all_terms, *invariants], {**start, TIME: fmpq(0)})
        self.reader.check_size(all_terms)
        solution = [] if exact is None else list(exact.values())
        self.reader.check_numbers([*all_terms, *invariants, *solution])
        self.source.close()
        assert start is not None
        # Newton's method needs derivatives
        self.reader.check_derivatives(all_terms, self.y, start, {self.t: arb(0)})
        self._refuse_constants(all_terms, terms, invariants)
        self.source.close()
        stiffness = self.formulas.values.get(STIFFNESS)
        made = RightHandSide(
            self.text.name,
            self.text.variables,
            tuple(self._components(term) for term in terms),
            tuple(start[name] for name in self.text.variables),
            self.text.t_end,
            named(invariants),
            None if exact is None else self._components(exact),
            stiffness=stiffness if isinstance(stiffness, fmpq) else None,
        )
        if exact is not None:
            self._check_solution(made, exact)
            self.source.close()
        return made

    def _components(self, term: ByName) -> tuple[object, ...]:
        """D expressions: 0 for what is left out."""
        import sympy

        zero = sympy.Integer(0)
        return tuple(term[x].made if x in term else zero for x in self.text.variables)

    def _by_name(self, items: Side, names: dict[str, str], noun: str) -> ByName:
        known = names if self.text.are_named else None
        return {
            name: term
            for name, node, where in items
            for term in self.reader.terms([(node, where)], self._symbols, known, noun)
        }

    def _invariants(self) -> list[Term]:
        names = dict.fromkeys(map(str, self.y), "")
        names[TIME] = "an invariant depends on the variables alone"
        known = names if self.text.are_named else None
        items, noun = formulas_of_invariants(self.text), "variable or parameter"
        return self.reader.terms(items, self._symbols, known, noun)

    def _exact(self) -> ByName | None:
        """The exact solution by names; None where there is none, or it has faults."""
        node = self.text.exact
        if node is None:
            return None
        before = len(self.source.faults)
        variables = self.text.variables if self.text.are_named else ()
        entries = self.source.mapping(node, "exact", variables)
        items = tuple((name, formula, f"exact: {name}") for name, formula in entries.items())
        names = dict.fromkeys(map(str, self.y), "the solution is a formula in t") | {TIME: ""}
        found = self._by_name(items, names, "parameter, nor t")
        if self.text.are_named:
            cure = f"a formula, such as {{}}: cos({TIME})"
            self.reader.refuse_missing(node, "exact", variables, entries, cure)
        return found if len(self.source.faults) == before else None

    def _initial(self, exact: ByName | None) -> Start | None:
        """The initial values by name; None where they are not complete."""
        started = None if exact is None else self._start_of(exact)
        node = self.text.initial
        if node is None:
            return started
        before = len(self.source.faults)
        variables = self.text.variables if self.text.are_named else ()
        entries, values = self.reader.numbers(node, "initial", variables)
        if self.text.are_named and len(self.source.faults) == before:
            cure = "a number, such as {}: 1/2"
            self.reader.refuse_missing(node, "initial", variables, entries, cure)
        if len(self.source.faults) > before or not self.text.are_named:
            return None
        if exact is not None and started is not None:
            self._refuse_other_start(exact, started, values)
        return values

    def _refuse_other_start(self, exact: ByName, started: Start, values: Start) -> None:
        """Note where the exact solution does not begin at the initial values."""
        for name, term in exact.items():
            own, given = started[name], values[name]
            if own != given:
                message = f"{term.where} starts at {_decimal(own)}, "
                message += f"but initial has {_decimal(given)}"
                cure = "leave initial out, or correct one of them"
                self.source.fault(term.node, message, cure, code="no-solution")

    def _start_of(self, exact: ByName) -> Start | None:
        """The exact solution at t = 0; None where it has no value there, which is noted."""
        found = {}
        for name, term in exact.items():
            where = f"{term.where} at t = 0"
            value = self.formulas.value(term.expression, term.node, where, {TIME: fmpq(0)})
            if value is not None:
                found[name] = nearby(value)
        return found if len(found) == len(exact) else None

    def _refuse_constants(
        self, all_terms: Sequence[Term], terms: Sequence[ByName], invariants: Sequence[Term]
    ) -> None:
        """Note right-hand sides with which nothing moves, and invariants that depend on nothing."""
        parts = ([x[name].made for x in terms if name in x] for name in self.text.variables)
        if not any(sum(made) != 0 for made in parts):
            message = "nothing moves: the right-hand sides sum to 0"
            cure = "write the derivative of a variable"
            self.source.fault(all_terms[0].node, message, cure, code="nothing-moves")
        self.reader.refuse_constants(invariants, "the variables")

    def _check_solution(self, problem: RightHandSide, exact: ByName) -> None:
        """Note a solution whose derivative differs from the right-hand sides at a later time, with
        balls that prove it.
        """
        from garkcli.problems.mass import enclosed

        places = dict(zip(self.y, problem.exact or (), strict=True))
        totals = dict(zip(problem.variables, problem.total, strict=True))
        for part in _TRIES:
            time = part * problem.t_end
            at = {self.t: arb(time)}
            for name, total in totals.items():
                term = exact[name]
                has, needs = enclosed([term.made.diff(self.t), total.xreplace(places)], at)
                if not (has.is_finite() and needs.is_finite()):
                    message = f"{term.where} has no value at t = {time}"
                    cure = "give an earlier t_end"
                    self.source.fault(term.node, message, cure, code="no-formula")
                    return
                if not has.overlaps(needs):
                    message = f"{term.where} is no solution: at t = {time} its derivative is "
                    message += f"{_decimal(has)}, the right-hand sides give {_decimal(needs)}"
                    cure = "correct it, or leave exact out"
                    self.source.fault(term.node, message, cure, code="no-solution")
                    return


def _decimal(x: fmpq | arb) -> str:
    """A few digits of a number."""
    return str(arb(x).str(6, radius=False))
