"""Methods constructed from the coupling of slow stages with fast problems."""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeAlias

from garkcli.constructions.infinitesimal import (
    CollocationPlan,
    Coupling,
    check_ends,
    infinitesimal,
    plan_for_flow,
    plan_for_method,
)
from garkcli.errors import counted
from garkcli.frozen import Frozen
from garkcli.methodfile.description import PartText
from garkcli.methodfile.values import Values
from garkcli.tableau.embedded import Further
from garkcli.tableau.forms import one_field
from garkcli.tableau.tableau import Method, Tableau

TableauOf: TypeAlias = Callable[[PartText], Tableau]


class Infinitesimal(Frozen):
    """Makes a multirate infinitesimal method.

    ``fast`` is None for the exact solution; ``coupling`` makes the coupling of the slow stages;
    ``steps`` is the number of small steps between two slow stages.
    """

    fast: PartText | None
    coupling: Callable[[TableauOf, Values], Coupling]
    steps: int

    def __call__(self, tableau_of: TableauOf, values: Values) -> tuple[Tableau, Further]:
        coupling = self.coupling(tableau_of, values)
        values.once(("ends", id(self)), lambda: check_ends(coupling))
        plan_for = plan_for_flow if self.fast is None else plan_for_method
        plan: CollocationPlan = values.once(("plan", id(self)), lambda: plan_for(coupling))
        fast = None if self.fast is None else method_of_part(tableau_of, self.fast, "fast")
        return infinitesimal(coupling, plan, fast, self.steps)


def method_of_part(tableau_of: TableauOf, part: PartText, key: str) -> Method:
    """Returns the method of a part that has one vector field; ``key`` is its place under
    ``multirate``.
    """
    tableau = tableau_of(part)
    message = f"multirate, {key}: a method of {counted(tableau.size, 'colour')}, "
    return one_field(tableau, message + "where a method of one vector field is expected")
