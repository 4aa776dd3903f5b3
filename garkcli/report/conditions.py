"""The order-condition table, as in the paper's Table 1 or with the values of a method."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import NamedTuple

from garkcli.exact.display import decimal, to_decimal, to_latex, to_text
from garkcli.exact.field import Number
from garkcli.exact.parametric import Parametric
from garkcli.order.conditions import Condition
from garkcli.page.latex import fragment, number
from garkcli.page.paint import Paint, counted, folded, indented
from garkcli.report.conditions_data import (
    ConditionRow,
    Valued,
    json_of,
    row_data,
    section_of,
    shown,
)
from garkcli.report.symplectic import legend_lines, member_lines, summary_lines
from garkcli.report.symplectic_subject import Subject
from garkcli.report.trees import picture
from garkcli.tell.facts import Level, Row, Section, table
from garkcli.tell.markdown import Markdown
from garkcli.tell.outputs import body
from garkcli.trees.notation import condition_text, format_latex, format_tree, vertex_letters

MOST_DIGITS = 60
"""Longer values are shown in decimals."""
_MARK_WIDTH = 9
"""Columns of the margin and of the word that tells whether a condition holds."""
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
        format: json, csv, latex, markdown or text.
        paint: colour or none.
        width: of the terminal.
        is_document: whether LaTeX gets a preamble.
        subject: where the rows are the independent conditions alone, what they are independent for.
        valued: where the rows have values, of what.
    """
    if valued is not None and format not in ("text", "markdown"):
        rows = filter(valued.shows, rows)
    if format == "json":
        yield from json_of(rows, subject, valued)
    elif format == "csv":
        count = "multiplicity" if subject is None else "stands_for"
        yield from _csv(rows, [*_VALUED, count])
    elif format == "latex":
        yield from fragment(_latex(rows, subject), is_document)
    elif format == "markdown":
        yield _markdown(rows, subject, valued)
    else:
        yield from _text(rows, paint, width, subject, valued)


def _csv(rows: Iterable[ConditionRow], heading: Sequence[str]) -> Iterator[str]:
    """The rows under their keys; under ``heading`` where there are none, since no condition
    fails.
    """
    keys: list[str] = []
    for row in rows:
        data = row_data(row)
        data.pop("for_all", None)
        if not keys:
            keys = list(data)
            yield ",".join(keys) + "\n"
        cells = [_quoted(data[key]) for key in keys]
        yield ",".join(cells) + "\n"
    if not keys:
        yield ",".join(heading) + "\n"


def _quoted(value: object) -> str:
    """A value as the cell of a CSV file."""
    if value is None:
        return ""
    text = str(value)
    if isinstance(value, list):
        text = " ".join(value)
    if isinstance(value, bool):
        text = text.lower()
    needs_quotes = "," in text or " " in text
    return f'"{text}"' if needs_quotes else text


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
        yield from _lines(row, paint, width, valued is None or valued.tableau.size > 1)
    verdict = ""
    if valued is not None and count:
        verdict = _verdict(failed, valued)
    if subject is not None:
        ending = f"; {verdict}" if verdict else ""
        yield from summary_lines(subject, ending, width)
    else:
        ending = f", {verdict}" if verdict else ""
        conditions = counted(count, "condition")
        yield f"{conditions}{ending}\n"


def _markdown(rows: Iterable[ConditionRow], subject: Subject | None, valued: Valued | None) -> str:
    """How many conditions there are, how many hold, and all of them in a table."""
    found = list(rows)
    if valued is None:
        text = counted(len(found), "condition")
        shown_rows = found
    else:
        failed = sum(x.condition is not None and not x.condition.holds for x in found)
        text = f"{counted(len(found), 'condition')}, {_verdict(failed, valued)}"
        shown_rows = [x for x in found if valued.shows(x)]
    about = legend_lines(subject) if subject is not None else _names(valued) if valued else ()
    d = Markdown()
    lines = d.headline(text)
    for line in about:
        lines += d.subtitle(d.prose(line.strip()))
    if shown_rows:
        section = section_of(shown_rows[0])
        whole = Section(Row("conditions", table(section, len(shown_rows))))
        lines += body(whole, _Listed(shown_rows), d, Level.USUAL, 1)
    return d.page(lines)


class _Listed(NamedTuple):
    """The rows of a table."""

    conditions: list[ConditionRow]


def _names(valued: Valued) -> Iterator[str]:
    """The names of the colours, where their numbers are not their names."""
    names = [colour.name for colour in valued.tableau.colours]
    last = len(names)
    numbers = [str(l) for l in range(1, last + 1)]
    if names != numbers:
        pairs = map(" ".join, zip(numbers, names, strict=True))
        legend = ", ".join(pairs)
        yield f"colours: {legend}\n"


def _verdict(failed: int, valued: Valued) -> str:
    if valued.parameters:
        return _of_every_value(failed)
    if failed == 1:
        return "1 fails"
    if failed:
        return f"{failed} fail"
    if valued.tolerance is None:
        return "all hold"
    return f"all hold within {decimal(valued.tolerance)}"


def _of_every_value(failed: int) -> str:
    """How many conditions not every value of free parameters meets."""
    if not failed:
        return "all hold for every value"
    verb = "does" if failed == 1 else "do"
    return f"{failed} {verb} not hold for every value"


def _lines(row: ConditionRow, paint: Paint, width: int, has_colours: bool) -> Iterator[str]:
    """One row: on one line where there is no value and it fits, below each other otherwise."""
    tree = format_tree(row.tree, has_colours and not row.is_shape)
    sizes = f"σ = {row.tree.symmetry}  γ = {row.tree.density}"
    multiplicity = _multiplicity(row)
    text = row.formula if has_colours else condition_text(row.tree, colours=False)
    formula = f"{text}   {multiplicity}".rstrip()
    one = f"  {tree:<22} {sizes:<17} {formula}"
    condition = row.condition
    if condition is None and len(one) <= width:
        lines = [one]
    else:
        head = f"{tree:<22} {sizes}"
        below: list[str] = []
        left = width - _MARK_WIDTH
        if len(head) > left:
            head, *below = folded(tree, left)
            below.append(f"  {sizes}")
        mark = _mark(condition, paint)
        lines = [f"  {mark}{head}"]
        below += folded(formula, width - 6, " " * 4)
        lines += indented(below, " " * 6)
    if condition is not None and not condition.is_exact:
        miss = _miss(condition, row.digits)
        lines += folded(f"      {miss}", width, " " * 8)
    members = (format_tree(tree, has_colours) for tree in row.members)
    lines += member_lines(members, width)
    for line in lines:
        yield line + "\n"


def _mark(condition: Condition | None, paint: Paint) -> str:
    """Whether a condition holds, exactly or within the tolerance."""
    if condition is None:
        return ""
    if is_parametric(condition.residual):
        return paint("note", "varies") + " "
    holds = "holds  " if condition.is_exact else "within "
    return paint.verdict(condition.holds, holds, "FAILS  ")


def is_parametric(number: object) -> bool:
    """Whether a number depends on free parameters."""
    return isinstance(number, Parametric)


def _multiplicity(row: ConditionRow) -> str:
    """How many conditions the row is, or for which colours it is one."""
    if row.stands_for:
        return f"stands for {row.stands_for}"
    if row.condition is not None:
        if not row.condition.twins:
            return ""
        trees = len(row.condition.trees)
        return f"({trees} times)"
    if row.is_shape:
        letters = ",".join(vertex_letters(row.tree))
        return f"∀ {letters}"
    return ""


def _miss(condition: Condition, digits: int | None) -> str:
    """The value and the residual, in decimals where they are long or ``digits`` are asked for."""
    kind = "coupling" if condition.is_coupling else "diagonal"
    value = shown(condition.value, digits)
    residual = shown(condition.residual, digits)
    longest = max(len(value), len(residual))
    is_number = not is_parametric(condition.value)
    if digits is None and longest > MOST_DIGITS and is_number:
        value = f"about {to_decimal(condition.value, 8)}"
        residual = to_decimal(condition.residual, 4)
    return f"is {value}, off by {residual}  ({kind} condition)"


def _latex_values(condition: Condition, digits: int | None) -> tuple[str, str]:
    """The value and the residual, in decimals where they are long or ``digits`` are asked for."""
    value = condition.value
    residual = condition.residual
    if digits is not None:
        shown_value = _latex_decimal(value, digits)
        shown_residual = _latex_decimal(residual, digits)
        return shown_value, shown_residual
    texts = (to_text(value), to_text(residual))
    is_number = not is_parametric(value)
    if max(map(len, texts)) > MOST_DIGITS and is_number:
        about = _latex_decimal(value, 8)
        shown_residual = _latex_decimal(residual, 4)
        return rf"\approx {about}", shown_residual
    return to_latex(value), to_latex(residual)


def _latex_decimal(value: Number, digits: int) -> str:
    return number(to_decimal(value, digits))


def _latex(rows: Iterable[ConditionRow], subject: Subject | None = None) -> Iterator[str]:
    if subject is not None:
        for line in legend_lines(subject):
            yield f"% {line}"
    is_begun = False
    for row in rows:
        if not is_begun:
            yield _latex_head(row)
            is_begun = True
        cells = " & ".join(_latex_cells(row))
        yield f"  {cells} \\\\[4pt]\n"
    if is_begun:
        yield "  \\hline\n\\end{longtable}\n"


def _latex_head(row: ConditionRow) -> str:
    """The beginning of a table whose rows have the columns of this one."""
    head = ["", "$u$", r"$\rho(u)$", r"$\gamma(u)$", "order condition"]
    if row.condition is not None:
        head += ["value", "residual"]
    if row.stands_for:
        head.append("stands for")
    elif row.condition is None:
        head.append("for all")
    columns = "l" * len(head)
    titles = " & ".join(head)
    begin = f"\\begin{{longtable}}{{{columns}}}\n  \\hline\n"
    return f"{begin}  {titles} \\\\ \\hline\n"


def _latex_cells(row: ConditionRow) -> list[str]:
    has_colours = not row.is_shape
    tree = format_latex(row.tree, has_colours)
    cells = [
        picture(row.tree, colours=has_colours),
        f"${tree}$",
        str(row.tree.order),
        str(row.tree.density),
        f"${row.latex}$",
    ]
    if row.condition is not None:
        values = _latex_values(row.condition, row.digits)
        cells += [f"${value}$" for value in values]
    if row.stands_for:
        cells.append(str(row.stands_for))
    elif row.condition is None:
        for_all = ""
        if row.is_shape:
            letters = ",".join(vertex_letters(row.tree))
            for_all = rf"$\forall\, {letters}$"
        cells.append(for_all)
    return cells
