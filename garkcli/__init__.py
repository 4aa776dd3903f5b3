"""gark: order conditions and design of generalized additive Runge-Kutta methods, decided exactly.

The public names are loaded when they are first used, so importing the package costs nothing.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from garkcli.dynamics.convergence import converge
    from garkcli.dynamics.energy import drift
    from garkcli.dynamics.examples import hamiltonian
    from garkcli.dynamics.longtime import follow
    from garkcli.dynamics.nonlinear import observe
    from garkcli.dynamics.problems import Oscillator
    from garkcli.dynamics.scheme import scheme
    from garkcli.dynamics.step import final, trajectory
    from garkcli.dynamics.symplecticity import defects
    from garkcli.families.registry import diagonal_method
    from garkcli.methodfile.check import check_file
    from garkcli.methodfile.load import load, loads
    from garkcli.methodfile.problem import load_problem, loads_problem
    from garkcli.order.certificate import find_order
    from garkcli.order.check import analyse
    from garkcli.order.conditions import conditions, elementary_weight
    from garkcli.order.simplifying import simplifying
    from garkcli.tableau.conjugate import conjugate, is_symplectic
    from garkcli.tableau.forms import gark, pair, symplectic_pair
    from garkcli.tableau.tableau import Tableau
    from garkcli.trees.notation import format_tree, parse_tree
    from garkcli.trees.tree import Tree

__version__ = "0.1.0"

_HOMES = {
    "analyse": "order.check",
    "check_file": "methodfile.check",
    "conditions": "order.conditions",
    "conjugate": "tableau.conjugate",
    "converge": "dynamics.convergence",
    "defects": "dynamics.symplecticity",
    "diagonal_method": "families.registry",
    "drift": "dynamics.energy",
    "elementary_weight": "order.conditions",
    "final": "dynamics.step",
    "find_order": "order.certificate",
    "follow": "dynamics.longtime",
    "format_tree": "trees.notation",
    "gark": "tableau.forms",
    "hamiltonian": "dynamics.examples",
    "is_symplectic": "tableau.conjugate",
    "load": "methodfile.load",
    "load_problem": "methodfile.problem",
    "loads": "methodfile.load",
    "loads_problem": "methodfile.problem",
    "observe": "dynamics.nonlinear",
    "Oscillator": "dynamics.problems",
    "pair": "tableau.forms",
    "parse_tree": "trees.notation",
    "scheme": "dynamics.scheme",
    "simplifying": "order.simplifying",
    "symplectic_pair": "tableau.forms",
    "Tableau": "tableau.tableau",
    "trajectory": "dynamics.step",
    "Tree": "trees.tree",
}

__all__ = [
    "Oscillator",
    "Tableau",
    "Tree",
    "analyse",
    "check_file",
    "conditions",
    "conjugate",
    "converge",
    "defects",
    "diagonal_method",
    "drift",
    "elementary_weight",
    "final",
    "find_order",
    "follow",
    "format_tree",
    "gark",
    "hamiltonian",
    "is_symplectic",
    "load",
    "load_problem",
    "loads",
    "loads_problem",
    "observe",
    "pair",
    "parse_tree",
    "scheme",
    "simplifying",
    "symplectic_pair",
    "trajectory",
]


def __getattr__(name: str) -> Any:
    if name not in _HOMES:
        raise AttributeError(f"module 'garkcli' has no attribute {name!r}")
    return getattr(import_module(f"garkcli.{_HOMES[name]}"), name)
