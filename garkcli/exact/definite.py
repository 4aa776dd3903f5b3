"""Polynomials in several variables that never change their sign, as far as that is decided."""

from __future__ import annotations

from collections.abc import Sequence

from flint import fmpq, fmpq_mpoly

from garkcli.deadline import check_time
from garkcli.exact.cells import between_roots
from garkcli.exact.polynomial import Polynomial
from garkcli.exact.projection import PLANE, coefficient_of, curves, in_t, projected
from garkcli.exact.roots import real_roots, sign

MOST_DEGREE = 12
"""Polynomials in the plane of a larger degree are not projected: the work grows with its cube and
more.
"""


def kept_sign(p: fmpq_mpoly) -> int | None:
    """1 where p ≥ 0 at all real points, −1 where p ≤ 0; None where neither is so or is recognised.

    Each irreducible factor of an odd power has to keep its sign. It is known to where all of its
    terms are squares of one sign; of a polynomial in one or two variables always, up to a degree;
    and of a v² + b v + c where it is of a, and 4ac − b² ≥ 0 is known.

    >>> from flint import Ordering, fmpq_mpoly_ctx
    >>> x, y, z = fmpq_mpoly_ctx.get(["x", "y", "z"], Ordering.lex).gens()
    >>> kept_sign((x - y) ** 2 + (y + z) ** 4), kept_sign(-x * x - y * y - 1), kept_sign(x * y - z)
    (1, -1, None)
    """
    check_time()
    if not p:
        return 1
    content, factors = p.factor()
    found = 1 if content > 0 else -1
    for factor, power in factors:
        if power % 2:
            own = _of_factor(factor)
            if own is None:
                return None
            found *= own
    return found


def _of_factor(p: fmpq_mpoly) -> int | None:
    """The same of an irreducible polynomial, not constant."""
    if any(degree % 2 for degree in p.degrees()):
        return None  # it has both signs on a line
    signs = {(a > 0) - (a < 0) for a in p.coeffs()}
    if len(signs) == 1 and not any(int(k) % 2 for e in p.monoms() for k in e):
        return signs.pop()
    used = [i for i, degree in enumerate(p.degrees()) if degree]
    if len(used) <= 2:
        return _in_plane(p, used)
    for i in used:
        if p.degrees()[i] == 2:
            a, b, c = (_coefficient(p, i, k) for k in (2, 1, 0))
            own = kept_sign(a)
            # 4 a p = (2 a v + b)² + 4ac − b², and a is zero on no open set
            if own is not None and kept_sign(4 * a * c - b * b) == 1:
                return own
    return None


def _coefficient(p: fmpq_mpoly, variable: int, power: int) -> fmpq_mpoly:
    terms = {}
    for e, a in p.to_dict().items():
        if e[variable] == power:
            terms[*e[:variable], 0, *e[variable + 1 :]] = a
    return p.context().from_dict(terms)


def _in_plane(p: fmpq_mpoly, used: Sequence[int]) -> int | None:
    """The same of a polynomial in two variables at most, by all cells of the plane."""
    if p.total_degree() > MOST_DEGREE:
        return None
    first, last = used[0], used[-1]
    moved = PLANE.from_dict(
        {(int(e[first]), int(e[last]) if last != first else 0): a for e, a in p.to_dict().items()}
    )
    for own in (1, -1):
        if is_nowhere_negative(moved * own):
            return own
    return None


def is_nowhere_negative(p: fmpq_mpoly) -> bool:
    """Whether p(y, t) ≥ 0 in the plane.

    Between the roots of the projection (``garkcli.exact.projection``) the signs on the lines
    t = const do not change, so that one line each decides; that p is continuous settles the others.
    """
    critical = projected(curves([p]), [])
    return all(_is_nowhere_negative(_on_line(p, t)) for t in between_roots(critical))


def _on_line(p: fmpq_mpoly, t: fmpq) -> Polynomial:
    """p(y, t) for one t."""
    degree, _ = p.degrees()
    return Polynomial([in_t(coefficient_of(p, k))(t) for k in range(degree + 1)])


def _is_nowhere_negative(p: Polynomial) -> bool:
    """Whether p(y) ≥ 0 for all y."""
    if not p:
        return True
    if sign(p.leading) < 0:
        return False
    return all(power % 2 == 0 for _, power in real_roots(p))
