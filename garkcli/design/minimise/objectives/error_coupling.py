"""The principal error, over the trees of more than one colour."""

from garkcli.design.minimise.objective import Objective
from garkcli.design.minimise.squared_error import Quotient, squared_coupling_error
from garkcli.errors import UsageProblem
from garkcli.exact.parametric import Parameters
from garkcli.tableau.tableau import Tableau


def _formula(tableau: Tableau, order: int, ring: Parameters | None) -> Quotient:
    if tableau.size == 1:
        raise UsageProblem(
            "error-coupling: the method has one colour, and no tree has two",
            "minimise error",
            code="wanted-without-meaning",
        )
    return squared_coupling_error(tableau, order + 1, ring)


OBJECTIVE = Objective(
    "error-coupling",
    "Σ e(u)² over the trees of order {next} with more than one colour,"
    " e(u) = (b·𝒜[u] − 1/γ(u)) / σ(u)",
    _formula,
)
"""E. Hairer, S. Nørsett, G. Wanner, *Solving Ordinary Differential Equations I*, II.3."""
