"""ẏ = Σ_l f^{l}(t, y), a right-hand side for each colour: problems that need not be Hamiltonian.

The expressions are sympy objects built by ``garkcli.problems.builtin`` or translated node by node;
no text is ever evaluated.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

from flint import arb, fmpq

from garkcli.problems.straightline import function
from garkcli.problems.vectorfield import (
    TIME,
    Group,
    Layout,
    VectorField,
    occurring,
    symbols,
)

EXACT_DIGITS = 50
"""To so many digits an irrational start of an exact solution is certainly the rational one that is
stepped from.
"""


@dataclass(frozen=True)
class RightHandSide:
    """ẏ = Σ_l f^{l}(t, y) with y(0), in units of its own.

    Attributes:
        name: what the command line calls it.
        variables: d names of unknowns.
        terms: f^{l}, d sympy expressions each, in ``symbols`` of the variables and of time.
        initial: y(0), shape (d,).
        t_end: the default final time of a convergence test.
        invariants: first integrals: a name and an expression in the variables each.
        exact: y(t), d expressions in time, where it is known.
        is_generic: whether it is made to see every tree, so that no order above that of the method
            is to be seen.
        long_run: a step size and a time that show the motion over a long time, where they are
            known.
        stiffness: the value of its stiffness parameter, where it has one.
    """

    name: str
    variables: tuple[str, ...]
    terms: tuple[tuple[Any, ...], ...]
    initial: tuple[fmpq, ...]
    t_end: fmpq
    invariants: tuple[tuple[str, Any], ...] = ()
    exact: tuple[Any, ...] | None = None
    is_generic: bool = False
    long_run: tuple[fmpq, fmpq] | None = None
    stiffness: fmpq | None = None

    @property
    def dimension(self) -> int:
        """The number d of unknowns."""
        return len(self.variables)

    @property
    def has_time(self) -> bool:
        """Whether a right-hand side depends on t."""
        components = [x for term in self.terms for x in term]
        return bool(occurring(components, self.variables, (TIME,)))

    @property
    def layout(self) -> Layout:
        """y, and t where it occurs."""
        groups: tuple[Group, ...] = ("y", TIME) if self.has_time else ("y",)
        return Layout(groups, self.dimension)

    @property
    def quantities(self) -> tuple[tuple[str, Any], ...]:
        """What is conserved: a name and an expression each."""
        return self.invariants

    @property
    def total(self) -> tuple[Any, ...]:
        """Σ_l f^{l}, d expressions."""
        return tuple(sum(parts) for parts in zip(*self.terms, strict=True))

    def unsplit(self) -> RightHandSide:
        """The same problem in one term."""
        return replace(self, terms=(self.total,))


def right_hand_side(problem: RightHandSide, term: int) -> VectorField:
    """f^{l}."""
    components = problem.terms[term]
    depends = occurring(components, problem.variables, ("y", TIME))
    return VectorField(components, problem.variables, depends)


def clock(problem: RightHandSide) -> VectorField:
    """ṫ = 1."""
    import sympy

    return VectorField((sympy.Integer(1),), problem.variables, ())


def solution(problem: RightHandSide, time: arb) -> list[arb]:
    """The exact solution at one time, enclosed at the precision in force."""
    assert problem.exact is not None
    by = symbols(problem.variables, TIME)
    return [arb(x) for x in function(problem.exact, by, True)(arb(time))]


def starts_exactly(problem: RightHandSide) -> bool:
    """Whether the exact solution starts at the rational numbers y(0): irrational ones are rounded
    to ``EXACT_DIGITS``.
    """
    import sympy

    assert problem.exact is not None
    (t,) = symbols(problem.variables, TIME)
    at_start = [x.subs(t, 0) for x in problem.exact]
    pairs = zip(at_start, problem.initial, strict=True)
    return all(x == sympy.Rational(int(y.p), int(y.q)) for x, y in pairs)


def steepness(problem: RightHandSide) -> arb:
    """‖∂(Σ f)/∂y‖ at the start, the largest sum of a row's absolute values: about how stiff the
    problem is. 1 where it has no value.
    """
    from garkcli.problems.mass import enclosed

    by = symbols(problem.variables, "y")
    at = dict(zip(by, map(arb, problem.initial), strict=True))
    at |= dict.fromkeys(symbols(problem.variables, TIME), arb(0))
    norm = arb(0)
    for component in problem.total:
        row = enclosed([component.diff(x) for x in by], at)
        norm = norm.max(sum(map(abs, row), arb(0)))
    return norm.mid() if norm.is_finite() else arb(1)
