"""``gark trees``."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any, TypeVar, cast

import click

from garkcli.cli.options import CONTEXT, PATH, Output, common
from garkcli.cli.streams import is_terminal, say
from garkcli.errors import UsageProblem
from garkcli.trees.symplectic import KINDS, Kind

if TYPE_CHECKING:
    from garkcli.report.trees import Query, TreeRow
    from garkcli.trees.tree import Tree

F = TypeVar("F", bound=Callable[..., Any])
MANY = 1_000_000
"""So many lines are asked for twice."""
MAX_PICTURES = 2000
"""Most trees on one sheet of pictures."""


def symplectic_options(function: F) -> F:
    """``--symplectic``, ``--kind`` and ``--members``."""
    options = [
        click.option(
            "--symplectic",
            is_flag=True,
            help="Independent conditions of symplectic methods: free trees.",
        ),
        click.option(
            "--kind",
            type=click.Choice(KINDS),
            help="With --symplectic: which methods, the pair (A, Â) unless given.",
        ),
        click.option(
            "--members",
            is_flag=True,
            help="With --symplectic: all rooted trees of each free tree.",
        ),
    ]
    for option in reversed(options):
        function = option(function)
    return function


def kind_asked(
    symplectic: bool, kind: str | None, members: bool, format: str
) -> Kind | None:
    """The kind of symplectic methods; None where all trees are meant.

    Raises:
        UsageProblem: options of ``--symplectic`` without it, or members in a LaTeX table.
    """
    if members and format == "latex":
        raise UsageProblem(
            "--members do not fit into a LaTeX table", "choose another --format"
        )
    if symplectic:
        return cast("Kind", kind or "pair")
    if kind is not None or members:
        raise UsageProblem(
            f"{'--members' if kind is None else '--kind'} is about free trees",
            "add --symplectic",
        )
    return None


@click.command("trees", context_settings=CONTEXT)
@click.option(
    "--colours",
    "-N",
    type=click.IntRange(1, 1000),
    metavar="N",
    help="How many colours, 1 unless given; with --symplectic, terms of the split.",
)
@click.option(
    "--order",
    "-n",
    type=click.IntRange(1, 10000),
    metavar="n",
    help="The number of vertices.",
)
@click.option("--upto", is_flag=True, help="Every order from 1 to n.")
@click.option(
    "--root",
    type=click.IntRange(1),
    metavar="L",
    help="Only trees whose root has colour L.",
)
@click.option(
    "--colours-used",
    metavar="L,M,...",
    help="Only trees in which each of these colours occurs.",
)
@click.option("--count", is_flag=True, help="Count without generating, for any order.")
@click.option("--yes", is_flag=True, help="List them also where they are millions.")
@click.option(
    "--tree",
    "one",
    metavar="TEXT",
    help="One tree, such as [[]_2,[]_1]_1, instead of an order.",
)
@click.option(
    "--svg", type=PATH, metavar="FILE", help="Draw a sheet of all the trees into FILE."
)
@click.option(
    "--document",
    is_flag=True,
    help="With --format latex: a document that compiles as it stands.",
)
@symplectic_options
@common(["text", "json", "ndjson", "csv", "latex"])
def command(
    colours: int | None,
    order: int | None,
    upto: bool,
    root: int | None,
    colours_used: str | None,
    count: bool,
    yes: bool,
    svg: str | None,
    one: str | None,
    document: bool,
    symplectic: bool,
    kind: str | None,
    members: bool,
    output: Output,
) -> int:
    """Enumerate the N-trees of an order, by root colour, with order, symmetry and density.

    A tree is its root's colour after its bracketed branches: []_1 is a single vertex of colour 1.
    With
    --symplectic the rooted trees that differ in the place of their root are one row: their
    conditions are equivalent for symplectic methods.
    """
    from garkcli.report import trees as report

    asked = kind_asked(symplectic, kind, members, output.format)
    if asked is not None:
        if root is not None or colours_used is not None or one is not None:
            raise UsageProblem(
                "free trees have no root", "leave out --root, --colours-used and --tree"
            )
        return _free_trees(
            asked,
            colours,
            _orders(order, upto),
            count,
            yes,
            members,
            svg,
            document,
            output,
        )
    colours = colours or 1
    used = _colours(colours_used, colours)
    if root is not None and root > colours:
        raise UsageProblem(
            f"there is no colour {root}", f"--colours {colours} numbers them from 1"
        )
    if one is not None:
        return _single(one, svg, document, output)
    orders = _orders(order, upto)
    query = report.Query(colours, orders[-1], upto, root, used)
    if count:
        if used:
            raise UsageProblem(
                "--count knows no --colours-used", "leave one of them out"
            )
        with _any_digits():
            output.write(
                report.render_counts(query, _counts(query), output.format, output.paint)
            )
        return 0
    if svg is not None:
        from garkcli.trees.notation import parse_tree

        _draw(svg, (parse_tree(row.tree) for row in _rows(query, orders)), colours > 1)
        output.note(f"wrote {svg}")
        return 0
    _list(query, orders, yes, document, output)
    return 0


def _orders(order: int | None, upto: bool) -> range:
    if order is None:
        raise UsageProblem("which order?", "give --order n, or --tree for one tree")
    return range(1, order + 1) if upto else range(order, order + 1)


def _list(
    query: Query, orders: range, yes: bool, document: bool, output: Output
) -> None:
    """A row for each tree."""
    from garkcli.report import trees as report
    from garkcli.report.progress import tracked

    totals = _totals(query)
    count_all = (
        None
        if totals is None
        else sum(map(sum, (report.kept(query, by_root) for _, by_root in totals)))
    )
    _refuse_millions(count_all, yes)
    rows = tracked(_rows(query, orders), count_all, "trees", output.may_show_progress)
    output.write(
        report.render(query, rows, totals, output.format, output.paint, document)
    )


def _refuse_millions(lines: int | None, yes: bool) -> None:
    """Ask on a terminal whether so many lines are meant, and refuse them without one.

    Raises:
        UsageProblem: they are not meant, or nobody was asked.
    """
    if yes or lines is None or lines <= MANY:
        return
    if is_terminal(sys.stdin) and is_terminal(sys.stderr):
        say(f"{lines} trees: list them all? [y/N]")
        if sys.stdin.readline().strip().lower() in {"y", "yes"}:
            return
    raise UsageProblem(f"{lines} trees", "--yes lists them, --count counts them")


def _free_trees(
    kind: Kind,
    terms: int | None,
    orders: range,
    count: bool,
    yes: bool,
    members: bool,
    svg: str | None,
    document: bool,
    output: Output,
) -> int:
    """A row for each class of equivalent conditions of symplectic methods."""
    from garkcli.report import symplectic as report
    from garkcli.report.progress import tracked

    subject = report.subject_of_kind(kind, terms, orders)
    if count:
        with _any_digits():
            output.write(
                report.render_class_counts(subject, output.format, output.paint)
            )
    elif svg is not None:
        trees = (found.representative for found in subject.classes())
        _draw(svg, trees, subject.has_colours)
        output.note(f"wrote {svg}")
    else:
        _refuse_millions(subject.independent, yes)
        classes = tracked(
            subject.classes(), subject.independent, "trees", output.may_show_progress
        )
        pieces = report.render_classes(
            subject, classes, output.format, output.paint, members, document
        )
        output.write(pieces)
    return 0


def _single(text: str, svg: str | None, document: bool, output: Output) -> int:
    """One tree, given in bracket text."""
    from garkcli.report import trees as report
    from garkcli.report.writing import write_whole
    from garkcli.trees.drawing import draw_svg_sheet
    from garkcli.trees.notation import NotationError, format_tree, parse_tree

    try:
        tree = parse_tree(text)
    except NotationError as error:
        raise UsageProblem(
            f"--tree, column {error.offset + 1}: {error.message}", error.help
        ) from None
    colours = 1 + max(tree.colours)
    written = format_tree(tree, colours > 1)
    if svg is not None:
        write_whole(svg, [draw_svg_sheet([tree], [written])])
        output.note(f"wrote {svg}")
        return 0
    row = report.TreeRow(written, tree.root, tree.order, tree.symmetry, tree.density)
    counts = [(tree.order, tuple(int(l == tree.root) for l in range(colours)))]
    query = report.Query(colours, tree.order, False, tree.root + 1)
    output.write(
        report.render(query, [row], counts, output.format, output.paint, document)
    )
    return 0


@contextmanager
def _any_digits() -> Iterator[None]:
    """Whole numbers are written with any number of digits: Python's limit is for texts from
    strangers.
    """
    limit = sys.get_int_max_str_digits()
    sys.set_int_max_str_digits(0)
    try:
        yield
    finally:
        sys.set_int_max_str_digits(limit)


def _colours(text: str | None, colours: int) -> tuple[int, ...]:
    if text is None:
        return ()
    words = [word.strip() for word in text.split(",")]
    if not all(
        word.isascii() and word.isdigit() and 1 <= int(word[:6]) <= colours
        for word in words
    ):
        raise UsageProblem(
            f"--colours-used {text}: colours are numbers from 1 to {colours}",
            "write 1,2",
        )
    return tuple(sorted({int(word) - 1 for word in words}))


def _counts(query: Query) -> list[tuple[int, tuple[int, ...]]]:
    """For each order the number of trees by root colour."""
    from garkcli.trees.count import Admissible, count_by_root, counts_upto

    if not query.upto:
        return [(query.order, count_by_root(query.colours, query.order))]
    return [*enumerate(counts_upto(Admissible.of(query.colours), query.order), start=1)]


def _totals(query: Query) -> list[tuple[int, tuple[int, ...]]] | None:
    return None if query.used else _counts(query)


def _rows(query: Query, orders: range) -> Iterator[TreeRow]:
    from garkcli.report.trees import TreeRow
    from garkcli.trees.blocks import select

    for n in orders:
        root = None if query.root is None else query.root - 1
        for block in select(
            query.colours, n, root=root, using=query.used, block_size=1 << 14
        ):
            columns = block.columns
            yield from map(
                TreeRow,
                block.notation(colours=query.colours > 1),
                columns.root.tolist(),
                [n] * len(block),
                columns.sigma.tolist(),
                columns.gamma.tolist(),
            )


def _draw(path: str, listed: Iterable[Tree], coloured: bool) -> None:
    from itertools import islice

    from garkcli.report.writing import write_whole
    from garkcli.trees.drawing import draw_svg_sheet
    from garkcli.trees.notation import format_tree

    trees = list(islice(listed, MAX_PICTURES + 1))
    if len(trees) > MAX_PICTURES:
        raise UsageProblem(
            f"more than {MAX_PICTURES} trees do not fit on a sheet",
            "draw one order or one root",
        )
    write_whole(
        path, [draw_svg_sheet(trees, [format_tree(tree, coloured) for tree in trees])]
    )
