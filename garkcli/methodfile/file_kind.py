"""What kinds of files there are, as faults speak of them."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class FileKind:
    """What a file is for.

    Attributes:
        name: what people call it.
        keys: those that tell one from other files.
        smallest: what the smallest one has.
        start: how one begins.
        page: where it is described.
    """

    name: str
    keys: tuple[str, ...]
    smallest: str
    start: str
    page: str


METHOD_FILE = FileKind(
    "method file",
    (
        *("gark", "methods", "tableau", "ark", "prk", "A", "b", "unknown"),
        *("compose", "adjoint", "extrapolate", "splitting", "multirate"),
    ),
    "the smallest file has A and b, or methods",
    "start with A: and b:, or with methods:",
    "docs/method-file.md",
)
PROBLEM_FILE = FileKind(
    "problem file",
    ("variables", "hamiltonian", "lagrangian", "rhs"),
    "the smallest file has variables, hamiltonian and initial",
    "start with variables:",
    "docs/problem-file.md",
)
