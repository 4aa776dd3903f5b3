"""Runge–Kutta methods with the R(z) of methods of other kinds."""

from __future__ import annotations

from flint import fmpq

from garkcli.constructions.derivatives import Derivatives, is_derivatives
from garkcli.constructions.rosenbrock import Rosenbrock, is_rosenbrock
from garkcli.order.meant import AnyTableau, keep, meant, printed
from garkcli.tableau.tableau import Tableau


def with_same_function(method: AnyTableau) -> AnyTableau | None:
    """The Runge–Kutta method with the R(z) of another kind of method; None if there is none."""
    tableau = printed(method)
    if not (is_rosenbrock(tableau) or is_derivatives(tableau)):
        return None
    if isinstance(method, Tableau):
        return _with_same_function(method)
    return method.derive("on test equation", _with_same_function)


def _with_same_function(tableau: Tableau) -> Tableau:
    kind = Derivatives if is_derivatives(tableau) else Rosenbrock
    return kind.of(tableau).on_test_equation


def on_test_equation(tableau: Tableau, tolerance: fmpq | None) -> Tableau | None:
    found = with_same_function(meant(tableau, tolerance))
    if found is None or isinstance(found, Tableau):
        return found
    keep(found)
    return printed(found)
