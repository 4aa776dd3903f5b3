"""Reducible methods: unused stages, and equal stages.

A stage on which no weight and no used stage depends can be left out (G. Dahlquist, R. Jeltsch).
Stages that are equal for every problem can be merged (W. Hundsdorfer, M. Spijker): a partition is
refined until equal stages have equal sums of weights over each class.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import combinations

from flint import fmpq

from garkcli.doing import doing
from garkcli.exact.field import ZERO
from garkcli.exact.matrix import Vector, apply
from garkcli.frozen import replace
from garkcli.order.equal_stages import equal_stages, sums_over
from garkcli.properties.pattern import Vertex, is_nonzero, spaces_that_matter
from garkcli.tableau.embedded import NOTHING, Further, as_colours, from_colours
from garkcli.tableau.stages import PointSpace
from garkcli.tableau.tableau import Tableau


def reduced(tableau: Tableau, tolerance: fmpq = ZERO) -> Tableau | None:
    """Returns the smallest method with the same step, as the same object if nothing can be left
    out; None without simple radicals. An empty stage space keeps one stage, with zero row and
    weight.

    >>> from garkcli.methodfile.load import loads
    >>> twice = loads("methods: [{A: [[0, 0], [0, 0]], b: [1/2, 1/2]}]").tableau
    >>> reduced(twice).spaces[0].stages
    1
    """
    exact = at_points(tableau)
    if exact is None:
        return None
    smaller = _once(exact, tolerance)
    if smaller.spaces == exact.spaces and smaller.blocks == exact.blocks:
        return tableau
    # weights that were added may be zero, and leave a stage without influence
    while True:
        smaller, before = _once(smaller, tolerance), smaller
        if sizes(smaller) == sizes(before):
            return smaller


def at_points(tableau: Tableau) -> Tableau | None:
    """The method on point stages; None if nodes have no simple radicals."""
    if all(isinstance(space, PointSpace) for space in tableau.spaces):
        return tableau
    # nodes of families are radicals
    from garkcli.tableau.pointwise import in_points

    return in_points(tableau)


def _once(tableau: Tableau, tolerance: fmpq) -> Tableau:
    matters = stages_that_matter(tableau, tolerance)
    kept = []
    for k, space in enumerate(tableau.spaces):
        kept.append([i for i in range(space.stages) if (k, i) in matters] or [0])
    smaller = _joined(tableau, [[[stage] for stage in stages] for stages in kept])
    return merged(_with_idle_stages_zero(smaller), tolerance)


def _with_idle_stages_zero(tableau: Tableau) -> Tableau:
    idle = set(range(len(tableau.spaces))) - spaces_that_matter(tableau)
    if not idle:
        return tableau
    spaces, colours, blocks = list(tableau.spaces), [], dict(tableau.blocks)
    for k in idle:
        spaces[k] = PointSpace((ZERO,) * spaces[k].stages)
    for colour in tableau.colours:
        is_idle = colour.space in idle
        colours.append(replace(colour, c=(ZERO,) * len(colour.c)) if is_idle else colour)
    for (k, m), block in tableau.blocks.items():
        if k in idle:
            blocks[k, m] = tuple((ZERO,) * len(row) for row in block)
    return Tableau(tuple(spaces), tuple(colours), blocks)


def sizes(tableau: Tableau) -> list[int]:
    return [space.stages for space in tableau.spaces]


def is_plainly_irreducible(tableau: Tableau, tolerance: fmpq = ZERO) -> bool:
    """Whether all stages have weights and different row sums: all are used, and no two are equal.
    The stages of a family have different row sums if A𝟙 = c. True holds for all of the rounding.
    """
    return all(
        _has_weights(tableau, k, tolerance) and _tells_apart(tableau, k, tolerance)
        for k in range(len(tableau.spaces))
    )


def _has_weights(tableau: Tableau, k: int, tolerance: fmpq) -> bool:
    """Whether each stage of a space has a nonzero weight, for some colour."""
    space = tableau.spaces[k]
    rows = [colour.b for colour in tableau.colours if colour.space == k]
    if isinstance(space, PointSpace):
        stages = zip(*rows, strict=True)
        return bool(rows) and all(any(is_nonzero(x, tolerance) for x in b) for b in stages)
    return bool(rows) and not tolerance  # the weights of every family are positive


def _tells_apart(tableau: Tableau, k: int, tolerance: fmpq) -> bool:
    space = tableau.spaces[k]
    for m, colour in enumerate(tableau.colours):
        block = tableau.blocks.get((k, m))
        if block is None:
            continue
        sums = apply(block, tableau.spaces[colour.space].one)
        if not isinstance(space, PointSpace):
            if not tolerance and sums == tuple(space.nodes):
                return True
            continue
        apart = 2 * len(block[0]) * tolerance
        if all(is_nonzero(x - y, apart) for x, y in combinations(sums, 2)):
            return True
    return False


def stages_that_matter(tableau: Tableau, tolerance: fmpq = ZERO) -> set[Vertex]:
    reached: set[Vertex] = set()
    for colour in tableau.colours:
        reached |= _with_entries(colour.space, colour.b, tolerance)
    waiting = list(reached)
    while waiting:
        k, i = waiting.pop()
        for m, colour in enumerate(tableau.colours):
            block = tableau.blocks.get((k, m))
            if block is None:
                continue
            seen = _with_entries(colour.space, block[i], tolerance)
            waiting += seen - reached
            reached |= seen
    return reached


def _with_entries(space: int, row: Vector, tolerance: fmpq) -> set[Vertex]:
    return {(space, j) for j, entry in enumerate(row) if is_nonzero(entry, tolerance)}


def _chosen(row: Vector, stages: Sequence[int]) -> Vector:
    return tuple(row[i] for i in stages)


def merged(tableau: Tableau, tolerance: fmpq = ZERO) -> Tableau:
    """The tableau with one stage for each class, with the sum of their weights."""
    return _joined(tableau, equal_stages(tableau, tolerance))


def _joined(tableau: Tableau, classes: Sequence[Sequence[Sequence[int]]]) -> Tableau:
    firsts = [[members[0] for members in of_space] for of_space in classes]
    spaces = []
    for space, stages in zip(tableau.spaces, firsts, strict=True):
        spaces.append(PointSpace(_chosen(space.nodes, stages)))
    colours = []
    for colour in tableau.colours:
        b = sums_over(colour.b, classes[colour.space])
        colours.append(replace(colour, b=b, c=_chosen(colour.c, firsts[colour.space])))
    blocks = {}
    for (k, m), block in tableau.blocks.items():
        columns = classes[tableau.colours[m].space]
        blocks[k, m] = tuple(sums_over(block[i], columns) for i in firsts[k])
    return Tableau(tuple(spaces), tuple(colours), blocks)


@doing("smallest method")
def smallest(tableau: Tableau, further: Further = NOTHING) -> tuple[Tableau, Further] | None:
    """Returns the smallest method; a stage that any row of weights needs stays. The same object if
    nothing can be left out; None if stages at irrational nodes had to be compared.

    >>> from garkcli.methodfile.load import loads
    >>> method = loads("{A: [[0, 0], [1, 0]], b: [1, 0], embedded: [1/2, 1/2]}")
    >>> smallest(method.tableau, method.further)[0] is method.tableau
    True
    """
    whole = as_colours(tableau, further)
    if is_plainly_irreducible(whole):
        return tableau, further
    smaller = reduced(whole)
    if smaller is None:
        return None
    if smaller is whole:
        return tableau, further
    return from_colours(smaller, further)
