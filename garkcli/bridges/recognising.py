"""Exact forms of decimals, accepted if the order does not fall."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from operator import ge
from typing import Any

from garkcli.bridges.claiming import imported
from garkcli.bridges.importing import numbers_of
from garkcli.bridges.subject import TableSubject
from garkcli.design.search.proposing import FEWEST_DIGITS, Proposal, proposed, significant_digits
from garkcli.errors import MethodFileError
from garkcli.frozen import Frozen, replace
from garkcli.sources.found import FoundTable

MAX_NUMBERS = 400


class Recognised(Frozen):
    """A method with exact forms of its decimals: with ``refused`` ones its order falls. The
    decimals ``left`` have no exact form.
    """

    method: TableSubject
    taken: tuple[Proposal, ...]
    refused: tuple[Proposal, ...]
    left: tuple[str, ...]

    def notes(self) -> Iterator[str]:
        yield from (f"{x.printed} is {x.exact}, {x.distance} away" for x in self.taken)
        for x in self.refused:
            yield f"{x.printed} is not {x.exact}: with it the order falls"
        yield from (f"{text} stays a decimal" for text in self.left)


def recognised(before: TableSubject, name: str, is_as_found: bool = False) -> Recognised:
    """The method with as many exact numbers as the certificate of the order confirms."""
    texts = dict.fromkeys(numbers_of(before.table))
    decimals = [x for x in texts if significant_digits(x) >= FEWEST_DIGITS]
    proposals = {x: proposed(x) for x in decimals[:MAX_NUMBERS]}
    left = tuple(x for x in decimals if proposals.get(x) is None)
    # the shortest forms are the most certain, so the longest are given up first
    kept = sorted(filter(None, proposals.values()), key=lambda x: len(x.exact))
    refused: list[Proposal] = []
    while kept:
        after = _with(before.table, {x.printed: x.exact for x in kept}, name, is_as_found)
        if after is not None and all(map(ge, _orders(after), _orders(before))):
            return Recognised(after, tuple(kept), tuple(refused), left)
        refused.append(kept.pop())
    return Recognised(before, (), tuple(refused), left)


def _orders(found: TableSubject) -> list[int]:
    return [x.order for x in (found.order, found.embedded_order) if x is not None]


def _with(
    table: FoundTable, exact: Mapping[str, str], name: str, is_as_found: bool
) -> TableSubject | None:
    """The method with other texts, without the rounding given in the source."""

    def changed(value: Any) -> Any:
        return tuple(map(changed, value)) if isinstance(value, tuple) else exact.get(value, value)

    numbers = {key: changed(getattr(table, key)) for key in ("A", "b", "c", "embedded")}
    try:
        return imported(replace(table, **numbers, tolerance=""), name, is_as_found)
    except MethodFileError:
        return None
