"""The values of one or two parameters for which a family is stable.

They are intervals of the first, and over each of them, if there is a second, its values, whose ends
are functions of the first.
"""

from __future__ import annotations

from typing import Any, Literal, TypeAlias

from flint import arb, ctx, fmpq, fmpq_mpoly

from garkcli.deadline import check_time
from garkcli.design.fewer import LinearForm
from garkcli.design.member import Whose
from garkcli.design.stability_kinds import TwoSprings
from garkcli.errors import counted
from garkcli.exact import projection
from garkcli.exact.cells import Interval
from garkcli.exact.parametric import evaluated
from garkcli.exact.polynomial import Polynomial, in_one
from garkcli.exact.roots import RealRoot, real_roots, sign_at
from garkcli.frozen import Frozen
from garkcli.tableau.family import Family, RequiredStability
from garkcli.upward import Shown

Wanted: TypeAlias = Literal["p-stable", "i-stable", "a-stable", "l-stable"]


class Branch(Frozen, eq=False):
    """A branch of p(y, t) = 0 as a function of t: root ``number`` of ``count`` in y, from below."""

    curve: fmpq_mpoly
    number: int
    count: int

    def __eq__(self, other: object) -> bool:
        return (
            isinstance(other, Branch)
            and str(self.curve) == str(other.curve)
            and (self.number, self.count) == (other.number, other.count)
        )

    __hash__ = None  # type: ignore[assignment]

    def formula(self) -> tuple[Polynomial, Polynomial] | None:
        if self.curve.degrees()[0] > 1:
            return None
        return -projection.in_t(projection.coefficient_of(self.curve, 0)), projection.in_t(
            projection.coefficient_of(self.curve, 1)
        )

    def at(self, t: RealRoot) -> RealRoot | None:
        """The root at t, at an end of the strip as a limit; None if roots meet or are infinite
        there.
        """
        degree = self.curve.degrees()[0]
        critical = [
            projection.leading(self.curve),
            *([projection.discriminant(self.curve)] if degree > 1 else []),
        ]
        if any(sign_at(projection.in_t(p), t) == 0 for p in critical):
            return None
        candidates = [
            y
            for y, _ in real_roots(
                in_one(projection.resultant(self.curve, projection.of_root(t), "t"))
            )
        ]
        bits = 64
        while len(candidates) > self.count:
            check_time()
            with ctx.workprec(2 * bits):
                x = t.ball(bits)
                candidates = [
                    y for y in candidates if _value(self.curve, [y.ball(bits), x]).overlaps(arb(0))
                ]
            bits *= 2
        return candidates[self.number]


def _value(x: Any, at: list[arb]) -> arb:
    # of a polynomial, or of the numerator of a number
    if isinstance(x, fmpq):
        return arb(x)
    return arb(evaluated(x if isinstance(x, fmpq_mpoly) else x.numerator, at))


End: TypeAlias = "Branch | RealRoot | None"
"""An end of a set of y: a function of t, a number over a single t, or None for infinity."""


class StripPart(Frozen):
    """An interval of y over a strip."""

    start: End
    end: End
    has_start: bool
    has_end: bool

    def over(self, t: RealRoot) -> Interval | None:
        ends: list[RealRoot | None] = []
        for end in (self.start, self.end):
            value = end.at(t) if isinstance(end, Branch) else end
            if end is not None and value is None:
                return None
            ends.append(value)
        return Interval(ends[0], ends[1], self.has_start, self.has_end)


class Strip(Interval):
    """An interval of the first parameter, and the values of the second over it, from below."""

    parts: tuple[StripPart, ...] = ()


class StableValues(Shown, Frozen):
    """The values of one or two parameters for which a family has a kind of stability.

    Attributes:
        family: as read from the file.
        whose: the method, its conjugate, or its pair.
        wanted: the kind of stability.
        found: the set, in ascending order of the first parameter: intervals of one parameter, or
            strips of two.
        undecided: single values of the first parameter that are undecided; none is in ``found``.
        two_springs: the springs for P- or I-stability; None for the oscillator.
        colour: the colour with λ ≠ 0, counted from 0; None for all colours.
        forms: the linear forms of several parameters on which the step depends, if the values are
            of them; empty for values of the parameters.
        is_apart: whether some of its methods may fail other wants of the file, such as signs.
        is_embedded: whether the stability is of the embedded weights.
    """

    family: Family
    whose: Whose
    wanted: Wanted
    found: tuple[Interval, ...]
    undecided: tuple[RealRoot, ...]
    two_springs: TwoSprings | None = None
    colour: int | None = None
    forms: tuple[LinearForm, ...] = ()
    is_apart: bool = False
    is_embedded: bool = False

    @property
    def stability(self) -> RequiredStability:
        """The kind of stability, with its weights and colours."""
        return RequiredStability(self.wanted, self.colour, self.is_embedded)

    @property
    def names(self) -> tuple[str, ...]:
        """The names of the parameters, or the linear forms in their place."""
        return tuple(map(str, self.forms)) or self.family.parameters

    @property
    def is_plane(self) -> bool:
        """Whether the values are those of two parameters."""
        return len(self.names) > 1

    @property
    def strips(self) -> tuple[Strip, ...]:
        """The set in a plane."""
        return tuple(x for x in self.found if isinstance(x, Strip))

    @property
    def has_wishes(self) -> bool:
        """Whether the file has other wants, which every value of the set satisfies."""
        return has_wishes(self.family)

    @property
    def has_values(self) -> bool | None:
        """Whether there are such values; None if undecided."""
        if self.found:
            return True
        return None if self.undecided else False

    @property
    def is_everything(self) -> bool:
        """Whether every value is in the set."""
        if len(self.found) != 1:
            return False
        parts = self.strips[0].parts if self.is_plane else self.found
        return all((x.start, x.end) == (None, None) for x in (*self.found, *parts))

    def __repr__(self) -> str:
        parts = counted(len(self.found), "strip" if self.is_plane else "interval")
        return f"<StableValues {self.wanted}: {parts}>"


def has_wishes(family: Family) -> bool:
    wanted = (*family.relations, *family.nonzero, *family.positive, *family.not_negative)
    return any(p.total_degree() != 0 for p in wanted)
