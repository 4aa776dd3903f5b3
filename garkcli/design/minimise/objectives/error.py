"""The principal error, over all trees."""

from garkcli.design.minimise.objective import Objective
from garkcli.design.minimise.squared_error import Quotient, squared_error
from garkcli.exact.parametric import Parameters
from garkcli.tableau.tableau import Tableau


def _formula(tableau: Tableau, order: int, ring: Parameters | None) -> Quotient:
    return squared_error(tableau, order + 1, ring)


OBJECTIVE = Objective(
    "error", "Σ e(u)² over the trees of order {next}, e(u) = (b·𝒜[u] − 1/γ(u)) / σ(u)", _formula
)
"""E. Hairer, S. Nørsett, G. Wanner, *Solving Ordinary Differential Equations I*, II.3."""
