"""A family of methods without denominators: its blocks and its weights as polynomials."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import chain
from typing import Any, TypeAlias

from flint import fmpq

from garkcli.exact.field import ONE
from garkcli.exact.parametric import Parameters, common_denominator, fraction
from garkcli.tableau.tableau import Edge, Tableau

Entry: TypeAlias = Any
"""A polynomial of parameters, or an exact number."""
Row: TypeAlias = tuple[Entry, ...]
Square: TypeAlias = tuple[Row, ...]


@dataclass(frozen=True)
class Cleared:
    """A tableau times denominators.

    Attributes:
        tableau: its entries are rational numbers and rational functions, or exact numbers.
        blocks: D A.
        weights: E b, a row a colour.
        D, E: the common denominators.
        one: 1 among the entries.
    """

    tableau: Tableau
    blocks: Mapping[Edge, Square]
    weights: tuple[Row, ...]
    D: Entry
    E: Entry
    one: Entry

    @classmethod
    def of(cls, tableau: Tableau, ring: Parameters | None) -> Cleared:
        """The tableau of a family with parameters, or of one method."""
        weights = tuple(colour.b for colour in tableau.colours)
        if ring is None:
            return cls(tableau, tableau.blocks, weights, ONE, ONE, ONE)
        rows = chain.from_iterable(tableau.blocks.values())
        D = common_denominator(chain.from_iterable(rows), ring)
        E = common_denominator(chain.from_iterable(weights), ring)

        def cleared(row: Sequence[object], denominator: Entry) -> Row:
            parts = [fraction(x, ring) for x in row]
            return tuple(numerator * (denominator // own) for numerator, own in parts)

        blocks = {
            edge: tuple(cleared(row, D) for row in block) for edge, block in tableau.blocks.items()
        }
        b = tuple(cleared(row, E) for row in weights)
        return cls(tableau, blocks, b, D, E, ring.constant(fmpq(1)))

    def alone(self, l: int) -> Cleared:
        """One colour by itself."""
        colour = self.tableau.colours[l]
        space = self.tableau.spaces[colour.space]
        key = colour.space, l
        has_block = key in self.blocks
        own = {(0, 0): self.tableau.blocks[key]} if has_block else {}
        tableau = Tableau((space,), (replace(colour, space=0),), own)
        blocks = {(0, 0): self.blocks[key]} if has_block else {}
        return replace(self, tableau=tableau, blocks=blocks, weights=(self.weights[l],))
