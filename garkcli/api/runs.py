"""Methods at work on problems: long runs, single steps."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

from flint import arb

from garkcli.api.anymethod import AnyMethod, tableau_of, with_tolerance
from garkcli.api.numbers import Number, Whole, rational, rational_or_none, whole
from garkcli.api.problems import AnyProblem, hamiltonian_for, problem_for, to_step
from garkcli.errors import MethodError, counted
from garkcli.frozen import replace
from garkcli.longtime import longtime, symplecticity
from garkcli.longtime.history import SERIES, LongRun, State, whole_run
from garkcli.longtime.symplecticity import Defect
from garkcli.problems.hamiltonian import FLOAT_DIGITS
from garkcli.stepping import integrator as stepping
from garkcli.stepping.integrator import Binding, Integrator, Real


def long_run(
    method: AnyMethod,
    problem: AnyProblem,
    t_end: Number | None = None,
    step: Number | None = None,
    digits: Whole = FLOAT_DIGITS,
    points: Whole = SERIES,
    tolerance: Number | None = None,
) -> LongRun:
    """Solve a problem over a long time and follow its energy and other invariants:
    ``gark energy``.

    The method is used as given, as in ``converge``.

    Args:
        method: whatever ``method_of`` takes.
        problem: as in ``converge``.
        t_end: the final time, a whole number of steps; by default one long enough to see a drift.
        step: the step size h; by default that of the problem, or a smaller one that divides
            ``t_end``.
        digits: the digits of the steps; floats up to 15. Steps of the oscillator are exact.
        points: the approximate number of times that are kept, including extremes.
        tolerance: the rounding of the coefficients; that of the method where it is not given. A
            drift that it may explain is undecided.

    Raises:
        UsageProblem: the problem is not of the form of the structure, the step does not divide the
            time, there are too many of them, or the stage equations of the oscillator have no
            unique solution.
        StepFailed: the stage equations of a step were not solved, and the energy had not blown up
            before.

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

    Raises:
        StepFailed: the stage equations of a step were not solved.

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

    Raises:
        UsageProblem: the problem is not of the form of the structure.

    >>> made = bind("rk4", "pendulum")
    >>> made.at(), made.at(50)
    (<Integrator pendulum: 15 digits>, <Integrator pendulum: 50 digits>)
    """
    tableau = tableau_of(method)
    return stepping.bind(tableau, to_step(problem, tableau))


def integrate(
    integrator: Integrator | Binding, h: Number, count: Whole, initial: Sequence[Any] | None = None
) -> list[Real]:
    """The state after ``count`` steps.

    Args:
        integrator: ``bind(method, problem)``, or that ``.at(digits)``.
        h: the step size.
        count: the number of steps.
        initial: the initial state, as in ``trajectory``.

    Returns:
        As ``trajectory``.

    Raises:
        MethodError: ``initial`` has more or fewer numbers than there are unknowns.
        StepFailed: the stage equations of a step were not solved.

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
        initial: the initial state, shape (2d,) for (q, p) of a Hamiltonian problem, (d,) for y of
            any other; by default that of the problem.
        every: the number of steps between states; the last one is after ``count``.

    Returns:
        States of the shape of ``initial``: floats up to 15 digits, otherwise midpoints of balls.

    Raises:
        MethodError: ``initial`` has more or fewer numbers than there are unknowns.
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
    """Returns the initial state with as many numbers as there are unknowns.

    Raises MethodError for other numbers.
    """
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
