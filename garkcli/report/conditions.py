"""The order-condition table, as in the paper's Table 1 or with the values of a method."""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any

from flint import fmpq

from garkcli.exact.display import decimal, to_decimal, to_latex, to_text
from garkcli.exact.field import Number
from garkcli.order.conditions import Condition
from garkcli.report.latex import fragment, number
from garkcli.report.paint import Paint, folded
from garkcli.report.symplectic import Subject, legend_lines, member_lines, summary_lines
from garkcli.report.trees import picture
from garkcli.tableau.tableau import Tableau
from garkcli.trees.notation import (
    condition_latex,
    condition_text,
    format_latex,
    format_tree,
    vertex_letters,
)
from garkcli.trees.tree import Tree

MOST_DIGITS = 60
"""Longer values are shown in decimals."""
_VALUED = [
    "tree",
    "root",
    "order",
    "sigma",
    "gamma",
    "condition",
    "value",
    "required",
    "residual",
    "holds",
    "kind",
]


@dataclass(frozen=True)
class ConditionRow:
    """One line of the table.

    Attributes:
        tree: the tree; its colours mean nothing where ``is_shape``.
        is_shape: whether the row stands for all colourings of the tree.
        condition: its value for a method, where there is one.
        stands_for: how many conditions are equivalent to it in a symplectic method; 0 where nobody
            asked.
        members: the trees of these conditions, where asked for.
        digits: of values in decimals; None for exact ones.
    """

    tree: Tree
    is_shape: bool
    condition: Condition | None = None
    stands_for: int = 0
    members: tuple[Tree, ...] = ()
    digits: int | None = None

    @property
    def formula(self) -> str:
        """The condition in the paper's notation, in plain text."""
        return condition_text(
            self.tree, vertex_letters(self.tree) if self.is_shape else None
        )

    @property
    def latex(self) -> str:
        """The condition in the paper's notation, in LaTeX."""
        return condition_latex(
            self.tree, vertex_letters(self.tree) if self.is_shape else None
        )


@dataclass(frozen=True)
class Valued:
    """What a table with values is about.

    Attributes:
        tableau: the method.
        tolerance: the rounding of its coefficients, or None.
        only_failing: whether conditions that hold are counted but not shown.
    """

    tableau: Tableau
    tolerance: fmpq | None = None
    only_failing: bool = False

    def data(self) -> dict[str, Any]:
        """The fields of the JSON report."""
        tolerance = None if self.tolerance is None else decimal(self.tolerance)
        return {
            "colours": [colour.name for colour in self.tableau.colours],
            "tolerance": tolerance,
        }

    def shows(self, row: ConditionRow) -> bool:
        """Whether a row is in the table."""
        return not self.only_failing or row.condition is None or not row.condition.holds


def render(
    rows: Iterable[ConditionRow],
    format: str,
    paint: Paint,
    width: int = 80,
    is_document: bool = False,
    subject: Subject | None = None,
    valued: Valued | None = None,
) -> Iterator[str]:
    """The table as pieces of text.

    Args:
        rows: its rows, also those that ``valued`` does not show.
        format: json, csv, latex or text.
        paint: colour or none.
        width: of the terminal.
        is_document: whether LaTeX gets a preamble.
        subject: where the rows are the independent conditions alone, what they are independent for.
        valued: where the rows have values, of what.
    """
    if valued is not None and format != "text":
        rows = filter(valued.shows, rows)
    if format == "json":
        fields = {} if valued is None else valued.data()
        if subject is not None:
            fields["symplectic"] = subject.data()
        about = "".join(
            f'"{key}": {json.dumps(value)}, ' for key, value in fields.items()
        )
        yield f'{{"schema": "gark/conditions/1", {about}"conditions": ['
        separator = "\n"
        for row in rows:
            yield separator + json.dumps(_data(row), ensure_ascii=False)
            separator = ",\n"
        yield "\n]}\n"
    elif format == "csv":
        yield from _csv(
            rows, [*_VALUED, "multiplicity" if subject is None else "stands_for"]
        )
    elif format == "latex":
        yield from fragment(_latex(rows, subject), is_document)
    else:
        yield from _text(rows, paint, width, subject, valued)


def _data(row: ConditionRow) -> dict[str, Any]:
    tree = row.tree
    data: dict[str, Any] = {
        "tree": format_tree(tree, not row.is_shape),
        "root": None if row.is_shape else tree.root + 1,
        "order": tree.order,
        "sigma": tree.symmetry,
        "gamma": tree.density,
        "condition": row.formula,
    }
    if row.is_shape:
        data["for_all"] = list(vertex_letters(tree))
    if row.condition is not None:
        data |= {
            "value": _number(row.condition.value, row.digits),
            "required": _number(row.condition.required, row.digits),
            "residual": _number(row.condition.residual, row.digits),
            "holds": row.condition.holds,
            "kind": "coupling" if row.condition.is_coupling else "diagonal",
        }
        if not row.stands_for:
            data["multiplicity"] = len(row.condition.trees)
    if row.stands_for:
        data["stands_for"] = row.stands_for
    if row.members:
        data["members"] = [format_tree(u) for u in row.members]
    return data


def _csv(rows: Iterable[ConditionRow], heading: Sequence[str]) -> Iterator[str]:
    """The rows under their keys; under ``heading`` where there are none, since no condition
    fails.
    """
    keys: list[str] = []
    for row in rows:
        data = {k: x for k, x in _data(row).items() if k != "for_all"}
        if not keys:
            keys = list(data)
            yield ",".join(keys) + "\n"
        yield ",".join(_quoted(data[key]) for key in keys) + "\n"
    if not keys:
        yield ",".join(heading) + "\n"


def _quoted(value: object) -> str:
    value = " ".join(value) if isinstance(value, list) else value
    text = (
        ""
        if value is None
        else str(value).lower()
        if isinstance(value, bool)
        else str(value)
    )
    return f'"{text}"' if any(sign in text for sign in ", ") else text


def _text(
    rows: Iterable[ConditionRow],
    paint: Paint,
    width: int,
    subject: Subject | None,
    valued: Valued | None,
) -> Iterator[str]:
    count = failed = order = 0
    if subject is not None:
        yield from legend_lines(subject, width)
    elif valued is not None:
        yield from _names(valued)
    for row in rows:
        count += 1
        failed += row.condition is not None and not row.condition.holds
        if valued is not None and not valued.shows(row):
            continue
        if row.tree.order != order:
            order = row.tree.order
            yield paint("strong", f"order {order}") + "\n"
        yield from _lines(row, paint, width)
    verdict = "" if valued is None or not count else _verdict(failed, valued)
    if subject is not None:
        yield from summary_lines(subject, verdict and f"; {verdict}", width)
    else:
        yield f"{count} condition{'s' * (count != 1)}{verdict and f', {verdict}'}\n"


def _names(valued: Valued) -> Iterator[str]:
    """The names of the colours, where their numbers are not their names."""
    names = [colour.name for colour in valued.tableau.colours]
    if names != [str(l) for l in range(1, len(names) + 1)]:
        yield f"colours: {', '.join(f'{l} {name}' for l, name in enumerate(names, start=1))}\n"


def _verdict(failed: int, valued: Valued) -> str:
    if failed:
        return f"{failed} fail{'s' * (failed == 1)}"
    return (
        "all hold"
        if valued.tolerance is None
        else f"all hold within {decimal(valued.tolerance)}"
    )


def _lines(row: ConditionRow, paint: Paint, width: int) -> Iterator[str]:
    tree = format_tree(row.tree, not row.is_shape)
    mark = ""
    after = f"∀ {','.join(vertex_letters(row.tree))}" if row.is_shape else ""
    if row.condition is not None:
        mark = paint.verdict(
            row.condition.holds,
            "holds  " if row.condition.is_exact else "within ",
            "FAILS  ",
        )
        after = f"({len(row.condition.trees)} times)" if row.condition.twins else ""
    if row.stands_for:
        after = f"stands for {row.stands_for}"
    sizes = f"σ = {row.tree.symmetry}  γ = {row.tree.density}"
    one = f"  {tree:<22} {sizes:<17} {row.formula}   {after}".rstrip()
    if row.condition is None and len(one) <= width:
        yield one + "\n"
    else:
        head = f"{tree:<22} {sizes}".rstrip()
        lines = (
            [head]
            if len(head) + 9 <= width
            else [*folded(tree, width - 9), f"  {sizes}"]
        )
        yield f"  {mark}{lines[0]}\n"
        yield from (f"      {line}\n" for line in lines[1:])
        whole = f"{row.formula}   {after}".rstrip()
        yield from (f"      {line}\n" for line in folded(whole, width - 6, "    "))
    if row.condition is not None and not row.condition.is_exact:
        miss = f"      {_miss(row.condition, row.digits)}"
        yield from (f"{line}\n" for line in folded(miss, width, "        "))
    yield from (
        line + "\n" for line in member_lines(map(format_tree, row.members), width)
    )


def _miss(condition: Condition, digits: int | None) -> str:
    """The value and the residual, in decimals where they are long or ``digits`` are asked for."""
    kind = "coupling" if condition.is_coupling else "diagonal"
    value, residual = (
        _number(condition.value, digits),
        _number(condition.residual, digits),
    )
    if digits is None and max(len(value), len(residual)) > MOST_DIGITS:
        value, residual = (
            f"about {to_decimal(condition.value, 8)}",
            to_decimal(condition.residual, 4),
        )
    return f"is {value}, off by {residual}  ({kind} condition)"


def _number(value: Number, digits: int | None) -> str:
    """A number as text, exactly or with so many digits."""
    return to_text(value) if digits is None else to_decimal(value, digits)


def _latex_values(condition: Condition, digits: int | None) -> tuple[str, str]:
    """The value and the residual, in decimals where they are long or ``digits`` are asked for."""
    value, residual = condition.value, condition.residual
    if digits is not None:
        return (number(to_decimal(value, digits)), number(to_decimal(residual, digits)))
    if max(len(to_text(value)), len(to_text(residual))) > MOST_DIGITS:
        return rf"\approx {number(to_decimal(value, 8))}", number(
            to_decimal(residual, 4)
        )
    return to_latex(value), to_latex(residual)


def _latex(
    rows: Iterable[ConditionRow], subject: Subject | None = None
) -> Iterator[str]:
    first = True
    if subject is not None:
        yield from (f"% {line}" for line in legend_lines(subject))
    for row in rows:
        valued = row.condition is not None
        if first:
            head = ["", "$u$", r"$\rho(u)$", r"$\gamma(u)$", "order condition"]
            head += ["value", "residual"] if valued else []
            head += ["stands for"] if row.stands_for else [] if valued else ["for all"]
            yield f"\\begin{{longtable}}{{{'l' * len(head)}}}\n  \\hline\n  {' & '.join(head)} \\\\ \\hline\n"
            first = False
        cells = [
            picture(row.tree, colours=not row.is_shape),
            f"${format_latex(row.tree, not row.is_shape)}$",
            str(row.tree.order),
            str(row.tree.density),
        ]
        cells.append(f"${row.latex}$")
        if row.condition is not None:
            cells += [f"${cell}$" for cell in _latex_values(row.condition, row.digits)]
        if row.stands_for:
            cells.append(str(row.stands_for))
        elif not valued:
            letters = ",".join(vertex_letters(row.tree)) if row.is_shape else ""
            cells.append(rf"$\forall\, {letters}$" if letters else "")
        yield "  " + " & ".join(cells) + " \\\\[4pt]\n"
    if not first:
        yield "  \\hline\n\\end{longtable}\n"
