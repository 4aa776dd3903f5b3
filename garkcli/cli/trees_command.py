"""``gark trees``."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import click

from garkcli.cli.options import CONTEXT, Output, common
from garkcli.errors import UsageProblem

if TYPE_CHECKING:
    from garkcli.report.trees import Query, TreeRow

MAX_PICTURES = 2000
"""Most trees on one sheet of pictures."""


@click.command("trees", context_settings=CONTEXT)
@click.option(
    "--colours",
    "-N",
    type=click.IntRange(1, 1000),
    default=1,
    show_default=True,
    metavar="N",
    help="How many colours.",
)
@click.option("--order", "-n", type=click.IntRange(1, 10000), metavar="n", help="The number of vertices.")
@click.option("--upto", is_flag=True, help="Every order from 1 to n.")
@click.option("--root", type=click.IntRange(1), metavar="L", help="Only trees whose root has colour L.")
@click.option("--colours-used", metavar="L,M,...", help="Only trees in which each of these colours occurs.")
@click.option("--count", is_flag=True, help="Count without generating, for any order.")
@click.option("--tree", "one", metavar="TEXT", help="One tree, such as [[]_2,[]_1]_1, instead of an order.")
@click.option("--svg", metavar="FILE", help="Draw a sheet of all the trees into FILE.")
@click.option("--document", is_flag=True, help="With --format latex: a document that compiles as it stands.")
@common(["text", "json", "ndjson", "csv", "latex"])
def command(
    colours: int,
    order: int | None,
    upto: bool,
    root: int | None,
    colours_used: str | None,
    count: bool,
    svg: str | None,
    one: str | None,
    document: bool,
    output: Output,
) -> int:
    """Enumerate the N-trees of an order, by root colour, with order, symmetry and density.

    A tree is its root's colour after its bracketed branches: []_1 is a single vertex of colour 1.
    """
    from garkcli.report import trees as report
    from garkcli.report.progress import tracked

    used = _colours(colours_used, colours)
    if root is not None and root > colours:
        raise UsageProblem(f"there is no colour {root}", f"--colours {colours} numbers them from 1")
    if one is not None:
        return _single(one, svg, document, output)
    if order is None:
        raise UsageProblem("which order?", "give --order n, or --tree for one tree")
    orders = range(1, order + 1) if upto else range(order, order + 1)
    query = report.Query(colours, order, upto, root, used)
    if count:
        if used:
            raise UsageProblem("--count knows no --colours-used", "leave one of them out")
        output.write(report.render_counts(query, _counts(query), output.format, output.paint))
        return 0
    if svg is not None:
        _draw(svg, query, orders)
        output.note(f"wrote {svg}")
        return 0
    totals = _totals(query)
    count_all = None if totals is None else sum(map(sum, (report.kept(query, by_root) for _, by_root in totals)))
    rows = tracked(_rows(query, orders), count_all, "trees", output.may_show_progress)
    output.write(report.render(query, rows, totals, output.format, output.paint, document))
    return 0


def _single(text: str, svg: str | None, document: bool, output: Output) -> int:
    """One tree, given in bracket text."""
    from garkcli.cli.options import write_whole
    from garkcli.report import trees as report
    from garkcli.trees.drawing import draw_svg_sheet
    from garkcli.trees.notation import NotationError, format_tree, parse_tree

    try:
        tree = parse_tree(text)
    except NotationError as error:
        raise UsageProblem(f"--tree, column {error.offset + 1}: {error.message}", error.help) from None
    colours = 1 + max(tree.colours)
    written = format_tree(tree, colours > 1)
    if svg is not None:
        write_whole(svg, [draw_svg_sheet([tree], [written])])
        output.note(f"wrote {svg}")
        return 0
    row = report.TreeRow(written, tree.root, tree.order, tree.symmetry, tree.density)
    counts = [(tree.order, tuple(int(l == tree.root) for l in range(colours)))]
    query = report.Query(colours, tree.order, False, tree.root + 1)
    output.write(report.render(query, [row], counts, output.format, output.paint, document))
    return 0


def _colours(text: str | None, colours: int) -> tuple[int, ...]:
    if text is None:
        return ()
    words = [word.strip() for word in text.split(",")]
    if not all(word.isascii() and word.isdigit() and 1 <= int(word[:6]) <= colours for word in words):
        raise UsageProblem(f"--colours-used {text}: colours are numbers from 1 to {colours}", "write 1,2")
    return tuple(sorted({int(word) - 1 for word in words}))


def _counts(query: Query) -> list[tuple[int, tuple[int, ...]]]:
    """For each order the number of trees by root colour."""
    from garkcli.trees.count import count_by_root

    first = 1 if query.upto else query.order
    return [(n, count_by_root(query.colours, n)) for n in range(first, query.order + 1)]


def _totals(query: Query) -> list[tuple[int, tuple[int, ...]]] | None:
    return None if query.used else _counts(query)


def _rows(query: Query, orders: range) -> Iterator[TreeRow]:
    from garkcli.report.trees import TreeRow
    from garkcli.trees.blocks import select

    for n in orders:
        root = None if query.root is None else query.root - 1
        for block in select(query.colours, n, root=root, using=query.used, block_size=1 << 14):
            columns = block.columns
            yield from map(
                TreeRow,
                block.notation(colours=query.colours > 1),
                columns.root.tolist(),
                [n] * len(block),
                columns.sigma.tolist(),
                columns.gamma.tolist(),
            )


def _draw(path: str, query: Query, orders: range) -> None:
    from itertools import islice

    from garkcli.cli.options import write_whole
    from garkcli.trees.drawing import draw_svg_sheet
    from garkcli.trees.notation import parse_tree

    rows = list(islice(_rows(query, orders), MAX_PICTURES + 1))
    if len(rows) > MAX_PICTURES:
        raise UsageProblem(f"more than {MAX_PICTURES} trees do not fit on a sheet", "draw one order or one root")
    trees = [parse_tree(row.tree) for row in rows]
    write_whole(path, [draw_svg_sheet(trees, [row.tree for row in rows])])
