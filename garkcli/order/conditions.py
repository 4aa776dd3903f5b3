"""Order conditions of a tableau, each with its elementary weight, required value and residual."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from flint import fmpq

from garkcli.exact.field import ZERO, Number
from garkcli.frozen import Frozen, replace
from garkcli.ntrees.tree import Tree
from garkcli.order.admissible import admissible_trees, elementary_weights, twin_roots
from garkcli.order.certificate import required_of
from garkcli.order.meant import AnyTableau, printed
from garkcli.tableau.tableau import Tableau
from garkcli.upward import Shown


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
        """Whether every tree has several colours: no condition of a diagonal method."""
        return all(len(tree.colours) > 1 for tree in self.trees)

    def __repr__(self) -> str:
        what = f"{self.tree}: {self.value}"
        if self.is_exact:
            return f"<Condition {what}>"
        return f"<Condition {what} instead of {self.required}>"


def conditions(method: AnyTableau, trees: Iterable[Tree]) -> Iterator[Condition]:
    for tree, value in elementary_weights(printed(method), trees):
        if isinstance(method, Tableau) or value == required_of(tree):
            yield Condition(tree, value)
        else:
            yield Condition(tree, value, method.allowed(tree), is_met=method.meets(tree))


def all_conditions(method: AnyTableau, order: int) -> Iterator[Condition]:
    """Every condition of ``order``, with the twins of its root; identical conditions occur once."""
    tableau = printed(method)
    twins = twin_roots(tableau)
    for condition in conditions(method, admissible_trees(tableau, order)):
        yield replace(condition, twins=twins[condition.tree.root][1:])
