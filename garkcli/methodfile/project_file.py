"""What ``.gark.toml``, or ``[tool.gark]`` of pyproject.toml, has: its keys; a table → values."""

from __future__ import annotations

import re
from collections.abc import Iterable
from types import SimpleNamespace
from typing import Any

import yaml
from yaml.nodes import MappingNode, Node, ScalarNode, SequenceNode

from garkcli.methodfile import grammar as g
from garkcli.methodfile.expectations import CLAIMS
from garkcli.methodfile.source import Source

HEAD = re.compile(r"^\s*\[\s*tool\s*\.\s*gark\s*\]", re.MULTILINE)
BEFORE = r"(?:tool\s*\.\s*)?gark\s*\.\s*"
"""Before a key where no line begins its table."""
TAG = "tag:yaml.org,2002:"
QUOTED = f"{TAG}str"


def _written(kind: g.Kind, is_quoted: bool) -> g.Kind:
    """A kind whose values have quotes in TOML, or have none."""

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

    return g.Kind(kind.schema, read)


def file_of(formats: Iterable[str]) -> g.Kind:
    """What the file has.

    Args:
        formats: those of ``gark check``.
    """
    return g.mapping(
        g.Key(
            'paths: ["methods"]',
            g.list_of(
                _written(g.Kind(lambda: {"type": "string"}, g.TEXT.read), is_quoted=True),
                "paths",
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


def read_settings(source: Source, table: dict[str, Any], kind: g.Kind, where: str) -> g.Found:
    """The values of a table of TOML by key; faults are noted.

    TOML tells no places: a value has that of the first line with its key.
    """
    is_whole = where == g.FILE
    head = None if is_whole else HEAD.search(source.text)
    start = head.end() if head else 0
    before = "" if head or is_whole else BEFORE

    def node(value: Any, mark: yaml.Mark) -> Node:
        if isinstance(value, dict):
            marks = {key: _mark(source.text, before + re.escape(key), start) for key in value}
            pairs = [(node(key, marks[key]), node(x, marks[key])) for key, x in value.items()]
            return MappingNode("", pairs, mark, mark)
        if isinstance(value, list):
            return SequenceNode("", [node(x, mark) for x in value], mark, mark)
        shown = str(value).lower() if isinstance(value, bool) else str(value)
        return ScalarNode(f"{TAG}{type(value).__name__}", shown, mark, mark)

    root = node(table, yaml.Mark("", 0, 0, 0, None, 0))
    found: g.Found = kind.read(SimpleNamespace(source=source), root, where)
    return found


def _mark(text: str, key: str, start: int) -> yaml.Mark:
    """The place of the pattern of a key in a file, after what begins its table; the start where it
    is not seen.
    """
    found = re.compile(rf"^[ \t]*[\"']?{key}[\"']?[ \t]*=", re.MULTILINE).search(text, start)
    index = 0 if found is None else found.start()
    return yaml.Mark("", index, text.count("\n", 0, index), 0, None, 0)
