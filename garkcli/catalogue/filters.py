"""Which methods of the catalogue are wanted: ranges, truths, words."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from garkcli.errors import UsageProblem

if TYPE_CHECKING:
    from garkcli.catalogue.facts import Entry

_RANGE = re.compile(r"(>=|<=|=|>|<)?\s*([0-9]{1,4})")
_SPAN = re.compile(r"([0-9]{1,4})\s*\.\.\s*([0-9]{1,4})")
_MOST = 10_000
"""No count of a method is as large."""
_SEARCHED = ("name", "title", "reference")
"""What words are looked for in, besides the aliases."""


@dataclass(frozen=True)
class Range:
    """Whole numbers from ``least`` to ``most``."""

    least: int
    most: int

    def has(self, value: object) -> bool:
        """Whether a value is one of them; an unknown one is not."""
        return isinstance(value, int) and self.least <= value <= self.most


def read_range(text: str) -> Range:
    """What ``4``, ``>=4``, ``<4`` or ``2..4`` mean.

    Raises:
        UsageProblem: it is none of them.

    >>> read_range(">= 4").has(4), read_range("2..4").has(5), read_range("<4").has(3)
    (True, False, True)
    """
    span = _SPAN.fullmatch(text.strip())
    if span:
        return Range(int(span[1]), int(span[2]))
    found = _RANGE.fullmatch(text.strip())
    if found is None:
        message = f"{text!r} is no number and no range"
        raise UsageProblem(message, "write 4, '>=4', '<4' or 2..4", code="option-value")
    sign, number = found[1] or "=", int(found[2])
    ranges = {
        "=": Range(number, number),
        ">=": Range(number, _MOST),
        ">": Range(number + 1, _MOST),
        "<=": Range(0, number),
        "<": Range(0, number - 1),
    }
    return ranges[sign]


@dataclass(frozen=True)
class Wanted:
    """What is wanted; all of it at once.

    Attributes:
        ranges: of numbers, by their keys in entries.
        truths: of properties, by their keys; one that is not known is neither true nor false.
        values: of texts, by their keys.
        folder: of the catalogue; empty for any.
        words: each is in the name, an alias, the title or the reference.
    """

    ranges: Mapping[str, Range] = field(default_factory=dict)
    truths: Mapping[str, bool] = field(default_factory=dict)
    values: Mapping[str, str] = field(default_factory=dict)
    folder: str = ""
    words: Sequence[str] = ()

    def takes(self, entry: Entry) -> bool:
        """Whether a method is as wanted."""
        return (
            all(x.has(entry[key]) for key, x in self.ranges.items())
            and all(entry[key] is x for key, x in self.truths.items())
            and all(entry[key] == x for key, x in self.values.items())
            and self.folder in {"", entry["folder"]}
            and self._says_it(entry)
        )

    def _says_it(self, entry: Entry) -> bool:
        if not self.words:
            return True
        texts = [entry[key] for key in _SEARCHED]
        told = _plain(" ".join([*texts, *entry["aliases"]]))
        return all(_plain(word) in told for word in self.words)


def _plain(text: str) -> str:
    """A text as it is searched: without capitals and accents, hyphens as blanks.

    >>> _plain("Störmer-Verlet")
    'stormer verlet'
    """
    letters = unicodedata.normalize("NFD", text.casefold())
    kept = (x for x in letters if not unicodedata.combining(x))
    return re.sub(r"[\s_‐-―−-]+", " ", "".join(kept))


ORDERS = ("name", "order", "stages", "error")
"""By what lists are sorted; each from small to large, but orders from large to small."""


def sorted_by(entries: Sequence[Entry], column: str) -> list[Entry]:
    """Entries in an order that people ask for; what is not known comes last."""

    def place(entry: Entry) -> tuple[Any, ...]:
        value = _measure(entry, column)
        tie = (-(entry["order"] or 0), entry["stages"] or 0, entry["name"])
        return (value is None, value or 0, *tie)

    if column == "name":
        return sorted(entries, key=lambda x: x["name"])
    return sorted(entries, key=place)


def _measure(entry: Entry, column: str) -> float | None:
    """What an entry is sorted by."""
    if column == "error":
        error = entry["error_constant"]
        return None if error is None else float(error)
    value: int | None = entry[column]
    if value is None:
        return None
    return -value if column == "order" else value
