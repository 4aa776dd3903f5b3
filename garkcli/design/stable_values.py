"""For which values of its parameter a family is P-, I-, A- or L-stable: the exact set.

What decides are signs of polynomials in the parameter t and in x, the square of hω or of the
imaginary part y. Between the critical t of ``garkcli.exact.projection`` nothing changes, so that
one rational t decides by the ordinary engine. A critical t is decided by itself:

* where some x is known for which a condition is violated at t, by the sign of a polynomial in t;
* A-stability at the end of an interval of it: |P| ≤ |Q| on the imaginary axis and poles that are
  not in the left half plane are kept in the limit, and a pole that moves onto the axis would
  contradict the first unless it cancels;
* I-stability at the end of an interval of it where the zeros of D and of the three conditions on
  the eigenvalues stay as they are: no pole and no double eigenvalue appears;
* otherwise by the ordinary engine over ℚ(t), with the roots among the coefficients.

Of the I-stable values those are P-stable for which the coefficients of 1 − det M in x are zero.
Both often hold at isolated points, which no sampling finds.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Literal, TypeAlias

from flint import fmpq, fmpq_mpoly

from garkcli.design.fewer import Form
from garkcli.design.member import TABLEAUS, Whose
from garkcli.design.stability_kinds import (
    AStability,
    IStability,
    Kind,
    Members,
    SpringStability,
    TwoSprings,
)
from garkcli.errors import NotDecided, UsageProblem, counted
from garkcli.exact.cells import Interval, Point, ends_of, has, sign_of, where
from garkcli.exact.polynomial import Polynomial
from garkcli.exact.roots import RealRoot, sign_at
from garkcli.frozen import Frozen
from garkcli.tableau.family import OSCILLATING, Family, Stability
from garkcli.upward import Shown

Wanted: TypeAlias = Literal["p-stable", "i-stable", "a-stable", "l-stable"]


class StableValues(Shown, Frozen):
    """The values of a parameter for which a family has a kind of stability.

    Attributes:
        family: as it was read.
        whose: which method is meant.
        wanted: which stability.
        found: the set, in ascending order, without the values of ``undecided``.
        undecided: single values that are undecided.
        two_springs: what P- or I-stability is meant on; None for the oscillator.
        colour: which colour alone is driven, counted from 0; None for all of them alike.
        form: the one number, linear in several parameters, that the step depends on, and whose
            values are meant; None for a parameter itself.
        is_apart: whether some of its methods may lack what else the file wants, such as signs.
        is_embedded: whether the stability is that with the embedded weights.
    """

    family: Family
    whose: Whose
    wanted: Wanted
    found: tuple[Interval, ...]
    undecided: tuple[RealRoot, ...]
    two_springs: TwoSprings | None = None
    colour: int | None = None
    form: Form | None = None
    is_apart: bool = False
    is_embedded: bool = False

    @property
    def stability(self) -> Stability:
        """The kind of stability, of which weights and vector fields."""
        return Stability(self.wanted, self.colour, self.is_embedded)

    @property
    def parameter(self) -> str:
        """The name of the parameter, or the number in its place."""
        return self.family.parameters[0] if self.form is None else str(self.form)

    @property
    def has_wishes(self) -> bool:
        """Whether the file asks for more than stability, which every value of the set has."""
        return has_wishes(self.family)

    @property
    def has_values(self) -> bool | None:
        """Whether there are such values; None where that is not decided."""
        if self.found:
            return True
        return None if self.undecided else False

    @property
    def is_everything(self) -> bool:
        """Whether every real number belongs to it."""
        if len(self.found) != 1:
            return False
        return self.found[0].start is None and self.found[0].end is None

    def __repr__(self) -> str:
        parts = counted(len(self.found), "interval")
        return f"<StableValues {self.wanted}: {parts}>"


def has_wishes(family: Family) -> bool:
    """Whether a file asks for more of the parameters than stability."""
    wanted = (*family.relations, *family.nonzero, *family.positive, *family.not_negative)
    return any(p.total_degree() != 0 for p in wanted)


def stable_values(
    family: Family,
    wanted: Wanted,
    whose: Whose = "method",
    two_springs: TwoSprings | None = None,
    colour: int | None = None,
    members: Members | None = None,
) -> StableValues:
    """The set of values of the one free parameter, restricted to what the file wants.

    Args:
        family: of methods, with one free parameter and numbers otherwise.
        wanted: P-stability or I-stability on the oscillator that is split as usual, A-stability or
            L-stability with all vector fields equal.
        whose: of the method, its symplectic conjugate, or its symplectic pair.
        two_springs: P- or I-stability is meant on them.
        colour: A- or L-stability of this colour alone, counted from 0.
        members: its methods, where there are more than those of the family.

    Raises:
        UsageProblem: the stability has no meaning for the method, there are several parameters, or
            roots of a parameter among the coefficients.
        ZeroWeight: a weight is zero for every value, and there is no conjugate.
        NotDecided: the time is not enough.
    """
    members = members or Members(family, whose)
    if len(family.parameters) > 1:
        raise too_many(family)
    _refuse_radicals(members, wanted, two_springs)
    tableau = TABLEAUS[whose](family.tableau)
    along = members.line(family.tableau).along
    (ends,) = family.ranges.values()
    if wanted in OSCILLATING:
        oscillating: IStability | SpringStability
        if two_springs is None:
            oscillating = IStability(members, tableau)
        else:
            oscillating = SpringStability(members, tableau, two_springs)
        found, undecided = decided(oscillating, ends)
        if wanted == "p-stable":
            found, undecided = _conservative(oscillating, found, undecided)
        found, undecided = _wanted(family, along, found, undecided)
        return StableValues(family, whose, wanted, found, undecided, two_springs)
    kind = AStability(members, tableau, colour)
    found, undecided = decided(kind, ends)
    if wanted == "l-stable":
        critical = [*kind.critical, *ends_of(found)]
        stable = found
        found = where(lambda t: has(stable, t) and kind.is_damped(t), critical)
        undecided = tuple(t for t in undecided if kind.is_damped(t))
    found, undecided = _wanted(family, along, found, undecided)
    return StableValues(family, whose, wanted, found, undecided, colour=colour)


def decided(
    kind: Kind, ends: tuple[fmpq | None, fmpq | None]
) -> tuple[tuple[Interval, ...], tuple[RealRoot, ...]]:
    """The set between two ends, and the values that are undecided."""
    decision = _Decision(kind, ends)
    found = decision.run()
    undecided = tuple(decision.undecided)
    return _without(found, undecided), undecided


def _conservative(
    kind: IStability | SpringStability, found: tuple[Interval, ...], undecided: tuple[RealRoot, ...]
) -> tuple[tuple[Interval, ...], tuple[RealRoot, ...]]:
    """The values of a set for which a step has the determinant 1, and the undecided ones."""
    damping = kind.plane.coefficients(kind.signs[0])  # of 1 − det M, times D²

    def is_conservative(t: Point) -> bool:
        return all(sign_of(p, t) == 0 for p in damping)

    critical = [*ends_of(found), *(p for p in damping if p.degree > 0)]
    kept = where(lambda t: is_conservative(t) and has(found, t), critical)
    return kept, tuple(t for t in undecided if is_conservative(t))


def _without(found: Sequence[Interval], undecided: Sequence[RealRoot]) -> tuple[Interval, ...]:
    """A set without values that are not decided."""
    if not undecided:
        return tuple(found)
    critical = [*ends_of(found), *(Polynomial.from_flint(t.polynomial) for t in undecided)]
    return where(lambda t: has(found, t) and t not in undecided, critical)


def _wanted(
    family: Family,
    along: Callable[[fmpq_mpoly], Polynomial],
    found: tuple[Interval, ...],
    undecided: tuple[RealRoot, ...],
) -> tuple[tuple[Interval, ...], tuple[RealRoot, ...]]:
    """The values of a set that the file wants, and the undecided ones among them."""
    asked: list[tuple[Polynomial, frozenset[int]]] = []
    for polynomials, signs in (
        (family.relations, {0}),
        (family.nonzero, {-1, 1}),
        (family.positive, {1}),
        (family.not_negative, {0, 1}),
    ):
        asked += [(along(p), frozenset(signs)) for p in polynomials]
    if not asked:
        return found, undecided

    def is_wanted(t: Point) -> bool:
        return all(sign_of(p, t) in signs for p, signs in asked)

    critical = [*ends_of(found), *(p for p, _ in asked)]
    kept = where(lambda t: is_wanted(t) and has(found, t), critical)
    still_open = tuple(t for t in undecided if is_wanted(t))
    return _without(kept, still_open), still_open


def too_many(family: Family) -> UsageProblem:
    """That only the set of one parameter is found."""
    *_, last = family.parameters
    return UsageProblem(
        f"there are {len(family.parameters)} free parameters, and the set of one is found",
        f"give values to all but one, such as --set {last}=1/2",
        code="free-parameters",
    )


def beside_roots(family: Family, wanted: Wanted, whose: Whose) -> UsageProblem:
    """That there are roots among the coefficients that the set is not found with."""
    message = f"there are roots among the coefficients, beside {family.parameters[0]}"
    cure = "write the method as a family by name, whose nodes are not needed"
    if wanted in OSCILLATING and whose == "pair":
        cure = "add --order P, which takes roots"
    return UsageProblem(message, cure, code="no-radicals")


def _refuse_radicals(members: Members, wanted: Wanted, two_springs: TwoSprings | None) -> None:
    """Refuse a family with roots of its parameter among its coefficients, or of large degrees."""
    family = members.family
    is_number = not any(x.relation.degrees()[0] for x in family.radicals)
    is_on_springs = bool(family.radicals) and two_springs is not None
    if not is_number or is_on_springs or members.constants is None:
        raise beside_roots(family, wanted, members.whose)


class _Decision:
    """One decomposition of the line of a parameter."""

    def __init__(self, kind: Kind, ends: tuple[fmpq | None, fmpq | None]) -> None:
        self.least, self.greatest = ends
        self.kind = kind
        self.undecided: list[RealRoot] = []
        self._known: dict[str, bool] = {}
        self._witnesses: list[fmpq] = []
        self._interior: tuple[Interval, ...] = ()

    def run(self) -> tuple[Interval, ...]:
        """The set; open intervals first, as they tell about their ends."""
        at_ends = [Polynomial([-end, 1]) for end in (self.least, self.greatest) if end is not None]
        poles = [p for p in self.kind.plane.poles if p.degree > 0]
        critical = [p.square_free() for p in self.kind.critical if p.degree > 0]
        critical += at_ends + poles
        self._interior = where(
            lambda t: not isinstance(t, RealRoot) and self._at_rational(t), critical
        )
        return where(self._holds, critical)

    def _holds(self, t: Point) -> bool:
        if not isinstance(t, RealRoot):
            return self._at_rational(t)
        if t.exact is not None:
            return self._at_rational(t.exact)
        poles = self.kind.plane.poles
        if self._is_outside(t) or any(sign_at(p, t) == 0 for p in poles):
            return False
        known = self.kind.members.known(t)
        if known is not None:
            return known
        for x in self._witnesses:
            if any(sign_at(p, t) < 0 for p in self.kind.conditions(x)):
                return False
        is_limit = any(t in (x.start, x.end) for x in self._interior)
        if is_limit and all(sign_at(p, t) for p in self.kind.essential):
            return True
        if self.kind.is_refuted(t):
            return False
        try:
            return self.kind.decide(t)
        except NotDecided as error:
            if error.is_late:
                raise
            self.undecided.append(t)
            return True

    def _is_outside(self, t: Point) -> bool:
        root = t if isinstance(t, RealRoot) else RealRoot.rational(t)
        below = self.least is not None and root < RealRoot.rational(self.least)
        above = self.greatest is not None and RealRoot.rational(self.greatest) < root
        return below or above

    def _at_rational(self, t: fmpq) -> bool:
        if self._is_outside(t):
            return False
        key = str(t)
        if key not in self._known:
            known = self.kind.members.known(t)
            self._known[key] = self.kind.decide(t) if known is None else known
            if known is None and not self._known[key]:
                witness = self.kind.witness(t)
                if witness is not None and witness not in self._witnesses:
                    self._witnesses.append(witness)
        return self._known[key]
