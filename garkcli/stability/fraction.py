"""R(z_1, …, z_N), the stability function for ẏ = Σ λ_l y with z_l = hλ_l, as one exact fraction.

With W(z) = Σ_l z_l W_l, the blocks of colour l in W_l, R(z) = 1 + Σ_l z_l b_lᵀ (I − W(z))⁻¹ 𝟙 has
the denominator det(I − W(z)); for blocks that are not shared this is

    R(z) = det(I − A Z + 𝟙 bᵀ Z) / det(I − A Z),    Z = diag(z_1 I, …, z_N I)

(A. Sandu, M. Günther 2015, section 3). Both are polynomials whose total degree is at most the
number of stages, interpolated from lines through the origin.

A common factor of both is one on every line, so lowest terms are proved by one line without a
common factor on which the denominator keeps its full degree.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import comb

from flint import fmpq

from garkcli.exact.field import ONE, ZERO, Number
from garkcli.exact.multivariate import Multivariate, from_lines, lattice
from garkcli.exact.polynomial import Polynomial, gcd
from garkcli.frozen import Frozen
from garkcli.stability.linear import unreduced
from garkcli.stepping.linear import stage_system
from garkcli.tableau.tableau import Tableau

MOST_LINES = 400
"""Most lines: enough for 26 stages of three colours, or 11 of four."""
OFFSETS = (1, 3, 7, 13, 29)
"""Offsets of the lattices of directions that are tried for common factors."""


class Fraction(Frozen):
    """R = P/Q with Q(0) = 1; ``is_reduced`` if P and Q provably have no common factor."""

    numerator: Multivariate
    denominator: Multivariate
    is_reduced: bool

    def with_fixed(self, index: int, value: Number) -> tuple[Polynomial, Polynomial]:
        """P and Q of two colours as polynomials in the other variable, for z_index = value."""
        return _fixed(self.numerator, index, value), _fixed(self.denominator, index, value)


def _fixed(p: Multivariate, index: int, value: Number) -> Polynomial:
    coefficients: list[Number] = []
    for exponents, a in p.terms:
        power = exponents[1 - index]
        coefficients += [ZERO] * (power + 1 - len(coefficients))
        coefficients[power] = coefficients[power] + a * value ** exponents[index]
    return Polynomial(coefficients)


def lines_needed(tableau: Tableau) -> int:
    tableau.demand_fields("the stability function")
    axes = tableau.size - 1
    stages = sum(space.stages for space in tableau.spaces)
    return comb(stages + axes, axes)


def stability_fraction(tableau: Tableau) -> Fraction | None:
    """R(z_1, …, z_N), for stages that see all colours; None if it needs more than ``MOST_LINES``
    lines.

    >>> from garkcli.families.registry import diagonal_method
    >>> from garkcli.tableau.forms import gark
    >>> stability_fraction(gark([diagonal_method("gauss", 1)], {})).denominator.terms
    (((1,), -1/2), ((0,), 1))
    """
    if lines_needed(tableau) > MOST_LINES:
        return None
    axes = tableau.size - 1
    degree = sum(space.stages for space in tableau.spaces)
    over, under = {}, {}
    for point in lattice(axes, degree):
        shares = [ONE, *map(fmpq, point)]
        # colours with share 0 are kept: all lines have numerators and denominators of one pair
        fields = [((share,),) for share in shares]
        step = unreduced(stage_system(tableau, fields, [((ONE,),) for _ in shares]))
        [[over[point]]] = step.numerators
        under[point] = step.denominator
    P = from_lines(over, 0, degree)
    Q = from_lines(under, 0, degree)
    axes = Q.variables - 1
    for offset in OFFSETS:
        direction = _direction([0] * axes, offset)
        on_line = Q.along(direction)
        common = gcd(P.along(direction), on_line)
        has_full_degree = on_line.degree == Q.degree
        if common.degree == 0 and has_full_degree:
            return Fraction(P, Q, is_reduced=True)
    for offset in OFFSETS:
        reduced = _cancelled(P, Q, offset)
        if reduced is not None:
            return reduced
    return Fraction(P, Q, is_reduced=False)


def _direction(point: Sequence[int], offset: int) -> list[Number]:
    return [ONE, *(fmpq(offset + i) for i in point)]


def _cancelled(P: Multivariate, Q: Multivariate, offset: int) -> Fraction | None:
    """P/Q in lowest terms from the quotients on lines; None if a line is special: on all others the
    denominators have one degree. The interpolated fraction is multiplied out, so it is right or
    rejected. Its denominator has the least possible degree, which is not less than on a line.
    """
    axes = Q.variables - 1
    over = {}
    under = {}
    degree = 0
    for point in lattice(axes, max(P.degree, Q.degree)):
        direction = _direction(point, offset)
        top = P.along(direction)
        bottom = Q.along(direction)
        common = gcd(top, bottom)
        lowest = bottom // common
        scale = ONE / lowest[0]
        over[point] = top // common * scale
        under[point] = lowest * scale
        degree = max(degree, over[point].degree, lowest.degree)
    p = from_lines(over, offset, degree)
    q = from_lines(under, offset, degree)
    least_degree = max(line.degree for line in under.values())
    if q * P != p * Q or q.degree != least_degree:
        return None
    return Fraction(p, q, is_reduced=True)
