"""Exact numbers from numbers of Python, NumPy, SymPy and FLINT."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any, SupportsIndex, TypeAlias

from flint import fmpq

from garkcli.errors import MethodError, counted
from garkcli.exact.given import EXACTLY, AnyNumber, complex_parts, number_text, rational_of

Number: TypeAlias = AnyNumber
"""A number or its text: an int, a Fraction, a Decimal, a float of at most 15 digits, ``"1/3"``; a
number of NumPy, SymPy or FLINT.
"""
Point: TypeAlias = "Number | complex | tuple[Number, Number]"
"""A complex number with rational parts: ``"0.01+2i"``, a Python number, or its two parts."""
Whole: TypeAlias = "SupportsIndex"
"""An integer of Python, NumPy, SymPy or FLINT."""
Settings: TypeAlias = "Mapping[str, Number]"
"""Values of parameters by name."""


def rational(given: Number, where: str) -> fmpq:
    """Returns a rational number; MethodError, with ``where`` for the argument, for others.

    >>> rational(0.25, "h"), rational("1/3 - 1/4", "h")
    (1/4, 1/12)
    """
    return rational_of(given, where)


def rational_or_none(given: Number | None, where: str) -> fmpq | None:
    return None if given is None else rational(given, where)


def rationals(given: Iterable[Number], where: str) -> list[fmpq]:
    """Raises MethodError with the index of the first wrong number."""
    if not _is_list(given):
        raise MethodError(f"{where}: {given!r} is not a list", "give a list", code="wrong-value")
    return [rational_of(x, f"{where}[{i}]") for i, x in enumerate(given)]


def points(given: Iterable[Point], where: str) -> list[tuple[fmpq, fmpq]]:
    """Returns complex numbers with rational parts; MethodError for others.

    >>> points(["0.01+2i", 2j, ("1/3", 0)], "at")
    [(1/100, 2), (0, 2), (1/3, 0)]
    """
    if not _is_list(given):
        cure = "give a list, such as ['0.01+2i']"
        raise MethodError(f"{where}: {given!r} is not a list", cure, code="wrong-value")
    return [_point(x, f"{where}[{i}]") for i, x in enumerate(given)]


def _point(given: Point, where: str) -> tuple[fmpq, fmpq]:
    parts: Any = given, 0
    if isinstance(given, str):
        parts = complex_parts(given)
    elif isinstance(given, complex):
        parts = given.real, given.imag
    elif isinstance(given, tuple) and len(given) == 2:
        parts = given
    real, imaginary = (rational_of(x, where) for x in parts)
    return real, imaginary


def whole(given: Any, where: str, least: int = 0) -> int:
    """Returns an integer from ``least`` on, such as 3.0 or "12"; MethodError for others."""
    value = rational_of(given, where)
    if value.q != 1 or value < least:
        message = f"{where}: {given} is not a whole number from {least} on"
        raise MethodError(message, f"give one, such as {max(least, 1)}", code="wrong-value")
    return int(value.p)


def colour_of(given: Any, where: str, count: int) -> int:
    """Returns a colour counted from 0, for one counted from 1; MethodError if there is none."""
    colour = whole(given, where)
    if not 1 <= colour <= count:
        some = counted(count, "colour")
        message = f"{where}: there is no colour {colour}"
        raise MethodError(message, f"the method has {some}, counted from 1", code="no-such-tree")
    return colour - 1


def colours_of(given: Iterable[Any], where: str, count: int) -> list[int]:
    if not _is_list(given):
        cure = "give a list of colours, such as [1]"
        raise MethodError(f"{where}: {given!r} is not a list", cure, code="wrong-value")
    return [colour_of(x, where, count) for x in given]


def texts(given: Settings, where: str) -> dict[str, str]:
    if not _is_mapping(given):
        cure = f"give a mapping, such as {where}={{'tau': '1/3'}}"
        raise MethodError(f"{where}: {given!r} is not a mapping", cure, code="wrong-value")
    return {name: number_text(x, f"{where}[{name!r}]", False, EXACTLY) for name, x in given.items()}


def _is_list(given: object) -> bool:
    return isinstance(given, Iterable) and not isinstance(given, str)


def _is_mapping(given: object) -> bool:
    return isinstance(given, Mapping)
