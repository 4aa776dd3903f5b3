"""The velocities of a Lagrangian that is not quadratic in them: p = ∂L/∂q̇(q, v) solved for v, and
tested.
"""

from __future__ import annotations

from flint import arb, ctx, fmpq

from garkcli.errors import NoLegendreTransform
from garkcli.problems.candidates import Equations, Solved, candidates
from garkcli.problems.draw import Draw
from garkcli.problems.expr import Expr, Place, Substitution, Vector, dot
from garkcli.problems.mass import (
    BITS,
    WRITE_HAMILTONIAN,
    Lagrangian,
    coupled,
    enclosed,
    is_smooth,
    velocities,
)
from garkcli.problems.vectorfield import symbols

_TRIES = 8  # random places where a solution is tested
_NEAR = 50  # thousandths: how far from the start they are
_GOOD = 1e-40  # what enclosures have to be good to, to tell that two numbers are one


def by_solving(lagrangian: Lagrangian) -> Expr:
    """The transform of a Lagrangian that is not quadratic; see ``legendre_transform``."""
    L, gradient, M = lagrangian.L, lagrangian.gradient, lagrangian.M
    variables = lagrangian.variables
    v, p = velocities(variables), symbols(variables, "p")
    replaced: dict[Expr, Expr] = {}
    for block in coupled(M):
        equations = Equations(
            [v[i] for i in block],
            [p[i] for i in block],
            [gradient[i] for i in block],
            [[M[i][j] for j in block] for i in block],
            lagrangian.start,
        )
        solved = _solution(L, equations, p)
        replaced |= {**solved.velocities, **solved.forms}
    work = dot(p, [replaced[x] for x in v])
    H = work - L.xreplace(replaced)
    arguments = (*symbols(variables, "q"), *p)
    derivatives = (H.diff(x) for x in arguments)
    if not is_smooth(H) or not all(map(is_smooth, derivatives)):
        raise NoLegendreTransform("the Hamiltonian was not found without kinks", WRITE_HAMILTONIAN)
    return H


def _solution(L: Expr, equations: Equations, p: Vector) -> Solved:
    """The one solution that is right.

    Raises:
        NoLegendreTransform: none was found, or the start does not tell which it is.
    """
    right: list[Solved] = []
    for candidate in candidates(L, equations):
        smooth = _smooth(candidate, p)
        right += [x for x in smooth if _is_right(x.velocities, equations)]
    if not right:
        whose = ", ".join(map(str, equations.v))
        raise NoLegendreTransform(f"p = ∂L/∂v was not solved for {whose}", WRITE_HAMILTONIAN)
    known = {**equations.start, **equations.momenta(equations.start)}
    found = []
    for solved in right:
        expressions = list(solved.velocities.values())
        found.append(enclosed(expressions, known))
    first, *others = found
    for other in others:
        pairs = zip(first, other, strict=True)
        if not all(x.overlaps(y) for x, y in pairs):
            raise NoLegendreTransform(
                "several velocities have these momenta at the start",
                "give the initial velocities instead of momenta",
            )
    return right[0]


def _smooth(solved: Solved, p: Vector) -> list[Solved]:
    """A candidate; in place of one with |y| those with y and with −y, where y is made of momenta
    alone.

    An analytic velocity that is right near the start is right as far as it is analytic. None is
    returned for what is not real or has kinks at some positions.
    """
    import sympy

    made = (*solved.velocities.values(), *solved.forms.values())
    not_real = sympy.I, sympy.zoo, sympy.nan
    if any(x.has(*not_real) for x in made):
        return []
    kinks: set[Expr] = set()
    for x in made:
        kinks |= x.atoms(sympy.Abs)
    if not kinks:
        return [solved]
    momenta = set(p)
    if any(x.free_symbols - momenta for x in kinks):
        return []
    return [_with_sign(solved, sign) for sign in (1, -1)]


def _with_sign(solved: Solved, sign: int) -> Solved:
    """The same with ``sign`` · y for |y|."""
    import sympy

    def without_kinks(y: Expr) -> Expr:
        return y.replace(sympy.Abs, lambda u: sign * u)

    def signed(of: Substitution) -> dict[Expr, Expr]:
        return {x: without_kinks(y) for x, y in of.items()}

    return Solved(signed(solved.velocities), signed(solved.forms))


def _is_right(solved: Substitution, equations: Equations) -> bool:
    """Whether ∂L/∂v(q, v(q, p)) is p, and v(q, p) the velocity at the start, wherever it is
    tested: at the start, and at most of some places near it.
    """
    draw = Draw(1)
    if _agrees(solved, equations, equations.start) is not True:
        return False
    tested = 1
    for _ in range(_TRIES - 1):
        near = {}
        with ctx.workprec(BITS):
            for x, y in equations.start.items():
                moved = fmpq(draw.between(-_NEAR, _NEAR), 1000)
                near[x] = y + arb(moved)
        found = _agrees(solved, equations, near)
        if found is False:
            return False
        tested += found is True
    return tested > _TRIES // 2


def _agrees(solved: Substitution, equations: Equations, place: Place) -> bool | None:
    """Whether the equations hold at one place; None where something has no value there."""
    at = {**place, **equations.momenta(place)}
    if not all(x in at for x in equations.p):
        return False
    values = enclosed(list(solved.values()), at)
    found = dict(zip(solved, values, strict=True))
    back = enclosed(equations.gradient, {**at, **found})
    pairs = []
    for p, value in zip(equations.p, back, strict=True):
        pairs.append((value, at[p]))
    known = [v for v in solved if v in at]
    pairs += [(found[v], at[v]) for v in known]
    for x, y in pairs:
        if not (x.is_finite() and y.is_finite()):
            return None
    return all(_are_one(x, y) for x, y in pairs)


def _are_one(x: arb, y: arb) -> bool:
    """Whether two enclosures, both good, may be those of one number."""
    is_good = x.rad() + y.rad() < _GOOD
    return bool(is_good and x.overlaps(y))
