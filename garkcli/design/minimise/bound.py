"""Whether a function of two coordinates is nowhere less than a number.

N/D ≥ m wherever D is not zero when (N − m D) D ≥ 0 on the whole plane. Between the roots of the
projection (``garkcli.exact.projection``) the signs on the lines t = const do not change, so that
one line each decides; that the polynomial is continuous settles the others.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise

from flint import fmpq, fmpq_mpoly

from garkcli.exact.cells import between
from garkcli.exact.polynomial import Polynomial
from garkcli.exact.projection import PLANE, curves, projected
from garkcli.exact.roots import RealRoot, real_roots, sign

MOST_DEGREE = 12
"""Polynomials of a larger degree are not projected: the work grows with its cube and more."""


def is_nowhere_less(numerator: fmpq_mpoly, denominator: fmpq_mpoly, m: fmpq) -> bool | None:
    """Whether N/D ≥ m on the plane; None where that would take too long.

    Args:
        numerator: N, in two variables.
        denominator: D.
        m: the bound.
    """
    difference = _in_plane(numerator - denominator * m)
    found = curves([difference])
    if any(p.total_degree() > MOST_DEGREE for p in found):
        return None
    product = difference * _in_plane(denominator)
    everything = curves([product])
    return all(
        _is_nowhere_negative(_on_line(product, t)) for t in _lines(projected(everything, []))
    )


def _in_plane(p: fmpq_mpoly) -> fmpq_mpoly:
    """The same with the names of ``PLANE``."""
    return PLANE.from_dict(dict(p.to_dict()))


def _lines(critical: list[Polynomial]) -> Iterator[fmpq]:
    """A rational t between each two neighbouring critical ones."""
    roots: set[RealRoot] = set()
    for p in critical:
        roots.update(root for root, _ in real_roots(p))
    ends = [None, *sorted(roots), None]
    for left, right in pairwise(ends):
        yield between(left, right)


def _on_line(p: fmpq_mpoly, t: fmpq) -> Polynomial:
    """p(y, t) for one t."""
    powers: dict[int, fmpq] = {}
    for (j, k), a in p.to_dict().items():
        powers[j] = powers.get(j, fmpq(0)) + a * t**k
    highest = max(powers, default=-1)
    return Polynomial([powers.get(j, fmpq(0)) for j in range(highest + 1)])


def _is_nowhere_negative(p: Polynomial) -> bool:
    """Whether p(y) ≥ 0 for all y."""
    if not p:
        return True
    if sign(p.leading) < 0:
        return False
    return all(power % 2 == 0 for _, power in real_roots(p))
