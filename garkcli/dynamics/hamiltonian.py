"""A split Hamiltonian H = Σ_l H^{l}(q, p), differentiated by sympy and made into functions of numbers.

The vector fields are V^{l} = ∂H^{l}/∂p and F^{l} = −∂H^{l}/∂q. The expressions are sympy objects built by
``garkcli.dynamics.examples``; no text is ever evaluated. sympy is imported when the first field is derived.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cache
from typing import Any, Literal, TypeAlias

from flint import arb, fmpq

Group: TypeAlias = Literal["q", "p"]
"""Positions or momenta."""
GROUPS: tuple[Group, Group] = ("q", "p")
FLOAT_DIGITS = 15
"""Up to so many digits numbers are floats; beyond, they are the midpoints of balls."""
_FUNCTIONS: Mapping[str, Callable[[arb], arb]] = {"sin": arb.sin, "cos": arb.cos, "exp": arb.exp, "log": arb.log}


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
        has_equal_parts: whether several terms are the same function, so that trees of different colours have
            the same elementary differential and their errors may cancel.
    """

    name: str
    variables: tuple[str, ...]
    terms: tuple[Any, ...]
    initial: tuple[fmpq, ...]
    t_end: fmpq
    invariants: tuple[tuple[str, Any], ...] = ()
    has_equal_parts: bool = False

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
        return Hamiltonian(
            self.name, self.variables, (self.energy,), self.initial, self.t_end, self.invariants, False
        )


@cache
def symbols(variables: tuple[str, ...], group: Group) -> tuple[Any, ...]:
    """The sympy symbols of the positions or of their momenta, shape (d,)."""
    import sympy

    return tuple(sympy.Symbol(x if group == "q" else f"p{x}", real=True) for x in variables)


@dataclass(frozen=True)
class VectorField:
    """V^{l} or F^{l}, with its Jacobians.

    Attributes:
        components: d sympy expressions.
        variables: of the problem.
        depends: the groups that occur in it, in the order q, p: its functions take the values of these only.
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
        return all(not x.free_symbols for g in self.depends for row in self.derivative(g) for x in row)

    @property
    def degree(self) -> int | None:
        """The largest degree of a component; None when they are not polynomials."""
        import sympy

        arguments = self._arguments
        if not all(f.is_polynomial(*arguments) for f in self.components):
            return None
        return max(int(sympy.Poly(f, *arguments).total_degree()) for f in self.components)

    def derivative(self, group: Group) -> tuple[tuple[Any, ...], ...]:
        """The Jacobian by positions or by momenta, sympy expressions, shape (d, d)."""
        by = symbols(self.variables, group)
        return tuple(tuple(f.diff(x) for x in by) for f in self.components)

    def function(self, digits: int) -> Callable[..., list[Any]]:
        """The field as a function of the numbers it depends on, in the order q, p; returns d numbers."""
        return function(self.components, self._arguments, digits)

    def jacobian(self, group: Group) -> Callable[..., list[float]]:
        """The Jacobian by ``group`` as a function of floats; returns d² floats, row by row."""
        flat = tuple(x for row in self.derivative(group) for x in row)
        return function(flat, self._arguments, FLOAT_DIGITS)

    @property
    def _arguments(self) -> tuple[Any, ...]:
        return tuple(x for g in self.depends for x in symbols(self.variables, g))


@cache
def vector_field(problem: Hamiltonian, term: int, drives: Group) -> VectorField:
    """V^{l} for ``drives`` q, F^{l} for p."""
    import sympy

    H, sign = problem.terms[term], 1 if drives == "q" else -1
    by = symbols(problem.variables, "p" if drives == "q" else "q")
    components = tuple(sympy.sympify(sign * sympy.diff(H, x)) for x in by)
    free = set().union(*(f.free_symbols for f in components))
    depends = tuple(g for g in GROUPS if free & set(symbols(problem.variables, g)))
    return VectorField(components, problem.variables, depends)


def energy_function(problem: Hamiltonian, digits: int) -> Callable[..., list[Any]]:
    """H and then the invariants as a function of q and p, all 2d numbers."""
    arguments = tuple(x for g in GROUPS for x in symbols(problem.variables, g))
    return function((problem.energy, *(x for _, x in problem.invariants)), arguments, digits)


def function(expressions: tuple[Any, ...], arguments: tuple[Any, ...], digits: int) -> Callable[..., list[Any]]:
    """Our own sympy expressions as one function of numbers: floats, or balls when ``digits`` are more than theirs.

    For balls the rational constants are enclosed once, at the precision in force now.
    """
    if digits <= FLOAT_DIGITS:
        return _on_floats(expressions, arguments)
    made, constants = _on_balls(expressions, arguments)
    enclosed = tuple(arb(fmpq(int(x.p), int(x.q))) for x in constants)
    return lambda *values: made(*values, *enclosed)


@cache
def _on_floats(expressions: tuple[Any, ...], arguments: tuple[Any, ...]) -> Callable[..., list[Any]]:
    import sympy

    made: Callable[..., list[Any]] = sympy.lambdify(arguments, list(expressions), modules="math", cse=True)
    return made


@cache
def _on_balls(
    expressions: tuple[Any, ...], arguments: tuple[Any, ...]
) -> tuple[Callable[..., list[Any]], tuple[Any, ...]]:
    """The function, and the rational constants it takes after its arguments."""
    import sympy

    found = {x for f in expressions for x in f.atoms(sympy.Rational) if not x.is_Integer}
    product = sympy.Function("power")
    constants = tuple(sorted(found, key=lambda x: (int(x.p), int(x.q))))
    names = {x: sympy.Dummy(f"k{i}") for i, x in enumerate(constants)}
    made: Callable[..., list[Any]] = sympy.lambdify(
        (*arguments, *names.values()),
        [
            f.xreplace(names).replace(lambda x: x.is_Pow and x.exp.is_Integer, lambda x: product(*x.args))
            for f in expressions
        ],
        modules=[{**_FUNCTIONS, "power": _power}],
        cse=True,
    )
    return made, constants


def _power(x: arb, n: int) -> arb:
    """An integer power by products: that of a ball around zero is a ball around zero."""
    if n < 0:
        return 1 / _power(x, -n)
    if n == 1:
        return x
    half = _power(x, n // 2)
    return half * half * x if n % 2 else half * half
