"""Right-hand sides ẏ = Σ_l f^{l}(t, y), one for each colour. No text is ever evaluated."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial

from flint import arb, fmpq

from garkcli.errors import counted
from garkcli.frozen import Frozen, replace
from garkcli.problems import vectorfield
from garkcli.problems.deferred import Deferred, ask
from garkcli.problems.expr import Exprs, Invariants, Vector, rational
from garkcli.problems.hamiltonian import summed
from garkcli.problems.straightline import function

EXACT_DIGITS = 50
"""Digits to which an irrational start agrees with that of the steps."""


class RightHandSide(Frozen):
    """ẏ = Σ_l f^{l}(t, y) with y(0), in units of its own.

    Attributes:
        name: its name on the command line.
        variables: d names of unknowns.
        terms: f^{l}, d sympy expressions each, in ``symbols`` of the variables and of time.
        initial: y(0), shape (d,).
        t_end: the default final time of a convergence test.
        invariants: first integrals, pairs of name and expression in the variables.
        exact: y(t), d expressions in time, if known.
        is_generic: whether it sees every tree, so that the observed order is that of the method.
        long_run: a step size and a time for long runs, if known.
        stiffness: the value of its stiffness parameter, if any.
    """

    name: str
    variables: tuple[str, ...]
    terms: Sequence[Vector]
    initial: tuple[fmpq, ...]
    t_end: fmpq
    invariants: Invariants = ()
    exact: Vector | None = None
    is_generic: bool = False
    long_run: tuple[fmpq, fmpq] | None = None
    stiffness: fmpq | None = None

    @property
    def dimension(self) -> int:
        return len(self.variables)

    @property
    def has_time(self) -> bool:
        return ask(self.terms, "time", self._has_time)

    def _has_time(self) -> bool:
        return bool(
            vectorfield.occurring(
                [x for term in self.terms for x in term], self.variables, (vectorfield.TIME,)
            )
        )

    @property
    def layout(self) -> vectorfield.StateLayout:
        groups: tuple[vectorfield.Group, ...] = ("y", vectorfield.TIME) if self.has_time else ("y",)
        return vectorfield.StateLayout(groups, self.dimension)

    @property
    def quantities(self) -> Invariants:
        return self.invariants

    @property
    def total(self) -> Exprs:
        """Σ_l f^{l}, d expressions."""
        return tuple(map(sum, zip(*self.terms, strict=True)))

    def unsplit(self) -> RightHandSide:
        return replace(self, terms=summed(self.terms, lambda: self.total))

    def __repr__(self) -> str:
        terms = counted(len(self.terms), "term")
        unknowns = counted(len(self.variables), "unknown")
        return f"<RightHandSide {self.name}: {terms}, {unknowns}>"


def right_hand_side(problem: RightHandSide, term: int) -> vectorfield.VectorField:
    """f^{l}."""
    components: Vector
    if isinstance(problem.terms, Deferred):
        what = f"right-hand side {term + 1}"
        make = partial(problem.terms.__getitem__, term)
        components = problem.terms.derived(what, make, problem.dimension)
    else:
        components = problem.terms[term]
    return vectorfield.field_of_components(components, problem.variables, ("y", vectorfield.TIME))


def clock(problem: RightHandSide) -> vectorfield.VectorField:
    """ṫ = 1."""
    return vectorfield.VectorField(Deferred("clock rate", _one, 1), problem.variables, ())


def _one() -> Exprs:
    import sympy

    return (sympy.Integer(1),)


def solution(problem: RightHandSide, time: arb) -> list[arb]:
    assert problem.exact is not None
    evaluate = function(
        problem.exact, vectorfield.arguments_in(problem.variables, (vectorfield.TIME,)), True
    )
    return [arb(x) for x in evaluate(arb(time))]


def starts_exactly(problem: RightHandSide) -> bool:
    """Whether the exact solution starts at the rational y(0), up to ``EXACT_DIGITS``."""
    assert problem.exact is not None
    (t,) = vectorfield.symbols(problem.variables, vectorfield.TIME)
    return [x.subs(t, 0) for x in problem.exact] == [rational(x) for x in problem.initial]


def steepness(problem: RightHandSide) -> arb:
    """‖∂(Σ f)/∂y‖ at the start, the largest row sum; 1 if it has no value."""
    from garkcli.problems.mass import enclosed_at

    d = problem.dimension
    field = right_hand_side(problem.unsplit(), 0)
    slopes = field.slopes([("y", k) for k in range(d)])
    names = vectorfield.arguments_in(problem.variables, ("y", vectorfield.TIME))
    entries = enclosed_at(slopes, names, [*map(arb, problem.initial), arb(0)])
    norm = arb(0)
    for i in range(d):
        row = entries[d * i : d * (i + 1)]
        norm = norm.max(sum(map(abs, row), arb(0)))
    return norm.mid() if norm.is_finite() else arb(1)
