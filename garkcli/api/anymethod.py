"""What stands for a method: a name, a path, arrays, or a method itself."""

from __future__ import annotations

import os
from collections.abc import Mapping
from typing import Any

from garkcli.api.arguments import tableau_of
from garkcli.api.arrays import from_arrays
from garkcli.api.methods import method_of
from garkcli.errors import MethodError
from garkcli.methodfile.load import load
from garkcli.tableau.garkmethod import GarkMethod

_ROWS = ("A", "b", "c", "embedded")


def as_method(given: Any) -> GarkMethod:
    """The method that is meant.

    Args:
        given: a method, a tableau; a path, or a name of the catalogue; a tuple ``(A, b)``,
            ``(A, b, c)`` or ``(A, b, c, embedded)``, or a mapping of what ``from_arrays`` takes.

    Raises:
        MethodError: it is none of these.
        MethodFileError: there is no such file or name, or it is no method.

    >>> as_method(([[0, 0], [1, 0]], ["1/2", "1/2"])).stages
    (2,)
    >>> as_method("rk4").name
    'the classical Runge-Kutta method'
    """
    if isinstance(given, (str, os.PathLike)):
        return load(os.fspath(given))
    if isinstance(given, Mapping):
        return _of_mapping(given)
    if isinstance(given, (tuple, list)):
        if not 2 <= len(given) <= len(_ROWS):
            raise MethodError(
                f"{len(given)} arrays are no method",
                "give (A, b), (A, b, c) or (A, b, c, embedded)",
            )
        return from_arrays(*given)
    tableau_of(given)  # what is no method is refused here
    return method_of(given)


def _of_mapping(given: Mapping[str, Any]) -> GarkMethod:
    known = (*_ROWS, "name", "tolerance")
    for key in given:
        if key not in known:
            names = ", ".join(known)
            raise MethodError(f"no array {key!r}", f"one of: {names}")
    missing = [key for key in ("A", "b") if key not in given]
    if missing:
        raise MethodError(f"{missing[0]} is missing", "give A and b")
    return from_arrays(**given)
