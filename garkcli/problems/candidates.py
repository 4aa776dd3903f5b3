"""What may solve p = ∂L/∂v(q, v) for the velocities v: by elimination, by the value of a quadratic
form, or one equation at a time.
"""

from __future__ import annotations

from dataclasses import dataclass

from flint import arb

from garkcli.errors import NoLegendreTransform
from garkcli.problems.expr import Expr, ExprMatrix, Place, Substitution, Vector, dot
from garkcli.problems.mass import enclosed, inverse_of
from garkcli.problems.solving import solutions


@dataclass(frozen=True)
class Solved:
    """Velocities as functions of positions and momenta, and what they make of forms of the
    Lagrangian.
    """

    velocities: Substitution
    forms: Substitution


@dataclass(frozen=True)
class Equations:
    """p = ∂L/∂v for velocities that depend on each other alone.

    Attributes:
        v: the velocities.
        p: their momenta.
        gradient: ∂L/∂v.
        M: ∂²L/∂v².
        start: what is known at the start.
    """

    v: Vector
    p: Vector
    gradient: Vector
    M: ExprMatrix
    start: Place

    @property
    def are_linear(self) -> bool:
        """Whether they are linear in the velocities."""
        moving = set(self.v)
        entries = [x for row in self.M for x in row]
        return not any(x.free_symbols & moving for x in entries)

    def momenta(self, at: Place) -> dict[Expr, arb]:
        """∂L/∂v where the velocities are known and the momenta are not."""
        needed: set[Expr] = set()
        for slope in self.gradient:
            needed |= slope.free_symbols
        are_known = all(x in at for x in self.p)
        if are_known or not needed <= set(at):
            return {}
        values = enclosed(self.gradient, at)
        return dict(zip(self.p, values, strict=True))


def candidates(L: Expr, equations: Equations) -> list[Solved]:
    """What may solve the equations; some do not."""
    if equations.are_linear:
        return [_by_elimination(equations)]
    found = _by_form(L, equations)
    if len(equations.v) == 1:
        (v,), (p,) = equations.v, equations.p
        (slope,) = equations.gradient
        for velocity in solutions(slope, v, p):
            found.append(Solved({v: velocity}, {}))
    return found


def _by_elimination(equations: Equations) -> Solved:
    """Where they are linear: v = M⁻¹(p − ∂L/∂v at v = 0)."""
    at_rest = dict.fromkeys(equations.v, 0)
    inverse, divisor = inverse_of(equations.M, equations.v, equations.start)
    pairs = zip(equations.p, equations.gradient, strict=True)
    shifted = [p - slope.xreplace(at_rest) for p, slope in pairs]
    products = _times(inverse, shifted)
    made = {}
    for v, x in zip(equations.v, products, strict=True):
        made[v] = x / divisor
    return Solved(made, {})


def _times(matrix: ExprMatrix, vector: Vector) -> list[Expr]:
    return [dot(row, vector) for row in matrix]


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

    a: Expr
    symbol: Expr
    G: ExprMatrix
    slope: Expr
    b: Vector
    at_rest: Expr


def _by_form(L: Expr, equations: Equations) -> list[Solved]:
    """The velocities where L depends on them by one quadratic form, and linearly besides.

    Then p − b = φ'(a) G v, so that (p − b)·G⁻¹(p − b) = 2 φ'(a)² (a − a_0) is an equation for a
    alone.
    """
    import sympy

    sums = sorted(L.atoms(sympy.Add), key=sympy.default_sort_key)
    for part in sums:
        form = _form(L, part, equations.v)
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


def _of_form(form: _Form, v: Vector, shifted: Vector, raised: Vector) -> list[Solved]:
    """The velocities G⁻¹(p − b)/φ'(a) for the values of a, from p − b and G⁻¹(p − b)."""
    import sympy

    # a symbol for the square of the momenta keeps sympy from mixing it up with the rest
    square = sympy.Dummy("n", positive=True)
    norm = {square: dot(shifted, raised)}
    moved = form.symbol - form.at_rest
    equation = 2 * form.slope**2 * moved
    found = []
    for value in solutions(equation, form.symbol, square):
        slope = form.slope.xreplace({form.symbol: value})
        slope = slope.xreplace(norm)
        made = {}
        for velocity, x in zip(v, raised, strict=True):
            made[velocity] = x / slope
        forms = {form.a: value.xreplace(norm)}
        found.append(Solved(made, forms))
    return found


def _form(L: Expr, a: Expr, v: Vector) -> _Form | None:
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
    mixed = {symbol, *v}
    is_apart = not any(x.free_symbols & mixed for x in b)
    if not (is_quadratic and is_even and is_apart):
        return None
    slope = phi.xreplace(at_rest).diff(symbol)
    return _Form(a, symbol, G, slope, b, a.xreplace(at_rest))
