"""Whether the numbers near a point are in their ranges and have the signs that are wanted."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, Literal, TypeAlias

from flint import arb, ctx, fmpq, fmpq_mpoly

from garkcli.design.admissible import not_negative
from garkcli.design.search.rational import RationalFunction, as_ball
from garkcli.tableau.family import Family

if TYPE_CHECKING:
    from garkcli.design.search.rational import Array

Answer: TypeAlias = Literal["yes", "open", "no"]


class Inside:
    """What the methods of a family are beside solutions of its equations.

    Args:
        family: of methods.
        bits: of the points; what is said is said of all numbers within 2^(−bits/2) of one.
    """

    def __init__(self, family: Family, bits: int) -> None:
        self.family = family
        self.bits = bits
        self.nonzero = self._functions(family.nonzero)
        self.positive = self._functions(family.positive)
        self.not_negative = self._functions(list(not_negative(family)))

    def _functions(self, polynomials: Sequence[fmpq_mpoly]) -> list[RationalFunction]:
        ring = self.family.ring
        one = ring.constant(fmpq(1))
        return [RationalFunction(ring.quotient(p, one), ring) for p in polynomials]

    def decided(self, x: Array) -> Answer:
        """Whether all numbers near a point are so; open where only something that must not be
        negative may be zero.

        Args:
            x: a column of balls without radius.
        """
        with ctx.workprec(self.bits):
            box = x + arb(0, arb(1) / arb(2) ** (self.bits // 2))
            values = dict(zip(self.family.ring.names, box[:, 0], strict=True))
            if not self._is_meant(values):
                return "no"
            if any(_value(f, box).contains(0) for f in self.nonzero):
                return "no"
            if not all(_value(f, box) > 0 for f in self.positive):
                return "no"
            signs = [_value(f, box) for f in self.not_negative]
            if any(value < 0 for value in signs):
                return "no"
            return "yes" if all(value >= 0 for value in signs) else "open"

    def _is_meant(self, values: Mapping[str, arb]) -> bool:
        """Whether roots of polynomials are those that are meant."""
        for radical in self.family.radicals:
            value = values[radical.name]
            meant = radical.meant
            if meant is not None:
                ball = meant.ball(self.bits // 2)
                if not ball.overlaps(value):
                    return False
        return True


def _value(function: RationalFunction, box: Array) -> arb:
    """Over a box; that of a constant is one number, not one for each point."""
    value: Any = function.at(box, as_ball).value
    ball: arb = value if isinstance(value, arb) else value[0]
    return ball
