"""Problems that are not Hamiltonian: parts are terms of a method, the last in equal shares."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from flint import fmpq

from garkcli.problems.deferred import Deferred
from garkcli.problems.expr import Exprs, Invariants, rational
from garkcli.problems.righthandside import RightHandSide
from garkcli.problems.vectorfield import TIME, symbols

CELLS = 8


def prothero_robinson(terms: int, stiffness: fmpq) -> RightHandSide:
    """ẏ = φ'(t) − λ (y − φ(t)) with φ(t) = cos t and λ the stiffness; y = φ(t). Source: Prothero
    and Robinson, Math. Comp. 28 (1974), 145–162.
    """
    variables = ("y",)

    def solution() -> Exprs:
        import sympy

        (t,) = symbols(variables, TIME)
        return (sympy.cos(t),)

    def parts() -> list[Exprs]:
        (y,) = symbols(variables, "y")
        (t,) = symbols(variables, TIME)
        (phi,) = solution()
        return [(phi.diff(t),), (-rational(stiffness) * (y - phi),)]

    return _decay("prothero-robinson", parts, solution, terms, stiffness)


def van_der_pol(terms: int, stiffness: fmpq) -> RightHandSide:
    """ẏ = z, ż = ((1 − y²) z − y)/ε with 1/ε the stiffness. Source: Hairer and Wanner, Solving
    Ordinary Differential Equations II, section VI.3; the start is the expansion of the smooth
    solution at y = 2 up to ε³.
    """
    variables = ("y", "z")
    small = 1 / stiffness
    start = fmpq(-2, 3)
    for power, coefficient in enumerate(_SMOOTH_START, start=1):
        start += coefficient * small**power

    def parts() -> list[Exprs]:
        y, z = symbols(variables, "y")
        zero = 0 * z
        return [(z, zero), (zero, rational(stiffness) * ((1 - y**2) * z - y))]

    return RightHandSide(
        "van-der-pol",
        variables,
        shared(f"van-der-pol stiffness={stiffness}", parts, terms),
        (fmpq(2), start),
        fmpq(1, 2),
        long_run=(fmpq(1, 100), fmpq(100)),
        stiffness=stiffness,
    )


# z_1, z_2, z_3 at y = 2 of z = Σ ε^k z_k(y): z_0 = y/(1 − y²), and (1 − y²) z_{k+1} is the sum
# of all z_i' z_{k−i}
_SMOOTH_START = (fmpq(10, 81), fmpq(-292, 2187), fmpq(15266, 59049))


def reaction_diffusion(terms: int, stiffness: fmpq) -> RightHandSide:
    """u̇_i = r_i u_i (1 − u_i) + k (u_{i−1} − 2 u_i + u_{i+1}) in a closed line of cells, with k
    the stiffness, r_i growing, from near the limit of fast diffusion: 1/4 + w/k balances the
    reaction.
    """
    cells = range(CELLS)
    variables = tuple(f"u{i + 1}" for i in cells)
    rates = [fmpq(CELLS + i, 2 * CELLS) for i in cells]

    def parts() -> list[Exprs]:
        u = symbols(variables, "y")
        reaction = [rational(r) * x * (1 - x) for r, x in zip(rates, u, strict=True)]
        k = rational(stiffness)
        diffusion = []
        for i, x in enumerate(u):
            # the first and the last cell have one neighbour
            neighbours = [u[j] for j in (i - 1, i + 1) if j in cells]
            diffusion.append(k * (sum(neighbours) - len(neighbours) * x))
        return [tuple(reaction), tuple(diffusion)]

    return RightHandSide(
        "reaction-diffusion",
        variables,
        shared(f"reaction-diffusion stiffness={stiffness}", parts, terms),
        _balanced(rates, stiffness),
        fmpq(2),
        stiffness=stiffness,
    )


def _balanced(rates: Sequence[fmpq], stiffness: fmpq) -> tuple[fmpq, ...]:
    """1/4 + w_i/k, where diffusion cancels the reaction up to its mean."""
    level = fmpq(1, 4)
    growth = [r * level * (1 - level) for r in rates]
    mean = _mean(growth)
    w, flow = [fmpq(0)], fmpq(0)
    for g in growth[:-1]:
        # what flows on to the right has to make up for all cells so far
        flow += mean - g
        w.append(w[-1] + flow)
    middle = _mean(w)
    return tuple(level + (x - middle) / stiffness for x in w)


def robertson(terms: int, stiffness: fmpq) -> RightHandSide:
    """Three reactions of very different speeds, the fast ones times the stiffness. Source:
    Robertson 1966; Hairer and Wanner, Solving Ordinary Differential Equations II, equation
    (IV.1.4).
    """
    variables = ("y1", "y2", "y3")

    def parts() -> list[Exprs]:
        a, b, c = symbols(variables, "y")
        k = rational(stiffness)
        slow = rational(fmpq(1, 25)) * a
        fast, faster = k * 10_000 * b * c, k * 30_000_000 * b**2
        return [(-slow, slow, 0 * c), (fast, -fast - faster, faster)]

    def invariants() -> Invariants:
        return (("mass", sum(symbols(variables, "y"))),)

    start = (fmpq(1), fmpq(0), fmpq(0))
    return RightHandSide(
        "robertson",
        variables,
        shared(f"robertson stiffness={stiffness}", parts, terms),
        start,
        fmpq(1, 1000),
        invariants=Deferred("robertson invariants", invariants, 1, ("mass",)),
        stiffness=stiffness,
    )


def _mean(numbers: Sequence[fmpq]) -> fmpq:
    return sum(numbers, fmpq(0)) / len(numbers)


def shared(name: str, parts: Callable[[], Sequence[Exprs]], terms: int) -> Deferred:
    """The parts in ``terms`` terms: the last one in equal shares, or the last ones added up."""
    whole = Deferred(f"{name} terms=1", lambda: _shared(parts(), 1), 1)
    return Deferred(f"{name} terms={terms}", lambda: _shared(parts(), terms), terms, total=whole)


def _shared(parts: Sequence[Exprs], terms: int) -> tuple[Exprs, ...]:
    if terms <= len(parts):
        last = terms - 1
        rest = tuple(map(sum, zip(*parts[last:], strict=True)))
        return (*parts[:last], rest)
    *kept, rest = parts
    left = terms - len(kept)
    return (*kept, *[tuple(component / left for component in rest)] * left)


def dahlquist(terms: int, stiffness: fmpq) -> RightHandSide:
    """ẏ = λ y with λ minus the stiffness; y = e^{λt}. Source: Dahlquist, BIT 3 (1963), 27–43."""
    variables = ("y",)

    def parts() -> list[Exprs]:
        (y,) = symbols(variables, "y")
        return [(-rational(stiffness) * y,)]

    def solution() -> Exprs:
        import sympy

        (t,) = symbols(variables, TIME)
        return (sympy.exp(-rational(stiffness) * t),)

    return _decay("dahlquist", parts, solution, terms, stiffness)


def _decay(
    name: str,
    parts: Callable[[], list[Exprs]],
    solution: Callable[[], Exprs],
    terms: int,
    stiffness: fmpq,
) -> RightHandSide:
    """A problem with one value y, which is 1 at t = 0; ``solution`` is y(t)."""
    key = f"{name} stiffness={stiffness}"
    return RightHandSide(
        name,
        ("y",),
        shared(key, parts, terms),
        (fmpq(1),),
        fmpq(1),
        exact=Deferred(f"{key} solution", solution, 1),
        stiffness=stiffness,
    )


def logistic(terms: int, _: int) -> RightHandSide:
    """ẏ = y (1 − y) from 1/10: growth and its limit; y = 1/(1 + 9 e^{−t})."""
    variables = ("y",)

    def parts() -> list[Exprs]:
        (y,) = symbols(variables, "y")
        return [(y,), (-(y**2),)]

    def solution() -> Exprs:
        import sympy

        (t,) = symbols(variables, TIME)
        return (1 / (1 + 9 * sympy.exp(-t)),)

    return RightHandSide(
        "logistic",
        variables,
        shared("logistic", parts, terms),
        (fmpq(1, 10),),
        fmpq(2),
        exact=Deferred("logistic solution", solution, 1),
    )


def lotka_volterra(terms: int, _: int) -> RightHandSide:
    """u̇ = u (1 − v), v̇ = v (u − 1): prey and predator, with u − ln u + v − ln v constant. Source:
    Hairer, Lubich and Wanner, Geometric Numerical Integration, section I.1.1.
    """
    variables = ("u", "v")

    def parts() -> list[Exprs]:
        u, v = symbols(variables, "y")
        zero = 0 * u
        return [(u * (1 - v), zero), (zero, v * (u - 1))]

    def invariants() -> Invariants:
        import sympy

        u, v = symbols(variables, "y")
        return (("invariant", u - sympy.log(u) + v - sympy.log(v)),)

    return RightHandSide(
        "lotka-volterra",
        variables,
        shared("lotka-volterra", parts, terms),
        (fmpq(2), fmpq(1)),
        fmpq(2),
        invariants=Deferred("lotka-volterra invariants", invariants, 1, ("invariant",)),
        long_run=(fmpq(1, 10), fmpq(1000)),
    )


def damped_pendulum(terms: int, _: int) -> RightHandSide:
    """q″ = −sin q − q′ (1 + q′²)/4 as q̇ = p, ṗ = g(q, p): a pendulum with linear and cubic drag."""
    variables = ("q", "v")

    def parts() -> list[Exprs]:
        import sympy

        q, v = symbols(variables, "y")
        zero = 0 * q
        return [(v, zero), (zero, -sympy.sin(q) - v * (1 + v**2) / 4)]

    return RightHandSide(
        "damped-pendulum",
        variables,
        shared("damped-pendulum", parts, terms),
        (fmpq(1), fmpq(1, 2)),
        fmpq(2),
    )
