"""The orders and the trees at which they end."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from markupsafe import Markup

from garkcli.ntrees.notation import format_tree
from garkcli.order.certificate import Witness
from garkcli.report.check import named_colours
from garkcli.report.checked import REPORT
from garkcli.tell.facts import Level
from garkcli.tell.outputs import cell, label, words
from garkcli.webpage.mathml import Typeset, typeset, typeset_condition, typeset_number
from garkcli.webpage.pictures import tree_picture
from garkcli.webpage.reported import Content, Reported

WITH_TIME = ("nonautonomous_order", "embedded_nonautonomous_order")
OF_OTHER_KINDS = (
    *("w_order", "old_jacobian_order", "index_1_order", "index_1_y_order", "index_1_z_order"),
    *("embedded_w_order", "embedded_old_jacobian_order", "embedded_index_1_order", "slow_order"),
    *("position_order", "velocity_order", "embedded_position_order", "embedded_velocity_order"),
    *("dense_position_order", "dense_velocity_order"),
)
ORDERS = (
    *("order", "embedded_order", "dense_order", "conjugate_order", "pair_order"),
    *(*WITH_TIME, *OF_OTHER_KINDS),
)
"""The rows of ``gark check`` with orders."""
OF_PAIR = ("conjugate_order", "pair_order")
NOTES = {"embedded_order": "error_estimate", "dense_order": "dense"}
"""Rows that are shown below others."""


def content(method: Reported) -> Content | None:
    outcome = method.outcome
    if not outcome.is_read:
        return None
    return {"orders": list(_orders(method)), "left_behind": " and ".join(outcome.left_behind)}


def _orders(method: Reported) -> Iterator[Content]:
    """Yields the orders, each with the condition at which it ends unless shown already."""
    outcome = method.outcome
    d = Typeset(**REPORT.signs(outcome))
    facts = REPORT.form(outcome).named(outcome, {*ORDERS, *NOTES.values()})
    met: set[tuple[str, str]] = set()
    for key, fact in facts.items():
        is_with_time = key in WITH_TIME
        if key not in ORDERS or not fact.is_something:
            continue
        if key in OF_PAIR and not method.tells_pair:
            continue
        if is_with_time and fact.level > Level.USUAL and not outcome.of_other_kind:
            continue
        note = facts.get(NOTES.get(key, ""))
        notes = [] if note is None else [Markup(f"{label(note, d)}: {words(note, d)}.")]
        if is_with_time:
            problem = typeset("y'=f(t,y)", "y' = f(t, y)")
            text = Markup("On {} with the nodes as printed; the last colour is time.")
            notes.append(text.format(problem))
        witness = fact.answer.witness or getattr(fact.value, "witness", None)
        has_colours: bool | Sequence[str] = len(d.colours) > 1
        if d.names:
            has_colours = fact.answer.names or d.names
        elif key == "pair_order" or is_with_time:
            has_colours = True
        shown = None
        if witness is not None and (where := (str(witness.tree), str(witness.residual))) not in met:
            met.add(where)
            shown = _witness(witness, has_colours)
        yield {
            "label": Markup(label(fact, d)),
            "number": Markup("none" if fact.value is None else cell(fact, d)),
            "text": Markup(words(fact, d)),
            "witness": shown,
            "notes": notes,
        }


def _witness(witness: Witness, colours: bool | Sequence[str]) -> Content:
    """Returns the failing condition; no formula if colours have names, as blocks have none."""
    tree, names = witness.tree, () if isinstance(colours, bool) else colours
    name = format_tree(tree, colours)
    title = f"tree of order {tree.order}, {name}"
    return {
        "order": tree.order,
        "tree": name,
        "legend": named_colours(tree, names) if names else "",
        "picture": tree_picture(tree, title, bool(colours)),
        "condition": "" if names else typeset_condition(tree, bool(colours)),
        "value": typeset_number(witness.value),
        "required": typeset_number(witness.required),
        "residual": typeset_number(witness.residual),
    }
