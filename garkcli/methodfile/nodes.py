"""What nodes of YAML hold and where they are; the words of a file, as shown, as meant."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TypeAlias

from yaml.nodes import MappingNode, Node, ScalarNode

from garkcli.errors import nearest

Extent: TypeAlias = tuple[int, int]
"""From where to where something is in the text of a file."""


def keys_of(node: Node) -> set[str]:
    """The keys of a mapping that are plain texts; none for anything else."""
    if not isinstance(node, MappingNode):
        return set()
    return {key.value for key, _ in node.value if isinstance(key, ScalarNode)}


def key_nodes(node: Node) -> dict[str, ScalarNode]:
    """Where the keys of a mapping are, the first of equal ones."""
    found: dict[str, ScalarNode] = {}
    for key, _ in node.value if isinstance(node, MappingNode) else ():
        if isinstance(key, ScalarNode):
            found.setdefault(str(key.value), key)
    return found


def key_of(root: MappingNode, value: Node) -> Node:
    """The key of a value, as it is in the file."""
    found: Node = next(key for key, other in root.value if other is value)
    return found


def extent(text: str, first: Node, last: Node) -> Extent:
    """From where to where in the text of a file the values from ``first`` to ``last`` are,
    without the blanks after them.
    """
    start, end = first.start_mark.index, last.end_mark.index
    return start, start + len(text[start:end].rstrip())


def is_null(node: Node) -> bool:
    """Whether the value is YAML's null."""
    return isinstance(node, ScalarNode) and node.tag == "tag:yaml.org,2002:null"


def meant_key(key: str, known: Sequence[str], words: Mapping[str, str]) -> str:
    """The key that an unknown one stands for; empty where it is none of them.

    Args:
        key: as it is written.
        known: the keys there are.
        words: what people call some of them besides.
    """
    return words.get(key.lower(), "") or nearest(key, known)


def one_line(text: str) -> str:
    r"""A name as it can be in a heading: blanks for line ends and for what a terminal would act
    on.

    >>> one_line("Gauss 2\n  and \x1b more")
    'Gauss 2 and more'
    """
    words = "".join([x if x.isprintable() else " " for x in text]).split()
    return " ".join(words)


def unquoted(name: str) -> str:
    """A name of the file, cut where it is long; in quotes where it is no plain word.

    >>> unquoted("tau"), unquoted("no name")
    ('tau', "'no name'")
    """
    shown = shortened(name)
    is_word = name.isidentifier() or not name
    return shown[1:-1] if is_word else shown


def shortened(text: str, length: int = 60) -> str:
    """``text`` in quotes, cut where it is long."""
    if len(text) > length:
        text = text[:length] + "…"
    return repr(text)
