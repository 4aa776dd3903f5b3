"""The file of a method as that of its symplectic conjugate, by the key ``conjugate: true``."""

from __future__ import annotations

import yaml
from yaml.nodes import MappingNode, Node, ScalarNode, SequenceNode

from garkcli.methodfile.build import MethodFile
from garkcli.methodfile.description import BESIDE
from garkcli.methodfile.source import Source

_DROPPED = (*("expect", "conjugate", "name", "aliases", "description"), *BESIDE)


def write_conjugate_of(method: MethodFile, name: str) -> str:
    """The file of ``method`` with ``conjugate: true`` added, or taken away where it stands.

    Exact for every method: nothing is spelled out. Claims and description are left behind, as they
    are about the other method, and so are weights that only the method itself has.
    """
    root = Source(method.source, method.text).compose()
    if root is None:
        raise ValueError("the text of a method file")
    title: tuple[Node, Node] = (_scalar("name"), _scalar(name))
    entries = [title]
    for key, value in root.value:
        if key.value not in _DROPPED:
            kept = _without_further(value)
            entries.append((key, kept))
    if not method.is_conjugate:
        true = ScalarNode("tag:yaml.org,2002:bool", "true")
        entries.append((_scalar("conjugate"), true))
    mapping = MappingNode(root.tag, entries, flow_style=False)
    return str(yaml.serialize(mapping, allow_unicode=True, width=110))


def _without_further(node: Node) -> Node:
    """The node without embedded weights and dense output in the mappings of it."""
    if isinstance(node, SequenceNode):
        items = [_without_further(item) for item in node.value]
        return SequenceNode(node.tag, items, flow_style=node.flow_style)
    if not isinstance(node, MappingNode):
        return node
    kept = []
    for key, value in node.value:
        if key.value not in BESIDE:
            kept.append((key, _without_further(value)))
    return MappingNode(node.tag, kept, flow_style=node.flow_style)


def _scalar(text: str) -> ScalarNode:
    return ScalarNode("tag:yaml.org,2002:str", text)
