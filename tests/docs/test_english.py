"""Pages say things as one would say them aloud: some patterns are refused."""

from __future__ import annotations

import re

from tests.cli.harness import ROOT
from tests.docs.blocks import pages
from tests.docs.test_links import prose
from tests.docs.test_repetition import MADE

REFUSED = re.compile(
    r"\b(?:(?:is|are|was|were) (?:told|asked for|looked at|thought of|taken for|said to be)"
    r"|hangs? on|goes for|what is not \w+ is)\b"
)
"""Passive voice without an actor, and idioms that are not the field's."""

SHOWN = {"style.md", "python-reference.md", "glossary.md", "json-fields.md", "command-line.md"}
"""The page that shows what not to write, and pages that the program writes from its own texts."""


def refused(text: str) -> list[str]:
    """What a reader has to read twice, code apart."""
    return REFUSED.findall(" ".join(re.sub(r"`[^`\n]*`", "", text).split()))


def test_pages_are_in_plain_english() -> None:
    """No page that people write has one of the patterns."""
    found = {
        str(page.relative_to(ROOT)): hits
        for page in pages()
        if page.name not in SHOWN and (hits := refused(MADE.sub("", prose(page))))
    }
    assert found == {}


def test_a_pattern_is_found() -> None:
    """Across lines; not in code."""
    assert refused("What is\ntold") == ["is told"]
    assert refused("`is told` says gark") == []
