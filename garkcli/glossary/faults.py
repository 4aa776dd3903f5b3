"""What errors mean, and what findings do: each kind of fault has a code, which an error says where
it is raised, and the messages that it has, so that ``gark explain`` knows a message that is pasted.

The words of a message that stay the same are in ``data/faults-*.toml``; so one cause has one code
wherever it shows, in whatever sentence.
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
"""The files of faults in the order of the documentation, with what they are about."""
HOLE = "{}"
_REST = r"(?: \(also at .*\)|; .*|, and \d+ more.*)?"
"""What is added to a message: other places, or the cure."""
_QUOTED = re.compile(r"""(?<!\w)(?:'(?:[^'\\]|\\.)*'|"(?:[^"\\]|\\.)*")""", re.DOTALL)
"""What a message quotes; behind a letter ' is an apostrophe or a derivative."""
_SHORT = 6
"""Characters, with the quotes, of what messages of the program quote themselves: '[', ">= n"."""


class FaultKind(Frozen):
    """A kind of fault.

    Attributes:
        code: what it is called in reports for machines.
        text: what it means and why it is one, in whole sentences.
        cure: what to do.
        says: its messages, with ``{}`` for what they are filled with.
        example: what has it: a method file, or a command after ``$``; empty where that would need
            more than a few lines.
    """

    code: str
    text: str
    cure: str
    says: tuple[str, ...]
    example: str = ""


@lru_cache(maxsize=len(TOPICS))
def faults_of(topic: str) -> tuple[FaultKind, ...]:
    """The kinds of faults of a topic."""
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
    """Every kind of fault by its code."""
    return {kind.code: kind for topic in TOPICS for kind in faults_of(topic)}


def code_of(message: str, least: int = 1) -> str:
    """The code of the kind of fault that a message tells.

    Of several kinds the one with the longest words is meant; what a message says of the place,
    before a colon, is passed over, and so is what it quotes from a file.

    Args:
        message: what is wrong.
        least: how many letters of it have to be the program's own.

    >>> code_of("A^{1,1}, row 1, entry 1: 'gama' is not a parameter")
    'unknown-name'
    """
    codes = codes_of(message, least)
    return codes[0] if codes else UNKNOWN


def codes_of(message: str, least: int = 1) -> list[str]:
    """The codes of the kinds with the longest words; of messages of the program it is one."""
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
    """Quotes with nothing of a file between them, which may read like another message."""
    text = quoted.group()
    return text if len(text) <= _SHORT else "''"


class _Message(Frozen):
    """A message of a kind: the words between its holes."""

    letters: int
    code: str
    words: tuple[str, ...]

    def is_told_by(self, message: str) -> bool:
        """Whether a message is this one, filled."""
        if not all(word in message for word in self.words):
            return False
        filled = ".*".join(map(re.escape, self.words))
        return re.fullmatch(f"(?:.*: )?{filled}{_REST}", message, re.DOTALL) is not None


@lru_cache(maxsize=1)
def _messages() -> tuple[_Message, ...]:
    """Those of all kinds, those with the longest words first."""
    messages = []
    for kind in by_code().values():
        for said in kind.says:
            words = tuple(said.split(HOLE))
            messages.append(_Message(sum(map(len, words)), kind.code, words))
    return tuple(sorted(messages, key=lambda said: said.letters, reverse=True))


COMMANDS = {"check": "docs/ci.md", "audit": "docs/audit.md"}
"""The commands that have findings, with the page about each."""


class FindingKind(Frozen):
    """A kind of finding: what it means, in whole sentences, and what to do."""

    code: str
    text: str
    cure: str


@lru_cache(maxsize=len(COMMANDS))
def findings_of(command: str) -> Mapping[str, FindingKind]:
    """The kinds of findings of a command by their codes.

    >>> list(findings_of("check"))
    ['unreadable', 'claim', 'undecided', 'no-claim']
    """
    kinds = {}
    for code, entry in read("findings")[command].items():
        text = " ".join(entry["text"].split())
        kinds[code] = FindingKind(code, text, " ".join(entry["cure"].split()))
    return kinds
