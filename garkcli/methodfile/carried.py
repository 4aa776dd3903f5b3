"""Files made from the text of another: the conjugate, other claims, keys that are kept."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from garkcli.errors import MethodFileError, Remark
from garkcli.glossary.key import METHOD_FILE
from garkcli.grammar.editing import block_mapping, block_text, mapping_under, with_values
from garkcli.grammar.nodes import MappingNode, Node, ScalarNode, SequenceNode
from garkcli.grammar.source import Source
from garkcli.methodfile.build import MethodFile
from garkcli.methodfile.description import BESIDE


def lines_of(method: MethodFile, keys: Sequence[str]) -> str:
    r"""The lines of some keys as they are in the file of a method.

    >>> from garkcli.methodfile.load import loads
    >>> euler = loads("{A: [[0]], b: [1], reference: L. Euler 1768, expect: {order: 1}}")
    >>> lines_of(euler, ["description", "reference"])
    'reference: L. Euler 1768\n'
    """
    return block_text([x for x in _entries(method) if x[0].value in keys])


def claim_lines(method: MethodFile, names: Mapping[str, str]) -> str:
    for key, claims in _entries(method):
        if key.value == "expect" and isinstance(claims, MappingNode):
            kept: list[tuple[Node, Node]] = [
                (ScalarNode(name.tag, names[name.value]), value)
                for name, value in claims.value
                if name.value in names
            ]
            return block_text([(key, block_mapping(kept))]) if kept else ""
    return ""


def parameter_names(text: str, source: str) -> list[str]:
    root = Source(source, text, METHOD_FILE).compose()
    parameters = None if root is None else mapping_under(root, "parameters")
    return [] if parameters is None else [str(name.value) for name, _ in parameters.value]


def is_transformed(method: MethodFile) -> bool:
    """Whether a Rosenbrock method is written in transformed form, as in programs."""
    root = Source(method.source, method.text, METHOD_FILE).compose()
    form = None if root is None else mapping_under(root, "rosenbrock")
    return form is not None and mapping_under(form, "transformed") is not None


def _entries(method: MethodFile) -> list[tuple[Node, Node]]:
    root = Source(method.source, method.text, METHOD_FILE).compose()
    assert root is not None
    return list(root.value)


_DROPPED = (*("expect", "conjugate", "name", "aliases", "description"), *BESIDE)


def write_conjugate_of(method: MethodFile, name: str) -> str:
    """``conjugate: true`` is added, or removed: exact for every method.

    Claims, the description, embedded and dense weights are about the other method, and dropped.
    """
    kept = [(key, _without_further(x)) for key, x in _entries(method) if key.value not in _DROPPED]
    kept = [(key, x) for key, x in kept if key.value != "tolerance" or x.value]
    title: tuple[Node, Node] = (_scalar("name"), _scalar(name))
    added: tuple[Node, Node] = (_scalar("conjugate"), ScalarNode("tag:yaml.org,2002:bool", "true"))
    return block_text([title, *kept, *([] if method.is_conjugate else [added])])


def _without_further(node: Node) -> Node:
    if isinstance(node, SequenceNode):
        items = [_without_further(item) for item in node.value]
        return SequenceNode(node.tag, items, flow_style=node.flow_style)
    if not isinstance(node, MappingNode):
        return node
    kept = [(key, _without_further(x)) for key, x in node.value if key.value not in BESIDE]
    return MappingNode(node.tag, kept, flow_style=node.flow_style)


def _scalar(text: str) -> ScalarNode:
    return ScalarNode("tag:yaml.org,2002:str", text)


def write_claims(source: str, text: str, claims: Mapping[str, str]) -> str:
    r"""The text with other claims; MethodFileError if it is one line in braces, to which nothing
    can be added.

    >>> print(write_claims("a file", "A: [[0]]\nb: [1]", {"order": "1"}))
    A: [[0]]
    b: [1]
    expect:
      order: 1
    <BLANKLINE>
    """
    root = Source(source, text, METHOD_FILE).compose()
    assert isinstance(root, MappingNode)
    edited = with_values(text, root, "expect", claims)
    if edited is None:
        fault = Remark(
            "the claims have no place in this file",
            "write keys below one another, without braces, and no expect: {}",
            code="no-place-for-claims",
        )
        raise MethodFileError(source, [fault], text)
    return edited
