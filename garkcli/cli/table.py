"""The one table of calls: every command with what it is in Python, and every option once.

An option that is an argument of a function of ``garkcli`` takes its help and its default from it:
``of`` names both, and the docstring and the signature are where they stand. What else an option
needs is how it is written, and within which limits a terminal may give it.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any, NamedTuple

import click

from garkcli.cli.method_argument import INPUT, add_folders
from garkcli.cli.problems import ProblemType


class Option(NamedTuple):
    """An option.

    Attributes:
        written: its flags; before them the command, where it is another one elsewhere.
        help: what it does; empty where the argument says it.
        settings: what click is given; ``choices`` are words that are looked up when it is made.
        of: the function and the argument that it is in Python; empty where it is none.
    """

    written: str
    help: str = ""
    settings: Mapping[str, Any] | None = None
    of: str = ""

    @property
    def flags(self) -> list[str]:
        """How it is written."""
        return [word for word in self.written.split() if word.startswith("-")]

    @property
    def key(self) -> str:
        """The command, where it says one, and the flag of whole words."""
        words = self.written.split()
        long = next(x for x in self.flags if x.startswith("--")).partition("/")[0]
        return long if words[0].startswith("-") else f"{words[0]} {long}"


class Command(NamedTuple):
    """A command.

    Attributes:
        summary: its line in the help.
        calls: the names of the package that do the same.
        options: its own, in the order of the help; ``OPTIONS`` has them, first by the name of the
            command and theirs, then by theirs alone.
        arguments: what it takes; FILE is a method file or a name of the catalogue.
        common: the options that commands share, in the order of the help.
    """

    summary: str
    calls: str
    options: str = ""
    arguments: str = ""
    common: str = "--format --output --quiet --verbose --color --help"


FLAG = {"is_flag": True}
PATH = click.Path(readable=False)
"""The type of options that are places to write to; ``INPUT`` is that of files that are read."""
SECONDS = 60.0
"""The time of ``gark design`` where none is given."""


def count(least: int, most: int | None = None, metavar: str = "N", **more: Any) -> dict[str, Any]:
    """A whole number within limits."""
    return {"type": click.IntRange(least, most), "metavar": metavar, **more}


def argument(
    written: str, of: str, settings: Mapping[str, Any] | None = None, help: str = ""
) -> Option:
    """An option that is an argument in Python."""
    return Option(written, help, settings, of)


def text(metavar: str, **more: Any) -> dict[str, Any]:
    """A text that the command reads."""
    return {"metavar": metavar, **more}


def place(metavar: str = "FILE", **more: Any) -> dict[str, Any]:
    """Where something is written."""
    return {"type": PATH, "metavar": metavar, **more}


def one_of(*words: str, **more: Any) -> dict[str, Any]:
    """A word of several."""
    return {"type": click.Choice(words), **more}


def pairs(
    context: click.Context, parameter: click.Parameter, given: tuple[str, ...]
) -> dict[str, str]:
    """``NAME=VALUE``, each name once."""
    settings: dict[str, str] = {}
    for given_text in given:
        name, sign, value = given_text.partition("=")
        if not sign or not name.strip() or not value.strip():
            raise click.BadParameter(f"{given_text!r} is not NAME=VALUE", context, parameter)
        if name.strip() in settings:
            raise click.BadParameter(f"{name.strip()!r} is given twice", context, parameter)
        settings[name.strip()] = value.strip()
    return settings


def finite(_: click.Context, __: click.Parameter, seconds: float | None) -> float | None:
    """A number of seconds; nan, which no limit of a range holds off, is none."""
    if seconds is not None and seconds != seconds:
        raise click.BadParameter("nan is no number of seconds")
    return seconds


def beginning(names: Callable[[], Any]) -> Callable[..., list[str]]:
    """Completion: those of some names that begin so."""
    return lambda _context, _option, start: [x for x in names() if x.startswith(start)]


def _targets() -> Any:
    from garkcli.bridges.registry import bridges

    return bridges()


def _reports() -> Any:
    from garkcli.report.schemas import REPORTS

    return REPORTS


def _forms() -> Any:
    from garkcli.conversion.targets import TARGETS

    return TARGETS


def _kinds() -> Any:
    from garkcli.trees.symplectic import KINDS

    return KINDS


def _objectives() -> Any:
    from garkcli.design.minimise.objectives import OBJECTIVES

    return OBJECTIVES


PAIRS = {"multiple": True, "metavar": "NAME=VALUE", "callback": pairs}
DIGITS = count(1, 1000)
_ROWS = (
    # of every command
    Option("--format"),
    Option("import --format", "The report, or the method files themselves."),
    argument("cite --format", "cite.format"),
    Option("-o --output", "Write the report to FILE.", place()),
    Option("export -o --output", "Write to FILE.", place()),
    Option(
        "import -o --output",
        "Write a method file for each method into DIR.",
        place("DIR", name="folder"),
    ),
    Option("-q --quiet", "Say less.", FLAG),
    Option("-v --verbose", "Say more.", FLAG),
    Option("--color", "", one_of("auto", "always", "never", default="auto")),
    Option(
        "--set",
        "A value for a parameter of FILE, in place of the one in it; repeatable.",
        {"name": "settings", **PAIRS},
    ),
    Option(
        "--catalogue",
        "Method files below DIR have names too, as those of GARK_PATH; repeatable.",
        {
            "multiple": True,
            "metavar": "DIR",
            "type": click.Path(readable=False, file_okay=False),
            "is_eager": True,
            "expose_value": False,
            "callback": add_folders,
        },
    ),
    # of several
    Option(
        "--conjugate",
        "Take the symplectic conjugate of FILE instead.",
        {"name": "is_conjugate", **FLAG},
    ),
    Option(
        "--pair",
        "Take the symplectic pair of FILE instead, 2N colours.",
        {"name": "is_pair", **FLAG},
    ),
    Option(
        "--digits",
        "Numbers in decimals of N digits; by default exact, where they have simple radicals.",
        DIGITS,
    ),
    Option("--document", "With --format latex: a document that compiles as it stands.", FLAG),
    Option(
        "-j --jobs",
        "Processes side by side; 0 for as many as there are processors.",
        count(0, 256, default=1, show_default=True),
    ),
    argument("--scheduler", "run_sweep.scheduler", text("ADDRESS")),
    Option("--plot", "Draw what is found into FILE: .png, .svg or .pdf.", place()),
    # check
    argument("--max-order", "check_file.limit", count(1, 400)),
    argument("--error-constants", "check_file.want_constants", FLAG),
    Option(
        "--properties",
        "Every property that a file may claim, with what decides it.",
        {"name": "wants_properties", **FLAG},
    ),
    Option("--explain", "What a claim means, with its source; no FILE is needed.", text("KEY")),
    Option(
        "--baseline",
        "Fail only on what is worse than in an earlier JSON report.",
        text("REPORT", type=INPUT),
    ),
    Option("--require-claims", "A file that makes no claim under `expect` fails.", FLAG),
    # new, claims
    Option(
        "--tableau",
        "A Butcher tableau, its lines parted by ; or line ends; - reads it from standard input.",
        text("TEXT"),
    ),
    Option(
        "--family",
        "A member of a family, one a colour; repeatable.",
        text("NAME:STAGES", name="families", multiple=True),
    ),
    argument(
        "--transfer",
        "gark.transfer",
        text("RULE", default=None),
        "How the blocks between families are made; collocation where none is named.",
    ),
    argument("--name", "from_arrays.name", text("TEXT"), "What the method is called."),
    Option("--force", "Write over a file that is there.", FLAG),
    Option(
        "--write",
        "Put the claims into the files; nothing else of their text is touched.",
        {"name": "is_written", **FLAG},
    ),
    Option(
        "--all",
        "Everything that a file may claim and that is decided.",
        {"name": "wants_all", **FLAG},
    ),
    argument(
        "--key",
        "claims_of.keys",
        text("KEY", name="keys", multiple=True),
        "This claim, besides those that the file makes; repeatable.",
    ),
    # trees, conditions
    argument(
        "--colours -N",
        "all_trees.colours",
        count(1, 1000, default=None),
        "How many colours there are; with --symplectic, terms of the split.",
    ),
    argument("trees --order -n", "all_trees.order", count(1, 10000, "n")),
    Option("--upto", "Every order from 1 to n.", FLAG),
    Option("--root", "Only trees whose root has colour L.", count(1, None, "L")),
    Option("--colours-used", "Only trees in which each of these colours occurs.", text("L,M,...")),
    Option("--count", "Count without generating, for any order.", FLAG),
    Option("--yes", "List them also where they are millions.", FLAG),
    argument(
        "--tree",
        "parse_tree.text",
        text("TEXT", name="one"),
        "One tree, such as [[]_2,[]_1]_1, instead of an order.",
    ),
    Option("--svg", "Draw a sheet of all the trees into FILE.", place()),
    Option("--symplectic", "Independent conditions of symplectic methods: free trees.", FLAG),
    Option(
        "--kind",
        "With --symplectic: which methods, the pair (A, Â) unless given.",
        {"choices": _kinds},
    ),
    Option("--members", "With --symplectic: all rooted trees of each free tree.", FLAG),
    argument(
        "conditions --order -n",
        "all_conditions.order",
        count(1, 100, "n", default=4, show_default=True),
        "Every order up to n.",
    ),
    Option("--only", "Order n alone.", FLAG),
    Option(
        "--coloured/--shapes",
        "A row for each colouring, or a row for all of them (without FILE).",
        {"default": None},
    ),
    Option("--failing", "Only conditions of FILE that do not hold.", FLAG),
    Option(
        "conditions --sort",
        "Order of the rows; worst: the largest residual first.",
        one_of("tree", "worst", default="tree", show_default=True),
    ),
    # convert, diff
    argument("convert --to", "convert.to", {"choices": _forms}),
    argument("--stages", "convert.stages", count(1, 1000)),
    Option("--strict", "Exit with 1 unless every entry is the same as it stands.", FLAG),
    # stability
    argument(
        "--slow",
        "two_springs.slow",
        text("A"),
        "The slow one of two springs: its (hω)², or A..B for all of them; with --fast.",
    ),
    argument(
        "--fast",
        "two_springs.fast",
        text("COLOUR", default=None),
        "With --slow: the colour of the fast spring.",
    ),
    argument("--ratio", "find_stability.ratios", text("Q", multiple=True)),
    Option(
        "stability --digits",
        "Digits of numbers that have no simple radicals.",
        count(1, 1000, default=12, show_default=True),
    ),
    argument("--order-star", "plot.is_order_star", FLAG, "With --plot: |R(z)| > |exp z| instead."),
    # modified
    argument("modified --order -n", "backward_analysis.max_order", count(1, 100, "n", default=5)),
    Option("--equation", "Rooted trees too, where there is a modified Hamiltonian.", FLAG),
    argument(
        "modified --problem",
        "modified_formula.problem",
        {"type": ProblemType()},
        "The formula on a problem: a name that gark list shows, or a file.",
    ),
    # converge, energy
    argument(
        "converge --problem",
        "converge.problem",
        {"type": ProblemType()},
        "What to solve: a name that gark list shows, or a problem file; by default a random "
        "polynomial that sees every tree of the methods.",
    ),
    argument(
        "energy --problem",
        "long_run.problem",
        {"type": ProblemType(), "default": "oscillator", "show_default": True},
        "What to follow: a name that gark list shows, or a problem file.",
    ),
    argument(
        "--omega", "Oscillator.omega", text("W"), "The frequency of the oscillator; 1 by default."
    ),
    argument(
        "--split",
        "Oscillator.shares",
        text("K:V,..."),
        "The oscillator's shares of kinetic and potential energy.",
    ),
    argument(
        "--seed",
        "problem.seed",
        count(0, default=None),
        "The coefficients of random problems; 1 by default.",
    ),
    argument(
        "design --seed",
        "search_methods.seed",
        count(0, default=None),
        "With --search: of the starts; 0 by default.",
    ),
    argument(
        "--stiffness",
        "problem.stiffness",
        text("S"),
        "Of the stiff problems, and the parameter of this name in a problem file.",
    ),
    argument("--t-end", "long_run.t_end", text("T"), "The final time; each problem has its own."),
    argument(
        "--steps",
        "converge.steps",
        text("H,..."),
        "Step sizes, instead of a ladder of halvings that fits the errors.",
    ),
    argument(
        "--work",
        "converge.is_timed",
        FLAG,
        "Count evaluations, measure time, and plot the errors against them.",
    ),
    argument(
        "--against",
        "plot.against",
        one_of("h", "evaluations", "seconds", default=None),
        "What plots have below: h, or evaluations with --work; seconds depend on the machine.",
    ),
    argument("--step", "long_run.step", text("H")),
    argument(
        "energy --digits",
        "long_run.digits",
        count(1, 200, default=None),
        "Step with N digits instead of floats.",
    ),
    argument("--points", "long_run.points", count(10, 1_000_000)),
    Option("--symplecticity", "Measure MᵀJM − J of steps, M = ∂y₁/∂y₀.", FLAG),
    Option("--bounded", "Claim that nothing drifts, as far as this run can tell.", FLAG),
    Option("--max-error", "Claim that no energy error is larger than E.", text("E")),
    argument(
        "--modified",
        "modified_run.max_order",
        count(1, 100, "[ORDER]", is_flag=False, flag_value=5, default=None),
        "Measure in the modified Hamiltonian of trees up to ORDER, 5 by default, too.",
    ),
    # design
    argument("design --order", "find_parameters.order", count(1, 60, "P")),
    Option(
        "design --digits",
        "Digits of numbers without simple radicals.",
        count(1, 1000, default=12, show_default=True),
    ),
    argument(
        "--seconds",
        "find_parameters.seconds",
        text("T", type=click.FloatRange(min=0, min_open=True), callback=finite),
        "After so many what is not decided is left open, or a search ends; "
        f"{SECONDS:.0f} by default, of a search none.",
    ),
    Option("--emit", "Write the first method found as a method file with its claim.", place()),
    Option("--emit-all", "Write every method found into a folder.", place("DIR")),
    argument(
        "--minimise", "minimise.objective", text("WHAT", name="objective", choices=_objectives)
    ),
    argument(
        "--p-stable",
        "stable_values.wanted",
        {"name": "stability", "flag_value": "p-stable"},
        "The exact set of values of one parameter for which the method is P-stable.",
    ),
    argument(
        "--a-stable",
        "stable_values.wanted",
        {"name": "stability", "flag_value": "a-stable"},
        "The same for A-stability.",
    ),
    argument(
        "--l-stable",
        "stable_values.wanted",
        {"name": "stability", "flag_value": "l-stable"},
        "The same for L-stability.",
    ),
    argument(
        "--colour",
        "stable_values.colour",
        count(1),
        "With --a-stable or --l-stable: of colour N alone, in place of all with one λ.",
    ),
    argument(
        "design --slow",
        "stable_values.slow",
        text("A"),
        "With --p-stable: a slow and a fast spring, the slow one of (hω)² = A.",
    ),
    argument(
        "--up-to",
        "stable_values.up_to",
        text("X"),
        "With --slow: fast springs of (hω)² up to X only.",
    ),
    argument(
        "--search",
        "search_methods.starts",
        count(1, 10_000_000, name="starts", default=None),
        "Search from N random starts instead, and prove what is found.",
    ),
    argument(
        "--most",
        "search_methods.most",
        count(1, 100_000, "K", default=None),
        "With --search: methods to find at most; 5 by default.",
    ),
    Option("design -j --jobs", "With --search: processes side by side.", count(1, 1000)),
    Option(
        "design --scheduler",
        "With --search: work on the Dask cluster there; needs garkcli[cluster].",
        text("ADDRESS"),
    ),
    Option(
        "--choose",
        "As --set, and say what each choice leaves; repeatable.",
        {"name": "choices", **PAIRS},
    ),
    # sweep
    argument(
        "--rows",
        "run_sweep.rows",
        place(),
        "Where the rows go, a line of JSON each; by default SPEC with .jsonl.",
    ),
    argument("--resume", "run_sweep.is_resumed", FLAG, "Do what is missing in the rows."),
    argument("sweep -j --jobs", "run_sweep.jobs", count(1, 60)),
    Option(
        "--top",
        "How many of the best are shown; CSV and JSON lines have all.",
        count(1, default=10, show_default=True),
    ),
    Option(
        "--parquet",
        "Write the methods that are kept as Parquet too; needs garkcli[parquet].",
        place(),
    ),
    # export, import
    argument(
        "export --to",
        "export.target",
        text("TARGET", name="target", required=True, shell_complete=beginning(_targets)),
        "What to write for; gark list exports names the targets.",
    ),
    argument("export --digits", "export.digits", DIGITS),
    Option(
        "--test",
        "With -o: write beside it a program that runs the method in TARGET, and the problem "
        "file on which gark converge prints the same errors.",
        {"name": "has_test", **FLAG},
    ),
    argument(
        "--from",
        "import_methods.format",
        text("FORMAT", name="source_format"),
        "What SOURCE is; else the ending of its name says, or what is found in it.",
    ),
    argument(
        "--recognise",
        "import_methods.is_recognising",
        {"name": "is_recognising", **FLAG},
        "Exact numbers in place of decimals, where the order does not fall.",
    ),
    Option("import -v --verbose", "Show the method files.", FLAG),
    # report, schema
    argument("report --order -n", "report_page.order", count(1, 100, "n")),
    argument("--pictures/--no-pictures", "report_page.pictures"),
    Option("schema --problem", "Of problem files, instead.", FLAG),
    Option("--sweep", "Of spec files of gark sweep, instead.", FLAG),
    argument(
        "--report",
        "report_schema.command",
        text(
            "[COMMAND]",
            is_flag=False,
            flag_value="check",
            shell_complete=beginning(_reports),
            default=None,
        ),
        "Of what a command writes with --format json, instead; gark check where none is named.",
    ),
)
OPTIONS = {row.key: row for row in _ROWS}
"""Every option, by its longest flag, and by the command where it is another one there."""
COMPANIONS = "--conjugate --pair"
OF_PROBLEMS = "--omega --split --seed --stiffness --t-end"
FREE_TREES = "--symplectic --kind --members"
COMMANDS = {
    "check": Command(
        "orders, B/C/D, symplecticity and the claims of method files",
        "check_file analyse find_order find_orders is_symplectic find_property simplifying",
        "--max-order --error-constants --properties --explain --baseline --require-claims --jobs "
        "--digits --set",
        "[FILE...]",
    ),
    "new": Command(
        "a method file, from a tableau or from families",
        "from_arrays loads with_claims",
        "--tableau --family --transfer --name --force",
        "[PLACE]",
    ),
    "claims": Command(
        "what is true of a method, as its file claims it",
        "claims_of with_claims",
        "--write --all --key",
        "FILE...",
    ),
    "trees": Command(
        "enumerate or count the N-trees of an order",
        "all_trees count_trees parse_tree format_tree",
        f"--colours --order --upto --root --colours-used --count --yes --tree --svg --document "
        f"{FREE_TREES}",
    ),
    "conditions": Command(
        "the order-condition table, of any method or of a file",
        "all_conditions conditions elementary_weight",
        f"--colours --order --only --coloured {COMPANIONS} --failing --sort --digits --document "
        f"{FREE_TREES} --set",
        "[FILE]",
    ),
    "tableau": Command(
        "the assembled tableau, all blocks",
        "load",
        f"{COMPANIONS} --digits --document --set",
        "FILE",
    ),
    "conjugate": Command(
        "the symplectic conjugate tableau, or the pair",
        "conjugate pair symplectic_pair",
        "--pair --digits --document --set",
        "FILE",
    ),
    "reduce": Command(
        "the smallest method that does the same, as a method file", "reduced", "--set", "FILE"
    ),
    "convert": Command(
        "the same method in another form, as a method file",
        "convert",
        "--to --stages --set",
        "FILE",
    ),
    "diff": Command(
        "how two methods differ, and whether they are the same one",
        "compare",
        "--strict --set",
        "FIRST SECOND",
    ),
    "stability": Command(
        "A-, L-, P-stability, intervals, SSP coefficient, exactly",
        "find_stability two_springs",
        f"{COMPANIONS} --slow --fast --ratio --digits --plot --order-star --set",
        "FILE...",
    ),
    "modified": Command(
        "the modified equation or Hamiltonian, effective order",
        "backward_analysis modified_formula modified_run",
        f"--order {COMPANIONS} --equation --problem --seed --digits --document --set",
        "FILE",
    ),
    "converge": Command(
        "the convergence test on a problem",
        "converge problem hamiltonian load_problem bind integrate",
        f"{COMPANIONS} --problem {OF_PROBLEMS} --steps --work --against --plot --set",
        "FILE...",
    ),
    "energy": Command(
        "energy and other invariants over a long time: do they drift?",
        "long_run symplecticity_defects trajectory",
        f"{COMPANIONS} --problem {OF_PROBLEMS} --step --digits --points --symplecticity --bounded "
        "--max-error --modified --plot --set",
        "FILE",
    ),
    "design": Command(
        "for which values of its parameters a method has an order",
        "load_family find_parameters minimise search_methods found_methods stable_values",
        f"--order {COMPANIONS} --seconds --digits --emit --minimise --p-stable --a-stable "
        "--l-stable --colour --slow --fast --up-to --search --seed --most --jobs --scheduler "
        "--emit-all --set --choose",
        "FILE",
    ),
    "sweep": Command(
        "many methods side by side: which are best",
        "run_sweep",
        "--rows --resume --jobs --scheduler --top --parquet --plot --catalogue",
        "SPEC",
    ),
    "export": Command(
        "a method for SciPy, SUNDIALS, PETSc, C, JSON and others",
        "export",
        f"{COMPANIONS} --to --digits --test --set",
        "FILE",
        "--output --help",
    ),
    "import": Command(
        "methods out of C, Python, MATLAB, Julia, LaTeX, JSON and others",
        "import_methods",
        "--from --recognise",
        "SOURCE...",
    ),
    "audit": Command(
        "the tables of a source tree against what they declare", "audit", "", "PATH..."
    ),
    "certificate": Command(
        "what proves the orders, to be checked without gark",
        "certificate prove_method",
        "--set",
        "FILE",
    ),
    "explain": Command("what a word of a report or of a file means", "explain", "", "[WORD...]"),
    "list": Command(
        "families, transfer rules, problems, methods of the catalogue",
        "names catalogue",
        "--catalogue",
        "[WHAT] [WORD...]",
    ),
    "show": Command(
        "all about one method: tableau, properties, reference",
        "load analyse catalogue",
        "--set",
        "FILE",
    ),
    "cite": Command("where methods were published, for a bibliography", "cite", "", "FILE..."),
    "report": Command(
        "all about methods as one HTML page",
        "report_page",
        f"{COMPANIONS} --order --pictures --set",
        "FILE...",
    ),
    "schema": Command(
        "the JSON Schemas of method files, problem files and reports",
        "method_file_schema problem_file_schema sweep_schema report_schema",
        "--problem --sweep --report",
    ),
}
"""Every command; the module of the same name in this room has it."""
