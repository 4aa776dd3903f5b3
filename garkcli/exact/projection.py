"""Where curves in the plane change their position over a line, seen along the other axis.

Over the t-axis, the curves p_k(y, t) = 0 keep their order and number among the y of an interval but
at a t where one has a vertical tangent or asymptote, where two cross, or where one meets an end of
the interval: at roots of discriminants, leading coefficients, resultants and restrictions
(G. E. Collins 1975). Between two such t every sign in the plane is that of one sample.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from itertools import combinations

from flint import Ordering, fmpq, fmpq_mpoly, fmpq_mpoly_ctx

from garkcli.deadline import check_time
from garkcli.exact.apart import apart
from garkcli.exact.polynomial import Polynomial

PLANE = fmpq_mpoly_ctx.get(["y", "t"], Ordering.lex)
"""ℚ[y, t]: y is what is looked along, t is what stays."""


def curves(polynomials: Iterable[fmpq_mpoly]) -> list[fmpq_mpoly]:
    """The irreducible factors of polynomials in the plane, each once; constants are left out."""
    found: dict[str, fmpq_mpoly] = {}
    for p in polynomials:
        if not p:
            continue
        _, factors = p.factor()
        for factor, _ in factors:
            found[str(factor)] = factor
    return [curve for curve in found.values() if not curve.is_constant()]


def projected(found: Sequence[fmpq_mpoly], ends: Sequence[fmpq]) -> list[Polynomial]:
    """The polynomials in t, not zero, between whose roots nothing changes.

    Args:
        found: irreducible curves, no two of them the same.
        ends: the ends of the interval of y.
    """
    _, t = PLANE.gens()
    critical: list[fmpq_mpoly] = []
    crossing = []
    for curve in found:
        check_time()
        degree, _ = curve.degrees()
        if degree == 0:
            critical.append(curve)
            continue
        crossing.append(curve)
        critical.append(leading(curve))
        for end in ends:
            y = PLANE.constant(end)
            critical.append(curve.compose(y, t))
        if degree > 1:
            critical.append(discriminant(curve))
    critical += [resultant(f, g) for f, g in combinations(crossing, 2)]
    return [in_t(p) for p in critical if p]


LARGE = 30_000
"""Work, as the cube of the degree that goes times the other, that is done in a process apart."""


def discriminant(p: fmpq_mpoly) -> fmpq_mpoly:
    """The discriminant with respect to y.

    Raises:
        NotDecided: the time is not enough.
    """
    check_time()
    y, t = p.degrees()
    return p.discriminant("y") if y**3 * t <= LARGE else apart(_discriminant, p)


def resultant(p: fmpq_mpoly, q: fmpq_mpoly, variable: str = "y") -> fmpq_mpoly:
    """The resultant with respect to y, or to t.

    Raises:
        NotDecided: the time is not enough.
    """
    check_time()
    largest = [max(degrees) for degrees in zip(p.degrees(), q.degrees(), strict=True)]
    gone, left = largest if variable == "y" else reversed(largest)
    if gone**3 * left <= LARGE:
        return p.resultant(q, variable)
    return apart(_resultant, p, q, variable)


def _discriminant(p: fmpq_mpoly) -> fmpq_mpoly:
    return p.discriminant("y")


def _resultant(p: fmpq_mpoly, q: fmpq_mpoly, variable: str) -> fmpq_mpoly:
    return p.resultant(q, variable)


def leading(p: fmpq_mpoly) -> fmpq_mpoly:
    """The coefficient of the highest power of y, a polynomial in t."""
    degree, _ = p.degrees()
    return coefficient_of(p, degree)


def coefficient_of(p: fmpq_mpoly, power: int) -> fmpq_mpoly:
    """The coefficient of a power of y, a polynomial in t."""
    terms: dict[tuple[int, ...], fmpq] = {}
    for (j, k), coefficient in p.to_dict().items():
        if j == power:
            terms[0, k] = coefficient
    return PLANE.from_dict(terms)


def in_t(p: fmpq_mpoly) -> Polynomial:
    """A polynomial in t alone."""
    powers = {k: c for (_, k), c in p.to_dict().items()}
    highest = max(powers, default=-1)
    return Polynomial([powers.get(k, 0) for k in range(highest + 1)])


def in_y(p: fmpq_mpoly) -> Polynomial:
    """A polynomial in y alone."""
    powers = {int(j): a for (j, _), a in p.to_dict().items()}
    return Polynomial([powers.get(j, fmpq(0)) for j in range(max(powers) + 1)])


def at_y(p: fmpq_mpoly, y: fmpq) -> Polynomial:
    """The polynomial in t for one y."""
    _, t = PLANE.gens()
    return in_t(p.compose(PLANE.constant(y), t))
