"""The orders, what decided them, and the trees at which they end."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

from garkcli.check.analysis import Analysis
from garkcli.check.every_orders import EveryOrder
from garkcli.check.every_value import EveryValue
from garkcli.check.outcome import Outcome
from garkcli.exact.display import decimal
from garkcli.order.certificate import Order, Witness
from garkcli.order.deciding import AnyOrder
from garkcli.order.dense import DenseOrder
from garkcli.report.check import dense_words, estimate_words, hints
from garkcli.report.every import higher_text
from garkcli.report.hints import size
from garkcli.tableau.forms import with_time
from garkcli.tableau.tableau import Tableau
from garkcli.tell.dialect import Plain
from garkcli.tell.facts import Row
from garkcli.tell.kinds import ORDER, order_answer
from garkcli.tell.outputs import cell
from garkcli.trees.notation import format_tree
from garkcli.trees.tree import Tree
from garkcli.webpage.mathml import typeset_condition, typeset_number
from garkcli.webpage.reported import Reported
from garkcli.webpage.section import Content, Section
from garkcli.webpage.tree_picture import tree_picture

ORDER_ROW = Row("order", ORDER, order_answer)


@dataclass(frozen=True)
class Shown:
    """An order as the page has it.

    Attributes:
        label: whose order it is.
        number: it, or that it is at least that.
        how: in a word what kind of answer it is.
        text: in a sentence.
        witness: the condition at which it ends.
        notes: further sentences.
        is_again: whether another order above ends at the same condition.
    """

    label: str
    number: str
    how: str
    text: str
    witness: Content | None = None
    notes: tuple[str, ...] = ()
    is_again: bool = False


def _content(method: Reported) -> Content | None:
    outcome = method.outcome
    if outcome.every is not None:
        found = list(_of_every_value(outcome.every))
    elif outcome.analysis is not None:
        found = list(_of_method(outcome.analysis))
    else:
        return None
    left_behind = " and ".join(outcome.left_behind)
    return {"orders": list(_told_once(found)), "hints": _hints(outcome), "left_behind": left_behind}


def _hints(outcome: Outcome) -> list[str]:
    """What failing conditions tell, as ``gark check`` has it."""
    return [] if outcome.analysis is None else list(map(str, hints(outcome)))


def _told_once(found: Sequence[Shown]) -> Iterator[Shown]:
    """The orders, those marked whose condition was told with another."""
    told = []
    for one in found:
        yield replace(one, is_again=one.witness in told)
        if one.witness is not None:
            told.append(one.witness)


def _of_method(analysis: Analysis) -> Iterator[Shown]:
    """Every order that there is, in the order of ``gark check``."""
    timed = None if not analysis.inconsistent else with_time(analysis.tableau)
    clock = ""
    if timed is not None:
        clock = f"On y' = f(t, y) with the nodes as printed; colour {timed.size} is time."
    yield _order("order", analysis.order, analysis.tableau)
    if analysis.nonautonomous_order is not None and timed is not None:
        order = analysis.nonautonomous_order
        yield _order("non-autonomous order", order, timed, clock)
    yield from _further(analysis, clock)
    for label, found, tableau in (
        ("conjugate order", analysis.conjugate_order, analysis.conjugate),
        ("pair order", analysis.pair_order, analysis.pair),
    ):
        if found is None or tableau is None:
            yield Shown(label, "none", "exact", str(analysis.obstacle))
        else:
            yield _order(label, found, tableau)


def _further(analysis: Analysis, clock: str) -> Iterator[Shown]:
    """The orders of embedded weights and of dense output."""
    embedded, dense = analysis.embedded, analysis.dense
    has_colours = analysis.tableau.size > 1
    if embedded is not None:
        estimate = estimate_words(embedded.estimator, Plain())
        note = f"Error estimate: {estimate}."
        yield _order("embedded order", embedded.order, embedded.tableau, note)
        order = embedded.nonautonomous_order
        timed = with_time(embedded.tableau)
        if order is not None and clock and timed is not None:
            yield _order("embedded non-autonomous order", order, timed, clock)
    if dense is not None:
        fit = f"The output is {dense_words(dense, Plain())}."
        if not dense.ends_at_step:
            fit = f"The output {dense_words(dense, Plain())}."
        yield _dense(dense.order, dense.degree, has_colours, fit)


def _order(label: str, order: AnyOrder, tableau: Tableau, *notes: str) -> Shown:
    """An order of a tableau."""
    witness = None
    if order.witness is not None:
        witness = _witness(order.witness, tableau.size > 1)
    text, how = said(order)
    return Shown(label, order_number(order), how, text, witness, notes)


def said(order: AnyOrder) -> tuple[str, str]:
    """What is known of an order in a sentence, and in a word what kind of answer that is."""
    number = order.order
    every = f"Every condition up to order {number}"
    if isinstance(order, Order):
        if order.is_lower_bound:
            return (f"{every} is proved; no further was looked.", "proved, at least")
        return f"{every} is proved; one of order {number + 1} fails.", "exact"
    tolerance = decimal(order.tolerance)
    largest = size(order.largest_residual)
    text = f"{every} is met within {tolerance}, residuals up to {largest}"
    how = f"within {tolerance}"
    if order.undecided:
        doubt = f"order {number + 1} is not decided: {order.undecided}"
        return f"{text}; {doubt}.", f"{how}, next not decided"
    if order.witness is None:
        return f"{text}; no further was looked.", f"{how}, at least"
    return f"{text}; one of order {number + 1} fails.", how


def _witness(witness: Witness, has_colours: bool) -> Content:
    """The condition that fails."""
    return {
        **_tree(witness.tree, has_colours),
        "value": typeset_number(witness.value),
        "required": typeset_number(witness.required),
        "residual": typeset_number(witness.residual),
    }


def order_number(order: AnyOrder) -> str:
    """An order as it is known."""
    return cell(ORDER_ROW.fact(order), Plain())


def _tree(tree: Tree, has_colours: bool) -> Content:
    """A tree drawn, written, and as a condition."""
    name = format_tree(tree, has_colours)
    title = f"tree of order {tree.order}, {name}"
    return {
        "order": tree.order,
        "tree": name,
        "picture": tree_picture(tree, title, has_colours),
        "condition": typeset_condition(tree, has_colours),
    }


def _dense(order: DenseOrder, degree: int, has_colours: bool, fit: str) -> Shown:
    """The order of dense output."""
    number = str(order.order)
    every = f"Every condition up to order {number} holds for every θ"
    how = "exact"
    if order.tolerance is not None:
        how = f"within {decimal(order.tolerance)}"
    text = f"{every}, of degree {degree}, {how}."
    if order.is_lower_bound:
        number = f"at least {number}"
    if order.undecided:
        text += f" Order {order.order + 1} is too much to decide."
        how += ", next not decided"
    witness = None
    found = order.witness
    if found is not None:
        witness = _witness(found.witness, has_colours)
        text += f" One of order {found.witness.tree.order} fails at θ^{found.power}."
    return Shown("dense order", number, how, text, witness, (fit,))


def _of_every_value(every: EveryValue) -> Iterator[Shown]:
    """The orders for every value of the parameters, and where they are higher."""
    name = next(iter(every.parameters), "")
    for label, order in (
        ("order", every.order),
        ("embedded order", every.embedded),
        ("conjugate order", every.conjugate),
        ("pair order", every.pair),
    ):
        if order is not None:
            yield _every(label, order, name)
        elif label != "embedded order":
            yield Shown(label, "none", "exact", str(every.obstacle))


def _every(label: str, order: EveryOrder, name: str) -> Shown:
    """An order that every value has."""
    number = str(order.order)
    text = f"Every condition up to order {number} is proved for every value."
    if order.witness is None:
        return Shown(label, f"at least {number}", "for every value", text)
    witness = {
        **_tree(order.witness, order.tableau.size > 1),
        "residual": typeset_number(order.residual),
    }
    higher = higher_text(order, name)
    higher = f"{higher[:1].upper()}{higher[1:]}."
    return Shown(label, number, "for every value", text, witness, (higher,))


SECTION = Section("orders", "Orders", _content)
