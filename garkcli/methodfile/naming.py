"""A name in place of a file: which method of which catalogue it means.

An argument with a separator of paths in it is a file, and so is one that exists as a file; any
other is a name. Your own folders come before the package, the package before packages of
others, and in all of them a name before an alias, and both before what has the same letters and
digits: ``ARS(2,2,2)`` is ``ARS222``.
"""

from __future__ import annotations

import os
import re
from collections.abc import Iterable, Iterator, Sequence
from contextlib import suppress
from itertools import chain
from typing import TYPE_CHECKING

from garkcli.errors import MAX_WORD, MethodFileError, Remark, nearest, printable
from garkcli.files import STDIN
from garkcli.frozen import fields
from garkcli.methodfile.reading import read_text
from garkcli.methodfile.shelves import (
    Found,
    Shelf,
    Shelved,
    key_of,
    letters_of,
    others,
    own_folders,
    package,
)
from garkcli.methodfile.source import METHOD_FILE

if TYPE_CHECKING:
    from garkcli.reference import Reference

FAMILY = "the families"
"""The shelf of methods that are made when they are named."""
PREFIX = "catalogue:"
"""What is before a name that is never a file; alone, or before a folder, it means all methods."""
_OF_FILES = (".yaml", ".yml", ".json")
"""No name ends so."""
_MOST_SHOWN = 6
"""Most methods that are listed where an alias means several, or a name is cut short."""


def read_argument(argument: str, path: str = "") -> tuple[str, str]:
    """The text of the method that an argument means, and what to call it.

    Args:
        argument: a path, or a name or alias of the catalogue.
        path: where it is as a file, if that is not the argument itself.

    Raises:
        MethodFileError: there is no such file or method, or no text in it, or it may mean several.
    """
    method = find_named(argument, path)
    if method is None:
        return read_text(path or argument, METHOD_FILE)
    return method.read(), method.name


def find_named(argument: str, path: str = "") -> Shelved | None:
    """The method of the catalogue that an argument means; None where it means a file.

    Args:
        argument: as in ``read_argument``.
        path: as there.

    Raises:
        MethodFileError: it means both, several, or nothing.
    """
    if not can_be_name(argument):
        return None
    is_file = os.path.lexists(path or argument)
    name = argument.removeprefix(PREFIX)
    if is_file and name != argument:
        return None
    method = look_up(name)
    if method is None and not is_file:
        raise MethodFileError(argument, [_unknown(name)])
    if method is not None and is_file:
        both = f"there is a file of this name here, and the method {method.name} in the catalogue"
        cure = f"write .{os.sep}{argument} for the file, {PREFIX}{argument} for the method"
        raise MethodFileError(argument, [Remark(both, cure, code="name-in-doubt")])
    return method


def can_be_name(argument: object) -> bool:
    """Whether it looks like a name, whatever exists: no file is sought, no catalogue."""
    if not isinstance(argument, str) or argument in {STDIN, "", ".", ".."}:
        return False
    if argument.startswith("{"):
        return True
    if not {"/", os.sep, os.altsep, "\0"}.isdisjoint(argument):
        return False
    return len(argument) <= len(PREFIX) + MAX_WORD and not argument.endswith(_OF_FILES)


def called(argument: str) -> str:
    """What reports call it: a method of the catalogue by its name, however it was typed, and a file
    by its path.
    """
    with suppress(MethodFileError):  # whoever reads it says what is wrong
        method = find_named(argument)
        if method is not None:
            return method.name
    return argument


def is_both(path: str) -> bool:
    """Whether what exists under this path is also a name."""
    return can_be_name(path) and look_up(path) is not None


def look_up(name: str) -> Shelved | None:
    """The method of a name or an alias; None where there is none.

    Raises:
        MethodFileError: the name is that of several files of one place, or the alias that of
            several methods.
    """
    key = key_of(name)
    for shelves in _in_turn():
        for shelf in shelves:
            if found := shelf.named(key):
                return _only(name, found)
        found = _called(key, (shelf.aliases for shelf in shelves))
        found = found or _called(letters_of(name), (shelf.spellings for shelf in shelves))
        if found:
            return _only(name, found)
    return _of_family(name)


def is_catalogued(name: str) -> bool:
    """Whether a catalogue has a method of exactly this name."""
    method = look_up(name)
    return method is not None and method.name == name and method.shelf != FAMILY


def _of_family(name: str) -> Shelved | None:
    """A member of a family: ``gauss-7``, ``gauss:7`` or ``{family: gauss, stages: 7}``."""
    from garkcli.families.registry import FAMILIES, member_named

    text = name.strip()
    if text.startswith("{") and text.endswith("}") and "family" in text:
        found = re.search(r"family:\s*([^\s,}]+)", text)
        meant = FAMILIES.get(found[1]) if found else None
        return _made(text, None if meant is None else meant.reference)
    member = member_named(text)
    if member is None:
        return None
    family, size = member
    called = family if size is None else f"{family}-{size}"
    return _made(called, FAMILIES[family].reference)


def _made(name: str, reference: Reference | None = None) -> Shelved:
    """The file of a member of a family, with the reference of the family."""

    def written() -> str:
        known = {key: getattr(reference, key) for key in fields(reference)} if reference else {}
        import json  # only members of families need it

        told = json.dumps({key: x for key, x in known.items() if x}, ensure_ascii=False)
        return f"methods: {name}\n" + (f"reference: {told}\n" if reference else "")

    return Shelved(name, "", name, FAMILY, written)


def _in_turn() -> Iterator[Sequence[Shelf]]:
    """The shelves; those of other packages, which take long to find, after all others."""
    yield [*own_folders(), package()]
    yield others()


def _called(key: str, known: Iterable[Found]) -> list[Shelved]:
    """The methods that a key means; of two that have one name the first."""
    found: dict[str, Shelved] = {}
    for methods in known:
        for method in methods.get(key, ()):
            found.setdefault(key_of(method.name), method)
    return list(found.values())


def _only(name: str, methods: Sequence[Shelved]) -> Shelved:
    """The one method of a name.

    Raises:
        MethodFileError: there are several.
    """
    if len(methods) == 1:
        return methods[0]
    names = dict.fromkeys(method.name for method in methods)
    several = list(names) if len(names) > 1 else [x.place for x in methods]
    message = f"{printable(name)!r} means {len(several)} methods: {_first(several)}"
    raise MethodFileError(name, [Remark(message, "name one of them", code="name-in-doubt")])


def _unknown(name: str) -> Remark:
    """Neither file nor name."""
    message = "no such file, and no method of this name in the catalogue"
    known = [
        word
        for shelf in every_shelf()
        for method in chain.from_iterable(shelf.methods.values())
        for word in (method.name, *shelf.called(method))
    ]
    cure = "gark list methods shows the names"
    if near := nearest(name, known):
        cure = f"did you mean {near!r}?"
    elif begun := names_beginning(name):
        cure = f"names that begin so: {_first(begun)}"
    return Remark(message, cure, code="no-such-file")


def _first(names: Sequence[str]) -> str:
    """Some names in a line."""
    shown = ", ".join(names[:_MOST_SHOWN])
    return f"{shown}, …" if len(names) > _MOST_SHOWN else shown


def every_shelf() -> list[Shelf]:
    """All shelves, in the order in which names are sought."""
    return list(chain.from_iterable(_in_turn()))


def shelf_of(method: Shelved) -> Shelf:
    """Where a method is."""
    (shelf,) = [x for x in every_shelf() if x.label == method.shelf]
    return shelf


def visible(shelves: Iterable[Shelf]) -> Iterator[tuple[Shelf, Shelved]]:
    """The methods that their names mean, shelf by shelf: none that another one hides."""
    known: set[str] = set()
    for shelf in shelves:
        for key, methods in shelf.methods.items():
            if key not in known:
                yield shelf, methods[0]
        known.update(shelf.methods)


def hidden_by(method: Shelved) -> list[str]:
    """Where else among your own folders and the package a method of this name is."""
    key = key_of(method.name)
    elsewhere = [x for x in (*own_folders(), package()) if x.label != method.shelf]
    return [shelf.label for shelf in elsewhere if key in shelf.methods]


def note_of(argument: str) -> list[str]:
    """What a user should know of a name: that its method hides another one.

    Raises:
        MethodFileError: the name may mean several methods.
    """
    if not can_be_name(argument) or os.path.lexists(argument):
        return []
    method = look_up(argument.removeprefix(PREFIX))
    hidden = hidden_by(method) if method else []
    if method is None or not hidden:
        return []
    places = " and ".join(hidden)
    name = printable(method.name)
    return [f"note: {name} is {method.place}, which hides that of {places}"]


def names_beginning(start: str) -> list[str]:
    """Names that begin so; where none does, aliases that are one word.

    Raises:
        MethodFileError: a package of others cannot be imported.
    """
    key = key_of(start)
    shelves = every_shelf()
    names = [method.name for _, method in visible(shelves)]
    found = [name for name in names if key_of(name).startswith(key)]
    if found:
        return found
    called = chain.from_iterable(shelf.called(method) for shelf, method in visible(shelves))
    return [x for x in called if key_of(x).startswith(key) and len(x.split()) == 1]


def expanded(argument: str) -> list[str]:
    """What ``catalogue:`` and ``catalogue:FOLDER`` mean, as arguments for one method each.

    Empty where the argument is something else, or there is no such folder.
    """
    if not argument.startswith(PREFIX) or os.path.lexists(argument):
        return []
    folder = key_of(argument.removeprefix(PREFIX))
    methods = (method for _, method in visible(every_shelf()))
    return [PREFIX + x.name for x in methods if folder in {"", key_of(x.folder)}]
