"""Blocks and rows by colours as people count them: from 1."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any, Generic, TypeVar

from garkcli.errors import MethodError

K = TypeVar("K", int, tuple[int, int])


class NoSuchColour(MethodError, KeyError):
    """There is nothing of this colour."""

    __str__ = MethodError.__str__


class ByColour(Mapping[K, Any], Generic[K]):
    """What a method has for each colour, or for each pair of them; colours count from 1.

    >>> from garkcli.tableau.bycolour import ByColour
    >>> rows = ByColour({1: (1,), 2: ("1/2", "1/2")})
    >>> rows[2], list(rows), rows.get(3)
    (('1/2', '1/2'), [1, 2], None)
    """

    __slots__ = ("_parts",)

    def __init__(self, parts: Mapping[K, Any]) -> None:
        self._parts: dict[K, Any] = dict(parts)

    def __getitem__(self, key: K) -> Any:
        """The part of a colour, or of a pair (l, m) of colours.

        Raises:
            NoSuchColour: there is none.
        """
        try:
            return self._parts[key]
        except (KeyError, TypeError):
            *_, last = self._parts
            what = "pair of colours" if isinstance(last, tuple) else "colour"
            raise NoSuchColour(
                f"{key!r} is no {what} of the method",
                f"they count from 1, the last is {last!r}",
                code="arrays",
            ) from None

    def __iter__(self) -> Iterator[K]:
        return iter(self._parts)

    def __len__(self) -> int:
        return len(self._parts)

    def __hash__(self) -> int:
        return hash(tuple(self._parts.items()))

    def __repr__(self) -> str:
        return repr(self._parts)
