"""``gark check`` of a file with free parameters, for people."""

from __future__ import annotations

from collections.abc import Sequence

from garkcli.check.every_facts import Fact, told
from garkcli.check.every_orders import EveryOrder
from garkcli.check.every_value import EveryValue
from garkcli.check.every_words import fact_text
from garkcli.check.explained import BOUND, SHARP_BOUND
from garkcli.check.outcome import Outcome
from garkcli.exact.display import to_text
from garkcli.order.simplifying import Simplifying
from garkcli.page.paint import Paint, aligned, counted, folded, indented
from garkcli.page.plain import printable
from garkcli.properties.keys import KEYS
from garkcli.report.check_orders import LABEL
from garkcli.trees.notation import format_tree

_WIDTH = 80
_NAMED = 8
"""Most parameters that are named; the others are counted."""


def every_lines(outcome: Outcome, found: EveryValue, paint: Paint) -> list[str]:
    """All that is told, but for the title and the claims.

    Args:
        outcome: the file.
        found: what holds for every value.
        paint: colour or none.
    """
    lines = _kind(found)
    lines.append("")
    lines += _orders(outcome, found, paint)
    lines += ["", *_conditions(found)]
    lines += ["", *_properties(outcome, found)]
    return lines


def every_line(outcome: Outcome, found: EveryValue, paint: Paint) -> str:
    """The file on one line."""
    mark = paint.verdict(outcome.ok, "ok  ", "FAIL")
    claims = counted(len(outcome.claims), "claim")
    order = f"order {found.order.order} for every value"
    file = printable(outcome.file)
    return f"{mark} {file}: {order}  ({claims})"


def _kind(found: EveryValue) -> list[str]:
    return folded(f"  {every_kind_text(found)}", _WIDTH, "  ")


def every_kind_text(found: EveryValue) -> str:
    """What is judged, and which parameters are free."""
    tableau = found.tableau
    spaces = [tableau.space(l) for l in range(tableau.size)]
    stages = ", ".join(str(space.stages) for space in spaces)
    names = list(found.parameters)
    shown = ", ".join(names[:_NAMED])
    more = len(names) - _NAMED
    if more > 0:
        shown += f" and {more} more"
    verb = "is" if len(names) == 1 else "are"
    colours = counted(tableau.size, "colour")
    text = f"{colours}, stages {stages}; {shown} {verb} free:"
    return f"{text} what holds for every value"


def _orders(outcome: Outcome, found: EveryValue, paint: Paint) -> list[str]:
    """The orders of the method, its conjugate and its pair."""
    lines: list[str] = []
    file = printable(outcome.file)
    shown: list[tuple[str, str]] = []
    for label, option, order in (
        ("order", "", found.order),
        ("conjugate order", " --conjugate", found.conjugate),
        ("pair order", " --pair", found.pair),
    ):
        if order is None:
            lines += [f"  {label:{LABEL}}none", f"      {found.obstacle}"]
            continue
        command = f"gark design {file}{option}"
        lines += _order(label, order, found, command, paint, shown)
    return lines + _further(found, paint, shown)


def _further(found: EveryValue, paint: Paint, shown: list[tuple[str, str]]) -> list[str]:
    """The order on problems with time and that of the embedded weights, where these are others."""
    lines: list[str] = []
    orders = [("embedded order", found.embedded)]
    if not found.is_consistent:
        orders.insert(0, ("non-autonomous", found.nonautonomous))
        orders.append(("embedded, time", found.embedded_nonautonomous))
    for label, order in orders:
        if order is not None:
            lines += _order(label, order, found, "", paint, shown)
    if found.file.further.dense is not None:
        text = "judged for values of the parameters: --set NAME=1/2"
        lines.append(f"  {'dense output':{LABEL}}{text}")
    return lines


def _order(
    label: str,
    order: EveryOrder,
    found: EveryValue,
    command: str,
    paint: Paint,
    shown: list[tuple[str, str]],
) -> list[str]:
    """An order, the condition that not every value meets, and for which values it is higher."""
    number = paint("strong", str(order.order))
    witness = order.witness
    if witness is None:
        every = f"every condition up to order {order.order} holds"
        return [f"  {label:{LABEL}}at least {number}   {every}"]
    tree = format_tree(witness, order.tableau.size > 1)
    residual = to_text(order.residual)
    failure = (tree, residual)
    lines = [f"  {label:{LABEL}}{number}"]
    if failure in shown:
        lines[0] += f"   fails at order {witness.order}, as above"
    else:
        shown.append(failure)
        text = f"not every value meets that of {tree} of order {witness.order}"
        lines += _indented(f"{text}: off by {residual}")
    lines += _higher(order, found, command)
    if order.poles:
        zero = " or ".join(f"{p} = 0" for p in order.poles[:_NAMED])
        lines += _indented(f"there is none where a weight is zero: {zero}")
    return lines


def _higher(order: EveryOrder, found: EveryValue, command: str) -> list[str]:
    """For which values the order is higher."""
    fact = order.fact
    higher = order.order + 1
    if order.dimension is not None and order.dimension < 0:
        return _indented(f"no value has order {higher}")
    special = tuple(x for x in fact.special if x[1] is not None)
    lines = []
    if special:
        name = found.parameters[0]
        text = fact_text(Fact(order.order, special), name, _with_order)
        lines += _indented(text.split("; ", 1)[1])
    elif fact.zeros:
        text = fact_text(Fact(order.order, zeros=fact.zeros), "")
        lines += _indented(f"order {text.split('; ', 1)[1]}")
    else:
        return _indented(f"no real value of the file has order {higher}")
    if not command:
        return lines
    return lines + _indented(f"{command} --order {higher}")


def _with_order(value: object) -> str:
    return f"order {value}"


def _indented(text: str) -> list[str]:
    """A text under the number that it is about."""
    margin = " " * 6
    lines = folded(text, _WIDTH - len(margin), "  ")
    return indented(lines, margin)


def _conditions(found: EveryValue) -> list[str]:
    """B, C and D for every value; single values where they are larger."""
    simplifying = found.simplifying.value
    if simplifying is None:
        return _labelled("B, C, D", "not decided for every value")
    lines = _table("B(r)", ["  ".join(map(str, simplifying.B))])
    for label, table in (("C(eta)", simplifying.C), ("D(zeta)", simplifying.D)):
        rows = [[_cell(number) for number in row] for row in table]
        lines += _table(label, aligned(rows))
    bound = simplifying.bound
    lines += _labelled("bound", f"{bound} = {BOUND}")
    sharp = simplifying.sharp_bound
    lines += _labelled("sharper bound", f"{sharp} = {SHARP_BOUND}")
    others = found.simplifying
    if not others.is_everywhere:
        name = next(iter(found.parameters), "")
        text = fact_text(others, name, _tables_text).partition("; ")[2]
        if text:
            lines += _labelled("elsewhere", text)
    return lines


def _cell(number: int | None) -> str:
    """How many conditions of a block hold; a dash where there is no block."""
    if number is None:
        return "-"
    return str(number)


def _tables_text(found: object) -> str:
    """B, C and D in a line."""
    assert isinstance(found, Simplifying)
    B = list(found.B)
    C = [list(row) for row in found.C]
    D = [list(row) for row in found.D]
    text = f"B {B}, C {C}, D {D}"
    return text.replace("None", "-")


def _table(label: str, rows: Sequence[str]) -> list[str]:
    lines = []
    for row in rows:
        lines.append(f"  {label:{LABEL}}{row}")
        label = ""
    return lines


def _labelled(label: str, text: str) -> list[str]:
    margin = " " * (LABEL + 2)
    first, *rest = folded(text, _WIDTH - len(margin), "")
    lines = [f"  {label:{LABEL}}{first}"]
    return lines + indented(rest, margin)


def _properties(outcome: Outcome, found: EveryValue) -> list[str]:
    name = next(iter(found.parameters), "")

    def blocks(value: object) -> str:
        return "no" if value else "yes"

    text = fact_text(found.inconsistent, name, blocks)
    lines = _labelled("consistent", text)
    text = fact_text(found.symplectic, name, told)
    lines += _labelled("symplectic", text)
    if not outcome.wants_properties:
        if found.holding:
            lines += _labelled("properties", ", ".join(found.holding))
        return lines
    lines.append("")
    longest = max(map(len, KEYS))
    margin = " " * (longest + 4)
    for key in KEYS:
        verdict = found.verdict(key)
        text = fact_text(verdict, name, property_text)
        first, *rest = folded(text, _WIDTH - len(margin), "")
        lines.append(f"  {key:{longest}}  {first}")
        lines += indented(rest, margin)
    return lines


def property_text(value: object) -> str:
    """An answer in a word or a number."""
    if value is None:
        return "no meaning"
    return told(value)
