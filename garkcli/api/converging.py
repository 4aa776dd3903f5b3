"""Methods tested on problems: the order that errors show."""

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

    The method steps as it was given, whatever its file looks like: ``method.pair`` and
    ``method.conjugate`` are what ``--pair`` and ``--conjugate`` take.

    Args:
        method: whatever ``method_of`` takes.
        problem: a problem, the name of a built-in one, or the path of a problem file; in as many
            terms as the method is for, or in one that has a natural split. The oscillator is solved
            by the exact step map. By default the problem with random coefficients that sees every
            tree of the structure.
        t_end: the final time; the problem's own by default, 4/ω for the oscillator.
        steps: step sizes that divide ``t_end``, the largest first; by default a ladder.
        tolerance: the rounding of the coefficients; that of the method where it is not given.
            Slopes may then end on a plateau.
        is_timed: whether to measure the time of the steps in floats as well, in seconds.
        jacobian: what a Rosenbrock method takes for it: the exact one; one that is older by a step,
            at t − h and y − h f; or its diagonal alone, without ∂f/∂t. The order is then that with
            an old Jacobian, or with any matrix.

    Raises:
        MethodError: ``jacobian`` is given and it is no Rosenbrock method.
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
"""The tableaus of other matrices than the exact Jacobian."""


def taking(tableau: Tableau, tolerance: fmpq | None, jacobian: Taken) -> Tableau:
    """The tableau of the method that takes some matrix for the Jacobian.

    Args:
        tableau: with the exact one.
        tolerance: of rounded coefficients.
        jacobian: the matrix.

    Raises:
        MethodError: it is no Rosenbrock method, and no exact Jacobian is meant; or there is no such
            matrix.
    """
    if jacobian == "exact":
        return tableau
    if jacobian not in MATRICES:
        cure = did_you_mean(jacobian, ["exact", *MATRICES])
        raise MethodError(f"jacobian: {jacobian!r} is not known", cure, code="unknown-word")
    if not is_rosenbrock(tableau):
        message = f"the Jacobian {jacobian} is meant of Rosenbrock methods"
        raise MethodError(message, "leave it out", code="wanted-without-meaning")
    made = seen(meant(tableau, tolerance), MATRICES[jacobian])
    if not isinstance(made, Tableau):
        keep(made)
    return printed(made)


def _some(steps: list[fmpq]) -> list[fmpq]:
    """Step sizes, at least one.

    Raises:
        MethodError: there is none.
    """
    if not steps:
        raise MethodError("steps: there is none", "give one or more", code="arrays")
    return steps
