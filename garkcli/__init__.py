"""gark: order conditions and design of generalized additive Runge-Kutta methods, decided exactly.

A method: load, loads, from_arrays, diagonal_method, gark, method_of; catalogue["rk4"]; from other
    sources import_methods, audit. MethodFile, GarkMethod, Tableau.
What is true of it: find_order, find_orders, find_property, find_stability, two_springs,
    is_symplectic, analyse, simplifying, claims_of; of a file check_file; in tests assert_order;
    proved by prove_method, certificate.
Methods from it: conjugate, pair, symplectic_pair, reduced, convert; side by side: compare.
Trees: Tree, parse_tree, format_tree, all_trees, count_trees; conditions, all_conditions,
    elementary_weight.
On problems: problem, hamiltonian, load_problem, loads_problem, Oscillator; converge, long_run,
    symplecticity_defects; bind, integrate, trajectory.
The modified equation: backward_analysis, modified_formula, modified_run.
Design: load_family, loads_family, find_parameters, minimise, search_methods,
    found_methods, stable_values; run_sweep.
To others: render, plot, export, cite, report_page, with_claims, method_file_schema,
    problem_file_schema, sweep_schema, report_schema; what there is: names, explain.
Errors: GarkError, and of it MethodFileError, HasFreeParameters, MethodError, ZeroWeight,
    ExpressionError, TreeError, UsageProblem.

Help has each of them: help(garkcli.find_order); docs/python.md has examples. The names are loaded
when they are first used, so importing the package costs nothing.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

from garkcli.version import __version__ as __version__

if TYPE_CHECKING:
    from garkcli.api.anymethod import method_of
    from garkcli.api.arrays import from_arrays
    from garkcli.api.asserting import assert_order, find_orders
    from garkcli.api.calls import claims_of, find_stability, prove_method, two_springs, with_claims
    from garkcli.api.construction import diagonal_method, gark
    from garkcli.api.design import (
        find_parameters,
        found_methods,
        minimise,
        search_methods,
        stable_values,
    )
    from garkcli.api.files import (
        check_file,
        compare,
        convert,
        load,
        load_family,
        load_problem,
        loads,
        loads_family,
        loads_problem,
    )
    from garkcli.api.methods import (
        analyse,
        conjugate,
        find_order,
        is_symplectic,
        pair,
        simplifying,
        symplectic_pair,
    )
    from garkcli.api.modified import backward_analysis, modified_formula, modified_run
    from garkcli.api.problems import hamiltonian, problem
    from garkcli.api.properties import find_property, reduced
    from garkcli.api.runs import (
        bind,
        converge,
        integrate,
        long_run,
        symplecticity_defects,
        trajectory,
    )
    from garkcli.api.trees import (
        all_conditions,
        all_trees,
        conditions,
        count_trees,
        elementary_weight,
        format_tree,
    )
    from garkcli.bridges.calls import audit, export, import_methods
    from garkcli.catalogue.mapping import Catalogue
    from garkcli.check.meanings import meanings as explain
    from garkcli.errors import (
        ExpressionError,
        GarkError,
        HasFreeParameters,
        MethodError,
        MethodFileError,
        TreeError,
        UsageProblem,
        ZeroWeight,
    )
    from garkcli.methodfile.build import MethodFile
    from garkcli.methodfile.problem_schema import problem_file_schema
    from garkcli.methodfile.schema import method_file_schema
    from garkcli.plots.calls import plot
    from garkcli.problems.oscillator import Oscillator
    from garkcli.report.calls import certificate, cite, names, run_sweep
    from garkcli.report.rendering import render
    from garkcli.report.schemas import report_schema
    from garkcli.sweep.load import sweep_schema
    from garkcli.tableau.garkmethod import GarkMethod
    from garkcli.tableau.tableau import Tableau
    from garkcli.trees.notation import parse_tree
    from garkcli.trees.tree import Tree
    from garkcli.webpage.calls import report_page

    catalogue: Catalogue

_HOMES = {
    "all_conditions": "api.trees",
    "all_trees": "api.trees",
    "analyse": "api.methods",
    "assert_order": "api.asserting",
    "audit": "bridges.calls",
    "backward_analysis": "api.modified",
    "bind": "api.runs",
    "certificate": "report.calls",
    "check_file": "api.files",
    "cite": "report.calls",
    "claims_of": "api.calls",
    "compare": "api.files",
    "conditions": "api.trees",
    "conjugate": "api.methods",
    "converge": "api.runs",
    "convert": "api.files",
    "count_trees": "api.trees",
    "diagonal_method": "api.construction",
    "elementary_weight": "api.trees",
    "explain": "check.meanings:meanings",
    "export": "bridges.calls",
    "ExpressionError": "errors",
    "find_order": "api.methods",
    "find_orders": "api.asserting",
    "find_parameters": "api.design",
    "found_methods": "api.design",
    "find_property": "api.properties",
    "find_stability": "api.calls",
    "format_tree": "api.trees",
    "from_arrays": "api.arrays",
    "gark": "api.construction",
    "GarkError": "errors",
    "GarkMethod": "tableau.garkmethod",
    "hamiltonian": "api.problems",
    "HasFreeParameters": "errors",
    "import_methods": "bridges.calls",
    "integrate": "api.runs",
    "is_symplectic": "api.methods",
    "load": "api.files",
    "load_family": "api.files",
    "load_problem": "api.files",
    "loads": "api.files",
    "loads_family": "api.files",
    "loads_problem": "api.files",
    "long_run": "api.runs",
    "method_file_schema": "methodfile.schema",
    "method_of": "api.anymethod",
    "MethodError": "errors",
    "MethodFile": "methodfile.build",
    "MethodFileError": "errors",
    "minimise": "api.design",
    "modified_formula": "api.modified",
    "modified_run": "api.modified",
    "names": "report.calls",
    "Oscillator": "problems.oscillator",
    "pair": "api.methods",
    "parse_tree": "trees.notation",
    "problem": "api.problems",
    "problem_file_schema": "methodfile.problem_schema",
    "prove_method": "api.calls",
    "reduced": "api.properties",
    "report_page": "webpage.calls",
    "report_schema": "report.schemas",
    "run_sweep": "report.calls",
    "search_methods": "api.design",
    "simplifying": "api.methods",
    "stable_values": "api.design",
    "two_springs": "api.calls",
    "plot": "plots.calls",
    "render": "report.rendering",
    "sweep_schema": "sweep.load",
    "symplectic_pair": "api.methods",
    "symplecticity_defects": "api.runs",
    "Tableau": "tableau.tableau",
    "trajectory": "api.runs",
    "TreeError": "errors",
    "Tree": "trees.tree",
    "UsageProblem": "errors",
    "with_claims": "api.calls",
    "ZeroWeight": "errors",
}
"""The module that each public name comes from, and what it is called there where that differs."""

_ROOMS = ("catalogue",)
"""Rooms that are public themselves."""

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
    "TreeError",
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
    "found_methods",
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
    "plot",
    "problem",
    "problem_file_schema",
    "prove_method",
    "reduced",
    "render",
    "report_page",
    "report_schema",
    "run_sweep",
    "search_methods",
    "simplifying",
    "stable_values",
    "sweep_schema",
    "symplectic_pair",
    "symplecticity_defects",
    "trajectory",
    "two_springs",
    "with_claims",
]


def __getattr__(name: str) -> Any:
    if name in _ROOMS:
        return import_module(f"garkcli.{name}")
    if name not in _HOMES:
        raise AttributeError(f"module 'garkcli' has no attribute {name!r}")
    home, _, other = _HOMES[name].partition(":")
    value = getattr(import_module(f"garkcli.{home}"), other or name)
    globals()[name] = value  # the next use finds it at once
    return value


def __dir__() -> list[str]:
    """What is meant for people: neither what this module imports nor the rooms."""
    of_module = [name for name in globals() if name.startswith("__")]
    return sorted({*of_module, *__all__})
