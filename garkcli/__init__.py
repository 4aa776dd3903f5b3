"""gark: order conditions and design of generalized additive Runge-Kutta methods, decided exactly.

A method: load, loads, from_arrays, diagonal_method, gark, method_of; catalogue["rk4"]; from other
    sources import_methods, audit. MethodFile, GarkMethod, Tableau.
What is true of it: find_order, find_orders, find_property, find_stability, is_symplectic, analyse,
    simplifying, claims_of; of a file check_file; in tests assert_order; proved by prove_method,
    certificate.
Methods from it: conjugate, pair, symplectic_pair, reduced, convert; side by side: compare.
Trees: Tree, parse_tree, format_tree, all_trees, count_trees; conditions, all_conditions,
    elementary_weight.
On problems: hamiltonian, load_problem, loads_problem, Oscillator; converge, long_run,
    symplecticity_defects; bind, integrate, trajectory.
The modified equation: backward_analysis, modified_formula, modified_run.
Design: load_family, loads_family, find_parameters, minimise, search_methods; run_sweep.
To others: export, cite, report_page, with_claims, method_file_schema, problem_file_schema,
    sweep_schema, report_schema; what there is: names, explain.
Errors: GarkError, and of it MethodFileError, HasFreeParameters, MethodError, ZeroWeight,
    ExpressionError, UsageProblem.

Help has each of them: help(garkcli.find_order); docs/python.md has examples. The names are loaded
when they are first used, so importing the package costs nothing.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

from garkcli.version import __version__ as __version__

if TYPE_CHECKING:
    from garkcli.api.arguments import of_methods
    from garkcli.api.arrays import from_arrays
    from garkcli.api.asserting import assert_order, find_orders
    from garkcli.api.calls import (
        all_trees,
        claims_of,
        find_stability,
        with_claims,
    )
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
    from garkcli.bridges.audit import audited as audit
    from garkcli.bridges.calls import export, import_methods
    from garkcli.catalogue.mapping import Catalogue
    from garkcli.check.check_file import check_file
    from garkcli.check.meanings import meanings as explain
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
    from garkcli.methodfile.problem_schema import problem_file_schema
    from garkcli.methodfile.schema import method_file_schema
    from garkcli.order import conditions as _conditions
    from garkcli.order import listing as _listing
    from garkcli.order import simplifying as _simplifying
    from garkcli.problems.builtin import hamiltonian
    from garkcli.problems.oscillator import Oscillator
    from garkcli.report.calls import certificate, cite, names, run_sweep
    from garkcli.report.schemas import report_schema
    from garkcli.stepping import integrator as _integrator
    from garkcli.stepping.step import integrate, trajectory
    from garkcli.sweep.load import sweep_schema
    from garkcli.tableau import forms as _forms
    from garkcli.tableau.garkmethod import GarkMethod
    from garkcli.tableau.tableau import Tableau
    from garkcli.trees.count import count_trees
    from garkcli.trees.notation import format_tree, parse_tree
    from garkcli.trees.tree import Tree
    from garkcli.webpage.calls import report_page

    catalogue: Catalogue
    all_conditions = of_methods(_listing.all_conditions)
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
    "all_conditions": "order.listing",
    "all_trees": "api.calls",
    "audit": "bridges.audit:audited",
    "certificate": "report.calls",
    "cite": "report.calls",
    "claims_of": "api.calls",
    "count_trees": "trees.count",
    "explain": "check.meanings:meanings",
    "export": "bridges.calls",
    "find_stability": "api.calls",
    "import_methods": "bridges.calls",
    "method_file_schema": "methodfile.schema",
    "names": "report.calls",
    "problem_file_schema": "methodfile.problem_schema",
    "report_page": "webpage.calls",
    "report_schema": "report.schemas",
    "run_sweep": "report.calls",
    "sweep_schema": "sweep.load",
    "with_claims": "api.calls",
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
"""The module that each public name comes from, and what it is called there where that differs."""

_ROOMS = ("catalogue",)
"""Rooms that are public themselves."""

_OF_METHODS = frozenset(
    {
        "all_conditions",
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
    "all_conditions",
    "all_trees",
    "analyse",
    "assert_order",
    "audit",
    "backward_analysis",
    "bind",
    "catalogue",
    "certificate",
    "check_file",
    "cite",
    "claims_of",
    "compare",
    "conditions",
    "conjugate",
    "converge",
    "convert",
    "count_trees",
    "diagonal_method",
    "elementary_weight",
    "explain",
    "export",
    "find_order",
    "find_orders",
    "find_parameters",
    "find_property",
    "find_stability",
    "format_tree",
    "from_arrays",
    "gark",
    "hamiltonian",
    "import_methods",
    "integrate",
    "is_symplectic",
    "load",
    "load_family",
    "load_problem",
    "loads",
    "loads_family",
    "loads_problem",
    "long_run",
    "method_file_schema",
    "method_of",
    "minimise",
    "modified_formula",
    "modified_run",
    "names",
    "pair",
    "parse_tree",
    "problem_file_schema",
    "prove_method",
    "reduced",
    "report_page",
    "report_schema",
    "run_sweep",
    "search_methods",
    "simplifying",
    "sweep_schema",
    "symplectic_pair",
    "symplecticity_defects",
    "trajectory",
    "with_claims",
]


def __getattr__(name: str) -> Any:
    if name in _ROOMS:
        return import_module(f"garkcli.{name}")
    if name not in _HOMES:
        raise AttributeError(f"module 'garkcli' has no attribute {name!r}")
    home, _, other = _HOMES[name].partition(":")
    value = getattr(import_module(f"garkcli.{home}"), other or name)
    if name in _OF_METHODS:
        value = import_module("garkcli.api.arguments").of_methods(value)
    if name in _OF_NUMBERS:
        value = import_module("garkcli.api.arguments").of_numbers(value)
    globals()[name] = value  # the next use finds it at once
    return value


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
