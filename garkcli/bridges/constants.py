"""Constants that a source takes from others of its tree."""

from __future__ import annotations

import re
from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from itertools import takewhile
from pathlib import PurePath

from garkcli.bridges.readers.registry import find_tables, readers_for
from garkcli.bridges.sources import source_text
from garkcli.errors import UsageProblem
from garkcli.frozen import replace
from garkcli.sources.found import FoundTable, Reader

MAX_SOUGHT = 5_000_000
"""Most characters of other sources in which constants are sought, near sources first."""
MAX_ROUNDS = 6
"""Most times a source is read again: constants are made of others."""
_UNKNOWN = re.compile(r"the name (?P<name>\w{2,40}), line [0-9]+, is not known")
_DECLARED = (
    r"\b(?P<name>{names})\b(?::[ \t]*\w+)?[ \t]*[= \t][ \t]*"
    r"(?P<value>[-+*/().\w \t]{{1,80}}?)[ \t]*(?:$|[;,!#]|//|/\*)"
)
_CONSTANT = re.compile(r"\b(?:parameter|const|constexpr|define|final)\b|^$", re.IGNORECASE)
_NO_CONSTANT = re.compile(r"=|//|/\*|!|%|^[ \t]*\*|#(?![ \t]*define\b)")
"""Signs before a name that is in a comment, or in the value of another one."""
_TAKING = re.compile(r"[ \t]*(?:#[ \t]*include|use|using|import|from)\b", re.IGNORECASE)


def tables_with_constants(text: str, source: str, others: Sequence[str]) -> list[FoundTable]:
    """The tables of a source, with constants on whose values all sources of its language agree."""
    readers = readers_for(source)
    fold = _fold(readers)
    tables = find_tables(text, source, readers)
    for _ in range(MAX_ROUNDS):
        missing = {fold(x["name"]) for table in tables if (x := _UNKNOWN.search(table.trouble))}
        constants = _constants(missing, source, others) if missing else {}
        if not constants:
            break
        lines = text.splitlines(keepends=True)
        text = "".join(_with_values(line, constants, fold) for line in lines)
        # a function may have a value of its own for a name
        read = [x for x in tables if not x.trouble]
        known = {(x.line, x.name) for x in read}
        found = find_tables(text, source, readers)
        more = [replace(x, borrows=True) for x in found if (x.line, x.name) not in known]
        tables = sorted([*read, *more], key=lambda x: x.line)
    return tables


def _fold(readers: Sequence[Reader]) -> Callable[[str], str]:
    """Makes names equal that differ in case, for Fortran."""
    return str.lower if [x.name for x in readers] == ["fortran"] else str


def _constants(names: Collection[str], source: str, others: Sequence[str]) -> Mapping[str, str]:
    readers, left = readers_for(source), MAX_SOUGHT
    fold = _fold(readers)
    pattern = _DECLARED.format(names="|".join(map(re.escape, sorted(names))))
    declared = re.compile(pattern, re.MULTILINE | (re.IGNORECASE if fold is str.lower else 0))
    found: dict[str, set[str]] = {}
    for path in sorted(others, key=lambda x: -_shared(x, source)):
        if path == source or readers_for(path) != readers:
            continue
        try:
            text, _ = source_text(path)
        except UsageProblem:
            continue
        left -= len(text)
        if left < 0:
            break
        for name, value in _declared_in(text, declared):
            found.setdefault(fold(name), set()).add(value)
    return {name: values.pop() for name, values in found.items() if len(values) == 1}


def _shared(path: str, source: str) -> int:
    pairs = zip(PurePath(path).parts, PurePath(source).parts, strict=False)
    return sum(1 for _ in takewhile(lambda x: x[0] == x[1], pairs))


def _declared_in(text: str, declared: re.Pattern[str]) -> Iterator[tuple[str, str]]:
    for match in declared.finditer(text):
        before = text[text.rfind("\n", 0, match.start()) + 1 : match.start()]
        value = match["value"].strip()
        is_number = re.search("[0-9]", value) and value.count("(") == value.count(")")
        if is_number and _CONSTANT.search(before) and not _NO_CONSTANT.search(before):
            yield match["name"], value


def _with_values(line: str, constants: Mapping[str, str], fold: Callable[[str], str]) -> str:
    """Puts values in place of constants, except in a line that imports them."""
    if _TAKING.match(line):
        return line

    def value(match: re.Match[str]) -> str:
        known = constants.get(fold(match[0]))
        return match[0] if known is None else f"({known})"

    return re.sub(r"\b[^\W\d]\w*", value, line)
