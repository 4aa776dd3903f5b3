"""Whether the method at a solution has a kind of stability, by the ordinary engine."""

from __future__ import annotations

from collections.abc import Callable

from flint import fmpq

from garkcli.design.member import member
from garkcli.design.solutions import Solution
from garkcli.errors import UsageProblem
from garkcli.exact.field import ONE, ZERO, Algebraic, Number
from garkcli.exact.root_number import number_of
from garkcli.exact.roots import RealRoot
from garkcli.problems.oscillator import Oscillator, terms_of
from garkcli.stability.linear import (
    is_a_stable,
    is_l_stable,
    stability_function,
)
from garkcli.stability.oscillator import oscillator_stability
from garkcli.tableau.family import Family
from garkcli.tableau.tableau import Tableau

MOST_DEGREE = 6
"""Solutions of a larger degree are left open."""
NAMES = {
    "a-stable": "A-stable",
    "l-stable": "L-stable",
    "p-stable": "P-stable",
}
"""The kinds of stability that may be wanted, as people write them."""


def method_at(
    family: Family, solution: Solution, root: RealRoot
) -> Tableau | None:
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


def is_stable(key: str, tableau: Tableau) -> bool:
    """Whether a method has a kind of stability; not where it has no meaning for it."""
    try:
        return _DECIDED[key](tableau)
    except UsageProblem:
        return False


def _is_p_stable(tableau: Tableau) -> bool:
    problem = Oscillator.default(terms_of(tableau), fmpq(1))
    return oscillator_stability(tableau, problem).is_p_stable


_DECIDED: dict[str, Callable[[Tableau], bool]] = {
    "a-stable": lambda x: is_a_stable(stability_function(x)),
    "l-stable": lambda x: is_l_stable(stability_function(x)),
    "p-stable": _is_p_stable,
}
