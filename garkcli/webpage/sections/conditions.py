"""The order conditions of the method with their values, and the data for filters."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from shlex import quote

from garkcli.exact.display import decimal
from garkcli.frozen import Frozen
from garkcli.methodfile.build import MethodFile
from garkcli.ntrees.notation import format_tree
from garkcli.order.admissible import count_conditions
from garkcli.order.conditions import Condition, all_conditions
from garkcli.order.meant import meant
from garkcli.report.conditions import ConditionRow, is_parametric, legend_of, row_of
from garkcli.tableau.garkmethod import derivation_of
from garkcli.tableau.tableau import Tableau
from garkcli.tell.dialect import Plain
from garkcli.webpage.mathml import typeset_condition, typeset_number
from garkcli.webpage.pictures import tree_picture
from garkcli.webpage.reported import Content, Reported

_STATES = ("holds", "within", "varies", "fails")


class Listed(Frozen):
    """The conditions up to ``upto``, and the number of the next order that are left out."""

    rows: list[Condition]
    upto: int
    left_out: int


def content(method: Reported) -> Content | None:
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
    """Returns the arguments of ``gark conditions`` for the method; empty without a file."""
    shown = method.method
    derivation = derivation_of(shown)
    base = shown.base if shown is not None and derivation else shown
    if base is not None and not isinstance(base, MethodFile):
        return ""
    file = quote(method.outcome.file if base is None else base.source)
    return f"{file} --{derivation}" if derivation else file


def _wanted(method: Reported) -> int:
    """Returns the last order of listed conditions: as requested, or the first that fails."""
    if method.wanted_order is not None:
        return method.wanted_order
    found = method.outcome.found
    assert found is not None
    return found.order.order + 1


def _listed(method: Reported, tableau: Tableau, wanted: int) -> Listed:
    """Returns the conditions of whole orders as long as there is room."""
    rows: list[Condition] = []
    wanted = min(wanted, tableau.exact_to or wanted)
    for n in range(1, wanted + 1):
        count = count_conditions(tableau, n)
        if len(rows) + count > method.most_conditions:
            return Listed(rows, n - 1, count)
        rows += all_conditions(meant(tableau, method.tolerance), n)
    return Listed(rows, wanted, 0)


def _rows(found: list[Condition], colours: bool | Sequence[str]) -> Iterator[Content]:
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
    """Returns whether a condition holds exactly, within the tolerance, or for some parameters."""
    if condition.is_exact:
        return "holds"
    if is_parametric(condition.residual):
        return "varies"
    return "within" if condition.holds else "fails"
