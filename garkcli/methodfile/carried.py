"""What a method file says besides the coefficients, for files that are made from it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import yaml
from yaml.nodes import MappingNode, Node, ScalarNode

from garkcli.methodfile.build import MethodFile
from garkcli.methodfile.source import Source

_WIDTH = 110


def lines_of(method: MethodFile, keys: Sequence[str]) -> str:
    r"""The lines of some keys as they stand in the file of a method; empty where it has none.

    >>> from garkcli.methodfile.load import loads
    >>> euler = loads("{A: [[0]], b: [1], reference: L. Euler 1768, expect: {order: 1}}")
    >>> lines_of(euler, ["description", "reference"])
    'reference: L. Euler 1768\n'
    """
    return _lines([x for x in _entries(method) if x[0].value in keys])


def claim_lines(method: MethodFile, names: Mapping[str, str]) -> str:
    """The lines of ``expect`` with some of the claims of a method.

    Args:
        method: the file.
        names: the claims that are kept, with what they are called now.
    """
    for key, claims in _entries(method):
        if key.value == "expect" and isinstance(claims, MappingNode):
            kept: list[tuple[Node, Node]] = []
            for name, value in claims.value:
                if name.value in names:
                    renamed = ScalarNode(name.tag, names[name.value])
                    kept.append((renamed, value))
            if kept:
                return _lines([(key, _mapping(kept))])
    return ""


def parameter_names(text: str, source: str) -> list[str]:
    """The parameters that the text of a file names; none where it is not readable as YAML.

    >>> parameter_names("{parameters: {t: free}, A: [[t]], b: [1]}", "it")
    ['t']
    """
    root = Source(source, text).compose()
    if not isinstance(root, MappingNode):
        return []
    for key, value in root.value:
        if key.value == "parameters" and isinstance(value, MappingNode):
            return [str(name.value) for name, _ in value.value]
    return []


def _entries(method: MethodFile) -> list[tuple[Node, Node]]:
    root = Source(method.source, method.text).compose()
    if root is None:
        raise ValueError("the text of a method file")
    return list(root.value)


def _mapping(entries: list[tuple[Node, Node]]) -> MappingNode:
    return MappingNode("tag:yaml.org,2002:map", entries, flow_style=False)


def _lines(entries: list[tuple[Node, Node]]) -> str:
    if not entries:
        return ""
    text = yaml.serialize(_mapping(entries), allow_unicode=True, width=_WIDTH)
    return str(text)
