"""Real roots of polynomials over ℚ or a number field, and signs at them.

A real root is an irreducible polynomial over ℚ with the index of the root, so roots are equal
exactly if they are the same number. Enclosures only separate numbers that are known to differ.
"""

from __future__ import annotations

from collections.abc import Callable
from itertools import pairwise

from flint import arb, ctx, fmpq, fmpq_poly, fmpz_poly

from garkcli.deadline import check_time
from garkcli.exact.apart import apart
from garkcli.exact.display import to_ball
from garkcli.exact.domain import Domain
from garkcli.exact.enclosing import isolated
from garkcli.exact.field import ZERO, Algebraic, Number
from garkcli.exact.nodes import AlgebraicRoot
from garkcli.exact.polynomial import Polynomial, gcd
from garkcli.frozen import Frozen
from garkcli.upward import answered

LARGE = 100_000
"""Size of a polynomial, degree times bits, beyond which factoring may take tenths of a second."""


class RealRoot(Frozen):
    """A real algebraic number.

    Attributes:
        polynomial: its minimal polynomial over ℤ, primitive with a positive leading coefficient.
        number: its index among the real roots in ascending order, from 0.
    """

    polynomial: fmpz_poly
    number: int

    def __hash__(self) -> int:
        return hash((_integers(self.polynomial), self.number))

    @classmethod
    def rational(cls, value: fmpq) -> RealRoot:
        """Returns a rational number as a root."""
        return cls(fmpz_poly([-value.p, value.q]), 0)

    @property
    def exact(self) -> fmpq | None:
        """The value if it is rational, else None."""
        if self.polynomial.degree() > 1:
            return None
        constant, slope = _integers(self.polynomial)
        return fmpq(-constant, slope)

    def ball(self, bits: int) -> arb:
        """Returns an enclosure with about ``bits`` correct bits."""
        value = self.exact
        if value is not None:
            with ctx.workprec(bits):
                return arb(value)
        return isolated(_integers(self.polynomial), bits)[self.number]

    def __float__(self) -> float:
        """A float close to it, for display only."""
        return float(self.ball(80))

    def __repr__(self) -> str:
        text: str = answered(self, "text")
        return f"<RealRoot {text}>"

    def __le__(self, other: RealRoot) -> bool:
        return not other < self

    def __lt__(self, other: RealRoot) -> bool:
        if self.polynomial == other.polynomial:
            return self.number < other.number
        bits = FIRST_BITS
        while True:
            check_time()
            mine = self.ball(bits)
            theirs = other.ball(bits)
            if mine < theirs or mine > theirs:
                return bool(mine < theirs)
            bits *= 2


def _integers(polynomial: fmpz_poly) -> tuple[int, ...]:
    return tuple(int(a) for a in polynomial.coeffs())


def real_roots(p: Polynomial) -> list[tuple[RealRoot, int]]:
    """The distinct real roots in ascending order, with their multiplicities; p is not zero.

    >>> real_roots(Polynomial([2, -3, 0, 1]))
    [(<RealRoot -2>, 1), (<RealRoot 1>, 2)]
    """
    if not p:
        raise ValueError("every number is a root of the zero polynomial")
    roots: list[tuple[RealRoot, int]] = []
    for factor, power in factors_of(p.norm()):
        check_time()
        primitive = factor if factor[factor.degree()] > 0 else -factor
        for number in range(len(isolated(_integers(primitive), FIRST_BITS))):
            root = RealRoot(primitive, number)
            multiplicity = power
            if not p.is_rational:
                multiplicity = multiplicity_at(p, root, power)
            if multiplicity:
                roots.append((root, multiplicity))
    return sorted(roots, key=lambda pair: pair[0])


def factors_of(p: fmpz_poly) -> list[tuple[fmpz_poly, int]]:
    is_large = p.degree() * int(p.height_bits()) > LARGE
    return apart(_factors, p) if is_large else _factors(p)


def _factors(p: fmpz_poly) -> list[tuple[fmpz_poly, int]]:
    return [(factor, int(power)) for factor, power in p.factor()[1]]


def is_nonnegative(p: Polynomial) -> bool:
    if not p:
        return True
    if sign(p.leading) < 0 or p.degree % 2:
        return False
    # the sign changes at the roots of odd multiplicity
    return not any(power % 2 for _, power in real_roots(p))


def multiplicity_at(p: Polynomial, root: RealRoot, together: int | None = None) -> int:
    """The multiplicity of a root of p ≠ 0; ``together`` is that in the norm, if known."""
    if together is None:
        together = _multiplicity(p.norm(), root.polynomial)
    field = p.field
    if field is None or not together:
        return together
    bits = FIRST_BITS
    while True:
        check_time()
        found = p.images(field, bits)
        if found is None:
            return _multiplicity_by_gcds(p, root)
        with ctx.workprec(bits):
            x = root.ball(bits)
            own = found[0].multiplicity(x)
            # all images have it as a root so often together, and none more often than that
            if not own or together == sum(f.weight * f.multiplicity(x) for f in found):
                return own
        bits *= 2


def _multiplicity(p: fmpz_poly, factor: fmpz_poly) -> int:
    rest, divisor = fmpq_poly(p), fmpq_poly(factor)
    count = 0
    while True:
        check_time()
        rest, remainder = divmod(rest, divisor)
        if remainder:
            return count
        count += 1


def _multiplicity_by_gcds(p: Polynomial, root: RealRoot) -> int:
    multiplicity = 0
    while p and _is_root(p, root):
        multiplicity += 1
        p = p.derivative()
    return multiplicity


def sign_at(p: Polynomial, root: RealRoot) -> int:
    value = root.exact
    if value is not None:
        return sign(p(value))
    if not p:
        return 0
    found = _sign_in_balls(p, root, FIRST_BITS)  # most often no gcd is needed
    if not found and vanishes_at(p, root):
        return 0
    bits = 2 * FIRST_BITS
    while not found:
        check_time()
        found = _sign_in_balls(p, root, bits)
        bits *= 2
    return found


def _sign_in_balls(p: Polynomial, root: RealRoot, bits: int) -> int:
    with ctx.workprec(bits):
        ball = p.enclosed_at(root.ball(bits))
    return int(ball > 0) - int(ball < 0)


def vanishes_at(p: Polynomial, root: RealRoot) -> bool:
    return not p or multiplicity_at(p, root) > 0


def _is_root(p: Polynomial, root: RealRoot) -> bool:
    """Whether p vanishes at a root, by a common divisor. With q the minimal polynomial and g =
    gcd(p, q), q = g · (q/g) has no multiple root, so the number is a root of exactly one of the two
    factors; an enclosure excludes the other.
    """
    q = Polynomial.from_flint(root.polynomial)
    g = gcd(p, q)
    if g.degree == 0:
        return False
    if g.degree == q.degree:
        return True
    other = q // g
    bits = FIRST_BITS
    while True:
        check_time()
        with ctx.workprec(bits):
            ball = root.ball(bits)
            if not g.enclosed_at(ball).contains(0):
                return False
            if not other.enclosed_at(ball).contains(0):
                return True
        bits *= 2


FIRST_BITS = 64
"""First precision for deciding signs; it doubles until they are decided."""


def sign(number: Number) -> int:
    """−1, 0 or 1: zero is known exactly, the rest by enclosures."""
    if not isinstance(number, Algebraic):
        return (number > 0) - (number < 0)
    digits = FIRST_BITS * 3 // 10
    while True:
        check_time()
        ball = to_ball(number, digits)
        if ball > 0 or ball < 0:
            return 1 if ball > 0 else -1
        digits *= 2


def roots_below(M: fmpq_poly, x: fmpq) -> int:
    """The number of roots below x if all roots of M are real, by Descartes' rule.

    >>> roots_below(fmpq_poly([0, 2, -3, 1]), fmpq(2))  # the roots 0, 1, 2
    2
    """
    mirrored = M(fmpq_poly([x, -1]))
    signs = [a > 0 for a in mirrored.coeffs() if a]
    return sum(1 for a, b in pairwise(signs) if a != b)


def root_within(p: Polynomial, ball: Callable[[int], arb]) -> RealRoot:
    """Returns the real root of p that ``ball(bits)`` encloses."""
    candidates = [x for x, _ in real_roots(p)]
    bits = FIRST_BITS
    while len(candidates) > 1:
        check_time()
        mine = ball(bits)
        candidates = [x for x in candidates if x.ball(bits).overlaps(mine)]
        bits *= 2
    return candidates[0]


def number_of(root: RealRoot, most_degree: int) -> Number | None:
    """A root as an exact number; None if its degree is larger than ``most_degree``.

    >>> from flint import fmpz_poly
    >>> theta = number_of(RealRoot(fmpz_poly([-2, 0, 1]), 1), 4)
    >>> theta * theta
    2
    """
    if root.exact is not None:
        return root.exact
    if root.polynomial.degree() > most_degree:
        return None
    expression = AlgebraicRoot(tuple(int(c) for c in root.polynomial.coeffs()), root.number)
    return Domain([expression]).evaluate(expression)


def square_root(x: RealRoot) -> RealRoot:
    """The square root of a number ≥ 0: squaring keeps the order of positive numbers."""
    origin = RealRoot.rational(ZERO)
    if x == origin:
        return origin
    p = Polynomial.from_flint(x.polynomial)
    smaller = sum(1 for root, _ in real_roots(p) if origin < root < x)
    squares = Polynomial([p[k // 2] if k % 2 == 0 else ZERO for k in range(2 * p.degree + 1)])
    return [root for root, _ in real_roots(squares) if root > origin][smaller]
