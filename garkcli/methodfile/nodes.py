"""What nodes of YAML hold: their keys, null, where they stand in the text."""

from __future__ import annotations

from typing import TypeAlias

from yaml.nodes import MappingNode, Node, ScalarNode

Extent: TypeAlias = tuple[int, int]
"""From where to where something stands in the text of a file."""


def keys_of(node: Node) -> set[str]:
    """The keys of a mapping that are plain texts; none for anything else."""
    if not isinstance(node, MappingNode):
        return set()
    return {key.value for key, _ in node.value if isinstance(key, ScalarNode)}


def key_nodes(node: Node) -> dict[str, ScalarNode]:
    """Where the keys of a mapping stand, the first of equal ones."""
    found: dict[str, ScalarNode] = {}
    for key, _ in node.value if isinstance(node, MappingNode) else ():
        if isinstance(key, ScalarNode):
            found.setdefault(str(key.value), key)
    return found


def key_of(root: MappingNode, value: Node) -> Node:
    """The key of a value, as it stands in the file."""
    for key, other in root.value:
        if other is value:
            found: Node = key
            return found
    raise LookupError("the value is none of the mapping")


def extent(text: str, first: Node, last: Node) -> Extent:
    """From where to where in the text of a file the values from ``first`` to ``last`` stand,
    without the blanks after them.
    """
    start, end = first.start_mark.index, last.end_mark.index
    written = text[start:end].rstrip()
    return start, start + len(written)


def is_null(node: Node) -> bool:
    """Whether the value is YAML's null."""
    return isinstance(node, ScalarNode) and node.tag == "tag:yaml.org,2002:null"
