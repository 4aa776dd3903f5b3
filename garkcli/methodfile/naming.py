"""The files that arguments stand for: names of methods, folders and patterns.

An argument with a path separator is a file, and so is one that exists as a file; any other is a
name. The user's folders come before the package, and the package before other packages; in each,
names come before aliases, and both before spellings with the same letters and digits:
``ARS(2,2,2)`` is ``ARS222``. The name of a family is no spelling of a method: ``sdirk2`` is not
``sdirk-2``.
"""

from __future__ import annotations

import os
import re
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import suppress
from fnmatch import fnmatchcase
from itertools import chain
from typing import TYPE_CHECKING

from garkcli.errors import MAX_WORD, MethodFileError, Remark, nearest, printable
from garkcli.files import STDIN, leads_away
from garkcli.frozen import fields
from garkcli.glossary.key import METHOD_FILE
from garkcli.grammar.reading import read_text
from garkcli.methodfile import shelves as shelving
from garkcli.methodfile.folders import files_below, no_one, within

if TYPE_CHECKING:
    from garkcli.families.family import MethodFamily
    from garkcli.reference import Reference

FAMILY = "the families"
PREFIX = "catalogue:"
"""Begins a name that is never a file; alone, or with a folder, it means all methods."""
_OF_FILES = (".yaml", ".yml", ".json")
"""Endings that names do not have."""
METHOD_FILES = (".gark.yaml", ".yaml", ".yml", ".json")
_MOST_SHOWN = 6


def read_argument(argument: str, path: str = "") -> tuple[str, str]:
    """Returns the text and the name; MethodFileError if they mean no method, or several."""
    method = find_named(argument, path)
    if method is None:
        return read_text(path or argument, METHOD_FILE)
    return method.read(), method.name


def find_named(argument: str, path: str = "") -> shelving.Shelved | None:
    """Returns a method of the catalogue, None for a file; MethodFileError for both, several or
    none.
    """
    if not can_be_name(argument):
        return None
    is_file = os.path.lexists(path or argument)
    name = argument.removeprefix(PREFIX)
    if is_file and name != argument:
        return None
    method = look_up(name)
    if method is None and not is_file:
        files = [x for x in (name + ending for ending in METHOD_FILES) if os.path.isfile(x)]
        raise MethodFileError(argument, [_unknown(name, files)])
    if method is not None and is_file:
        both = f"there is a file of this name here, and the method {method.name} in the catalogue"
        cure = f"write .{os.sep}{argument} for the file, {PREFIX}{argument} for the method"
        raise MethodFileError(argument, [Remark(both, cure, code="name-in-doubt")])
    return method


def can_be_name(argument: object) -> bool:
    """Whether an argument has the form of a name, for any or no method."""
    if not isinstance(argument, str) or argument in {STDIN, "", ".", ".."}:
        return False
    if argument.startswith("{"):
        return True
    if not {"/", os.sep, os.altsep, "\0"}.isdisjoint(argument):
        return False
    return len(argument) <= len(PREFIX) + MAX_WORD and not argument.endswith(_OF_FILES)


def called(argument: str) -> str:
    """The name of a method in reports: that in the catalogue, or the path."""
    with suppress(MethodFileError):  # whoever reads it says what is wrong
        method = find_named(argument)
        if method is not None:
            return method.name
    return argument


def is_both(path: str) -> bool:
    return can_be_name(path) and look_up(path) is not None


def look_up(name: str) -> shelving.Shelved | None:
    """The method with a name or an alias, or None; MethodFileError if several have it."""
    key = shelving.key_of(name)
    for shelves in _in_turn():
        for shelf in shelves:
            if methods := shelf.named(key):
                return _only(name, methods)
        methods = _called(key, (shelf.aliases for shelf in shelves))
        methods = methods or _spelt_like(name, shelves)
        if methods:
            return _only(name, methods)
    return _of_family(name)


def _spelt_like(name: str, shelves: Iterable[shelving.Shelf]) -> list[shelving.Shelved]:
    methods = _called(shelving.letters_of(name), (shelf.spellings for shelf in shelves))
    return methods if methods and _family(name) is None else []


def _family(name: str) -> MethodFamily | None:
    from garkcli.families.registry import FAMILIES

    family = FAMILIES.get(name.strip().lower())
    return None if family is None or family.stands_alone else family


def is_catalogued(name: str) -> bool:
    method = look_up(name)
    return method is not None and method.name == name and method.shelf != FAMILY


def _of_family(name: str) -> shelving.Shelved | None:
    """A member of a family: ``gauss-7``, ``gauss:7`` or ``{family: gauss, stages: 7}``."""
    from garkcli.families.registry import FAMILIES, member_named

    text = name.strip()
    if text.startswith("{") and text.endswith("}") and "family" in text:
        match = re.search(r"family:\s*([^\s,}]+)", text)
        meant = FAMILIES.get(match[1]) if match else None
        return _made(text, None if meant is None else meant.reference)
    member = member_named(text)
    if member is None:
        return None
    family, size = member
    if size is None and not FAMILIES[family].stands_alone:
        return None
    called = family if size is None else f"{family}-{size}"
    return _made(called, FAMILIES[family].reference)


def _made(name: str, reference: Reference | None = None) -> shelving.Shelved:
    def written() -> str:
        known = {key: getattr(reference, key) for key in fields(reference)} if reference else {}
        import json  # only members of families need it

        told = json.dumps({key: x for key, x in known.items() if x}, ensure_ascii=False)
        return f"methods: {name}\n" + (f"reference: {told}\n" if reference else "")

    return shelving.Shelved(name, "", name, FAMILY, written)


def _in_turn() -> Iterator[Sequence[shelving.Shelf]]:
    """The shelves in the order of search, those of other packages last, as they are slow."""
    yield [*shelving.own_folders(), shelving.package()]
    yield shelving.others()


def _called(key: str, known: Iterable[shelving.Found]) -> list[shelving.Shelved]:
    """The first of those with the same name."""
    by_name: dict[str, shelving.Shelved] = {}
    for methods in known:
        for method in methods.get(key, ()):
            by_name.setdefault(shelving.key_of(method.name), method)
    return list(by_name.values())


def _only(name: str, methods: Sequence[shelving.Shelved]) -> shelving.Shelved:
    if len(methods) == 1:
        return methods[0]
    names = dict.fromkeys(method.name for method in methods)
    several = list(names) if len(names) > 1 else [x.place for x in methods]
    message = f"{printable(name)!r} means {len(several)} methods: {_first(several)}"
    raise MethodFileError(name, [Remark(message, "name one of them", code="name-in-doubt")])


def _unknown(name: str, files: Sequence[str]) -> Remark:
    message = "no such file, and no method of this name in the catalogue"
    if files:
        cure = f"did you mean {' or '.join(map(repr, files))}?"
        return Remark(message, cure, code="no-such-file")
    family = _family(name)
    if family is not None:
        needs = " and ".join(option.name for option in family.needed)
        message = f"{family.name} is a family: its methods need {needs}"
        cure = f"write for instance {family.example}"
        if alike := _called(
            shelving.letters_of(name), (shelf.spellings for shelf in every_shelf())
        ):
            cure += f", or {_first([x.name for x in alike])} for the method of the catalogue"
        return Remark(message, cure, code="missing-key")
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
        cure = f"names that begin with it: {_first(begun)}"
    return Remark(message, cure, code="no-such-file")


def _first(names: Sequence[str]) -> str:
    shown = ", ".join(names[:_MOST_SHOWN])
    return f"{shown}, …" if len(names) > _MOST_SHOWN else shown


def every_shelf() -> list[shelving.Shelf]:
    return list(chain.from_iterable(_in_turn()))


def shelf_of(method: shelving.Shelved) -> shelving.Shelf:
    (shelf,) = [x for x in every_shelf() if x.label == method.shelf]
    return shelf


def visible(shelves: Iterable[shelving.Shelf]) -> Iterator[tuple[shelving.Shelf, shelving.Shelved]]:
    """Methods without those hidden by another of the same name."""
    known: set[str] = set()
    for shelf in shelves:
        for key, methods in shelf.methods.items():
            if key not in known:
                yield shelf, methods[0]
        known.update(shelf.methods)


def hidden_by(method: shelving.Shelved) -> list[str]:
    key = shelving.key_of(method.name)
    elsewhere = [
        x for x in (*shelving.own_folders(), shelving.package()) if x.label != method.shelf
    ]
    return [shelf.label for shelf in elsewhere if key in shelf.methods]


def note_of(argument: str) -> list[str]:
    """A note if the method of a name hides another; MethodFileError if the name is ambiguous."""
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
    """Names, or else one-word aliases; MethodFileError if another package cannot be imported."""
    key = shelving.key_of(start)
    shelves = every_shelf()
    names = [method.name for _, method in visible(shelves)]
    beginning = [name for name in names if shelving.key_of(name).startswith(key)]
    if beginning:
        return beginning
    called = chain.from_iterable(shelf.called(method) for shelf, method in visible(shelves))
    return [x for x in called if shelving.key_of(x).startswith(key) and len(x.split()) == 1]


def expanded(argument: str) -> list[str]:
    """The methods for ``catalogue:`` or ``catalogue:FOLDER``; empty for other arguments."""
    if not argument.startswith(PREFIX) or os.path.lexists(argument):
        return []
    folder = shelving.key_of(argument.removeprefix(PREFIX))
    methods = (method for _, method in visible(every_shelf()))
    return [PREFIX + x.name for x in methods if folder in {"", shelving.key_of(x.folder)}]


_MAGIC = frozenset("*?[")


def find_files(paths: Iterable[str], told: Callable[[str], None] = no_one) -> Iterator[str]:
    """The files that ``paths`` stand for, in order.

    A folder stands for all method files below it, a pattern such as ``**/*.yaml`` for its matches,
    ``catalogue:FOLDER`` for methods of the catalogue. An argument without files stays, to be
    reported as missing, as does a folder that cannot be searched. Links to folders are not
    followed, because they may lead back; ``told`` learns of links to files elsewhere, which are
    left out.
    """
    for path in paths:
        if path == STDIN:
            yield path
        elif os.path.isdir(path):
            # a folder that is called as a method is reported where it is read
            yield from [path] if is_both(path) else files_below(path, told) or [path]
        elif path.startswith(PREFIX):
            yield from expanded(path) or [path]
        elif _MAGIC & set(path) and not os.path.lexists(path):
            yield from _matching(path, told) or [path]
        else:
            yield path


def _matching(pattern: str, told: Callable[[str], None]) -> list[str]:
    """The matches of a pattern; a folder stands for the files below it."""
    from pathlib import Path

    path = Path(pattern)
    start = path.anchor
    whole = path.parts[1:] if start else path.parts
    # in a row they say no more than one
    parts = [x for x, then in zip(whole, (*whole[1:], ""), strict=True) if not x == then == "**"]
    paths: set[str] = set()
    root = fixed_part(pattern)
    for match in _expanded(start, parts, root):
        if os.path.isdir(match) and not leads_away(match, root):
            paths.update(files_below(match, told))
        else:
            paths.add(match)
    return within(sorted(paths), root, told)


def fixed_part(pattern: str) -> str:
    """The folder with which a pattern begins; a path without wildcards is returned whole.

    >>> fixed_part("methods/**/*.yaml"), fixed_part("methods/rk4.yaml"), fixed_part("*.yaml")
    ('methods', 'methods/rk4.yaml', '')
    """
    fixed = pattern
    while _MAGIC & set(fixed):
        fixed = os.path.dirname(fixed)
    return fixed


def _expanded(place: str, parts: Sequence[str], root: str) -> Iterator[str]:
    """All matches below a place; links out of ``root`` are not followed."""
    if not parts or (os.path.islink(place) and leads_away(place, root)):
        if os.path.lexists(place):
            yield place
        return
    part, rest = parts[0], parts[1:]
    if part == "**":
        for folder in _folders(place):
            yield from _expanded(folder, rest or ("*",), root)
    elif _MAGIC & set(part):
        for name in _names(place):
            # a hidden one has to be requested
            is_shown = part.startswith(".") or not name.startswith(".")
            if is_shown and fnmatchcase(name, part):
                yield from _expanded(os.path.join(place, name), rest, root)
    else:
        yield from _expanded(os.path.join(place, part), rest, root)


def _folders(place: str) -> Iterator[str]:
    """A folder and all folders below it except hidden ones; empty for the current one."""
    for folder, below, _ in os.walk(place or "."):
        # os.walk goes on with what is left in the list
        below[:] = [name for name in below if not name.startswith(".")]
        inside = folder if place else os.path.relpath(folder)
        yield "" if inside == "." else inside


def _names(folder: str) -> list[str]:
    try:
        return os.listdir(folder or ".")
    except OSError:
        return []
