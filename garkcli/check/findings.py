"""What is wrong with checked files, one value a finding: the common ground of the formats for
machines.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from hashlib import sha256
from pathlib import PurePath

from garkcli.check.explained import claim_hint, claim_witness
from garkcli.check.outcome import Outcome

CLAIM = "write what holds under expect: gark claims FILE --write"
"""The cure of a file that lacks a claim."""


@dataclass(frozen=True)
class Finding:
    """One fault or one failed claim.

    Attributes:
        rule: a key of ``KINDS``.
        file: the path as given, with forward slashes.
        line: from 1; 1 where unknown.
        column: from 1; 1 where unknown.
        message: what is wrong, of an order with the tree whose condition fails.
        help: the cure or a hint, where there is one.
        fingerprint: the same as long as the same thing is wrong with the same file, wherever it
            stands in it.
        level: ``error``, ``warning`` or ``note``.
        code: of a file that cannot be read, the code of what is wrong with it.
    """

    rule: str
    file: str
    line: int
    column: int
    message: str
    help: str
    fingerprint: str
    level: str = "error"
    code: str = ""


@dataclass(frozen=True)
class Part:
    """A finding as its kind makes it: ``key`` is the same as long as the same thing is wrong."""

    message: str
    help: str
    key: str
    line: int = 1
    column: int = 1
    code: str = ""


@dataclass(frozen=True)
class Kind:
    """A kind of finding: what it is in words, and where it occurs."""

    text: str
    find: Callable[[Outcome], Iterator[Part]]


def _unreadable(outcome: Outcome) -> Iterator[Part]:
    seen: Counter[str] = Counter()
    for fault in outcome.faults:
        key = f"{fault.message}\0{seen[fault.message]}"
        seen[fault.message] += 1
        yield Part(fault.message, fault.help, key, fault.line or 1, fault.column or 1, fault.code)


def _failed_claims(outcome: Outcome) -> Iterator[Part]:
    for claim in outcome.failed_claims:
        difference = f"expected {claim.expected}, found {claim.found}"
        message = f"{claim.claim}: {difference}"
        witness = claim_witness(outcome, claim.claim)
        if witness:
            message = f"{message}; {witness}"
        hint = claim_hint(outcome, claim.claim)
        yield Part(message, str(hint), claim.claim, claim.line, claim.column)


def _missing_claims(outcome: Outcome) -> Iterator[Part]:
    for message in outcome.lacks:
        is_any = outcome.makes_no_claim and outcome.needs_claims
        yield Part(message, CLAIM, "" if is_any else message)


KINDS = {
    "unreadable": Kind("the file cannot be read as a method", _unreadable),
    "claim": Kind("a claim under expect does not hold", _failed_claims),
    "no-claim": Kind("the file lacks a claim that is required", _missing_claims),
}
"""Every kind of finding; formats and their documentation are made from it."""


def findings(outcome: Outcome) -> Iterator[Finding]:
    """All findings of one file, kind by kind in file order."""
    file = PurePath(outcome.file).as_posix()
    for rule, kind in KINDS.items():
        for part in kind.find(outcome):
            digest = fingerprint(f"{file}\0{rule}\0{part.key}")
            yield Finding(
                rule, file, part.line, part.column, part.message, part.help, digest, code=part.code
            )


def fingerprint(key: str) -> str:
    """A short text that is the same for the same key, and for no other."""
    return sha256(key.encode("utf-8", "surrogatepass")).hexdigest()[:32]
