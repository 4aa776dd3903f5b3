"""Tables of TOML as nodes, so that the grammar of files reads them too."""

from __future__ import annotations

import re
from types import SimpleNamespace
from typing import Any

import yaml

from garkcli.grammar.keys import FILE, ReadMapping, ValueKind
from garkcli.grammar.nodes import MappingNode, Node, ScalarNode, SequenceNode
from garkcli.grammar.source import Source

HEAD = re.compile(r"^[ \t]*\[[ \t]*tool[ \t]*\.[ \t]*gark[ \t]*\]", re.MULTILINE)
BEFORE = r"(?:tool[ \t]*\.[ \t]*)?gark[ \t]*\.[ \t]*"
TAG = "tag:yaml.org,2002:"
QUOTED = f"{TAG}str"
DEEPEST = 2


def read_settings(
    source: Source, table: dict[str, Any], kind: ValueKind, where: str
) -> ReadMapping:
    """The values of a table, each at the first line with its key: TOML gives no positions."""
    is_whole = where == FILE
    head = None if is_whole else HEAD.search(source.text)
    start = head.end() if head else 0
    before = "" if head or is_whole else BEFORE

    places = _places(source.text, before, start)
    top = yaml.Mark("", 0, 0, 0, None, 0)

    def node(value: Any, mark: yaml.Mark, depth: int = 0) -> Node:
        if isinstance(value, dict):
            inside = value if depth <= DEEPEST else {}
            marks = {key: places.get(key, top) for key in inside}
            pairs = [
                (node(key, marks[key]), node(x, marks[key], depth + 1)) for key, x in inside.items()
            ]
            return MappingNode("", pairs, mark, mark)
        if isinstance(value, list):
            items = value if depth <= DEEPEST else []
            return SequenceNode("", [node(x, mark, depth + 1) for x in items], mark, mark)
        shown = str(value).lower() if isinstance(value, bool) else str(value)
        return ScalarNode(f"{TAG}{type(value).__name__}", shown, mark, mark)

    settings: ReadMapping = kind.read(SimpleNamespace(source=source), node(table, top), where)
    return settings


def _places(text: str, before: str, start: int) -> dict[str, yaml.Mark]:
    """The first line with each key, behind the pattern ``before``."""
    places: dict[str, yaml.Mark] = {}
    line, seen = 0, 0
    pattern = re.compile(rf"^[ \t]*[\"']?{before}([^\n=\"']*+)[\"']?[ \t]*=", re.MULTILINE)
    for match in pattern.finditer(text, start):
        line += text.count("\n", seen, match.start())
        seen = match.start()
        places.setdefault(match[1].rstrip(), yaml.Mark("", seen, line, 0, None, 0))
    return places
