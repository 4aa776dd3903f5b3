"""A split Hamiltonian H = Σ_l H^{l}(q, p), differentiated by sympy and made into functions of
numbers.

The vector fields are V^{l} = ∂H^{l}/∂p and F^{l} = −∂H^{l}/∂q. The expressions are sympy objects
built by ``garkcli.problems.builtin``; no text is ever evaluated. sympy is imported when the first
field is derived.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cache
from typing import Any, Literal, TypeAlias

from flint import arb, ctx, fmpq

from garkcli.problems.draw import Draw
from garkcli.problems.straightline import function

Group: TypeAlias = Literal["q", "p"]
"""Positions or momenta."""
GROUPS: tuple[Group, Group] = ("q", "p")
FLOAT_DIGITS = 15
"""Up to so many digits numbers are floats; beyond, they are the midpoints of balls."""


@dataclass(frozen=True)
class Hamiltonian:
    """H = Σ_l H^{l}(q, p) with its initial values, in units of its own.

    Attributes:
        name: what the command line calls it.
        variables: d names of positions; the momentum of ``x`` is ``px``.
        terms: H^{l}, sympy expressions in ``symbols``.
        initial: q(0), then p(0), shape (2d,).
        t_end: the default final time of a convergence test, in units of time.
        invariants: first integrals besides H: a name and an expression each.
        is_generic: whether it is made to see every tree, so that no order above that of the method
            is to be seen.
        long_run: a step size and a time that show the motion over a long time, where they are
            known.
    """

    name: str
    variables: tuple[str, ...]
    terms: tuple[Any, ...]
    initial: tuple[fmpq, ...]
    t_end: fmpq
    invariants: tuple[tuple[str, Any], ...] = ()
    is_generic: bool = False
    long_run: tuple[fmpq, fmpq] | None = None

    @property
    def dimension(self) -> int:
        """The number d of degrees of freedom."""
        return len(self.variables)

    @property
    def energy(self) -> Any:
        """H, a sympy expression."""
        return sum(self.terms)

    def unsplit(self) -> Hamiltonian:
        """The same problem in one term."""
        return replace(self, terms=(self.energy,))


@cache
def symbols(variables: tuple[str, ...], group: Group) -> tuple[Any, ...]:
    """The sympy symbols of the positions or of their momenta, shape (d,)."""
    import sympy

    prefix = "" if group == "q" else "p"
    return tuple(sympy.Symbol(prefix + name, real=True) for name in variables)


@dataclass(frozen=True)
class VectorField:
    """V^{l} or F^{l}, with its Jacobians.

    Attributes:
        components: d sympy expressions.
        variables: of the problem.
        depends: the groups that occur in it, in the order q, p: its functions take the values of
            these only.
    """

    components: tuple[Any, ...]
    variables: tuple[str, ...]
    depends: tuple[Group, ...]

    @property
    def is_zero(self) -> bool:
        """Whether there is no such field."""
        return not any(self.components)

    @property
    def is_linear(self) -> bool:
        """Whether all second derivatives vanish."""
        return all(
            is_constant(x)
            for g in self.depends
            for row in self.derivative(g)
            for x in row
        )

    @property
    def degree(self) -> int | None:
        """A bound of the degree of all components, before terms cancel; None when they are not
        polynomials.
        """
        largest = 0
        for component in self.components:
            degree = _degree(component)
            if degree is None:
                return None
            largest = max(largest, degree)
        return largest

    def derivative(self, group: Group) -> tuple[tuple[Any, ...], ...]:
        """The Jacobian by positions or by momenta, sympy expressions, shape (d, d)."""
        return _derivative(self, group)

    @property
    def arguments(self) -> tuple[Any, ...]:
        """The symbols of what it depends on, in the order q, p."""
        return tuple(x for g in self.depends for x in symbols(self.variables, g))


@cache
def _derivative(field: VectorField, group: Group) -> tuple[tuple[Any, ...], ...]:
    by = symbols(field.variables, group)
    return tuple(tuple(f.diff(x) for x in by) for f in field.components)


@cache
def vector_field(problem: Hamiltonian, term: int, drives: Group) -> VectorField:
    """V^{l} for ``drives`` q, F^{l} for p."""
    import sympy

    H = problem.terms[term]
    q, p = (symbols(problem.variables, group) for group in GROUPS)
    sign, by = (1, p) if drives == "q" else (-1, q)
    components = tuple(sign * sympy.diff(H, x) for x in by)
    free: set[Any] = set()
    for component in components:
        free |= component.free_symbols
    depends = []
    for group, names in zip(GROUPS, (q, p), strict=True):
        if not free.isdisjoint(names):
            depends.append(group)
    return VectorField(components, problem.variables, tuple(depends))


def energy_function(problem: Hamiltonian, digits: int) -> Callable[..., list[Any]]:
    """H and then the invariants as a function of q and p, all 2d numbers: floats, or balls for more
    ``digits``.

    For balls the rational constants are enclosed once, at the precision in force now.
    """
    arguments = (*symbols(problem.variables, "q"), *symbols(problem.variables, "p"))
    invariants = [x for _, x in problem.invariants]
    return function((problem.energy, *invariants), arguments, digits > FLOAT_DIGITS)


def is_constant(x: Any) -> bool:
    """Whether an expression depends on nothing, be it written with symbols that cancel."""
    import sympy

    names = tuple(sorted(x.free_symbols, key=str))
    if not names:
        return True
    if _differs(x, names):
        return False
    if _degree(x) is not None:
        return not sympy.expand(x).free_symbols
    # what has one value wherever it was tried is left to sympy, unless that would take long
    return bool(x.count_ops() < _SIMPLE) and not sympy.simplify(x).free_symbols


_SIMPLE = 200  # operations
_TRIES = 8  # random places where two values are looked for


def _differs(x: Any, names: tuple[Any, ...]) -> bool:
    """Whether two values of an expression lie in balls that do not overlap, which proves that it is
    no constant.
    """
    draw = Draw(1)
    first: arb | None = None
    with ctx.workprec(200):
        value = function((x,), names, True)
        for _ in range(_TRIES):
            place = [arb(fmpq(draw.between(1, 999), 1000)) for _ in names]
            try:
                (ball,) = value(*place)
            except (ArithmeticError, ValueError):  # not defined here
                continue
            if not ball.is_finite():
                continue
            if first is None:
                first = ball
            elif not ball.overlaps(first):
                return True
    return False


def _degree(x: Any) -> int | None:
    """The degree of a polynomial as it is written; None for another expression."""
    if not x.free_symbols:
        return 0
    if x.is_Symbol:
        return 1
    if x.is_Pow and x.exp.is_Integer and x.exp.is_positive:
        base = _degree(x.base)
        return None if base is None else base * int(x.exp)
    if not (x.is_Add or x.is_Mul):
        return None
    parts = []
    for y in x.args:
        degree = _degree(y)
        if degree is None:
            return None
        parts.append(degree)
    return max(parts) if x.is_Add else sum(parts)
