"""The independent order conditions of symplectic methods: one for each free tree that is not
superfluous.

Write Φ(u) = b_lᵀ 𝒜^[u] for the elementary weight and u∘v for u with v as one more branch of its
root. In a symplectic pair b^l_i â^{l,m}_{ij} = b^l_i b^m_j − b^m_j a^{m,l}_{ji}. Put on one edge of
a tree this reads

    Φ(u∘v) + Φ(v∘u) = Φ(u) Φ(v),                                                              (1)

where in v∘u the root has moved across the edge, which carries Â if it carried A, and A if it
carried Â. The numbers 1/γ satisfy (1) as well, for the exact flow is symplectic. So once the
conditions of lower order hold, those of u∘v and v∘u are equivalent, and all rootings of one free
tree give *one* condition. The free tree has a term H^{l} at each vertex, and each edge a direction,
from l to m for A^{l,m}. In a symplectic GARK method Â = A, edges have no direction, and u∘u is
*superfluous*: (1) is 2 Φ(u∘u) = Φ(u)².

Theorem. For every choice of one real number for each free tree of order up to n, the superfluous
ones left out, some symplectic method with nonzero weights has these elementary weights. So no
condition follows from the others, and the rank of the Jacobian of all conditions up to order n is
the number of free trees.

Proof. Let w_{ij} = a^{l,m}_{ij} / b^m_j, free in a pair, and w_{ij} = 1/2 + z_{ij} with z_{ij} =
−z_{ji} in a symplectic GARK method. Up to sign and products of lower weights, Φ(u) is the sum S_T,
over the stages at the vertices of the free tree T of u, of Π b over the vertices times Π w (or z)
over the edges.

(a) The S_T are linearly independent functions of b and w (or z). Take a method with one stage for
each vertex of T: the monomial with each of its vertices and edges once has in S_T the coefficient
|Aut T|, in the sum of any other tree 0. In z automorphisms count with the sign (−1)^(edges turned
round), and S_T is zero exactly when one of them exchanges the ends of an edge, that is, when T is
u∘u.

(b) The attained vectors (S_T) are a subgroup of ℝ^K: two methods side by side, with w (or z) zero
between them, add them, and −b with −w (or −z) negates them.

(c) No linear functional vanishes on all dS, for by (a) it would vanish on S. So enough methods side
by side have a Jacobian of rank K; the subgroup contains an open set, hence is everything. ∎

``docs/symplectic-conditions.md`` says more. Sources: Sanz-Serna and Abia, SIAM J. Numer. Anal. 28
(1991) 1081; Abia and Sanz-Serna, Math. Comp. 60 (1993) 617; Araújo, Murua and Sanz-Serna, SIAM J.
Numer. Anal. 34 (1997) 1926; Hairer, Lubich and Wanner, *Geometric Numerical Integration*, VI.7 and
IX.10.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import cached_property
from typing import Literal, TypeAlias, get_args

from garkcli.frozen import Frozen
from garkcli.ntrees.count import counts_upto
from garkcli.ntrees.free import Grower, Structure
from garkcli.ntrees.tree import Tree

Kind: TypeAlias = Literal["pair", "self-conjugate", "semi-separable", "separable", "nystrom"]

KINDS: tuple[Kind, ...] = get_args(Kind)


def structure_of(kind: Kind, colours: int = 2) -> Structure:
    """The structure of a kind of symplectic method; ValueError for a wrong number N of ``colours``.

    ==============  =============================================  =============================
    kind            problem                                        colours of the trees, from 0
    ==============  =============================================  =============================
    pair            H = Σ H^{l}(q, p), the paper's eq. (varGARK)   V¹…Vᴺ, F¹…Fᴺ
    self-conjugate  y' = Σ f^{l}(y), GARK with Â = A               1…N
    semi-separable  H = H^{1}(q, p) + H^{2}(q)                     V¹, F¹, F²
    separable       H = H^{1}(p) + H^{2}(q)                        V¹, F²
    nystrom         separable with H^{1} quadratic                  V¹, F²
    ==============  =============================================  =============================
    """
    if kind == "pair":
        return Structure.pair(range(colours), range(colours))
    if kind == "self-conjugate":
        return Structure.self_conjugate(colours)
    if colours != 2:
        raise ValueError(f"{kind} problems have 2 terms, not {colours}")
    if kind == "semi-separable":
        return Structure.pair([0], [0, 1])
    return Structure.pair([0], [1], [0] if kind == "nystrom" else [])


class ConditionClass(Frozen):
    """Order conditions that are equivalent given those of lower order: a free tree, ``centred``."""

    centred: Tree
    structure: Structure

    @property
    def order(self) -> int:
        return self.centred.order

    @cached_property
    def representative(self) -> Tree:
        """The rooting at the centroid, or if a quadratic term does not admit it the first one."""
        return next(self._admissible_rootings())

    @cached_property
    def members(self) -> tuple[Tree, ...]:
        """Every rooted tree of the class, sorted, with every colour of the same stages."""
        twins: list[Tree] = []
        for rooting in set(self._admissible_rootings()):
            twins += self.structure.twins(rooting)
        return tuple(sorted(twins, key=Tree.sort_key))

    def _admissible_rootings(self) -> Iterator[Tree]:
        return filter(self.structure.is_admissible, self.structure.rootings(self.centred))

    @property
    def is_superfluous(self) -> bool:
        """Whether the condition follows from those of lower order: the tree is u∘u with Â = A."""
        if self.structure.is_directed or self.order % 2:
            return False
        *rest, half = self.centred.branches
        if 2 * half.order < self.order:
            return False  # one centroid: there are no halves
        return Tree(self.centred.root, rest) == half


def independent_classes(structure: Structure, order: int) -> Iterator[ConditionClass]:
    """The independent conditions of one order, sorted by the trees rooted at the centroid.

    Trees of at most half the order are in memory. ``ValueError`` for an order below 1.

    >>> from garkcli.ntrees.notation import format_tree
    >>> [format_tree(c.representative) for c in independent_classes(Structure.pair([0], [0]), 3)]
    ['[[]_1,[]_1]_1', '[[]_1,[]_2]_1', '[[]_2,[]_2]_1']
    """
    _check(order)
    grower = Grower(structure)
    for root in sorted(structure.leaders.values()):
        for tree in grower.one_centroid(root, order):
            yield ConditionClass(tree, structure)
        for tree in grower.two_centroids(root, order):
            yield ConditionClass(tree, structure)


def superfluous_classes(structure: Structure, order: int) -> Iterator[ConditionClass]:
    """The free trees u∘u of one order, whose conditions follow from lower ones; a pair has none."""
    _check(order)
    if structure.is_directed or order % 2:
        return
    grower = Grower(structure)
    for root in structure.leaders.values():
        for u in grower.planted(root, order // 2):
            yield ConditionClass(Tree(root, (*u.branches, u)), structure)


def count_classes(structure: Structure, order: int) -> int:
    """The number of independent conditions of one order, without generating a tree.

    A free tree with v classes of alike vertices has v − 1 classes of alike edges, or v if an edge
    may be turned round, that is, if it is superfluous. So the number is that of trees with a marked
    vertex minus that of trees with a marked edge (Otter's dissymmetry).

    >>> [count_classes(Structure.pair([0], [0]), n) for n in range(1, 10)]
    [1, 1, 3, 8, 27, 91, 350, 1376, 5743]
    >>> [count_classes(Structure.self_conjugate(1), n) for n in range(1, 10)]
    [1, 0, 1, 1, 3, 4, 11, 19, 47]
    """
    _check(order)
    admissible = structure.admissible
    # [n - 1][colour]: trees that hang from an edge
    halves = counts_upto(admissible, order)
    vertices = edges = 0
    for leader in structure.leaders.values():
        below = admissible.branches[leader]
        upper = [row[leader] for row in halves]
        vertices += upper[order - 1]
        if admissible.is_linear(leader):
            branches = [sum(row[m] for m in below) for row in halves]
            vertices += _pairs(branches, branches, order - 1, same=True)
        for m in below:
            is_from_here = structure.is_directed or m >= leader
            if not (is_from_here and structure.is_forward(m)):
                continue
            same = m == leader and not structure.is_directed
            edges += _pairs(upper, [row[m] for row in halves], order, same)
    return vertices - edges


def _pairs(ones: list[int], others: list[int], total: int, same: bool) -> int:
    ordered = 0
    for k in range(1, total):
        ordered += ones[k - 1] * others[total - k - 1]
    if not same:
        return ordered
    twice = 0  # pairs of a tree with itself
    if total and total % 2 == 0:
        twice = ones[total // 2 - 1]
    return (ordered + twice) // 2


def _check(order: int) -> None:
    if order < 1:
        raise ValueError(f"the order of a tree is at least 1, not {order}")
