"""From the text of a problem file to a Hamiltonian: known names, values at the start,
derivatives.
"""

from __future__ import annotations

from collections.abc import Container, Mapping, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any

from flint import arb, ctx, fmpq
from yaml.nodes import Node

from garkcli.errors import NoLegendreTransform
from garkcli.methodfile.expansion import too_long
from garkcli.methodfile.formulas import BITS, PLACES, Formulas, nearby
from garkcli.methodfile.problem_text import ProblemText
from garkcli.methodfile.source import Source
from garkcli.methodfile.termreader import Term, TermReader
from garkcli.methodfile.words import shortened

if TYPE_CHECKING:
    from garkcli.problems.hamiltonian import Hamiltonian

_SHOWN = 8  # most missing names that are told


class Maker:
    """Makes the problem of one file; faults are noted in its source."""

    def __init__(
        self, source: Source, formulas: Formulas, text: ProblemText
    ) -> None:
        from garkcli.problems.mass import velocities
        from garkcli.problems.vectorfield import symbols

        self.source, self.formulas, self.text = source, formulas, text
        self.reader = TermReader(source, formulas)
        self.q, self.p = (
            symbols(text.variables, "q"),
            symbols(text.variables, "p"),
        )
        self.v = velocities(text.variables)
        self.is_lagrangian = text.form == "lagrangian"

    def problem(self) -> Hamiltonian:
        """The problem.

        Raises:
            MethodFileError: there are faults; all that could be found.
        """
        from garkcli.problems.hamiltonian import Hamiltonian

        start = self._initial()
        terms = self._terms()
        invariants = self._invariants()
        if start is not None:
            self.reader.check_values(terms, start)
        self.reader.check_size(terms)
        self.reader.check_numbers([*terms, *invariants])
        self.source.close()
        assert start is not None
        if self.is_lagrangian:
            terms, start = self._transformed(terms, start)
        at = {str(x): start[str(x)] for x in (*self.q, *self.p)}
        self._check_fields(terms, at)
        self.reader.check_values(invariants, at)
        self._refuse_constants(terms, invariants)
        self.source.close()
        return Hamiltonian(
            self.text.name,
            self.text.variables,
            tuple(x.made for x in terms),
            tuple(at.values()),
            self.text.t_end,
            tuple(
                (x.where.removeprefix("invariants: "), x.made)
                for x in invariants
            ),
        )

    def _initial(self) -> dict[str, fmpq] | None:
        """The initial values by name; None where they are not complete."""
        node = self.text.initial
        if node is None:
            return None
        if not self.text.are_named:
            self._read_unnamed(node)
            return None
        before = len(self.source.faults)
        motions = [self.p, self.v] if self.is_lagrangian else [self.p]
        names = [str(x) for group in (self.q, *motions) for x in group]
        entries = self.source.mapping(node, "initial", names)
        values = {}
        for name, x in entries.items():
            value = self.formulas.rational(x, f"initial: {name}")
            if value is not None:
                values[name] = value
        given = [
            group for group in motions if any(str(x) in entries for x in group)
        ]
        if len(given) > 1:
            cure = "give all velocities or all momenta"
            self.source.fault(node, "initial: velocities and momenta", cure)
        elif len(self.source.faults) == before:
            self._refuse_missing(
                node, given[0] if given else motions[-1], entries
            )
        return values if len(self.source.faults) == before else None

    def _read_unnamed(self, node: Node) -> None:
        """Note what is wrong with the numbers alone, where the names are not known."""
        for name, x in self.source.mapping(node, "initial", ()).items():
            self.formulas.rational(x, f"initial: {shortened(name)[1:-1]}")

    def _refuse_missing(
        self, node: Node, motion: Sequence[Any], given: Container[str]
    ) -> None:
        """Note positions, and momenta or velocities, without a value."""
        missing = [str(x) for x in (*self.q, *motion) if str(x) not in given]
        if missing:
            more = ", …" if len(missing) > _SHOWN else ""
            names = ", ".join(missing[:_SHOWN])
            message = f"initial: no value for {names}{more}"
            cure = f"give each a number, such as {missing[0]}: 1/2"
            self.source.fault(node, message, cure)

    def _names(
        self, motion: Sequence[Any], other: Sequence[Any], cure: str
    ) -> dict[str, str]:
        """For names that may stand in a formula nothing, for others the cure."""
        names = {
            str(y): cure.format(x) for x, y in zip(motion, other, strict=True)
        }
        return names | {str(x): "" for x in (*self.q, *motion)}

    def _terms(self) -> list[Term]:
        if self.is_lagrangian:
            names = self._names(
                self.v, self.p, "a Lagrangian has velocities: {}"
            )
            noun = "variable, velocity or parameter"
        else:
            names = self._names(
                self.p, self.v, "a Hamiltonian has momenta: {}"
            )
            noun = "variable, momentum or parameter"
        return self._formulas(self.text.terms, names, noun)

    def _invariants(self) -> list[Term]:
        names = self._names(self.p, self.v, "invariants have momenta: {}")
        items = [
            (node, f"invariants: {name}")
            for name, node in self.text.invariants
        ]
        return self._formulas(items, names, "variable, momentum or parameter")

    def _formulas(
        self,
        items: Sequence[tuple[Node, str]],
        names: dict[str, str],
        noun: str,
    ) -> list[Term]:
        symbols = {str(x): x for x in (*self.q, *self.p, *self.v)}
        known = names if self.text.are_named else None
        return self.reader.terms(items, symbols, known, noun)

    def _transformed(
        self, lagrangians: list[Term], start: dict[str, fmpq]
    ) -> tuple[list[Term], dict[str, fmpq]]:
        """The Hamiltonian terms, and the start with momenta."""
        moving = [x for x in lagrangians if x.made.free_symbols & set(self.v)]
        if not moving:
            names = ", ".join(map(str, self.v[:3]))
            message = "the Lagrangian has no velocities"
            cure = f"the kinetic energy has {names}"
            self.source.fault(lagrangians[0].node, message, cure)
        has_velocities = str(self.v[0]) in start
        with ctx.workprec(BITS):
            at = {
                x: arb(start[str(x)])
                for x in (*self.q, *self.p, *self.v)
                if str(x) in start
            }
        # with several moving terms the velocity of each is not q̇(0), only their sum is
        is_one = len(moving) == 1 or not has_velocities
        known = at if is_one else {x: at[x] for x in self.q}
        transformed = (self._transform(term, known) for term in lagrangians)
        found = [term for term in transformed if term is not None]
        self.source.close()
        self.reader.check_size(found)
        self.reader.check_numbers(found)
        self.source.close()
        if has_velocities:
            start = start | self._momenta(lagrangians, found, at, moving[0])
        return found, start

    def _transform(self, term: Term, known: Mapping[Any, arb]) -> Term | None:
        """The Hamiltonian of one term; None where it is not found, which is noted."""
        from garkcli.problems.lagrangian import legendre_transform
        from garkcli.problems.mass import WRITE_HAMILTONIAN

        unsolved = too_long(term.made, self.v)
        if unsolved is not None:
            message = f"{term.where}: p = ∂L/∂v was not solved for {unsolved}, it is too long"
            self.source.fault(term.node, message, WRITE_HAMILTONIAN)
            return None
        try:
            return replace(
                term,
                made=legendre_transform(term.made, self.text.variables, known),
            )
        except NoLegendreTransform as error:
            self.source.fault(
                term.node, f"{term.where}: {error.message}", error.help
            )
            return None

    def _momenta(
        self,
        lagrangians: Sequence[Term],
        hamiltonians: Sequence[Term],
        at: Mapping[Any, arb],
        moving: Term,
    ) -> dict[str, fmpq]:
        """The momenta by name that belong to the velocities at the start."""
        from garkcli.problems.start import initial_momenta

        L, H = (
            [x.made for x in terms] for terms in (lagrangians, hamiltonians)
        )
        try:
            momenta = initial_momenta(L, H, self.text.variables, at)
        except NoLegendreTransform as error:
            self.source.fault(
                self.text.initial, f"initial: {error.message}", error.help
            )
            self.source.close()
        if not all(x.is_finite() and x.rad() < 10.0**-PLACES for x in momenta):
            message = f"{moving.where}: the momenta do not exist at the initial values"
            self.source.fault(moving.node, message, "start elsewhere")
            self.source.close()
        return {
            str(x): nearby(y) for x, y in zip(self.p, momenta, strict=True)
        }

    def _refuse_constants(
        self, terms: Sequence[Term], invariants: Sequence[Term]
    ) -> None:
        """Note an H with which nothing moves, and invariants that are none: they are constant for
        every motion.
        """
        from garkcli.problems.vectorfield import is_constant

        if is_constant(sum(x.made for x in terms)):
            parts = "the sum of its terms" if len(terms) > 1 else "it"
            self.source.fault(
                terms[0].node,
                f"the Hamiltonian is constant: {parts} depends on no variable, and nothing moves",
                "write it in positions and momenta",
            )
        for invariant in invariants:
            if is_constant(invariant.made):
                self.source.fault(
                    invariant.node,
                    f"{invariant.where} is constant: it depends on no variable",
                    "write a first integral in positions and momenta, or leave it out",
                )

    def _check_fields(
        self, terms: Sequence[Term], start: dict[str, fmpq]
    ) -> None:
        """Note terms that have no derivative at the start."""
        from garkcli.problems.start import missing_derivative

        with ctx.workprec(BITS):
            at = {x: arb(start[str(x)]) for x in (*self.q, *self.p)}
        for term in terms:
            missing = missing_derivative(term.made, (*self.q, *self.p), at)
            if missing is not None:
                self.source.fault(
                    term.node,
                    f"{term.where} at the initial values: {missing[0]}",
                    missing[1],
                )
