"""The modified Hamiltonian of a symplectic method, in free trees.

Where J⁻¹∇H(u) = Σ_θ |Aut T|/σ(θ) (±) F(θ), the modified equation is that of

    H̃ = Σ_T h^(ρ(T)−1) b(u)/|Aut T| H(u),         u any rooting of T,

if b(θ) = ± b(u) for all rootings θ of T with the sign of their distance, b(u) = 0 for T = u∘u.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from garkcli.backward.free_trees import FreeTree, free_trees
from garkcli.backward.modified import ModifiedEquation
from garkcli.exact.field import ZERO, Number
from garkcli.trees.free import Structure


@dataclass(frozen=True)
class HamiltonianTerm:
    """One term c · H(u) of h^(ρ−1) in the modified Hamiltonian.

    Attributes:
        tree: the free tree.
        coefficient: b(u) of its representative u.
    """

    tree: FreeTree
    coefficient: Number

    @property
    def factor(self) -> Number:
        """b(u)/|Aut T|, what multiplies H(u)."""
        return self.coefficient / self.tree.symmetry


def defect(equation: ModifiedEquation, tree: FreeTree) -> bool:
    """Whether the coefficients of the rootings of a free tree do not belong to a Hamiltonian."""
    expected = equation[tree.representative]
    if not tree.has_hamiltonian and expected:
        return True
    for rooting, sign in tree.rootings:
        for twin in tree.structure.twins(rooting):
            if equation[twin] != expected * sign:
                return True
    return False


def symplectic_order(equation: ModifiedEquation, structure: Structure) -> int:
    """The order of symplecticity, up to that of the largest trees.

    It is the largest q for which steps satisfy MᵀJM = J + O(h^(q+1)) on all Hamiltonian problems:
    for which the first q terms of the modified equation have a Hamiltonian. With elementary weights
    it is a(u∘v) + a(v∘u) = a(u) a(v) for ρ(u) + ρ(v) ≤ q.

    Source: A. Aubry, P. Chartier, *Pseudo-symplectic Runge–Kutta methods*, BIT 38 (1998) 439.
    """
    for n in range(1, equation.max_order + 1):
        if any(defect(equation, tree) for tree in free_trees(structure, n)):
            return n - 1
    return equation.max_order


def modified_hamiltonian(
    equation: ModifiedEquation, structure: Structure
) -> Iterator[HamiltonianTerm]:
    """The terms of the modified Hamiltonian that are not zero, up to the order of symplecticity."""
    for n in range(1, symplectic_order(equation, structure) + 1):
        for tree in free_trees(structure, n):
            coefficient = equation[tree.representative]
            if coefficient:
                yield HamiltonianTerm(tree, coefficient)


def energy_order(equation: ModifiedEquation, structure: Structure) -> int:
    """The order to which steps conserve H = Σ H^{l}, up to that of the largest trees.

    It is the largest r with H(y₁) = H(y₀) + O(h^(r+1)) for all Hamiltonian problems. The modified
    field changes H by Σ_u h^(ρ(u)−1)/σ(u) b(u) H([u]), where [u] is u hung below a vertex of any
    term; rootings at the leaves of one free tree are the same function but for the sign.

    Source: E. Celledoni, R. I. McLachlan, B. Owren, G. R. W. Quispel, *Energy-preserving
    integrators and the structure of B-series*, Found. Comput. Math. 10 (2010) 673.
    """
    for n in range(1, equation.max_order + 1):
        for tree in free_trees(structure, n + 1):
            if tree.has_hamiltonian and _change(equation, tree):
                return n - 1
    return equation.max_order


def _change(equation: ModifiedEquation, tree: FreeTree) -> Number:
    """What multiplies the elementary Hamiltonian of ``tree`` in the change of H."""
    total: Number = ZERO
    for rooting, sign in tree.rootings:
        if len(rooting.branches) == 1:
            (u,) = rooting.branches
            total = total + equation[u] * sign / u.symmetry
    return total
