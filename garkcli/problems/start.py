"""A problem at its initial values: the momenta that belong to velocities, and whether all fields
exist.
"""

from __future__ import annotations

from flint import arb, arb_mat, ctx

from garkcli.errors import NoLegendreTransform
from garkcli.problems.expr import Expr, Place, Vector
from garkcli.problems.mass import BITS, enclosed, is_smooth, velocities
from garkcli.problems.vectorfield import symbols


def initial_momenta(
    lagrangians: Vector, hamiltonians: Vector, variables: tuple[str, ...], start: Place
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
        (L,) = moving
        return enclosed([L.diff(x) for x in v], start)
    H: Expr = sum(hamiltonians)
    gradient = [H.diff(x) for x in p]
    hessian = [g.diff(y) for g in gradient for y in p]
    if any(x.free_symbols & set(p) for x in hessian):
        raise NoLegendreTransform(
            "several terms have velocities, and the momenta that belong to their sum were not "
            "found",
            "give the initial momenta instead of velocities",
        )
    # q̇(0) = ∂²H/∂p² p(0) + ∂H/∂p at p = 0
    d = len(p)
    places = {x: y for x, y in start.items() if x not in v}
    at_rest = dict.fromkeys(p, 0)
    offsets = [g.xreplace(at_rest) for g in gradient]
    with ctx.workprec(BITS):
        matrix = arb_mat(d, d, enclosed(hessian, places))
        pairs = zip(v, enclosed(offsets, places), strict=True)
        rest = [start[x] - y for x, y in pairs]
        right = arb_mat(d, 1, rest)
        try:
            momenta = matrix.solve(right).entries()
            return [arb(x) for x in momenta]
        except ZeroDivisionError:
            raise NoLegendreTransform(
                "the velocities do not determine the momenta at the start",
                "give the initial momenta instead of velocities",
            ) from None


def missing_derivative(made: Expr, by: Vector, start: Place) -> tuple[str, str] | None:
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
    guilty = by[0]
    for x, g in zip(by, gradient, strict=True):
        (alone,) = enclosed([g], start)
        if not alone.is_finite():
            guilty = x
            break
    return f"no derivative by {guilty}", "start elsewhere"
