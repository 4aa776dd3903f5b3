"""The exact set of values of a parameter for which a family is P-, I-, A- or L-stable.

Signs of polynomials decide, in the parameter t and in x, the square of hω or of the imaginary part
y. Between the critical t of ``garkcli.exact.projection`` nothing changes, so one rational t
decides, by the engine for one method. A critical t is decided on its own:

* by the sign of a polynomial in t, if an x is known at which a condition is violated at t; *
A-stability at the end of an A-stable interval: |P| ≤ |Q| on the imaginary axis and poles that are
  not in the left half plane are kept in the limit, and a pole that moves onto the axis would
  contradict the first unless it cancels;
* I-stability at the end of an I-stable interval if the zeros of D and of the three conditions on
the eigenvalues do not change: no pole and no double eigenvalue appears; * otherwise by the engine
for one method over ℚ(t), with the roots among the coefficients.

An I-stable value is P-stable if all coefficients of 1 − det M in x vanish. Both often hold at
isolated points, which no sampling finds.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Literal, TypeAlias

from flint import fmpq, fmpq_mpoly

from garkcli.design.fewer import LinearForm
from garkcli.design.member import TABLEAUS, Whose
from garkcli.design.stability_kinds import (
    AStability,
    IStability,
    Members,
    SpringStability,
    StabilityKind,
    TwoSprings,
)
from garkcli.errors import NotDecided, UsageProblem, counted
from garkcli.exact.cells import Interval, Point, ends_of, has, sign_of, where
from garkcli.exact.polynomial import Polynomial
from garkcli.exact.roots import RealRoot, sign_at
from garkcli.frozen import Frozen
from garkcli.tableau.family import OSCILLATING, Family, RequiredStability
from garkcli.upward import Shown

Wanted: TypeAlias = Literal["p-stable", "i-stable", "a-stable", "l-stable"]


class StableValues(Shown, Frozen):
    """The values of a parameter for which a family has a kind of stability.

    Attributes:
        family: as read from the file.
        whose: the method, its conjugate, or its pair.
        wanted: the kind of stability.
        found: the set, in ascending order, without the values of ``undecided``.
        undecided: single values that are undecided.
        two_springs: the springs for P- or I-stability; None for the oscillator.
        colour: the colour with λ ≠ 0, counted from 0; None for all colours.
        form: the linear form of several parameters on which the step depends, if the values are of
            it; None for values of the parameter.
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
    form: LinearForm | None = None
    is_apart: bool = False
    is_embedded: bool = False

    @property
    def stability(self) -> RequiredStability:
        """The kind of stability, with its weights and colours."""
        return RequiredStability(self.wanted, self.colour, self.is_embedded)

    @property
    def parameter(self) -> str:
        """The name of the parameter, or the linear form in its place."""
        return self.family.parameters[0] if self.form is None else str(self.form)

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
        """Whether every real number is in the set."""
        if len(self.found) != 1:
            return False
        return self.found[0].start is None and self.found[0].end is None

    def __repr__(self) -> str:
        parts = counted(len(self.found), "interval")
        return f"<StableValues {self.wanted}: {parts}>"


def has_wishes(family: Family) -> bool:
    """Whether a file has wants of the parameters besides stability."""
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
    """The set of stable values of the one free parameter that satisfy the other wants of the file.

    Args:
        family: of methods, with one free parameter and numbers otherwise.
        wanted: P- or I-stability on the oscillator with the usual splitting, A- or L-stability with
            all vector fields equal.
        whose: of the method, its symplectic conjugate, or its symplectic pair.
        two_springs: the springs for P- or I-stability; None for the oscillator.
        colour: A- or L-stability of this colour only, counted from 0.
        members: its methods; None for those of the family.

    Raises:
        UsageProblem: the stability is not applicable, there are several parameters, or roots of a
            parameter among the coefficients.
        ZeroWeight: a weight is zero for every value, so there is no conjugate.
        NotDecided: the time limit has passed.
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
    kind: StabilityKind, ends: tuple[fmpq | None, fmpq | None]
) -> tuple[tuple[Interval, ...], tuple[RealRoot, ...]]:
    """The set between two ends, and the undecided values."""
    decision = _Decision(kind, ends)
    found = decision.run()
    undecided = tuple(decision.undecided)
    return _without(found, undecided), undecided


def _conservative(
    kind: IStability | SpringStability, found: tuple[Interval, ...], undecided: tuple[RealRoot, ...]
) -> tuple[tuple[Interval, ...], tuple[RealRoot, ...]]:
    """The values of a set with det M = 1 for all x, and the undecided ones."""
    damping = kind.plane.coefficients(kind.signs[0])  # of 1 − det M, times D²

    def is_conservative(t: Point) -> bool:
        return all(sign_of(p, t) == 0 for p in damping)

    critical = [*ends_of(found), *(p for p in damping if p.degree > 0)]
    kept = where(lambda t: is_conservative(t) and has(found, t), critical)
    return kept, tuple(t for t in undecided if is_conservative(t))


def _without(found: Sequence[Interval], undecided: Sequence[RealRoot]) -> tuple[Interval, ...]:
    """A set without the undecided values."""
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
    """The values of a set that satisfy the other wants, and the undecided ones among them."""
    constraints: list[tuple[Polynomial, frozenset[int]]] = []
    for polynomials, signs in (
        (family.relations, {0}),
        (family.nonzero, {-1, 1}),
        (family.positive, {1}),
        (family.not_negative, {0, 1}),
    ):
        constraints += [(along(p), frozenset(signs)) for p in polynomials]
    if not constraints:
        return found, undecided

    def is_wanted(t: Point) -> bool:
        return all(sign_of(p, t) in signs for p, signs in constraints)

    critical = [*ends_of(found), *(p for p, _ in constraints)]
    kept = where(lambda t: is_wanted(t) and has(found, t), critical)
    still_open = tuple(t for t in undecided if is_wanted(t))
    return _without(kept, still_open), still_open


def too_many(family: Family) -> UsageProblem:
    """The error that the set is found for one parameter only."""
    *_, last = family.parameters
    return UsageProblem(
        f"there are {len(family.parameters)} free parameters, and the set of one is found",
        f"give values to all but one, such as --set {last}=1/2",
        code="free-parameters",
    )


def beside_roots(family: Family, wanted: Wanted, whose: Whose) -> UsageProblem:
    """The error that the set is not found with roots among the coefficients."""
    message = f"there are roots among the coefficients, beside {family.parameters[0]}"
    cure = "write the method as a family by name, whose nodes are not needed"
    if wanted in OSCILLATING and whose == "pair":
        cure = "add --order P, which takes roots"
    return UsageProblem(message, cure, code="no-radicals")


def _refuse_radicals(members: Members, wanted: Wanted, two_springs: TwoSprings | None) -> None:
    """Raises for a family with roots of its parameter among its coefficients, or of large
    degrees.
    """
    family = members.family
    is_number = not any(x.relation.degrees()[0] for x in family.radicals)
    is_on_springs = bool(family.radicals) and two_springs is not None
    if not is_number or is_on_springs or members.constants is None:
        raise beside_roots(family, wanted, members.whose)


class _Decision:
    """The decomposition of the line of a parameter for one kind of stability."""

    def __init__(self, kind: StabilityKind, ends: tuple[fmpq | None, fmpq | None]) -> None:
        self.least, self.greatest = ends
        self.kind = kind
        self.undecided: list[RealRoot] = []
        self._known: dict[str, bool] = {}
        self._witnesses: list[fmpq] = []
        self._interior: tuple[Interval, ...] = ()

    def run(self) -> tuple[Interval, ...]:
        """The set of stable values; open intervals first, since they help to decide their ends."""
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
