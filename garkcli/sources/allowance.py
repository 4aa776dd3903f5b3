"""Limits on the size of one source: names that stand for lists, zeros, and tables are counted
before they are expanded.
"""

from __future__ import annotations

from garkcli.sources.found import MAX_TABLES, FoundTable, Row, TooLarge

MAX_WRITTEN = 10_000_000
"""Most characters of the numbers of a source after expansion of its names and zeros."""
FREE = 1_000_000
"""Characters allowed for the shortest source."""
TIMES = 20
"""Further characters allowed for each character of the source."""


class Allowance:
    """The remaining allowance of one source.

    Args:
        length: of the source, in characters; 0 for a source without names.

    Attributes:
        line: the current line, from 1.
    """

    def __init__(self, length: int) -> None:
        self.line = 1
        self._most = min(FREE + TIMES * length, MAX_WRITTEN) if length else MAX_WRITTEN
        self._written = 0
        self._tables = 0

    def spend(self, characters: int) -> None:
        """Counts characters to be written out.

        Raises:
            TooLarge: there are too many.
        """
        self._written += characters
        if self._written > self._most:
            what = "characters of numbers when its names and zeros are written out"
            raise TooLarge(f"the source has more than {self._most} {what}", self.line)

    def table(self, table: FoundTable, is_kept: bool = True) -> FoundTable:
        """Counts a table and returns it.

        Raises:
            TooLarge: it is one too many, or too large.
        """
        self._tables += is_kept
        if self._tables > MAX_TABLES:
            raise TooLarge(f"the source has more than {MAX_TABLES} tables", table.line)
        self.line = table.line
        rows: list[Row] = [*table.b, *filter(None, table.c), *(table.embedded or ())]
        blocks = [block for row in table.A for block in row if block is not None]
        for block in (*blocks, *(table.dense or ())):
            rows += block
        self.spend(sum(len(x) + 1 for row in rows for x in row))
        return table
