"""What one order asks of the parameters of a family: a kind of answer, its ideal, its solutions."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, TypeAlias

from garkcli.design.ideal import Ideal
from garkcli.design.solutions import Solution
from garkcli.order.certificate import Order
from garkcli.trees.tree import Tree

Kind: TypeAlias = Literal["every-value", "solutions", "family", "none", "undecided"]


@dataclass(frozen=True)
class Found:
    """A solution with what the ordinary certificate says of it.

    Attributes:
        solution: the values of the parameters, with their conjugates over ℚ.
        order: the exact order of the method that they make; None where a weight or a denominator is
            zero, and then there is no such method.
        accepted: which of the real roots of the solution are within the ranges of the file, and as
            stable as is wanted.
        unstable: which of them would be, but are not stable.
        open: which of them are not decided to be stable, as their field is too large.
    """

    solution: Solution
    order: Order | None
    accepted: tuple[int, ...]
    unstable: tuple[int, ...] = ()
    open: tuple[int, ...] = ()


@dataclass(frozen=True)
class Step:
    """What an order asks of the parameters.

    Attributes:
        order: the order.
        kind: for which values it is reached.
        ideal: the ideal of its conditions and of all lower ones; None where it was not found. Where
            it is not proved it is msolve's: each zero has the order, that there are no others is
            not proved.
        witness: the first tree whose condition no value meets together with those before it; None
            where what is wanted besides the order cannot be met.
        found: the solutions, where there are finitely many.
    """

    order: int
    kind: Kind
    ideal: Ideal | None
    witness: Tree | None = None
    found: tuple[Found, ...] = ()

    @property
    def may_have_methods(self) -> bool:
        """Whether there are values to go on with: of a family that is not looked into."""
        if self.kind in {"every-value", "family"}:
            return True
        return any(x.accepted and x.order is not None for x in self.found)

    def __repr__(self) -> str:
        return f"<Step order {self.order}: {self.kind}>"
