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
    letter = found["letter"].lower()
    colours = found["colours"].split(",") if found["colours"] else []
    # one value in place of a row of one is its only entry
    indices = [found["entry"] or "1"]
    if letter == "a":
        indices.insert(0, found["row"] or "1")
    groups = [letter + _together(colours), _together(indices)]
    name = "_".join(groups) if colours else "".join(groups)
    return f"{found['part']}_{name}" if found["part"] else name


def is_bare_unknown(node: Node) -> bool:
    """Whether a ? stands there without quotes, which YAML takes for the sign of a key."""
    if not isinstance(node, MappingNode) or len(node.value) != 1:
        return False
    return all(
        isinstance(x, ScalarNode) and not x.value for x in node.value[0]
    )


def _together(indices: _Indices) -> str:
    """Indices one after the other, with _ between them where one has two digits."""
    is_plain = all(len(index) == 1 for index in indices)
    return ("" if is_plain else "_").join(indices)
