"""How much one source may become: names that stand for lists, zeros, and tables are counted before
they are written out.
"""

from __future__ import annotations

from collections.abc import Iterable

from garkcli.sources.found import MAX_TABLES, FoundTable, Row, TooLarge
from garkcli.sources.scalars import Scalar, Value, combined, transposed

MAX_WRITTEN = 10_000_000
"""Most characters of the numbers of a source, its names and zeros written out."""
MAX_READ_AGAIN = 10_000_000
"""Most words and signs that are read again, as what begins before them is no value."""


class Allowance:
    """What is left of it for one source.

    Attributes:
        line: of what is read, from 1.
    """

    def __init__(self) -> None:
        self.line = 1
        self._written = 0
        self._read_again = 0
        self._tables = 0

    def spend(self, characters: int) -> None:
        """Write out so many characters.

        Raises:
            TooLarge: that is too many.
        """
        self._written += characters
        if self._written > MAX_WRITTEN:
            what = "characters of numbers when its names and zeros are written out"
            raise TooLarge(f"the source has more than {MAX_WRITTEN} {what}", self.line)

    def read_again(self, words: int) -> None:
        """Read so many words and signs again.

        Raises:
            TooLarge: that is too many.
        """
        self._read_again += words
        if self._read_again > MAX_READ_AGAIN:
            what = "words in values and brackets that do not end"
            raise TooLarge(f"the source has more than {MAX_READ_AGAIN} {what}", self.line)

    def kept(self, value: Value) -> Value:
        """A value that is kept from now on."""
        self.spend(length(value))
        return value

    def copied(self, value: Value) -> Value:
        """A list with rows of its own, as another name may change entries of it. No value holds
        one list twice, so all that is done to values takes as long as they are.
        """
        if not isinstance(value, list):
            return value
        self.spend(length(value))
        return _copied(value)

    def combined(self, sign: str, left: Value, right: Value) -> Value:
        """As ``scalars.combined``, where lists are counted."""
        lists = [x for x in (left, right) if isinstance(x, list)]
        if lists:
            factor = next((x for x in (left, right) if isinstance(x, Scalar)), Scalar(""))
            self.spend(sum(length(x, len(factor.text)) for x in lists))
        return combined(sign, left, right)

    def transposed(self, value: Value) -> Value:
        """As ``scalars.transposed``, counted."""
        self.spend(length(value))
        return transposed(value)

    def table(self, table: FoundTable) -> FoundTable:
        """A table that is kept.

        Raises:
            TooLarge: it is one too many, or too large.
        """
        self._tables += 1
        if self._tables > MAX_TABLES:
            raise TooLarge(f"the source has more than {MAX_TABLES} tables", table.line)
        self.line = table.line
        rows: list[Row] = [*table.b, *filter(None, table.c), *(table.embedded or ())]
        blocks = [block for row in table.A for block in row if block is not None]
        for block in (*blocks, *(table.dense or ())):
            rows += block
        self.spend(sum(len(x) + 1 for row in rows for x in row))
        return table

    def tables(self, tables: Iterable[FoundTable]) -> list[FoundTable]:
        """Tables that are kept, counted as they are made."""
        return [self.table(x) for x in tables]


def length(value: Value, more: int = 0) -> int:
    """The characters of a value written out, with some more for each of its numbers.

    >>> length([Scalar("1/2"), [Scalar("0")]])
    8
    """
    if isinstance(value, list):
        return 1 + sum(length(x, more) for x in value)
    text = value.text if isinstance(value, Scalar) else value if isinstance(value, str) else ""
    return len(text) + 1 + more


def _copied(value: Value) -> Value:
    return [_copied(x) for x in value] if isinstance(value, list) else value
