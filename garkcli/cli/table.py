"""The table of commands: groups, files, summaries, Python functions, and former names."""

from __future__ import annotations

from garkcli.frozen import Frozen


class Command(Frozen):
    """``group`` is a heading, ``calls`` functions of the package, ``examples`` lines to copy."""

    group: str
    file: str
    summary: str
    calls: tuple[str, ...]
    examples: tuple[str, ...]


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
        ("gark check rk4", "gark check mine.yaml", "gark check gauss-3 --format json"),
    ),
    "show": Command(
        INSPECT,
        "looking_up",
        "one method: tableau, orders, properties, reference",
        ("load", "analyse", "catalogue", "cite"),
        ("gark show dopri5", "gark show dopri5 --reference"),
    ),
    "report": Command(
        INSPECT,
        "looking_up",
        "methods as one HTML page",
        ("report_page",),
        ("gark report rk4", "gark report rk4 heun --no-pictures -o both.html"),
    ),
    "plot": Command(
        INSPECT,
        "plotting",
        "one look at a method, in the terminal",
        ("plot",),
        (
            "gark plot rk4",
            "gark plot gauss-2 --what star -o star.svg",
            "gark plot rk4 --what energy",
        ),
    ),
    "list": Command(
        INSPECT,
        "looking_up",
        "families, transfer rules, problems, methods of the catalogue",
        ("names", "catalogue"),
        (
            "gark list methods",
            "gark list methods --kind rk --order 5 --a-stable",
            "gark list problems",
        ),
    ),
    "explain": Command(
        INSPECT,
        "looking_up",
        "the meaning of a word in a report or a file",
        ("explain",),
        ("gark explain stage order", "gark explain legendre"),
    ),
    "stability": Command(
        ANALYSE,
        "stability",
        "A-, L-, P-stability, intervals, SSP coefficient, exactly",
        ("find_stability", "two_springs"),
        ("gark stability rk4", "gark stability gauss-2 --format latex"),
    ),
    "conditions": Command(
        ANALYSE,
        "trees",
        "the order conditions, in general or of one method",
        ("all_conditions", "conditions", "elementary_weight"),
        ("gark conditions --order 4", "gark conditions rk4 --order 5 --failing"),
    ),
    "trees": Command(
        ANALYSE,
        "trees",
        "the trees of an order: list, count or draw them",
        ("trees", "count_trees", "parse_tree", "format_tree"),
        ("gark trees 4", "gark trees 5 --count --upto", "gark trees 3 --colours 2 --svg trees.svg"),
    ),
    "modified": Command(
        ANALYSE,
        "running",
        "the modified equation or Hamiltonian, and the effective order",
        ("backward_analysis", "modified_formula", "modified_run"),
        ("gark modified gauss-2", "gark modified leapfrog-2 --order 3 --problem kepler"),
    ),
    "converge": Command(
        ANALYSE,
        "running",
        "errors over step sizes: does the method show its order?",
        ("converge", "problem", "hamiltonian", "load_problem", "bind", "integrate"),
        ("gark converge heun", "gark converge rk4 --problem kepler"),
    ),
    "energy": Command(
        ANALYSE,
        "running",
        "does the energy drift over a long time?",
        ("long_run", "symplecticity_defects", "trajectory"),
        ("gark energy leapfrog-2", "gark energy gauss-2 --problem kepler --t-end 100"),
    ),
    "new": Command(
        BUILD,
        "building",
        "a new method file, from a tableau or from families",
        ("from_arrays", "loads", "with_claims"),
        (
            "gark new mine2.yaml --family gauss:2",
            "gark new pair.yaml --family gauss:2 --family lobatto-iiia:3",
        ),
    ),
    "tableau": Command(
        BUILD,
        "tableaux",
        "the whole tableau; the symplectic conjugate or pair",
        ("load", "conjugate", "pair", "symplectic_pair"),
        (
            "gark tableau gauss-2",
            "gark tableau rk4 --conjugate",
            "gark tableau mine.yaml --format latex",
        ),
    ),
    "convert": Command(
        BUILD,
        "tableaux",
        "the same method in another form, or with fewer stages",
        ("convert", "reduced"),
        ("gark convert gauss-2 --to reduced", "gark convert ark-ars222 --to gark -o mine2.yaml"),
    ),
    "diff": Command(
        BUILD,
        "tableaux",
        "how two methods differ, or that they are the same",
        ("compare",),
        ("gark diff lobatto-iiia-2 Trapezoid", "gark diff gauss-1 implicit-midpoint"),
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
        ("gark design sdirk.yaml", "gark design sdirk.yaml --order 3 --a-stable"),
    ),
    "sweep": Command(
        SEARCH,
        "designing",
        "many methods compared: which are best?",
        ("run_sweep",),
        ("gark sweep spec.yaml", "gark sweep spec.yaml --resume --top 3"),
    ),
    "import": Command(
        EXCHANGE,
        "exchange",
        "methods from C, Python, MATLAB, Julia, LaTeX, JSON and others",
        ("import_methods",),
        ("gark import tables.json", "gark import tables.json --format yaml"),
    ),
    "export": Command(
        EXCHANGE,
        "exchange",
        "a method for SciPy, PETSc, C, JSON and others; a proof of its orders",
        ("export", "certificate", "prove_method", "prove_method_exists"),
        ("gark export rk4 --to c", "gark export rk4 --to certificate -o rk4.json"),
    ),
    "audit": Command(
        EXCHANGE,
        "exchange",
        "the tables in a source tree: are their declared orders true?",
        ("audit", "audit_patch"),
        ("gark audit tables.json", "gark audit tables.json --strict"),
    ),
    "claims": Command(
        EXCHANGE,
        "building",
        "the true claims of a method, for its file",
        ("claims_of", "with_claims"),
        ("gark claims rk4", "gark claims mine.yaml --write"),
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
        ("gark schema", "gark schema --report stability"),
    ),
    "lsp": Command(
        EXCHANGE,
        "editing",
        "orders and remarks in an editor, while a method file is typed",
        (),
        ("gark lsp --once mine.yaml", "gark lsp --once rk4"),
    ),
}
FORMER = {
    "conjugate": ("tableau", "--conjugate"),
    "reduce": ("convert", "--to", "reduced"),
    "cite": ("show", "--reference"),
    "certificate": ("export", "--to", "certificate"),
}
"""Former names, which the help does not list, and their words."""
