"""Verdicts on rounded coefficients that do not contradict each other.

Every condition is judged by what rounding does to it, of the conjugate and the pair too, and what
follows from each other exactly is kept:

- a method that is its own conjugate has the orders of the conjugate and of the pair;
- the trees of the pair (Q, P) include those of Q and those of P;
- up to order 2 the conjugate has the order of the method;
- with A^{l,m} 𝟙 = c^{l} the order implies B.
"""

from __future__ import annotations

from collections.abc import Sequence

from garkcli.exact.display import to_ball
from garkcli.frozen import replace
from garkcli.ntrees.tree import Tree
from garkcli.order.certificate import Witness
from garkcli.order.conditions import elementary_weight, is_admissible
from garkcli.order.deciding import AnyOrder
from garkcli.order.rounded import RoundedOrder
from garkcli.order.simplifying import Simplifying
from garkcli.tableau.meant import AnyTableau, printed
from garkcli.tableau.tableau import Tableau


def implied(
    tableau: Tableau,
    conditions: Simplifying,
    order: AnyOrder,
    inconsistent: Sequence[tuple[int, int]],
) -> Simplifying:
    """B at least as far as the order: where nodes are row sums, bushes have its conditions.

    A colour that is linear, or sees no other, has no bushes.
    """
    if inconsistent:
        return conditions
    B = list(conditions.B)
    for l, colour in enumerate(tableau.colours):
        if not colour.is_linear and any(seer == l for seer, _ in tableau.edges()):
            B[l] = max(B[l], order.order)
    return replace(conditions, B=tuple(B))


def agreeing(
    method: AnyTableau,
    order: AnyOrder,
    symplectic: bool,
    conjugated: AnyTableau | None,
    conjugate_order: AnyOrder | None,
    pair_order: AnyOrder | None,
) -> tuple[AnyOrder | None, AnyOrder | None]:
    """The orders of the conjugate and of the pair, so that they agree with that of the method."""
    tableau = printed(method)
    if symplectic:
        return _like(conjugate_order, order), _like(pair_order, order)
    if not isinstance(order, RoundedOrder):
        return conjugate_order, pair_order
    if conjugated is not None and isinstance(conjugate_order, RoundedOrder):
        conjugate_order = _no_earlier(conjugate_order, order, printed(conjugated))
    if pair_order is not None and not tableau.is_partitioned:
        pair_order = _at_most(pair_order, order, 0)
        if conjugate_order is not None:
            pair_order = _at_most(pair_order, conjugate_order, tableau.size)
    return conjugate_order, pair_order


def _like(found: AnyOrder | None, own: AnyOrder) -> AnyOrder | None:
    """What is the method itself within the tolerance has the order of the method."""
    if found is None:
        return None
    is_same = found.order == own.order and found.is_lower_bound == own.is_lower_bound
    return found if is_same else own


def _at_most(pair_order: AnyOrder, part: AnyOrder, shift: int) -> AnyOrder:
    """The order of the pair, no more than that of a part whose colours begin at ``shift``."""
    is_less = part.order < pair_order.order
    is_known = part.order == pair_order.order and pair_order.witness is None
    if not isinstance(part, RoundedOrder) or not (is_less or is_known):
        return pair_order
    if part.witness is None:
        return part
    return replace(part, witness=replace(part.witness, tree=_shifted(part.witness.tree, shift)))


def _no_earlier(found: RoundedOrder, own: RoundedOrder, conjugated: Tableau) -> RoundedOrder:
    """The order of the conjugate: up to 2 it is that of the method.

    Both have the weights b, and b_lᵀ Â^{l,m} 𝟙 = (b_lᵀ𝟙)(b_mᵀ𝟙) − b_mᵀ A^{m,l} 𝟙.
    """
    if found.undecided and found.order < min(own.order, 2):
        known = min(own.order, 2)
        return replace(found, order=known, sizes=own.sizes[:known], means=own.means[:known])
    if own.witness is None or own.order > 1 or found.order <= own.order:
        return found
    tree = own.witness.tree
    if tree.branches:
        tree = Tree(tree.branches[0].root, (Tree(tree.root),))
    if not is_admissible(conjugated, tree):
        return found
    witness = Witness(tree, elementary_weight(conjugated, tree), own.witness.required)
    sizes = (*own.sizes[: own.order], abs(to_ball(witness.residual)))
    return replace(own, witness=witness, sizes=sizes)


def _shifted(tree: Tree, shift: int) -> Tree:
    return Tree(tree.root + shift, tuple(_shifted(branch, shift) for branch in tree.branches))
