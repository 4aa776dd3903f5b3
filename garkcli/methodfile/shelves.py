"""The places of named methods: the user's folders, the package, and other packages."""

from __future__ import annotations

import os
import re
import sys
import unicodedata
from abc import ABC, abstractmethod
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from functools import cache, cached_property, lru_cache
from itertools import chain
from typing import TYPE_CHECKING, Any

from msgspec import json

from garkcli.errors import MethodFileError, Remark
from garkcli.frozen import Frozen
from garkcli.glossary.key import METHOD_FILE
from garkcli.grammar.reading import decoded, read_text
from garkcli.methodfile.bibliography import aliases_of
from garkcli.methodfile.folders import SUFFIX, files_below

if TYPE_CHECKING:
    from importlib.metadata import EntryPoint
    from importlib.resources.abc import Traversable

PATH_VARIABLE = "GARK_PATH"
GROUP = "gark.catalogue"
INDEX = "catalogue/index.json"
DATA = "catalogue/data"
_DASHES = dict.fromkeys([*range(0x2010, 0x2016), 0x2212], "-")
_NO_LETTERS = r"[\W_]+"


@lru_cache(4_096)
def key_of(name: str) -> str:
    """A name for comparison.

    >>> key_of("Dormand_Prince 5"), key_of("Runge–Kutta")
    ('dormand-prince-5', 'runge-kutta')
    """
    spelt = unicodedata.normalize("NFC", name).casefold().strip()
    return re.sub(r"[\s_-]+", "-", spelt.translate(_DASHES))


def letters_of(name: str) -> str:
    """Letters and digits; a star counts as a word.

    >>> letters_of("ARK4(3)6L[2]SA"), letters_of("lobatto-iiic*-2")
    ('ark436l2sa', 'lobattoiiicstar2')
    """
    spelt = unicodedata.normalize("NFC", name).casefold().replace("*", "star")
    return re.sub(_NO_LETTERS, "", spelt)


class Shelved(Frozen):
    """``folder`` is below the root of its shelf; ``read`` may raise MethodFileError."""

    name: str
    folder: str
    place: str
    shelf: str
    read: Callable[[], str]


Found = Mapping[str, Sequence[Shelved]]


def _by(keys: Callable[[Shelved], Iterable[str]], methods: Iterable[Shelved]) -> Found:
    by_key: dict[str, list[Shelved]] = {}
    for method in methods:
        for key in dict.fromkeys(keys(method)):
            by_key.setdefault(key, []).append(method)
    return by_key


class Shelf(ABC):
    """A folder of methods; ``label`` names it in messages."""

    def __init__(self, label: str) -> None:
        self.label = label

    @cached_property
    def methods(self) -> Found:
        return _by(lambda x: [key_of(x.name)], self._shelved())

    def named(self, key: str) -> Sequence[Shelved]:
        return self.methods.get(key, ())

    @cached_property
    def aliases(self) -> Found:
        return _by(lambda x: map(key_of, self.called(x)), chain(*self.methods.values()))

    @cached_property
    def spellings(self) -> Found:
        return _by(
            lambda x: map(letters_of, (x.name, *self.called(x))), chain(*self.methods.values())
        )

    def called(self, method: Shelved) -> Sequence[str]:
        try:
            return aliases_of(method.read(), method.place)
        except MethodFileError:
            return ()

    @abstractmethod
    def _shelved(self) -> Iterator[Shelved]: ...


class OwnFolder(Shelf):
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
    """The methods of gark, from their index."""

    @cached_property
    def _index(self) -> str:
        return _resource(INDEX).decode("ascii")

    @cached_property
    def entries(self) -> Mapping[str, Mapping[str, Any]]:
        return {x["name"]: x for x in json.decode(self._index)["methods"]}

    def named(self, key: str) -> Sequence[Shelved]:
        """No other entry of the index is read."""
        start = self._index.find(f'\n{{"name": "{key}", ') + 1
        if not start or '"' in key:
            return ()
        line = self._index[start : self._index.index("\n", start)]
        return [self._entered(json.decode(line.removesuffix(",")))]

    def called(self, method: Shelved) -> Sequence[str]:
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
    """The content of a file of the package, also of one in an archive."""
    # importlib.resources takes as long to import as a check
    from pkgutil import get_data

    data = get_data("garkcli", file)
    assert data is not None
    return data


class OtherPackage(Shelf):
    def __init__(self, label: str, root: Traversable) -> None:
        super().__init__(label)
        self.root = root

    def _shelved(self) -> Iterator[Shelved]:
        return self._below(self.root, ())

    def _below(self, folder: Traversable, inside: tuple[str, ...]) -> Iterator[Shelved]:
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
    return Package("the package")


def own_folders() -> list[Shelf]:
    """The existing folders of ``GARK_PATH``, in its order."""
    given = os.environ.get(PATH_VARIABLE)
    if not given:
        return []
    return [OwnFolder(x) for x in dict.fromkeys(given.split(os.pathsep)) if os.path.isdir(x)]


@cache
def _points(_: tuple[str, ...]) -> list[EntryPoint]:
    """Cached: the search takes longer than a check, and follows each unknown name."""
    from importlib.metadata import entry_points

    return sorted(entry_points(group=GROUP), key=lambda x: x.name)


def others() -> list[Shelf]:
    """Returns the shelves of entry points; MethodFileError if one cannot be imported."""
    from importlib.resources import files

    shelves: list[Shelf] = []
    for point in _points(tuple(sys.path)):
        try:
            root = files(point.value)
        except Exception as error:  # whatever the import of their package does
            what = f"{type(error).__name__}: {error}".splitlines()[0]
            message = f"{point.value} cannot be imported: {what}"
            cure = f"fix or remove its entry point of the group {GROUP}"
            fault = Remark(message, cure, code="missing-package")
            raise MethodFileError(point.name, [fault]) from None
        shelves.append(OtherPackage(point.name, root))
    return shelves
