"""The entries of all named methods: from the index, and for the user's own from their files."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any

from garkcli.errors import HasFreeParameters, MethodFileError, UsageProblem
from garkcli.frozen import Frozen
from garkcli.methodfile.naming import every_shelf, visible
from garkcli.methodfile.shelves import Package, Shelf, Shelved, letters_of
from garkcli.properties.registry import KEYS

if TYPE_CHECKING:
    from garkcli.catalogue.facts import Entry
    from garkcli.methodfile.build import MethodFile


FOUND, CLAIMED, UNREAD = "found", "claimed", "unread"
"""The facts of an entry are found by ``gark check``, claimed in the file, or unknown."""


def all_entries(judges: bool = False) -> Iterator[Entry]:
    """An entry for each named method; with ``judges`` those outside the index are analysed."""
    for shelf, method in visible(every_shelf()):
        yield entry_on(shelf, method, judges)


def entry_on(shelf: Shelf, method: Shelved, judges: bool = False) -> Entry:
    """``catalogue`` and ``folder`` say where the file is, ``facts`` where these come from."""
    facts = FOUND
    if isinstance(shelf, Package):
        known = shelf.entries[method.name]
        fields = (key.replace("-", "_") for key in KEYS)
        missing = [field for field in fields if field not in known]
        entry = {**known, **dict.fromkeys(missing), "undecided": [*known["undecided"], *missing]}
    else:
        entry, facts = _of_file(method, judges)
    for key in ("digest", "fingerprint"):
        entry.pop(key, None)
    return {**entry, "folder": method.folder, "catalogue": shelf.label, "facts": facts}


def _of_file(method: Shelved, judges: bool) -> tuple[Entry, str]:
    # the index is read without any of this
    from garkcli.methodfile.load import loads

    try:
        read = loads(method.read(), method.name)
    except HasFreeParameters as error:
        from garkcli.methodfile.load import described

        _, description = described(error.text, error.source, {})
        return {
            **_blank(method),
            "aliases": list(description.aliases),
            "title": description.name,
            "reference": description.reference,
            "kind": "family",
            "structure": description.structure,
        }, CLAIMED
    except MethodFileError:
        return _blank(method), UNREAD
    if not judges:
        return _claimed(read, method), CLAIMED
    return _judged(read, method.name, method.place), FOUND


def entry_of_method(read: MethodFile, file: str) -> Entry:
    return {**_judged(read, read.source, file), "folder": "", "catalogue": "", "facts": FOUND}


def _judged(read: MethodFile, name: str, file: str) -> Entry:
    from garkcli.catalogue.facts import found_of
    from garkcli.check.analysis import analyse_any

    return found_of(read, analyse_any(read), name, file)


def _blank(method: Shelved) -> Entry:
    from garkcli.catalogue.facts import blank

    return {**blank(), "name": method.name, "file": method.place}


def _claimed(read: MethodFile, method: Shelved) -> Entry:
    from garkcli.catalogue.facts import blank, head, shape
    from garkcli.methodfile.expectations import AtLeast

    entry = {**blank(), **head(read, method.name, method.place), **shape(read)}
    for claim in read.claims:
        key = claim.key.replace("-", "_")
        if key not in entry:
            continue
        value = claim.value
        if isinstance(value, AtLeast):
            value = value.least
        is_plain = value is None or isinstance(value, bool | int)
        entry[key] = value if is_plain else str(value)
    return entry


_RANGE = re.compile(r"(>=|<=|=|>|<)?\s*([0-9]{1,4})")
_SPAN = re.compile(r"([0-9]{1,4})\s*\.\.\s*([0-9]{1,4})")
_MOST = 10_000
_SEARCHED = ("name", "title", "reference")
"""Fields that are searched for words, besides the aliases."""


class NumberRange(Frozen):
    least: int
    most: int

    def has(self, value: object) -> bool:
        return isinstance(value, int) and self.least <= value <= self.most


def read_range(text: str) -> NumberRange:
    """Reads a range of integers, ``4``, ``>=4``, ``<4`` or ``2..4``; else raises UsageProblem.

    >>> read_range(">= 4").has(4), read_range("2..4").has(5), read_range("<4").has(3)
    (True, False, True)
    """
    span = _SPAN.fullmatch(text.strip())
    if span:
        return NumberRange(int(span[1]), int(span[2]))
    match = _RANGE.fullmatch(text.strip())
    if match is None:
        message = f"{text!r} is neither a number nor a range"
        raise UsageProblem(message, "write 4, '>=4', '<4' or 2..4", code="option-value")
    sign, number = match[1] or "=", int(match[2])
    ranges = {
        "=": NumberRange(number, number),
        ">=": NumberRange(number, _MOST),
        ">": NumberRange(number + 1, _MOST),
        "<=": NumberRange(0, number),
        "<": NumberRange(0, number - 1),
    }
    return ranges[sign]


class MethodFilter(Frozen):
    """Conditions on methods, all of which have to hold; unknown values match nothing. ``values``
    are by the keys of entries, ``folder`` is one of the catalogue, or empty. ``words`` are in the
    name, an alias, the title or the reference, or a name or alias in another spelling.
    """

    values: Mapping[str, NumberRange | bool | str]
    folder: str = ""
    words: Sequence[str] = ()

    def takes(self, entry: Entry) -> bool:
        for key, x in self.values.items():
            value = entry[key]
            is_so = type(x) is type(value) and x == value
            if not (x.has(value) if isinstance(x, NumberRange) else is_so):
                return False
        return self.folder in {"", entry["folder"]} and self._says_it(entry)

    def _says_it(self, entry: Entry) -> bool:
        if not self.words:
            return True
        texts = [entry[key] for key in _SEARCHED]
        told = _plain(" ".join([*texts, *entry["aliases"]]))
        names = set(map(letters_of, (entry["name"], *entry["aliases"])))
        return all(_plain(word) in told or letters_of(word) in names for word in self.words)


def _plain(text: str) -> str:
    """Lower case without accents, with spaces for hyphens.

    >>> _plain("Störmer-Verlet")
    'stormer verlet'
    """
    letters = unicodedata.normalize("NFD", text.casefold())
    return re.sub(r"[\s_‐-―−-]+", " ", "".join(x for x in letters if not unicodedata.combining(x)))


ORDERS = ("name", "order", "stages", "error")
"""Lists are ascending, but with the highest order first."""


def sorted_by(entries: Sequence[Entry], column: str) -> list[Entry]:
    """Entries in the order of a column, unknown values last."""

    def place(entry: Entry) -> tuple[Any, ...]:
        value = _measure(entry, column)
        tie = (-(entry["order"] or 0), entry["stages"] or 0, entry["name"])
        return (value is None, value or 0, *tie)

    if column == "name":
        return sorted(entries, key=lambda x: x["name"])
    return sorted(entries, key=place)


def _measure(entry: Entry, column: str) -> float | None:
    if column == "error":
        error = entry["error_constant"]
        return None if error is None else float(error)
    value: int | None = entry[column]
    if value is None:
        return None
    return -value if column == "order" else value
