"""YAML as text: nodes and values written, and files edited in place."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from typing import TypeAlias

import yaml

from garkcli.grammar.nodes import MappingNode, Node, ScalarNode, SequenceNode, extent

_WIDTH = 110


def row_text(numbers: Iterable[str]) -> str:
    return f"[{', '.join(map(number_text, numbers))}]"


def number_text(number: str) -> str:
    """The comma of root(x, n) needs quotes in a list."""
    return quoted(number) if "," in number else number


def quoted(text: str) -> str:
    escaped = text.replace("\\", "\\\\").replace('"', '\\"')
    inside = "".join(x if x.isprintable() else f"\\U{ord(x):08x}" for x in escaped)
    return f'"{inside}"'


def in_ascii(text: str) -> str:
    r"""YAML with the same values in ASCII; only quoted scalars can have escapes.

    >>> print(in_ascii("title: näher\nb: 'ö'\n"), end="")
    title: "n\U000000e4her"
    b: "\U000000f6"
    """
    pieces: list[str] = []
    place = 0
    for token in yaml.scan(text):
        start, end = token.start_mark.index, token.end_mark.index
        if not isinstance(token, yaml.ScalarToken) or token.style == '"':
            continue
        if not text[start:end].isascii():
            is_block = text[start] in "|>"
            pieces += [text[place:start], quoted(token.value), "\n" * is_block]
            place = end
    made = "".join([*pieces, text[place:]])
    return "".join(x if x.isascii() else f"\\U{ord(x):08x}" for x in made)


def block_mapping(entries: list[tuple[Node, Node]]) -> MappingNode:
    return MappingNode("tag:yaml.org,2002:map", entries, flow_style=False)


def block_text(entries: list[tuple[Node, Node]]) -> str:
    mapping = block_mapping(entries)
    return str(yaml.serialize(mapping, allow_unicode=True, width=_WIDTH)) if entries else ""


def mapping_under(root: MappingNode, name: str) -> MappingNode | None:
    mappings = (x for key, x in root.value if key.value == name and isinstance(x, MappingNode))
    return next(mappings, None)


INDENT = "  "
Edit: TypeAlias = tuple[int, int, str]


def with_values(text: str, root: MappingNode, name: str, values: Mapping[str, str]) -> str | None:
    """Returns the text with values below a key; other keys stay, new ones follow the last one. None
    if there is no place for a new mapping: the file is in braces or has an empty one.
    """
    there = mapping_under(root, name)
    if there is None or not there.value:
        is_open = there is None and not root.flow_style
        return _with_block(text, root, name, values) if is_open else None
    edits = [*_replacements(text, there, values), *_additions(text, there, values)]
    # from the last to the first: places before an edit stay where they are
    for start, end, new in sorted(edits, reverse=True):
        text = text[:start] + new + text[end:]
    return text


def _with_block(text: str, root: MappingNode, name: str, values: Mapping[str, str]) -> str:
    if not values:
        return text
    # below the last key and comment, before ... of YAML, as far in as the keys are
    end = root.end_mark.index
    before, after = text[:end], text[end:]
    line_end = _line_end(text)
    margin = " " * root.start_mark.column
    lines = [f"{name}:", *(f"{INDENT}{key}: {value}" for key, value in values.items())]
    block = "".join(margin + line + line_end for line in lines)
    return before + ("" if before.endswith("\n") else line_end) + block + after


def _replacements(text: str, there: MappingNode, values: Mapping[str, str]) -> Iterator[Edit]:
    for key, node in there.value:
        value = values.get(key.value)
        is_plain = isinstance(node, ScalarNode)
        if value is None or (is_plain and node.value == value.strip('"')):
            continue
        start, _ = extent(text, node, node)
        yield start, _end(text, node), value


def _additions(text: str, there: MappingNode, values: Mapping[str, str]) -> Iterator[Edit]:
    """Yields the new keys, in braces or on lines below the last key."""
    known = {key.value for key, _ in there.value}
    new = [f"{key}: {x}" for key, x in values.items() if key not in known]
    first, _ = there.value[0]
    _, last = there.value[-1]
    end = _end(text, last)
    if not new:
        return
    if there.flow_style:
        yield end, end, "".join(f", {x}" for x in new)
        return
    margin = _line_end(text) + " " * first.start_mark.column
    line_end = text.find(_line_end(text), end)
    place = len(text) if line_end < 0 else line_end
    yield place, place, "".join(margin + x for x in new)


def _line_end(text: str) -> str:
    return "\r\n" if "\r\n" in text else "\n"


def _end(text: str, node: Node) -> int:
    """The end of a value, before comments below a block list."""
    while isinstance(node, SequenceNode) and node.value:
        if node.flow_style:
            break
        node = node.value[-1]
    _, end = extent(text, node, node)
    return end
