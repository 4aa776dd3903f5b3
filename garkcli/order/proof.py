"""What decides an order, for a reader who trusts nobody: spanning trees and a witness.

``docs/certificate.md`` says what follows from them.
"""

from __future__ import annotations

from dataclasses import dataclass

from garkcli.order.certificate import DEFAULT_LIMIT, Order, all_spanning_trees, find_order
from garkcli.tableau.tableau import Tableau
from garkcli.trees.tree import Tree


@dataclass(frozen=True)
class Proof:
    """The order of a tableau with what decides it.

    Attributes:
        tableau: whose order it is.
        order: the order, with the tree that fails one higher.
        spanning: ``spanning[k − 1][l]`` are trees of order k with root colour l whose ψ span those
            of all such trees, for k up to the order.
    """

    tableau: Tableau
    order: Order
    spanning: tuple[tuple[tuple[Tree, ...], ...], ...]

    def __repr__(self) -> str:
        return f"<Proof of {self.order!r}>"


def prove(tableau: Tableau, limit: int = DEFAULT_LIMIT) -> Proof:
    """The exact order of a tableau and what decides it; no order beyond ``limit`` is looked for."""
    found = find_order(tableau, limit)
    orders = range(1, found.order + 1)
    return Proof(tableau, found, tuple(all_spanning_trees(tableau, orders)))
