"""What the order-condition table shows: its rows, and the method that gives them values."""

from __future__ import annotations

from dataclasses import dataclass

from flint import fmpq

from garkcli.exact.display import to_decimal, to_text
from garkcli.exact.field import Number
from garkcli.order.conditions import Condition
from garkcli.tableau.meant import AnyTableau, printed, tolerance_of
from garkcli.tableau.tableau import Tableau
from garkcli.trees.notation import condition_latex, condition_text, vertex_letters
from garkcli.trees.tree import Tree


@dataclass(frozen=True)
class ConditionRow:
    """One line of the table.

    Attributes:
        tree: the tree; its colours mean nothing where ``is_shape``.
        is_shape: whether the row stands for all colourings of the tree.
        condition: its value for a method, where there is one.
        stands_for: how many conditions are equivalent to it in a symplectic method; 0 where nobody
            asked.
        members: the trees of these conditions, where asked for.
        digits: of values in decimals; None for exact ones.
    """

    tree: Tree
    is_shape: bool
    condition: Condition | None = None
    stands_for: int = 0
    members: tuple[Tree, ...] = ()
    digits: int | None = None

    @property
    def formula(self) -> str:
        """The condition in the paper's notation, in plain text."""
        return condition_text(self.tree, self._letters)

    @property
    def latex(self) -> str:
        """The condition in the paper's notation, in LaTeX."""
        return condition_latex(self.tree, self._letters)

    @property
    def _letters(self) -> tuple[str, ...] | None:
        """A letter for the colour of each vertex, where the row is for all colours."""
        return vertex_letters(self.tree) if self.is_shape else None


@dataclass(frozen=True)
class Valued:
    """What a table with values is about.

    Attributes:
        method: its tableau, with its rounding where it is rounded.
        only_failing: whether conditions that hold are counted but not shown.
        parameters: the free ones, of which values are rational functions.
        derivation: whether the method is the conjugate or the pair of what a file gives.
    """

    method: AnyTableau
    only_failing: bool = False
    parameters: tuple[str, ...] = ()
    derivation: str = ""

    @property
    def tableau(self) -> Tableau:
        """As it is printed."""
        return printed(self.method)

    @property
    def tolerance(self) -> fmpq | None:
        """The rounding of its coefficients; None where they are exact."""
        return tolerance_of(self.method)

    @property
    def names(self) -> list[str]:
        """The names of the colours."""
        return [colour.name for colour in self.tableau.colours]

    def shows(self, row: ConditionRow) -> bool:
        """Whether a row is in the table."""
        fails = row.condition is not None and not row.condition.holds
        return fails or row.condition is None or not self.only_failing


def shown(value: Number, digits: int | None) -> str:
    """A number as text, exactly or with so many digits."""
    return to_text(value) if digits is None else to_decimal(value, digits)
