"""Whether the method at a solution has a kind of stability, by the ordinary engine."""

from __future__ import annotations

from flint import fmpq

from garkcli.design.member import member
from garkcli.design.solutions import Solution
from garkcli.errors import UsageProblem
from garkcli.exact.field import ONE, ZERO, Algebraic, Number
from garkcli.exact.roots import RealRoot, number_of
from garkcli.problems.oscillator import Oscillator, terms_of
from garkcli.stability.linear import is_a_stable, is_l_stable, stability_function
from garkcli.stability.oscillator import oscillator_stability
from garkcli.tableau.family import Family, Stability
from garkcli.tableau.tableau import Tableau

MOST_DEGREE = 6
"""Solutions of a larger degree are left open."""


def method_at(family: Family, solution: Solution, root: RealRoot) -> Tableau | None:
    """The method at a real root of a solution; None where its field is too large.

    Raises:
        ZeroDivisionError: a denominator is zero there.
    """
    u = number_of(root, MOST_DEGREE)
    if u is None:
        return None
    values = {name: _at(x, u) for name, x in solution.values.items()}
    return member(family.tableau, family.ring, values)


def _at(value: Number, u: Number) -> Number:
    """An element of ℚ[u]/modulus where u is a number."""
    if not isinstance(value, Algebraic):
        return value
    total: Number = ZERO
    for coefficient in reversed(value.poly.coeffs()):
        total = total * u + ONE * coefficient
    return total


def is_stable(wanted: Stability, tableau: Tableau) -> bool:
    """Whether a method has a kind of stability; not where it has no meaning for it."""
    if wanted.kind == "p-stable":
        return _is_p_stable(tableau)
    R = stability_function(tableau, shares_of(tableau, wanted.colour))
    return is_l_stable(R) if wanted.kind == "l-stable" else is_a_stable(R)


def shares_of(tableau: Tableau, colour: int | None) -> list[Number]:
    """The λ of each colour of the linear test equation: all alike, or 0 but for one colour."""
    return [ONE if colour in (None, l) else ZERO for l in range(tableau.size)]


def _is_p_stable(tableau: Tableau) -> bool:
    problem = Oscillator.default(terms_of(tableau), fmpq(1))
    try:
        return oscillator_stability(tableau, problem).is_p_stable
    except UsageProblem:
        return False
