"""``gark diff --format markdown``: for a pull request or a page."""

from __future__ import annotations

from collections.abc import Iterator

from garkcli.comparison.comparison import Comparison
from garkcli.order.deciding import AnyOrder
from garkcli.page.plain import printable
from garkcli.report.diff_words import (
    cell_name,
    gap_name,
    place_name,
    relation_lines,
    tolerance_lines,
    verdict_name,
)
from garkcli.trees.notation import format_tree


def render(found: Comparison, files: tuple[str, str]) -> str:
    """The whole report."""
    first, second = map(_code, files)
    head, *others = relation_lines(found)
    lines = [f"{first} against {second}: **{_cell(head)}**", ""]
    told = [*others, *tolerance_lines(found)]
    lines += [f"- {_cell(line)}" for line in told]
    lines += [*_orders(found), *_gaps(found)]
    lines += [*_conditions(found), *_properties(found)]
    return "\n".join(lines).rstrip() + "\n"


def _orders(found: Comparison) -> Iterator[str]:
    orders = [pair for pair in found.orders if pair.exists]
    if not orders:
        return
    yield from ("", "| | first | second |", "|---|---|---|")
    for pair in orders:
        yield f"| {pair.name} | {_order(pair.one)} | {_order(pair.other)} |"


def _order(order: AnyOrder | None) -> str:
    if order is None:
        return "none"
    return f"≥ {order.order}" if order.is_lower_bound else str(order.order)


def _gaps(found: Comparison) -> Iterator[str]:
    if not found.gaps:
        return
    yield from ("", "| differs | entries | largest at | first | second |")
    yield "|---|---|---|---|---|"
    for gap in found.gaps:
        name = _code(gap_name(gap, found.one.tableau.size))
        largest = gap.largest
        if gap.shapes is not None:
            yield f"| {name} | shape | | {gap.shapes[0]} | {gap.shapes[1]} |"
        elif largest is not None:
            count = f"{len(gap.gaps)} of {gap.entries}"
            place = place_name(largest)
            one, other = cell_name(largest.one), cell_name(largest.other)
            cells = (name, count, place, _code(one), _code(other))
            yield f"| {' | '.join(cells)} |"


def _conditions(found: Comparison) -> Iterator[str]:
    met = found.met
    if met is None or not met.pairs:
        return
    yield from ("", "| condition | order | first | second |", "|---|---|---|---|")
    for one, other in met.pairs:
        tree = _code(format_tree(one.tree, found.one.tableau.size > 1))
        first = "met" if one.holds else "not met"
        second = "met" if other.holds else "not met"
        yield f"| {tree} | {one.tree.order} | {first} | {second} |"


def _properties(found: Comparison) -> Iterator[str]:
    if not found.properties:
        return
    yield from ("", "| property | first | second |", "|---|---|---|")
    for pair in found.properties:
        one, other = verdict_name(pair.one), verdict_name(pair.other)
        yield f"| `{pair.key}` | {_cell(one)} | {_cell(other)} |"


def _cell(text: str) -> str:
    """A text in which nothing ends the cell."""
    return printable(text).replace("|", r"\|")


def _code(text: str) -> str:
    """A text as code."""
    return f"`{_cell(text).replace('`', chr(39))}`"
