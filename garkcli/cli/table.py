"""The table of calls: all commands with their Python functions, and all options."""

from __future__ import annotations

import re
from collections.abc import Iterator

from garkcli.frozen import Frozen


class Option(Frozen):
    """An option.

    ``written`` has its flags, after the name of a command if it differs there; ``kind`` describes
    its value as ``OPTIONS`` explains, empty for a flag; ``of`` is the function and the argument in
    Python, or empty; ``help`` is empty if the docstring of the argument serves.
    """

    written: str
    kind: tuple[str, ...]
    of: str
    help: str

    @property
    def flags(self) -> list[str]:
        return [word for word in self.written.split() if word.startswith("-")]

    @property
    def key(self) -> str:
        """The command, if the option depends on it, and the long flag."""
        words = self.written.split()
        long = next(x for x in self.flags if x.startswith("--")).partition("/")[0]
        return long if words[0].startswith("-") else f"{words[0]} {long}"

    @property
    def name(self) -> str:
        """The name of the value in the command."""
        names = (word.removeprefix("name=") for word in self.kind if word.startswith("name="))
        return next(names, self.key.split()[-1].lstrip("-").replace("-", "_"))

    @property
    def is_flag(self) -> bool:
        return all(word.startswith(("name=", "default=")) for word in self.kind)


class Command(Frozen):
    """A command.

    ``group`` is its heading in the help, ``HIDDEN`` for names that are not listed; ``file`` its
    module; ``arguments`` as in the usage; ``calls`` the equivalent functions of the package;
    ``options`` its own, ``common`` those that commands share.
    """

    group: str
    file: str
    arguments: str
    summary: str
    calls: str
    options: str
    common: str


class OptionRule(Frozen):
    """Options that require or exclude others.

    One of ``options`` is given; if ``needs``, one of ``others`` is required, otherwise they are
    excluded. An option with ``=`` stands for that value; for ``--format`` the effective format
    counts, for ``--output`` a file. OPTION in the message is the option that is given.
    """

    options: tuple[str, ...]
    needs: bool
    others: tuple[str, ...]
    message: str
    cure: str

    @property
    def code(self) -> str:
        """The kind of fault."""
        return "option-alone" if self.needs else "options-clash"


HIDDEN = "hidden"
"""The group of former names: they work and are not listed."""
SECONDS = 60.0
"""The default time of ``gark design``."""
_COMMON = "--format --output --quiet --verbose --color --help"
_OPTIONS = f"""
--format formats
import --format formats | The report, or the method files themselves.
cite --format formats = cite.format
-o --output FILE written
    | Write the result to FILE, in the format that its ending names; - is standard output.
export -o --output FILE written | Write to FILE, whose ending is that of TARGET.
--output-dir DIR written name=folder | Write a method file for each method into DIR.
report -o --output FILE written
    | Write the page to FILE; by default to METHOD.html, of several methods to report.html.
-q --quiet | Say less.
-v --verbose | Say more.
import -v --verbose | Show the method files.
--color words=auto,always,never default=auto
--set pairs name=settings
    | Give a parameter of FILE a value; repeatable.
--catalogue folders
    | Add the method files below DIR to the catalogue; repeatable.

--conjugate | Take the symplectic conjugate of FILE instead.
--pair | Take the symplectic pair of FILE instead, 2N colours.
--digits N 1..1000
    | Decimals with N digits; by default numbers with simple radicals are exact.
--transformation
    | Add the eigenvalues of the inverse of A, and T with its real block form.
--document | With --format latex: a complete document that compiles.
-j --jobs N 0..256 jobs default=1
    | The number of processes; 0 is one per processor.
--scheduler ADDRESS = run_sweep.scheduler
--plot FILE picture | Draw a plot into FILE: .png, .svg or .pdf.

--max-order N 1..400 = check_file.limit
--error-constants = check_file.want_constants
--properties | List every property with its reason.
--explain KEY | Explain a claim, with its source; needs no FILE.
--baseline REPORT read | Fail only if something got worse since an earlier JSON report.
--require-claims | Fail a file without claims under `expect`.

--tableau TEXT
    | A Butcher tableau, its lines separated by ; or line ends; @FILE reads it from a file, - from
      standard input.
--family NAME-STAGES many name=families | A family with its stages, one per colour; repeatable.
--transfer RULE default= = gark.transfer
    | The rule for the blocks between families; by default collocation.
--name TEXT = from_arrays.name | The name of the method.
--force | Overwrite an existing file.
--write | Put the claims into the files, and change nothing else.
--all | Every decided claim.
--key KEY many name=keys = claims_of.keys
    | Add this claim; repeatable.

--colours -N N 1..1000 default= = trees.colours
    | The number of colours; with --symplectic, of terms of the split.
trees --order -n n 1..10000 = trees.order
--upto | Every order from 1 to n.
--root L 1.. | Only trees whose root has colour L.
--colours-used L,M,... | Only trees in which each of these colours occurs.
--count | Count without generating, for any order.
--yes | List the trees even if there are millions.
--tree TEXT = parse_tree.text | One tree, such as [[]_2,[]_1]_1, instead of an order.
--svg FILE written holds=svg | Draw a sheet of all the trees into FILE.
--symplectic | Independent conditions of symplectic methods: free trees.
--kind words=kinds | With --symplectic: which methods, the pair (A, Â) unless given.
--members | With --symplectic: all rooted trees of each free tree.
conditions --order -n n 1..100 default=4 = all_conditions.order | Every order up to n.
--only | Order n alone.
--coloured/--shapes default=
    | A row per colouring, or one row for all (without FILE).
--failing | Only conditions that FILE does not meet.
conditions --sort words=tree,worst default=tree
    | Order of the rows; worst: the largest residual first.

convert --to FORM words=forms = convert.to
    | The form of the result: spelled-out, gark, ark, prk, pair, canonical, recovered, reduced,
    2N, 2R, 3R, 4R, 5R or shu-osher; of a Rosenbrock method printed or transformed.
--stages N 1..1000 = convert.stages
convert --digits N 1..1000 = convert.digits
convert --recognise = convert.is_recognising
--strict | Exit with 1 unless every entry is identical.

--slow A = two_springs.slow
    | The slow one of two springs: its (hω)², or A..B for all of them; with --fast.
--fast COLOUR default= = two_springs.fast | With --slow: the colour of the fast spring.
--ratio Q many ratios = find_stability.ratios
--at Z many points = find_stability.at
stability --seconds T seconds = find_stability.seconds
    | Seconds of processor time after which the rest is not decided.
stability --digits N 1..1000 default=12 | Digits of numbers that have no simple radicals.
--order-star = plot.is_order_star | In the picture |R(z)| > |exp z| instead.

modified --order -n n 1..100 default=5 = backward_analysis.max_order
--equation | Show rooted trees too if there is a modified Hamiltonian.
modified --problem problem = modified_formula.problem
    | The formula on a problem: a name of gark list problems, or a file.
converge --problem problem = converge.problem
    | The problem to solve: a name of gark list problems, or a file; by default a random
      polynomial that sees every tree.
energy --problem problem default=oscillator = long_run.problem
    | The problem to follow: a name of gark list problems, or a file.
--omega W positive = Oscillator.omega | The frequency of the oscillator; 1 by default.
--split K:V,... = Oscillator.shares | The oscillator's shares of kinetic and potential energy.
--seed N 0.. default= = problem.seed | The seed of random coefficients; 1 by default.
design --seed N 0.. default= = search_methods.seed
    | With --search: the seed of the starts; 0 by default.
--stiffness S positive = problem.stiffness
    | The stiffness of a stiff problem; in a file the parameter of this name.
--t-end T positive = long_run.t_end | The final time; each problem has its own.
--steps H,... positives = converge.steps
    | Step sizes, instead of a ladder of halvings that fits the errors.
--work = converge.is_timed
    | Count evaluations, measure time, and plot the errors against them.
--against words=h,evaluations,seconds default= = plot.against
    | The horizontal axis of plots: h, or evaluations with --work; seconds depend on the machine.
--jacobian words=exact,old,diagonal default= = converge.jacobian
    | The Jacobian of a Rosenbrock method: exact; old, of the step before; or diagonal, that of any
      matrix.
--step H positive = long_run.step
energy --digits N 1..200 default= = long_run.digits | Step with N digits instead of floats.
--points N 10..1000000 = long_run.points
--symplecticity | Measure MᵀJM − J of steps, M = ∂y₁/∂y₀.
--bounded | Claim that nothing drifts, as far as this run can tell.
--max-error E positive | Claim that no energy error is larger than E.
--modified [ORDER] 1..100 alone=5 = modified_run.max_order
    | Measure the modified Hamiltonian of trees up to ORDER (by default 5) too.

design --order P 1..60 = find_parameters.order
design --digits N 1..1000 default=12 | Digits of numbers without simple radicals.
--seconds T seconds = find_parameters.seconds
    | Seconds after which the rest stays undecided, or a search ends; {SECONDS:.0f} by default, of
      a search none.
--emit FILE written holds=yaml | Write the first method into a file, with its claim.
--minimise WHAT = minimise.objective
--p-stable value=p-stable name=stability = stable_values.wanted
    | The exact set of values of the parameters for which the method is P-stable.
--i-stable value=i-stable name=stability = stable_values.wanted | The same for I-stability.
--a-stable value=a-stable name=stability = stable_values.wanted | The same for A-stability.
--l-stable value=l-stable name=stability = stable_values.wanted | The same for L-stability.
--colour N 1.. = stable_values.colour
    | With --a-stable or --l-stable: for colour N alone, instead of one λ for all.
design --slow A square = stable_values.slow
    | With --p-stable or --i-stable: a slow and a fast spring, the slow one of (hω)² = A.
--up-to X square = stable_values.up_to | With --slow: fast springs of (hω)² up to X only.
--search N 1..10000000 default= = search_methods.starts
    | Search from N random starts instead, and prove the finds; with --minimise the best one.
--most K 1..100000 default= = search_methods.most
    | With --search: the most methods to find; by default 5, with --minimise the best one.
design -j --jobs N 0..1000 jobs
    | With --search: the number of processes; 0 is one per processor.
design --scheduler ADDRESS
    | With --search: work on the Dask cluster there; needs garkcli[cluster].
--front two
    | With --search: the front of two objectives, the best A for bounds on B, in place of methods.
--along NAME
    | With --search and --minimise: the optimum for values of an unknown, in place of methods.
--choose pairs | Like --set, and show the values that remain; repeatable.

--rows FILE written holds=jsonl = run_sweep.rows
    | The file of rows, a line of JSON each; by default SPEC with .jsonl.
--resume = run_sweep.is_resumed | Continue: add the missing rows.
sweep -j --jobs N 0..60 jobs = run_sweep.jobs
    | The number of processes; 0 is one per processor.
--top N 1.. default=10 | Show the N best; CSV and JSON lines have all.
--parquet FILE written holds=parquet
    | Write the kept methods as Parquet too; needs garkcli[parquet].

export --to TARGET target = export.target
    | The target; gark list exports shows them.
export --digits N 1..1000 = export.digits
--test
    | With -o: also write a program that runs the method in TARGET, and a problem file with
      which gark converge prints the same errors.
--from FORMAT name=source_format = import_methods.format
    | The format of SOURCE; by default gark goes by its name or content.
--recognise = import_methods.is_recognising
    | Replace decimals by exact numbers if the order does not fall.
--as-found = import_methods.is_as_found
    | Claim the true orders, not those that SOURCE declares.
audit -j --jobs N 0..60 jobs = audit.jobs
    | The number of processes; 0 is one per processor.
audit --strict | Fail if gark could not read a possible table.
--fix | Write a patch of what is sure instead: a wrong sign, digit or entry. It changes no file.
--claim PLACE written
    | Also write method files that claim what the sources declare: into a folder, or one into
      PLACE.gark.yaml.

report --order -n n 1..100 = report_page.order
--pictures/--no-pictures = report_page.pictures
schema --problem | The schema of problem files.
--sweep | The schema of spec files of gark sweep.
--project | The schema of .gark.toml.
--report [COMMAND] report alone=check = report_schema.command
    | The schema of the JSON report of COMMAND; by default gark check.
"""
"""One option per row: the command, if another one has an option of the same name; the flags; the
metavariable; the type (``options.KINDS``, a range, or words); ``=`` the argument in Python; ``|``
the help. Missing help and defaults are those of the argument, from its docstring and signature.
``alone=`` is the value of a flag without one, ``value=`` that of a flag for one of several words;
an empty ``default=`` is not shown.
"""
_COMMANDS = """
[Inspect]
checking: check [FILE...] | order and properties of methods; are their claims true?
    = check_file analyse find_order find_orders is_symplectic find_property simplifying
    --max-order --error-constants --properties --explain --baseline --require-claims --jobs
    --digits --set
looking_up: show FILE | one method: tableau, orders, properties, reference
    = load analyse catalogue
    --set
looking_up: report FILE... | methods as one HTML page
    = report_page
    --conjugate --pair --order --pictures --set
    only --format --output --quiet --color --help
looking_up: list [WHAT] [WORD...] | families, transfer rules, problems, methods of the catalogue
    = names catalogue
    --catalogue
looking_up: explain [WORD...] | the meaning of a word in a report or a file
    = explain
looking_up: cite FILE... | the publication of a method, as BibTeX
    = cite
[Analyse]
stability: stability FILE... | A-, L-, P-stability, intervals, SSP coefficient, exactly
    = find_stability two_springs
    --conjugate --pair --slow --fast --ratio --at --seconds --digits --plot --order-star --set
trees: conditions [FILE] | the order conditions, in general or of one method
    = all_conditions conditions elementary_weight
    --colours --order --only --coloured --conjugate --pair --failing --sort --digits --document
    --symplectic --kind --members --set
trees: trees [ORDER] | the trees of an order: list, count or draw them
    = trees count_trees parse_tree format_tree
    --colours --order --upto --root --colours-used --count --yes --tree --svg --document
    --symplectic --kind --members
running: modified FILE | the modified equation or Hamiltonian, and the effective order
    = backward_analysis modified_formula modified_run
    --order --conjugate --pair --equation --problem --seed --digits --document --set
running: converge FILE... | errors over step sizes: does the method show its order?
    = converge problem hamiltonian load_problem bind integrate
    --conjugate --pair --problem --omega --split --seed --stiffness --t-end --steps --work
    --against --jacobian --plot --set
running: energy FILE | does the energy drift over a long time?
    = long_run symplecticity_defects trajectory
    --conjugate --pair --problem --omega --split --seed --stiffness --t-end --step --digits
    --points --symplecticity --bounded --max-error --modified --plot --set
[Build]
new: new [PLACE] | a new method file, from a tableau or from families
    = from_arrays loads with_claims
    --tableau --family --transfer --name --force
    only --format --output --quiet --color --help
tableaux: tableau FILE | the whole tableau, block by block
    = load
    --conjugate --pair --digits --transformation --document --set
tableaux: conjugate FILE | the symplectic conjugate, or the symplectic pair
    = conjugate pair symplectic_pair
    --pair --digits --transformation --document --set
tableaux: convert FILE | the same method in another form, or with fewer stages
    = convert
    --to --stages --digits --recognise --set
tableaux: diff FIRST SECOND | how two methods differ, or that they are the same
    = compare
    --strict --set
[Search]
designing: design FILE | the parameter values that give a method an order
    = load_family find_parameters minimise search_methods found_methods stable_values
    --order --conjugate --pair --seconds --digits --emit --minimise --p-stable --i-stable
    --a-stable --l-stable --colour --slow --fast --up-to --search --front --along --seed --most
    --jobs --scheduler --output-dir --plot --set --choose
designing: sweep SPEC | many methods compared: which are best?
    = run_sweep
    --rows --resume --jobs --scheduler --top --parquet --plot --catalogue
[Exchange and CI]
exchange: import SOURCE... | methods from C, Python, MATLAB, Julia, LaTeX, JSON and others
    = import_methods
    --from --recognise --as-found --output-dir
exchange: export FILE | a method for SciPy, SUNDIALS, PETSc, C, JSON and others
    = export
    --conjugate --pair --to --digits --test --set
    only --output --help
exchange: audit PATH... | the tables in a source tree: are their declared orders true?
    = audit audit_patch
    --strict --fix --claim --jobs
claims: claims FILE... | the true claims of a method, for its file
    = claims_of with_claims
    --write --all --key
looking_up: certificate FILE | a proof of the orders, which a separate short script checks
    = certificate prove_method prove_method_exists
    --set
looking_up: schema | JSON Schemas of method files, problem files and reports
    = method_file_schema problem_file_schema sweep_schema project_schema report_schema
    --problem --sweep --project --report
    only --format --output --help
[hidden]
tableaux: reduce FILE | the smallest equivalent method: convert --to reduced
    = reduced
    --set
"""
"""A group, in brackets, before its commands; those of ``HIDDEN`` are former names that still work.
One command per paragraph: its file, its name, its arguments, ``|`` the summary, ``=`` the Python
functions, the options; ``only`` the common options if they are not all.
"""

RULES = """
tableau conjugate modified conditions trees: --document without --format=latex
    | --document goes with --format latex | add --format latex
report stability conditions modified converge energy tableau export design: --pair with --conjugate
    | --pair and --conjugate are two methods | ask for one
tableau conjugate: --transformation with --format=yaml
    | a method file has no place for the transformation | ask for another format
tableau conjugate: --transformation with --format=latex
    | LaTeX has no transformation | ask for another format
new: FILE with --output | FILE and -o at once | name one place
new: --tableau with --family | --tableau and --family at once | give one
trees: ORDER with --order | the order is given twice | give it once
trees conditions: --members with --format=latex
    | --members do not fit into a LaTeX table | choose another --format
trees conditions: --kind --members without --symplectic | OPTION is about free trees
    | add --symplectic
trees: --root --colours-used --tree with --symplectic | free trees have no root
    | leave out --root, --colours-used and --tree
trees: --count with --colours-used | --count knows no --colours-used | leave one of them out
conditions: --conjugate --pair without FILE
    | --conjugate or --pair: values are those of a method | give a FILE
conditions: --failing --digits --sort=worst without FILE
    | OPTION: values are those of a method | give a FILE
conditions: --colours --coloured with FILE
    | the colours are those of FILE | leave out --colours, --coloured, --shapes
conditions: --coloured with --symplectic
    | free trees have colours | leave out --coloured and --shapes
conditions: --set without FILE | --set is for the parameters of FILE | name a file
conditions: --kind with FILE | the kind is that of FILE | leave out --kind; --pair asks for the pair
convert: --digits --recognise without --to=recovered
    | OPTION goes with --to recovered | add --to recovered
convert: --stages with --to=reduced
    | --stages adds stages, --to reduced leaves some out | use one of them
design: --seed --most --jobs --scheduler --front --along without --search
    | OPTION goes with --search | add --search N
design: --along without --minimise
    | --along goes with --minimise | add --minimise WHAT
design: --front --along with --emit --output-dir --most
    | OPTION has no methods but optima in floats
    | --set an unknown and --minimise prove one of them
design: --format=csv without --front --along
    | CSV has a line a point of a curve | add --front or --along
design: --front with --minimise --along
    | --front names two objectives | leave --minimise and --along out
stability design: --slow without --fast | --slow and --fast belong together | give both
stability design: --fast without --slow | --slow and --fast belong together | give both
design: --up-to without --slow
    | --up-to is a bound for the fast one of two springs | give --slow and --fast too
design: --slow without --p-stable --i-stable
    | --slow and --fast say on which springs | add --p-stable
design: --slow with --order
    | two springs give a set of values, --order does not | ask for one
design: --colour without --a-stable --l-stable
    | --colour goes with --a-stable and --l-stable | add one of them
energy: --omega --split --stiffness --digits --symplecticity --bounded --max-error --plot
    with --modified | OPTION does not go with --modified | leave it out
modified: --seed without --problem | --seed is for the problem | give --problem too
stability: --ratio --at with --slow
    | OPTION does not go with --slow | leave one of them out
stability: --order-star without --plot --verbose
    | --order-star is for the picture | give -v or --plot FILE too
export: --test without --output
    | --test writes further files beside the first | name it: -o FILE
"""
"""One rule per row, in the order in which they are examined: the commands; the options; ``without``
those that they require or ``with`` those that they exclude; ``|`` the message; ``|`` the cure.
"""


def _paragraphs(table: str) -> Iterator[str]:
    """Yields rows together with their continuation lines."""
    yield from filter(None, re.sub(r"\n +", " ", table).splitlines())


def _option(row: str) -> Option:
    row, _, help = row.partition(" | ")
    row, _, of = row.partition(" = ")
    words = row.split()
    written = next(k for k, word in enumerate(words) if word.startswith("-"))
    while written < len(words) and words[written].startswith("-"):
        written += 1
    return Option(" ".join(words[:written]), tuple(words[written:]), of, " ".join(help.split()))


def _commands(table: str) -> Iterator[tuple[str, Command]]:
    """Yields the commands with their names."""
    group = ""
    for row in _paragraphs(table):
        if row.startswith("["):
            group = row.strip("[]")
            continue
        row, _, common = row.partition(" only ")
        head, _, rest = row.partition(" | ")
        summary, _, rest = rest.partition(" = ")
        calls, sign, rest = rest.partition(" --")
        file, _, usage = head.partition(": ")
        name, _, arguments = usage.partition(" ")
        options = sign.strip() + rest
        common = common or _COMMON
        yield name, Command(group, file, arguments, summary, calls.strip(), options, common)


OPTIONS = {row.key: row for row in map(_option, _paragraphs(_OPTIONS))}
"""All options, by their longest flags, with the command if it matters."""
COMMANDS = dict(_commands(_COMMANDS))
"""All commands, including former names."""
SHOWN = {name: row for name, row in COMMANDS.items() if row.group != HIDDEN}
"""The commands in the help, group by group."""


def option_of(command: str, flag: str) -> Option:
    """Returns the option for a flag of a command."""
    return OPTIONS.get(f"{command} {flag}") or OPTIONS[flag]


def options_of(command: str) -> Iterator[Option]:
    """Yields the options of a command: its own, then the common ones."""
    row = COMMANDS[command]
    for flag in (*row.options.split(), *row.common.split()):
        if flag != "--help":
            yield option_of(command, flag)


def rules_of(command: str) -> list[OptionRule]:
    """Returns the rules about the options of a command."""
    found = []
    for row in _paragraphs(RULES):
        head, message, cure = row.split(" | ")
        commands, _, options = head.partition(": ")
        if command in commands.split():
            words = options.split()
            sign = next(x for x in ("with", "without") if x in words)
            place = words.index(sign)
            given, others = tuple(words[:place]), tuple(words[place + 1 :])
            found.append(OptionRule(given, sign == "without", others, message, cure))
    return found
