"""``gark conditions``."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

from garkcli.cli.companion import companion
from garkcli.cli.options import Output, declared
from garkcli.cli.tree_lists import kind_asked
from garkcli.doing import counting
from garkcli.errors import HasFreeParameters, UsageProblem

if TYPE_CHECKING:
    from garkcli.order.conditions import Condition
    from garkcli.report.conditions_data import ConditionRow, Valued
    from garkcli.report.symplectic_subject import Subject
    from garkcli.trees.symplectic import Kind
    from garkcli.trees.tree import Tree


@declared("conditions", ["text", "json", "csv", "markdown", "latex"])
def command(settings: dict[str, str], output: Output, **options: Any) -> int:
    """The order-condition table.

    Without FILE the conditions that every method has to meet: a row for each tree shape, to hold
    for all colours (text and latex), or a row for each coloured tree (json and csv). With FILE
    every condition of that method with its exact value, the required value and the residual;
    identical conditions are listed once. Values of a file with free parameters are rational
    functions of these.

    With --symplectic one condition of each class of those that are equivalent for symplectic
    methods; with FILE for its symplectic pair, unless it is symplectic itself.
    """
    from garkcli.report import conditions as report

    wanted = Wanted(**options)
    asked = kind_asked(wanted.symplectic, wanted.kind, wanted.members, output.format)
    _check(wanted, asked)
    if settings and wanted.file is None:
        raise UsageProblem(
            "--set is for the parameters of FILE", "name a file", code="option-alone"
        )
    valued = None
    if wanted.file is not None:
        valued = _chosen(wanted.file, settings, wanted)
    subject = None
    if asked is not None:
        subject = _subject(asked, wanted, valued)
    if valued is not None and subject is not None and subject.method is not None:
        valued = replace(valued, method=subject.method)
    if subject is not None:
        rows = _independent(subject, wanted.members, valued)
    elif valued is not None:
        rows = _with_values(valued, wanted.orders)
    else:
        rows = _table(wanted, output.format)
    rows = _arranged(rows, wanted.sort, wanted.digits)
    rows = counting("conditions", rows)
    pieces = report.render(
        rows, output.format, output.paint, output.width, wanted.document, subject, valued
    )
    output.write(pieces)
    return 0


@dataclass(frozen=True)
class Wanted:
    """What is asked for, by the names of the options.

    Attributes:
        file: the method, or None for the conditions themselves.
        colours: how many, without a method.
        order, only: every order up to that one, or it alone.
        coloured: whether each colouring has a row, or None for what suits the format.
        which: of what the values are, "conjugate" or "pair"; None for the method as it stands.
        failing: whether conditions that hold are left out.
        sort: "tree" or "worst".
        digits: of decimals, or None for exact values.
        document: whether LaTeX gets a preamble.
        symplectic, kind, members: of the independent conditions.
    """

    file: str | None
    colours: int | None
    order: int
    only: bool
    coloured: bool | None
    which: str | None
    failing: bool
    sort: str
    digits: int | None
    document: bool
    symplectic: bool
    kind: str | None
    members: bool

    @property
    def orders(self) -> range:
        """The orders asked for."""
        first = self.order if self.only else 1
        return range(first, self.order + 1)


def _check(wanted: Wanted, asked: Kind | None) -> None:
    """Refuse options that do not go together.

    Raises:
        UsageProblem: two of them do not.
    """
    if wanted.file is None:
        _refuse(
            {
                "--conjugate or --pair": wanted.which,
                "--failing": wanted.failing,
                "--digits": wanted.digits,
                "--sort": wanted.sort != "tree",
            }
        )
    elif wanted.colours is not None or wanted.coloured is not None:
        cure = "leave out --colours, --coloured, --shapes"
        raise UsageProblem("the colours are those of FILE", cure, code="options-clash")
    if asked is not None and wanted.coloured is not None:
        cure = "leave out --coloured and --shapes"
        raise UsageProblem("free trees have colours", cure, code="options-clash")


def _refuse(given: Mapping[str, object]) -> None:
    """Refuse options that are about values where there is no method.

    Raises:
        UsageProblem: one of them was given.
    """
    for option, value in given.items():
        if value:
            raise UsageProblem(
                f"{option}: values are those of a method", "give a FILE", code="option-alone"
            )


def _arranged(
    rows: Iterator[ConditionRow], sort: str, digits: int | None
) -> Iterator[ConditionRow]:
    """The rows as they are to be shown: the worst first, in decimals."""
    if sort == "worst":
        rows = iter(sorted(rows, key=_badness, reverse=True))
    for row in rows:
        yield row if digits is None else replace(row, digits=digits)


def _chosen(file: str, settings: Mapping[str, str], wanted: Wanted) -> Valued:
    from garkcli.methodfile.load import load
    from garkcli.report.conditions_data import Valued
    from garkcli.tableau.meant import derived

    try:
        method = load(file, settings)
    except HasFreeParameters as error:
        return _for_every_value(error, settings, wanted)
    which = wanted.which or ""
    return Valued(derived(method.meant, which), wanted.failing, derivation=which)


def _for_every_value(
    error: HasFreeParameters, settings: Mapping[str, str], wanted: Wanted
) -> Valued:
    """A file with free parameters: residuals are rational functions of them."""
    from garkcli.cli.every import read_family, refuse_numbers
    from garkcli.report.conditions_data import Valued

    _, family = read_family(error, settings)
    sort = wanted.sort == "worst"
    refuse_numbers(family, {"--digits": wanted.digits, "--sort worst": sort})
    tableau = companion(family.tableau, wanted.which)
    parameters = family.family.parameters
    return Valued(tableau, wanted.failing, parameters, wanted.which or "")


def _subject(asked: Kind, wanted: Wanted, valued: Valued | None) -> Subject:
    """What the conditions are independent for: a kind of methods, or the one of a file."""
    from garkcli.report.symplectic_subject import subject_of_kind, subject_of_method

    if valued is None:
        return subject_of_kind(asked, wanted.colours, wanted.orders)
    if wanted.kind is not None:
        cure = "leave out --kind; --pair asks for the pair"
        raise UsageProblem("the kind is that of FILE", cure, code="options-clash")
    return subject_of_method(valued.method, wanted.orders)


def _independent(subject: Subject, members: bool, valued: Valued | None) -> Iterator[ConditionRow]:
    """A row for each class, with its value where there is a method."""
    from itertools import tee

    from garkcli.report.conditions_data import ConditionRow

    classes, again = tee(subject.classes())
    trees = (found.representative for found in again)
    values = _values_at(trees, valued)
    for found, (tree, condition) in zip(classes, values, strict=True):
        shown = found.members if members else ()
        yield ConditionRow(tree, False, condition, stands_for=len(found.members), members=shown)


def _values_at(
    trees: Iterator[Tree], valued: Valued | None
) -> Iterator[tuple[Tree, Condition | None]]:
    """Each tree with its condition for the method; with None where there is no method."""
    from garkcli.order.conditions import conditions

    if valued is None:
        for tree in trees:
            yield tree, None
        return
    for condition in conditions(valued.method, trees):
        yield condition.tree, condition


def _table(wanted: Wanted, format: str) -> Iterator[ConditionRow]:
    """A row for each tree: of each shape for people, of each colouring for programs that say how
    many colours there are.
    """
    from garkcli.report.conditions_data import ConditionRow
    from garkcli.trees.blocks import iter_blocks

    coloured = wanted.coloured
    if coloured is None:
        coloured = format in {"json", "csv"} and wanted.colours is not None
    colours = (wanted.colours or 1) if coloured else 1
    for n in wanted.orders:
        for block in iter_blocks(colours, n, block_size=1 << 14):
            for tree in block.trees():
                yield ConditionRow(tree, is_shape=not coloured)


def _with_values(valued: Valued, orders: range) -> Iterator[ConditionRow]:
    from garkcli.order.conditions import all_conditions
    from garkcli.report.conditions_data import ConditionRow

    for n in orders:
        for condition in all_conditions(valued.method, n):
            yield ConditionRow(condition.tree, False, condition)


def _badness(row: ConditionRow) -> float:
    from garkcli.exact.display import to_float

    if row.condition is None:
        return 0.0
    return abs(to_float(row.condition.residual))
