"""The keys of ``.gark.toml``, or of ``[tool.gark]`` in pyproject.toml, and their values."""

from __future__ import annotations

import re
from collections.abc import Iterable
from types import SimpleNamespace
from typing import Any

import yaml
from yaml.nodes import MappingNode, Node, ScalarNode, SequenceNode

from garkcli.methodfile import grammar as g
from garkcli.methodfile.expectations import CLAIMS
from garkcli.methodfile.nodes import shortened
from garkcli.methodfile.source import Source

HEAD = re.compile(r"^[ \t]*\[[ \t]*tool[ \t]*\.[ \t]*gark[ \t]*\]", re.MULTILINE)
BEFORE = r"(?:tool[ \t]*\.[ \t]*)?gark[ \t]*\.[ \t]*"
"""The prefix of a key outside of a table."""
TAG = "tag:yaml.org,2002:"
QUOTED = f"{TAG}str"
MOST_PATHS = 1_000
DEEPEST = 2
"""The deepest nesting of lists and tables that is read or refused."""


def _written(kind: g.ValueKind, is_quoted: bool) -> g.ValueKind:
    """Returns a kind whose values have to be quoted in TOML, or must not be."""

    def read(at: Any, node: Node, where: str) -> Any:
        value = kind.read(at, node, where)
        if value is None or (node.tag == QUOTED) == is_quoted:
            return value
        given, meant = f'"{node.value}"', str(value).lower()
        if is_quoted:
            given, meant = node.value, given
        at.source.fault(
            node, f"{where}: {given} is not {meant}", f"write {meant}", code="wrong-value"
        )
        return None

    return g.ValueKind(kind.schema, read)


def _path(at: Any, node: Node, where: str) -> str | None:
    """Reads a path or a pattern; NUL cannot be in the name of a file."""
    text: str | None = g.TEXT.read(at, node, where)
    if text is None or "\0" not in text:
        return text
    message = f"{where}: {shortened(text)} is not the name of a file"
    at.source.fault(node, message, "remove the NUL characters", code="wrong-value")
    return None


def file_of(formats: Iterable[str]) -> g.ValueKind:
    """Returns the keys of the file.

    ``formats`` are those of ``gark check``.
    """
    return g.mapping(
        g.Key(
            'paths: ["methods"]',
            g.list_of(
                _written(g.ValueKind(lambda: {"type": "string"}, _path), is_quoted=True),
                "paths",
                MOST_PATHS,
                each="paths",
                form='write ["methods"]',
            ),
            "The files, folders or patterns that gark check reads where none are named.",
        ),
        g.Key(
            'require-claims: ["order"]',
            g.either(
                _written(g.FLAG, is_quoted=False),
                g.list_of(
                    g.word(lambda: CLAIMS), "claims", each="require-claims", form='write ["order"]'
                ),
            ),
            "Whether a file without a claim fails; or a list of claims that every file has to "
            "make.",
            False,
        ),
        g.Key(
            'format: "github"',
            g.word(lambda: formats),
            "The format of gark check without --format.",
        ),
        g.Key(
            "max-order: 12",
            _written(g.count(1, 400), is_quoted=False),
            "The order at which gark check stops looking where --max-order does not say.",
            60,
        ),
        g.Key(
            "jobs: 2",
            _written(g.count(0, 256), is_quoted=False),
            "How many processes gark check takes where --jobs does not say; 0 for one a processor.",
            1,
        ),
    )


def read_settings(
    source: Source, table: dict[str, Any], kind: g.ValueKind, where: str
) -> g.ReadMapping:
    """Returns the values of a table by key; faults are reported.

    TOML gives no positions: a value is placed at the first line with its key.
    """
    is_whole = where == g.FILE
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

    found: g.ReadMapping = kind.read(SimpleNamespace(source=source), node(table, top), where)
    return found


def _places(text: str, before: str, start: int) -> dict[str, yaml.Mark]:
    """Returns the place of the first line with each key.

    ``before`` is the pattern before each key, ``start`` the start of the table.
    """
    places: dict[str, yaml.Mark] = {}
    line, seen = 0, 0
    pattern = re.compile(rf"^[ \t]*[\"']?{before}([^\n=\"']*+)[\"']?[ \t]*=", re.MULTILINE)
    for found in pattern.finditer(text, start):
        line += text.count("\n", seen, found.start())
        seen = found.start()
        places.setdefault(found[1].rstrip(), yaml.Mark("", seen, line, 0, None, 0))
    return places
