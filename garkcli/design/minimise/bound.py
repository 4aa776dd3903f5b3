"""Whether a function of two coordinates is nowhere less than a number.

N/D ≥ m wherever D is not zero when (N − m D) D ≥ 0 on the whole plane.
"""

from __future__ import annotations

from flint import fmpq, fmpq_mpoly

from garkcli.exact.projection import MOST_DEGREE, PLANE, curves, is_nowhere_negative


def is_nowhere_less(numerator: fmpq_mpoly, denominator: fmpq_mpoly, m: fmpq) -> bool | None:
    """Whether N/D ≥ m on the plane; None where that would take too long.

    Args:
        numerator: N, in two variables.
        denominator: D.
        m: the bound.
    """
    difference = _in_plane(numerator - denominator * m)
    if any(p.total_degree() > MOST_DEGREE for p in curves([difference])):
        return None
    return is_nowhere_negative(difference * _in_plane(denominator))


def _in_plane(p: fmpq_mpoly) -> fmpq_mpoly:
    """The same with the names of ``PLANE``."""
    return PLANE.from_dict(dict(p.to_dict()))
