"""New method files, with comments that say what stands where."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from garkcli.methodfile.pasted import Pasted
from garkcli.methodfile.writer import quoted

HEAD = (
    "# gark check FILE proves the claims under expect; gark claims FILE --write",
    "# renews them; gark explain WORD says what a key means.",
)


@dataclass(frozen=True)
class Member:
    """A member of a family."""

    family: str
    stages: int


def of_tableau(name: str, found: Pasted) -> str:
    """A method file of a pasted tableau."""
    return "\n".join([*HEAD, f"name: {quoted(name)}", *_tableau(found), ""])


def _tableau(found: Pasted) -> Iterator[str]:
    yield "# the matrix, a row a stage"
    yield "A:"
    for row in found.A:
        yield f"  - {_row(row)}"
    yield f"b: {_row(found.b)}  # weights"
    if found.c is not None:
        yield f"c: {_row(found.c)}  # nodes"
    if found.embedded is not None:
        yield f"embedded: {_row(found.embedded)}  # embedded weights"


def of_families(name: str, members: Sequence[Member], transfer: str) -> str:
    """A method file of members of families.

    Args:
        name: of the method.
        members: one a colour.
        transfer: the rule for the blocks between them.
    """
    lines = [*HEAD, f"name: {quoted(name)}"]
    lines += ["# the diagonal methods, one a colour", "methods:"]
    for member in members:
        lines.append(f"  - {{family: {member.family}, stages: {member.stages}}}")
    if len(members) > 1:
        lines.append(f"transfer: {transfer}  # how the blocks between are made")
    return "\n".join([*lines, ""])


def _row(numbers: Sequence[str]) -> str:
    """Numbers in brackets; what YAML would take apart stands in quotes."""
    return f"[{', '.join(map(_entry, numbers))}]"


def _entry(text: str) -> str:
    is_plain = all(x.isalnum() or x in "/.+-*^() _" for x in text)
    return text if is_plain else quoted(text)
