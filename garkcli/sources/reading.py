"""From the text of a source to its tables: parsed, evaluated, searched."""

from __future__ import annotations

import re
from collections.abc import Callable

from garkcli.sources import ir
from garkcli.sources.allowance import Allowance
from garkcli.sources.finder import TableFinder
from garkcli.sources.found import FoundTable, TooLarge
from garkcli.sources.naming import speaks
from garkcli.sources.recognised import with_readings

HINTS = re.compile(
    r"tableau|butcher|runge.?kutta|register|embedd|order|weights|nodes"
    r"|(?<![a-z])(?:a|b|c)(?:mat|vec|hat)?\w?(?:\[|\s*=|_|\d\d|\{)",
    re.IGNORECASE,
)
"""Every source with a table has some of these words."""
SHORT = 5_000
"""Shorter sources are read in any case."""


def tables_in(
    text: str,
    source: str,
    format: str,
    lowered: Callable[[str], ir.Body],
    base: int,
    is_growing: bool = False,
    has_whole_quotients: bool = False,
) -> list[FoundTable]:
    """The tables of a source in a language.

    Args:
        text: of the source.
        source: its name.
        format: the name of the language.
        lowered: makes the statements of a text.
        base: the index of the first entry of an array.
        is_growing: whether all arrays grow.
        has_whole_quotients: whether ``1/2`` is 0.

    Raises:
        TooLarge: the source exceeds a limit.
    """
    if len(text) > SHORT and not (HINTS.search(text) or speaks(text)):
        return []
    allowance = Allowance(len(text))
    finder = TableFinder(source, format, base, allowance, is_growing, has_whole_quotients)
    statements = lowered(text)
    try:
        finder.module(statements)
        return with_readings(finder, finder.tables(statements, text))
    except RecursionError:
        raise TooLarge("values are nested too deep", allowance.line) from None
