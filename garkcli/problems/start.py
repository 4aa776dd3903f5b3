"""A problem at its initial values: the momenta that belong to velocities, and whether all fields
exist.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from flint import arb, arb_mat, ctx

from garkcli.errors import NoLegendreTransform
from garkcli.problems.mass import BITS, enclosed, is_smooth, velocities
from garkcli.problems.vectorfield import symbols


def initial_momenta(
    lagrangians: Sequence[Any],
    hamiltonians: Sequence[Any],
    variables: tuple[str, ...],
    start: Mapping[Any, arb],
) -> list[arb]:
    """p(0) with which q̇(0) is the given velocity, shape (d,).

    With one term that has velocities, p = ∂L/∂q̇. With several, each has a velocity of its own and
    q̇ = Σ_l ∂H^{l}/∂p is solved for p.

    Args:
        lagrangians: L^{l}.
        hamiltonians: H^{l}, their transforms.
        variables: d names.
        start: q(0) and q̇(0).

    Raises:
        NoLegendreTransform: several terms have velocities, and not all are quadratic in them.
    """
    v, p = velocities(variables), symbols(variables, "p")
    moving = [L for L in lagrangians if L.free_symbols & set(v)]
    if len(moving) == 1:
        return enclosed([moving[0].diff(x) for x in v], start)
    H = sum(hamiltonians)
    gradient = [H.diff(x) for x in p]
    hessian = [g.diff(y) for g in gradient for y in p]
    if any(x.free_symbols & set(p) for x in hessian):
        raise NoLegendreTransform(
            "several terms have velocities, and the momenta that belong to their sum were not "
            "found",
            "give the initial momenta instead of velocities",
        )
    d = len(p)
    places = {x: y for x, y in start.items() if x not in v}
    values = enclosed(hessian, places)
    at_rest = dict.fromkeys(p, 0)
    offsets = enclosed([g.xreplace(at_rest) for g in gradient], places)
    with ctx.workprec(BITS):
        matrix = arb_mat(d, d, values)
        pairs = zip(v, offsets, strict=True)
        right = arb_mat(d, 1, [start[x] - y for x, y in pairs])
        try:
            return [arb(x) for x in matrix.solve(right).entries()]
        except ZeroDivisionError:
            raise NoLegendreTransform(
                "the velocities do not determine the momenta at the start",
                "give the initial momenta instead of velocities",
            ) from None


def missing_derivative(
    made: Any, by: Sequence[Any], start: Mapping[Any, arb]
) -> tuple[str, str] | None:
    """What is wrong with a derivative of an expression at the start, and the cure; None where all
    derivatives exist.

    A derivative with |x| counts as none: it has no derivatives of its own.
    """
    gradient = [made.diff(x) for x in by]
    for x, g in zip(by, gradient, strict=True):
        if not is_smooth(g):
            return (
                f"the derivative by {x} has kinks, such as those of |x|",
                "write it without inverse functions",
            )
    if all(x.is_finite() for x in enclosed(gradient, start)):
        return None
    # one operation that fails spoils them all: the guilty one is undefined on its own
    failing = (
        str(x)
        for x, g in zip(by, gradient, strict=True)
        if not enclosed([g], start)[0].is_finite()
    )
    return f"no derivative by {next(failing, by[0])}", "start elsewhere"
