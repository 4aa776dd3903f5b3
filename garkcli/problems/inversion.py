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
from garkcli.problems.hamiltonian import symbols
from garkcli.problems.mass import (
    BITS,
    WRITE_HAMILTONIAN,
    coupled,
    enclosed,
    inverse_of,
    is_smooth,
    velocities,
)
from garkcli.problems.solving import solutions

_TRIES = 8  # random places where a solution is tested


@dataclass(frozen=True)
class _Solved:
    """Velocities as functions of positions and momenta, and what they make of forms of the
    Lagrangian.
    """

    velocities: Mapping[Any, Any]
    forms: Mapping[Any, Any]


def by_solving(
    L: Any,
    gradient: Sequence[Any],
    M: Sequence[Sequence[Any]],
    variables: tuple[str, ...],
    start: Mapping[Any, arb],
) -> Any:
    """The transform of a Lagrangian that is not quadratic; see ``legendre``."""
    v, p = velocities(variables), symbols(variables, "p")
    solved: dict[Any, Any] = {}
    forms: dict[Any, Any] = {}
    for block in coupled(M):
        of, momenta = [v[i] for i in block], [p[i] for i in block]
        own = [gradient[i] for i in block]
        if not any(M[i][j].free_symbols & set(v) for i in block for j in block):
            inverse, divisor = inverse_of([[M[i][j] for j in block] for i in block], of, start)
            shifted = [
                x - g.xreplace(dict.fromkeys(of, 0)) for x, g in zip(momenta, own, strict=True)
            ]
            found = [
                _Solved(
                    {x: y / divisor for x, y in zip(of, _times(inverse, shifted), strict=True)}, {}
                )
            ]
        else:
            found = _by_form(L, of, momenta, start)
            found += [
                _Solved({of[0]: x}, {})
                for x in solutions(own[0], of[0], momenta[0])
                if len(of) == 1
            ]
        right = [
            x
            for one in found
            for x in _smooth(one, p)
            if _is_right(x.velocities, own, momenta, start)
        ]
        if not right:
            whose = ", ".join(map(str, of))
            raise NoLegendreTransform(f"p = ∂L/∂v was not solved for {whose}", WRITE_HAMILTONIAN)
        values = [
            enclosed(list(x.velocities.values()), {**start, **_known(own, momenta, start)})
            for x in right
        ]
        if not all(
            x.overlaps(y) for other in values for x, y in zip(other, values[0], strict=True)
        ):
            raise NoLegendreTransform(
                "several velocities have these momenta at the start",
                "give the initial velocities instead of momenta",
            )
        solved |= right[0].velocities
        forms |= right[0].forms
    H = sum(a * solved[x] for a, x in zip(p, v, strict=True)) - L.xreplace({**solved, **forms})
    if not is_smooth(H) or not all(is_smooth(H.diff(x)) for x in (*symbols(variables, "q"), *p)):
        raise NoLegendreTransform("the Hamiltonian was not found without kinks", WRITE_HAMILTONIAN)
    return H


def _times(matrix: Sequence[Sequence[Any]], vector: Sequence[Any]) -> list[Any]:
    return [sum(a * x for a, x in zip(row, vector, strict=True)) for row in matrix]


def _by_form(L: Any, v: Sequence[Any], p: Sequence[Any], start: Mapping[Any, arb]) -> list[_Solved]:
    """The velocities where L = φ(q, a) + b(q)·v with one form a = a_0(q) + ½ v·G(q)v.

    Then p − b = φ'(a) G v, so that (p − b)·G⁻¹(p − b) = 2 φ'(a)² (a − a_0) is an equation for a
    alone.
    """
    import sympy

    a, square = sympy.Dummy("a", real=True), sympy.Dummy("n", positive=True)
    rest_of = dict.fromkeys(v, 0)
    for form in sorted(L.atoms(sympy.Add), key=sympy.default_sort_key):
        if not set(v) <= form.free_symbols:
            continue
        G = [[form.diff(x, y) for y in v] for x in v]
        if any(x.free_symbols & set(v) for row in G for x in row):
            continue
        phi = L.xreplace({form: a})
        b = [phi.diff(x) for x in v]
        if any(x.free_symbols & {a, *v} for x in b) or any(
            form.diff(x).xreplace(rest_of) != 0 for x in v
        ):
            continue
        try:
            inverse, divisor = inverse_of(G, v, start)
        except NoLegendreTransform:
            continue
        slope = phi.xreplace(rest_of).diff(a)
        shifted = [x - y for x, y in zip(p, b, strict=True)]
        raised = [x / divisor for x in _times(inverse, shifted)]
        # a symbol for the square of the momenta keeps sympy from mixing it up with the rest
        norm = {square: sum(x * y for x, y in zip(shifted, raised, strict=True))}
        values = solutions(2 * slope**2 * (a - form.xreplace(rest_of)), a, square)
        return [
            _Solved(
                {
                    x: y / slope.xreplace({a: value}).xreplace(norm)
                    for x, y in zip(v, raised, strict=True)
                },
                {form: value.xreplace(norm)},
            )
            for value in values
        ]
    return []


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
    kinks = set().union(*(x.atoms(sympy.Abs) for x in made))
    if not kinks:
        return [solved]
    if any(x.free_symbols - set(p) for x in kinks):
        return []
    return [
        _Solved(
            *(
                {x: y.replace(sympy.Abs, lambda u, s=sign: s * u) for x, y in of.items()}
                for of in (solved.velocities, solved.forms)
            )
        )
        for sign in (1, -1)
    ]


def _is_right(
    solved: Mapping[Any, Any], gradient: Sequence[Any], p: Sequence[Any], start: Mapping[Any, arb]
) -> bool:
    """Whether ∂L/∂v(q, v(q, p)) is p, and v(q, p) the velocity at the start, wherever it is
    tested.
    """
    draw = Draw(1)
    tested = 0
    for k in range(_TRIES):
        with ctx.workprec(BITS):
            near = {x: start[x] + arb(fmpq(draw.between(-50, 50) if k else 0, 1000)) for x in start}
        at = near | _known(gradient, p, near)
        if not all(x in at for x in p):
            return False
        found = dict(zip(solved, enclosed(list(solved.values()), at), strict=True))
        back = enclosed(gradient, {**at, **found})
        pairs = [(y, at[x]) for x, y in zip(p, back, strict=True)]
        pairs += [(found[x], at[x]) for x in solved if x in at]
        if all(x.is_finite() for pair in pairs for x in pair):
            if not all(x.overlaps(y) and x.rad() + y.rad() < 1e-40 for x, y in pairs):
                return False
            tested += 1
        elif not k:
            return False
    return tested > _TRIES // 2


def _known(gradient: Sequence[Any], p: Sequence[Any], at: Mapping[Any, arb]) -> dict[Any, arb]:
    """The momenta ∂L/∂v where the velocities are known."""
    if all(x in at for x in p) or not all(x in at for g in gradient for x in g.free_symbols):
        return {}
    return dict(zip(p, enclosed(gradient, at), strict=True))
