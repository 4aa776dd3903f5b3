"""The method that pictures are drawn of, and what they share."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

from garkcli.errors import ZeroWeight
from garkcli.tableau.forms import pair
from garkcli.tableau.garkmethod import GarkMethod
from garkcli.tableau.tableau import Tableau

MOST_STAGES = 40
"""Of a method that is put to work for a picture."""
MOST_ROUNDED_STAGES = 20
"""Of one with rounded coefficients, whose order takes longer."""


@dataclass(frozen=True)
class Subject:
    """One method.

    Attributes:
        method: as its file gives it.
        steps_as_pair: whether it is put to work on Hamiltonian problems as its symplectic pair, as
            ``gark converge`` and ``gark energy`` do with files that give ``methods``.
    """

    method: GarkMethod
    steps_as_pair: bool = False

    @cached_property
    def stepped(self) -> Tableau:
        """The tableau that steps Hamiltonian problems."""
        tableau = self.method.tableau
        if not self.is_stepped_as_pair:
            return tableau
        return pair(tableau)

    @cached_property
    def is_stepped_as_pair(self) -> bool:
        """Whether the tableau that steps is the symplectic pair."""
        tableau = self.method.tableau
        if not self.steps_as_pair or tableau.is_partitioned:
            return False
        try:
            pair(tableau)
        except ZeroWeight:
            return False
        return True

    @property
    def is_large(self) -> bool:
        """Whether steps would take longer than a picture is worth."""
        stages = sum(self.method.stages)
        is_rounded = self.method.tolerance is not None
        most = MOST_ROUNDED_STAGES if is_rounded else MOST_STAGES
        return stages > most
