"""The catalogue as a mapping from names to methods: ``garkcli.catalogue["rk4"]``.

The package ``garkcli.catalogue`` is this mapping itself, however it is imported.
"""

from __future__ import annotations

from collections.abc import ItemsView, Iterator, KeysView, Mapping, ValuesView
from types import ModuleType
from typing import TYPE_CHECKING, Any, cast

from garkcli.errors import GarkError, MethodFileError, UsageProblem, did_you_mean

if TYPE_CHECKING:
    from garkcli.methodfile.build import MethodFile
    from garkcli.methodfile.shelves import Shelved


_WORDS = ("kind", "structure")


class NoSuchMethod(GarkError, KeyError):
    """No method of the catalogue has this name."""


class Catalogue(ModuleType):
    """Published methods by name; a lookup reads its file.

    The keys are the names, those in the folders of ``GARK_PATH`` first; aliases are accepted too.

    >>> import garkcli
    >>> garkcli.catalogue["rk4"].stages, "no-such-method" in garkcli.catalogue
    ((4,), False)
    >>> garkcli.catalogue.search("Verlet", order=2, symplectic=True)
    ['leapfrog-2', 'pseudo-leapfrog-2', 'stoermer-verlet']
    """

    def __getitem__(self, name: str) -> MethodFile:
        """The method with a name or an alias.

        Raises:
            NoSuchMethod: there is none, or the name may mean several.
            MethodFileError: its file cannot be read as a method.
        """
        from garkcli.methodfile.load import loads

        found = _method_called(name)
        return loads(found.read(), found.name)

    def __contains__(self, name: object) -> bool:
        try:
            return _method_called(name) is not None
        except NoSuchMethod:
            return False

    def __iter__(self) -> Iterator[str]:
        return iter(method_names())

    def __len__(self) -> int:
        return len(method_names())

    def __repr__(self) -> str:
        return f"<Catalogue of {len(self)} methods>"

    def __bool__(self) -> bool:
        return True  # a module is true; nothing is counted for that

    def keys(self) -> KeysView[str]:
        """The names of the methods."""
        return KeysView(_mapping(self))

    def values(self) -> ValuesView[MethodFile]:
        """The methods; each is read when the iteration reaches it."""
        return ValuesView(_mapping(self))

    def items(self) -> ItemsView[str, MethodFile]:
        """The names and methods."""
        return ItemsView(_mapping(self))

    def search(self, *words: str, folder: str = "", **wanted: bool | int | str) -> list[str]:
        """The names of methods that match, as in ``gark list methods``, highest order first.

        Args:
            words: each is in the name, an alias, the title or the reference.
            folder: of the catalogue, such as ``"erk"``.
            wanted: values of what the index knows: numbers, ranges (``order=">=4"``), truths
                (``symplectic=True``) and words (``kind="ark"``).

        Raises:
            UsageProblem: nothing is known by a name, or a text is no range.
        """
        from garkcli.catalogue.entries import (
            MethodFilter,
            NumberRange,
            all_entries,
            read_range,
            sorted_by,
        )

        entries = list(all_entries())
        values: dict[str, NumberRange | bool | str] = {}
        for key, value in wanted.items():
            if key not in entries[0]:
                message = f"nothing is known by the name {key!r}"
                raise UsageProblem(message, did_you_mean(key, entries[0]), code="unknown-word")
            if isinstance(value, bool):
                values[key] = value
            else:
                values[key] = str(value) if key in _WORDS else read_range(str(value))
        chosen = MethodFilter(values, folder, words)
        taken = [entry for entry in entries if chosen.takes(entry)]
        return [entry["name"] for entry in sorted_by(taken, "order")]

    def get(self, name: str, default: Any = None) -> Any:
        """The method with a name or an alias, or the default if there is none."""
        try:
            return self[name]
        except NoSuchMethod:
            return default


Mapping.register(Catalogue)


def _mapping(catalogue: Catalogue) -> Mapping[str, MethodFile]:
    return cast("Mapping[str, MethodFile]", catalogue)


def method_names() -> list[str]:
    from garkcli.methodfile.naming import every_shelf, visible

    return [method.name for _, method in visible(every_shelf())]


def _method_called(name: object) -> Shelved:
    from garkcli.methodfile.naming import FAMILY, PREFIX, find_named

    if not isinstance(name, str):
        raise NoSuchMethod(f"a name is text, not {type(name).__name__}", code="arrays")
    message = f"no method {name!r} in the catalogue"
    try:
        method = find_named(PREFIX + name.removeprefix(PREFIX))
    except MethodFileError as error:
        fault = error.faults[0]
        if fault.message.startswith("no such file"):
            raise NoSuchMethod(message, fault.help, code="unknown-word") from None
        raise NoSuchMethod(fault.message, fault.help, code=fault.code) from None
    if method is not None and method.shelf == FAMILY:
        raise NoSuchMethod(message, f"load({method.name!r}) makes it", code="unknown-word")
    if method is None:
        raise NoSuchMethod(message, "load(path) reads a file", code="unknown-word")
    return method
