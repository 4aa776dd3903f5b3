"""Split Hamiltonians H = Σ_l H^{l}(q, p): V^{l} = ∂H^{l}/∂p and F^{l} = −∂H^{l}/∂q by sympy,
compiled to functions of numbers. No text is ever evaluated.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cache

from flint import fmpq

from garkcli.errors import counted
from garkcli.frozen import Frozen, replace
from garkcli.problems import vectorfield
from garkcli.problems.deferred import Deferred
from garkcli.problems.expr import Expr, Exprs, Invariants, Vector

FLOAT_DIGITS = 15
"""Most digits of floats; with more, numbers are the midpoints of balls."""


class Hamiltonian(Frozen):
    """H = Σ_l H^{l}(q, p) with its initial values, in units of its own.

    Attributes:
        name: its name on the command line.
        variables: d names of positions; the momentum of ``x`` is ``px``.
        terms: H^{l}, sympy expressions in ``symbols``.
        initial: q(0), then p(0), shape (2d,).
        t_end: the default final time of a convergence test.
        invariants: first integrals besides H, pairs of name and expression.
        is_generic: whether it sees every tree, so that the observed order is that of the method.
        long_run: a step size and a time for long runs, if known.

    >>> from garkcli import hamiltonian
    >>> kepler = hamiltonian("kepler")
    >>> kepler.variables, kepler.terms
    (('x', 'y'), (px**2/2 + py**2/2 - 1/sqrt(x**2 + y**2),))
    """

    name: str
    variables: tuple[str, ...]
    terms: Vector
    initial: tuple[fmpq, ...]
    t_end: fmpq
    invariants: Invariants = ()
    is_generic: bool = False
    long_run: tuple[fmpq, fmpq] | None = None

    @property
    def dimension(self) -> int:
        """The number d of degrees of freedom."""
        return len(self.variables)

    @property
    def energy(self) -> Expr:
        """H, a sympy expression."""
        return sum(self.terms)

    @property
    def layout(self) -> vectorfield.StateLayout:
        return vectorfield.StateLayout(vectorfield.GROUPS, self.dimension)

    @property
    def quantities(self) -> Invariants:
        """The conserved quantities, the energy first: pairs of name and expression."""
        return (("energy", self.energy), *self.invariants)

    def unsplit(self) -> Hamiltonian:
        return replace(self, terms=summed(self.terms, lambda: self.energy))

    def __repr__(self) -> str:
        terms = counted(len(self.terms), "term")
        freedom = counted(self.dimension, "degree")
        return f"<Hamiltonian {self.name}: {terms}, {freedom} of freedom>"


def summed(terms: Vector, total: Callable[[], Expr]) -> Vector:
    if len(terms) == 1:
        return terms
    if isinstance(terms, Deferred):
        return terms.total or Deferred(f"{terms.name}, summed", lambda: (total(),), 1)
    return (total(),)


def vector_field(
    problem: Hamiltonian, term: int, drives: vectorfield.Group
) -> vectorfield.VectorField:
    """Returns V^{l} for ``drives`` q, F^{l} for p."""
    terms, variables = problem.terms, problem.variables
    if not isinstance(terms, Deferred):
        return vectorfield.field_of_components(
            _moved(terms[term], variables, drives), variables, vectorfield.GROUPS
        )
    what = f"{'velocity' if drives == 'q' else 'force'} {term + 1}"
    components = terms.derived(what, lambda: _moved(terms[term], variables, drives), len(variables))
    return vectorfield.field_of_components(components, variables, vectorfield.GROUPS)


@cache
def _moved(H: Expr, variables: tuple[str, ...], drives: vectorfield.Group) -> Exprs:
    """Returns ∂H/∂p or −∂H/∂q; cached, as problems share terms."""
    import sympy

    if drives == "q":
        return tuple(sympy.diff(H, x) for x in vectorfield.symbols(variables, "p"))
    return tuple(-sympy.diff(H, x) for x in vectorfield.symbols(variables, "q"))
