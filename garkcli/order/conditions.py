"""Order conditions of a tableau, each with its elementary weight, required value and residual."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import TYPE_CHECKING, TypeAlias

from flint import fmpq

from garkcli.errors import MethodError
from garkcli.exact.field import ZERO, Number
from garkcli.exact.matrix import Vector, apply, dot
from garkcli.frozen import Frozen, replace
from garkcli.ntrees.count import Admissible, counts_of
from garkcli.ntrees.listing import trees_of
from garkcli.ntrees.tree import Tree
from garkcli.order.certificate import required_of
from garkcli.tableau.tableau import Colour, Tableau
from garkcli.upward import Shown

if TYPE_CHECKING:
    from garkcli.order.meant import AnyTableau

_Place: TypeAlias = tuple[int, Tree]
"""The stage space that sees a branch, and the branch."""

_CURE = "gark conditions FILE lists the trees of a method"


class TreeVectors:
    """Stage vectors of single trees of a tableau of numbers, polynomials or balls; images of
    branches are cached.
    """

    def __init__(self, tableau: Tableau) -> None:
        self.tableau = tableau
        self._images: dict[_Place, Vector] = {}

    def of(self, tree: Tree) -> Vector:
        """𝒜^[u], eqs. (Ataul) and (Au).

        Raises:
            MethodError: the coupling graph does not admit the tree.
        """
        colour = self.tableau.colours[tree.root]
        if not colour.kind.allows(len(tree.branches)):
            message = f"colour {colour.name} is linear: its vertices have one branch at most"
            if not colour.is_linear:
                message = f"the vertices of colour {colour.name} have {colour.kind.branches}"
            raise MethodError(message, _CURE, code="tree-not-admissible")
        space = self.tableau.space(tree.root)
        vector = space.one
        for branch in tree.branches:
            vector = space.product(vector, self.image(tree.root, branch))
        return vector

    def image(self, l: int, branch: Tree) -> Vector:
        """A 𝒜^[u] of a branch u, as the stages of a colour see it."""
        colour = self.tableau.colours[l]
        place = colour.space, branch
        if place not in self._images:
            block = self.tableau.blocks.get((colour.space, branch.root))
            if block is None:
                seen = self.tableau.colours[branch.root]
                raise MethodError(
                    f"colour {colour.name} does not see colour {seen.name}: "
                    "the tree is not admissible",
                    _CURE,
                    code="tree-not-admissible",
                )
            self._images[place] = apply(block, self.of(branch))
        return self._images[place]


class Condition(Shown, Frozen):
    """The order condition b_lᵀ 𝒜^[u] = 1/γ(u) of one tree, eq. (bA).

    Attributes:
        tree: u, with colours counted from 0.
        value: the elementary weight b_lᵀ 𝒜^[u], exact.
        allowed: the largest change of the value by rounding of the coefficients; zero for exact
            ones.
        is_met: whether the rounded method is taken to meet it; False for exact ones.
        twins: further root colours that give the same condition, as they share stages and weights.

    >>> from garkcli import conditions
    >>> (condition,) = conditions("heun", ["[[[]]]"])
    >>> condition
    <Condition [[[]]]: 0 instead of 1/6>
    >>> condition.holds, condition.residual
    (False, -1/6)
    """

    tree: Tree
    value: Number
    allowed: fmpq = ZERO
    twins: tuple[int, ...] = ()
    is_met: bool = False

    @property
    def required(self) -> fmpq:
        """1/γ(u), or 0 if the exact solution has no such tree."""
        return required_of(self.tree)

    @property
    def residual(self) -> Number:
        """The value minus the required one."""
        return self.value - self.required

    @property
    def holds(self) -> bool:
        """Whether the residual is zero, exactly or for the method that is rounded."""
        return self.is_exact or self.is_met

    @property
    def is_exact(self) -> bool:
        """Whether the residual is exactly zero."""
        return not self.residual

    @property
    def trees(self) -> tuple[Tree, ...]:
        """The tree with its own root colour and with those of its twins."""
        return (self.tree, *[Tree(l, self.tree.branches, self.tree.kind) for l in self.twins])

    @property
    def is_coupling(self) -> bool:
        """Whether every tree has more than one colour; otherwise the condition is one of a diagonal
        method.
        """
        return all(len(tree.colours) > 1 for tree in self.trees)

    def __repr__(self) -> str:
        what = f"{self.tree}: {self.value}"
        if self.is_exact:
            return f"<Condition {what}>"
        return f"<Condition {what} instead of {self.required}>"


def conditions(method: AnyTableau, trees: Iterable[Tree]) -> Iterator[Condition]:
    """The conditions of ``trees`` for a tableau; stage vectors of shared branches are computed
    once.

    Raises:
        MethodError: a tree that the coupling graph does not admit, or beyond the order up to which
            the conditions are known.
    """
    tableau = method if isinstance(method, Tableau) else method.tableau
    vectors = TreeVectors(tableau)
    most = tableau.exact_to
    for tree in map(tableau.known, trees):
        if most is not None and tree.order > most:
            message = f"the conditions of this method are known up to order {most}"
            cure = f"choose trees of at most {most} vertices"
            raise MethodError(message, cure, code="too-many")
        value = dot(tableau.colours[tree.root].b, vectors.of(tree))
        if isinstance(method, Tableau) or value == required_of(tree):
            yield Condition(tree, value)
        else:
            yield Condition(tree, value, method.allowed(tree), is_met=method.meets(tree))


def elementary_weight(tableau: Tableau, tree: Tree) -> Number:
    """b_lᵀ 𝒜^[u], exact.

    Raises:
        MethodError: the coupling graph does not admit the tree.
    """
    return next(conditions(tableau, [tree])).value


def is_admissible(tableau: Tableau, tree: Tree) -> bool:
    """Whether every vertex sees its branches and may have as many."""
    if not tableau.colours[tree.root].kind.allows(len(tree.branches)):
        return False
    for branch in tree.branches:
        if tableau.block(tree.root, branch.root) is None:
            return False
        if not is_admissible(tableau, branch):
            return False
    return True


def coupling_graph(tableau: Tableau) -> Admissible:
    """The admissible trees of a tableau: which colours see which, and the kinds of their
    vertices.
    """
    colours = range(tableau.size)
    branches = tuple(tuple(m for m in colours if tableau.block(l, m) is not None) for l in colours)
    return Admissible(tableau.size, branches, tuple(colour.kind for colour in tableau.colours))


def are_few(tableau: Tableau, order: int, most: int) -> bool:
    """Whether the trees of an order can be listed and are at most ``most``."""
    return tableau.is_listed and sum(counts_of(coupling_graph(tableau), order)) <= most


def twin_roots(tableau: Tableau) -> dict[int, tuple[int, ...]]:
    """Groups of root colours with identical conditions, by their first colour; colours without
    conditions are left out. Colours with the same stages and weights, such as V^l and F^l of the
    symplectic pair, give every tree the same elementary weight.
    """
    groups: dict[int, tuple[int, ...]] = {}
    for l in tableau.roots:
        colour = tableau.colours[l]
        for first in groups:
            if _are_twins(colour, tableau.colours[first]):
                groups[first] += (l,)
                break
        else:
            groups[l] = (l,)
    return groups


def _are_twins(one: Colour, other: Colour) -> bool:
    """Whether two colours share stages, weights and the kind of their vertices."""
    if (one.space, one.kind, one.late) != (other.space, other.kind, other.late):
        return False
    return one.b == other.b


def count_conditions(tableau: Tableau, order: int) -> int:
    """The number of conditions of ``order``, those of twin roots counted once."""
    by_root = counts_of(coupling_graph(tableau), order)
    return sum(by_root[root] for root in twin_roots(tableau))


def all_conditions(method: AnyTableau, order: int) -> Iterator[Condition]:
    """Every condition of ``order``, with the twins of its root; identical conditions occur once."""
    tableau = method if isinstance(method, Tableau) else method.tableau
    twins = twin_roots(tableau)
    for condition in conditions(method, admissible_trees(tableau, order)):
        yield replace(condition, twins=twins[condition.tree.root][1:])


def admissible_trees(tableau: Tableau, order: int) -> Iterator[Tree]:
    """The admissible trees of ``order``, with one root colour of each group of twins."""
    return trees_of(coupling_graph(tableau), order, twin_roots(tableau))
