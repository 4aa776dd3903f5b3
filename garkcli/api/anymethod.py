"""The kinds of arguments that stand for a method."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from typing import Any, TypeAlias

from flint import fmpq

from garkcli.api.arrays import from_arrays
from garkcli.errors import MethodError
from garkcli.exact.given import rational_of
from garkcli.frozen import replace
from garkcli.methodfile.load import load
from garkcli.order.meant import AnyTableau, as_meant, meant
from garkcli.tableau.forms import gark
from garkcli.tableau.garkmethod import GarkMethod
from garkcli.tableau.tableau import Method, Tableau

AnyMethod: TypeAlias = (
    "GarkMethod | Tableau | Method | str | os.PathLike[str] | Sequence[Any] | Mapping[str, Any]"
)
"""A method or a tableau; a path or a name of the catalogue; arrays ``(A, b)``, ``(A, b, c)`` or
``(A, b, c, embedded)``, or a mapping of arguments of ``from_arrays``.
"""
_ROWS = ("A", "b", "c", "embedded")
_CURE = "load a file with load(path), or make one with from_arrays(A, b)"


def method_of(given: AnyMethod, tolerance: object = None, is_any_kind: bool = False) -> GarkMethod:
    """The method for an argument, with its entries as printed.

    Args:
        given: an ``AnyMethod``: a method, a path, a name of the catalogue, or arrays ``(A, b)``.
        tolerance: the rounding of arrays without one of their own.
        is_any_kind: whether the method may be other than a GARK method.

    Raises:
        MethodError: the argument is none of these.
        MethodFileError: there is no such file or name, or the file is not a method.

    >>> method_of(([[0, 0], [1, 0]], ["1/2", "1/2"])).stages
    (2,)
    """
    found = _method_of(given, tolerance)
    if not is_any_kind:
        found.tableau.demand_fields("this function")
    return found


def _method_of(given: AnyMethod, tolerance: object) -> GarkMethod:
    if isinstance(given, GarkMethod):
        return given
    if isinstance(given, Tableau):
        return GarkMethod(tableau=given)
    if isinstance(given, Method):
        return GarkMethod(tableau=gark([given], {}), name=given.name)
    if isinstance(given, (str, os.PathLike)):
        return load(os.fspath(given))
    if isinstance(given, Mapping):
        return _of_mapping({**_rounded(tolerance), **given})
    if isinstance(given, (tuple, list)):
        if not 2 <= len(given) <= len(_ROWS):
            message = f"{len(given)} arrays are not a method"
            cure = "give (A, b), (A, b, c) or (A, b, c, embedded)"
            raise MethodError(message, cure, code="arrays")
        return from_arrays(*given, **_rounded(tolerance))
    raise MethodError(f"a method is expected, not {type(given).__name__}", _CURE, code="arrays")


def tableau_of(given: AnyMethod) -> Tableau:
    """Returns the tableau for an argument; errors are those of ``method_of``."""
    if isinstance(given, Tableau):
        return given
    return method_of(given).tableau


def tolerance_of(method: object, given: object = None) -> fmpq | None:
    """Returns the given tolerance, or that of the file; MethodError unless it is in [0, 1)."""
    if given is None:
        return method.tolerance if isinstance(method, GarkMethod) else None
    value = rational_of(given, "tolerance", is_rounded=True)
    if not 0 <= value < 1:
        message = "a tolerance lies between 0 and 1"
        raise MethodError(message, "for instance '1e-13'", code="wrong-value")
    return value or None


def refuse_rounded(method: GarkMethod) -> None:
    """Raises MethodError for a derived rounded method, whose errors exceed the tolerance."""
    derivation = method.derivation
    if derivation and method.tolerance is not None:
        message = f"the coefficients are rounded, and those of the {derivation} by more"
        raise MethodError(message, "give exact coefficients, without tolerance", code="rounded")


def with_tolerance(
    given: AnyMethod, tolerance: object = None, is_any_kind: bool = False
) -> tuple[GarkMethod, fmpq | None]:
    method = method_of(given, tolerance, is_any_kind)
    if tolerance is not None and (method.embedded_tolerance or method.dense_tolerance):
        # that of its further weights is another too
        method = replace(method, tableau=replace(method.tableau))
    return method, tolerance_of(method, tolerance)


def meant_of(
    given: AnyMethod, tolerance: object = None, is_any_kind: bool = False
) -> tuple[GarkMethod, AnyTableau]:
    """Returns a method, and its tableau within the given or its own rounding."""
    method, near = with_tolerance(given, tolerance, is_any_kind)
    return method, as_meant(method) if tolerance is None else meant(method.tableau, near)


def _rounded(tolerance: object) -> dict[str, Any]:
    is_rounded = tolerance_of(None, tolerance) is not None
    return {"tolerance": tolerance} if is_rounded else {}


def _of_mapping(given: Mapping[str, Any]) -> GarkMethod:
    known = (*_ROWS, "name", "tolerance")
    for key in given:
        if key not in known:
            names = ", ".join(known)
            raise MethodError(f"no array {key!r}", f"one of: {names}", code="unknown-word")
    missing = [key for key in ("A", "b") if key not in given]
    if missing:
        raise MethodError(f"{missing[0]} is missing", "give A and b", code="missing-key")
    return from_arrays(**given)
