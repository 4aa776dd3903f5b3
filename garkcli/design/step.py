"""What one order asks of the parameters of a family: a kind of answer, its ideal, its solutions."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, TypeAlias

from flint import fmpq_mpoly, fmpz_mpoly

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
        polynomials: that are zero at these values and, but for zeros of ``nonzero``, nowhere else.
        nonzero: polynomials of which none is zero at a method, as far as ``polynomials`` do not say
            it already.
        real: of a family, where its real values satisfy more: an ideal with these alone.
        polynomials_of_real: a basis of that, square-free as ``polynomials``.
        found: the solutions, where there are finitely many; of a family the real ones.
        is_real: of a family and of every value, whether a real value is a method of the file; None
            where that is not decided.
    """

    order: int
    kind: Kind
    ideal: Ideal | None
    witness: Tree | None = None
    polynomials: tuple[fmpq_mpoly | fmpz_mpoly, ...] = ()
    nonzero: tuple[fmpq_mpoly, ...] = ()
    real: Ideal | None = None
    polynomials_of_real: tuple[fmpq_mpoly | fmpz_mpoly, ...] = ()
    found: tuple[Found, ...] = ()
    is_real: bool | None = None

    @property
    def has_methods(self) -> bool | None:
        """Whether methods of the file have the order; None where that is not decided."""
        if self.kind == "undecided":
            return None
        if self.kind in {"every-value", "family"}:
            return self.is_real
        if any(x.accepted and x.order is not None for x in self.found):
            return True
        is_open = any(x.open for x in self.found) or (self.kind == "solutions" and not self.is_all)
        return None if is_open else False

    @property
    def may_have_methods(self) -> bool:
        """Whether there may be values to go on with."""
        return self.kind != "undecided" and self.has_methods is not False

    @property
    def is_all(self) -> bool:
        """Whether there are no other values, not even complex ones: that is proved."""
        return self.ideal is not None and self.ideal.is_proved

    def __repr__(self) -> str:
        return f"<Step order {self.order}: {self.kind}>"
