"""gark: order conditions and design of generalized additive Runge-Kutta methods, decided exactly.

The public names are loaded when they are first used, so importing the package costs nothing.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

from garkcli.version import __version__ as __version__

if TYPE_CHECKING:
    from garkcli.api.arguments import of_methods
    from garkcli.api.arrays import from_arrays
    from garkcli.api.asserting import assert_order, find_orders
    from garkcli.api.construction import diagonal_method, gark
    from garkcli.api.methods import (
        analyse,
        conjugate,
        find_order,
        is_symplectic,
        method_of,
        pair,
    )
    from garkcli.api.properties import find_property, reduced
    from garkcli.backward import energy as _energy
    from garkcli.backward import formulas as _formulas
    from garkcli.backward import summary as _summary
    from garkcli.catalogue.mapping import Catalogue
    from garkcli.check.check_file import check_file
    from garkcli.check.proof import prove_method
    from garkcli.comparison.comparison import compare
    from garkcli.convergence import convergence as _convergence
    from garkcli.conversion.convert import convert
    from garkcli.design.design import find_parameters
    from garkcli.design.minimise.minimise import minimise
    from garkcli.design.search.run import search_methods
    from garkcli.errors import (
        ExpressionError,
        GarkError,
        HasFreeParameters,
        MethodError,
        MethodFileError,
        UsageProblem,
        ZeroWeight,
    )
    from garkcli.longtime import longtime as _longtime
    from garkcli.longtime import symplecticity as _symplecticity
    from garkcli.methodfile.build import MethodFile
    from garkcli.methodfile.family import load_family, loads_family
    from garkcli.methodfile.load import load, loads
    from garkcli.methodfile.problem import load_problem, loads_problem
    from garkcli.order import conditions as _conditions
    from garkcli.order import simplifying as _simplifying
    from garkcli.problems.builtin import hamiltonian
    from garkcli.problems.oscillator import Oscillator
    from garkcli.stepping import integrator as _integrator
    from garkcli.stepping.step import integrate, trajectory
    from garkcli.tableau import forms as _forms
    from garkcli.tableau.garkmethod import GarkMethod
    from garkcli.tableau.tableau import Tableau
    from garkcli.trees.notation import format_tree, parse_tree
    from garkcli.trees.tree import Tree

    catalogue: Catalogue
    backward_analysis = of_methods(_summary.backward_analysis)
    bind = of_methods(_integrator.bind)
    conditions = of_methods(_conditions.conditions)
    converge = of_methods(_convergence.converge)
    elementary_weight = of_methods(_conditions.elementary_weight)
    long_run = of_methods(_longtime.long_run)
    modified_formula = of_methods(_formulas.modified_formula)
    modified_run = of_methods(_energy.modified_run)
    simplifying = of_methods(_simplifying.simplifying)
    symplectic_pair = of_methods(_forms.symplectic_pair)
    symplecticity_defects = of_methods(_symplecticity.symplecticity_defects)

_HOMES = {
    "analyse": "api.methods",
    "backward_analysis": "backward.summary",
    "bind": "stepping.integrator",
    "assert_order": "api.asserting",
    "check_file": "check.check_file",
    "compare": "comparison.comparison",
    "conditions": "order.conditions",
    "conjugate": "api.methods",
    "converge": "convergence.convergence",
    "convert": "conversion.convert",
    "diagonal_method": "api.construction",
    "elementary_weight": "order.conditions",
    "find_order": "api.methods",
    "find_orders": "api.asserting",
    "find_parameters": "design.design",
    "find_property": "api.properties",
    "format_tree": "trees.notation",
    "from_arrays": "api.arrays",
    "gark": "api.construction",
    "GarkError": "errors",
    "ZeroWeight": "errors",
    "UsageProblem": "errors",
    "MethodError": "errors",
    "HasFreeParameters": "errors",
    "ExpressionError": "errors",
    "GarkMethod": "tableau.garkmethod",
    "hamiltonian": "problems.builtin",
    "integrate": "stepping.step",
    "is_symplectic": "api.methods",
    "load": "methodfile.load",
    "load_family": "methodfile.family",
    "load_problem": "methodfile.problem",
    "loads": "methodfile.load",
    "loads_family": "methodfile.family",
    "loads_problem": "methodfile.problem",
    "long_run": "longtime.longtime",
    "method_of": "api.methods",
    "minimise": "design.minimise.minimise",
    "MethodFile": "methodfile.build",
    "MethodFileError": "errors",
    "modified_formula": "backward.formulas",
    "modified_run": "backward.energy",
    "Oscillator": "problems.oscillator",
    "pair": "api.methods",
    "parse_tree": "trees.notation",
    "prove_method": "check.proof",
    "reduced": "api.properties",
    "search_methods": "design.search.run",
    "simplifying": "order.simplifying",
    "symplectic_pair": "tableau.forms",
    "symplecticity_defects": "longtime.symplecticity",
    "Tableau": "tableau.tableau",
    "trajectory": "stepping.step",
    "Tree": "trees.tree",
}
"""The module that each public name comes from."""

_ROOMS = ("catalogue",)
"""Rooms that are public themselves."""

_OF_METHODS = frozenset(
    {
        "backward_analysis",
        "bind",
        "conditions",
        "converge",
        "elementary_weight",
        "long_run",
        "modified_formula",
        "modified_run",
        "simplifying",
        "symplectic_pair",
        "symplecticity_defects",
    }
)
"""Functions of tableaus, which are handed out as functions of whatever has a tableau."""
_OF_NUMBERS = _OF_METHODS | {
    "check_file",
    "integrate",
    "load",
    "load_family",
    "load_problem",
    "loads",
    "loads_family",
    "loads_problem",
    "trajectory",
}
"""Functions of exact numbers, which are handed out as functions of numbers of every kind."""

__all__ = [
    "ExpressionError",
    "GarkError",
    "GarkMethod",
    "HasFreeParameters",
    "MethodError",
    "MethodFile",
    "MethodFileError",
    "Oscillator",
    "Tableau",
    "Tree",
    "UsageProblem",
    "ZeroWeight",
    "analyse",
    "assert_order",
    "backward_analysis",
    "bind",
    "catalogue",
    "check_file",
    "compare",
    "conditions",
    "conjugate",
    "converge",
    "convert",
    "diagonal_method",
    "elementary_weight",
    "find_order",
    "find_orders",
    "find_parameters",
    "find_property",
    "format_tree",
    "from_arrays",
    "gark",
    "hamiltonian",
    "integrate",
    "is_symplectic",
    "load",
    "load_family",
    "load_problem",
    "loads",
    "loads_family",
    "loads_problem",
    "long_run",
    "method_of",
    "minimise",
    "modified_formula",
    "modified_run",
    "pair",
    "parse_tree",
    "prove_method",
    "reduced",
    "search_methods",
    "simplifying",
    "symplectic_pair",
    "symplecticity_defects",
    "trajectory",
]


def __getattr__(name: str) -> Any:
    if name in _ROOMS:
        return import_module(f"garkcli.{name}")
    if name not in _HOMES:
        raise AttributeError(f"module 'garkcli' has no attribute {name!r}")
    value = getattr(import_module(f"garkcli.{_HOMES[name]}"), name)
    if name in _OF_METHODS:
        value = import_module("garkcli.api.arguments").of_methods(value)
    if name in _OF_NUMBERS:
        value = import_module("garkcli.api.arguments").of_numbers(value)
    globals()[name] = value  # the next use finds it at once
    return value


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
