"""The velocities of a Lagrangian that is not quadratic in them: p = ∂L/∂q̇(q, v) solved for v, and
tested.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from flint import arb, ctx, fmpq

from garkcli.errors import NoLegendreTransform
from garkcli.problems.draw import Draw
from garkcli.problems.mass import (
    BITS,
    WRITE_HAMILTONIAN,
    Lagrangian,
    coupled,
    enclosed,
    inverse_of,
    is_smooth,
    velocities,
)
from garkcli.problems.solving import solutions
from garkcli.problems.vectorfield import symbols

_TRIES = 8  # random places where a solution is tested
_NEAR = 50  # thousandths: how far from the start they are
_GOOD = 1e-40  # what enclosures have to be good to, to tell that two numbers are one


@dataclass(frozen=True)
class _Solved:
    """Velocities as functions of positions and momenta, and what they make of forms of the
    Lagrangian.
    """

    velocities: Mapping[Any, Any]
    forms: Mapping[Any, Any]


@dataclass(frozen=True)
class _Equations:
    """p = ∂L/∂v for velocities that depend on each other alone.

    Attributes:
        v: the velocities.
        p: their momenta.
        gradient: ∂L/∂v.
        M: ∂²L/∂v².
        start: what is known at the start.
    """

    v: Sequence[Any]
    p: Sequence[Any]
    gradient: Sequence[Any]
    M: Sequence[Sequence[Any]]
    start: Mapping[Any, arb]

    @property
    def are_linear(self) -> bool:
        """Whether they are linear in the velocities."""
        moving = set(self.v)
        entries = [x for row in self.M for x in row]
        return not any(x.free_symbols & moving for x in entries)

    def momenta(self, at: Mapping[Any, arb]) -> dict[Any, arb]:
        """∂L/∂v where the velocities are known and the momenta are not."""
        needed: set[Any] = set()
        for slope in self.gradient:
            needed |= slope.free_symbols
        are_known = all(x in at for x in self.p)
        if are_known or not needed <= set(at):
            return {}
        values = enclosed(self.gradient, at)
        return dict(zip(self.p, values, strict=True))


def by_solving(lagrangian: Lagrangian) -> Any:
    """The transform of a Lagrangian that is not quadratic; see ``legendre_transform``."""
    L, gradient, M = lagrangian.L, lagrangian.gradient, lagrangian.M
    variables = lagrangian.variables
    v, p = velocities(variables), symbols(variables, "p")
    replaced: dict[Any, Any] = {}
    for block in coupled(M):
        equations = _Equations(
            [v[i] for i in block],
            [p[i] for i in block],
            [gradient[i] for i in block],
            [[M[i][j] for j in block] for i in block],
            lagrangian.start,
        )
        solved = _solution(L, equations, p)
        replaced |= {**solved.velocities, **solved.forms}
    work = sum(a * replaced[x] for a, x in zip(p, v, strict=True))
    H = work - L.xreplace(replaced)
    arguments = (*symbols(variables, "q"), *p)
    derivatives = (H.diff(x) for x in arguments)
    if not is_smooth(H) or not all(map(is_smooth, derivatives)):
        raise NoLegendreTransform(
            "the Hamiltonian was not found without kinks", WRITE_HAMILTONIAN
        )
    return H


def _solution(L: Any, equations: _Equations, p: Sequence[Any]) -> _Solved:
    """The one solution that is right.

    Raises:
        NoLegendreTransform: none was found, or the start does not tell which it is.
    """
    right: list[_Solved] = []
    for candidate in _candidates(L, equations):
        smooth = _smooth(candidate, p)
        right += [x for x in smooth if _is_right(x.velocities, equations)]
    if not right:
        whose = ", ".join(map(str, equations.v))
        raise NoLegendreTransform(
            f"p = ∂L/∂v was not solved for {whose}", WRITE_HAMILTONIAN
        )
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


def _candidates(L: Any, equations: _Equations) -> list[_Solved]:
    """What may solve the equations; some do not."""
    if equations.are_linear:
        return [_by_elimination(equations)]
    found = _by_form(L, equations)
    if len(equations.v) == 1:
        (v,), (p,) = equations.v, equations.p
        (slope,) = equations.gradient
        found += [_Solved({v: x}, {}) for x in solutions(slope, v, p)]
    return found


def _by_elimination(equations: _Equations) -> _Solved:
    """Where they are linear: v = M⁻¹(p − ∂L/∂v at v = 0)."""
    at_rest = dict.fromkeys(equations.v, 0)
    inverse, divisor = inverse_of(equations.M, equations.v, equations.start)
    pairs = zip(equations.p, equations.gradient, strict=True)
    shifted = [p - slope.xreplace(at_rest) for p, slope in pairs]
    products = _times(inverse, shifted)
    made = {}
    for v, x in zip(equations.v, products, strict=True):
        made[v] = x / divisor
    return _Solved(made, {})


def _times(
    matrix: Sequence[Sequence[Any]], vector: Sequence[Any]
) -> list[Any]:
    return [_dot(row, vector) for row in matrix]


def _dot(left: Sequence[Any], right: Sequence[Any]) -> Any:
    return sum(a * x for a, x in zip(left, right, strict=True))


@dataclass(frozen=True)
class _Form:
    """L = φ(q, a) + b(q)·v with one form a = a_0(q) + ½ v·G(q)v.

    Attributes:
        a: the form, as it stands in L.
        symbol: what stands for it in φ.
        G: the matrix.
        slope: φ'(a).
        b: of the linear part.
        at_rest: a_0.
    """

    a: Any
    symbol: Any
    G: Sequence[Sequence[Any]]
    slope: Any
    b: Sequence[Any]
    at_rest: Any


def _by_form(L: Any, equations: _Equations) -> list[_Solved]:
    """The velocities where L depends on them by one quadratic form, and linearly besides.

    Then p − b = φ'(a) G v, so that (p − b)·G⁻¹(p − b) = 2 φ'(a)² (a − a_0) is an equation for a
    alone.
    """
    import sympy

    candidates = sorted(L.atoms(sympy.Add), key=sympy.default_sort_key)
    for candidate in candidates:
        form = _form(L, candidate, equations.v)
        if form is None:
            continue
        try:
            inverse, divisor = inverse_of(form.G, equations.v, equations.start)
        except NoLegendreTransform:
            continue
        pairs = zip(equations.p, form.b, strict=True)
        shifted = [p - b for p, b in pairs]
        raised = [x / divisor for x in _times(inverse, shifted)]
        return _of_form(form, equations.v, shifted, raised)
    return []


def _of_form(
    form: _Form,
    v: Sequence[Any],
    shifted: Sequence[Any],
    raised: Sequence[Any],
) -> list[_Solved]:
    """The velocities G⁻¹(p − b)/φ'(a) for the values of a, from p − b and G⁻¹(p − b)."""
    import sympy

    # a symbol for the square of the momenta keeps sympy from mixing it up with the rest
    square = sympy.Dummy("n", positive=True)
    norm = {square: _dot(shifted, raised)}
    equation = 2 * form.slope**2 * (form.symbol - form.at_rest)
    found = []
    for value in solutions(equation, form.symbol, square):
        slope = form.slope.xreplace({form.symbol: value})
        slope = slope.xreplace(norm)
        made = {}
        for velocity, x in zip(v, raised, strict=True):
            made[velocity] = x / slope
        found.append(_Solved(made, {form.a: value.xreplace(norm)}))
    return found


def _form(L: Any, a: Any, v: Sequence[Any]) -> _Form | None:
    """L by its part ``a``; None where that is no quadratic form that has all velocities, or where
    they occur besides it other than linearly.
    """
    import sympy

    moving = set(v)
    at_rest = dict.fromkeys(v, 0)
    if not moving <= a.free_symbols:
        return None
    slopes = [a.diff(x) for x in v]
    G = [[slope.diff(y) for y in v] for slope in slopes]
    entries = [x for row in G for x in row]
    is_quadratic = not any(x.free_symbols & moving for x in entries)
    is_even = all(slope.xreplace(at_rest) == 0 for slope in slopes)
    symbol = sympy.Dummy("a", real=True)
    phi = L.xreplace({a: symbol})
    b = [phi.diff(x) for x in v]
    is_apart = not any(x.free_symbols & {symbol, *v} for x in b)
    if not (is_quadratic and is_even and is_apart):
        return None
    slope = phi.xreplace(at_rest).diff(symbol)
    return _Form(a, symbol, G, slope, b, a.xreplace(at_rest))


def _smooth(solved: _Solved, p: Sequence[Any]) -> list[_Solved]:
    """A candidate; in place of one with |y| those with y and with −y, where y is made of momenta
    alone.

    An analytic velocity that is right near the start is right as far as it is analytic. None is
    returned for what is not real or has kinks at some positions.
    """
    import sympy

    made = (*solved.velocities.values(), *solved.forms.values())
    if any(x.has(sympy.I, sympy.zoo, sympy.nan) for x in made):
        return []
    kinks: set[Any] = set()
    for x in made:
        kinks |= x.atoms(sympy.Abs)
    if not kinks:
        return [solved]
    momenta = set(p)
    if any(x.free_symbols - momenta for x in kinks):
        return []
    return [_with_sign(solved, sign) for sign in (1, -1)]


def _with_sign(solved: _Solved, sign: int) -> _Solved:
    """The same with ``sign`` · y for |y|."""
    import sympy

    def without_kinks(y: Any) -> Any:
        return y.replace(sympy.Abs, lambda u: sign * u)

    def signed(of: Mapping[Any, Any]) -> dict[Any, Any]:
        return {x: without_kinks(y) for x, y in of.items()}

    return _Solved(signed(solved.velocities), signed(solved.forms))


def _is_right(solved: Mapping[Any, Any], equations: _Equations) -> bool:
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


def _agrees(
    solved: Mapping[Any, Any], equations: _Equations, place: Mapping[Any, arb]
) -> bool | None:
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
    pairs += [(found[v], at[v]) for v in solved if v in at]
    if not all(x.is_finite() for pair in pairs for x in pair):
        return None
    return all(_are_one(x, y) for x, y in pairs)


def _are_one(x: arb, y: arb) -> bool:
    """Whether two enclosures, both good, may be those of one number."""
    is_good = x.rad() + y.rad() < _GOOD
    return bool(is_good and x.overlaps(y))
