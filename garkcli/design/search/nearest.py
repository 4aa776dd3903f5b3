"""The method of a family that is nearest to a given one: a place where a search may start."""

from __future__ import annotations

from collections.abc import Iterator

from flint import arb, fmpq

from garkcli.design.search.least_squares import least_squares
from garkcli.design.search.rational import RationalFunction, System
from garkcli.errors import UsageProblem, counted
from garkcli.exact.display import to_ball
from garkcli.exact.enclosing import midpoint
from garkcli.exact.field import Number
from garkcli.exact.parametric import Parameters
from garkcli.tableau.embedded import Further, with_weights
from garkcli.tableau.family import Family
from garkcli.tableau.pointwise import numeric_entries
from garkcli.tableau.tableau import Tableau

BITS = 64


def nearest_member(family: Family, method: Tableau, further: Further) -> list[float]:
    """A local minimum of the sum of squared differences to a method, from 1/2 for each unknown. It
    is zero at members; embedded weights count if both have some. Raises UsageProblem if sizes
    differ.
    """
    import numpy as np

    is_alike = family.tableau.size == method.size
    if not is_alike or _shape(family.tableau) != _shape(method):
        sizes = [
            f"{' + '.join(map(str, _shape(x)))} stages for {counted(x.size, 'vector field')}"
            for x in (method, family.tableau)
        ]
        message = f"the start has {sizes[0]}, the methods of the file {sizes[1]}"
        raise UsageProblem(message, "name a method with as many", code="option-value")
    pairs = list(_pairs(family.tableau, method))
    if family.further.embedded is not None and further.embedded is not None:
        own = with_weights(family.tableau, family.further.embedded)
        pairs += list(_weights(own, with_weights(method, further.embedded)))
    differences = [_difference(x, value, family.ring) for x, value in pairs]
    start = np.full((len(family.ring.names), 1), 0.5)
    found = least_squares(System(differences).at, start).points[:, 0]
    return [float(x) for x in found]


def _shape(tableau: Tableau) -> list[int]:
    return [space.stages for space in tableau.spaces]


def _pairs(family: Tableau, method: Tableau) -> Iterator[tuple[Number, Number]]:
    entries = numeric_entries(method).A
    for l, row in enumerate(entries):
        for m, given in enumerate(row):
            block = family.block(l, m)
            if block is not None and given is not None:
                for own, other in zip(block, given, strict=True):
                    yield from zip(own, map(_rational, other), strict=True)
    yield from _weights(family, method)


def _weights(family: Tableau, method: Tableau) -> Iterator[tuple[Number, Number]]:
    for colour, row in zip(family.colours, numeric_entries(method).b, strict=True):
        yield from zip(colour.b, map(_rational, row), strict=True)


def _rational(x: Number | arb) -> fmpq:
    return midpoint(x if isinstance(x, arb) else to_ball(x, BITS))


def _difference(entry: Number, value: Number, ring: Parameters) -> RationalFunction:
    return RationalFunction(entry - value, ring)
