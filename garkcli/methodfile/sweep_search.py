"""What a spec file says of the searches for unknowns that it gives no values."""

from __future__ import annotations

import re
from dataclasses import dataclass

from yaml.nodes import Node, ScalarNode

from garkcli.methodfile.source import Source
from garkcli.methodfile.sweep_text import one_or_more
from garkcli.methodfile.words import shortened

KEYS = ("seeds", "starts", "order")
STARTS = 20
"""Starts of a seed, where nothing is said."""
FREE = "free"
"""The value of a parameter that is left to the search."""
_SPAN = re.compile(r"([0-9]{1,9})\.\.([0-9]{1,9})")


@dataclass(frozen=True)
class SearchText:
    """How methods are searched for.

    Attributes:
        seeds: one row each.
        starts: from which each of them looks.
        order: that is wanted; 0 for the order that the file wants.
    """

    seeds: range
    starts: int = STARTS
    order: int = 0


def read_search(source: Source, node: Node) -> SearchText | None:
    """Read ``search``; None where it is faulty.

    Args:
        source: the spec file.
        node: the value of the key.
    """
    form = "write {seeds: 1..100, starts: 20}"
    entries = source.mapping(node, "search", KEYS, form=form)
    if "seeds" not in entries:
        source.fault(node, "search: seeds missing", form)
        return None
    seeds = _seeds(source, entries["seeds"])
    numbers = {"starts": STARTS, "order": 0}
    for key in numbers.keys() & entries.keys():
        found = source.whole(entries[key], f"search, {key}", 1)
        numbers[key] = found or 0
    return None if seeds is None else SearchText(seeds, **numbers)


def _seeds(source: Source, node: Node) -> range | None:
    """A number, or a range of numbers."""
    text = node.value if isinstance(node, ScalarNode) else ""
    span = _SPAN.fullmatch(text)
    if span is None:
        seed = source.whole(node, "search, seeds")
        return None if seed is None else range(seed, seed + 1)
    first, last = int(span[1]), int(span[2])
    if first > last:
        message = f"search, seeds: {shortened(text)} is no range"
        source.fault(node, message, "write 1..100")
        return None
    return range(first, last + 1)


def is_free(node: Node) -> bool:
    """Whether a parameter is left to the search."""
    values = one_or_more(node)
    return [x.value for x in values] == [FREE]
