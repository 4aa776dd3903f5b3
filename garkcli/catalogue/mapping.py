"""The catalogue as a mapping from names to methods: ``garkcli.catalogue["rk4"]``.

The room itself is this mapping, so that whoever imports it in whatever way has the same object:
``import garkcli.catalogue`` and ``from garkcli import catalogue``.
"""

from __future__ import annotations

from collections.abc import ItemsView, Iterator, KeysView, Mapping, ValuesView
from types import ModuleType
from typing import TYPE_CHECKING, Any, cast

from garkcli.errors import GarkError, MethodFileError

if TYPE_CHECKING:
    from garkcli.methodfile.build import MethodFile
    from garkcli.methodfile.shelves import Shelved


class NoSuchMethod(GarkError, KeyError):
    """No method of the catalogue has this name."""


class Catalogue(ModuleType):
    """Published methods by their names; each is read when it is asked for.

    Its keys are the names, those of folders in ``GARK_PATH`` first; aliases are looked up too, as
    on the command line. A method that is asked for twice is read twice.
    """

    def __getitem__(self, name: str) -> MethodFile:
        """The method of a name or an alias.

        Raises:
            NoSuchMethod: there is none, or the name may mean several.
            MethodFileError: its file cannot be read as a method.
        """
        from garkcli.methodfile.load import loads

        found = _found(name)
        return loads(found.read(), found.name)

    def __contains__(self, name: object) -> bool:
        try:
            return _found(name) is not None
        except NoSuchMethod:
            return False

    def __iter__(self) -> Iterator[str]:
        return iter(_names())

    def __len__(self) -> int:
        return len(_names())

    def __bool__(self) -> bool:
        return True  # a module is true; nothing is counted for that

    def keys(self) -> KeysView[str]:
        """The names."""
        return KeysView(_mapping(self))

    def values(self) -> ValuesView[MethodFile]:
        """The methods; each is read when it is come to."""
        return ValuesView(_mapping(self))

    def items(self) -> ItemsView[str, MethodFile]:
        """Names and methods."""
        return ItemsView(_mapping(self))

    def get(self, name: str, default: Any = None) -> Any:
        """The method of a name or an alias; the default where there is none."""
        try:
            return self[name]
        except NoSuchMethod:
            return default


Mapping.register(Catalogue)


def _mapping(catalogue: Catalogue) -> Mapping[str, MethodFile]:
    """The same, for type checkers."""
    return cast("Mapping[str, MethodFile]", catalogue)


def _names() -> list[str]:
    """The names of all methods."""
    from garkcli.methodfile.naming import every_shelf, visible

    return [method.name for _, method in visible(every_shelf())]


def _found(name: object) -> Shelved:
    """Where the method of a name is.

    Raises:
        NoSuchMethod: there is none, or the name may mean several.
    """
    from garkcli.methodfile.naming import PREFIX, find_named

    if not isinstance(name, str):
        raise NoSuchMethod(f"a name is text, not {type(name).__name__}")
    message = f"no method {name!r} in the catalogue"
    try:
        found = find_named(PREFIX + name.removeprefix(PREFIX))
    except MethodFileError as error:
        fault = error.faults[0]
        if fault.message.startswith("no such file"):
            raise NoSuchMethod(message, fault.help) from None
        raise NoSuchMethod(fault.message, fault.help) from None
    if found is None:
        raise NoSuchMethod(message, "load(path) reads a file")
    return found
