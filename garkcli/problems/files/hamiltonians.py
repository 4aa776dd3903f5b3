"""Hamiltonians from the text of a problem file, checked."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import chain
from typing import TYPE_CHECKING

from flint import arb, ctx, fmpq

from garkcli.errors import NoLegendreTransform
from garkcli.frozen import replace
from garkcli.problems.expr import Place, Vector
from garkcli.problems.files import formulas as texts
from garkcli.problems.files.expansion import too_long
from garkcli.problems.files.keys import ProblemText

if TYPE_CHECKING:
    from garkcli.problems.hamiltonian import Hamiltonian

_NUMBER = "a number, such as {}: 1/2"
_GOOD = 10.0**-texts.PLACES  # the radius of momenta that may count as the start


class HamiltonianMaker(texts.Maker):
    def __init__(self, formulas: texts.FormulaReader, text: ProblemText) -> None:
        from garkcli.problems.mass import velocities
        from garkcli.problems.vectorfield import symbols

        self.q = symbols(text.variables, "q")
        self.p = symbols(text.variables, "p")
        self.v = velocities(text.variables)
        self.is_lagrangian = text.form == "lagrangian"
        super().__init__(formulas, text, (*self.q, *self.p, *self.v))

    def problem(self) -> Hamiltonian:
        """Raises MethodFileError with all faults."""
        from garkcli.problems.hamiltonian import Hamiltonian

        start = self._initial()
        noun = "variable, momentum or parameter"
        if self.is_lagrangian:
            names = self._names(self.v, self.p, "a Lagrangian has velocities: {}")
            terms = self.terms(self.text.terms, names, "variable, velocity or parameter")
        else:
            names = self._names(self.p, self.v, "a Hamiltonian has momenta: {}")
            terms = self.terms(self.text.terms, names, noun)
        names = self._names(self.p, self.v, "invariants have momenta: {}")
        invariants = self.invariants(names, noun)
        if start is not None:
            self.check_values(terms, start)
        self.check_size(terms)
        self.check_numbers([*terms, *invariants])
        self.source.close()
        assert start is not None
        if self.is_lagrangian:
            terms, start = self._transformed(terms, start)
        at = {str(x): start[str(x)] for x in (*self.q, *self.p)}
        self.check_derivatives(terms, (*self.q, *self.p), at, {})
        self.check_values(invariants, at)
        self._refuse_constants(terms, invariants)
        self.source.close()
        return Hamiltonian(
            self.text.name,
            self.text.variables,
            tuple(x.made for x in terms),
            tuple(at.values()),
            self.text.t_end,
            texts.named(invariants),
        )

    def _initial(self) -> dict[str, fmpq] | None:
        node = self.text.initial
        if node is None:
            return None
        if not self.text.are_named:
            self.numbers(node, "initial", ())
            return None
        before = len(self.source.faults)
        # a Lagrangian starts with velocities or with momenta
        motions = [self.p, self.v] if self.is_lagrangian else [self.p]
        names = [str(x) for x in chain(self.q, *motions)]
        entries, values = self.numbers(node, "initial", names)
        given = [x for x in motions if not entries.keys().isdisjoint(map(str, x))]
        if len(given) > 1:
            cure = "give all velocities or all momenta"
            self.source.fault(node, "initial: velocities and momenta", cure, code="given-twice")
        elif len(self.source.faults) == before:
            (motion,) = given or motions[-1:]
            self.refuse_missing(node, "initial", (*self.q, *motion), entries, _NUMBER)
        return values if len(self.source.faults) == before else None

    def _names(self, motion: Vector, other: Vector, cure: str) -> dict[str, str]:
        others = {str(y): cure.format(x) for x, y in zip(motion, other, strict=True)}
        return others | dict.fromkeys(map(str, (*self.q, *motion)), "")

    def _transformed(
        self, lagrangians: list[texts.FormulaTerm], start: dict[str, fmpq]
    ) -> tuple[list[texts.FormulaTerm], dict[str, fmpq]]:
        velocities = set(self.v)
        moving = [x for x in lagrangians if x.made.free_symbols & velocities]
        if not moving:
            message = "the Lagrangian has no velocities"
            cure = f"the kinetic energy has {', '.join(map(str, self.v[:3]))}"
            self.source.fault(lagrangians[0].node, message, cure, code="missing-key")
        has_velocities = str(self.v[0]) in start
        every = (*self.q, *self.p, *self.v)
        with ctx.workprec(texts.BITS):
            at = {x: arb(start[str(x)]) for x in every if str(x) in start}
        # with several moving terms the velocity of each is not q̇(0), only their sum is
        is_one = len(moving) == 1 or not has_velocities
        known = at if is_one else {x: at[x] for x in self.q}
        transformed = (self._transform(term, known) for term in lagrangians)
        terms = [term for term in transformed if term is not None]
        self.source.close()
        self.check_size(terms)
        self.check_numbers(terms)
        self.source.close()
        if has_velocities:
            start = start | self._momenta(lagrangians, terms, at, moving[0])
        return terms, start

    def _transform(self, term: texts.FormulaTerm, known: Place) -> texts.FormulaTerm | None:
        from garkcli.problems.lagrangian import legendre_transform
        from garkcli.problems.mass import WRITE_HAMILTONIAN

        unsolved = too_long(term.made, self.v)
        if unsolved is not None:
            message = f"{term.where}: p = ∂L/∂v was not solved for {unsolved}, it is too long"
            self.source.fault(term.node, message, WRITE_HAMILTONIAN, code="no-legendre-transform")
            return None
        try:
            made = legendre_transform(term.made, self.text.variables, known)
        except NoLegendreTransform as error:
            message = f"{term.where}: {error.message}"
            self.source.fault(term.node, message, error.help, code=error.code)
            return None
        return replace(term, made=made)

    def _momenta(
        self,
        lagrangians: Sequence[texts.FormulaTerm],
        hamiltonians: Sequence[texts.FormulaTerm],
        at: Place,
        moving: texts.FormulaTerm,
    ) -> dict[str, fmpq]:
        """Returns the momenta that belong to the initial velocities, by name."""
        from garkcli.problems.lagrangian import initial_momenta

        L = [term.made for term in lagrangians]
        H = [term.made for term in hamiltonians]
        try:
            momenta = initial_momenta(L, H, self.text.variables, at)
        except NoLegendreTransform as error:
            message = f"initial: {error.message}"
            self.source.fault(self.text.initial, message, error.help, code=error.code)
            self.source.close()
        by_name: dict[str, fmpq] = {}
        for p, value in zip(self.p, momenta, strict=True):
            if not (value.is_finite() and value.rad() < _GOOD):
                message = f"{moving.where}: the momenta do not exist at the initial values"
                self.source.fault(moving.node, message, "start elsewhere", code="no-formula")
                self.source.close()
            by_name[str(p)] = texts.nearby(value)
        return by_name

    def _refuse_constants(
        self, terms: Sequence[texts.FormulaTerm], invariants: Sequence[texts.FormulaTerm]
    ) -> None:
        from garkcli.problems.vectorfield import is_constant

        total = sum(x.made for x in terms)
        if is_constant(total):
            parts = "the sum of its terms" if len(terms) > 1 else "it"
            message = (
                f"the Hamiltonian is constant: {parts} depends on no variable, and nothing moves"
            )
            cure = "write it in positions and momenta"
            self.source.fault(terms[0].node, message, cure, code="nothing-moves")
        self.refuse_constants(invariants, "positions and momenta")
