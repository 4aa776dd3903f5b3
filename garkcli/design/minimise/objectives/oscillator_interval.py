"""The interval of stability on the oscillator."""

from collections.abc import Sequence

from flint import fmpq

from garkcli.design.minimise.objective import Level, Signs, Size
from garkcli.design.stability_kinds import oscillator_curves
from garkcli.design.step_plane import step_plane
from garkcli.exact.cells import first_end
from garkcli.exact.parametric import Parameters
from garkcli.problems.oscillator import Oscillator, check_structure, terms_of
from garkcli.stability.oscillator import oscillator_stability
from garkcli.tableau.tableau import Tableau


def _problem(tableau: Tableau) -> Oscillator:
    problem = Oscillator.default(terms_of(tableau), fmpq(1))
    check_structure(tableau, problem)
    return problem


def _value(tableau: Tableau) -> Size:
    return first_end(oscillator_stability(tableau, _problem(tableau)).stable)


def _signs(tableau: Tableau, ring: Parameters) -> Signs:
    """The denominator, the conditions on the eigenvalues, and the entries off the diagonal."""
    problem = _problem(tableau)
    fields = [problem.matrix(colour) for colour in tableau.colours]
    conditions, others = oscillator_curves(step_plane(tableau, ring, fields))
    poles, _, _, upper, lower = others
    polynomials = [poles, *conditions, upper, lower]
    return Signs(polynomials, _is_bounded, is_closed=False, common=others)


def _is_bounded(signs: Sequence[int]) -> bool:
    """Whether all powers of the step are bounded: no pole, no eigenvalue outside the unit circle,
    and no double one ±1 that makes them grow.
    """
    pole, area, right, left, upper, lower = signs
    if not pole or min(area, right, left) < 0:
        return False
    is_double = area == 0 and 0 in (right, left)
    return not is_double or upper == lower == 0


OBJECTIVE = Level(
    "-oscillator-interval",
    "the z such that all powers of the step are bounded on the oscillator for hω ≤ z",
    _value,
    _signs,
    is_square=True,
)
"""E. Hairer, C. Lubich, G. Wanner, *Geometric Numerical Integration*, section I.5.2."""
