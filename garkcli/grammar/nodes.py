"""YAML text to nodes with positions, by PyYAML's parser in Python, within limits.

Nodes keep what ``safe_load`` loses: the positions of values, repeated keys, and the text of
numbers. PyYAML's loader in C has other messages and columns, and a file should be answered alike on
every machine.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from itertools import chain
from typing import Any, TypeAlias

import yaml
from yaml.nodes import MappingNode as MappingNode
from yaml.nodes import Node as Node
from yaml.nodes import ScalarNode as ScalarNode
from yaml.nodes import SequenceNode as SequenceNode

from garkcli.errors import Remark, nearest, printable

Extent: TypeAlias = tuple[int, int]


def keys_of(node: Node) -> set[str]:
    if not isinstance(node, MappingNode):
        return set()
    return {key.value for key, _ in node.value if isinstance(key, ScalarNode)}


def key_nodes(node: Node) -> dict[str, ScalarNode]:
    nodes: dict[str, ScalarNode] = {}
    for key, _ in node.value if isinstance(node, MappingNode) else ():
        if isinstance(key, ScalarNode):
            nodes.setdefault(str(key.value), key)
    return nodes


def below(root: object, *path: str | int) -> Node | None:
    """The value below keys of mappings and indices of lists; None if there is none."""
    node: Node | None = root if isinstance(root, Node) else None
    for step in path:
        if isinstance(node, MappingNode) and isinstance(step, str):
            values = [
                x for key, x in node.value if isinstance(key, ScalarNode) and key.value == step
            ]
        elif isinstance(node, SequenceNode) and isinstance(step, int):
            values = node.value[step : step + 1]
        else:
            return None
        node = values[0] if values else None
    return node


def key_of(root: MappingNode, value: Node) -> Node:
    key_node: Node = next(key for key, other in root.value if other is value)
    return key_node


def extent(text: str, first: Node, last: Node) -> Extent:
    """The places of the first and last character, without blanks at the end."""
    start, end = first.start_mark.index, last.end_mark.index
    return start, start + len(text[start:end].rstrip())


def node_at(value: object, place: Node) -> Node:
    marks = place.start_mark, place.end_mark
    if isinstance(value, Mapping):
        pairs = [(node_at(key, place), node_at(x, place)) for key, x in value.items()]
        return MappingNode("tag:yaml.org,2002:map", pairs, *marks)
    if isinstance(value, (list, tuple)):
        return SequenceNode("tag:yaml.org,2002:seq", [node_at(x, place) for x in value], *marks)
    return value if isinstance(value, Node) else ScalarNode("tag:yaml.org,2002:str", value, *marks)


def is_null(node: Node) -> bool:
    return isinstance(node, ScalarNode) and node.tag == "tag:yaml.org,2002:null"


def meant_key(key: str, known: Sequence[str], words: Mapping[str, str]) -> str:
    """The known key meant by an unknown one; empty if there is none."""
    return words.get(key.lower(), "") or nearest(key, known)


def one_line(text: str) -> str:
    r"""A text in one line of printable characters.

    >>> one_line("Gauss 2\n  and \x1b more")
    'Gauss 2 and more'
    """
    words = "".join([x if x.isprintable() else " " for x in text]).split()
    return " ".join(words)


def unquoted(name: str) -> str:
    shown = shortened(name)
    is_word = name.isidentifier() or not name
    return shown[1:-1] if is_word else shown


def shortened(text: str, length: int = 60) -> str:
    if len(text) > length:
        text = text[:length] + "…"
    return repr(text)


MAX_NODES = 50_000
MAX_NESTING = 12


def position(mark: Any) -> tuple[int, int]:
    if mark is None:
        return 1, 1
    return mark.line + 1, mark.column + 1


class TooLargeError(Exception):
    def __init__(self, at: Node | yaml.Event, message: str, cure: str) -> None:
        super().__init__(message)
        self.line, self.column = position(at.start_mark)
        self.message, self.cure = message, cure


class _Composer(yaml.SafeLoader):
    """Refuses too many values and too deep nesting."""

    def __init__(self, text: str) -> None:
        super().__init__(text)
        self._depth = 0
        self._count = 0

    def _next_event(self) -> yaml.Event:
        event: yaml.Event = self.peek_event()  # type: ignore[no-untyped-call]
        return event

    def compose_node(self, parent: Node | None, index: int) -> Node | None:
        self._count += 1
        if self._count > MAX_NODES:
            raise TooLargeError(self._next_event(), _TOO_MANY, "no method needs that")
        if self._depth >= MAX_NESTING:
            event = self._next_event()
            if isinstance(event, (yaml.SequenceStartEvent, yaml.MappingStartEvent)):
                raise TooLargeError(event, _TOO_DEEP, "no file needs that")
        self._depth += 1
        node: Node | None = super().compose_node(parent, index)
        self._depth -= 1
        return node


_TOO_DEEP = f"nested more than {MAX_NESTING} deep"
_TOO_MANY = f"more than {MAX_NODES} values in one file"
_SIGN = "quote a text that begins with this sign"
_ALIGN = "align the keys and the dashes of one list"
_YAML_WORDS = (
    (r"character '\\t'", "a tab where a value or a key begins", "indent with spaces, not tabs"),
    ("character (.+) that cannot start", "no text begins with {}", _SIGN),
    (
        "mapping values are not allowed",
        "no key ends at this colon",
        "quote a text that holds a colon, and align the keys",
    ),
    ("mapping keys are not allowed", "no text begins with '?'", _SIGN),
    ("sequence entries are not allowed", "no item begins at this dash", _ALIGN),
    ("expected ':'", "a colon is missing after the key", "write key: value"),
    (r"block end>, but found ('[\]}]')", "{} closes no bracket", "leave it out"),
    ("block end>", "this belongs to no list or mapping before it", _ALIGN),
    (r"expected ',' or ('[\]}]')", "a comma or {} is missing", "put commas between the values"),
    ("node content", "a value is missing", "write one, or quote a text that begins with this sign"),
    (
        "undefined alias '(.+)'",
        "*{0} stands for a value &{0}, which is missing",
        "define it first as &{0}, or quote the text",
    ),
    ("duplicate anchor '(.+)'", "&{} has two values", "give every anchor a name of its own"),
    (
        "another document|document (start|separator)",
        "another document begins",
        "give every method a file of its own",
    ),
    ("unexpected end of stream", "the quotation mark is open", "close it"),
    (
        "escape",
        "no sign is written so after a backslash",
        r"write \\ for a backslash, or put the text between single quotation marks",
    ),
    (
        "indentation indicator|line break",
        "the line does not end after | or >",
        "begin the text on the next line, or quote it",
    ),
    ("alphabetic or numeric", "a name is missing after this sign", _SIGN),
    ("", "the directive or tag is not known", "leave it out, or quote a text with % or !"),
)
_FROM_START = ("could not find expected ':'", "found unexpected end of stream")
"""Messages about the start of what PyYAML reads, not about where it gives up."""


def yaml_fault(error: yaml.MarkedYAMLError) -> Remark:
    mark = error.problem_mark or error.context_mark
    context = str(error.context or "")
    problem = str(error.problem or context)
    if context.startswith("found "):  # here the context says what is wrong
        problem = context.partition(";")[0]
    if problem in _FROM_START and error.context_mark:
        mark = error.context_mark
    matches = ((re.search(pattern, problem), words) for pattern, *words in _YAML_WORDS)
    match, words = next((match, words) for match, words in matches if match)
    message, cure = (x.format(*match.groups()) for x in words)
    if re.search("parsing a flow (sequence|mapping)", context) and error.context_mark:
        line, column = position(error.context_mark)
        cure = (
            f"the bracket at {line}:{column} is open: close it, and put commas between its values"
        )
    message = printable(f"this is not YAML: {message}")
    return Remark(message, printable(cure), *position(mark), code="not-yaml")


def composed(text: str) -> Node | Remark | None:
    """The document or its fault; None if the text is empty."""
    try:
        return compose(text)
    except TooLargeError as error:
        return Remark(error.message, error.cure, error.line, error.column, code="file-too-large")
    except yaml.MarkedYAMLError as error:
        return yaml_fault(error)
    except yaml.YAMLError as error:
        sign = getattr(error, "character", "")
        if isinstance(sign, int) and 0xD800 <= sign <= 0xDFFF:
            message = "half a sign, which no text has"
            cure, code = "write the text as Unicode", "not-utf8"
        else:
            shown = f"U+{sign:04X}" if isinstance(sign, int) else repr(sign)
            message = f"this is not YAML: it has the control character {shown}"
            cure, code = "leave the control character out", "not-yaml"
        return Remark(message, cure, *place_of_sign(text, sign), code=code)


def compose(text: str) -> Node | None:
    """The document within the limits; None if the text is empty."""
    composer = _Composer(text)
    try:
        root: Node | None = composer.get_single_node()
    finally:
        composer.dispose()
    if root is not None:
        _walk(root)
    return root


def _walk(root: Node) -> None:
    """Counts each value at every use, so that aliases cannot multiply work unnoticed."""
    count = 0
    pending: list[tuple[Node, int]] = [(root, 1)]
    while pending:
        node, depth = pending.pop()
        count += 1
        if count > MAX_NODES:
            raise TooLargeError(root, _TOO_MANY, "aliases count each time")
        if depth > MAX_NESTING:
            raise TooLargeError(node, _TOO_DEEP, "no file needs that; or an anchor contains itself")
        if not isinstance(node, ScalarNode):
            is_mapping = isinstance(node, MappingNode)
            children = chain.from_iterable(node.value) if is_mapping else node.value
            pending += [(child, depth + 1) for child in children]


def folded_place(text: str, node: ScalarNode, offset: int) -> tuple[int, int]:
    """The line and column of character ``offset`` of a folded value."""
    position = node.start_mark.index
    if node.style in {"|", ">"}:
        line_end = text.find("\n", position)
        position = len(text) if line_end < 0 else line_end
    elif node.style:
        position += 1
    for sign in node.value[:offset]:
        after = position if sign.isspace() else text.find(sign, position) + 1
        if not after:  # written as an escape
            break
        position = after
    while position < len(text) and text[position].isspace():
        position += 1
    return _line_and_column(text, position)


def place_of_sign(text: str, sign: object) -> tuple[int, int]:
    """The first refused character; one at the start marks the encoding."""
    code = ord(sign) if isinstance(sign, str) and len(sign) == 1 else sign
    position = 0
    if isinstance(code, int):
        start = 1 if text.startswith("\ufeff") else 0
        position = max(text.find(chr(code), start), 0)
    return _line_and_column(text, position)


def _line_and_column(text: str, position: int) -> tuple[int, int]:
    return text.count("\n", 0, position) + 1, position - text.rfind("\n", 0, position)
