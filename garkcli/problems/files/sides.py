"""Right-hand sides from the text of a problem file, checked, with exact solutions."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import chain
from typing import TYPE_CHECKING, TypeAlias

from flint import arb, fmpq

from garkcli.problems.files.formulas import FormulaReader, FormulaTerm, Maker, named, nearby
from garkcli.problems.files.keys import STIFFNESS, ProblemText, Side
from garkcli.problems.vectorfield import TIME, symbols

if TYPE_CHECKING:
    from garkcli.problems.righthandside import RightHandSide

# parts of the time, where a solution is tried
_TRIES = fmpq(1, 3), fmpq(2, 3), fmpq(1)
ByName: TypeAlias = dict[str, FormulaTerm]
"""Formulas by the variables whose derivatives they are."""
Start: TypeAlias = dict[str, fmpq]


class SidesMaker(Maker):
    def __init__(self, formulas: FormulaReader, text: ProblemText) -> None:
        self.y = symbols(text.variables, "y")
        (self.t,) = symbols(text.variables, TIME)
        self.variables = text.variables if text.are_named else ()
        """The names that values and formulas may have; empty after a fault."""
        super().__init__(formulas, text, (*self.y, self.t))

    def problem(self) -> RightHandSide:
        """Raises MethodFileError with all faults."""
        from garkcli.problems.righthandside import RightHandSide

        exact = self._exact()
        start = self._initial(exact)
        names = dict.fromkeys(self.symbols, "")
        noun = "variable or parameter, nor t"
        terms = [self._by_name(side, names, noun) for side in self.text.sides]
        names = names | {TIME: "an invariant depends on the variables alone"}
        invariants = self.invariants(names, "variable or parameter")
        all_terms = list(chain(*(term.values() for term in terms)))
        if start is not None:
            self.check_values([*all_terms, *invariants], {**start, TIME: fmpq(0)})
        self.check_size(all_terms)
        solution = [] if exact is None else list(exact.values())
        self.check_numbers([*all_terms, *invariants, *solution])
        self.source.close()
        assert start is not None
        # Newton's method needs derivatives
        self.check_derivatives(all_terms, self.y, start, {self.t: arb(0)})
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
        import sympy

        zero = sympy.Integer(0)
        return tuple(term[x].made if x in term else zero for x in self.text.variables)

    def _by_name(self, items: Side, names: dict[str, str], noun: str) -> ByName:
        return {
            name: term
            for name, node, where in items
            for term in self.terms([(node, where)], names, noun)
        }

    def _exact(self) -> ByName | None:
        node = self.text.exact
        if node is None:
            return None
        before = len(self.source.faults)
        entries = self.source.mapping(node, "exact", self.variables)
        items = tuple((name, formula, f"exact: {name}") for name, formula in entries.items())
        names = dict.fromkeys(map(str, self.y), "the solution is a formula in t") | {TIME: ""}
        solution = self._by_name(items, names, "parameter, nor t")
        cure = f"a formula, such as {{}}: cos({TIME})"
        self.refuse_missing(node, "exact", self.variables, entries, cure)
        return solution if len(self.source.faults) == before else None

    def _initial(self, exact: ByName | None) -> Start | None:
        started = None if exact is None else self._start_of(exact)
        node = self.text.initial
        if node is None:
            return started
        before = len(self.source.faults)
        entries, values = self.numbers(node, "initial", self.variables)
        if len(self.source.faults) == before:
            cure = "a number, such as {}: 1/2"
            self.refuse_missing(node, "initial", self.variables, entries, cure)
        if len(self.source.faults) > before or not self.text.are_named:
            return None
        if exact is not None and started is not None:
            self._refuse_other_start(exact, started, values)
        return values

    def _refuse_other_start(self, exact: ByName, started: Start, values: Start) -> None:
        for name, term in exact.items():
            own, given = started[name], values[name]
            if own != given:
                message = f"{term.where} starts at {_decimal(own)}, "
                message += f"but initial has {_decimal(given)}"
                cure = "leave initial out, or correct one of them"
                self.source.fault(term.node, message, cure, code="no-solution")

    def _start_of(self, exact: ByName) -> Start | None:
        start = {}
        for name, term in exact.items():
            where = f"{term.where} at t = 0"
            value = self.formulas.value(term.expression, term.node, where, {TIME: fmpq(0)})
            if value is not None:
                start[name] = nearby(value)
        return start if len(start) == len(exact) else None

    def _refuse_constants(
        self,
        all_terms: Sequence[FormulaTerm],
        terms: Sequence[ByName],
        invariants: Sequence[FormulaTerm],
    ) -> None:
        parts = ([x[name].made for x in terms if name in x] for name in self.text.variables)
        if not any(sum(made) != 0 for made in parts):
            message = "nothing moves: the right-hand sides sum to 0"
            cure = "write the derivative of a variable"
            self.source.fault(all_terms[0].node, message, cure, code="nothing-moves")
        self.refuse_constants(invariants, "the variables")

    def _check_solution(self, problem: RightHandSide, exact: ByName) -> None:
        """Reports a solution whose derivative provably differs from the right-hand sides."""
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
                    message = f"{term.where} is not a solution: at t = {time} its derivative is "
                    message += f"{_decimal(has)}, the right-hand sides give {_decimal(needs)}"
                    cure = "correct it, or leave exact out"
                    self.source.fault(term.node, message, cure, code="no-solution")
                    return


def _decimal(x: fmpq | arb) -> str:
    return str(arb(x).str(6, radius=False))
