"""The interval of stability on the oscillator."""

from collections.abc import Sequence

from flint import fmpq, fmpq_mpoly

from garkcli.design.minimise.objective import Level, Size
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


def _curves(tableau: Tableau, ring: Parameters) -> Sequence[fmpq_mpoly]:
    problem = _problem(tableau)
    fields = [problem.matrix(colour) for colour in tableau.colours]
    signs, others = oscillator_curves(step_plane(tableau, ring, fields))
    return [*signs, *others]


OBJECTIVE = Level(
    "-oscillator-interval",
    "the z such that all powers of the step are bounded on the oscillator for hω ≤ z",
    _value,
    _curves,
    is_square=True,
)
"""E. Hairer, C. Lubich, G. Wanner, *Geometric Numerical Integration*, section I.5.2."""
