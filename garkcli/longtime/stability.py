"""What becomes of Rⁿ z for ever, decided exactly from the determinant and the trace of R ∈ K^{2×2}.

The eigenvalues are the roots of λ² − λ tr R + det R. For det R = 1 they lie on the unit circle,
apart from each other, if and only if |tr R| < 2: then every orbit stays on an ellipse, and an error
of the energy is bounded for all time. Both lie inside the circle if and only if |det R| < 1 and |tr
R| < 1 + det R (Jury).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, TypeAlias

from garkcli.exact.display import to_ball
from garkcli.exact.field import ONE, Number
from garkcli.exact.matrix import Matrix

Fate: TypeAlias = Literal["elliptic", "unstable", "contractive", "marginal"]
"""Orbits stay on ellipses; leave all bounds; go to zero; stay bounded, but neither of the
former.
"""


@dataclass(frozen=True)
class Stability:
    """The step map of a linear problem, iterated for ever.

    Attributes:
        determinant: det R; RᵀJR = J if and only if it is 1.
        trace: tr R.
        fate: of almost all orbits.
    """

    determinant: Number
    trace: Number
    fate: Fate

    @property
    def is_symplectic(self) -> bool:
        """Whether RᵀJR = J."""
        return self.determinant == ONE


def stability(R: Matrix) -> Stability:
    """Decide what becomes of the orbits of ``R``, shape (2, 2).

    >>> from flint import fmpq
    >>> stability(((fmpq(3, 5), fmpq(4, 5)), (fmpq(-4, 5), fmpq(3, 5)))).fate
    'elliptic'
    >>> stability(((ONE, ONE), (fmpq(0), ONE))).fate
    'unstable'
    """
    (a, b), (c, d) = R
    determinant, trace = a * d - b * c, a + d
    return Stability(determinant, trace, _fate(R, determinant, trace))


def _fate(R: Matrix, determinant: Number, trace: Number) -> Fate:
    if determinant == ONE:
        room = _sign(4 - trace * trace)
        (_, b), (c, _) = R
        # of trace ±2 a diagonal R is the identity, or its negative
        is_identity = room == 0 and not (b or c)
        return "elliptic" if room > 0 or is_identity else "unstable"
    area = _sign(1 - determinant * determinant)
    most = 1 + determinant
    room = _sign(most * most - trace * trace)
    if area > 0 and room > 0:
        return "contractive"
    if area < 0 or room < 0:
        return "unstable"
    return "marginal"


def _sign(x: Number) -> int:
    """The sign, exactly: a ball that is not zero has one."""
    if not x:
        return 0
    return 1 if to_ball(x) > 0 else -1
