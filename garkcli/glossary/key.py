"""The keys of the files that users write; the rooms that read them declare them."""

from __future__ import annotations

from collections.abc import Mapping
from functools import lru_cache

from garkcli.frozen import Frozen
from garkcli.upward import answered


class FileKind(Frozen):
    """A kind of file, with the name of all such files, and the keys that distinguish it."""

    name: str
    files: str
    page: str
    keys: tuple[str, ...] = ()
    smallest: str = ""
    start: str = ""
    use: str = ""
    is_imported: bool = False


METHOD_FILE = FileKind(
    "method file",
    "method files",
    "docs/method-file.md",
    (
        *("gark", "methods", "tableau", "ark", "prk", "A", "b", "unknown"),
        *("compose", "adjoint", "extrapolate", "splitting", "multirate"),
    ),
    "the smallest file has A and b, or methods",
    "start with A: and b:, or with methods:",
    "gark check FILE reads it",
    is_imported=True,
)
PROBLEM_FILE = FileKind(
    "problem file",
    "problem files",
    "docs/problem-file.md",
    ("variables", "hamiltonian", "lagrangian", "rhs"),
    "the smallest file has variables, hamiltonian and initial",
    "start with variables:",
    "give it beside a method file: gark converge METHOD --problem FILE",
)
SWEEP_FILE = FileKind(
    "sweep file",
    "spec files of gark sweep",
    "docs/sweep.md",
    ("columns", "methods", "files", "where", "best", "pareto"),
    "the smallest file has methods or files, and columns",
    "start with methods:",
    "gark sweep FILE runs it",
)
PROJECT_FILE = FileKind("project file", ".gark.toml and [tool.gark]", "docs/ci.md")
KINDS = {
    "method": METHOD_FILE,
    "problem": PROBLEM_FILE,
    "sweep": SWEEP_FILE,
    "project": PROJECT_FILE,
}


class KeyMeaning(Frozen):
    """The meaning of a key by its path, as ``compose.steps``, or, ``is_word``, by its name."""

    path: str
    text: str
    example: str
    default: object = None
    page: str = ""
    is_word: bool = True


@lru_cache(maxsize=len(KINDS))
def keys_of(kind: str) -> Mapping[str, KeyMeaning]:
    """Returns the keys of a kind of files by their paths, in the order of the documentation.

    >>> keys_of("method")["compose.from"].default
    2
    """
    return {key.path: key for key in answered(KINDS[kind], kind)}
