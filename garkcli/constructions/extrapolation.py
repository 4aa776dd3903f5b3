"""Extrapolation: a method with several numbers of substeps, combined so that powers of h cancel.

E. Hairer, S. P. Nørsett, G. Wanner, *Solving Ordinary Differential Equations I*, section II.9: the
error of a method of order p with n equal substeps has an expansion in h^p, h^(p+1), …, that of a
symmetric method in h^p, h^(p+2), …
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace

from flint import fmpq

from garkcli.constructions.composition import Substep, composed, count_stages, refuse_large
from garkcli.exact.field import ZERO, Number
from garkcli.exact.matrix import Matrix, Vector
from garkcli.families.extrapolated import extrapolation_weights
from garkcli.properties.reduction import merged
from garkcli.tableau.stages import PointSpace
from garkcli.tableau.tableau import Colour, Edge, Tableau


def extrapolated(base: Tableau, parts: Sequence[int], order: int, is_symmetric: bool) -> Tableau:
    """The extrapolated method, equal stages once.

    Args:
        base: the method, its stages at points.
        parts: how many equal substeps it takes, a number for each row of the extrapolation table.
        order: of the base.
        is_symmetric: whether its error has every second power only.

    Raises:
        MethodError: there are too many stages.
    """
    refuse_large(count_stages(base) * sum(parts), "extrapolate fewer times, or a smaller method")
    gap = 2 if is_symmetric else 1
    powers = range(order, order + gap * (len(parts) - 1), gap)
    weights = extrapolation_weights(parts, powers)
    rows = [composed([Substep(base, fmpq(1, n))] * n) for n in parts]
    return merged(side_by_side(rows, weights))


def side_by_side(tableaus: Sequence[Tableau], weights: Vector) -> Tableau:
    """The method Σ w_j Φ_j: every method on its own from the same value, their results combined."""
    first = tableaus[0]
    colours = [_side_by_side(tableaus, weights, l) for l in range(first.size)]
    nodes = (next(x.c for x in colours if x.space == k) for k in range(len(first.spaces)))
    blocks: dict[Edge, Matrix] = {}
    for place in first.blocks:
        _, m = place
        widths = [len(x.colours[m].b) for x in tableaus]
        parts = [x.blocks[place] for x in tableaus]
        blocks[place] = tuple(_diagonal(parts, widths))
    return Tableau(tuple(map(PointSpace, nodes)), tuple(colours), blocks)


def _side_by_side(tableaus: Sequence[Tableau], weights: Vector, l: int) -> Colour:
    b: list[Number] = []
    c: list[Number] = []
    for tableau, weight in zip(tableaus, weights, strict=True):
        colour = tableau.colours[l]
        b += [weight * x for x in colour.b]
        c += colour.c
    return replace(tableaus[0].colours[l], b=tuple(b), c=tuple(c))


def _diagonal(blocks: Sequence[Matrix], widths: Sequence[int]) -> Iterator[Vector]:
    """The rows of a block diagonal matrix, whose blocks have so many columns."""
    for k, block in enumerate(blocks):
        before = [ZERO] * sum(widths[:k])
        after = [ZERO] * sum(widths[k + 1 :])
        for row in block:
            yield (*before, *row, *after)
