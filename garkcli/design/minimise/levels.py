"""The greatest level on a part of the line, exactly.

The level L(t) is the first y > 0 at which the sign of a polynomial p(y, t) changes, or 0, or
infinite. Between the t of ``garkcli.exact.projection`` and those where a curve p = 0 has a
horizontal tangent L is one branch of a curve, and that is monotone. So the greatest value is
reached at such a t, or it is approached there without being reached: L may jump. That is then
decided once more, without this argument: with the greatest value m found so far, L − m has one sign
between the t at which p(m, t) = 0 for some p, and one t each decides. L at a critical t itself is
computed there, or nothing is said of it.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from itertools import groupby, pairwise

from flint import fmpq, fmpq_mpoly

from garkcli.design.minimise.line import Conditions, Toward
from garkcli.design.minimise.objective import ORIGIN, Size
from garkcli.exact.cells import Point, between
from garkcli.exact.field import ZERO, Number
from garkcli.exact.polynomial import Polynomial
from garkcli.exact.projection import PLANE, curves, in_t, projected
from garkcli.exact.root_number import number_of
from garkcli.exact.roots import RealRoot, real_roots

MOST_DEGREE = 6
"""Parameters and levels of a larger degree are not put into methods."""


@dataclass(frozen=True)
class HighAt:
    """The level at an allowed number.

    Attributes:
        level: there.
        t: the number.
        is_sample: whether it is one of an interval without critical numbers.
    """

    level: Size
    t: RealRoot
    is_sample: bool = False


@dataclass(frozen=True)
class Levels:
    """What there is to be compared.

    Attributes:
        attained: the greatest level at critical numbers and between them, once for each interval.
        limits: of a larger one that is approached where it is not attained.
        is_decided: whether nothing larger is to be found.
        is_greatest: whether no interval has a larger one: at a sample with the greatest level it
            is then the same nearby.
    """

    attained: tuple[HighAt, ...]
    limits: tuple[Toward, ...]
    is_decided: bool
    is_greatest: bool = False


def height(level: Size) -> tuple[bool, RealRoot]:
    """A key to compare levels by."""
    return level is None, ORIGIN if level is None else level


def on_levels(
    level: Callable[[Number], Size], polynomials: Sequence[fmpq_mpoly], allowed: Conditions
) -> Levels:
    """The candidates for the greatest level.

    Args:
        level: of one value of the parameter t.
        polynomials: at whose zeros (y, t) the level can be.
        allowed: which t.
    """
    found = curves(polynomials)
    ends = allowed.polynomials
    critical = [*projected(found, [ZERO]), *_stationary(found), *ends]
    attained = []
    open_points = set()
    points = _roots(critical)
    for t in _in_turn(points):
        if not allowed.hold(t):
            continue
        if not isinstance(t, RealRoot):
            root = RealRoot.rational(t)
            attained.append(HighAt(level(t), root, is_sample=True))
            continue
        number = number_of(t, MOST_DEGREE)
        if number is None:
            open_points.add(t)
        else:
            attained.append(HighAt(level(number), t))
    is_decided = not open_points
    if not attained:
        return Levels((), (), is_decided)
    greatest = max((x.level for x in attained), key=height)
    best = _representatives(attained, greatest)
    if greatest is None:
        return Levels(best, (), is_decided=True, is_greatest=True)
    crossing = _crossing(found, greatest)
    if crossing is None:
        return Levels(best, (), is_decided=False)
    points = _roots([*critical, *crossing])
    for left, right in _cells(points):
        sample = between(left, right)
        if allowed.hold(sample) and height(level(sample)) > height(greatest):
            limits = tuple(
                toward
                for toward in _approached(level, found, allowed, critical)
                if height(toward.value) > height(greatest) and toward.end not in open_points
            )
            return Levels(best, limits, is_decided)
    # the sign of L − m decides between critical t, not what L is at one that was left out
    return Levels(best, (), is_decided, is_greatest=True)


def _approached(
    level: Callable[[Number], Size],
    found: Sequence[fmpq_mpoly],
    allowed: Conditions,
    critical: Sequence[Polynomial],
) -> tuple[Toward, ...]:
    """The limits at ends of intervals, allowed or not, where the level grows towards these."""
    limits = []
    for left, right in _cells(_roots(critical)):
        if not allowed.hold(between(left, right)):
            continue
        for end, is_right in ((left, False), (right, True)):
            near = _Near(level, found, critical, (left, right), is_right)
            if near.is_growing():
                limits.append(Toward(near.limit(), end, is_right))
    return tuple(limits)


class _Near:
    """The levels near an end of a cell.

    A branch comes near to a zero of the coefficient of the highest power of t at infinity, of
    p(y, t) at another end t, or to infinity. Near enough to the end no branch crosses any of these.
    """

    def __init__(
        self,
        level: Callable[[Number], Size],
        found: Sequence[fmpq_mpoly],
        critical: Sequence[Polynomial],
        cell: tuple[RealRoot | None, RealRoot | None],
        is_right: bool,
    ) -> None:
        left, right = cell
        end = right if is_right else left
        self.values = _limits_at(found, end)
        crossing = [_where_level(p, self.values) for p in found]
        points = _roots([*critical, *crossing])
        ends = [left, *(x for x in points if _is_in(x, left, right)), right]
        start, stop = ends[-2:] if is_right else ends[:2]
        t = between(start, stop)
        root = RealRoot.rational(t)
        nearer = between(root, stop) if is_right else between(start, root)
        self.first, self.second = level(t), level(nearer)

    def is_growing(self) -> bool:
        """Whether the level grows towards the end."""
        return height(self.second) > height(self.first)

    def limit(self) -> Size:
        """What it grows to."""
        assert self.second is not None
        roots = _roots([in_y(self.values)])
        return min((x for x in roots if x > self.second), default=None)


def _is_in(x: RealRoot, left: RealRoot | None, right: RealRoot | None) -> bool:
    return (left is None or left < x) and (right is None or x < right)


def _limits_at(found: Iterable[fmpq_mpoly], end: RealRoot | None) -> fmpq_mpoly:
    """A polynomial in y with the limits of all branches as t tends to an end."""
    product = PLANE.constant(fmpq(1))
    for p in found:
        if end is None:
            highest = p.degrees()[1]
            terms: dict[tuple[int, ...], fmpq] = {
                (j, 0): a for (j, k), a in p.to_dict().items() if k == highest
            }
            product *= PLANE.from_dict(terms)
        else:
            modulus = PLANE.from_dict(
                {(0, k): fmpq(a) for k, a in enumerate(end.polynomial.coeffs())}
            )
            at_end = p.resultant(modulus, "t")
            product *= at_end if at_end else PLANE.constant(fmpq(1))
    return product


def in_y(p: fmpq_mpoly) -> Polynomial:
    """A polynomial in y alone."""
    powers = {int(j): a for (j, _), a in p.to_dict().items()}
    return Polynomial([powers.get(j, fmpq(0)) for j in range(max(powers) + 1)])


def _where_level(p: fmpq_mpoly, values: fmpq_mpoly) -> Polynomial:
    """All t at which a curve has one of several levels."""
    if not p.degrees()[0]:
        return in_t(p)
    return in_t(values.resultant(p, "y"))


def _stationary(found: Iterable[fmpq_mpoly]) -> list[Polynomial]:
    """Where a curve has a horizontal tangent, as polynomials in t."""
    made = []
    for curve in found:
        by_t = curve.derivative(1)
        if by_t and curve.degrees()[0]:
            made.append(in_t(curve.resultant(by_t, "y")))
    return [p for p in made if p]


def _roots(polynomials: Iterable[Polynomial]) -> list[RealRoot]:
    roots: set[RealRoot] = set()
    for p in polynomials:
        if p:
            roots.update(root for root, _ in real_roots(p))
    return sorted(roots)


def _cells(points: Sequence[RealRoot]) -> list[tuple[RealRoot | None, RealRoot | None]]:
    """The open intervals between points."""
    ends = [None, *points, None]
    return list(pairwise(ends))


def _representatives(attained: Iterable[HighAt], greatest: Size) -> tuple[HighAt, ...]:
    """Those with the greatest level, one of each run of neighbours, of intervals the shortest
    number.
    """
    found = []
    for is_greatest, run in groupby(attained, key=lambda x: x.level == greatest):
        if is_greatest:
            found.append(min(run, key=_length))
    return tuple(found)


def _length(one: HighAt) -> tuple[bool, int]:
    """Samples first, short ones first."""
    t = one.t.exact
    bits = 0 if t is None else int(t.p).bit_length() + int(t.q).bit_length()
    return not one.is_sample, bits


def _in_turn(points: Sequence[RealRoot]) -> Iterator[Point]:
    """A number of each cell and the points between them, in ascending order."""
    for left, right in _cells(points):
        yield between(left, right)
        if right is not None:
            yield right


def _crossing(found: Iterable[fmpq_mpoly], level: RealRoot) -> list[Polynomial] | None:
    """Polynomials with all t at which a curve has a level; None where its degree is too large."""
    if level.exact is not None:
        _, t = PLANE.gens()
        y = PLANE.constant(level.exact)
        return [in_t(p.compose(y, t)) for p in found]
    if level.polynomial.degree() > MOST_DEGREE:
        return None
    modulus = PLANE.from_dict({(k, 0): fmpq(a) for k, a in enumerate(level.polynomial.coeffs())})
    return [_where_level(p, modulus) for p in found]
