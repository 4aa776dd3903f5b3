"""The modified Hamiltonian of a symplectic method, in free trees.

Where J⁻¹∇H(u) = Σ_θ |Aut T|/σ(θ) (±) F(θ), the modified equation is that of

    H̃ = Σ_T h^(ρ(T)−1) b(u)/|Aut T| H(u),         u any rooting of T,

if b(θ) = ± b(u) for all rootings θ of T with the sign of their distance, b(u) = 0 for T = u∘u.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import cached_property
from itertools import chain

from flint import fmpq

from garkcli.backward.modified import ModifiedEquation
from garkcli.exact.field import ZERO, Number
from garkcli.frozen import Frozen
from garkcli.ntrees.free import Structure
from garkcli.ntrees.symplectic import ConditionClass, independent_classes, superfluous_classes
from garkcli.ntrees.tree import Tree
from garkcli.stepping.fields import with_joined_terms
from garkcli.tableau.tableau import Tableau


class FreeTree(ConditionClass):
    @property
    def has_hamiltonian(self) -> bool:
        """Whether its elementary Hamiltonian is not always zero."""
        return not self.is_superfluous

    @cached_property
    def rootings(self) -> tuple[tuple[Tree, int], ...]:
        """The rootings with a vector field, each once with its sign, the representative first. The
        root has the first of its colours. The rootings of u∘u have both signs; one is given.
        """
        signs: dict[Tree, int] = {self.representative: 1}
        for tree, sign in self._from_representative():
            signs.setdefault(tree, sign)
        structure = self.structure
        return tuple(x for x in signs.items() if structure.is_admissible(x[0]))

    def _from_representative(self) -> Iterator[tuple[Tree, int]]:
        """The rooting at every vertex, with the sign of its distance."""
        structure = self.structure
        start = self.representative
        waiting = [(start, start.branches, 1)]
        while waiting:
            here, onward, sign = waiting.pop()
            yield here, sign
            for u in onward:
                moved = structure.move_root(here, here.branches.index(u))
                waiting.append((moved, u.branches, -sign))

    @cached_property
    def symmetry(self) -> int:
        """|Aut T|: σ of a rooting times the number of vertices that are alike."""
        rootings = self.structure.rootings(self.representative)
        alike = sum(1 for tree in rootings if tree == self.representative)
        return self.representative.symmetry * alike


def free_trees(structure: Structure, order: int) -> Iterator[FreeTree]:
    """The free trees of one order, those without an elementary Hamiltonian last."""
    independent = independent_classes(structure, order)
    for found in chain(independent, superfluous_classes(structure, order)):
        yield FreeTree(found.centred, structure)


def hamiltonian_structure(tableau: Tableau) -> Structure | None:
    """The structure of H = Σ H^{l}; None if the root of some tree cannot move."""
    tableau = with_joined_terms(tableau)
    natures = [(x.term, x.part) for x in tableau.colours]
    parts = {x.part for x in tableau.colours}
    has_mixed_parts = "y" in parts and len(parts) > 1
    if has_mixed_parts or len(set(natures)) < len(natures):
        return None
    is_linear: dict[int, bool] = {}
    for colour in tableau.colours:
        before = is_linear.setdefault(colour.term, colour.is_linear)
        if before != colour.is_linear:
            return None  # H^{l} would be quadratic in one part alone
    quadratic = frozenset(term for term, linear in is_linear.items() if linear)
    structure = Structure(tuple(natures), quadratic)
    meant = set()
    for l, row in enumerate(structure.admissible.branches):
        meant |= {(l, m) for m in row}
    if set(tableau.edges()) != meant:
        return None
    return structure


class HamiltonianTerm(Frozen):
    """One term c · H(u) of h^(ρ−1); ``coefficient`` is b(u) of the representative u of the free
    tree.
    """

    tree: FreeTree
    coefficient: Number

    @property
    def factor(self) -> Number:
        """b(u)/|Aut T|, the coefficient of H(u)."""
        return self.coefficient / self.tree.symmetry


def defect(equation: ModifiedEquation, tree: FreeTree, zero: fmpq = ZERO) -> bool:
    """Whether rootings belong to no Hamiltonian, up to ``zero`` for rounded methods."""
    expected = equation[tree.representative]
    if not tree.has_hamiltonian and not is_zero(expected, zero):
        return True
    for rooting, sign in tree.rootings:
        for twin in tree.structure.twins(rooting):
            if not is_zero(equation[twin] - expected * sign, zero):
                return True
    return False


def is_zero(x: Number, zero: fmpq) -> bool:
    return not x or (zero > 0 and isinstance(x, fmpq) and abs(x) <= zero)


def symplectic_order(equation: ModifiedEquation, structure: Structure, zero: fmpq = ZERO) -> int:
    """The order of symplecticity, at most that of the largest trees: the largest q with MᵀJM = J +
    O(h^(q+1)) on all Hamiltonian problems: the first q terms of the modified equation have a
    Hamiltonian. With elementary weights: a(u∘v) + a(v∘u) = a(u) a(v) for ρ(u) + ρ(v) ≤ q. Source:
    A. Aubry, P. Chartier, *Pseudo-symplectic Runge–Kutta methods*, BIT 38 (1998) 439.
    """
    for n in range(1, equation.max_order + 1):
        if any(defect(equation, tree, zero) for tree in free_trees(structure, n)):
            return n - 1
    return equation.max_order


def modified_hamiltonian(
    equation: ModifiedEquation, structure: Structure, zero: fmpq = ZERO
) -> Iterator[HamiltonianTerm]:
    """The nonzero terms of the modified Hamiltonian, up to the order of symplecticity."""
    for n in range(1, symplectic_order(equation, structure, zero) + 1):
        for tree in free_trees(structure, n):
            coefficient = equation[tree.representative]
            if not is_zero(coefficient, zero):
                yield HamiltonianTerm(tree, coefficient)


def energy_order(equation: ModifiedEquation, structure: Structure, zero: fmpq = ZERO) -> int:
    """The order to which steps conserve H = Σ H^{l}: the largest r with H(y₁) = H(y₀) + O(h^(r+1))
    for all problems, at most that of the largest trees. The modified field changes H by Σ_u
    h^(ρ(u)−1)/σ(u) b(u) H([u]), where [u] is u below a vertex of any term; rootings at the leaves
    of one free tree agree up to sign. Source: E. Celledoni, R. I. McLachlan, B. Owren, G. R. W.
    Quispel, *Energy-preserving integrators and the structure of B-series*, Found. Comput. Math. 10
    (2010) 673.
    """
    for n in range(1, equation.max_order + 1):
        for tree in free_trees(structure, n + 1):
            if tree.has_hamiltonian and not is_zero(_change(equation, tree), zero):
                return n - 1
    return equation.max_order


def _change(equation: ModifiedEquation, tree: FreeTree) -> Number:
    total: Number = ZERO
    for rooting, sign in tree.rootings:
        if len(rooting.branches) == 1:
            (u,) = rooting.branches
            total = total + equation[u] * sign / u.symmetry
    return total
