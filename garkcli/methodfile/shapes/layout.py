"""A tableau of unknowns as text, which shapes change entry by entry."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, replace
from itertools import chain
from typing import Literal, TypeAlias

from garkcli.errors import MethodError

Kind: TypeAlias = Literal["tableau", "ark", "prk"]
TextRow: TypeAlias = tuple[str, ...]
Texts: TypeAlias = tuple[TextRow, ...]
ZERO = "0"
_NAME = re.compile(r"[A-Za-z_][A-Za-z0-9_]*")
_OWN = re.compile(r"[ae][0-9_]+")
"""An entry of a matrix that is an unknown of its own."""


@dataclass(frozen=True)
class Layout:
    """A tableau whose entries are zeros, names of unknowns and sums of them.

    Attributes:
        kind: the form of method file that it is.
        A: a matrix for each colour.
        b: a row of weights for each colour; of an ark one for all.
    """

    kind: Kind
    A: tuple[Texts, ...]
    b: Texts

    @property
    def stages(self) -> int:
        """How many stages it has."""
        return len(self.b[0])

    @property
    def unknowns(self) -> tuple[str, ...]:
        """The names in it, each once, row by row."""
        names: dict[str, None] = {}
        for rows in (*self.A, self.b):
            for text in _entries(rows):
                names |= dict.fromkeys(_NAME.findall(text))
        return tuple(names)

    def with_entries(self, entry: Callable[[int, int, str], str]) -> Layout:
        """The layout with the entries of its last matrix changed.

        Args:
            entry: from a row and a column, counted from 0, and the text there to another.
        """
        *others, last = self.A
        changed: list[TextRow] = []
        for i, row in enumerate(last):
            texts: list[str] = []
            for j, text in enumerate(row):
                texts.append(entry(i, j, text))
            changed.append(tuple(texts))
        return replace(self, A=(*others, tuple(changed)))

    def with_weights(self, weights: Iterable[str]) -> Layout:
        """The layout with other weights for all of its colours."""
        row = tuple(weights)
        return replace(self, b=(row,) * len(self.b))


def _entries(rows: Texts) -> Iterator[str]:
    """Every entry, row by row."""
    return chain.from_iterable(rows)


@dataclass(frozen=True)
class Shape:
    """A shape of tableaus.

    Attributes:
        name: in method files.
        summary: what it is.
        applied: the layout with that shape.
        begins: whether it says which colours there are, and so stands first.
    """

    name: str
    summary: str
    applied: Callable[[Layout], Layout]
    begins: bool = False


def full_layout(stages: int) -> Layout:
    """Every entry an unknown of its own, named by its place."""
    join = "" if stages < 10 else "_"
    numbers = range(1, stages + 1)
    rows: list[TextRow] = []
    for i in numbers:
        row = [f"a{join}{i}{join}{j}" for j in numbers]
        rows.append(tuple(row))
    weights = tuple(f"b{join}{i}" for i in numbers)
    return Layout("tableau", (tuple(rows),), (weights,))


def with_nodes(layout: Layout) -> Layout:
    """The layout with the node c_i an unknown in place of the first entry of row i.

    Where that entry is an unknown that stands nowhere else it is the node minus the rest of the
    row: the same methods, and values for nodes are the ones people choose.
    """
    if layout.kind == "prk":
        return layout
    matrices = tuple(_with_nodes(rows, layout) for rows in layout.A)
    return replace(layout, A=matrices)


def _with_nodes(rows: Texts, layout: Layout) -> Texts:
    everything = list(layout.b[0])
    for block in layout.A:
        everything += _entries(block)
    join = "" if layout.stages < 10 else "_"
    changed: list[TextRow] = []
    for i, row in enumerate(rows, start=1):
        first, *others = row
        uses = [text for text in everything if first in _NAME.findall(text)]
        if not _OWN.fullmatch(first) or len(uses) > 1:
            changed.append(row)
            continue
        rest = [x for x in others if x != ZERO]
        difference = " - ".join([f"c{join}{i}", *rest])
        changed.append((difference, *others))
    return tuple(changed)


def refuse_shape(message: str, cure: str) -> MethodError:
    """What is wrong with shapes that do not go together."""
    return MethodError(message, cure)
