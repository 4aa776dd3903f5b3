"""Free trees with signs: what the vector field of a Hamiltonian in trees looks like.

For a problem with f = J⁻¹∇H in each colour a rooted tree u has the elementary Hamiltonian

    H(u) = H^{l (k)}(F(u_1), …, F(u_k)),        u = [u_1, …, u_k] with a root of term l.

When the root moves across one edge only the sign changes, H(u∘v) = −H(v∘u). So there is one for
each free tree T, none for T = u∘u with exchangeable halves, and

    J⁻¹∇H(u) = Σ_v ± F(u_v),

summed over the vertices of T, u_v being the rooting at v, with the sign of its distance from the
root of u: each rooting θ occurs |Aut T|/σ(θ) times.

Source: Hairer, Lubich and Wanner, *Geometric Numerical Integration*, 2nd ed. (2006), lemmas IX.9.5,
IX.9.6 and section IX.10, in one colour and in two.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

from garkcli.stepping.fields import with_joined_terms
from garkcli.tableau.tableau import Tableau
from garkcli.trees.free import Structure
from garkcli.trees.symplectic import ConditionClass, independent_classes, superfluous_classes
from garkcli.trees.tree import Tree


@dataclass(frozen=True)
class FreeTree:
    """A free tree, by its rooting at the centroid.

    Attributes:
        found: it with its structure.
    """

    found: ConditionClass

    @property
    def order(self) -> int:
        """The number of vertices."""
        return self.found.order

    @property
    def structure(self) -> Structure:
        """Its colours."""
        return self.found.structure

    @cached_property
    def representative(self) -> Tree:
        """The rooting that stands for it."""
        return self.found.representative

    @property
    def has_hamiltonian(self) -> bool:
        """Whether its elementary Hamiltonian is not always zero."""
        return not self.found.is_superfluous

    @cached_property
    def rootings(self) -> tuple[tuple[Tree, int], ...]:
        """The rootings with a vector field, each once with its sign, the representative first.

        The root has the first of its colours. Of u∘u each rooting has both signs; one is given.
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
    for found in independent_classes(structure, order):
        yield FreeTree(found)
    for found in superfluous_classes(structure, order):
        yield FreeTree(found)


def hamiltonian_structure(tableau: Tableau) -> Structure | None:
    """The structure of the Hamiltonian problems that a tableau is for, H = Σ H^{l}.

    None where there is none: the root of some tree that the tableau sees cannot move.
    """
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
