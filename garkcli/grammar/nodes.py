"""YAML nodes: their content and their place; the words of a file in messages."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TypeAlias

from yaml.nodes import MappingNode as MappingNode
from yaml.nodes import Node as Node
from yaml.nodes import ScalarNode as ScalarNode
from yaml.nodes import SequenceNode as SequenceNode

from garkcli.errors import nearest

Extent: TypeAlias = tuple[int, int]
"""The start and the end of a place in the text of a file."""


def keys_of(node: Node) -> set[str]:
    """Returns the text keys of a mapping; none for other nodes."""
    if not isinstance(node, MappingNode):
        return set()
    return {key.value for key, _ in node.value if isinstance(key, ScalarNode)}


def key_nodes(node: Node) -> dict[str, ScalarNode]:
    """Returns the nodes of the keys of a mapping, the first of equal ones."""
    found: dict[str, ScalarNode] = {}
    for key, _ in node.value if isinstance(node, MappingNode) else ():
        if isinstance(key, ScalarNode):
            found.setdefault(str(key.value), key)
    return found


def key_of(root: MappingNode, value: Node) -> Node:
    found: Node = next(key for key, other in root.value if other is value)
    return found


def extent(text: str, first: Node, last: Node) -> Extent:
    """Returns the place of the values from ``first`` to ``last``, without blanks at the end."""
    start, end = first.start_mark.index, last.end_mark.index
    return start, start + len(text[start:end].rstrip())


def is_null(node: Node) -> bool:
    return isinstance(node, ScalarNode) and node.tag == "tag:yaml.org,2002:null"


def meant_key(key: str, known: Sequence[str], words: Mapping[str, str]) -> str:
    """Returns the known key meant by an unknown one; empty if there is none.

    ``words`` has other spellings.
    """
    return words.get(key.lower(), "") or nearest(key, known)


def one_line(text: str) -> str:
    r"""Returns a text in one line of printable characters.

    >>> one_line("Gauss 2\n  and \x1b more")
    'Gauss 2 and more'
    """
    words = "".join([x if x.isprintable() else " " for x in text]).split()
    return " ".join(words)


def unquoted(name: str) -> str:
    """Returns a name from the file, shortened if long, in quotes unless it is an identifier.

    >>> unquoted("tau"), unquoted("no name")
    ('tau', "'no name'")
    """
    shown = shortened(name)
    is_word = name.isidentifier() or not name
    return shown[1:-1] if is_word else shown


def shortened(text: str, length: int = 60) -> str:
    """Returns ``text`` in quotes, shortened if long."""
    if len(text) > length:
        text = text[:length] + "…"
    return repr(text)
