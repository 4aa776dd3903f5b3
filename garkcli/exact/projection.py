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
from garkcli.frozen import Frozen

PLANE = fmpq_mpoly_ctx.get(["y", "t"], Ordering.lex)
"""ℚ[y, t]: y is eliminated, t stays."""


def in_plane(p: fmpq_mpoly, y: int, t: int) -> fmpq_mpoly:
    return p.project_to_context(PLANE, {t: 1, y: 0})


def projected(irreducible: Sequence[fmpq_mpoly], ends: Sequence[fmpq]) -> list[Polynomial]:
    """Nonzero polynomials in t between whose roots distinct irreducible curves change nothing."""
    return [in_t(p) for p in seen_along(irreducible, ends)]


def seen_along(irreducible: Sequence[fmpq_mpoly], ends: Sequence[fmpq]) -> list[fmpq_mpoly]:
    """Nonzero polynomials between whose zeros those of others in the first variable stay apart.
    ``irreducible`` are distinct, ``ends`` those of the interval of the first variable.
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
"""Problems of larger cubed degree times the other degrees run in a process apart."""


def discriminant(p: fmpq_mpoly) -> fmpq_mpoly:
    """The discriminant in the first variable; NotDecided if the time is over."""
    variable = p.context().name(0)
    return _without(variable, p, p, methodcaller("discriminant", variable))


def resultant(p: fmpq_mpoly, q: fmpq_mpoly, variable: str | None = None) -> fmpq_mpoly:
    """The resultant in a variable, by default the first; NotDecided if the time is over."""
    variable = variable or p.context().name(0)
    return _without(variable, p, q, methodcaller("resultant", q, variable))


def _without(
    variable: str, p: fmpq_mpoly, q: fmpq_mpoly, work: Callable[[fmpq_mpoly], fmpq_mpoly]
) -> fmpq_mpoly:
    check_time()
    place = p.context().variable_to_index(variable)
    degrees = [max(x) for x in zip(p.degrees(), q.degrees(), strict=True)]
    others = prod(max(1, x) for k, x in enumerate(degrees) if k != place)
    return work(p) if degrees[place] ** 3 * others <= LARGE else apart(work, p)


def of_root(t: RealRoot) -> fmpq_mpoly:
    return across(t.polynomial.coeffs())


def across(coefficients: Iterable[Any]) -> fmpq_mpoly:
    return PLANE.from_dict({(0, k): fmpq(a) for k, a in enumerate(coefficients) if a})


def leading(p: fmpq_mpoly) -> fmpq_mpoly:
    return coefficient_of(p, p.degrees()[0])


def coefficient_of(p: fmpq_mpoly, power: int, variable: int = 0) -> fmpq_mpoly:
    terms = {}
    for e, a in p.to_dict().items():
        if e[variable] == power:
            terms[*e[:variable], 0, *e[variable + 1 :]] = a
    return p.context().from_dict(terms)


def coefficients(p: fmpq_mpoly) -> list[Polynomial]:
    return [in_t(coefficient_of(p, k)) for k in range(p.degrees()[0] + 1)]


def in_t(p: fmpq_mpoly) -> Polynomial:
    return in_one(p, 1)


def at_y(p: fmpq_mpoly, y: fmpq) -> Polynomial:
    _, t = PLANE.gens()
    return in_t(p.compose(PLANE.constant(y), t))


MOST_DEGREE = 12
"""Plane polynomials of larger degree are not projected."""


class Along(Frozen):
    """A variable, by its place, and its values: a number or an interval."""

    place: int
    values: Interval

    def reduced(self, p: fmpq_mpoly) -> fmpq_mpoly:
        number = self.values.start
        return p if number is None or not self.values.is_point else modulo(p, self.place, number)


def modulo(p: fmpq_mpoly, place: int, number: RealRoot) -> fmpq_mpoly:
    """The polynomial of least degree that is equal where a variable is a number."""
    gen = p.context().gens()[place]
    powers = enumerate(number.polynomial.coeffs())
    return divmod(p, sum((gen**k * fmpq(a) for k, a in powers), gen * 0))[1]


def kept_sign(p: fmpq_mpoly, along: Along | None = None) -> int | None:
    """1 if p ≥ 0 at all real points, −1 if p ≤ 0; None if neither holds or the tests below fail.

    Irreducible factors of odd power have to keep their signs. That is decided if all terms are
    squares of one sign; in one or two variables always, up to a degree; and for a v² + b v + c if
    a keeps its sign and 4ac − b² ≥ 0. One variable may be ``along`` an interval or number.

    >>> from flint import Ordering, fmpq_mpoly_ctx
    >>> x, y, z = fmpq_mpoly_ctx.get(["x", "y", "z"], Ordering.lex).gens()
    >>> kept_sign((x - y) ** 2 + (y + z) ** 4), kept_sign(-x * x - y * y - 1), kept_sign(x * y - z)
    (1, -1, None)
    """
    check_time()
    if along is not None:
        p = along.reduced(p)
    if not p:
        return 1
    content, powers = p.factor()
    common = 1 if content > 0 else -1
    for factor, power in powers:
        if power % 2:
            own = _of_factor(factor, along)
            if own is None:
                return None
            common *= own
    return common


def _of_factor(p: fmpq_mpoly, along: Along | None) -> int | None:
    t = -1 if along is None else along.place
    if any(degree % 2 for k, degree in enumerate(p.degrees()) if k != t):
        return None  # it has both signs on a line
    signs = {(a > 0) - (a < 0) for a in p.coeffs()}
    if len(signs) == 1 and not any(int(k) % 2 for e in p.monoms() for k in e):
        return signs.pop()
    used = [i for i in unknowns_of(p) if i != t]
    if along is not None and len(used) <= 1:
        return _in_plane(p, used[0] if used else (t + 1) % len(p.degrees()), along)
    if along is None and len(used) <= 2:
        return _in_plane(p, used[0], Along(used[-1], Interval(None, None)))
    if along is not None and len(used) == 2 and along.values.is_point:
        own = _beside_number(p, (used[0], used[1]), along)
        if own is not None:
            return own
    for i in used:
        if p.degrees()[i] == 2:
            a, b, c = (coefficient_of(p, k, i) for k in (2, 1, 0))
            own = kept_sign(a, along)
            # 4 a p = (2 a v + b)² + 4ac − b², and a is zero on no open set
            if own is not None and kept_sign(4 * a * c - b * b, along) == 1:
                return own
    return None


def _in_plane(p: fmpq_mpoly, y: int, along: Along) -> int | None:
    if p.total_degree() > MOST_DEGREE and not along.values.is_point:
        return None
    moved = in_plane(p, y, along.place)
    within = None if along.values == Interval(None, None) else [along.values]
    return next((own for own in (1, -1) if is_nowhere_negative(moved * own, within)), None)


MOST_BESIDE = 4
"""Largest degree of the variable that is eliminated beside a number."""
SPACE = fmpq_mpoly_ctx.get(["y", "x", "t"], Ordering.lex)
"""ℚ[y, x, t]: y is eliminated, t is a number."""


def _beside_number(p: fmpq_mpoly, variables: tuple[int, int], along: Along) -> int | None:
    """``kept_sign`` of a polynomial in two variables and a number, by one line in each strip
    between the critical values of a variable.
    """
    x, y = sorted(variables, key=lambda i: p.degrees()[i], reverse=True)
    moved = p.project_to_context(SPACE, {y: 0, x: 1, along.place: 2})
    root = along.values.start
    assert root is not None
    number = number_of(root, MOST_FIELD)
    if number is None or moved.degrees()[0] > MOST_BESIDE:
        return None

    def at_number(q: fmpq_mpoly, place: int) -> Polynomial:
        powers = (coefficient_of(q, k, place) for k in range(q.degrees()[place] + 1))
        return Polynomial([in_one(c, 2)(number) for c in powers])

    critical = [at_number(modulo(q, 2, root), 1) for q in seen_along([moved], [])]
    if not all(critical):
        return None
    first, _, third = SPACE.gens()
    lines = [
        at_number(moved.compose(first, SPACE.constant(value), third), 0)
        for value in between_roots(critical)
    ]
    return next((own for own in (1, -1) if all(is_nonnegative(q * own) for q in lines)), None)


MOST_FIELD = 6
"""Single lines over numbers of larger degree are not examined."""


def is_nowhere_negative(p: fmpq_mpoly, within: Sequence[Interval] | None = None) -> bool | None:
    """Whether p(y, t) ≥ 0 for all y and the t of a set; None if an isolated t has a large degree.

    Between the roots of the projection the signs on the lines t = const do not change: one line
    decides for each strip, and continuity at the roots.
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
