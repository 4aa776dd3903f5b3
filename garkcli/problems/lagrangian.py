"""The Legendre transform H(q, p) = p·v − L(q, v), p = ∂L/∂q̇(q, v), in closed form.

In the paper each term of a split Lagrangian has a velocity of its own: the stages Q̇^{l} belong to
P^{l} = ∂L^{l}/∂q̇(Q^{l}, Q̇^{l}), and q̇ = Σ_l V^{l}. So the terms are transformed one by one to
H^{l}; a term L^{l} without velocities becomes −L^{l}, without momenta (the semi-separable and
separable cases).
"""

from __future__ import annotations

from flint import arb, arb_mat, ctx, fmpq

from garkcli.doing import doing
from garkcli.errors import NoLegendreTransform
from garkcli.frozen import Frozen
from garkcli.problems import mass
from garkcli.problems.draw import Draw
from garkcli.problems.expr import Expr, ExprMatrix, Place, Substitution, Vector, dot
from garkcli.problems.mass import velocities
from garkcli.problems.solving import solutions
from garkcli.problems.vectorfield import symbols


class SolvedVelocities(Frozen):
    velocities: Substitution
    forms: Substitution


class Equations(Frozen):
    """p = ∂L/∂v for coupled velocities: ``gradient`` is ∂L/∂v, ``M`` ∂²L/∂v²."""

    v: Vector
    p: Vector
    gradient: Vector
    M: ExprMatrix
    start: Place

    @property
    def are_linear(self) -> bool:
        moving = set(self.v)
        entries = [x for row in self.M for x in row]
        return not any(x.free_symbols & moving for x in entries)

    def momenta(self, at: Place) -> dict[Expr, arb]:
        """∂L/∂v as momenta, if the velocities are known and the momenta are not; else empty."""
        needed: set[Expr] = set()
        for slope in self.gradient:
            needed |= slope.free_symbols
        are_known = all(x in at for x in self.p)
        if are_known or not needed <= set(at):
            return {}
        return dict(zip(self.p, mass.enclosed(self.gradient, at), strict=True))


def candidates(L: Expr, equations: Equations) -> list[SolvedVelocities]:
    if equations.are_linear:
        return [_by_elimination(equations)]
    solved = _by_form(L, equations)
    if len(equations.v) == 1:
        (v,), (p,) = equations.v, equations.p
        (slope,) = equations.gradient
        for velocity in solutions(slope, v, p):
            solved.append(SolvedVelocities({v: velocity}, {}))
    return solved


def _by_elimination(equations: Equations) -> SolvedVelocities:
    """Solves linear equations: v = M⁻¹(p − ∂L/∂v at v = 0)."""
    at_rest = dict.fromkeys(equations.v, 0)
    inverse, divisor = mass.inverse_of(equations.M, equations.v, equations.start)
    pairs = zip(equations.p, equations.gradient, strict=True)
    products = _times(inverse, [p - slope.xreplace(at_rest) for p, slope in pairs])
    return SolvedVelocities(
        {v: x / divisor for v, x in zip(equations.v, products, strict=True)}, {}
    )


def _times(matrix: ExprMatrix, vector: Vector) -> list[Expr]:
    return [dot(row, vector) for row in matrix]


class _QuadraticForm(Frozen):
    """L = φ(q, a) + b(q)·v with a = a_0(q) + ½ v·G(q)v; ``slope`` is φ'(a), ``at_rest`` a_0."""

    a: Expr
    symbol: Expr
    G: ExprMatrix
    slope: Expr
    b: Vector
    at_rest: Expr


def _by_form(L: Expr, equations: Equations) -> list[SolvedVelocities]:
    """Solves for v if L depends on it by one quadratic form, and linearly otherwise. Then p − b =
    φ'(a) G v, so (p − b)·G⁻¹(p − b) = 2 φ'(a)² (a − a_0) is an equation for a.
    """
    import sympy

    for part in sorted(L.atoms(sympy.Add), key=sympy.default_sort_key):
        form = _form(L, part, equations.v)
        if form is None:
            continue
        try:
            inverse, divisor = mass.inverse_of(form.G, equations.v, equations.start)
        except NoLegendreTransform:
            continue
        shifted = [p - b for p, b in zip(equations.p, form.b, strict=True)]
        return _of_form(form, equations.v, shifted, [x / divisor for x in _times(inverse, shifted)])
    return []


def _of_form(
    form: _QuadraticForm, v: Vector, shifted: Vector, raised: Vector
) -> list[SolvedVelocities]:
    """Returns v = G⁻¹(p − b)/φ'(a) for the possible a, from p − b and G⁻¹(p − b)."""
    import sympy

    # a symbol for the square of the momenta keeps sympy from mixing it up with the rest
    square = sympy.Dummy("n", positive=True)
    norm = {square: dot(shifted, raised)}
    equation = 2 * form.slope**2 * (form.symbol - form.at_rest)
    solved = []
    for value in solutions(equation, form.symbol, square):
        slope = form.slope.xreplace({form.symbol: value})
        slope = slope.xreplace(norm)
        made = {velocity: x / slope for velocity, x in zip(v, raised, strict=True)}
        solved.append(SolvedVelocities(made, {form.a: value.xreplace(norm)}))
    return solved


def _form(L: Expr, a: Expr, v: Vector) -> _QuadraticForm | None:
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
    return _QuadraticForm(a, symbol, G, slope, b, a.xreplace(at_rest))


_TRIES = 8  # random places where a solution is tested
_NEAR = 50  # thousandths: how far from the start they are
_GOOD = 1e-40  # what enclosures have to be good to, to tell that two numbers are one


def by_solving(lagrangian: mass.Lagrangian) -> Expr:
    L, gradient, M = lagrangian.L, lagrangian.gradient, lagrangian.M
    variables = lagrangian.variables
    v, p = velocities(variables), symbols(variables, "p")
    replaced: dict[Expr, Expr] = {}
    for block in mass.coupled(M):
        equations = Equations(
            [v[i] for i in block],
            [p[i] for i in block],
            [gradient[i] for i in block],
            [[M[i][j] for j in block] for i in block],
            lagrangian.start,
        )
        solved = _solution(L, equations, p)
        replaced |= {**solved.velocities, **solved.forms}
    H = dot(p, [replaced[x] for x in v]) - L.xreplace(replaced)
    derivatives = (H.diff(x) for x in (*symbols(variables, "q"), *p))
    if not mass.is_smooth(H) or not all(map(mass.is_smooth, derivatives)):
        raise NoLegendreTransform(
            "the Hamiltonian was not found without kinks", mass.WRITE_HAMILTONIAN
        )
    return H


def _solution(L: Expr, equations: Equations, p: Vector) -> SolvedVelocities:
    """Returns the right solution; NoLegendreTransform without any, or if several fit the start."""
    right: list[SolvedVelocities] = []
    for candidate in candidates(L, equations):
        right += [x for x in _smooth(candidate, p) if _is_right(x.velocities, equations)]
    if not right:
        whose = ", ".join(map(str, equations.v))
        raise NoLegendreTransform(f"p = ∂L/∂v was not solved for {whose}", mass.WRITE_HAMILTONIAN)
    known = {**equations.start, **equations.momenta(equations.start)}
    at_start = [mass.enclosed(list(solved.velocities.values()), known) for solved in right]
    first, *others = at_start
    for other in others:
        if not all(x.overlaps(y) for x, y in zip(first, other, strict=True)):
            message = "several velocities have these momenta at the start"
            raise NoLegendreTransform(message, "give the initial velocities instead of momenta")
    return right[0]


def _smooth(solved: SolvedVelocities, p: Vector) -> list[SolvedVelocities]:
    """Replaces |y| by y and by −y if y is made of momenta only: an analytic velocity that is right
    near the start is right as far as it is analytic. Empty if a value is not real or has other
    kinks.
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


def _with_sign(solved: SolvedVelocities, sign: int) -> SolvedVelocities:
    import sympy

    def without_kinks(y: Expr) -> Expr:
        return y.replace(sympy.Abs, lambda u: sign * u)

    def signed(of: Substitution) -> dict[Expr, Expr]:
        return {x: without_kinks(y) for x, y in of.items()}

    return SolvedVelocities(signed(solved.velocities), signed(solved.forms))


def _is_right(solved: Substitution, equations: Equations) -> bool:
    """Whether ∂L/∂v(q, v(q, p)) is p at the start and at random places near it."""
    draw = Draw(1)
    if _agrees(solved, equations, equations.start) is not True:
        return False
    tested = 1
    for _ in range(_TRIES - 1):
        near = {}
        with ctx.workprec(mass.BITS):
            for x, y in equations.start.items():
                near[x] = y + arb(fmpq(draw.between(-_NEAR, _NEAR), 1000))
        agrees = _agrees(solved, equations, near)
        if agrees is False:
            return False
        tested += agrees is True
    return tested > _TRIES // 2


def _agrees(solved: Substitution, equations: Equations, place: Place) -> bool | None:
    at = {**place, **equations.momenta(place)}
    if not all(x in at for x in equations.p):
        return False
    solution = dict(zip(solved, mass.enclosed(list(solved.values()), at), strict=True))
    back = mass.enclosed(equations.gradient, {**at, **solution})
    pairs = [(value, at[p]) for p, value in zip(equations.p, back, strict=True)]
    known = [v for v in solved if v in at]
    pairs += [(solution[v], at[v]) for v in known]
    for x, y in pairs:
        if not (x.is_finite() and y.is_finite()):
            return None
    return all(_are_one(x, y) for x, y in pairs)


def _are_one(x: arb, y: arb) -> bool:
    """Whether two good enclosures may be those of one number."""
    is_good = x.rad() + y.rad() < _GOOD
    return bool(is_good and x.overlaps(y))


@doing("Legendre transform")
def legendre_transform(L: Expr, variables: tuple[str, ...], start: Place) -> Expr:
    """Returns the Hamiltonian of a Lagrangian, sympy expressions both.

    With L = ½ v·Mv + b·v + c, H = ½ (p − b)·M⁻¹(p − b) − c exactly, where M, b and c may depend on
    the positions. Other equations are solved for velocities one by one, or together if they occur
    in one quadratic form only, as in √(1 − v·v); such solutions are tested at the start and at
    random places near it, with 90 digits.

    ``start`` has q(0), and known velocities or momenta, which select one of several solutions;
    NoLegendreTransform if the mass matrix is singular, or no solution was found.

    >>> from flint import arb
    >>> from sympy import cos
    >>> (x,), (v,) = symbols(("x",), "q"), velocities(("x",))
    >>> legendre_transform(v**2 / 2 - cos(x), ("x",), {x: arb(0)})
    px**2/2 + cos(x)
    """
    v = velocities(variables)
    present = [x for x in v if x in L.free_symbols]
    if not present:
        return -L
    if len(present) < len(v):
        missing = ", ".join(str(x) for x in v if x not in present)
        others = ", ".join(map(str, present))
        raise NoLegendreTransform(
            f"the mass matrix is singular: {missing} does not occur beside {others}",
            f"each term has all velocities or none; move {missing} into this term, "
            f"or write the Hamiltonian",
        )
    lagrangian = mass.differentiated(L, variables, start)
    if lagrangian.is_quadratic:
        return _of_quadratic(lagrangian)
    return by_solving(lagrangian)


def _of_quadratic(lagrangian: mass.Lagrangian) -> Expr:
    """H = ½ (p − b)·M⁻¹(p − b) − c, block by block of M."""
    import sympy

    M, variables = lagrangian.M, lagrangian.variables
    v, p = velocities(variables), symbols(variables, "p")
    at_rest = dict.fromkeys(v, 0)
    shifted = []  # p - b
    for x, slope in zip(p, lagrangian.gradient, strict=True):
        shifted.append(x - slope.xreplace(at_rest))
    H = [-lagrangian.L.xreplace(at_rest)]
    for block in mass.coupled(M):
        own = [[M[i][j] for j in block] for i in block]
        inverse, divisor = mass.inverse_of(own, [v[i] for i in block], lagrangian.start)
        products = []
        for row, i in zip(inverse, block, strict=True):
            for entry, j in zip(row, block, strict=True):
                products.append(entry * shifted[i] * shifted[j])
        H.append(sympy.Add(*products) / (2 * divisor))
    return sympy.Add(*H)


def initial_momenta(
    lagrangians: Vector, hamiltonians: Vector, variables: tuple[str, ...], start: Place
) -> list[arb]:
    """Returns the p(0) for which q̇(0) is the given velocity, shape (d,): ∂L/∂q̇ for one term with
    velocities, else the solution of q̇ = Σ_l ∂H^{l}/∂p, NoLegendreTransform unless all are
    quadratic.
    """
    v, p = velocities(variables), symbols(variables, "p")
    moving = [L for L in lagrangians if L.free_symbols & set(v)]
    if len(moving) == 1:
        (L,) = moving
        return mass.enclosed([L.diff(x) for x in v], start)
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
    with ctx.workprec(mass.BITS):
        matrix = arb_mat(d, d, mass.enclosed(hessian, places))
        rest = [start[x] - y for x, y in zip(v, mass.enclosed(offsets, places), strict=True)]
        right = arb_mat(d, 1, rest)
        try:
            return [arb(x) for x in matrix.solve(right).entries()]
        except ZeroDivisionError:
            message = "the velocities do not determine the momenta at the start"
            cure = "give the initial momenta instead of velocities"
            raise NoLegendreTransform(message, cure) from None


def missing_derivative(made: Expr, by: Vector, start: Place) -> tuple[str, str] | None:
    """Returns the fault of a derivative at the start and its cure, or None; |x| has kinks."""
    gradient = [made.diff(x) for x in by]
    for x, g in zip(by, gradient, strict=True):
        if not mass.is_smooth(g):
            return (
                f"the derivative by {x} has kinks, such as those of |x|",
                "write it without inverse functions",
            )
    if all(x.is_finite() for x in mass.enclosed(gradient, start)):
        return None
    # one operation that fails spoils them all: the guilty one is undefined on its own
    guilty = by[0]
    for x, g in zip(by, gradient, strict=True):
        (alone,) = mass.enclosed([g], start)
        if not alone.is_finite():
            guilty = x
            break
    return f"no derivative by {guilty}", "start elsewhere"
