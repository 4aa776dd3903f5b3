"""The built-in Hamiltonian problems, split for the number of terms of a method.

The kinetic energy goes to the first term and the potential to the others: one part each where there
are as many parts as terms, equal shares of all of it otherwise. ``generic`` has no separable term.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from random import Random
from typing import Any

from flint import arb, fmpq

from garkcli.errors import UsageProblem, did_you_mean
from garkcli.problems.hamiltonian import Hamiltonian, symbols

DEGREE = 8
"""The degree of ``generic``: its fields have nonzero derivatives up to the seventh, for all trees
of order 8.
"""
_FORMS = 3  # powers of linear forms in each term of generic


@dataclass(frozen=True)
class Mechanical:
    """H = T + Σ potentials(q).

    Attributes:
        variables: names of the positions.
        kinetic: T of the positions and momenta.
        potentials: the parts of the potential, of the positions.
        initial: q(0), then p(0).
        t_end: the default final time.
        invariants: names, and expressions in positions and momenta.
    """

    variables: tuple[str, ...]
    kinetic: Callable[[tuple[Any, ...], tuple[Any, ...]], Any]
    potentials: Callable[..., tuple[Any, ...]]
    initial: tuple[fmpq, ...]
    t_end: fmpq
    invariants: Callable[..., tuple[tuple[str, Any], ...]] = lambda *_: ()


def hamiltonian(name: str, terms: int, seed: int = 1) -> Hamiltonian:
    """The problem called ``name``, split into ``terms`` terms; ``seed`` is for ``generic``.

    Raises:
        UsageProblem: there is no such problem.

    >>> [str(x) for x in hamiltonian("pendulum", 2).terms]
    ['px**2/2', '1 - cos(x)']
    """
    if name == "generic":
        return _generic(terms, seed)
    if name not in MECHANICAL:
        raise UsageProblem(f"no problem {name!r}", did_you_mean(name, (*MECHANICAL, "generic")))
    return _split(name, MECHANICAL[name], terms)


def _split(name: str, made: Mechanical, terms: int) -> Hamiltonian:
    import sympy

    q, p = symbols(made.variables, "q"), symbols(made.variables, "p")
    T, parts = made.kinetic(q, p), made.potentials(*q)
    V = sum(parts)
    if terms == 1:
        split = (T + V,)
    elif terms - 1 == len(parts):
        split = (T, *parts)
    else:
        split = (T, *(sympy.expand(V / (terms - 1)),) * (terms - 1))
    return Hamiltonian(
        name, made.variables, split, made.initial, made.t_end, made.invariants(*q, *p)
    )


def _generic(terms: int, seed: int) -> Hamiltonian:
    """H^{l} = Σ_k c_k (1 + a_k·(q, p))^8, with random rational c_k and a_k: every term has every
    derivative.

    Powers of linear forms span all polynomials; three of them a term are enough for no derivative
    to vanish, and are cheap to evaluate. The terms stay small, so that all solutions from the
    origin exist to the final time.
    """
    import sympy

    draw = Random(seed)
    variables = ("x", "y")
    y = (*symbols(variables, "q"), *symbols(variables, "p"))
    split = []
    for _ in range(terms):
        H = sympy.Integer(0)
        for _ in range(_FORMS):
            u = sum(sympy.Rational(draw.choice((-1, 1)) * draw.randint(3, 12), 20) * x for x in y)
            H += (
                sympy.Rational(draw.choice((-1, 1)) * draw.randint(5, 20), 1600 * terms)
                * (1 + u) ** DEGREE
            )
        split.append(H)
    start = tuple(fmpq(draw.randint(-10, 10), 50) for _ in y)
    return Hamiltonian("generic", variables, tuple(split), start, fmpq(1), is_generic=True)


def _quadratic(_: tuple[Any, ...], p: tuple[Any, ...]) -> Any:
    return sum(x**2 for x in p) / 2


def _double_pendulum(q: tuple[Any, ...], _: tuple[Any, ...]) -> Any:
    """T of two rods of length 1 with masses 1, in absolute angles: its mass matrix depends on their
    difference.
    """
    import sympy

    from garkcli.problems.legendre import legendre
    from garkcli.problems.mass import velocities

    (a, b), (u, w) = q, velocities(("a", "b"))
    return legendre(
        u**2 + w**2 / 2 + u * w * sympy.cos(a - b), ("a", "b"), dict.fromkeys(q, arb(0))
    )


def _cos(x: Any) -> Any:
    import sympy

    return sympy.cos(x)


def _kepler(x: Any, y: Any) -> tuple[Any, ...]:
    import sympy

    return (-1 / sympy.sqrt(x**2 + y**2),)


def _chain(*q: Any) -> tuple[Any, ...]:
    """Springs between walls with quadratic and cubic forces, α = 1/4, β = 1/2: V = Σ r²/2 + αr³/3 +
    βr⁴/4.
    """
    stretched = [b - a for a, b in zip((0, *q), (*q, 0), strict=True)]
    return (sum(r**2 / 2 + r**3 / 12 + r**4 / 8 for r in stretched),)


MECHANICAL: Mapping[str, Mechanical] = {
    "oscillator": Mechanical(
        ("q",), _quadratic, lambda q: (q**2 / 2,), (fmpq(1), fmpq(1, 2)), fmpq(4)
    ),
    "split-oscillator": Mechanical(
        ("x", "y"),
        _quadratic,
        lambda x, y: (x**2 / 2, 25 * (y - x) ** 2 / 8),
        (fmpq(1), fmpq(1, 2), fmpq(0), fmpq(1)),
        fmpq(2),
    ),
    "pendulum": Mechanical(
        ("x",), _quadratic, lambda x: (1 - _cos(x),), (fmpq(1), fmpq(1, 2)), fmpq(4)
    ),
    "kepler": Mechanical(
        ("x", "y"),
        _quadratic,
        _kepler,
        (fmpq(2, 5), fmpq(0), fmpq(0), fmpq(2)),  # eccentricity 3/5, period 2π
        fmpq(2),
        lambda x, y, px, py: (("angular momentum", x * py - y * px),),
    ),
    "henon-heiles": Mechanical(
        ("x", "y"),
        _quadratic,
        lambda x, y: ((x**2 + y**2) / 2 + x**2 * y - y**3 / 3,),
        (fmpq(0), fmpq(3, 10), fmpq(2, 5), fmpq(1, 10)),
        fmpq(4),
    ),
    "fput": Mechanical(
        ("x", "y", "z"),
        _quadratic,
        _chain,
        (fmpq(1), fmpq(1, 2), fmpq(-1, 4), fmpq(0), fmpq(1, 2), fmpq(0)),
        fmpq(2),
    ),
    "double-pendulum": Mechanical(
        ("a", "b"),
        _double_pendulum,
        lambda a, b: (1 - _cos(a), 2 - _cos(a) - _cos(b)),  # of the upper and of the lower mass
        (fmpq(1), fmpq(-1, 2), fmpq(1), fmpq(1, 2)),
        fmpq(2),
    ),
}
"""The problems H = T + V(q); T depends on the momenta alone but for the double pendulum."""
