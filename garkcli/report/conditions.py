"""The order-condition table, as in the paper's Table 1 or with the values of a method."""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from itertools import groupby
from typing import Any

from garkcli.exact.display import to_text
from garkcli.order.conditions import Condition
from garkcli.report.latex import fragment
from garkcli.report.paint import Paint
from garkcli.report.symplectic import Subject, legend_lines, member_lines, summary_lines
from garkcli.report.trees import picture
from garkcli.trees.notation import condition_latex, condition_text, format_latex, format_tree, vertex_letters
from garkcli.trees.tree import Tree


@dataclass(frozen=True)
class ConditionRow:
    """One line of the table.

    Attributes:
        tree: the tree; its colours mean nothing where ``is_shape``.
        is_shape: whether the row stands for all colourings of the tree.
        condition: its value for a method, where there is one.
        multiplicity: how many identical conditions the row stands for, as those of V^l and F^l.
        stands_for: how many conditions are equivalent to it in a symplectic method; 0 where nobody asked.
        members: the trees of these conditions, where asked for.
    """

    tree: Tree
    is_shape: bool
    condition: Condition | None = None
    multiplicity: int = 1
    stands_for: int = 0
    members: tuple[Tree, ...] = ()

    @property
    def formula(self) -> str:
        """The condition in the paper's notation, in plain text."""
        return condition_text(self.tree, vertex_letters(self.tree) if self.is_shape else None)

    @property
    def latex(self) -> str:
        """The condition in the paper's notation, in LaTeX."""
        return condition_latex(self.tree, vertex_letters(self.tree) if self.is_shape else None)


def render(
    rows: Iterable[ConditionRow],
    format: str,  # noqa: A002
    paint: Paint,
    width: int = 80,
    is_document: bool = False,
    subject: Subject | None = None,
) -> Iterator[str]:
    """The table as pieces of text; ``subject`` where the rows are the independent conditions alone."""
    if format == "json":
        about = "" if subject is None else f'"symplectic": {json.dumps(subject.data())}, '
        yield f'{{"schema": "gark/conditions/1", {about}"conditions": ['
        separator = "\n"
        for row in rows:
            yield separator + json.dumps(_data(row), ensure_ascii=False)
            separator = ",\n"
        yield "\n]}\n"
    elif format == "csv":
        yield from _csv(rows)
    elif format == "latex":
        yield from fragment(_latex(rows, subject), is_document)
    else:
        yield from _text(rows, paint, width, subject)


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
            "value": to_text(row.condition.value),
            "required": to_text(row.condition.required),
            "residual": to_text(row.condition.residual),
            "holds": row.condition.holds,
            "kind": "coupling" if row.condition.is_coupling else "diagonal",
        }
        if not row.stands_for:
            data["multiplicity"] = row.multiplicity
    if row.stands_for:
        data["stands_for"] = row.stands_for
    if row.members:
        data["members"] = [format_tree(u) for u in row.members]
    return data


def _csv(rows: Iterable[ConditionRow]) -> Iterator[str]:
    keys: list[str] = []
    for row in rows:
        data = {k: x for k, x in _data(row).items() if k != "for_all"}
        if not keys:
            keys = list(data)
            yield ",".join(keys) + "\n"
        yield ",".join(_quoted(data[key]) for key in keys) + "\n"


def _quoted(value: object) -> str:
    value = " ".join(value) if isinstance(value, list) else value
    text = "" if value is None else str(value).lower() if isinstance(value, bool) else str(value)
    return f'"{text}"' if any(sign in text for sign in ", ") else text


def _text(rows: Iterable[ConditionRow], paint: Paint, width: int, subject: Subject | None = None) -> Iterator[str]:
    count = failed = 0
    valued = False
    if subject is not None:
        yield from legend_lines(subject, width)
    for order, group in groupby(rows, key=lambda row: row.tree.order):
        yield paint("strong", f"order {order}") + "\n"
        for row in group:
            yield from _lines(row, paint, width)
            count += 1
            valued = valued or row.condition is not None
            failed += row.condition is not None and not row.condition.holds
    noun = "condition" if count == 1 else "conditions"
    verdict = f", {failed} fail{'s' * (failed == 1)}" if failed else ", all hold" if valued and count else ""
    if subject is not None:
        valued = subject.tableau is not None
        verdict = f"; {failed} fail{'s' * (failed == 1)}" if failed else "; all hold" if valued else ""
        yield from summary_lines(subject, verdict, width)
        return
    yield f"{count} {noun}{verdict}\n"


def _lines(row: ConditionRow, paint: Paint, width: int) -> Iterator[str]:
    tree = format_tree(row.tree, not row.is_shape)
    mark = ""
    after = f"∀ {','.join(vertex_letters(row.tree))}" if row.is_shape else ""
    if row.condition is not None:
        mark = paint.verdict(row.condition.holds, "holds  ", "FAILS  ")
        after = "" if row.multiplicity == 1 else f"({row.multiplicity} times)"
    if row.stands_for:
        after = f"stands for {row.stands_for}"
    sizes = f"σ = {row.tree.symmetry}  γ = {row.tree.density}"
    one = f"  {tree:<22} {sizes:<17} {row.formula}   {after}".rstrip()
    if row.condition is None and len(one) <= width:
        yield one + "\n"
    else:
        yield f"  {mark}{tree:<22} {sizes}".rstrip() + "\n"
        yield f"      {row.formula}   {after}".rstrip() + "\n"
    if row.condition is not None and not row.condition.holds:
        kind = "coupling" if row.condition.is_coupling else "diagonal"
        value, residual = to_text(row.condition.value), to_text(row.condition.residual)
        yield f"      is {value}, off by {residual}  ({kind} condition)\n"
    yield from (line + "\n" for line in member_lines(map(format_tree, row.members), width))


def _latex(rows: Iterable[ConditionRow], subject: Subject | None = None) -> Iterator[str]:
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
            from garkcli.exact.display import to_latex

            cells += [f"${to_latex(row.condition.value)}$", f"${to_latex(row.condition.residual)}$"]
        if row.stands_for:
            cells.append(str(row.stands_for))
        elif not valued:
            letters = ",".join(vertex_letters(row.tree)) if row.is_shape else ""
            cells.append(rf"$\forall\, {letters}$" if letters else "")
        yield "  " + " & ".join(cells) + " \\\\[4pt]\n"
    if not first:
        yield "  \\hline\n\\end{longtable}\n"
