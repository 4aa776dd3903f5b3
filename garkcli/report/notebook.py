"""Methods and results in notebooks: tables in plain HTML, without colours, and LaTeX."""

from __future__ import annotations

from html import escape
from typing import TYPE_CHECKING, TypeVar

from garkcli.check.findings import witness_text
from garkcli.errors import GarkError, printable
from garkcli.exact.polynomial_text import integral
from garkcli.ntrees.drawing import draw_svg_sheet
from garkcli.page.cells import remark
from garkcli.page.exactly import definition, definition_latex, polynomial_latex
from garkcli.page.tableau_html import tableau_lines
from garkcli.page.tableau_latex import displays
from garkcli.tableau.letters import with_letters

if TYPE_CHECKING:
    from garkcli.order.certificate import Witness
    from garkcli.order.conditions import Condition
    from garkcli.order.deciding import AnyOrder
    from garkcli.order.dense import DenseOrder
    from garkcli.stability.linear import StabilityFunction
    from garkcli.stability.summary import Stability
    from garkcli.tableau.garkmethod import GarkMethod
    from garkcli.tell.facts import Answer, Kind

V = TypeVar("V")
MAX_COLUMNS = 24
"""Most stages side by side; a larger tableau is named, not shown."""


def method_latex(method: GarkMethod) -> str | None:
    """Returns LaTeX; None if the tableau is too large to be examined."""
    if _is_large(method):
        return None
    with with_letters(method.tableau) as letters:
        lines = [*displays(method.tableau, method.entries)]
    return "\n".join([*(rf"\[ {definition_latex(*x)} \]" for x in letters.items()), *lines])


def method_html(method: GarkMethod) -> str:
    if _is_large(method):
        return f"<pre>{_text(repr(method))}</pre>"
    with with_letters(method.tableau) as letters:
        tables = tableau_lines(method.tableau, method.entries, method.name)
    noted = [f"<p>{_text(definition(*x))}</p>" for x in letters.items()]
    note = remark(method.entries)
    noted += [f"<p>{_text(note)}</p>"] if note else []
    return "\n".join([*tables, *noted, *_region_html(method)])


def _region_html(method: GarkMethod) -> list[str]:
    from garkcli.plots.regions import region_of
    from garkcli.plots.svg import svg

    try:
        panel = region_of(method.tableau, method.tolerance)
    except GarkError:
        return []  # the tableau is shown all the same
    return [] if panel is None else [f'<div style="max-width:24rem">{svg(panel)}</div>']


def _is_large(method: GarkMethod) -> bool:
    return sum(method.stages) > MAX_COLUMNS


def witness_html(witness: Witness) -> str:
    colours = len(witness.tree.colours) > 1 or bool(witness.tree.root)
    text = str(witness_text(witness, colours))
    return f"{draw_svg_sheet([witness.tree])}<p>{_text(text)}</p>"


def order_html(order: AnyOrder) -> str:
    from garkcli.tell.kinds import ORDER, order_answer

    return _said("order", ORDER, order_answer(order)) + _drawn(order.witness)


def dense_order_html(order: DenseOrder) -> str:
    from garkcli.report.check import dense_answer
    from garkcli.tell.kinds import COUNT

    witness = None if order.witness is None else order.witness.witness
    has_colours = witness is not None and len(witness.tree.colours) > 1
    return _said("dense order", COUNT, dense_answer(order, has_colours)) + _drawn(witness)


def _said(label: str, kind: Kind[V], answer: Answer[V]) -> str:
    from garkcli.tell.facts import Row
    from garkcli.tell.html import Html
    from garkcli.tell.outputs import phrase

    row: Row[None] = Row("order", kind, lambda _: answer, label=label)
    return f"<p>{phrase(row.fact(None), Html())}</p>"


def _drawn(witness: Witness | None) -> str:
    return "" if witness is None else witness_html(witness)


def condition_html(condition: Condition) -> str:
    tree = condition.tree
    weight = f"{condition.value} = {condition.required}"
    if not condition.is_exact:
        weight = f"{condition.value} instead of {condition.required}"
    return f"{draw_svg_sheet([tree])}<p>{_text(str(tree))}: {_text(weight)}</p>"


def _text(text: str) -> str:
    return escape(printable(text))


def stability_latex(found: Stability) -> str:
    """R(z), and the step matrix on the oscillator."""
    from garkcli.report.stability import formulas

    lines = " \\\\\n".join(f"{name} &{value}" for name, value in formulas(found))
    return f"\\begin{{align*}}\n{lines}\n\\end{{align*}}\n"


def function_latex(R: StabilityFunction) -> str:
    over, under = (polynomial_latex(p, "z") for p in integral([R.numerator, R.denominator]))
    fraction = over if under == "1" else rf"\frac{{{over}}}{{{under}}}"
    return f"$R(z) = {fraction}$"
