"""``gark trees`` and ``gark conditions``."""

from __future__ import annotations

import sys
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from itertools import islice, tee
from typing import TYPE_CHECKING, Literal

from garkcli.cli import options as opt
from garkcli.cli.command import declared
from garkcli.cli.output import Output
from garkcli.cli.streams import say
from garkcli.doing import counting, hush
from garkcli.errors import HasFreeParameters, UsageProblem
from garkcli.frozen import replace
from garkcli.terminal import is_terminal

if TYPE_CHECKING:
    from garkcli.ntrees.symplectic import Kind as Symplectic
    from garkcli.ntrees.tree import Tree
    from garkcli.order.conditions import Condition
    from garkcli.report.conditions import ConditionRow, Valued
    from garkcli.report.trees import Query, SymplecticSubject, TreeRow

MANY = 1_000_000
"""Most lines for which the command does not ask."""
MAX_PICTURES = 2000
BLOCK_SIZE = 1 << 14


COLOURS = opt.option(
    "--colours -N",
    opt.hidden_default(opt.number("N", 1, 1000)),
    "The number of colours; with --symplectic, of terms of the split.",
    of="trees.colours",
)
SYMPLECTIC = opt.flag(
    "--symplectic",
    "Independent conditions of symplectic methods: free trees.",
    heading="Symplectic methods",
)
KIND: Symplectic | None = opt.option(
    "--kind",
    opt.words_of("ntrees.symplectic:KINDS"),
    "With --symplectic: which methods, the pair (A, Â) unless given.",
)
MEMBERS = opt.flag("--members", "With --symplectic: all rooted trees of each free tree.")
RULES = (
    opt.excludes(
        MEMBERS,
        opt.being(opt.FORMAT, "latex"),
        "--members do not fit into a LaTeX table",
        "choose another --format",
    ),
    opt.needs((KIND, MEMBERS), SYMPLECTIC, "OPTION is about free trees", "add --symplectic"),
)


class TreesOptions(opt.Options):
    order_asked: int | None = opt.maybe_argument("ORDER", opt.number("n", 1, 10_000))
    order: int | None = opt.option(
        "--order -n", opt.number("n", 1, 10_000), of="trees.order", heading="Trees"
    )
    upto: bool = opt.flag("--upto", "Every order from 1 to n.")
    colours: int | None = COLOURS
    root: int | None = opt.option(
        "--root", opt.number("L", 1), "Only trees whose root has colour L."
    )
    colours_used: str | None = opt.option(
        "--colours-used", opt.text("L,M,..."), "Only trees in which each of these colours occurs."
    )
    tree: str | None = opt.option(
        "--tree",
        opt.text("TEXT"),
        "One tree, such as [[]_2,[]_1]_1, instead of an order.",
        of="parse_tree.text",
    )
    symplectic: bool = SYMPLECTIC
    kind: Symplectic | None = KIND
    members: bool = MEMBERS
    count: bool = opt.flag("--count", "Count without generating, for any order.", heading="Report")
    yes: bool = opt.flag("--yes", "List the trees even if there are millions.")
    svg: str | None = opt.option(
        "--svg", opt.file("svg"), "Draw a sheet of all the trees into FILE."
    )
    document: bool = opt.DOCUMENT
    rules = (
        opt.DOCUMENT_RULE,
        opt.excludes(order_asked, order, "the order is given twice", "give it once"),
        *RULES,
        opt.excludes(
            (root, colours_used, tree),
            SYMPLECTIC,
            "free trees have no root",
            "leave out --root, --colours-used and --tree",
        ),
        opt.excludes(
            count, colours_used, "--count knows no --colours-used", "leave one of them out"
        ),
    )


@declared("trees", TreesOptions, ["text", "json", "ndjson", "csv", "markdown", "latex"])
def trees(given: TreesOptions, output: Output) -> None:
    """The N-trees of an order, by root colour, with order, symmetry and density.

    [[]_2]_1 is a root of colour 1 with a leaf of colour 2. With --symplectic one row stands for all
    rooted trees that differ in the place of their root only: symplectic methods have equivalent
    conditions for them.
    """
    order = given.order or given.order_asked
    if given.symplectic:
        _free_trees(given, order, output)
        return
    from garkcli.ntrees.notation import parse_tree
    from garkcli.report import trees as report

    colours = given.colours or 1
    used = _colours(given.colours_used, colours)
    if given.root is not None and given.root > colours:
        message = f"there is no colour {given.root}"
        raise UsageProblem(message, f"--colours {colours} numbers them from 1", code="no-such-tree")
    if given.tree is not None:
        _single(given.tree, given, output)
        return
    orders = _orders(order, given.upto)
    query = report.Query(colours, orders[-1], given.upto, given.root, used)
    if given.count:
        with _any_digits():
            output.stream(report.REPORT, report.TreeList(query, None, counts_of(query)))
    elif given.svg is not None:
        listed = (parse_tree(row.tree) for row in rows_of(query, orders))
        _draw_sheet(given.svg, listed, colours > 1, output)
    else:
        totals = None if used else counts_of(query)
        lines = sum(query.total(by_root) for _, by_root in totals) if totals is not None else None
        _refuse_millions(lines, given.yes)
        rows = counting("trees", rows_of(query, orders), lines)
        output.stream(report.REPORT, report.TreeList(query, rows, totals), given.document)


def _orders(order: int | None, upto: bool) -> range:
    if order is None:
        raise UsageProblem(
            "which order?", "gark trees 4 lists order 4; --tree shows one tree", code="option-alone"
        )
    return range(1 if upto else order, order + 1)


def counts_of(query: Query) -> list[tuple[int, tuple[int, ...]]]:
    from garkcli.ntrees.count import Admissible, count_by_root, counts_upto

    if not query.upto:
        return [(query.order, count_by_root(query.colours, query.order))]
    return list(enumerate(counts_upto(Admissible.of(query.colours), query.order), start=1))


def rows_of(query: Query, orders: Iterable[int]) -> Iterator[TreeRow]:
    from garkcli.ntrees.blocks import select
    from garkcli.report.trees import TreeRow

    root = None if query.root is None else query.root - 1
    colours, used = query.colours, query.used
    for n in orders:
        for block in select(colours, n, root=root, using=used, block_size=BLOCK_SIZE):
            columns = block.columns
            yield from map(
                TreeRow,
                block.notation(colours=colours > 1),
                columns.root.tolist(),
                [n] * len(block),
                columns.sigma.tolist(),
                columns.gamma.tolist(),
            )


def _draw_sheet(path: str, listed: Iterable[Tree], has_colours: bool, output: Output) -> None:
    """UsageProblem if there are too many trees for a sheet."""
    from garkcli.ntrees.drawing import draw_svg_sheet
    from garkcli.ntrees.notation import format_tree

    drawn = list(islice(listed, MAX_PICTURES + 1))
    if len(drawn) > MAX_PICTURES:
        message = f"more than {MAX_PICTURES} trees do not fit on a sheet"
        raise UsageProblem(message, "draw one order or one root", code="too-many")
    output.save(path, [draw_svg_sheet(drawn, [format_tree(tree, has_colours) for tree in drawn])])


def _refuse_millions(lines: int | None, yes: bool) -> None:
    """Asks on a terminal whether so many lines are wanted; UsageProblem if not, or without one."""
    if yes or lines is None or lines <= MANY:
        return
    if is_terminal(sys.stdin) and is_terminal(sys.stderr):
        say(f"{lines} trees: list them all? [y/N]")
        hush()
        if sys.stdin.readline().strip().lower() in {"y", "yes"}:
            return
    message = f"{lines} trees"
    raise UsageProblem(message, "--yes lists them, --count counts them", code="option-value")


def _free_trees(given: TreesOptions, order: int | None, output: Output) -> None:
    from garkcli.report import trees as report

    subject = report.subject_of_kind(
        given.kind or "pair", given.colours, _orders(order, given.upto)
    )
    if given.count:
        with _any_digits():
            output.stream(report.FREE_TREES, report.FreeList(subject, None))
    elif given.svg is not None:
        listed = (found.representative for found in subject.classes())
        _draw_sheet(given.svg, listed, subject.has_colours, output)
    else:
        lines = subject.independent
        _refuse_millions(lines, given.yes)
        found = report.FreeList(subject, counting("trees", subject.classes(), lines), given.members)
        output.stream(report.FREE_TREES, found, given.document)


def _single(text: str, given: TreesOptions, output: Output) -> None:
    from garkcli.ntrees.notation import NotationError, format_tree, parse_tree
    from garkcli.report import trees as report

    try:
        tree = parse_tree(text)
    except NotationError as error:
        message = f"--tree, column {error.offset + 1}: {error.message}"
        raise UsageProblem(message, error.help, code="no-such-tree") from None
    colours = 1 + max(tree.colours)
    if given.svg is not None:
        _draw_sheet(given.svg, [tree], colours > 1, output)
        return
    written = format_tree(tree, colours > 1)
    row = report.TreeRow(written, tree.root, tree.order, tree.symmetry, tree.density)
    counts = [(tree.order, tuple(int(l == tree.root) for l in range(colours)))]
    query = report.Query(colours, tree.order, False, tree.root + 1)
    output.stream(report.REPORT, report.TreeList(query, [row], counts), given.document)


@contextmanager
def _any_digits() -> Iterator[None]:
    """Lifts Python's limit on the digits of integers, which is for untrusted texts."""
    limit = sys.get_int_max_str_digits()
    sys.set_int_max_str_digits(0)
    try:
        yield
    finally:
        sys.set_int_max_str_digits(limit)


def _colours(text: str | None, colours: int) -> tuple[int, ...]:
    if text is None:
        return ()
    used = set()
    for word in text.split(","):
        number = word.strip()
        is_number = number.isascii() and number.isdigit()
        if not is_number or not 1 <= int(number[:6]) <= colours:
            wanted = f"colours are numbers from 1 to {colours}"
            cure = "write 1,2" if colours > 1 else "--colours 2 gives a second one"
            raise UsageProblem(f"--colours-used {text}: {wanted}", cure, code="option-value")
        used.add(int(number) - 1)
    return tuple(sorted(used))


class ConditionsOptions(opt.Derivable):
    file: str | None = opt.maybe_argument("FILE", opt.METHOD)
    order: int = opt.preset(
        "--order -n",
        opt.number("n", 1, 100),
        4,
        "Every order up to n.",
        of="all_conditions.order",
        heading="Conditions",
    )
    only: bool = opt.flag("--only", "Order n alone.")
    colours: int | None = COLOURS
    coloured: bool | None = opt.switch(
        "--coloured/--shapes", "A row per colouring, or one row for all (without FILE)."
    )
    failing: bool = opt.flag("--failing", "Only conditions that FILE does not meet.")
    sort: Literal["tree", "worst"] = opt.preset(
        "--sort",
        opt.words("tree", "worst"),
        "tree",
        "Order of the rows; worst: the largest residual first.",
    )
    symplectic: bool = SYMPLECTIC
    kind: Symplectic | None = KIND
    members: bool = MEMBERS
    digits: int | None = opt.DIGITS
    document: bool = opt.DOCUMENT
    rules = (
        opt.DOCUMENT_RULE,
        *RULES,
        opt.needs(
            (opt.CONJUGATE, opt.PAIR),
            file,
            "--conjugate or --pair: values are those of a method",
            "give a FILE",
        ),
        opt.needs(
            (failing, digits, opt.being(sort, "worst")),
            file,
            "OPTION: values are those of a method",
            "give a FILE",
        ),
        opt.excludes(
            (colours, coloured),
            file,
            "the colours are those of FILE",
            "leave out --colours, --coloured, --shapes",
        ),
        opt.excludes(
            coloured, SYMPLECTIC, "free trees have colours", "leave out --coloured and --shapes"
        ),
        opt.needs(opt.SET, file, "--set is for the parameters of FILE", "name a file"),
        opt.excludes(
            kind, file, "the kind is that of FILE", "leave out --kind; --pair asks for the pair"
        ),
    )


@declared("conditions", ConditionsOptions, ["text", "json", "csv", "markdown", "latex"])
def conditions(given: ConditionsOptions, output: Output) -> None:
    """The order-condition table.

    Without FILE the conditions for every method: a row for each tree shape and all colours (text
    and latex), or for each coloured tree (json and csv). With FILE each condition of that method
    with its exact value, the required value and the residual, identical ones once; rational
    functions if parameters are free.

    With --symplectic one condition of each class that is equivalent for symplectic methods; with
    FILE for its symplectic pair, unless it is symplectic itself.
    """
    from garkcli.order.conditions import all_conditions
    from garkcli.order.meant import printed
    from garkcli.report.conditions import REPORT, ConditionRow, ConditionTable

    valued = None if given.file is None else _valued(given.file, given)
    last = given.order
    exact_to = None if valued is None else printed(valued.method).exact_to
    if exact_to is not None and exact_to < last:
        last = exact_to
        output.note(f"{given.file}: its conditions are known up to order {last}")
    orders = range(last if given.only else 1, last + 1)
    subject = None
    colours = 0
    if given.symplectic:
        subject = _subject(given, orders, valued)
        if valued is not None and subject.method is not None:
            valued = replace(valued, method=subject.method)
        rows = _independent(subject, given.members, valued)
    elif valued is not None:
        met = (x for n in orders for x in all_conditions(valued.method, n))
        rows = (ConditionRow(x.tree, False, x) for x in met)
    else:
        # 0 colours: each row is for all colourings of a shape
        coloured = given.coloured
        if coloured is None:
            coloured = output.format in {"json", "csv"} and given.colours is not None
        colours = (given.colours or 1) if coloured else 0
        rows = _table(colours, orders)
    if given.sort == "worst":
        rows = iter(sorted(rows, key=_badness, reverse=True))
    rows = counting("conditions", rows)
    found = ConditionTable(rows, colours, subject, valued, given.members, given.digits)
    output.stream(REPORT, found, given.document)


def _valued(file: str, given: ConditionsOptions) -> Valued:
    from garkcli.methodfile.load import load
    from garkcli.order.meant import as_meant, derived
    from garkcli.report.conditions import Valued

    which = given.which or ""
    parameters: tuple[str, ...] = ()
    try:
        known_as = as_meant(load(file, given.settings))
    except HasFreeParameters as error:
        from garkcli.cli.tableaux import read_family

        needs = {"--digits": given.digits, "--sort worst": given.sort == "worst"}
        _, family = read_family(error, given.settings, needs)
        known_as, parameters = family.tableau, family.family.parameters
    return Valued(derived(known_as, which), given.failing, parameters, which)


def _subject(given: ConditionsOptions, orders: range, valued: Valued | None) -> SymplecticSubject:
    from garkcli.report.trees import subject_of_kind, subject_of_method

    if valued is None:
        return subject_of_kind(given.kind or "pair", given.colours, orders)
    return subject_of_method(valued.method, orders)


def _independent(
    subject: SymplecticSubject, members: bool, valued: Valued | None
) -> Iterator[ConditionRow]:
    from garkcli.order.conditions import conditions
    from garkcli.report.conditions import ConditionRow

    classes, again = tee(subject.classes())
    listed = (found.representative for found in again)
    values: Iterator[tuple[Tree, Condition | None]] = ((tree, None) for tree in listed)
    if valued is not None:
        values = ((x.tree, x) for x in conditions(valued.method, listed))
    for found, (tree, condition) in zip(classes, values, strict=True):
        shown = found.members if members else ()
        yield ConditionRow(tree, False, condition, stands_for=len(found.members), members=shown)


def _table(colours: int, orders: range) -> Iterator[ConditionRow]:
    from garkcli.ntrees.count import Admissible
    from garkcli.ntrees.listing import trees_of
    from garkcli.report.conditions import ConditionRow

    admissible = Admissible.of(colours or 1)
    for n in orders:
        for tree in trees_of(admissible, n):
            yield ConditionRow(tree, is_shape=not colours)


def _badness(row: ConditionRow) -> float:
    from garkcli.exact.display import to_float

    return 0.0 if row.condition is None else abs(to_float(row.condition.residual))
