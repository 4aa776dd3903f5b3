"""What may be minimised: a function of a method, and how it depends on parameters."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TypeAlias

from garkcli.design.minimise.squared_error import Quotient
from garkcli.exact.parametric import Parameters
from garkcli.tableau.tableau import Tableau

Formula: TypeAlias = Callable[[Tableau, int, "Parameters | None"], Quotient]
"""From a tableau, the order of its methods and the parameters in it (None where its entries are
numbers) to the objective, numerator and denominator.
"""


@dataclass(frozen=True)
class Objective:
    """Something that is made as small as possible.

    Attributes:
        key: its name; a minus sign means that the thing without it is made as large as possible.
        summary: what it is, in words.
        formula: a rational function of the coefficients.
    """

    key: str
    summary: str
    formula: Formula
