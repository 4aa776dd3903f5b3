"""The orders of a method with the trees that fail, for people."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from flint import arb, fmpq

from garkcli.check.analysis import Analysis
from garkcli.exact.display import decimal, to_decimal, to_text
from garkcli.order.certificate import Order, Witness
from garkcli.order.deciding import AnyOrder
from garkcli.page.paint import Paint, beside, indented
from garkcli.tableau.nonautonomous import with_time
from garkcli.tableau.tableau import Tableau
from garkcli.trees.drawing import draw_text
from garkcli.trees.notation import format_tree

if TYPE_CHECKING:
    from garkcli.order.rounded import RoundedOrder
    from garkcli.order.suggestion import Suggestion

LABEL = 17
"""Columns of a label."""
_TREE_WIDTH = 30
"""Columns of a drawn tree."""
_BESIDE_WIDTH = 74
"""Text and tree stand beside each other where both together are shorter than that."""
_LONGEST = 60
"""Longer values are shown in decimals."""
_WIDTH = 80
_ONE_LINE = 50
"""Value and residual that are shorter together share a line."""


@dataclass(frozen=True)
class Shown:
    """How failures are shown, and which were.

    Attributes:
        digits: significant digits of numbers; None for exact ones.
        witnesses: those that were shown.
    """

    digits: int | None
    witnesses: list[Witness] = field(default_factory=list)


def order_lines(analysis: Analysis, paint: Paint, shown: Shown) -> list[str]:
    """The order of the method, of its conjugate, of their pair, and with time.

    Args:
        analysis: what was found.
        paint: colour or none.
        shown: how failures are shown; those of these lines are added.
    """
    lines: list[str] = []
    for label, order, tableau in (
        ("order", analysis.order, analysis.tableau),
        ("conjugate order", analysis.conjugate_order, analysis.conjugate),
        ("pair order", analysis.pair_order, analysis.pair),
    ):
        if order is None or tableau is None:
            lines += [f"  {label:{LABEL}}none", f"      {analysis.obstacle}"]
            continue
        lines += one_order(label, order, tableau, paint, shown)
    timed = analysis.nonautonomous_order
    if timed is not None and analysis.inconsistent:
        label = "non-autonomous"
        lines += with_time_lines(label, timed, analysis.tableau, paint, shown)
    return lines


def order_number(order: AnyOrder) -> str:
    """An order, or that it is the least one possible."""
    number = str(order.order)
    return f"at least {number}" if order.is_lower_bound else number


def with_time_lines(
    label: str, order: AnyOrder, tableau: Tableau, paint: Paint, shown: Shown
) -> list[str]:
    """The order on y' = f(t, y), as the nodes are not the row sums."""
    timed = with_time(tableau)
    if timed is None:
        return []
    lines = one_order(label, order, timed, paint, shown)
    time = f"colour {timed.size} is time"
    lines.append(f"      for y' = f(t, y) with the nodes as printed; {time}")
    return lines


def one_order(
    label: str, order: AnyOrder, tableau: Tableau, paint: Paint, shown: Shown
) -> list[str]:
    """An order with its witness, drawn unless the same failure was shown before."""
    number = paint("strong", order_number(order))
    head = f"  {label:{LABEL}}{number}"
    if not isinstance(order, Order):
        tolerance = decimal(order.tolerance)
        largest = size(order.largest_residual)
        head += f"   within {tolerance}, residuals up to {largest}"
        if order.undecided:
            return _undecided(head, order)
    witness = order.witness
    if witness is None:
        every = f"every condition up to order {order.order} holds"
        return [f"{head}   {every}; no further was looked"]
    failed = f"fails at order {witness.tree.order}"
    if witness in shown.witnesses:
        line = f"{head}   {failed}, as above"
        if len(line) <= _WIDTH:
            return [line]
        return [head, f"      {failed}, as above"]
    shown.witnesses.append(witness)
    text = _failure(failed, witness, tableau, shown.digits)
    lines = [paint.dots(line) for line in indented(text, " " * 6)]
    return [head, *lines]


def _failure(failed: str, witness: Witness, tableau: Tableau, digits: int | None) -> list[str]:
    """The tree that fails, how far off its condition is, and its drawing where it fits."""
    has_colours = tableau.size > 1
    tree = format_tree(witness.tree, has_colours)
    text = [f"{failed}: {tree}"]
    text += _residual(witness, digits)
    text += _legend(witness, tableau)
    picture = draw_text(witness.tree, has_colours, width=_TREE_WIDTH)
    width = max(map(len, text)) + max(map(len, picture))
    if width >= _BESIDE_WIDTH:
        return text
    return beside(text, picture)


def _undecided(head: str, order: RoundedOrder) -> list[str]:
    """What is left open, and why: on a line of its own where it is long."""
    return [head, f"      {doubt_text(order)}"]


def doubt_text(order: RoundedOrder) -> str:
    """Why the next order is left open."""
    return f"order {order.order + 1} is not decided: {order.undecided}"


def suggestion_lines(found: Suggestion, tolerance: fmpq | None, paint: Paint) -> list[str]:
    """The coefficients look rounded, or more so than they say: what to write into the file."""
    hint = f"  {paint('note', 'hint')}:"
    cure = f"with the line  {found.line}  the order is {found.order}"
    rounding = size(found.rounding)
    if tolerance is not None:
        effect = f"rounding by {decimal(tolerance)} makes residuals up to {rounding}"
        return [f"{hint} {effect}:", "        the tolerance is too tight;", f"        {cure}"]
    small = f"up to order {found.order} the residuals are at most {rounding}"
    return [
        f"{hint} {small}, then {size(found.genuine)}:",
        "        the coefficients look rounded;",
        f"        {cure}",
    ]


def size(ball: arb) -> str:
    """A bound in two digits."""
    if ball == 0:
        return "0"
    text: str = ball.upper().str(2, radius=False)
    return text


def _legend(witness: Witness, tableau: Tableau) -> list[str]:
    """What the numbers of the colours mean, where colours have other names."""
    names = [colour.name for colour in tableau.colours]
    numbers = [str(l) for l in range(1, len(names) + 1)]
    if names == numbers:
        return []
    used = sorted(witness.tree.colours)
    meanings = [f"{numbers[l]} is {names[l]}" for l in used]
    legend = ", ".join(meanings)
    return [f"colour {legend}"]


def _residual(witness: Witness, digits: int | None) -> list[str]:
    """The value, what it should be, and the difference; long ones in decimals."""
    if digits is not None:
        value = to_decimal(witness.value, digits)
        required = to_decimal(witness.required, digits)
        residual = to_decimal(witness.residual, digits)
        return [f"{value} instead of {required}, off by {residual}"]
    value = to_text(witness.value)
    residual = to_text(witness.residual)
    required = str(witness.required)
    if max(len(value), len(residual)) > _LONGEST:
        value = to_decimal(witness.value, 8)
        residual = to_decimal(witness.residual, 4)
        if len(required) > _LONGEST:
            required = f"about {to_decimal(witness.required, 8)}"
        return [f"about {value} instead of {required}, off by {residual}"]
    if len(value) + len(residual) < _ONE_LINE:
        return [f"{value} instead of {required}, off by {residual}"]
    return [f"value    {value}", f"required {required}", f"residual {residual}"]
