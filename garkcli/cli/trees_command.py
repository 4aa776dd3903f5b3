"""``gark trees``."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from garkcli.cli.options import Output, declared
from garkcli.cli.streams import is_terminal, say
from garkcli.cli.tree_lists import counts_of, draw_sheet, kind_asked, rows_of
from garkcli.doing import counting, hush
from garkcli.errors import UsageProblem

if TYPE_CHECKING:
    from garkcli.report.trees import Query
    from garkcli.trees.symplectic import Kind

MANY = 1_000_000
"""So many lines are asked for twice."""


@declared("trees", ["text", "json", "ndjson", "csv", "latex"])
def command(output: Output, **options: Any) -> int:
    """Enumerate the N-trees of an order, by root colour, with order, symmetry and density.

    A tree is its root's colour after its bracketed branches: []_1 is a single vertex of colour 1.
    With
    --symplectic the rooted trees that differ in the place of their root are one row: their
    conditions are equivalent for symplectic methods.
    """
    wanted = Wanted(**options)
    asked = kind_asked(wanted.symplectic, wanted.kind, wanted.members, output.format)
    if asked is not None:
        _free_trees(asked, wanted, output)
    else:
        _rooted_trees(wanted, output)
    return 0


@dataclass(frozen=True)
class Wanted:
    """What is asked for, by the names of the options.

    Attributes:
        colours: how many, or None for as many as usual.
        order, upto: the order, and whether those below it are meant too.
        root: the colour of the root, from 1, or None for any.
        colours_used: the colours that have to occur, as they were written.
        count: whether the trees are counted only.
        yes: whether millions of lines are meant.
        one: a single tree instead of an order.
        svg: the file of a sheet of pictures.
        document: whether LaTeX gets a preamble.
        symplectic, kind, members: of free trees.
    """

    colours: int | None
    order: int | None
    upto: bool
    root: int | None
    colours_used: str | None
    count: bool
    yes: bool
    one: str | None
    svg: str | None
    document: bool
    symplectic: bool
    kind: str | None
    members: bool

    @property
    def orders(self) -> range:
        """The orders asked for.

        Raises:
            UsageProblem: none is.
        """
        if self.order is None:
            raise UsageProblem(
                "which order?", "give --order n, or --tree for one tree", code="option-alone"
            )
        first = 1 if self.upto else self.order
        return range(first, self.order + 1)


def _rooted_trees(wanted: Wanted, output: Output) -> None:
    """A row for each tree, their number, their pictures, or one tree."""
    from garkcli.report import trees as report

    colours = wanted.colours or 1
    used = _colours(wanted.colours_used, colours)
    if wanted.root is not None and wanted.root > colours:
        message = f"there is no colour {wanted.root}"
        raise UsageProblem(message, f"--colours {colours} numbers them from 1", code="no-such-tree")
    if wanted.one is not None:
        _single(wanted.one, wanted.svg, wanted.document, output)
        return
    orders = wanted.orders
    query = report.Query(colours, orders[-1], wanted.upto, wanted.root, used)
    if wanted.count:
        _count(query, output)
    elif wanted.svg is not None:
        from garkcli.trees.notation import parse_tree

        trees = (parse_tree(row.tree) for row in rows_of(query, orders))
        draw_sheet(wanted.svg, trees, colours > 1, output)
    else:
        _list(query, orders, wanted, output)


def _count(query: Query, output: Output) -> None:
    """The numbers of trees alone."""
    from garkcli.report import trees as report

    if query.used:
        raise UsageProblem(
            "--count knows no --colours-used", "leave one of them out", code="options-clash"
        )
    counts = counts_of(query)
    format, paint = output.format, output.paint
    with _any_digits():
        output.write(report.render_counts(query, counts, format, paint))


def _list(query: Query, orders: range, wanted: Wanted, output: Output) -> None:
    """A row for each tree."""
    from garkcli.report import trees as report

    totals = None
    count_all = None
    if not query.used:
        totals = counts_of(query)
        kept = [report.kept(query, by_root) for _, by_root in totals]
        count_all = sum(map(sum, kept))
    _refuse_millions(count_all, wanted.yes)
    rows = counting("trees", rows_of(query, orders), count_all)
    pieces = report.render(query, rows, totals, output.format, output.paint, wanted.document)
    output.write(pieces)


def _refuse_millions(lines: int | None, yes: bool) -> None:
    """Ask on a terminal whether so many lines are meant, and refuse them without one.

    Raises:
        UsageProblem: they are not meant, or nobody was asked.
    """
    if yes or lines is None or lines <= MANY:
        return
    if is_terminal(sys.stdin) and is_terminal(sys.stderr):
        say(f"{lines} trees: list them all? [y/N]")
        hush()
        if sys.stdin.readline().strip().lower() in {"y", "yes"}:
            return
    raise UsageProblem(
        f"{lines} trees", "--yes lists them, --count counts them", code="option-value"
    )


def _free_trees(kind: Kind, wanted: Wanted, output: Output) -> None:
    """A row for each class of equivalent conditions of symplectic methods."""
    from garkcli.report import symplectic as report
    from garkcli.report.symplectic_subject import subject_of_kind

    of_rooted = (wanted.root, wanted.colours_used, wanted.one)
    if any(option is not None for option in of_rooted):
        cure = "leave out --root, --colours-used and --tree"
        raise UsageProblem("free trees have no root", cure, code="options-clash")
    subject = subject_of_kind(kind, wanted.colours, wanted.orders)
    format, paint = output.format, output.paint
    if wanted.count:
        with _any_digits():
            output.write(report.render_class_counts(subject, format, paint))
    elif wanted.svg is not None:
        trees = (found.representative for found in subject.classes())
        draw_sheet(wanted.svg, trees, subject.has_colours, output)
    else:
        lines = subject.independent
        _refuse_millions(lines, wanted.yes)
        classes = counting("trees", subject.classes(), lines)
        pieces = report.render_classes(
            subject, classes, format, paint, wanted.members, wanted.document
        )
        output.write(pieces)


def _single(text: str, svg: str | None, is_document: bool, output: Output) -> None:
    """One tree, given in bracket text."""
    from garkcli.report import trees as report
    from garkcli.trees.notation import NotationError, format_tree, parse_tree

    try:
        tree = parse_tree(text)
    except NotationError as error:
        message = f"--tree, column {error.offset + 1}: {error.message}"
        raise UsageProblem(message, error.help, code="no-such-tree") from None
    colours = 1 + max(tree.colours)
    written = format_tree(tree, colours > 1)
    if svg is not None:
        draw_sheet(svg, [tree], colours > 1, output)
        return
    row = report.TreeRow(written, tree.root, tree.order, tree.symmetry, tree.density)
    by_root = tuple(int(l == tree.root) for l in range(colours))
    counts = [(tree.order, by_root)]
    query = report.Query(colours, tree.order, False, tree.root + 1)
    pieces = report.render(query, [row], counts, output.format, output.paint, is_document)
    output.write(pieces)


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
    used = set()
    for word in text.split(","):
        number = word.strip()
        is_number = number.isascii() and number.isdigit()
        if not is_number or not 1 <= int(number[:6]) <= colours:
            wanted = f"colours are numbers from 1 to {colours}"
            raise UsageProblem(f"--colours-used {text}: {wanted}", "write 1,2", code="option-value")
        used.add(int(number) - 1)
    return tuple(sorted(used))
