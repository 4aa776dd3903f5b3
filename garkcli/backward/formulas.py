"""The modified Hamiltonian or the modified equation of a method on one problem, as a formula."""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import comb, prod
from typing import TYPE_CHECKING, Any, Literal

from garkcli.backward.differentials import Differentials, Formula, FormulaVector
from garkcli.backward.hamiltonian import modified_hamiltonian
from garkcli.backward.modified import ModifiedEquation, modified_equation
from garkcli.backward.visible import visible
from garkcli.doing import doing
from garkcli.errors import UsageProblem
from garkcli.exact.field import Algebraic, Number
from garkcli.problems.hamiltonian import Hamiltonian
from garkcli.stepping.integrator import bind
from garkcli.tableau.conjugate import is_symplectic
from garkcli.tableau.tableau import Tableau
from garkcli.upward import Shown

if TYPE_CHECKING:
    from flint import fmpq

    from garkcli.exact.nodes import Expression
    from garkcli.trees.free import Structure

MAX_OPERATIONS = 20_000
"""The longest formula that is multiplied out, in operations as it is put together."""
MAX_SUMMANDS = 100_000
"""The most summands of a formula that is multiplied out, before like ones are collected."""


@dataclass(frozen=True)
class PowerTerm:
    """What multiplies a power of h.

    Attributes:
        power: of h.
        formulas: one for a Hamiltonian, 2d for an equation.
    """

    power: int
    formulas: FormulaVector


@dataclass(frozen=True)
class ModifiedFormula(Shown):
    """The modified Hamiltonian or the right-hand side of the modified equation.

    Attributes:
        problem: in as many terms as the method is for.
        of: which of the two.
        max_order: of the trees: powers of h up to one less.
        terms: by ascending powers, without those whose trees all vanish.
        is_consistent: whether the term without h is the problem itself.
    """

    problem: Hamiltonian
    of: Literal["hamiltonian", "equation"]
    max_order: int
    terms: tuple[PowerTerm, ...]
    is_consistent: bool

    def expanded(self) -> ModifiedFormula:
        """The same multiplied out, with like summands collected, without powers that vanish.

        Raises:
            UsageProblem: a formula is too long.
        """
        terms = []
        for term in self.terms:
            formulas = tuple(_expanded(x, term.power) for x in term.formulas)
            if any(x != 0 for x in formulas):
                terms.append(PowerTerm(term.power, formulas))
        return replace(self, terms=tuple(terms))

    def __repr__(self) -> str:
        powers = ", ".join(f"h^{term.power}" for term in self.terms)
        return f"<ModifiedFormula {self.of} of {self.problem.name}: {powers}>"


@doing("modified Hamiltonian of the problem")
def modified_formula(tableau: Tableau, problem: Hamiltonian, max_order: int) -> ModifiedFormula:
    """The modified Hamiltonian of a symplectic method, the modified equation of any other.

    Args:
        tableau: that steps; its coefficients are exact.
        problem: in as many terms as the tableau is for, or in one that has a natural split.
        max_order: of the trees.

    Raises:
        UsageProblem: the problem is not of the form of the structure, or there are too many trees.

    >>> from garkcli import hamiltonian, load
    >>> verlet = load("methods/stoermer-verlet.gark.yaml").tableau
    >>> found = modified_formula(verlet, hamiltonian("pendulum", 2), 4)
    >>> for term in found.expanded().terms:
    ...     print(term.power, *term.formulas)
    0 px**2/2 - cos(x) + 1
    2 px**2*cos(x)/12 - sin(x)**2/24
    """
    bound = bind(tableau, problem)
    split = bound.problem
    assert isinstance(split, Hamiltonian)
    seen = visible(bound)
    equation = modified_equation(seen.tableau, max_order)
    differentials = Differentials(seen.tableau, split, seen.energies)
    if seen.structure is not None and is_symplectic(bound.tableau):
        of: Literal["hamiltonian", "equation"] = "hamiltonian"
        sums = _of_hamiltonian(differentials, equation, seen.structure)
    else:
        of = "equation"
        sums = _of_equation(differentials, equation)
    terms = []
    for power, formulas in enumerate(sums):
        if any(x != 0 for x in formulas):
            terms.append(PowerTerm(power, tuple(formulas)))
    is_consistent = equation.order > 0
    return ModifiedFormula(split, of, max_order, tuple(terms), is_consistent)


def _of_hamiltonian(
    differentials: Differentials, equation: ModifiedEquation, structure: Structure
) -> list[list[Formula]]:
    """For each power of h one formula."""
    sums: list[list[Formula]] = [[0] for _ in range(equation.max_order)]
    is_consistent = equation.order > 0
    if is_consistent:
        sums[0] = [differentials.problem.energy]
    for term in modified_hamiltonian(equation, structure):
        if is_consistent and term.tree.order == 1:
            continue
        value = differentials.hamiltonian(term.tree.representative)
        power = term.tree.order - 1
        sums[power][0] += in_sympy(term.factor) * value
    return sums


def _of_equation(differentials: Differentials, equation: ModifiedEquation) -> list[list[Formula]]:
    """For each power of h one formula for each unknown."""
    size = len(differentials.unknowns)
    sums: list[list[Formula]] = []
    for n in range(1, equation.max_order + 1):
        total: list[Formula] = [0] * size
        for tree, coefficient in equation.terms(n):
            factor = in_sympy(coefficient / tree.symmetry)
            for i, component in enumerate(differentials.field(tree)):
                total[i] += factor * component
        sums.append(total)
    return sums


def _expanded(formula: Formula, power: int) -> Formula:
    """A formula multiplied out.

    Raises:
        UsageProblem: it is too long.
    """
    import sympy

    expression = sympy.Integer(0) + formula
    cure = f"ask for --order {power} at most, or choose a simpler problem"
    size = int(expression.count_ops())
    if size > MAX_OPERATIONS:
        raise UsageProblem(
            f"the formula of h^{power} has {size} operations (limit {MAX_OPERATIONS})",
            cure,
            code="too-many",
        )
    if _summands(expression) > MAX_SUMMANDS:
        raise UsageProblem(
            f"the formula of h^{power} has too many summands (limit {MAX_SUMMANDS})",
            cure,
            code="too-many",
        )
    return sympy.expand(expression)


def _summands(expression: Formula) -> int:
    """A bound of the number of summands when a formula is multiplied out."""
    if expression.is_Add:
        return sum(map(_summands, expression.args))
    if expression.is_Mul:
        return prod(map(_summands, expression.args))
    if expression.is_Pow and expression.exp.is_Integer and expression.exp > 0:
        count, power = _summands(expression.base), int(expression.exp)
        return comb(count + power - 1, power)
    return 1


def in_sympy(number: Number) -> Any:
    """An exact number as a sympy expression.

    Raises:
        UsageProblem: it has no radicals.
    """
    import sympy

    if not isinstance(number, Algebraic):
        return _rational(number)
    total = sympy.Integer(0)
    for coefficient, word in number.terms():
        term = _rational(coefficient)
        for index in word:
            radical, _ = number.field.radicals[index]
            term *= _radical(radical)
        total += term
    return total


def _rational(number: fmpq) -> Any:
    import sympy

    return sympy.Rational(int(number.p), int(number.q))


def _radical(radical: Expression) -> Any:
    """A radical of a file in sympy."""
    from garkcli.exact.nodes import AlgebraicRoot
    from garkcli.exact.rewriting import roots_in
    from garkcli.problems.translate import Translator

    if any(isinstance(root, AlgebraicRoot) for root in roots_in(radical)):
        raise UsageProblem(
            "a formula is written in radicals, and a coefficient of the method is a root_of",
            "gark modified without a problem lists the coefficients",
            code="no-radicals",
        )
    return Translator({}, {}).translate(radical)
