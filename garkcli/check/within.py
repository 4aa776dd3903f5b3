"""The analysis of a method with rounded coefficients: verdicts that do not contradict each other.

The conditions of the method itself are met within the tolerance t of its file. The conjugate and
the pair are computed from the coefficients, so their conditions are met within t and what rounding
by t does to them, ``order.propagation``. What follows from each other exactly is kept:

- a method that is its own conjugate has the orders of the conjugate and of the pair;
- the trees of the pair (Q, P) include those of Q and those of P;
- below order 2 the conjugate has the order of the method;
- no bound exceeds the order;
- with A^{l,m} 𝟙 = c^{l} the order implies B.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from flint import arb, ctx, fmpq

from garkcli.check.analysis import (
    Analysis,
    conjugate_and_pair,
    inconsistent_blocks,
    is_pair_of_itself,
    nonautonomous,
)
from garkcli.exact.display import to_ball
from garkcli.exact.field import Number
from garkcli.order.certificate import Witness
from garkcli.order.conditions import elementary_weight, is_admissible
from garkcli.order.defects import Defects, is_symplectic_within
from garkcli.order.propagation import ConjugateRounding, Propagation, conjugate_rounding
from garkcli.order.rounded import Effect, RoundedOrder, find_order_within
from garkcli.order.simplifying import Simplifying, Table, simplifying
from garkcli.order.suggestion import suggest_wider
from garkcli.order.tolerance import TINY, form_entries, rounded_up, within
from garkcli.tableau.conjugate import symplectic_defect
from garkcli.tableau.point_space import PointSpace
from garkcli.tableau.tableau import Tableau
from garkcli.trees.tree import Tree


def analyse_within(tableau: Tableau, tolerance: fmpq, limit: int) -> Analysis:
    """Decide everything that ``gark check`` reports, for coefficients rounded by ``tolerance``.

    Args:
        tableau: the method.
        tolerance: t > 0.
        limit: where the search for orders stops.
    """
    conjugated, both, obstacle = conjugate_and_pair(tableau)
    rounding = None if both is None else conjugate_rounding(tableau, tolerance)
    order = find_order_within(tableau, tolerance, limit)
    inconsistent = inconsistent_blocks(tableau, tolerance)
    conditions = simplifying(tableau, limit, tolerance)
    if not inconsistent:
        B = _implied(tableau, conditions.B, order.order, tolerance)
        conditions = replace(conditions, B=B)
    symplectic = is_symplectic_within(tableau, tolerance)
    symplectic = symplectic and _explained(tableau, rounding)
    hat = _conjugate_part(conjugated, rounding, tolerance, limit)
    both_parts = _pair_part(tableau, both, rounding, order, limit)
    hat, both_parts = _agreeing(tableau, order, symplectic, hat, both_parts)
    pair_conditions = _pair_conditions(tableau, both_parts, conditions, limit)
    pair_order, pair_bound, pair_sharp_bound = None, None, None
    if both_parts is not None and pair_conditions is not None:
        pair_order = both_parts.order
        pair_bound = _capped(pair_conditions.bound, pair_order)
        pair_sharp_bound = _capped(pair_conditions.sharp_bound, pair_order)

    def find(timed: Tableau) -> RoundedOrder:
        return find_order_within(timed, tolerance, limit)

    return Analysis(
        tableau=tableau,
        order=order,
        simplifying=conditions,
        inconsistent=inconsistent,
        symplectic=symplectic,
        conjugate=conjugated,
        conjugate_order=hat.order if hat else None,
        conjugate_inconsistent=_conjugate_nodes(hat, symplectic, inconsistent),
        pair=both,
        pair_order=pair_order,
        pair_simplifying=pair_conditions,
        bound=_capped(conditions.bound, order),
        pair_bound=pair_bound,
        sharp_bound=_capped(conditions.sharp_bound, order),
        pair_sharp_bound=pair_sharp_bound,
        obstacle=obstacle,
        limit=limit,
        tolerance=tolerance,
        nonautonomous_order=nonautonomous(tableau, order, inconsistent, find),
        suggestion=suggest_wider(tableau, order, limit),
    )


def _capped(bound: int, order: RoundedOrder) -> int:
    """A bound, as far as the order bears it out."""
    return min(bound, order.order)


@dataclass(frozen=True)
class _Derived:
    """The conjugate or the pair, its order, and the tolerance for its entries."""

    tableau: Tableau
    order: RoundedOrder
    tolerance: fmpq

    @staticmethod
    def of(tableau: Tableau, made: Propagation | None, tolerance: fmpq, limit: int) -> _Derived:
        """Its order within what rounding explains; ``made`` is None where nothing is known."""
        effect: Effect = made.effect if made else _unknown
        order = find_order_within(tableau, tolerance, limit, effect)
        if made is None:
            return _Derived(tableau, order, tolerance)
        wider = tolerance + rounded_up(made.largest_row_sum())
        return _Derived(tableau, order, wider if wider <= TINY else tolerance)


def _conjugate_part(
    conjugated: Tableau | None, rounding: ConjugateRounding | None, tolerance: fmpq, limit: int
) -> _Derived | None:
    if conjugated is None:
        return None
    made = rounding.of_conjugate(conjugated) if rounding else None
    return _Derived.of(conjugated, made, tolerance, limit)


def _pair_part(
    tableau: Tableau,
    both: Tableau | None,
    rounding: ConjugateRounding | None,
    order: RoundedOrder,
    limit: int,
) -> _Derived | None:
    if both is None:
        return None
    if is_pair_of_itself(tableau, both):
        return _Derived(both, order, order.tolerance)
    made = rounding.of_pair(both) if rounding else None
    return _Derived.of(both, made, order.tolerance, limit)


def _pair_conditions(
    tableau: Tableau, both: _Derived | None, own: Simplifying, limit: int
) -> Simplifying | None:
    """B, C and D of the pair; those of the method, ``own``, are parts of them."""
    if both is None:
        return None
    found = simplifying(both.tableau, limit, both.tolerance)
    if tableau.is_partitioned:
        return found
    return _with_own(found, own)


def _agreeing(
    tableau: Tableau,
    order: RoundedOrder,
    symplectic: bool,
    hat: _Derived | None,
    both: _Derived | None,
) -> tuple[_Derived | None, _Derived | None]:
    """The conjugate and the pair with orders that agree with that of the method."""
    if symplectic:
        return _like(hat, order), _like(both, order)
    if hat is not None:
        hat = replace(hat, order=_no_earlier(hat.order, order, hat.tableau))
    if both is not None and not tableau.is_partitioned:
        both = replace(both, order=_at_most(both.order, order, 0))
        if hat is not None:
            both = replace(both, order=_at_most(both.order, hat.order, tableau.size))
    return hat, both


def _unknown(_: int) -> arb | None:
    """What rounding does where a weight might be zero."""
    return None


def _explained(tableau: Tableau, rounding: ConjugateRounding | None) -> bool:
    """Whether rounding takes the method to its own conjugate entry by entry.

    A defect b_i (a_ij − Â_ij) may be within t because b_i is small, with entries that differ by far
    more than t.
    """
    if rounding is None:
        return True
    for l, m in rounding.hats:
        defect = symplectic_defect(tableau, l, m)
        entries = form_entries(tableau.space(l), tableau.space(m), defect)
        if not rounding.explains(l, m, entries):
            return False
    return True


def _like(derived: _Derived | None, own: RoundedOrder) -> _Derived | None:
    """What is the method itself within the tolerance has the order of the method."""
    if derived is None:
        return None
    found = derived.order
    is_same = found.order == own.order and found.is_lower_bound == own.is_lower_bound
    return derived if is_same else replace(derived, order=own)


def _at_most(pair_order: RoundedOrder, part: RoundedOrder, shift: int) -> RoundedOrder:
    """The order of the pair, no more than that of a part whose colours begin at ``shift``."""
    if part.order > pair_order.order:
        return pair_order
    if part.order == pair_order.order and pair_order.witness is not None:
        return pair_order
    sizes = pair_order.sizes[: part.order]
    means = pair_order.means[: part.order]
    witness = part.witness
    if witness is not None:
        tree = _shifted(witness.tree, shift)
        witness = Witness(tree, witness.value, witness.required)
        sizes = (*sizes, abs(to_ball(witness.residual)))
        means = (*means, part.means[-1])
    return RoundedOrder(
        part.order, pair_order.tolerance, witness, part.undecided, sizes, means, part.doubt
    )


def _no_earlier(found: RoundedOrder, own: RoundedOrder, conjugated: Tableau) -> RoundedOrder:
    """The order of the conjugate: below 2 it is that of the method.

    Both have the weights b, and b_lᵀ Â^{l,m} 𝟙 = (b_lᵀ𝟙)(b_mᵀ𝟙) − b_mᵀ A^{m,l} 𝟙.
    """
    if own.witness is None or own.order > 1 or found.order <= own.order:
        return found
    tree = own.witness.tree
    if tree.branches:
        tree = Tree(tree.branches[0].root, (Tree(tree.root),))
    if not is_admissible(conjugated, tree):
        return found
    witness = Witness(tree, elementary_weight(conjugated, tree), own.witness.required)
    sizes = (*found.sizes[: own.order], abs(to_ball(witness.residual)))
    means = (*found.means[: own.order], own.means[-1])
    return RoundedOrder(own.order, found.tolerance, witness, False, sizes, means)


def _shifted(tree: Tree, shift: int) -> Tree:
    branches = tuple(_shifted(branch, shift) for branch in tree.branches)
    return Tree(tree.root + shift, branches)


def _with_own(both: Simplifying, own: Simplifying) -> Simplifying:
    """The conditions of the pair, where those of the method are as they were found for it."""
    N = len(own.B)

    def mixed(table: Table, part: Table) -> Table:
        return tuple((*part[l % N], *row[N:]) for l, row in enumerate(table))

    return Simplifying(own.B * 2, mixed(both.C, own.C), mixed(both.D, own.D))


def _conjugate_nodes(
    derived: _Derived | None, symplectic: bool, inconsistent: tuple[tuple[int, int], ...]
) -> tuple[tuple[int, int], ...]:
    """The blocks with Â^{l,m} 𝟙 ≠ c^{l}."""
    if derived is None:
        return ()
    if symplectic:
        return inconsistent
    return inconsistent_blocks(derived.tableau, derived.tolerance)


def _implied(tableau: Tableau, B: tuple[int, ...], order: int, tolerance: fmpq) -> tuple[int, ...]:
    """B as far as the order implies it: b c^(k−1) is off by what the rounding of c adds.

    That is at most t (k−1) Σ |b_i| (|c_i| + t)^(k−2).
    """
    defects = Defects(tableau)
    found = []
    for l, r in enumerate(B):
        if not isinstance(tableau.space(l), PointSpace):
            found.append(r)
            continue
        while r < order:
            wider = tolerance + _nodes_effect(tableau, l, r + 1, tolerance)
            if not within(defects.B(l, r + 1), wider):
                break
            r += 1
        found.append(r)
    return tuple(found)


def _nodes_effect(tableau: Tableau, l: int, k: int, tolerance: fmpq) -> fmpq:
    colour = tableau.colours[l]
    with ctx.workprec(128):
        total = arb(0)
        for b, c in zip(colour.b, colour.c, strict=True):
            total += _size(b) * (_size(c) + arb(tolerance)) ** max(k - 2, 0)
        return rounded_up((k - 1) * tolerance * total)


def _size(number: Number) -> arb:
    return abs(to_ball(number, 30))
