"""What is wrong with checked files, one value a finding: the common ground of the formats for
machines.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from hashlib import sha256
from pathlib import PurePath

from garkcli.check.outcome import Outcome

RULES = {
    "unreadable": "the file cannot be read as a method",
    "claim": "a claim under expect does not hold",
}
"""Every kind of finding."""


@dataclass(frozen=True)
class Finding:
    """One fault or one failed claim.

    Attributes:
        rule: a key of ``RULES``.
        file: the path as given, with forward slashes.
        line: from 1; 1 where unknown.
        column: from 1; 1 where unknown.
        message: what is wrong.
        help: the cure, where there is one.
        fingerprint: the same as long as the same thing is wrong with the same file, wherever it
            stands in it.
    """

    rule: str
    file: str
    line: int
    column: int
    message: str
    help: str
    fingerprint: str


def findings(outcome: Outcome) -> Iterator[Finding]:
    """All findings of one file, in file order."""
    file = PurePath(outcome.file).as_posix()
    seen: Counter[str] = Counter()
    for fault in outcome.faults:
        key = f"{file}\0unreadable\0{fault.message}\0{seen[fault.message]}"
        seen[fault.message] += 1
        yield Finding(
            "unreadable",
            file,
            fault.line or 1,
            fault.column or 1,
            fault.message,
            fault.help,
            _digest(key),
        )
    for claim in outcome.failed_claims:
        message = f"{claim.claim}: expected {claim.expected}, found {claim.found}"
        key = f"{file}\0claim\0{claim.claim}"
        yield Finding("claim", file, claim.line, claim.column, message, "", _digest(key))


def _digest(key: str) -> str:
    return sha256(key.encode("utf-8", "surrogatepass")).hexdigest()[:32]
