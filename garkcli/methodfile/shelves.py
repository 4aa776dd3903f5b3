"""Where methods with names are: your own folders, the package, packages of others.

A shelf knows its methods by their names, which are those of their files, and by their aliases.
"""

from __future__ import annotations

import os
import re
import sys
import unicodedata
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from functools import cache, cached_property, lru_cache
from itertools import chain
from typing import TYPE_CHECKING, Any

from msgspec import json

from garkcli.errors import MethodFileError, Remark
from garkcli.frozen import Frozen
from garkcli.methodfile.bibliography import aliases_of
from garkcli.methodfile.reading import SUFFIX, decoded, files_below, read_text
from garkcli.methodfile.source import METHOD_FILE

if TYPE_CHECKING:
    from importlib.metadata import EntryPoint
    from importlib.resources.abc import Traversable

PATH_VARIABLE = "GARK_PATH"
"""The variable with your own folders, as ``PATH`` has those of programs."""
GROUP = "gark.catalogue"
"""The group of entry points whose values are packages with method files in them."""
INDEX = "catalogue/index.json"
"""What there is in the package, from its root."""
DATA = "catalogue/data"
"""The method files of the package, from its root."""
_DASHES = dict.fromkeys([*range(0x2010, 0x2016), 0x2212], "-")
_NO_LETTERS = r"[\W_]+"


@lru_cache(4_096)
def key_of(name: str) -> str:
    """A name as it is compared: in lower case, with hyphens between its words.

    >>> key_of("Dormand_Prince 5"), key_of("Runge–Kutta")
    ('dormand-prince-5', 'runge-kutta')
    """
    spelt = unicodedata.normalize("NFC", name).casefold().strip()
    return re.sub(r"[\s_-]+", "-", spelt.translate(_DASHES))


def letters_of(name: str) -> str:
    """The letters and digits of a name, however it is spelt; a star tells methods apart.

    >>> letters_of("ARK4(3)6L[2]SA"), letters_of("ARS-222") == letters_of("ARS(2,2,2)")
    ('ark436l2sa', True)
    >>> letters_of("lobatto-iiic*-2")
    'lobattoiiicstar2'
    """
    spelt = unicodedata.normalize("NFC", name).casefold().replace("*", "star")
    return re.sub(_NO_LETTERS, "", spelt)


class Shelved(Frozen):
    """A method file with a name.

    Attributes:
        name: that of the file, without its suffix.
        folder: the one below the root of its shelf that it is in; empty for none.
        place: where the file is, for people.
        shelf: what messages call its shelf.
        read: gives its text, or raises ``MethodFileError``.
    """

    name: str
    folder: str
    place: str
    shelf: str
    read: Callable[[], str]


Found = Mapping[str, Sequence[Shelved]]
"""Methods by the keys of their names, or of their aliases; several where these are not unique."""


def _by(keys: Callable[[Shelved], Iterable[str]], methods: Iterable[Shelved]) -> Found:
    """Methods by keys that each of them has."""
    found: dict[str, list[Shelved]] = {}
    for method in methods:
        for key in dict.fromkeys(keys(method)):
            found.setdefault(key, []).append(method)
    return found


class Shelf:
    """Methods with names that are in one place.

    Attributes:
        label: what messages call it.
    """

    def __init__(self, label: str) -> None:
        self.label = label

    @cached_property
    def methods(self) -> Found:
        """By their names."""
        return _by(lambda x: [key_of(x.name)], self._shelved())

    def named(self, key: str) -> Sequence[Shelved]:
        """Those of a name, by its key."""
        return self.methods.get(key, ())

    @cached_property
    def aliases(self) -> Found:
        """By what else they are called."""
        return _by(lambda x: map(key_of, self.called(x)), chain(*self.methods.values()))

    @cached_property
    def spellings(self) -> Found:
        """By the letters and digits of their names and aliases."""
        return _by(
            lambda x: map(letters_of, (x.name, *self.called(x))), chain(*self.methods.values())
        )

    def called(self, method: Shelved) -> Sequence[str]:
        """The aliases of one of its methods; none where its file cannot be read."""
        try:
            return aliases_of(method.read(), method.place)
        except MethodFileError:
            return ()

    def _shelved(self) -> Iterator[Shelved]:
        """Its methods."""
        raise NotImplementedError


class OwnFolder(Shelf):
    """A folder, with all method files below it."""

    def _shelved(self) -> Iterator[Shelved]:
        for path in files_below(self.label):
            if not path.endswith(SUFFIX):
                continue  # a folder that cannot be read
            parts = os.path.relpath(path, self.label).split(os.sep)
            folder = parts[0] if len(parts) > 1 else ""
            yield Shelved(parts[-1].removesuffix(SUFFIX), folder, path, self.label, _text_of(path))


def _text_of(path: str) -> Callable[[], str]:
    return lambda: read_text(path, METHOD_FILE)[0]


class Package(Shelf):
    """The methods that come with the program, by their index."""

    @cached_property
    def _index(self) -> str:
        return _resource(INDEX).decode("ascii")

    @cached_property
    def entries(self) -> Mapping[str, Mapping[str, Any]]:
        """What the index says of each, by its name."""
        return {x["name"]: x for x in json.decode(self._index)["methods"]}

    def named(self, key: str) -> Sequence[Shelved]:
        """Those of a name, by its key, which it is itself; no other entry of the index is read."""
        start = self._index.find(f'\n{{"name": "{key}", ') + 1
        if not start or '"' in key:
            return ()
        line = self._index[start : self._index.index("\n", start)]
        return [self._entered(json.decode(line.removesuffix(",")))]

    def called(self, method: Shelved) -> Sequence[str]:
        """The aliases of one of its methods; no file is read for it."""
        aliases: Sequence[str] = self.entries[method.name]["aliases"]
        return aliases

    def _shelved(self) -> Iterator[Shelved]:
        return map(self._entered, self.entries.values())

    def _entered(self, entry: Mapping[str, Any]) -> Shelved:
        name, file = entry["name"], entry["file"]
        folder = file.partition("/")[0]
        return Shelved(
            name, folder, file, self.label, lambda: decoded(name, _resource(f"{DATA}/{file}"))
        )


def _resource(file: str) -> bytes:
    """A file of this package, wherever the package is.

    By ``pkgutil``, as to import ``importlib.resources`` takes as long as to check a method.
    """
    from pkgutil import get_data

    data = get_data("garkcli", file)
    assert data is not None
    return data


class OtherPackage(Shelf):
    """A package of others, with method files in it.

    Args:
        label: the name of its entry point.
        root: where it is.
    """

    def __init__(self, label: str, root: Traversable) -> None:
        super().__init__(label)
        self.root = root

    def _shelved(self) -> Iterator[Shelved]:
        return self._below(self.root, ())

    def _below(self, folder: Traversable, inside: tuple[str, ...]) -> Iterator[Shelved]:
        """The method files below a folder of the package."""
        for item in sorted(folder.iterdir(), key=lambda x: x.name):
            if item.is_dir():
                yield from self._below(item, (*inside, item.name))
            elif item.name.endswith(SUFFIX):
                name = item.name.removesuffix(SUFFIX)
                place = "/".join((self.label, *inside, item.name))
                text = _text_of_item(item, place)
                yield Shelved(name, inside[0] if inside else "", place, self.label, text)


def _text_of_item(item: Traversable, place: str) -> Callable[[], str]:
    return lambda: decoded(place, item.read_bytes())


@cache
def package() -> Package:
    """The shelf of this package; its index is read once."""
    return Package("the package")


def own_folders() -> list[Shelf]:
    """The folders of ``GARK_PATH`` that there are, in its order."""
    folders = dict.fromkeys(x for x in os.environ.get(PATH_VARIABLE, "").split(os.pathsep) if x)
    return [OwnFolder(x) for x in folders if os.path.isdir(x)]


@cache
def _points(_: tuple[str, ...]) -> list[EntryPoint]:
    """The entry points of the group on a search path: to look for them takes longer than a check,
    and many names that mean nothing ask for them.
    """
    from importlib.metadata import entry_points

    return sorted(entry_points(group=GROUP), key=lambda x: x.name)


def others() -> list[Shelf]:
    """The packages that are installed with an entry point of the group, by its name.

    Raises:
        MethodFileError: one of them cannot be imported.
    """
    from importlib.resources import files

    shelves: list[Shelf] = []
    for point in _points(tuple(sys.path)):
        try:
            root = files(point.value)
        except Exception as error:  # whatever the import of their package does
            what = f"{type(error).__name__}: {error}".splitlines()[0]
            message = f"{point.value} cannot be imported: {what}"
            cure = f"it has an entry point of the group {GROUP}: mend it, or remove it"
            fault = Remark(message, cure, code="missing-package")
            raise MethodFileError(point.name, [fault]) from None
        shelves.append(OtherPackage(point.name, root))
    return shelves
