"""Methods at work on problems: convergence tests, modified equations, long runs, single steps."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

from flint import arb, fmpq

from garkcli.api.anymethod import AnyMethod, method_of, tableau_of, with_tolerance
from garkcli.api.methods import find_order
from garkcli.api.numbers import Number, Whole, rational, rational_or_none, rationals, whole
from garkcli.api.problems import AnyProblem, hamiltonian_for, problem_for, to_step
from garkcli.api.stepped import stepped
from garkcli.backward import energy, formulas, summary
from garkcli.backward.energy import ModifiedRun
from garkcli.backward.formulas import ModifiedFormula
from garkcli.backward.summary import BackwardAnalysis
from garkcli.constructions.rosenbrock import Which, is_rosenbrock, seen
from garkcli.convergence import convergence
from garkcli.convergence.result import Convergence
from garkcli.errors import MethodError, counted, did_you_mean
from garkcli.frozen import replace
from garkcli.longtime import longtime, symplecticity
from garkcli.longtime.history import SERIES, LongRun, State, whole_run
from garkcli.longtime.symplecticity import Defect
from garkcli.order.meant import keep, meant, printed
from garkcli.problems.hamiltonian import FLOAT_DIGITS
from garkcli.stepping import integrator as stepping
from garkcli.stepping.integrator import Binding, Integrator, Real
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

    The method is used as given; ``method.pair`` and ``method.conjugate`` are ``--pair`` and
    ``--conjugate``.

    Args:
        method: whatever ``method_of`` takes.
        problem: with as many terms as the method has fields, or a natural split. The oscillator is
            solved by the exact step map. By default every tree of the structure matters.
        t_end: the final time; the problem's own by default, 4/ω for the oscillator.
        steps: step sizes that divide ``t_end``, the largest first; by default a ladder.
        tolerance: the rounding of the coefficients; slopes may then end on a plateau.
        is_timed: whether to measure the time of the steps in floats as well, in seconds.
        jacobian: of a Rosenbrock method: exact; that of one step before, at t − h and y − h f; or
            its diagonal, without ∂f/∂t. The order is then with an old Jacobian, or with any matrix.

    Raises:
        MethodError: ``jacobian`` is given for another kind of method.
        UsageProblem: the problem or a step does not fit, or the stage equations of a given step are
            singular.
        StepFailed: Newton's method fails for a given step size, or for all of the default ladder.

    >>> found = converge("rk4", "pendulum")
    >>> found, round(found.observed_order, 1), found.verdict
    (<Convergence pendulum: observed order 4.0, agree>, 4.0, 'agree')
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
    """Raises MethodError if there are none."""
    if not steps:
        raise MethodError("steps: there is none", "give one or more", code="arrays")
    return steps


def backward_analysis(
    method: AnyMethod, max_order: Whole, tolerance: Number | None = None
) -> BackwardAnalysis:
    """The backward error analysis of a method with trees up to ``max_order``: ``gark modified``.

    With a tolerance it is that of the exact method that the coefficients approximate, to some
    digits more than are printed; orders that depend on exact zeros are undecided.

    Args:
        method: whatever ``method_of`` takes.
        max_order: the largest number of vertices of a tree, at least 1.
        tolerance: the rounding of the coefficients; by default that of the method, 0 for none.

    >>> found = backward_analysis("stoermer-verlet", 5)
    >>> found, found.symplectic, found.effective.order
    (<BackwardAnalysis order 2, symplectic>, Reached(order=5, is_lower_bound=True), 2)
    """
    most = whole(max_order, "max_order", 1)
    method, near = with_tolerance(method, tolerance)
    return summary.backward_analysis(method.tableau, most, near)


def modified_formula(method: AnyMethod, problem: AnyProblem, max_order: Whole) -> ModifiedFormula:
    """The modified Hamiltonian of a symplectic method, or the modified equation of another one.

    Args:
        method: whatever ``method_of`` takes; its coefficients are exact.
        problem: a Hamiltonian problem, the name of a built-in one, or the path of a problem file.
        max_order: the largest order of trees; powers of h go up to one less.

    >>> for term in modified_formula("stoermer-verlet", "pendulum", 4).expanded().terms:
    ...     print(term.power, *term.formulas)
    0 px**2/2 - cos(x) + 1
    2 px**2*cos(x)/12 - sin(x)**2/24
    """
    tableau = tableau_of(method)
    most = whole(max_order, "max_order", 1)
    return formulas.modified_formula(tableau, hamiltonian_for(problem, tableau), most)


def modified_run(
    method: AnyMethod,
    problem: AnyProblem,
    max_order: Whole,
    t_end: Number | None = None,
    longest: Number | None = None,
) -> ModifiedRun:
    """The error of a symplectic method in its modified Hamiltonian: ``gark energy --modified``.

    Args:
        method: whatever ``method_of`` takes; symplectic by its coefficients, which are exact.
        problem: as in ``modified_formula``.
        max_order: the largest order of trees; powers of h go up to one less.
        t_end: the final time; the problem's own by default.
        longest: an upper bound on the step sizes.

    Raises:
        UsageProblem: the method is not symplectic or consistent, or there is too much work.
        StepFailed: the stage equations of a step were not solved.

    >>> run = modified_run("stoermer-verlet", "pendulum", 3)
    >>> run, [(x.power, x.exact_order, x.verdict) for x in run.energies]
    (<ModifiedRun pendulum: h^0 agree, h^2 agree>, [(0, 2, 'agree'), (2, 4, 'agree')])
    """
    method = method_of(method)
    tableau = method.tableau
    run = energy.modified_run(
        tableau,
        hamiltonian_for(problem, tableau),
        whole(max_order, "max_order", 1),
        rational_or_none(t_end, "t_end"),
        rational_or_none(longest, "longest"),
    )
    return replace(run, method=method)


def long_run(
    method: AnyMethod,
    problem: AnyProblem,
    t_end: Number | None = None,
    step: Number | None = None,
    digits: Whole = FLOAT_DIGITS,
    points: Whole = SERIES,
    tolerance: Number | None = None,
) -> LongRun:
    """Follow the energy and other invariants of a problem over a long time: ``gark energy``.

    The method is used as given, as in ``converge``.

    Args:
        method: whatever ``method_of`` takes.
        problem: as in ``converge``.
        t_end: the final time, a whole number of steps; by default one long enough to see a drift.
        step: the step size h; by default that of the problem, or a smaller one that divides
            ``t_end``.
        digits: the digits of the steps; floats up to 15. Steps of the oscillator are exact.
        points: the approximate number of times that are kept, including extremes.
        tolerance: the rounding of the coefficients; a drift that it may explain is undecided.

    Raises:
        UsageProblem: the problem or the step does not fit, or the oscillator has a singular step.
        StepFailed: the stage equations of a step were not solved, before the energy had blown up.

    >>> run = long_run("stoermer-verlet", "pendulum", 50, "1/10")
    >>> run, [(x.name, x.verdict) for x in run.invariants]
    (<LongRun pendulum: 500 steps of 1/10, energy bounded>, [('energy', 'bounded')])
    """
    method, near = with_tolerance(method, tolerance)
    found = problem_for(problem, method.tableau)
    h, end = whole_run(
        rational_or_none(step, "step"), rational_or_none(t_end, "t_end"), *longtime.usual(found)
    )
    run = longtime.long_run(
        method.tableau, found, end, h, whole(digits, "digits", 1), whole(points, "points", 1), near
    )
    return replace(run, method=method)


def symplecticity_defects(
    method: AnyMethod, problem: AnyProblem, step: Number, states: Sequence[State]
) -> tuple[Defect, ...]:
    """The defects of symplecticity: the entries of MᵀJM − J for the Jacobians M of steps.

    Args:
        method: whatever ``method_of`` takes.
        problem: as in ``converge``; it is Hamiltonian.
        step: the step size h.
        states: times with (q, p), as in ``LongRun.states``.

    >>> states = long_run("rk4", "pendulum", 1, "1/10").states[:1]
    >>> [defect.is_seen for defect in symplecticity_defects("rk4", "pendulum", "1/10", states)]
    [True]
    """
    tableau = tableau_of(method)
    return symplecticity.symplecticity_defects(
        tableau, hamiltonian_for(problem, tableau), rational(step, "step"), states
    )


def bind(method: AnyMethod, problem: AnyProblem) -> Binding:
    """Prepare a method for a problem, to step with any number of digits.

    Args:
        method: whatever ``method_of`` takes.
        problem: as in ``converge``, except the oscillator.

    >>> made = bind("rk4", "pendulum")
    >>> made.at(), made.at(50)
    (<Integrator pendulum: 15 digits>, <Integrator pendulum: 50 digits>)
    """
    tableau = tableau_of(method)
    return stepping.bind(tableau, to_step(problem, tableau))


def integrate(
    integrator: Integrator | Binding, h: Number, count: Whole, initial: Sequence[Any] | None = None
) -> list[Real]:
    """The state after ``count`` steps, as in ``trajectory``.

    Args:
        integrator: ``bind(method, problem)``, or that ``.at(digits)``.
        h: the step size.
        count: the number of steps.
        initial: the initial state.

    >>> [round(x, 6) for x in integrate(bind("rk4", "pendulum").at(), "1/10", 10)]
    [1.056272, -0.391965]
    """
    made = _made(integrator)
    start = _start(made, initial)
    many = whole(count, "count")
    return stepping.integrate(made, rational(h, "h"), many, start)


def trajectory(
    integrator: Integrator | Binding,
    h: Number,
    count: Whole,
    initial: Sequence[Any] | None = None,
    every: Whole = 1,
) -> Iterator[list[Real]]:
    """The state at the start and after each ``every`` of ``count`` steps.

    Args:
        integrator: ``bind(method, problem)``, or that ``.at(digits)``.
        h: the step size.
        count: the number of steps.
        initial: shape (2d,) for (q, p), (d,) for y; by default that of the problem.
        every: the number of steps between states; the last one is after ``count``.

    Returns:
        States of the shape of ``initial``: floats up to 15 digits, otherwise midpoints of balls.

    Raises:
        StepFailed: the stage equations of a step were not solved.

    >>> made = bind("rk4", "pendulum").at()
    >>> [[round(x, 3) for x in y] for y in trajectory(made, 0.5, 4, every=2)]
    [[1.0, 0.5], [1.056, -0.392], [0.292, -1.041]]
    """
    made = _made(integrator)
    return stepping.trajectory(
        made,
        rational(h, "h"),
        whole(count, "count"),
        _start(made, initial),
        whole(every, "every", 1),
    )


def _made(given: Integrator | Binding) -> Integrator:
    return given.at() if isinstance(given, Binding) else given


def _start(integrator: Integrator, initial: Sequence[Any] | None) -> list[Any] | None:
    """Raises MethodError unless there are as many numbers as unknowns."""
    if initial is None:
        return None
    wanted = integrator.problem.layout.unknowns
    if len(initial) != wanted:
        message = f"initial: {counted(len(initial), 'number')} for {counted(wanted, 'unknown')}"
        cure = "positions first, then momenta, as problem.initial has them"
        raise MethodError(message, cure, code="pasted-tableau")
    return [
        x if isinstance(x, (float, arb)) else rational(x, f"initial[{i}]")
        for i, x in enumerate(initial)
    ]
