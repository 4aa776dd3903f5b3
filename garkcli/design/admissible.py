"""Which real solutions are methods: signs of radicals, ranges, and signs that are wanted."""

from __future__ import annotations

from collections.abc import Iterator

from flint import fmpq_mpoly

from garkcli.design.member import value_of
from garkcli.design.solutions import Solution, value_at
from garkcli.exact.field import Algebraic, Number
from garkcli.exact.polynomial import Polynomial
from garkcli.exact.roots import RealRoot, sign, sign_at
from garkcli.tableau.family import Family


def not_negative(family: Family) -> Iterator[fmpq_mpoly]:
    """Polynomials that are at least 0 at every method of a family: ends of ranges, even roots, and
    what is wanted.
    """
    gens = dict(zip(family.ring.names, family.ring.context.gens(), strict=True))
    for radical in family.radicals:
        if radical.is_even:
            yield gens[radical.name]
    for name, (least, greatest) in family.ranges.items():
        if least is not None:
            yield gens[name] - least
        if greatest is not None:
            yield greatest - gens[name]
    yield from family.not_negative


def is_admissible(family: Family, solution: Solution, root: RealRoot) -> bool:
    """Whether a real solution is a method of a family: even roots are not negative, parameters are
    within their ranges, and what is wanted of signs holds.
    """
    for radical in family.radicals:
        value = solution.values[radical.name]
        if radical.meant is not None and value_at(value, root) != radical.meant:
            return False

    def sign_of(polynomial: fmpq_mpoly) -> int:
        return _sign(value_of(polynomial, family.ring, solution.values), root)

    is_positive = all(sign_of(p) > 0 for p in family.positive)
    return is_positive and all(sign_of(p) >= 0 for p in not_negative(family))


def _sign(value: Number, root: RealRoot) -> int:
    """The sign of an element of ℚ[u]/modulus where u is a real root of the modulus."""
    if isinstance(value, Algebraic):
        return sign_at(Polynomial.from_flint(value.poly), root)
    return sign(value)
