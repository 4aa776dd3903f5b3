"""A single entry of a method, and a new value that restores an order."""

from __future__ import annotations

from garkcli.exact.field import Number
from garkcli.exact.matrix import Vector
from garkcli.frozen import Frozen, replace
from garkcli.tableau.tableau import Tableau

GAIN = 2
"""Orders that an entry has to restore to be named without a claim. Many published methods are one
entry away from the next order, none of the catalogue from two.
"""
HIGHEST_LOW = 4
"""Largest order at which an entry is sought without a claim: a wrong one hardly leaves more."""


class RepairedEntry(Frozen):
    """One entry of a method, by indices from 0; weights b^{l} have no ``m`` and no ``i``."""

    l: int
    m: int | None
    i: int | None
    j: int
    old: Number

    def put(self, method: Tableau, value: Number) -> Tableau:
        """The method with another value there, also in colours with the same stages."""
        if self.m is None or self.i is None:
            old = method.colours[self.l]
            b = _with_value(old.b, self.j, value)
            colours = (
                replace(x, b=b) if x.space == old.space and x.b == old.b else x
                for x in method.colours
            )
            return replace(method, colours=tuple(colours))
        key = method.colours[self.l].space, self.m
        block = list(method.blocks[key])
        block[self.i] = _with_value(block[self.i], self.j, value)
        return replace(method, blocks={**method.blocks, key: tuple(block)})


class Repair(RepairedEntry):
    new: Number
    is_embedded: bool = False

    def carried_out(self, method: Tableau) -> Tableau:
        return self.put(method, self.new)


def _with_value(row: Vector, j: int, value: Number) -> Vector:
    changed = list(row)
    changed[j] = value
    return tuple(changed)
