"""The trees that are asked for: their numbers, their rows, a sheet of pictures."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from itertools import islice
from typing import TYPE_CHECKING, cast

from garkcli.errors import UsageProblem

if TYPE_CHECKING:
    from garkcli.cli.options import Output
    from garkcli.report.trees import Query, TreeRow
    from garkcli.trees.symplectic import Kind
    from garkcli.trees.tree import Tree

MAX_PICTURES = 2000
"""Most trees on one sheet of pictures."""
BLOCK_SIZE = 1 << 14
"""So many trees are made at a time."""


def counts_of(query: Query) -> list[tuple[int, tuple[int, ...]]]:
    """For each order the number of trees by root colour."""
    from garkcli.trees.count import Admissible, count_by_root, counts_upto

    if not query.upto:
        return [(query.order, count_by_root(query.colours, query.order))]
    admissible = Admissible.of(query.colours)
    return list(enumerate(counts_upto(admissible, query.order), start=1))


def rows_of(query: Query, orders: Iterable[int]) -> Iterator[TreeRow]:
    """A row for each tree of these orders."""
    from garkcli.report.trees import TreeRow
    from garkcli.trees.blocks import select

    root = None if query.root is None else query.root - 1
    colours, used = query.colours, query.used
    for n in orders:
        blocks = select(colours, n, root=root, using=used, block_size=BLOCK_SIZE)
        for block in blocks:
            columns = block.columns
            yield from map(
                TreeRow,
                block.notation(colours=colours > 1),
                columns.root.tolist(),
                [n] * len(block),
                columns.sigma.tolist(),
                columns.gamma.tolist(),
            )


def draw_sheet(path: str, listed: Iterable[Tree], has_colours: bool, output: Output) -> None:
    """Draw trees into a file, and say so.

    Raises:
        UsageProblem: they are too many for a sheet.
    """
    from garkcli.page.writing import write_whole
    from garkcli.trees.drawing import draw_svg_sheet
    from garkcli.trees.notation import format_tree

    trees = list(islice(listed, MAX_PICTURES + 1))
    if len(trees) > MAX_PICTURES:
        message = f"more than {MAX_PICTURES} trees do not fit on a sheet"
        raise UsageProblem(message, "draw one order or one root", code="too-many")
    labels = [format_tree(tree, has_colours) for tree in trees]
    write_whole(path, [draw_svg_sheet(trees, labels)])
    output.note(f"wrote {path}")


def kind_asked(symplectic: bool, kind: str | None, members: bool, format: str) -> Kind | None:
    """The kind of symplectic methods; None where all trees are meant.

    Raises:
        UsageProblem: options of ``--symplectic`` without it, or members in a LaTeX table.
    """
    if members and format == "latex":
        message = "--members do not fit into a LaTeX table"
        raise UsageProblem(message, "choose another --format", code="options-clash")
    if symplectic:
        return cast("Kind", kind or "pair")
    if kind is not None or members:
        option = "--members" if kind is None else "--kind"
        raise UsageProblem(f"{option} is about free trees", "add --symplectic", code="option-alone")
    return None
