"""Entries of a tableau that are unknown: ``"?"``, an unknown of its own named by its place."""

from __future__ import annotations

import re
from typing import TypeAlias

from yaml.nodes import MappingNode, Node, ScalarNode

UNKNOWN = "?"
"""What stands in a file for a coefficient that is not known."""
_PLACE = re.compile(
    r"(?:(?P<part>[qp])\.)?(?P<letter>[Abc])(?:\^\{(?P<colours>[0-9,]+)\})?"
    r"(?:, row (?P<row>[0-9]+))?(?:, entry (?P<entry>[0-9]+))?"
)
_Indices: TypeAlias = list[str]


def name_of_place(where: str) -> str | None:
    """The name of the unknown at a place, as messages call it; None where there is none.

    Numbers of ten and more are kept apart by ``_``.

    >>> name_of_place("A, row 2, entry 1"), name_of_place("A^{1,2}, row 3, entry 1")
    ('a21', 'a12_31')
    >>> name_of_place("b^{2}, entry 1"), name_of_place("q.A, row 10, entry 2")
    ('b2_1', 'q_a10_2')
    """
    found = _PLACE.fullmatch(where)
    if found is None:
        return None
    part, letter, colours, row, entry = found.groups()
    letter = letter.lower()
    # one value in place of a row of one is its only entry
    indices = [entry or "1"]
    if letter == "a":
        indices = [row or "1", *indices]
    name = letter
    if colours:
        name += _together(colours.split(",")) + "_"
    name += _together(indices)
    return f"{part}_{name}" if part else name


def is_bare_unknown(node: Node) -> bool:
    """Whether a ? stands there without quotes, which YAML takes for the sign of a key."""
    if not isinstance(node, MappingNode) or len(node.value) != 1:
        return False
    key, value = node.value[0]
    return _is_empty(key) and _is_empty(value)


def _is_empty(node: Node) -> bool:
    return isinstance(node, ScalarNode) and not node.value


def _together(indices: _Indices) -> str:
    """Indices one after the other, with _ between them where one has two digits."""
    join = ""
    if any(len(index) > 1 for index in indices):
        join = "_"
    return join.join(indices)
