"""The observed orders of methods on problems."""

from __future__ import annotations

from collections.abc import Sequence

from flint import fmpq

from garkcli.api.anymethod import AnyMethod, with_tolerance
from garkcli.api.methods import find_order
from garkcli.api.numbers import Number, rational_or_none, rationals
from garkcli.api.problems import AnyProblem, problem_for
from garkcli.api.stepped import stepped
from garkcli.constructions.rosenbrock import Which, is_rosenbrock, seen
from garkcli.convergence import convergence
from garkcli.convergence.result import Convergence
from garkcli.errors import MethodError, did_you_mean
from garkcli.frozen import replace
from garkcli.order.meant import keep, meant, printed
from garkcli.stepping.linearly_implicit import Taken
from garkcli.tableau.tableau import Tableau


def converge(
    method: AnyMethod,
    problem: AnyProblem | None = None,
    t_end: Number | None = None,
    steps: Sequence[Number] | None = None,
    tolerance: Number | None = None,
    is_timed: bool = False,
    jacobian: Taken = "exact",
) -> Convergence:
    """Test the convergence of a method on a problem: ``gark converge``.

    The method is used as given; ``method.pair`` and ``method.conjugate`` correspond to ``--pair``
    and ``--conjugate``.

    Args:
        method: whatever ``method_of`` takes.
        problem: a problem, the name of a built-in one, or the path of a problem file; with as many
            terms as the method has fields, or with one that has a natural split. The oscillator is
            solved by the exact step map. By default the problem with random coefficients for which
            every tree of the structure matters.
        t_end: the final time; the problem's own by default, 4/ω for the oscillator.
        steps: step sizes that divide ``t_end``, the largest first; by default a ladder.
        tolerance: the rounding of the coefficients; that of the method where it is not given.
            Slopes may then end on a plateau.
        is_timed: whether to measure the time of the steps in floats as well, in seconds.
        jacobian: the matrix of a Rosenbrock method: the exact Jacobian; that of one step before, at
            t − h and y − h f; or its diagonal, without ∂f/∂t. The order is then that with an old
            Jacobian, or with any matrix.

    Raises:
        MethodError: ``jacobian`` is given for another kind of method.
        UsageProblem: the problem is not of the form of the structure, a step does not divide
            ``t_end``, or the stage equations of a given step have no unique solution.
        StepFailed: Newton's method fails for a given step size, or for all of the default ladder.

    >>> found = converge("rk4", "pendulum")
    >>> found, round(found.observed_order, 1), found.verdict
    (<Convergence pendulum: observed order 4.0, agree>, 4.0, 'agree')
    >>> found.rows[0].h, float(found.rows[0].error) < 0.1
    (1, True)
    """
    is_own = tolerance is None
    method, near = with_tolerance(method, tolerance, is_any_kind=True)
    taken = taking(method.tableau, near, jacobian)
    tableau, problem, order = stepped(taken, near, problem)
    if near is not None and is_own and method.base is not None:
        order = find_order(method).order
    found = convergence.converge(
        tableau,
        None if problem is None else problem_for(problem, tableau),
        rational_or_none(t_end, "t_end"),
        None if steps is None else _some(rationals(steps, "steps")),
        near,
        is_timed,
        order,
    )
    return replace(found, method=method, jacobian=jacobian)


MATRICES: dict[Taken, Which] = {"old": "with_old_jacobian", "diagonal": "with_any_matrix"}
"""The tableaus for other matrices than the exact Jacobian."""


def taking(tableau: Tableau, tolerance: fmpq | None, jacobian: Taken) -> Tableau:
    """Returns the tableau of a Rosenbrock method with some matrix for the Jacobian.

    Raises MethodError for other methods, unless the Jacobian is exact, and for unknown matrices.
    """
    if jacobian == "exact":
        return tableau
    if jacobian not in MATRICES:
        cure = did_you_mean(jacobian, ["exact", *MATRICES])
        raise MethodError(f"jacobian: {jacobian!r} is not known", cure, code="unknown-word")
    if not is_rosenbrock(tableau):
        message = f"the Jacobian {jacobian} applies to Rosenbrock methods only"
        raise MethodError(message, "leave it out", code="wanted-without-meaning")
    made = seen(meant(tableau, tolerance), MATRICES[jacobian])
    if not isinstance(made, Tableau):
        keep(made)
    return printed(made)


def _some(steps: list[fmpq]) -> list[fmpq]:
    """Returns the step sizes; raises MethodError if there are none."""
    if not steps:
        raise MethodError("steps: there is none", "give one or more", code="arrays")
    return steps
