"""``gark diff`` for people."""

from __future__ import annotations

from collections.abc import Sequence

from garkcli.comparison.comparison import WITH_TIME, Comparison, PropertyPair
from garkcli.comparison.differences import BlockGap
from garkcli.order.conditions import Condition
from garkcli.order.deciding import AnyOrder
from garkcli.page.paint import Paint, aligned, counted, folded, indented
from garkcli.page.plain import printable
from garkcli.properties.property import Verdict
from garkcli.report.diff_words import (
    cell_name,
    gap_name,
    place_name,
    relation_lines,
    tolerance_lines,
    verdict_name,
)
from garkcli.trees.notation import format_tree

_WIDTH = 80
_MOST_SHOWN = 10
"""So many conditions are shown of each kind; JSON has all of them."""
_GOOD = ("identical", "same", "within-rounding")


def render(found: Comparison, files: tuple[str, str], paint: Paint) -> str:
    """The whole report.

    Args:
        found: the comparison.
        files: what the methods were asked for by.
        paint: colour or none.
    """
    lines = _head(found, files)
    first, *others = relation_lines(found)
    style = "good" if found.relation in _GOOD else "bad"
    lines += ["", paint(style, first), *indented(others)]
    lines += indented(tolerance_lines(found))
    for part in (_gaps(found), _orders(found), _conditions(found), _properties(found)):
        if part:
            lines += ["", *part]
    return "\n".join(lines) + "\n"


def _head(found: Comparison, files: tuple[str, str]) -> list[str]:
    """Which methods these are."""
    lines = []
    labels = ("first ", "second")
    methods = (found.one, found.other)
    for label, file, method in zip(labels, files, methods, strict=True):
        name = printable(method.name)
        colours = counted(method.tableau.size, "colour")
        stages = ", ".join(map(str, method.stages))
        about = f"{colours}, stages {stages}"
        lines.append(f"{label}  {printable(file)}")
        if name and name != file:
            about = f"{name}: {about}"
        lines += [f"        {line}" for line in folded(about, 72, "")]
    return lines


def _gaps(found: Comparison) -> list[str]:
    """The entries that differ, with the largest difference of each block."""
    if found.one.tableau.size != found.other.tableau.size:
        return ["the numbers of colours differ: no entry is compared"]
    if not found.gaps or found.relation == "same":
        return []
    lines = ["entries that differ, first against second"]
    rows = []
    for gap in found.gaps:
        name = gap_name(gap, found.one.tableau.size)
        rows.append([name, _count(gap), _largest(gap)])
    lines += indented(aligned(rows, right=False))
    return [x for line in lines for x in folded(line, _WIDTH, " " * 6)]


def _count(gap: BlockGap) -> str:
    if gap.shapes is not None:
        return "shape"
    return f"{len(gap.gaps)} of {gap.entries}"


def _largest(gap: BlockGap) -> str:
    """The largest difference and where it is."""
    if gap.shapes is not None:
        return f"{gap.shapes[0]} against {gap.shapes[1]}"
    largest = gap.largest
    if largest is None:
        return ""
    place = place_name(largest)
    one, other = cell_name(largest.one), cell_name(largest.other)
    size = cell_name(largest.gap)
    text = f"{place}: {one} against {other}, off by {size}"
    return f"largest in {text}" if len(gap.gaps) > 1 else text


def _orders(found: Comparison) -> list[str]:
    rows = [["", "first", "second"]]
    for pair in found.orders:
        has_time = pair.name == WITH_TIME
        if (has_time and not pair.is_different) or not pair.exists:
            continue
        mark = "  differs" if pair.is_different else ""
        second = f"{_order(pair.other):>6}{mark}"
        rows.append([pair.name, f"{_order(pair.one):>5}", second])
    return [line.rstrip() for line in aligned(rows, right=False)]


def _order(order: AnyOrder | None) -> str:
    if order is None:
        return "none"
    return f">= {order.order}" if order.is_lower_bound else str(order.order)


def _conditions(found: Comparison) -> list[str]:
    """The trees that tell the methods apart."""
    if found.met is None:
        return []
    met = found.met
    if not met.pairs:
        return [f"no condition to order {met.order} is met by one alone"]
    is_one = found.one.tableau.size == 1
    lines = []
    for which, pairs, at in (("first", met.first_only, 1), ("second", met.second_only, 0)):
        upto = f"conditions to order {met.order} that the {which} alone meets"
        lines.append(f"{upto}: {len(pairs) or 'none'}")
        for pair in pairs[:_MOST_SHOWN]:
            lines += _condition(pair[at], not is_one)
        if len(pairs) > _MOST_SHOWN:
            more = len(pairs) - _MOST_SHOWN
            lines.append(f"  and {more} more: --format json has them")
    return lines


def _condition(failing: Condition, colours: bool) -> list[str]:
    """A condition with the value that the other method has."""
    tree = format_tree(failing.tree, colours)
    value = cell_name(failing.value)
    text = f"  order {failing.tree.order}  {tree}: {value} instead of"
    return folded(f"{text} {failing.required}", _WIDTH)


def _properties(found: Comparison) -> list[str]:
    known = [x for x in found.properties if x.is_known]
    half_known = [x for x in found.properties if not x.is_known]
    lines: list[str] = []
    for title, pairs in (
        ("properties that differ", known),
        ("properties decided of one alone", half_known),
    ):
        if lines and pairs:
            lines.append("")
        lines += _table_of(title, pairs)
    return lines


def _table_of(title: str, pairs: Sequence[PropertyPair]) -> list[str]:
    if not pairs:
        return []
    rows = [[title, "first", "second"]]
    for pair in pairs:
        one, other = _short(pair.one), _short(pair.other)
        rows.append([f"  {pair.key}", one, other])
    lines = aligned(rows, right=False)
    return [x for line in lines for x in folded(line, _WIDTH)]


def _short(verdict: Verdict) -> str:
    """The value of a property without the polynomial that a number is a root of."""
    return verdict_name(verdict).partition(", a root of ")[0]
