"""gark: order conditions and design of generalized additive Runge-Kutta methods, decided exactly.

The public names are loaded when they are first used, so importing the package costs nothing.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from garkcli.check.analysis import analyse
    from garkcli.check.check_file import check_file
    from garkcli.convergence.convergence import converge
    from garkcli.families.registry import diagonal_method
    from garkcli.longtime.energy import drift
    from garkcli.longtime.longtime import follow
    from garkcli.longtime.symplecticity import defects
    from garkcli.methodfile.load import load, loads
    from garkcli.methodfile.problem import load_problem, loads_problem
    from garkcli.order.certificate import find_order
    from garkcli.order.conditions import conditions, elementary_weight
    from garkcli.order.simplifying import simplifying
    from garkcli.problems.builtin import hamiltonian
    from garkcli.problems.oscillator import Oscillator
    from garkcli.stepping.integrator import bind
    from garkcli.stepping.step import integrate, trajectory
    from garkcli.tableau.conjugate import conjugate, is_symplectic
    from garkcli.tableau.forms import gark, pair, symplectic_pair
    from garkcli.tableau.tableau import Tableau
    from garkcli.trees.notation import format_tree, parse_tree
    from garkcli.trees.tree import Tree

__version__ = "0.1.0"

_HOMES = {
    "analyse": "check.analysis",
    "check_file": "check.check_file",
    "bind": "stepping.integrator",
    "conditions": "order.conditions",
    "conjugate": "tableau.conjugate",
    "converge": "convergence.convergence",
    "defects": "longtime.symplecticity",
    "diagonal_method": "families.registry",
    "drift": "longtime.energy",
    "elementary_weight": "order.conditions",
    "find_order": "order.certificate",
    "follow": "longtime.longtime",
    "format_tree": "trees.notation",
    "gark": "tableau.forms",
    "hamiltonian": "problems.builtin",
    "integrate": "stepping.step",
    "is_symplectic": "tableau.conjugate",
    "load": "methodfile.load",
    "load_problem": "methodfile.problem",
    "loads": "methodfile.load",
    "loads_problem": "methodfile.problem",
    "Oscillator": "problems.oscillator",
    "pair": "tableau.forms",
    "parse_tree": "trees.notation",
    "simplifying": "order.simplifying",
    "symplectic_pair": "tableau.forms",
    "Tableau": "tableau.tableau",
    "trajectory": "stepping.step",
    "Tree": "trees.tree",
}

__all__ = [
    "Oscillator",
    "Tableau",
    "Tree",
    "analyse",
    "bind",
    "check_file",
    "conditions",
    "conjugate",
    "converge",
    "defects",
    "diagonal_method",
    "drift",
    "elementary_weight",
    "find_order",
    "follow",
    "format_tree",
    "gark",
    "hamiltonian",
    "integrate",
    "is_symplectic",
    "load",
    "load_problem",
    "loads",
    "loads_problem",
    "pair",
    "parse_tree",
    "simplifying",
    "symplectic_pair",
    "trajectory",
]


def __getattr__(name: str) -> Any:
    if name not in _HOMES:
        raise AttributeError(f"module 'garkcli' has no attribute {name!r}")
    return getattr(import_module(f"garkcli.{_HOMES[name]}"), name)
