"""What a problem file can have, and what one of them says."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TypeAlias

from flint import fmpq
from yaml.nodes import Node

DEFAULT_T_END = fmpq(2)
"""The final time of a convergence test where the file gives none."""
STIFFNESS = "stiffness"
"""The parameter that ``--stiffness`` sets."""
Side: TypeAlias = tuple[tuple[str, Node, str], ...]
"""The right-hand sides of one term: variable, formula, and what this is called."""
Sides: TypeAlias = tuple[Side, ...]
"""Those of all terms."""


@dataclass(frozen=True)
class ProblemText:
    """What a problem file says; formulas are still nodes, each with what it is called in messages.

    Attributes:
        name: what people call it.
        variables: names of the positions.
        are_named: whether these are all; if not, other names are not judged.
        form: hamiltonian, lagrangian or rhs.
        terms: one formula a term; none of rhs.
        sides: the right-hand sides of a term by the names of variables, each with its formula;
            empty for the other forms.
        initial: the mapping of initial values, where the file has one.
        exact: the mapping of the exact solution, where the file has one.
        t_end: the final time.
        invariants: names, and formulas.
    """

    name: str
    variables: tuple[str, ...]
    are_named: bool
    form: str
    terms: tuple[tuple[Node, str], ...]
    initial: Node | None
    t_end: fmpq
    invariants: tuple[tuple[str, Node], ...]
    sides: Sides = ()
    exact: Node | None = None
