"""The keys of the files that users write; the rooms that read them declare them."""

from __future__ import annotations

from collections.abc import Mapping
from functools import lru_cache
from typing import NamedTuple

from garkcli.frozen import Frozen
from garkcli.upward import answered


class Files(NamedTuple):
    """A kind of file and its page."""

    name: str
    page: str


KINDS = {
    "method": Files("method files", "docs/method-file.md"),
    "problem": Files("problem files", "docs/problem-file.md"),
    "sweep": Files("spec files of gark sweep", "docs/sweep.md"),
    "project": Files(".gark.toml and [tool.gark]", "docs/ci.md"),
}


class KeyMeaning(Frozen):
    """The meaning of a key.

    ``path`` includes the parent keys, as ``compose.steps``; ``example`` is a line of a file;
    ``default`` is None without a default. With ``is_word`` the key is also found by its own name.
    """

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
