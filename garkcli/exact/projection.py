"""The t at which curves in the plane change their position over a line.

Over the t-axis, the curves p_k(y, t) = 0 keep their order and number among the y of an interval
except where one has a vertical tangent or asymptote, two cross, or one meets an end of the
interval: at roots of discriminants, leading coefficients, resultants and restrictions (G. E.
Collins 1975). Between two such t every sign in the plane is that of one sample.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from itertools import combinations
from math import prod
from operator import methodcaller
from typing import Any

from flint import Ordering, fmpq, fmpq_mpoly, fmpq_mpoly_ctx

from garkcli.deadline import check_time
from garkcli.exact.apart import apart
from garkcli.exact.cells import Interval, between_roots, ends_of, has
from garkcli.exact.field import Number
from garkcli.exact.parametric import factors, unknowns_of
from garkcli.exact.polynomial import Polynomial, in_one
from garkcli.exact.roots import RealRoot, is_nonnegative, number_of

PLANE = fmpq_mpoly_ctx.get(["y", "t"], Ordering.lex)
"""ℚ[y, t]: y is eliminated, t stays."""


def in_plane(p: fmpq_mpoly, y: int, t: int) -> fmpq_mpoly:
    """A polynomial mapped to the plane; ``y`` and ``t`` are the indices of its only variables."""
    return p.project_to_context(PLANE, {t: 1, y: 0})


def projected(irreducible: Sequence[fmpq_mpoly], ends: Sequence[fmpq]) -> list[Polynomial]:
    """Returns the nonzero polynomials in t between whose roots nothing changes.

    ``irreducible`` are distinct irreducible curves, ``ends`` the ends of the interval of y.
    """
    return [in_t(p) for p in seen_along(irreducible, ends)]


def seen_along(irreducible: Sequence[fmpq_mpoly], ends: Sequence[fmpq]) -> list[fmpq_mpoly]:
    """The nonzero polynomials without the first variable, between whose zeros the zeros of others
    in it keep their order and number.

    Args:
        irreducible: distinct irreducible polynomials.
        ends: the ends of the interval of the first variable.
    """
    found: list[fmpq_mpoly] = []
    crossing = []
    for curve in irreducible:
        check_time()
        degree = curve.degrees()[0]
        if degree == 0:
            found.append(curve)
            continue
        crossing.append(curve)
        first, *others = curve.context().gens()
        found.append(leading(curve))
        found.extend(curve.compose(first * 0 + end, *others) for end in ends)
        if degree > 1:
            found.append(discriminant(curve))
    found += [resultant(f, g) for f, g in combinations(crossing, 2)]
    return [p for p in found if p]


LARGE = 30_000
"""Larger problems, by the cubed degree in the eliminated variable times the others, run in a
process apart.
"""


def discriminant(p: fmpq_mpoly) -> fmpq_mpoly:
    """The discriminant with respect to the first variable, y in the plane.

    Raises:
        NotDecided: the time limit has passed.
    """
    variable = p.context().name(0)
    return _without(variable, p, p, methodcaller("discriminant", variable))


def resultant(p: fmpq_mpoly, q: fmpq_mpoly, variable: str | None = None) -> fmpq_mpoly:
    """The resultant with respect to a variable, the first one where none is named.

    Raises:
        NotDecided: the time limit has passed.
    """
    variable = variable or p.context().name(0)
    return _without(variable, p, q, methodcaller("resultant", q, variable))


def _without(
    variable: str, p: fmpq_mpoly, q: fmpq_mpoly, work: Callable[[fmpq_mpoly], fmpq_mpoly]
) -> fmpq_mpoly:
    """The result of eliminating an unknown, in a process of its own where that is large."""
    check_time()
    place = p.context().variable_to_index(variable)
    degrees = [max(x) for x in zip(p.degrees(), q.degrees(), strict=True)]
    others = prod(max(1, x) for k, x in enumerate(degrees) if k != place)
    return work(p) if degrees[place] ** 3 * others <= LARGE else apart(work, p)


def of_root(t: RealRoot) -> fmpq_mpoly:
    """The polynomial of an algebraic number, in the variable t of the plane."""
    return across(t.polynomial.coeffs())


def across(coefficients: Iterable[Any]) -> fmpq_mpoly:
    """The polynomial in the variable t of the plane with these rational coefficients."""
    return PLANE.from_dict({(0, k): fmpq(a) for k, a in enumerate(coefficients) if a})


def leading(p: fmpq_mpoly) -> fmpq_mpoly:
    """The coefficient of the highest power of the first variable, y in the plane."""
    return coefficient_of(p, p.degrees()[0])


def coefficient_of(p: fmpq_mpoly, power: int, variable: int = 0) -> fmpq_mpoly:
    """The coefficient of a power of one variable, as a polynomial in the others."""
    terms = {}
    for e, a in p.to_dict().items():
        if e[variable] == power:
            terms[*e[:variable], 0, *e[variable + 1 :]] = a
    return p.context().from_dict(terms)


def coefficients(p: fmpq_mpoly) -> list[Polynomial]:
    """The coefficients of the powers of y, lowest first, as polynomials in t."""
    return [in_t(coefficient_of(p, k)) for k in range(p.degrees()[0] + 1)]


def in_t(p: fmpq_mpoly) -> Polynomial:
    return in_one(p, 1)


def at_y(p: fmpq_mpoly, y: fmpq) -> Polynomial:
    """p(y, t) for one y."""
    _, t = PLANE.gens()
    return in_t(p.compose(PLANE.constant(y), t))


MOST_DEGREE = 12
"""Polynomials in the plane of larger degree are not projected: the work grows with more than the
cube of the degree.
"""


def kept_sign(p: fmpq_mpoly) -> int | None:
    """1 if p ≥ 0 at all real points, −1 if p ≤ 0; None if neither holds or the tests below fail.

    Each irreducible factor of odd power has to keep its sign. This is decided if all terms are
    squares of one sign; in one or two variables always, up to a degree; and for a v² + b v + c if a
    keeps its sign and 4ac − b² ≥ 0.

    >>> from flint import Ordering, fmpq_mpoly_ctx
    >>> x, y, z = fmpq_mpoly_ctx.get(["x", "y", "z"], Ordering.lex).gens()
    >>> kept_sign((x - y) ** 2 + (y + z) ** 4), kept_sign(-x * x - y * y - 1), kept_sign(x * y - z)
    (1, -1, None)
    """
    check_time()
    if not p:
        return 1
    content, powers = p.factor()
    common = 1 if content > 0 else -1
    for factor, power in powers:
        if power % 2:
            own = _of_factor(factor)
            if own is None:
                return None
            common *= own
    return common


def _of_factor(p: fmpq_mpoly) -> int | None:
    """``kept_sign`` of an irreducible polynomial that is not constant."""
    if any(degree % 2 for degree in p.degrees()):
        return None  # it has both signs on a line
    signs = {(a > 0) - (a < 0) for a in p.coeffs()}
    if len(signs) == 1 and not any(int(k) % 2 for e in p.monoms() for k in e):
        return signs.pop()
    used = unknowns_of(p)
    if len(used) <= 2:
        if p.total_degree() > MOST_DEGREE:
            return None
        moved = in_plane(p, used[0], used[-1])
        return next((own for own in (1, -1) if is_nowhere_negative(moved * own)), None)
    for i in used:
        if p.degrees()[i] == 2:
            a, b, c = (coefficient_of(p, k, i) for k in (2, 1, 0))
            own = kept_sign(a)
            # 4 a p = (2 a v + b)² + 4ac − b², and a is zero on no open set
            if own is not None and kept_sign(4 * a * c - b * b) == 1:
                return own
    return None


MOST_FIELD = 6
"""Single lines over numbers of larger degree are not examined."""


def is_nowhere_negative(p: fmpq_mpoly, within: Sequence[Interval] | None = None) -> bool | None:
    """Whether p(y, t) ≥ 0 for all t, or the t of a set; None if the set has an isolated number of
    large degree.

    Between the roots of the projection (``garkcli.exact.projection``) the signs on the lines t =
    const do not change, so one line each decides; the others follow by continuity.
    """
    lines: list[Number] = []
    if within is not None:
        points = [number_of(x.start, MOST_FIELD) for x in within if x.is_point and x.start]
        if None in points:
            return None
        lines += [t for t in points if t is not None]
    if within is None or not all(x.is_point for x in within):
        critical = [*projected(factors([p]), []), *ends_of(within or ())]
        lines += [t for t in between_roots(critical) if within is None or has(within, t)]
    return all(is_nonnegative(on_line(p, t)) for t in lines)


def on_line(p: fmpq_mpoly, t: Number) -> Polynomial:
    return Polynomial([a(t) for a in coefficients(p)])
