"""The keys of ``.gark.toml``, or of ``[tool.gark]`` in pyproject.toml, and their values."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from garkcli.grammar import keys as g
from garkcli.grammar.nodes import Node, shortened
from garkcli.grammar.tables import QUOTED
from garkcli.methodfile.expectations import CLAIMS

MOST_PATHS = 1_000


def _written(kind: g.ValueKind, is_quoted: bool) -> g.ValueKind:
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
    """NUL cannot be in the name of a file."""
    text: str | None = g.TEXT.read(at, node, where)
    if text is None or "\0" not in text:
        return text
    message = f"{where}: {shortened(text)} is not the name of a file"
    at.source.fault(node, message, "remove the NUL characters", code="wrong-value")
    return None


def file_of(formats: Iterable[str]) -> g.ValueKind:
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
