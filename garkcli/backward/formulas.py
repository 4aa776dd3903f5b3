"""The modified Hamiltonian or the modified equation of a method on one problem, as a formula."""

from __future__ import annotations

from collections.abc import Sequence
from math import comb, prod
from typing import Any, Literal, TypeAlias

from garkcli.backward.hamiltonian import hamiltonian_structure, modified_hamiltonian
from garkcli.backward.modified import ModifiedEquation, modified_equation
from garkcli.doing import doing
from garkcli.errors import UsageProblem
from garkcli.exact.field import Algebraic, Number
from garkcli.exact.nodes import AlgebraicRoot, Expression
from garkcli.frozen import Frozen, replace
from garkcli.ntrees.free import Structure
from garkcli.ntrees.kind import LINEAR
from garkcli.ntrees.tree import Tree
from garkcli.order.admissible import elementary_weight
from garkcli.order.simplifying import is_symplectic
from garkcli.problems.expr import rational
from garkcli.problems.hamiltonian import Hamiltonian
from garkcli.problems.vectorfield import symbols
from garkcli.stepping.fields import visible_tableau
from garkcli.stepping.integrator import Binding, bind
from garkcli.tableau.tableau import Tableau
from garkcli.upward import Shown

Formula: TypeAlias = Any
"""A sympy expression in the positions and momenta."""
FormulaVector: TypeAlias = tuple[Formula, ...]
"""2d formulas, one for each unknown, positions first."""


class Differentials:
    """The elementary differentials F(u) and H(u); ``energies`` are the H^{l} by term."""

    def __init__(self, tableau: Tableau, problem: Hamiltonian, energies: Sequence[Formula]) -> None:
        self.tableau = tableau
        self.problem = problem
        self.energies = energies
        self.unknowns = (*symbols(problem.variables, "q"), *symbols(problem.variables, "p"))
        self._derivatives: dict[tuple[int, tuple[int, ...]], Formula] = {}
        self._fields: dict[Tree, FormulaVector] = {}

    def field(self, tree: Tree) -> FormulaVector:
        """F(u), with f^{l} = J⁻¹∇H^{l} or the half that the colour drives."""
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
        return self._along(term, (), [self.field(u) for u in tree.branches])

    def _along(self, term: int, taken: tuple[int, ...], along: Sequence[FormulaVector]) -> Formula:
        """A derivative of H^{l} by some unknowns, along vectors that are held fixed."""
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
        """∂^k H^{l} by the unknowns with these indices, ascending."""
        key = term, by
        if key not in self._derivatives:
            if by:
                *before, last = by
                value = self._derivative(term, tuple(before)).diff(self.unknowns[last])
            else:
                import sympy

                value = sympy.Integer(0) + self.energies[term]
            self._derivatives[key] = value
        return self._derivatives[key]


class VisibleTrees(Frozen):
    """A tableau with few trees, among them all that a problem sees: with two terms for H^{l} = T(p)
    + U(q), as ∂H^{l}/∂p is that of T, and all of H^{l} in ``energies``. ``structure`` is None if
    roots cannot move.
    """

    tableau: Tableau
    energies: tuple[Any, ...]
    structure: Structure | None


def visible(bound: Binding) -> VisibleTrees:
    """The fewest trees that contain those seen by a problem and whose roots can still move."""
    energies = tuple(bound.problem.terms)
    roots = range(bound.tableau.size)
    is_consistent = all(elementary_weight(bound.tableau, Tree(l)) == 1 for l in roots)
    if bound.fields and is_consistent:
        few = visible_tableau(bound.tableau, bound.fields)
        # for each colour its term, with its part where V^l and F^l do not see what they
        # drive: then ∂²H^{l}/∂q∂p = 0
        origins: list[tuple[int, str]] = []
        for l, colour in enumerate(few.colours):
            same_part = [m for m, x in enumerate(few.colours) if x.part == colour.part]
            sees_own = any(few.block(l, m) is not None for m in same_part)
            origins.append((colour.term, "" if sees_own else colour.part))
        distinct = list(dict.fromkeys(origins))
        colours = []
        for colour, origin in zip(few.colours, origins, strict=True):
            colours.append(replace(colour, term=distinct.index(origin)))
        few = replace(few, colours=tuple(colours))
        structure = hamiltonian_structure(few)
        if structure is not None:
            apart = tuple(energies[term] for term, _ in distinct)
            return VisibleTrees(few, apart, structure)
    more = _with_linear_fields(bound)
    return VisibleTrees(more, energies, hamiltonian_structure(more))


def _with_linear_fields(bound: Binding) -> Tableau:
    """The tableau without the trees that vanish because some H^{l} is quadratic."""
    tableau = bound.tableau
    quadratic = {x.term for x in tableau.colours}
    for (l, _), field in bound.fields.items():
        if not field.is_linear:
            quadratic.discard(tableau.colours[l].term)
    colours = tuple(
        replace(colour, kind=LINEAR) if colour.term in quadratic else colour
        for colour in tableau.colours
    )
    return replace(tableau, colours=colours)


MAX_OPERATIONS = 20_000
"""Most operations of a formula that is expanded."""
MAX_SUMMANDS = 100_000


class PowerTerm(Frozen):
    """The coefficient of a power of h.

    Attributes:
        power: the power of h.
        formulas: one for a Hamiltonian, 2d for an equation.
    """

    power: int
    formulas: FormulaVector


class ModifiedFormula(Shown, Frozen):
    """The modified Hamiltonian or the right-hand side of the modified equation.

    Attributes:
        problem: in as many terms as the method has.
        of: Hamiltonian or equation.
        max_order: the order of the largest trees; powers of h up to one less.
        terms: by ascending powers, without those whose trees all vanish.
        is_consistent: whether the term without h is the problem itself.
    """

    problem: Hamiltonian
    of: Literal["hamiltonian", "equation"]
    max_order: int
    terms: tuple[PowerTerm, ...]
    is_consistent: bool

    def expanded(self) -> ModifiedFormula:
        """Expanded, without vanishing powers; UsageProblem if a formula is too long."""
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
    """Returns the modified Hamiltonian of a symplectic method, the modified equation of any other;
    UsageProblem if the problem does not suit the structure, or there are too many trees.

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
        size = len(differentials.unknowns)
        sums = []
        for n in range(1, equation.max_order + 1):
            total: list[Formula] = [0] * size
            for tree, coefficient in equation.terms(n):
                factor = in_sympy(coefficient / tree.symmetry)
                for i, component in enumerate(differentials.field(tree)):
                    total[i] += factor * component
            sums.append(total)
    terms = []
    for power, formulas in enumerate(sums):
        if any(x != 0 for x in formulas):
            terms.append(PowerTerm(power, tuple(formulas)))
    is_consistent = equation.order > 0
    return ModifiedFormula(split, of, max_order, tuple(terms), is_consistent)


def _of_hamiltonian(
    differentials: Differentials, equation: ModifiedEquation, structure: Structure
) -> list[list[Formula]]:
    sums: list[list[Formula]] = [[0] for _ in range(equation.max_order)]
    is_consistent = equation.order > 0
    if is_consistent:
        sums[0] = [differentials.problem.energy]
    for term in modified_hamiltonian(equation, structure):
        if is_consistent and term.tree.order == 1:
            continue
        value = differentials.hamiltonian(term.tree.representative)
        sums[term.tree.order - 1][0] += in_sympy(term.factor) * value
    return sums


def _expanded(formula: Formula, power: int) -> Formula:
    import sympy

    expression = sympy.Integer(0) + formula
    cure = f"ask for --order {power} at most, or choose a simpler problem"
    size = int(expression.count_ops())
    if size > MAX_OPERATIONS:
        message = f"the formula of h^{power} has {size} operations (limit {MAX_OPERATIONS})"
        raise UsageProblem(message, cure, code="too-many")
    if _summands(expression) > MAX_SUMMANDS:
        message = f"the formula of h^{power} has too many summands (limit {MAX_SUMMANDS})"
        raise UsageProblem(message, cure, code="too-many")
    return sympy.expand(expression)


def _summands(expression: Formula) -> int:
    if expression.is_Add:
        return sum(map(_summands, expression.args))
    if expression.is_Mul:
        return prod(map(_summands, expression.args))
    if expression.is_Pow and expression.exp.is_Integer and expression.exp > 0:
        count, power = _summands(expression.base), int(expression.exp)
        return comb(count + power - 1, power)
    return 1


def in_sympy(number: Number) -> Any:
    """Returns a sympy expression; UsageProblem if a number is not in radicals."""
    import sympy

    if not isinstance(number, Algebraic):
        return rational(number)
    total = sympy.Integer(0)
    for coefficient, word in number.terms():
        term = rational(coefficient)
        for index in word:
            radical, _ = number.field.radicals[index]
            term *= _radical(radical)
        total += term
    return total


def _radical(radical: Expression) -> Any:
    from garkcli.exact.rewriting import roots_in
    from garkcli.problems.translate import Translator

    if any(isinstance(root, AlgebraicRoot) for root in roots_in(radical)):
        message = "a formula is written in radicals, and a coefficient of the method is a root_of"
        cure = "gark modified without a problem lists the coefficients"
        raise UsageProblem(message, cure, code="no-radicals")
    return Translator({}, {}).translate(radical)
