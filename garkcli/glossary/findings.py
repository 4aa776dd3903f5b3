"""What the findings of ``gark check`` and ``gark audit`` mean, by their codes."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache

from garkcli.glossary.data import read

COMMANDS = {"check": "docs/ci.md", "audit": "docs/audit.md"}
"""The commands that have findings, with the page about each."""


@dataclass(frozen=True)
class FindingKind:
    """A kind of finding: what it means, in whole sentences, and what to do."""

    code: str
    text: str
    cure: str


@lru_cache(maxsize=len(COMMANDS))
def findings_of(command: str) -> Mapping[str, FindingKind]:
    """The kinds of findings of a command by their codes.

    >>> list(findings_of("check"))
    ['unreadable', 'claim', 'no-claim']
    """
    found = {}
    for code, entry in read("findings")[command].items():
        text = " ".join(entry["text"].split())
        cure = " ".join(entry["cure"].split())
        found[code] = FindingKind(code, text, cure)
    return found
