"""YAML text to nodes with positions, by PyYAML's parser in Python, within limits.

Composing keeps what ``safe_load`` loses: where each value is, keys that occur twice, and the
text of a number as it was written. PyYAML's loader in Python is used whatever there is in C: the
two word their faults differently and count columns differently, and a file has to be met with the
same answer on every machine.
"""

from __future__ import annotations

import re
from itertools import chain
from typing import Any

import yaml
from yaml.nodes import MappingNode, Node, ScalarNode

from garkcli.errors import Remark, printable

MAX_NODES = 50_000
"""Most YAML values in one file, with aliases counted each time they are used."""
MAX_NESTING = 12
"""Deepest nesting of lists and mappings; files need six."""


def position(mark: Any) -> tuple[int, int]:
    """Line and column of a mark of PyYAML, from 1; those of the start where there is none."""
    if mark is None:
        return 1, 1
    return mark.line + 1, mark.column + 1


class TooLargeError(Exception):
    """A file beyond the limits: where, what there is too much of, and the cure."""

    def __init__(self, at: Node | yaml.Event, message: str, cure: str) -> None:
        super().__init__(message)
        self.line, self.column = position(at.start_mark)
        self.message, self.cure = message, cure


class _Composer(yaml.SafeLoader):
    """PyYAML's composer; it refuses too many values and too deep nesting as it meets them."""

    def __init__(self, text: str) -> None:
        super().__init__(text)
        self._depth = 0
        self._count = 0

    def _next_event(self) -> yaml.Event:
        event: yaml.Event = self.peek_event()  # type: ignore[no-untyped-call]
        return event

    def compose_node(self, parent: Node | None, index: int) -> Node | None:
        """One value and those in it."""
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
_YAML_CURES = (
    ("'\\t'", "indent with spaces, not with tabs"),
    ("mapping values are not allowed", "quote a text that holds a colon, and align the keys"),
    ("mapping keys are not allowed", "quote a text that begins with ?"),
    ("block end", "align the keys and the dashes of one list"),
    ("undefined alias", "define it first as &name, or quote the text"),
    ("cannot start any token", "quote a text that begins with this sign"),
    ("another document", "give every method a file of its own"),
    ("unexpected end of stream", "a quotation mark is open: close it"),
    ("expected alphabetic or numeric", "comments begin with #"),
    ("duplicate anchor", "give every anchor a name of its own"),
    ("undefined tag", "leave the tag out, or quote the text"),
)
"""What is behind the words of PyYAML."""


def yaml_fault(error: yaml.MarkedYAMLError) -> Remark:
    """What PyYAML complains about, where, and its cure."""
    mark = error.problem_mark or error.context_mark
    context = str(error.context or "")
    problem = str(error.problem or context)
    if context.startswith("found "):  # here the context says what is wrong
        problem = context.partition(";")[0]
    cure = next((cure for words, cure in _YAML_CURES if words in problem), "")
    if "parsing a flow" in context and error.context_mark:
        line, column = position(error.context_mark)
        cure = (
            f"the bracket at {line}:{column} is open: close it, and put commas between its values"
        )
    message = printable(f"this is not YAML: {problem}")
    return Remark(message, printable(cure), *position(mark), code="not-yaml")


def composed(text: str) -> Node | Remark | None:
    """The one document of a text, or what is wrong with it; None where there is nothing in it."""
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
            message = f"this is not YAML: {str(error).splitlines()[0]}"
            cure, code = "leave the control character out", "not-yaml"
        return Remark(message, cure, *place_of_sign(text, sign), code=code)


def compose(text: str) -> Node | None:
    """The one document of a text, within the limits; None where there is nothing in it."""
    composer = _Composer(text)
    try:
        root: Node | None = composer.get_single_node()
    finally:
        composer.dispose()
    if root is not None:
        _walk(root)
    return root


def _walk(root: Node) -> None:
    """Count every value as often as it is used, so that no alias multiplies work unseen."""
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
    """Where a value over several lines has its character ``offset``: YAML changes nothing but the
    space between.
    """
    position = node.start_mark.index
    if node.style in {"|", ">"}:
        line_end = text.find("\n", position)
        position = len(text) if line_end < 0 else line_end
    elif node.style:
        position += 1
    for sign in node.value[:offset]:
        found = position if sign.isspace() else text.find(sign, position) + 1
        if not found:  # written as an escape
            break
        position = found
    while position < len(text) and text[position].isspace():
        position += 1
    return _line_and_column(text, position)


def place_of_sign(text: str, sign: object) -> tuple[int, int]:
    """Where a sign that YAML refuses is first; one at the start of the text marks its bytes."""
    code = ord(sign) if isinstance(sign, str) and len(sign) == 1 else sign
    position = 0
    if isinstance(code, int):
        start = 1 if text.startswith("\ufeff") else 0
        position = max(text.find(chr(code), start), 0)
    return _line_and_column(text, position)


def _line_and_column(text: str, position: int) -> tuple[int, int]:
    return text.count("\n", 0, position) + 1, position - text.rfind("\n", 0, position)


MOST_LOOKED_AT = 20_000
"""Characters of a file that are examined."""
_READS = "gark import {file} reads it"
_PASTED = "gark new FILE --tableau - < {file} makes a method file of it"
_PROGRAMS = (
    ".c",
    ".h",
    ".cc",
    ".cpp",
    ".cxx",
    ".hpp",
    ".hh",
    ".cu",
    ".jl",
    ".py",
    ".f90",
    ".m",
    ".wl",
    ".rs",
    ".java",
)
_LOOKS: tuple[tuple[str, str], ...] = (
    (
        r"\\(begin|frac|dfrac|hline|sqrt)\b|\\\\\s*$",
        f"this looks like LaTeX: {_READS}, and in a method file write 1/2",
    ),
    (
        r"^[ \t]*([Abc]|b?hat|bt?|embedded):[-\[0-9]",
        "put a blank behind the colon: A: [[0, 0], [1/2, 0]]",
    ),
    (r"^[ \t]*//", "comments begin with #"),
    (r"^[ \t]*%", "comments begin with #"),
    (
        r"^[^:#\n]*\w[ \t]*=[ \t]*[\[({\w]",
        f"this looks like a program: {_READS}; a method file has A: in place of A =",
    ),
)
"""What a text has that is none of a method file, and the cure; the first that is found counts."""
_WITHOUT_KEYS: tuple[tuple[str, str], ...] = (
    (r"^[ \t]*([-+0-9/.]*[0-9][ \t]*[|│]|[|│][ \t]*[-+0-9])", _PASTED),
    (r"^[-+0-9/.]*,[-+0-9/., ]*$", f"this looks like CSV: {_READS}"),
    (r"\A[-+0-9/. \t\n]+\Z", _PASTED),
)
"""The same of a text that is read as YAML, but has no keys."""


def cure_of_foreign(text: str, name: str, is_yaml: bool) -> str:
    r"""What to do with a file that is no YAML mapping; empty where it looks like nothing known.

    Args:
        text: of the file.
        name: what it is called.
        is_yaml: whether it is YAML all the same, a text or a list.

    >>> cure_of_foreign("A = [0 0; 1/2 0];", "m.txt", True)
    'this looks like a program: gark import m.txt reads it; a method file has A: in place of A ='
    >>> cure_of_foreign("// rk4", "rk4.cpp", True)
    'this is a program: gark import rk4.cpp reads it'
    >>> cure_of_foreign("hello", "m.yaml", True)
    ''
    """
    if name.lower().endswith(_PROGRAMS):
        return f"this is a program: {_READS}".replace("{file}", printable(name))
    looked_at = text[:MOST_LOOKED_AT]
    looks = (*_LOOKS, *_WITHOUT_KEYS) if is_yaml else _LOOKS
    for pattern, cure in looks:
        if re.search(pattern, looked_at, re.MULTILINE):
            file = "FILE" if name.startswith("<") else printable(name)
            return cure.replace("{file}", file)
    return ""
