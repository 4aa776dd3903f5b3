"""The table of commands: groups, files, summaries, Python functions, and former names."""

from __future__ import annotations

from garkcli.frozen import Frozen


class Command(Frozen):
    """A command: its heading in the help, its module, and the functions of the package for it.

    Its arguments and options are declared in the module.
    """

    group: str
    file: str
    summary: str
    calls: tuple[str, ...]


INSPECT, ANALYSE, BUILD, SEARCH = "Inspect", "Analyse", "Build", "Search"
EXCHANGE = "Exchange and CI"
COMMANDS = {
    "check": Command(
        INSPECT,
        "checking",
        "order and properties of methods; are their claims true?",
        (
            "check_file",
            "analyse",
            "find_order",
            "find_orders",
            "is_symplectic",
            "find_property",
            "simplifying",
        ),
    ),
    "show": Command(
        INSPECT,
        "looking_up",
        "one method: tableau, orders, properties, reference",
        ("load", "analyse", "catalogue", "cite"),
    ),
    "report": Command(INSPECT, "looking_up", "methods as one HTML page", ("report_page",)),
    "plot": Command(INSPECT, "plotting", "one look at a method, in the terminal", ("plot",)),
    "list": Command(
        INSPECT,
        "looking_up",
        "families, transfer rules, problems, methods of the catalogue",
        ("names", "catalogue"),
    ),
    "explain": Command(
        INSPECT, "looking_up", "the meaning of a word in a report or a file", ("explain",)
    ),
    "stability": Command(
        ANALYSE,
        "stability",
        "A-, L-, P-stability, intervals, SSP coefficient, exactly",
        ("find_stability", "two_springs"),
    ),
    "conditions": Command(
        ANALYSE,
        "trees",
        "the order conditions, in general or of one method",
        ("all_conditions", "conditions", "elementary_weight"),
    ),
    "trees": Command(
        ANALYSE,
        "trees",
        "the trees of an order: list, count or draw them",
        ("trees", "count_trees", "parse_tree", "format_tree"),
    ),
    "modified": Command(
        ANALYSE,
        "running",
        "the modified equation or Hamiltonian, and the effective order",
        ("backward_analysis", "modified_formula", "modified_run"),
    ),
    "converge": Command(
        ANALYSE,
        "running",
        "errors over step sizes: does the method show its order?",
        ("converge", "problem", "hamiltonian", "load_problem", "bind", "integrate"),
    ),
    "energy": Command(
        ANALYSE,
        "running",
        "does the energy drift over a long time?",
        ("long_run", "symplecticity_defects", "trajectory"),
    ),
    "new": Command(
        BUILD,
        "building",
        "a new method file, from a tableau or from families",
        ("from_arrays", "loads", "with_claims"),
    ),
    "tableau": Command(BUILD, "tableaux", "the whole tableau, block by block", ("load",)),
    "conjugate": Command(
        BUILD,
        "tableaux",
        "the symplectic conjugate, or the symplectic pair",
        ("conjugate", "pair", "symplectic_pair"),
    ),
    "convert": Command(
        BUILD,
        "tableaux",
        "the same method in another form, or with fewer stages",
        ("convert", "reduced"),
    ),
    "diff": Command(
        BUILD, "tableaux", "how two methods differ, or that they are the same", ("compare",)
    ),
    "design": Command(
        SEARCH,
        "designing",
        "the parameter values that give a method an order",
        (
            "load_family",
            "find_parameters",
            "minimise",
            "search_methods",
            "found_methods",
            "stable_values",
        ),
    ),
    "sweep": Command(SEARCH, "designing", "many methods compared: which are best?", ("run_sweep",)),
    "import": Command(
        EXCHANGE,
        "exchange",
        "methods from C, Python, MATLAB, Julia, LaTeX, JSON and others",
        ("import_methods",),
    ),
    "export": Command(
        EXCHANGE,
        "exchange",
        "a method for SciPy, PETSc, C, JSON and others; a proof of its orders",
        ("export", "certificate", "prove_method", "prove_method_exists"),
    ),
    "audit": Command(
        EXCHANGE,
        "exchange",
        "the tables in a source tree: are their declared orders true?",
        ("audit", "audit_patch"),
    ),
    "claims": Command(
        EXCHANGE,
        "building",
        "the true claims of a method, for its file",
        ("claims_of", "with_claims"),
    ),
    "schema": Command(
        EXCHANGE,
        "looking_up",
        "JSON Schemas of method files, problem files and reports",
        (
            "method_file_schema",
            "problem_file_schema",
            "sweep_schema",
            "project_schema",
            "report_schema",
        ),
    ),
}
"""The commands in the order of the help."""
FORMER = {
    "reduce": ("convert", "--to", "reduced"),
    "cite": ("show", "--reference"),
    "certificate": ("export", "--to", "certificate"),
}
"""Former names of commands, which the help does not list, and the words they stand for."""
