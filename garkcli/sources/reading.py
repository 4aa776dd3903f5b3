"""From the text of a source to its tables: parsed, evaluated, searched."""

from __future__ import annotations

import re
from collections.abc import Callable

from garkcli.sources import ir
from garkcli.sources.allowance import Allowance
from garkcli.sources.finder import TableFinder
from garkcli.sources.found import FoundTable, troubled
from garkcli.sources.naming import role_of
from garkcli.sources.signatures import CONSTRUCTOR

HINTS = re.compile(
    r"tableau|butcher|runge.?kutta|register|embedd|order|weights|nodes"
    r"|(?<![a-z])(?:a|b|c)(?:mat|vec|hat)?\w?(?:\[|\s*=|_|\d\d|\{)",
    re.IGNORECASE,
)
"""What a source has a table with has some of these words."""
SHORT = 5_000
"""A source with fewer characters is read in any case."""


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
        source: what it is called.
        format: what the language is called.
        lowered: from a text to its statements.
        base: the index of the first entry of an array.
        is_growing: whether all arrays grow.
        has_whole_quotients: whether ``1/2`` is 0.

    Raises:
        TooLarge: the source says too much.
    """
    if len(text) > SHORT and not HINTS.search(text):
        return []
    allowance = Allowance(len(text))
    finder = TableFinder(source, format, base, allowance, is_growing, has_whole_quotients)
    finder.module(lowered(text))
    found = finder.tables()
    for scope in finder.given_up:
        assigned = (x.target for x in ir.inside(scope.body) if isinstance(x, ir.Assign))
        names = (x.name for x in ir.inside(tuple(assigned)) if isinstance(x, ir.Name | ir.Field))
        roles = {told[1] for told in map(role_of, names) if told}
        if not ({"A", "b"} <= roles or CONSTRUCTOR.fullmatch(scope.name)):
            continue
        place = FoundTable(source, scope.line, format, scope.name, (), ())
        found.append(troubled(place, "it takes too much work to read"))
    return found
