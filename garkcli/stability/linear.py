"""The linear test equation ẏ = Σ_l λ_l y: the stability function and its consequences.

A method is A-stable if |R(z)| ≤ 1 for Re z ≤ 0. By the maximum principle that means two things
(E. Hairer, G. Wanner, Solving Ordinary Differential Equations II, section IV.3): all poles lie in
the right half plane, and |R(iy)| ≤ 1 on the imaginary axis, where with R = P/Q

    E(y) = |Q(iy)|² − |P(iy)|² ≥ 0   for all real y.

Both are decided from signs of polynomials at exact numbers, without a grid.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache
from itertools import pairwise
from typing import TypeAlias

from garkcli.exact.cells import Interval, Point, is_half_line, sign_of, where
from garkcli.exact.field import ONE, ZERO, Number
from garkcli.exact.matrix import Vector, apply, transpose
from garkcli.exact.polynomial import Polynomial, gcd, reciprocal_characteristic, squared_on_axis
from garkcli.exact.polynomial_text import polynomial_text
from garkcli.exact.roots import sign
from garkcli.frozen import Frozen
from garkcli.stepping.linear import StageSystem, stage_system
from garkcli.tableau.tableau import Tableau
from garkcli.upward import Shown

Complex: TypeAlias = tuple[Number, Number]
"""A real and an imaginary part."""


class StepFunction(Frozen):
    """M(z) with a common denominator D, D(0) = 1, and the entries of D · M."""

    denominator: Polynomial
    numerators: tuple[tuple[Polynomial, ...], ...]


def step_function(system: StageSystem) -> StepFunction:
    return reduced(unreduced(system))


def unreduced(system: StageSystem) -> StepFunction:
    """M(z) with the denominator det(I − zW). By Cramer's rule the degrees of the numerators are at
    most the number of unknowns, so finitely many terms of M determine them.
    """
    n = len(system.W)
    d = len(system.B)
    denominator = reciprocal_characteristic(system.W)
    # without a stage the step does nothing
    columns = transpose(system.E) if n else ((),) * d
    series = [_series(system, column, n) for column in columns]
    numerators = []
    for i in range(d):
        entries = []
        for j in range(d):
            powers = Polynomial([ONE if i == j else ZERO, *series[j][i]])
            # the first terms of D · M_ij are all there are
            entries.append(Polynomial((denominator * powers).coefficients[: n + 1]))
        numerators.append(tuple(entries))
    return StepFunction(denominator, tuple(numerators))


def _series(system: StageSystem, column: Vector, terms: int) -> list[list[Number]]:
    """The coefficients of z, z², … in one column of M, a list for each row."""
    series: list[list[Number]] = [[] for _ in system.B]
    state = column
    for _ in range(terms):
        for i, value in enumerate(apply(system.B, state)):
            series[i].append(value)
        state = apply(system.W, state)
    return series


def reduced(step: StepFunction) -> StepFunction:
    common = step.denominator
    for row in step.numerators:
        for p in row:
            common = gcd(common, p)
    lowest = step.denominator // common
    scale = ONE / lowest[0]
    numerators = [tuple(p // common * scale for p in row) for row in step.numerators]
    return StepFunction(lowest * scale, tuple(numerators))


class StabilityFunction(Shown, Frozen):
    """R = P/Q in lowest terms, with Q(0) = 1.

    Attributes:
        numerator: P.
        denominator: Q.

    >>> from garkcli import find_stability
    >>> find_stability("heun").linear[0].R.numerator
    Polynomial([1, 1, 1/2])
    """

    numerator: Polynomial
    denominator: Polynomial

    def at_infinity(self) -> Number | None:
        """R(∞); None if R is unbounded."""
        if self.numerator.degree > self.denominator.degree:
            return None
        return self.numerator[self.denominator.degree] / self.denominator.leading

    def at(self, z: Complex) -> Complex | None:
        """R at one point; None at a pole."""
        (p, q), (u, v) = (_value(x, z) for x in (self.numerator, self.denominator))
        size = u * u + v * v
        return ((p * u + q * v) / size, (q * u - p * v) / size) if size else None

    def __repr__(self) -> str:
        P, Q = (polynomial_text(x, "z") for x in (self.numerator, self.denominator))
        return f"<R(z) = {P}>" if Q == "1" else f"<R(z) = ({P})/({Q})>"


def _value(p: Polynomial, z: Complex) -> Complex:
    x, y = z
    real: Number = ZERO
    imaginary: Number = ZERO
    for a in reversed(p.coefficients):
        real, imaginary = real * x - imaginary * y + a, real * y + imaginary * x
    return real, imaginary


def stability_function(
    tableau: Tableau, shares: Sequence[Number] | None = None
) -> StabilityFunction:
    """R(z) for λ_l = w_l λ, z = hλ; used stages see all colours with w_l ≠ 0, by default 1."""
    weights = [ONE] * tableau.size if shares is None else list(shares)
    step = step_function(stage_system(tableau, [((w,),) for w in weights]))
    [[numerator]] = step.numerators
    return StabilityFunction(numerator, step.denominator)


def real_and_imaginary(p: Polynomial) -> tuple[Polynomial, Polynomial]:
    """The polynomials u and v in y with p(iy) = u(y) + i v(y)."""
    real: list[Number] = []
    imaginary: list[Number] = []
    for k, a in enumerate(p.coefficients):
        # i⁰, i¹, i², i³ = 1, i, −1, −i
        amount = -a if k % 4 in {2, 3} else a
        is_real = k % 2 == 0
        real.append(amount if is_real else ZERO)
        imaginary.append(ZERO if is_real else amount)
    return Polynomial(real), Polynomial(imaginary)


def squared_modulus(p: Polynomial) -> Polynomial:
    return Polynomial(squared_on_axis(p.coefficients))


def e_polynomial(R: StabilityFunction) -> Polynomial:
    """E as a polynomial in x = y²."""
    return squared_modulus(R.denominator) - squared_modulus(R.numerator)


@lru_cache(maxsize=16)
def imaginary_set(R: StabilityFunction) -> tuple[Interval, ...]:
    E = e_polynomial(R)
    Q = squared_modulus(R.denominator)

    def is_bounded(x: Point) -> bool:
        return sign_of(E, x) >= 0 and sign_of(Q, x) != 0

    return where(is_bounded, [E, Q], start=ZERO)


def real_set(R: StabilityFunction) -> tuple[Interval, ...]:
    minus = Polynomial([0, -1])
    P, Q = R.numerator.substituted(minus), R.denominator.substituted(minus)
    difference = Q * Q - P * P

    def is_bounded(x: Point) -> bool:
        return sign_of(difference, x) >= 0 and sign_of(Q, x) != 0

    return where(is_bounded, [difference, Q], start=ZERO)


def is_i_stable(R: StabilityFunction) -> bool:
    return is_half_line(imaginary_set(R))


@lru_cache(maxsize=16)
def poles_are_right(Q: Polynomial) -> bool:
    """Whether all roots of Q have a positive real part, by the Hermite-Biehler theorem: with Q(iy)
    = u(y) + i v(y), the argument of Q(iy) turns by −π deg Q along the real line exactly then: a
    Cauchy index of u, v. A common root of u and v is a root of Q on the axis, or a pair ±.
    """
    if Q.degree <= 0:
        return True
    u, v = real_and_imaginary(Q)
    if gcd(u, v).degree > 0:
        return False
    # one of u, v has the degree of Q, the other less: the index is that of lower/higher
    if u.degree > v.degree:
        return exact_cauchy_index(u, v) == Q.degree
    return exact_cauchy_index(v, -u) == Q.degree


def exact_cauchy_index(f: Polynomial, g: Polynomial) -> int:
    """The Cauchy index of g/f over the real line, by Sturm's chain f, g, −rem, …"""
    chain = [f, g]
    while chain[-1]:
        chain.append(-(chain[-2] % chain[-1]))
    chain.pop()
    return _variations(chain, at_plus=False) - _variations(chain, at_plus=True)


def _variations(chain: Sequence[Polynomial], at_plus: bool) -> int:
    """Sign changes along the chain at ∞ or −∞."""
    signs = []
    for p in chain:
        leading = sign(p.leading)
        is_turned = p.degree % 2 == 1 and not at_plus
        signs.append(-leading if is_turned else leading)
    return sum(1 for a, b in pairwise(signs) if a != b)


def is_a_stable(R: StabilityFunction) -> bool:
    return poles_are_right(R.denominator) and is_i_stable(R)


def is_l_stable(R: StabilityFunction) -> bool:
    return R.numerator.degree < R.denominator.degree and is_a_stable(R)
