"""Which real solutions are methods: signs of radicals, ranges, and signs that are wanted."""

from __future__ import annotations

from flint import fmpq_mpoly

from garkcli.design.member import value_of
from garkcli.design.solutions import Solution, value_at
from garkcli.exact.field import Algebraic, Number
from garkcli.exact.polynomial import Polynomial
from garkcli.exact.roots import RealRoot, sign, sign_at
from garkcli.tableau.family import Family


def is_admissible(family: Family, solution: Solution, root: RealRoot) -> bool:
    """Whether even roots are positive there and parameters within their ranges."""
    for radical in family.radicals:
        value = solution.values[radical.name]
        if radical.is_positive and _sign(value, root) <= 0:
            return False
        if radical.meant is not None and value_at(value, root) != radical.meant:
            return False
    for name, (least, greatest) in family.ranges.items():
        value = solution.values[name]
        if least is not None and _sign(value - least, root) < 0:
            return False
        if greatest is not None and _sign(value - greatest, root) > 0:
            return False
    return _has_signs(family, solution, root)


def _has_signs(family: Family, solution: Solution, root: RealRoot) -> bool:
    """Whether what is to be positive is, at a real root of a solution."""

    def sign_of(polynomial: fmpq_mpoly) -> int:
        return _sign(value_of(polynomial, family.ring, solution.values), root)

    is_positive = all(sign_of(p) > 0 for p in family.positive)
    return is_positive and all(sign_of(p) >= 0 for p in family.not_negative)


def _sign(value: Number, root: RealRoot) -> int:
    """The sign of an element of ℚ[u]/modulus where u is a real root of the modulus."""
    if isinstance(value, Algebraic):
        return sign_at(Polynomial.from_flint(value.poly), root)
    return sign(value)
