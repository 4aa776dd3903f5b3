"""Elementary differentials and elementary Hamiltonians of a problem as formulas.

Derivatives of H^{l} are sympy expressions, each taken once; so is each F(u).
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, TypeAlias

from garkcli.problems.hamiltonian import Hamiltonian
from garkcli.problems.vectorfield import symbols
from garkcli.tableau.tableau import Tableau
from garkcli.trees.tree import Tree

Formula: TypeAlias = Any
"""A sympy expression in the positions and momenta."""
FormulaVector: TypeAlias = tuple[Formula, ...]
"""2d formulas, one for each unknown, positions first."""


class Differentials:
    """F(u) and H(u) of a problem that is split as the colours of a tableau say.

    Args:
        tableau: the colours; their terms are numbers of ``energies``.
        problem: whose unknowns they are.
        energies: H^{l}, sympy expressions.
    """

    def __init__(self, tableau: Tableau, problem: Hamiltonian, energies: Sequence[Formula]) -> None:
        self.tableau = tableau
        self.problem = problem
        self.energies = energies
        q = symbols(problem.variables, "q")
        p = symbols(problem.variables, "p")
        self.unknowns = (*q, *p)
        self._derivatives: dict[tuple[int, tuple[int, ...]], Formula] = {}
        self._fields: dict[Tree, FormulaVector] = {}

    def field(self, tree: Tree) -> FormulaVector:
        """F(u), with f^{l} = J⁻¹∇H^{l} or the half of it that the colour drives."""
        if tree not in self._fields:
            self._fields[tree] = self._field(tree)
        return self._fields[tree]

    def _field(self, tree: Tree) -> FormulaVector:
        colour = self.tableau.colours[tree.root]
        d = self.problem.dimension
        along = [self.field(u) for u in tree.branches]
        components: list[Formula] = [0] * (2 * d)
        for i in range(d):
            if colour.part != "p":
                components[i] = self._along(colour.term, (d + i,), along)
            if colour.part != "q":
                components[d + i] = -self._along(colour.term, (i,), along)
        return tuple(components)

    def hamiltonian(self, tree: Tree) -> Formula:
        """H(u) = H^{l (k)}(F(u_1), …, F(u_k))."""
        term = self.tableau.colours[tree.root].term
        along = [self.field(u) for u in tree.branches]
        return self._along(term, (), along)

    def _along(self, term: int, taken: tuple[int, ...], along: Sequence[FormulaVector]) -> Formula:
        """A derivative of H^{l} that was taken by some unknowns, further along vectors which are
        not differentiated.
        """
        value = self._derivative(term, tuple(sorted(taken)))
        if value == 0 or not along:
            return value
        first, *rest = along
        total: Formula = 0
        for i, component in enumerate(first):
            if component != 0:
                total += component * self._along(term, (*taken, i), rest)
        return total

    def _derivative(self, term: int, by: tuple[int, ...]) -> Formula:
        """∂^k H^{l} by the unknowns of these numbers, ascending."""
        key = term, by
        if key not in self._derivatives:
            if by:
                *before, last = by
                lower = self._derivative(term, tuple(before))
                value = lower.diff(self.unknowns[last])
            else:
                import sympy

                value = sympy.Integer(0) + self.energies[term]
            self._derivatives[key] = value
        return self._derivatives[key]
