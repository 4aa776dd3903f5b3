"""Nodes in place of entries as unknowns: the conditions are simpler in these."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import cast

from flint import fmpq, fmpq_mpoly

from garkcli.exact.parametric import Mixed, Parameters, Parametric
from garkcli.tableau.point_space import PointSpace
from garkcli.tableau.tableau import Tableau


@dataclass(frozen=True)
class Changes:
    """Unknowns that are replaced by others.

    Attributes:
        old: the ring of the unknowns.
        ring: that of the new ones, in the same places.
        instead: by the place of an old unknown what it is, in the new ones.
    """

    old: Parameters
    ring: Parameters
    instead: Mapping[int, fmpq_mpoly]

    def polynomial(self, p: fmpq_mpoly) -> fmpq_mpoly:
        """A polynomial in the new unknowns."""
        if not self.instead:
            return p
        context = self.ring.context
        given = [self.instead.get(i, context.gen(i)) for i in range(len(self.ring.names))]
        return p.compose(*given, ctx=context)

    def values(self) -> dict[str, Mixed]:
        """The old unknowns as functions of the new ones."""
        found: dict[str, Mixed] = {}
        one = self.ring.constant(fmpq(1))
        for i, name in enumerate(self.old.names):
            polynomial = self.instead.get(i, self.ring.context.gen(i))
            found[name] = self.ring.quotient(polynomial, one)
        return found


def nodes_as_coordinates(tableau: Tableau, ring: Parameters) -> Changes:
    """Each node that is a sum of several unknowns in place of the first of them that is in no other
    node.
    """
    nodes = dict(_nodes(tableau))
    names = list(ring.names)
    instead: dict[int, fmpq_mpoly] = {}
    chosen: dict[int, fmpq_mpoly] = {}
    for name, node in nodes.items():
        others = [x for key, x in nodes.items() if key != name]
        for i in _places(node):
            is_alone = not any(x.degrees()[i] for x in others)
            if is_alone and name not in names:
                names[i] = name
                chosen[i] = node
                break
    new = Parameters(names)
    for i, node in chosen.items():
        moved = new.context.from_dict(dict(node.to_dict()))
        slope = moved.derivative(i).leading_coefficient()
        here = new.context.gen(i)
        # node = slope x + rest, and its place now has the node itself
        instead[i] = here / slope - (moved - here * slope) / slope
    return Changes(ring, new if instead else ring, instead)


def _nodes(tableau: Tableau) -> Iterator[tuple[str, fmpq_mpoly]]:
    """The nodes that are sums of several unknowns, with names for them."""
    for l, colour in enumerate(tableau.colours, start=1):
        if not isinstance(tableau.spaces[colour.space], PointSpace):
            continue
        for i, node in enumerate(colour.c, start=1):
            x = cast("Mixed", node)
            if not isinstance(x, Parametric) or not x.denominator.is_one():
                continue
            if x.numerator.total_degree() == 1 and len(_places(x.numerator)) > 1:
                name = f"c{i}" if tableau.size == 1 else f"c{l}_{i}"
                yield name, x.numerator


def _places(p: fmpq_mpoly) -> list[int]:
    """The unknowns that occur."""
    return [i for i, degree in enumerate(p.degrees()) if degree]
