"""The fenced blocks of the README, of CONTRIBUTING.md and of all pages."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from tests.cli.harness import ROOT

FENCE = re.compile(r"^(?P<indent>\s*)(?P<fence>`{3,}|~{3,})\s*(?P<language>.*)$")
NAME = re.compile(r"`([\w./-]+\.\w+)`:\n\n\Z")


@dataclass(frozen=True)
class Block:
    """What stands between two fences.

    Attributes:
        page: the file.
        line: that of the first fence, from 1.
        language: the word behind it.
        name: that of the file which the block shows, where the text before it ends so:
            `` `name.yaml`: ``.
        text: the lines.
        indent: what stands before the fence.
    """

    page: Path
    line: int
    language: str
    name: str
    text: str
    indent: str

    @property
    def where(self) -> str:
        """Page and line."""
        return f"{self.page.relative_to(ROOT)}:{self.line}"


def pages() -> list[Path]:
    """Everything people read that is Markdown, as far as it is no record of changes."""
    return [ROOT / "README.md", ROOT / "CONTRIBUTING.md", *sorted((ROOT / "docs").rglob("*.md"))]


def blocks(page: Path) -> Iterator[Block]:
    """The blocks of a page in order.

    Raises:
        ValueError: the last one has no end.
    """
    lines = page.read_text(encoding="utf-8").splitlines(keepends=True)
    numbered = iter(enumerate(lines, start=1))
    for number, line in numbered:
        if (fence := FENCE.match(line.rstrip("\n"))) is None:
            continue
        before = "".join(lines[: number - 1])
        name = NAME.search(before[-200:])
        text = ""
        for _, inner in numbered:
            if inner.strip() == fence["fence"]:
                break
            text += inner
        else:
            raise ValueError(f"{page}:{number}: the block has no end")
        yield Block(
            page, number, fence["language"].strip(), name[1] if name else "", text, fence["indent"]
        )


def pages_with(language: str, sign: str = "") -> list[Path]:
    """Pages that have a block of a language with ``sign`` in it."""
    return [
        page
        for page in pages()
        if any(x.language == language and sign in x.text for x in blocks(page))
    ]
