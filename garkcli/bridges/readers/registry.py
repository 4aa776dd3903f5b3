"""The readers of ``gark import`` and ``gark audit``, collected from two folders."""

from __future__ import annotations

import pkgutil
from collections.abc import Iterable, Mapping, Sequence
from functools import lru_cache
from importlib import import_module
from importlib.util import find_spec
from pathlib import PurePath

from garkcli.bridges import readers
from garkcli.errors import UsageProblem, did_you_mean, printable
from garkcli.sources import languages
from garkcli.sources.found import MAX_CHARACTERS, FoundTable, Reader, TooLarge, troubled


@lru_cache(maxsize=1)
def all_readers() -> Mapping[str, Reader]:
    by_name: dict[str, Reader] = {}
    for package in (readers, languages):
        for module in pkgutil.iter_modules(package.__path__):
            place = import_module(f"{package.__name__}.{module.name}")
            by_name |= {x.name: x for x in vars(place).values() if isinstance(x, Reader)}
    return dict(sorted(by_name.items()))


def reader_named(name: str) -> Reader:
    known = all_readers()
    if name not in known:
        cure = did_you_mean(name, list(known))
        raise UsageProblem(f"no format {name!r}", cure, code="unknown-word")
    return known[name]


def suffixes() -> frozenset[str]:
    return frozenset(x for r in all_readers().values() for x in r.suffixes)


def readers_for(path: str) -> Sequence[Reader]:
    """The readers for the ending of a path; all if none reads it."""
    suffix = PurePath(path).suffix.lower()
    everyone = tuple(all_readers().values())
    return [x for x in everyone if suffix in x.suffixes] or everyone


def demand_grammars(paths: Iterable[str], format: str | None = None) -> None:
    """Raises UsageProblem for sources whose grammars are not installed."""
    grammars = {"tree_sitter"}.union(*(x.grammars for x in all_readers().values()))
    missing = {x for x in grammars if find_spec(x) is None}
    if not missing:
        return
    for path in paths:
        readers = readers_for(path) if format is None else [reader_named(format)]
        if any(missing & {"tree_sitter", *x.grammars} for x in readers if x.grammars):
            message = f"{printable(path)} cannot be read without tree-sitter and its grammars"
            cure = 'type pip install "garkcli[audit]", or in a checkout pip install ".[audit]"'
            raise UsageProblem(message, cure, code="missing-package")


def find_tables(text: str, source: str, chosen: Sequence[Reader]) -> list[FoundTable]:
    """The tables of a source in the order of its lines; with all readers those of the best one."""
    if len(text) > MAX_CHARACTERS:
        return []
    if len(chosen) == len(all_readers()):
        return _by_the_best(text, source, chosen)
    tables: list[FoundTable] = []
    for reader in chosen:
        tables += _read(reader, text, source)
    return sorted(tables, key=lambda x: x.line)


def _read(reader: Reader, text: str, source: str) -> list[FoundTable]:
    """The tables of a reader; for a source that becomes too large, the place where it does."""
    try:
        return reader.find(text, source)
    except TooLarge as error:
        return [troubled(FoundTable(source, error.line, reader.name, "", (), ()), error.message)]


def _by_the_best(text: str, source: str, chosen: Sequence[Reader]) -> list[FoundTable]:
    best: list[FoundTable] = []
    no_tables: list[FoundTable] = []
    for reader in chosen:
        tables = _read(reader, text, source)
        no_tables += [x for x in tables if x.trouble]
        if _worth(tables) > _worth(best):
            best = tables
    return best or no_tables


def _worth(tables: Sequence[FoundTable]) -> tuple[int, int]:
    read = [x for x in tables if not x.trouble]
    return sum(x.is_sure for x in read), len(read)
