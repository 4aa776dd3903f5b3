"""gark: order conditions and design of generalized additive Runge-Kutta methods, decided exactly.

{names}

Help has each of them: help(garkcli.find_order); docs/python.md has examples. The names are loaded
when they are first used, so importing the package costs nothing.
"""

from garkcli import upward
from garkcli.version import __version__ as __version__

NAMES = {
    "A method": {
        "api.files": "load loads check_file convert compare",
        "api.arrays": "from_arrays",
        "api.construction": "diagonal_method gark",
        "api.anymethod": "method_of",
        "catalogue": "catalogue",
        "bridges.calls": "import_methods audit audit_patch",
        "methodfile.build": "MethodFile",
        "tableau.garkmethod": "GarkMethod",
        "tableau.tableau": "Tableau",
    },
    "Properties": {
        "api.methods": "find_order is_symplectic analyse simplifying find_property",
        "api.asserting": "find_orders assert_order",
        "api.calls": "find_stability two_springs claims_of prove_method prove_method_exists",
        "report.calls": "certificate",
    },
    "Derived methods": {"api.methods": "conjugate pair symplectic_pair reduced"},
    "Trees": {
        "ntrees.tree": "Tree",
        "ntrees.notation": "parse_tree",
        "api.trees": "format_tree trees count_trees conditions all_conditions elementary_weight",
    },
    "Problems and runs": {
        "api.problems": "problem hamiltonian",
        "api.files": "load_problem loads_problem",
        "problems.oscillator": "Oscillator",
        "api.runs": "converge long_run symplecticity_defects bind integrate trajectory",
    },
    "The modified equation": {"api.runs": "backward_analysis modified_formula modified_run"},
    "Design": {
        "api.files": "load_family loads_family",
        "api.design": "find_parameters minimise search_methods found_methods stable_values",
        "report.calls": "run_sweep",
    },
    "Output and exchange": {
        "report.rendering": "render",
        "plots.calls": "plot",
        "bridges.calls": "export",
        "report.calls": "cite names",
        "webpage.page": "report_page",
        "api.calls": "with_claims",
        "methodfile.file_keys": "method_file_schema",
        "problems.files.keys": "problem_file_schema",
        "sweep.file": "sweep_schema",
        "cli.project": "project_schema",
        "report.schemas": "report_schema",
        "check.meanings": "explain",
    },
    "Errors": {
        "errors": "GarkError MethodFileError HasFreeParameters MethodError ZeroWeight "
        "ExpressionError TreeError UsageProblem"
    },
}
"""Every public name by topic and module; ``__init__.pyi`` is generated from it."""
HOMES = {
    name: home
    for homes in NAMES.values()
    for home, names in homes.items()
    for name in names.split()
}
__all__ = sorted(HOMES)
ANSWERS = {
    "api.asserting": "GarkMethod.orders=find_orders",
    "api.methods": "GarkMethod.order=find_order GarkMethod.symplectic=is_symplectic "
    "GarkMethod.conjugate=conjugate GarkMethod.pair=pair GarkMethod.check=analyse",
    "api.calls": "GarkMethod.stability=find_stability",
    "api.runs": "GarkMethod.converge=converge",
    "backward.formulas": "Algebraic.sympy=in_sympy",
    "cli.project": "FileKind.project=told",
    "exact.display": "Algebraic.float=nearest_float",
    "exact.polynomial_text": "RealRoot.text=root_in_short",
    "methodfile.file_keys": "FileKind.method=told",
    "problems.files.keys": "FileKind.problem=told",
    "sweep.file": "FileKind.sweep=told",
    "ntrees.notation": "Tree.text=shortest",
    "ntrees.drawing": "Tree.svg=draw_svg",
    "report.notebook": "GarkMethod.html=method_html GarkMethod.latex=method_latex "
    "Witness.html=witness_html Order.html=order_html RoundedOrder.html=order_html "
    "DenseOrder.html=dense_order_html Condition.html=condition_html "
    "Stability.latex=stability_latex StabilityFunction.latex=function_latex",
    "report.modified": "ModifiedFormula.latex=formula_latex",
    "report.rendering": "GarkMethod.to_latex=latex Analysis.html=html Outcome.html=html "
    "RosenbrockAnalysis.html=html InfinitesimalAnalysis.html=html NystromAnalysis.html=html "
    "NprkAnalysis.html=html DerivativesAnalysis.html=html "
    "Stability.html=html Comparison.html=html Design.html=html Minimum.html=html "
    "StableValues.html=html SweepReport.html=html MethodProof.html=html "
    "ModifiedRun.html=html BackwardAnalysis.html=html Convergence.html=html LongRun.html=html",
    "plots.calls": "GarkMethod.plot=plot_method",
}
_ANSWERING = {
    question: (room, function)
    for room, answers in ANSWERS.items()
    for question, _, function in (answer.partition("=") for answer in answers.split())
}


def _answering(kind, question):
    from importlib import import_module  # the command imports it when ^C is taken care of

    room, function = _ANSWERING.get(f"{kind}.{question}", ("", ""))
    return getattr(import_module(f"garkcli.{room}"), function) if room else None


upward.hand_down(_answering)


def _names_by_topic() -> str:
    lines = []
    for topic, homes in NAMES.items():
        line = f"{topic}:"
        for name in ", ".join(homes.values()).replace(" ", ", ").replace(",,", ",").split():
            if len(line) + len(name) > 98:
                lines.append(line)
                line = "   "
            line += f" {name}"
        lines.append(line)
    return "\n".join(lines)


__doc__ = (__doc__ or "").replace("{names}", _names_by_topic())


def __getattr__(name):
    if name not in HOMES:
        raise AttributeError(f"module 'garkcli' has no attribute {name!r}")
    from importlib import import_module

    room = import_module(f"garkcli.{HOMES[name]}")
    value = room if name == HOMES[name] else getattr(room, name)
    globals()[name] = value  # the next use finds it at once
    return value


def __dir__():
    """The public names, without imports and rooms."""
    return sorted({*__all__, *(name for name in globals() if name.startswith("__"))})
