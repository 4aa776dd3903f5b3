"""The order conditions of the method with their values, and what they are filtered by."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from shlex import quote

from garkcli.exact.display import decimal
from garkcli.frozen import Frozen
from garkcli.methodfile.build import MethodFile
from garkcli.ntrees.notation import format_tree
from garkcli.order.conditions import Condition, all_conditions, count_conditions
from garkcli.order.meant import meant
from garkcli.report.conditions import ConditionRow, is_parametric, legend_of, row_of
from garkcli.tableau.garkmethod import derivation_of
from garkcli.tableau.tableau import Tableau
from garkcli.tell.dialect import Plain
from garkcli.webpage.mathml import typeset_condition, typeset_number
from garkcli.webpage.reported import Content, Reported
from garkcli.webpage.tree_picture import tree_picture

_STATES = ("holds", "within", "varies", "fails")


class Listed(Frozen):
    """The conditions that are shown.

    Attributes:
        rows: of whole orders.
        upto: the last of these orders.
        left_out: how many of the next order are left out; 0 where it is not wanted.
    """

    rows: list[Condition]
    upto: int
    left_out: int


def content(method: Reported) -> Content | None:
    """What the template is given; None where the section has nothing to say."""
    tableau = method.tableau
    if tableau is None:
        return None
    listed = _listed(method, tableau, _wanted(method))
    names = [colour.name for colour in tableau.colours]
    rows = list(_rows(listed.rows, names if method.has_names else tableau.size > 1))
    states = {row["state"] for row in rows}
    roots = sorted({row["root"] for row in rows})
    return {
        "rows": rows,
        "legend": legend_of(tableau) if method.has_names else "",
        "upto": listed.upto,
        "left_out": listed.left_out,
        "orders": range(1, listed.upto + 1),
        "roots": [(root, names[root - 1]) for root in roots],
        "states": [state for state in _STATES if state in states],
        "failing": sum(row["state"] in ("fails", "varies") for row in rows),
        "tolerance": method.tolerance and decimal(method.tolerance),
        "arguments": _arguments(method),
    }


def _arguments(method: Reported) -> str:
    """FILE of ``gark conditions`` for this method, perhaps with --pair; empty without a file."""
    shown = method.method
    derivation = derivation_of(shown)
    base = shown.base if shown is not None and derivation else shown
    if base is not None and not isinstance(base, MethodFile):
        return ""
    file = quote(method.outcome.file if base is None else base.source)
    return f"{file} --{derivation}" if derivation else file


def _wanted(method: Reported) -> int:
    """Up to which order: that which was requested, or the first of which a condition fails."""
    if method.wanted_order is not None:
        return method.wanted_order
    found = method.outcome.found
    assert found is not None
    return found.order.order + 1


def _listed(method: Reported, tableau: Tableau, wanted: int) -> Listed:
    """Whole orders as long as there is room."""
    rows: list[Condition] = []
    wanted = min(wanted, tableau.exact_to or wanted)
    for n in range(1, wanted + 1):
        count = count_conditions(tableau, n)
        if len(rows) + count > method.most_conditions:
            return Listed(rows, n - 1, count)
        rows += all_conditions(meant(tableau, method.tolerance), n)
    return Listed(rows, wanted, 0)


def _rows(found: list[Condition], colours: bool | Sequence[str]) -> Iterator[Content]:
    """What ``gark conditions`` says of each, with the tree drawn and the formulas typeset."""
    has_colours = bool(colours)
    for condition in found:
        row = ConditionRow(condition.tree, False, condition)
        data = row_of(has_values=True).data(row, Plain())
        name = format_tree(condition.tree, colours)
        title = f"tree of order {condition.tree.order}, {name}"
        yield {
            **data,
            "tree": name,
            "picture": tree_picture(condition.tree, title, has_colours),
            "formula": typeset_condition(condition.tree, has_colours),
            "weight": typeset_number(condition.value),
            "off": typeset_number(condition.residual),
            "state": _state(condition),
        }


def _state(condition: Condition) -> str:
    """Whether it holds: exactly, within the tolerance, for some values of the parameters."""
    if condition.is_exact:
        return "holds"
    if is_parametric(condition.residual):
        return "varies"
    return "within" if condition.holds else "fails"
