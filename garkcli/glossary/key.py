"""The keys of the files that people write, as data/keys-*.toml has them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache

from garkcli.glossary.data import read

KINDS = {
    "method": ("method files", "docs/method-file.md"),
    "problem": ("problem files", "docs/problem-file.md"),
    "sweep": ("spec files of gark sweep", "docs/sweep.md"),
    "project": (".gark.toml and [tool.gark]", "docs/ci.md"),
}
"""The kinds of files, each with what they are called and the page about them."""


@dataclass(frozen=True)
class Key:
    """What a key means.

    Attributes:
        path: the key with those that it stands below, as ``compose.steps``.
        text: what it is, in whole sentences.
        example: a line of such a file with it.
        default: what holds where it is left out; None where nothing does.
        page: where more is said.
        is_word: whether it is found by its own name too.
    """

    path: str
    text: str
    example: str
    default: object = None
    page: str = ""
    is_word: bool = True


@lru_cache(maxsize=len(KINDS))
def keys_of(kind: str) -> Mapping[str, Key]:
    """The keys of a kind of files by their paths, in the order of the documentation.

    >>> keys_of("method")["compose.from"].default
    2
    """
    _, page = KINDS[kind]
    found: dict[str, Key] = {}
    for path, entry in read(f"keys-{kind}").items():
        said = entry
        if "same" in entry:
            said = read(f"keys-{kind}")[entry["same"]]
        found[path] = Key(
            path,
            " ".join(said["text"].split()),
            said["example"],
            said.get("default"),
            said.get("page", page),
            said.get("word", True),
        )
    return found
