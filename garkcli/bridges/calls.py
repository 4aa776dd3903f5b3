"""Exports, imports and audits as calls."""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator
from typing import TypeAlias

from garkcli.api.anymethod import AnyMethod, method_of, refuse_rounded
from garkcli.api.numbers import Whole, whole
from garkcli.bridges.audit import Audited, audited
from garkcli.bridges.collecting import collected
from garkcli.bridges.patching import patches
from garkcli.bridges.preparing import prepared
from garkcli.bridges.registry import bridge_named
from garkcli.bridges.sources import source_files
from garkcli.methodfile.build import MethodFile

AnyPath: TypeAlias = "str | os.PathLike[str]"
"""The path of a file or a folder."""


def export(method: AnyMethod, target: str, digits: Whole | None = None) -> str:
    """The text that ``gark export`` writes.

    Args:
        method: from a file, a text or arrays, or its ``conjugate`` or ``pair``; or a path or a name
            of the catalogue.
        target: as ``gark list exports`` shows it.
        digits: decimals with so many digits, correctly rounded; by default exact numbers, or as
            many digits as the target reads.

    Raises:
        UsageProblem: there is no such target.
        CannotExport: the target cannot hold the method.
        MethodError: the method was not read from a text, or it is the conjugate or the pair of
            rounded coefficients.

    >>> export("heun", "csv").splitlines()[0][:1]
    '#'
    """
    method = method_of(method)
    refuse_rounded(method)
    many = None if digits is None else whole(digits, "digits", 1)
    return bridge_named(target).written(prepared(method, many))


def import_methods(
    *paths: AnyPath,
    format: str | None = None,
    is_recognising: bool = False,
    is_as_found: bool = False,
) -> list[MethodFile]:
    """The methods that ``gark import`` finds in files and folders; nothing in them is executed.

    Each claims what its source declares, true or not: ``claims_of`` has what is true.

    Args:
        paths: of the sources.
        format: of the sources; by default the endings of their names decide.
        is_recognising: whether to seek exact forms of decimals.
        is_as_found: whether methods claim their true orders instead of the declared ones.

    Raises:
        UsageProblem: a source cannot be read, or there is no such format.

    >>> import_methods("tests/bridges/sources/kutta.csv")
    [<MethodFile kutta: 1 colour, stages 3>]
    """
    results = collected(_files(paths), format, is_recognising, is_as_found)
    return [result.method.method for result in results if result.method is not None]


def audit(paths: AnyPath | Iterable[AnyPath], jobs: Whole = 1) -> Iterator[Audited]:
    """The tables of some sources with their findings: ``gark audit``.

    Args:
        paths: files and folders, or one of them.
        jobs: the number of processes; 0 is one per processor.

    Raises:
        UsageProblem: a source cannot be read.

    >>> [found.has_errors for found in audit("tests/bridges/sources/kutta.csv")]
    [False]
    """
    if isinstance(paths, (str, os.PathLike)):
        paths = [paths]
    return audited(_files(paths), whole(jobs, "jobs", 0))


def audit_patch(paths: AnyPath | Iterable[AnyPath]) -> str:
    """The unified diff of ``gark audit --fix`` with the certain repairs; no file changes.

    Args:
        paths: files and folders below the current folder, or one of them.

    Raises:
        UsageProblem: a source cannot be read.

    >>> audit_patch("tests/bridges/sources/kutta.csv")
    ''
    """
    if isinstance(paths, (str, os.PathLike)):
        paths = [paths]
    files = list(_files(paths))
    return "".join(piece for _, piece in patches(audited(files), files))


def _files(paths: Iterable[AnyPath]) -> Iterator[str]:
    return source_files(os.fspath(path) for path in paths)
