"""Files made from the text of another: the conjugate, other claims, keys that are kept."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import TypeAlias

import yaml
from yaml.nodes import MappingNode, Node, ScalarNode, SequenceNode

from garkcli.errors import MethodFileError, Remark
from garkcli.methodfile.build import MethodFile
from garkcli.methodfile.description import BESIDE
from garkcli.methodfile.nodes import extent
from garkcli.methodfile.source import Source

_WIDTH = 110


def lines_of(method: MethodFile, keys: Sequence[str]) -> str:
    r"""Returns the lines of some keys as they are in the file of a method; empty without them.

    >>> from garkcli.methodfile.load import loads
    >>> euler = loads("{A: [[0]], b: [1], reference: L. Euler 1768, expect: {order: 1}}")
    >>> lines_of(euler, ["description", "reference"])
    'reference: L. Euler 1768\n'
    """
    return _lines([x for x in _entries(method) if x[0].value in keys])


def claim_lines(method: MethodFile, names: Mapping[str, str]) -> str:
    """Returns the lines of ``expect`` for some of the claims of a method.

    ``names`` maps the claims that are kept to their new names.
    """
    for key, claims in _entries(method):
        if key.value == "expect" and isinstance(claims, MappingNode):
            kept: list[tuple[Node, Node]] = [
                (ScalarNode(name.tag, names[name.value]), value)
                for name, value in claims.value
                if name.value in names
            ]
            return _lines([(key, _mapping(kept))]) if kept else ""
    return ""


def parameter_names(text: str, source: str) -> list[str]:
    """Returns the parameters that the text of a file names; none if it is not YAML.

    >>> parameter_names("{parameters: {t: free}, A: [[t]], b: [1]}", "it")
    ['t']
    """
    root = Source(source, text).compose()
    parameters = None if root is None else _mapping_under(root, "parameters")
    return [] if parameters is None else [str(name.value) for name, _ in parameters.value]


def is_transformed(method: MethodFile) -> bool:
    """Returns whether a Rosenbrock method is written in transformed form, as in programs."""
    root = Source(method.source, method.text).compose()
    form = None if root is None else _mapping_under(root, "rosenbrock")
    return form is not None and _mapping_under(form, "transformed") is not None


def _entries(method: MethodFile) -> list[tuple[Node, Node]]:
    root = Source(method.source, method.text).compose()
    assert root is not None
    return list(root.value)


def _mapping(entries: list[tuple[Node, Node]]) -> MappingNode:
    return MappingNode("tag:yaml.org,2002:map", entries, flow_style=False)


def _lines(entries: list[tuple[Node, Node]]) -> str:
    mapping = _mapping(entries)
    return str(yaml.serialize(mapping, allow_unicode=True, width=_WIDTH)) if entries else ""


_DROPPED = (*("expect", "conjugate", "name", "aliases", "description"), *BESIDE)


def write_conjugate_of(method: MethodFile, name: str) -> str:
    """Returns the file of the method with ``conjugate: true`` added, or removed.

    This is exact for every method, as nothing is spelled out. Claims and the description are
    dropped, because they are about the other method, and so are embedded and dense weights.
    """
    kept = [(key, _without_further(x)) for key, x in _entries(method) if key.value not in _DROPPED]
    kept = [(key, x) for key, x in kept if key.value != "tolerance" or x.value]
    title: tuple[Node, Node] = (_scalar("name"), _scalar(name))
    added: tuple[Node, Node] = (_scalar("conjugate"), ScalarNode("tag:yaml.org,2002:bool", "true"))
    return _lines([title, *kept, *([] if method.is_conjugate else [added])])


def _without_further(node: Node) -> Node:
    """Returns the node without embedded weights and dense output in its mappings."""
    if isinstance(node, SequenceNode):
        items = [_without_further(item) for item in node.value]
        return SequenceNode(node.tag, items, flow_style=node.flow_style)
    if not isinstance(node, MappingNode):
        return node
    kept = [(key, _without_further(x)) for key, x in node.value if key.value not in BESIDE]
    return MappingNode(node.tag, kept, flow_style=node.flow_style)


def _scalar(text: str) -> ScalarNode:
    return ScalarNode("tag:yaml.org,2002:str", text)


INDENT = "  "
Edit: TypeAlias = tuple[int, int, str]
"""A place in a text and its new content."""


def write_claims(source: str, text: str, claims: Mapping[str, str]) -> str:
    r"""Returns the text of a method file with other claims.

    A claim in the file gets the new value; one without a new value stays. New claims follow the
    last one. Comments, blanks and everything else stay. Raises MethodFileError if the file is one
    line in braces, below which nothing can be added.

    >>> print(write_claims("a file", "A: [[0]]\nb: [1]", {"order": "1"}))
    A: [[0]]
    b: [1]
    expect:
      order: 1
    <BLANKLINE>
    """
    root = Source(source, text).compose()
    assert isinstance(root, MappingNode)
    expect = _mapping_under(root, "expect")
    if expect is None or not expect.value:
        return _with_block(source, text, root, expect, claims)
    edits = [*_replacements(text, expect, claims), *_additions(text, expect, claims)]
    # from the last to the first: places before an edit stay where they are
    for start, end, new in sorted(edits, reverse=True):
        text = text[:start] + new + text[end:]
    return text


def _mapping_under(root: MappingNode, name: str) -> MappingNode | None:
    found = (x for key, x in root.value if key.value == name and isinstance(x, MappingNode))
    return next(found, None)


def _with_block(
    source: str, text: str, root: MappingNode, empty: Node | None, claims: Mapping[str, str]
) -> str:
    """Returns a file without claims, with the claims added at the end."""
    if root.flow_style or empty is not None:
        fault = Remark(
            "the claims have no place in this file",
            "write keys below one another, without braces, and no expect: {}",
            code="no-place-for-claims",
        )
        raise MethodFileError(source, [fault], text)
    if not claims:
        return text
    # below the last key and comment, before ... of YAML, as far in as the keys are
    end = root.end_mark.index
    before, after = text[:end], text[end:]
    line_end = _line_end(text)
    margin = " " * root.start_mark.column
    lines = ["expect:", *(f"{INDENT}{key}: {value}" for key, value in claims.items())]
    block = "".join(margin + line + line_end for line in lines)
    return before + ("" if before.endswith("\n") else line_end) + block + after


def _replacements(text: str, expect: MappingNode, claims: Mapping[str, str]) -> Iterator[Edit]:
    """Yields the edits for claims that are in the file."""
    for key, node in expect.value:
        value = claims.get(key.value)
        is_plain = isinstance(node, ScalarNode)
        if value is None or (is_plain and node.value == value.strip('"')):
            continue
        start, _ = extent(text, node, node)
        yield start, _end(text, node), value


def _additions(text: str, expect: MappingNode, claims: Mapping[str, str]) -> Iterator[Edit]:
    """Yields the edits for new claims after the last one, in braces or on lines below it."""
    there = {key.value for key, _ in expect.value}
    new = [f"{key}: {x}" for key, x in claims.items() if key not in there]
    first, _ = expect.value[0]
    _, last = expect.value[-1]
    end = _end(text, last)
    if not new:
        return
    if expect.flow_style:
        yield end, end, "".join(f", {x}" for x in new)
        return
    margin = _line_end(text) + " " * first.start_mark.column
    line_end = text.find(_line_end(text), end)
    place = len(text) if line_end < 0 else line_end
    yield place, place, "".join(margin + x for x in new)


def _line_end(text: str) -> str:
    return "\r\n" if "\r\n" in text else "\n"


def _end(text: str, node: Node) -> int:
    """Returns the end of a value; that of a block list is the end of its last entry, before
    comments below it.
    """
    while isinstance(node, SequenceNode) and node.value:
        if node.flow_style:
            break
        node = node.value[-1]
    _, end = extent(text, node, node)
    return end
