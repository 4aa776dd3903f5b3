"""The meaning of errors and findings: ``data/faults-*.toml`` has the codes with the fixed words of
messages, so that ``gark explain`` recognises a pasted one. A cause has one code everywhere.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from functools import lru_cache

from garkcli.errors import UNKNOWN
from garkcli.frozen import Frozen
from garkcli.glossary import read

TOPICS = {
    "files": "Files",
    "values": "Numbers, sizes and words",
    "methods": "Methods and problems",
    "usage": "Options",
}
"""The files of faults in the order of the documentation, with their subjects."""
HOLE = "{}"
_REST = r"(?: \(also at .*\)|; .*|, and \d+ more.*)?"
"""Text after a message: other places, or the cure."""
_QUOTED = re.compile(r"""(?<!\w)(?:'(?:[^'\\]|\\.)*'|"(?:[^"\\]|\\.)*")""", re.DOTALL)
"""Quotations in a message; after a letter, ' is an apostrophe or a derivative."""
_SHORT = 6
"""Longest quotation, with its quotes, that belongs to the message itself: '[', ">= n"."""


class FaultKind(Frozen):
    """A kind of fault: messages ``says`` have ``{}`` for varying parts; ``example`` is a method
    file, or a command after ``$``.
    """

    code: str
    text: str
    cure: str
    says: tuple[str, ...]
    example: str = ""


@lru_cache(maxsize=len(TOPICS))
def faults_of(topic: str) -> tuple[FaultKind, ...]:
    kinds = []
    for code, entry in read(f"faults-{topic}").items():
        kind = FaultKind(
            code,
            " ".join(entry["text"].split()),
            " ".join(entry["cure"].split()),
            tuple(entry["says"]),
            entry.get("example", "").strip(),
        )
        kinds.append(kind)
    return tuple(kinds)


@lru_cache(maxsize=1)
def by_code() -> Mapping[str, FaultKind]:
    return {kind.code: kind for topic in TOPICS for kind in faults_of(topic)}


def code_of(message: str, least: int = 1) -> str:
    """Returns the code whose message has the most fixed words, of at least ``least`` letters. The
    place before a colon and quotations from a file are ignored.

    >>> code_of("A^{1,1}, row 1, entry 1: 'gama' is not a parameter")
    'unknown-name'
    """
    codes = codes_of(message, least)
    return codes[0] if codes else UNKNOWN


def codes_of(message: str, least: int = 1) -> list[str]:
    """Returns the codes of the kinds with the most fixed words, one for messages of the program."""
    codes: list[str] = []
    own = _QUOTED.sub(_without_text, message)
    for said in _messages():
        if said.letters < least:
            break
        if said.code not in codes and said.is_told_by(own):
            codes.append(said.code)
            least = said.letters
    return codes


def _without_text(quoted: re.Match[str]) -> str:
    """Empties a quotation from a file, which may read like another message."""
    text = quoted.group()
    return text if len(text) <= _SHORT else "''"


class _Message(Frozen):
    """A message of a kind, as the words between its holes."""

    letters: int
    code: str
    words: tuple[str, ...]

    def is_told_by(self, message: str) -> bool:
        if not all(word in message for word in self.words):
            return False
        filled = ".*".join(map(re.escape, self.words))
        return re.fullmatch(f"(?:.*: )?{filled}{_REST}", message, re.DOTALL) is not None


@lru_cache(maxsize=1)
def _messages() -> tuple[_Message, ...]:
    messages = []
    for kind in by_code().values():
        for said in kind.says:
            words = tuple(said.split(HOLE))
            messages.append(_Message(sum(map(len, words)), kind.code, words))
    return tuple(sorted(messages, key=lambda said: said.letters, reverse=True))


COMMANDS = {"check": "docs/ci.md", "audit": "docs/audit.md"}


class FindingKind(Frozen):
    code: str
    text: str
    cure: str


@lru_cache(maxsize=len(COMMANDS))
def findings_of(command: str) -> Mapping[str, FindingKind]:
    """Returns the kinds of findings of a command by their codes."""
    kinds = {}
    for code, entry in read("findings")[command].items():
        text = " ".join(entry["text"].split())
        kinds[code] = FindingKind(code, text, " ".join(entry["cure"].split()))
    return kinds


def cure_of(command: str, code: str) -> str:
    """Returns the cure of a kind of finding, as the end of a message.

    >>> cure_of("check", "no-claim")
    'write what holds under expect: gark claims FILE --write'
    """
    cure = findings_of(command)[code].cure
    return cure[:1].lower() + cure[1:].removesuffix(".")
