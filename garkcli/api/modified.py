"""Backward error analysis: the modified equation of a method, and the energy error in it."""

from __future__ import annotations

from garkcli.api.anymethod import AnyMethod, method_of, tableau_of, with_tolerance
from garkcli.api.numbers import Number, Whole, rational_or_none, whole
from garkcli.api.problems import AnyProblem, hamiltonian_for
from garkcli.backward import energy, formulas, summary
from garkcli.backward.energy import ModifiedRun
from garkcli.backward.formulas import ModifiedFormula
from garkcli.backward.summary import BackwardAnalysis
from garkcli.frozen import replace


def backward_analysis(
    method: AnyMethod, max_order: Whole, tolerance: Number | None = None
) -> BackwardAnalysis:
    """The backward error analysis of a method with trees of up to ``max_order`` vertices: ``gark
    modified``.

    With a tolerance it is that of the exact method that the coefficients approximate, to some
    digits more than are printed; orders that depend on exact zeros are undecided.

    Args:
        method: whatever ``method_of`` takes.
        max_order: the largest number of vertices of a tree, at least 1.
        tolerance: the rounding of the coefficients; that of the method where it is not given, 0 for
            none.

    Raises:
        UsageProblem: there are too many trees.

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

    Raises:
        UsageProblem: the problem is not of the form of the structure, or there are too many trees.

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
    """Measure the error of a symplectic method in its modified Hamiltonian:
    ``gark energy --modified``.

    Args:
        method: whatever ``method_of`` takes; symplectic by its coefficients, which are exact.
        problem: as in ``modified_formula``.
        max_order: the largest order of trees; powers of h go up to one less.
        t_end: the final time; the problem's own by default.
        longest: an upper bound on the step sizes.

    Raises:
        UsageProblem: the method is not symplectic or not consistent, there are too many trees or
            steps.
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
