"""Vector fields of positions, momenta, all unknowns, or time. No text is ever evaluated."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from functools import cache
from typing import Any, Final, Literal, TypeAlias

from flint import arb, ctx, fmpq

from garkcli.frozen import Frozen
from garkcli.problems.deferred import Deferred, ask
from garkcli.problems.draw import Draw
from garkcli.problems.expr import Expr, Exprs, Vector
from garkcli.problems.straightline import function

Group: TypeAlias = Literal["q", "p", "y", "t"]
"""Positions, momenta, all unknowns of a problem that is not Hamiltonian, or time."""
GROUPS: tuple[Group, Group] = ("q", "p")
TIME: Final = "t"


class StateLayout(Frozen):
    """The groups of a state, time last with size 1, the others with size ``dimension`` d."""

    groups: tuple[Group, ...]
    dimension: int

    def size(self, group: Group) -> int:
        return 1 if group == TIME else self.dimension

    def start(self, group: Group) -> int:
        return self.groups.index(group) * self.dimension

    @property
    def total(self) -> int:
        return sum(map(self.size, self.groups))

    @property
    def unknowns(self) -> int:
        return sum(self.dimension for group in self.groups if group != TIME)


@cache
def symbols(variables: tuple[str, ...], group: Group) -> Exprs:
    import sympy

    return tuple(sympy.Symbol(name, real=True) for name in _names(variables, group))


def _names(variables: tuple[str, ...], group: Group) -> tuple[str, ...]:
    if group == TIME:
        return (TIME,)
    prefix = "p" if group == "p" else ""
    return tuple(prefix + name for name in variables)


class VectorField(Frozen):
    """V^{l}, F^{l} or f^{l}: d ``components``, one for time; ``depends`` has the groups in them."""

    components: Vector
    variables: tuple[str, ...]
    depends: tuple[Group, ...]

    @property
    def is_zero(self) -> bool:
        return ask(self.components, "zero", lambda: not any(self.components))

    @property
    def is_linear(self) -> bool:
        return all(map(self.is_linear_in, self.depends))

    def is_linear_in(self, group: Group) -> bool:
        return ask(
            self.components,
            f"linear in {group}",
            lambda: all(is_constant(x) for row in self.derivative(group) for x in row),
        )

    @property
    def degree(self) -> int | None:
        """A bound on the degree of all components; None unless they are polynomials."""
        return ask(self.components, "degree", self._degree)

    def _degree(self) -> int | None:
        largest = 0
        for component in self.components:
            degree = _degree(component)
            if degree is None:
                return None
            largest = max(largest, degree)
        return largest

    def derivative(self, group: Group) -> tuple[Exprs, ...]:
        """The Jacobian by a group, shape (d, size of the group)."""
        return _derivative(self, group)

    def slopes(self, by: Sequence[tuple[Group, int]]) -> Vector:
        """The derivatives by components of groups, row by row."""
        rows = range(len(self.components))

        def make() -> list[Expr]:
            columns = {group: self.derivative(group) for group, _ in by}
            return [columns[group][i][k] for i in rows for group, k in by]

        if not isinstance(self.components, Deferred):
            return tuple(make())
        names = " ".join(f"{group}{k + 1}" for group, k in by)
        return self.components.derived(f"by {names}", make, len(rows) * len(by))

    @property
    def arguments(self) -> Vector:
        return arguments_in(self.variables, self.depends)


def arguments_in(variables: tuple[str, ...], groups: Iterable[Group]) -> Deferred:
    names = [name for group in groups for name in _names(variables, group)]

    def make() -> list[Expr]:
        return [x for group in groups for x in symbols(variables, group)]

    return Deferred(" ".join(names), make, len(names))


def occurring(
    components: Iterable[Any], variables: tuple[str, ...], groups: Iterable[Group]
) -> tuple[Group, ...]:
    free: set[Expr] = set()
    for component in components:
        free |= component.free_symbols
    absent = {g for g in groups if free.isdisjoint(symbols(variables, g))}
    return tuple(g for g in groups if g not in absent)


def field_of_components(
    components: Vector, variables: tuple[str, ...], groups: Sequence[Group]
) -> VectorField:
    depends = ask(components, "depends", lambda: list(occurring(components, variables, groups)))
    return VectorField(components, variables, tuple(depends))


@cache
def _derivative(field: VectorField, group: Group) -> tuple[Exprs, ...]:
    by = symbols(field.variables, group)
    return tuple(map(tuple, ([f.diff(x) for x in by] for f in field.components)))


def is_constant(x: Expr) -> bool:
    """Whether an expression is constant, even with symbols that cancel."""
    import sympy

    names = tuple(sorted(x.free_symbols, key=str))
    if not names:
        return True
    if _differs(x, names):
        return False
    if _degree(x) is not None:
        return not sympy.expand(x).free_symbols
    # what has one value wherever it was tried is left to sympy, unless that would take long
    return _is_simple(x) and not sympy.simplify(x).free_symbols


def _is_simple(x: Expr) -> bool:
    """Whether sympy simplifies x quickly: it expands powers, and sin(2a) as 2 sin(a) cos(a)."""
    import sympy

    numbers = x.atoms(sympy.Rational)
    return x.count_ops() < _SIMPLE and all(max(abs(n.p), n.q) <= _SMALL for n in numbers)


_SIMPLE = 200  # operations
_SMALL = 8  # of the numbers that multiples of angles and exponents may be
_BITS = (200, 3200)  # to begin with, and at most: sin(10^64 x) loses 213 of them
_GOOD = 2.0**-100  # radius of a ball that has the digits to tell two numbers apart
_TRIES = 8  # random places where two values are sought


def _differs(x: Expr, names: Exprs) -> bool:
    bits = _BITS[0]
    while bits <= _BITS[1]:
        differs = _differs_at(x, names, bits)
        if differs is not None:
            return differs
        bits *= 4
    return False


def _differs_at(x: Expr, names: Exprs, bits: int) -> bool | None:
    """Whether balls of ``bits`` bits are disjoint; None if these are too few."""
    draw = Draw(1)
    first: arb | None = None
    is_good = True
    with ctx.workprec(bits):
        value = function((x,), names, True)
        for _ in range(_TRIES):
            numerators = [draw.between(1, 999) for _ in names]
            place = [arb(fmpq(n, 1000)) for n in numerators]
            try:
                (ball,) = value(*place)
            except (ArithmeticError, ValueError):  # not defined here
                continue
            if not ball.is_finite():
                continue
            is_good = is_good and ball.rad() < _GOOD
            if first is None:
                first = ball
            elif not ball.overlaps(first):
                return True
    return False if is_good else None


def _degree(x: Expr) -> int | None:
    """The degree of a polynomial as written; None for other expressions."""
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
