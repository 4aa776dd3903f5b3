"""``gark conditions``."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace
from typing import TYPE_CHECKING

import click

from garkcli.cli.options import CONTEXT, PATH, Output, common
from garkcli.cli.trees_command import kind_asked, symplectic_options
from garkcli.errors import UsageProblem

if TYPE_CHECKING:
    from garkcli.report.conditions import ConditionRow, Valued
    from garkcli.report.symplectic import Subject
    from garkcli.trees.symplectic import Kind


@click.command("conditions", context_settings=CONTEXT)
@click.argument("file", required=False, type=PATH, metavar="[FILE]")
@click.option(
    "--colours",
    "-N",
    type=click.IntRange(1, 1000),
    metavar="N",
    help="How many colours, without FILE.",
)
@click.option(
    "--order",
    "-n",
    type=click.IntRange(1, 100),
    default=4,
    show_default=True,
    metavar="n",
    help="Every order up to n.",
)
@click.option("--only", is_flag=True, help="Order n alone.")
@click.option(
    "--coloured/--shapes",
    "coloured",
    default=None,
    help="A row for each colouring, or a row for all of them (without FILE).",
)
@click.option(
    "--conjugate",
    "which",
    flag_value="conjugate",
    help="Of the symplectic conjugate of FILE.",
)
@click.option(
    "--pair", "which", flag_value="pair", help="Of the symplectic pair of FILE."
)
@click.option(
    "--failing", is_flag=True, help="Only conditions of FILE that do not hold."
)
@click.option(
    "--sort",
    type=click.Choice(["tree", "worst"]),
    default="tree",
    show_default=True,
    help="Order of the rows; worst: the largest residual first.",
)
@click.option(
    "--digits",
    type=click.IntRange(1, 1000),
    metavar="N",
    help="Values and residuals in decimals of N digits; by default exact.",
)
@click.option(
    "--document",
    is_flag=True,
    help="With --format latex: a document that compiles as it stands.",
)
@symplectic_options
@common(["text", "json", "csv", "latex"])
def command(
    file: str | None,
    colours: int | None,
    order: int,
    only: bool,
    coloured: bool | None,
    which: str | None,
    failing: bool,
    sort: str,
    digits: int | None,
    document: bool,
    symplectic: bool,
    kind: str | None,
    members: bool,
    output: Output,
) -> int:
    """The order-condition table.

    Without FILE the paper's Table 1 for any order: a row for each tree shape, to hold for all
    colours (text and latex), or a row for each coloured tree (json and csv). With FILE every
    condition of that method with its exact value, the required value and the residual; identical
    conditions are listed once.

    With --symplectic one condition of each class of those that are equivalent for symplectic
    methods; with FILE for its symplectic pair, unless it is symplectic itself.
    """
    from garkcli.report import conditions as report
    from garkcli.report.progress import tracked

    asked = kind_asked(symplectic, kind, members, output.format)
    orders = range(order, order + 1) if only else range(1, order + 1)
    if file is None:
        _refuse(
            {"--conjugate or --pair": which, "--failing": failing, "--digits": digits}
        )
        _refuse({"--sort": sort != "tree"})
    elif colours is not None or coloured is not None:
        raise UsageProblem(
            "the colours are those of FILE", "leave out --colours, --coloured, --shapes"
        )
    if asked is not None and coloured is not None:
        raise UsageProblem(
            "free trees have colours", "leave out --coloured and --shapes"
        )
    valued = None if file is None else _chosen(file, which, failing)
    subject = None if asked is None else _subject(asked, kind, colours, orders, valued)
    if valued is not None and subject is not None and subject.tableau is not None:
        valued = replace(valued, tableau=subject.tableau)
    if subject is not None:
        rows = _independent(subject, members, valued)
    elif valued is not None:
        rows = _with_values(valued, orders)
    else:
        rows = _table(colours, orders, coloured, output.format)
    rows = _arranged(rows, sort, digits)
    rows = tracked(rows, None, "conditions", output.may_show_progress)
    output.write(
        report.render(
            rows, output.format, output.paint, output.width, document, subject, valued
        )
    )
    return 0


def _refuse(given: Mapping[str, object]) -> None:
    """Refuse options that are about values where there is no method.

    Raises:
        UsageProblem: one of them was given.
    """
    for option, value in given.items():
        if value:
            raise UsageProblem(f"{option}: values are those of a method", "give a FILE")


def _arranged(
    rows: Iterator[ConditionRow], sort: str, digits: int | None
) -> Iterator[ConditionRow]:
    """The rows as they are to be shown: the worst first, in decimals."""
    if sort == "worst":
        rows = iter(sorted(rows, key=_badness, reverse=True))
    for row in rows:
        yield row if digits is None else replace(row, digits=digits)


def _chosen(file: str, which: str | None, only_failing: bool) -> Valued:
    from garkcli.methodfile.load import load
    from garkcli.report.conditions import Valued
    from garkcli.tableau.conjugate import conjugate
    from garkcli.tableau.forms import pair

    method = load(file)
    tableau = method.tableau
    if which == "conjugate":
        tableau = conjugate(tableau)
    elif which == "pair":
        tableau = pair(tableau)
    return Valued(tableau, method.tolerance, only_failing)


def _subject(
    asked: Kind,
    kind: str | None,
    terms: int | None,
    orders: range,
    valued: Valued | None,
) -> Subject:
    """What the conditions are independent for: a kind of methods, or the one of a file."""
    from garkcli.report.symplectic import subject_of_kind, subject_of_method

    if valued is None:
        return subject_of_kind(asked, terms, orders)
    if kind is not None:
        raise UsageProblem(
            "the kind is that of FILE", "leave out --kind; --pair asks for the pair"
        )
    return subject_of_method(valued.tableau, orders)


def _independent(
    subject: Subject, members: bool, valued: Valued | None
) -> Iterator[ConditionRow]:
    """A row for each class, with its value where there is a method."""
    from itertools import repeat, tee

    from garkcli.exact.field import ZERO
    from garkcli.order.conditions import conditions
    from garkcli.report.conditions import ConditionRow

    classes, again = tee(subject.classes())
    trees = (found.representative for found in again)
    values = (
        zip(trees, repeat(None))
        if valued is None
        else (
            (x.tree, x)
            for x in conditions(valued.tableau, trees, valued.tolerance or ZERO)
        )
    )
    for found, (tree, condition) in zip(classes, values, strict=True):
        shown = found.members if members else ()
        yield ConditionRow(
            tree, False, condition, stands_for=len(found.members), members=shown
        )


def _table(
    colours: int | None,
    orders: range,
    coloured: bool | None,
    format: str,
) -> Iterator[ConditionRow]:
    """A row for each tree: of each shape for people, of each colouring for programs that say how
    many colours there are.
    """
    from garkcli.report.conditions import ConditionRow
    from garkcli.trees.blocks import iter_blocks

    if coloured is None:
        coloured = format in {"json", "csv"} and colours is not None
    for n in orders:
        for block in iter_blocks(
            (colours or 1) if coloured else 1, n, block_size=1 << 14
        ):
            for tree in block.trees():
                yield ConditionRow(tree, is_shape=not coloured)


def _with_values(valued: Valued, orders: range) -> Iterator[ConditionRow]:
    from garkcli.exact.field import ZERO
    from garkcli.order.listing import all_conditions
    from garkcli.report.conditions import ConditionRow

    for n in orders:
        for condition in all_conditions(valued.tableau, n, valued.tolerance or ZERO):
            yield ConditionRow(condition.tree, False, condition)


def _badness(row: ConditionRow) -> float:
    from garkcli.exact.display import to_float

    return abs(to_float(row.condition.residual)) if row.condition is not None else 0.0
