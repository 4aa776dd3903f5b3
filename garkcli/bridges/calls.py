"""Exports and imports as calls."""

from __future__ import annotations

from garkcli.bridges.collecting import collected
from garkcli.bridges.preparing import prepared
from garkcli.bridges.readers.registry import reader_named
from garkcli.bridges.registry import bridge_named
from garkcli.bridges.sources import source_files
from garkcli.errors import MethodError
from garkcli.methodfile.build import MethodFile
from garkcli.methodfile.load import load


def export(
    method: MethodFile | str, target: str, digits: int | None = None
) -> str:
    """The text that ``gark export`` writes.

    Args:
        method: from a file, a text or arrays; or a path or a name of the catalogue.
        target: as ``gark list exports`` shows it.
        digits: of every number, where they are asked for.

    Raises:
        UsageProblem: there is no such target.
        CannotExport: the target cannot hold the method.
        MethodError: the method was not read from a text.

    >>> export("heun", "csv").splitlines()[0][:1]
    '#'
    """
    if isinstance(method, str):
        method = load(method)
    if not isinstance(method, MethodFile):
        raise MethodError(
            f"{type(method).__name__} is no method file",
            "give what load, loads or from_arrays return",
        )
    return bridge_named(target).written(prepared(method, digits))


def import_methods(
    *paths: str, format: str | None = None, is_recognising: bool = False
) -> list[MethodFile]:
    """The methods that ``gark import`` finds in files and folders; nothing in them is executed.

    Args:
        paths: of the sources.
        format: what they are; by default what their names end with says it.
        is_recognising: whether to look for the exact forms of decimals.

    Raises:
        UsageProblem: a source cannot be read, or there is no such format.
    """
    readers = [] if format is None else [reader_named(format)]
    results = collected(source_files(paths), readers, is_recognising)
    return [
        result.method.method for result in results if result.method is not None
    ]
