"""Symmetric methods: those that are their own adjoint.

The adjoint, the inverse of the step with −h, has the blocks 𝟙 b_mᵀ − A^{l,m} and the same weights
(E. Hairer, C. Lubich, G. Wanner, Geometric Numerical Integration, section V.2). A method is
symmetric when a renumbering of the stages of each space, the same for all blocks, turns one into
the other. In the stage algebra of a family it is the reflection x → 1 − x of the nodes.

A stage can only map to one whose sums in the adjoint equal its own: stages are divided by these
sums until no class divides any more (B. Weisfeiler, A. Lehman). In an irreducible method every
stage then has at most one image.
"""

from __future__ import annotations

import operator
from collections.abc import Iterator, Mapping
from itertools import chain, repeat
from typing import TypeAlias

from flint import fmpq, fmpq_poly

from garkcli.deadline import check_time
from garkcli.exact.field import ZERO, Number
from garkcli.exact.matrix import Matrix, Vector, add, apply_left, multiply, outer
from garkcli.frozen import Frozen
from garkcli.order.equal_stages import sums_over
from garkcli.order.tolerance import within
from garkcli.properties.pattern import Vertex
from garkcli.tableau.polynomial_space import PolynomialSpace
from garkcli.tableau.stages import PointSpace
from garkcli.tableau.tableau import Edge, Tableau

MOST_TRIALS = 2000
"""Images of stages that are tried before the search is given up."""

_Images: TypeAlias = dict[Vertex, list[int]]
"""For each stage its possible images, stages of its space."""


class Symmetry(Frozen):
    """Whether a method is its own adjoint; None if rounding or too many renumberings leave it open.
    ``images`` has the image of each stage by spaces, None for x → 1 − x in a stage algebra.
    """

    holds: bool | None
    images: tuple[tuple[int, ...] | None, ...] = ()


def symmetry(tableau: Tableau, tolerance: fmpq = ZERO) -> Symmetry:
    """Returns whether a method is its own adjoint, with the renumbering of the stages. An equation
    between three coefficients has three times their ``tolerance``.

    >>> from garkcli.methodfile.load import loads
    >>> symmetry(loads("{A: [[0, 0], [1/2, 1/2]], b: [1/2, 1/2]}").tableau)
    Symmetry(holds=True, images=((1, 0),))
    """
    reflections: dict[int, Matrix] = {}
    for k, space in enumerate(tableau.spaces):
        if isinstance(space, PolynomialSpace):
            reflection = _reflection(space)
            if reflection is None:
                return Symmetry(None if tolerance else False)
            reflections[k] = reflection
    no = Symmetry(None if tolerance and reflections else False)
    search = _SymmetrySearch(tableau, reflections, tolerance)
    possible = _by_sums(tableau, tolerance) if tolerance else _by_sight(tableau)
    if possible is None or not search.algebras_are_turned():
        return no
    try:
        images = search.renumbering(possible)
    except _TooManyError:
        return Symmetry(None)
    if images is None:
        return no
    spaces = range(len(tableau.spaces))
    return Symmetry(True, tuple(None if k in reflections else _in_order(images[k]) for k in spaces))


def _in_order(images: Mapping[int, int]) -> tuple[int, ...]:
    return tuple(images[i] for i in range(len(images)))


def _reflection(space: PolynomialSpace) -> Matrix | None:
    """X → 1 − x on ℚ[x]/(M); None unless the nodes are symmetric about 1/2."""
    reflected = space.modulus(fmpq_poly([1, -1]))
    if reflected * reflected[space.stages] != space.modulus:
        return None
    columns = []
    power = fmpq_poly([1])
    for _ in range(space.stages):
        columns.append([power[i] for i in range(space.stages)])
        power = power * fmpq_poly([1, -1]) % space.modulus
    return tuple(zip(*columns, strict=True))


def _by_sums(tableau: Tableau, tolerance: fmpq) -> _Images:
    """The possible images: row sums of a stage and its image add up to the sum of the weights."""
    possible: _Images = {}
    for k, space in enumerate(tableau.spaces):
        if not isinstance(space, PointSpace):
            continue
        sums: list[tuple[list[Number], Number, fmpq]] = []
        for m, colour in enumerate(tableau.colours):
            if (k, m) in tableau.blocks and isinstance(tableau.space(m), PointSpace):
                rows = [sum(row, ZERO) for row in tableau.blocks[k, m]]
                sums.append((rows, sum(colour.b, ZERO), 3 * len(colour.b) * tolerance))
        for i in range(space.stages):
            possible[k, i] = [
                j
                for j in range(space.stages)
                if all(within(x[i] + x[j] - total, allowed) for x, total, allowed in sums)
            ]
    return possible


class _Class(Frozen):
    stages: list[int]
    images: list[int]


_Classes: TypeAlias = dict[int, list[_Class]]


def _by_sight(tableau: Tableau) -> _Images | None:
    """The possible images of stages by their sums; None if a class has too few."""
    classes: _Classes = {}
    for k, space in enumerate(tableau.spaces):
        if isinstance(space, PointSpace):
            every = list(range(space.stages))
            classes[k] = [_Class(every, every)]
    while True:
        check_time()
        finer = {k: _divided(tableau, k, classes) for k in classes}
        if any(len(x.stages) != len(x.images) for x in chain(*finer.values())):
            return None
        if all(len(finer[k]) == len(classes[k]) for k in classes):
            return {(k, i): x.images for k in finer for x in finer[k] for i in x.stages}
        classes = finer


def _divided(tableau: Tableau, k: int, classes: _Classes) -> list[_Class]:
    finer = []
    for whole in classes[k]:
        if len(whole.stages) == 1:
            finer.append(whole)
            continue
        # compared, not hashed: that of a fraction is slow to be had first
        found: list[tuple[Vector, _Class]] = []
        for i in whole.stages:
            _place(_sight(tableau, (k, i), classes), found).stages.append(i)
        for j in whole.images:
            _place(_sight_in_adjoint(tableau, (k, j), classes), found).images.append(j)
        finer += [part for _, part in found]
    return finer


def _place(sight: Vector, found: list[tuple[Vector, _Class]]) -> _Class:
    for seen, part in found:
        if seen == sight:
            return part
    found.append((sight, _Class([], [])))
    return found[-1][1]


def _sight(tableau: Tableau, stage: Vertex, classes: _Classes) -> Vector:
    """The weights of a stage, and the sums of its entries over each class."""
    k, i = stage
    seen = _own_weights(tableau, stage)
    for m, colour in enumerate(tableau.colours):
        if (k, m) in tableau.blocks and colour.space in classes:
            seen += sums_over(tableau.blocks[k, m][i], [x.stages for x in classes[colour.space]])
    return seen


def _sight_in_adjoint(tableau: Tableau, stage: Vertex, classes: _Classes) -> Vector:
    """The sums of a stage in the adjoint, over the images of each class."""
    k, j = stage
    seen = _own_weights(tableau, stage)
    for m, colour in enumerate(tableau.colours):
        if (k, m) in tableau.blocks and colour.space in classes:
            images = [x.images for x in classes[colour.space]]
            sums = sums_over(tableau.blocks[k, m][j], images)
            wanted = sums_over(colour.b, images)
            seen += tuple(x - y for x, y in zip(wanted, sums, strict=True))
    return seen


def _own_weights(tableau: Tableau, stage: Vertex) -> Vector:
    k, i = stage
    return tuple(colour.b[i] for colour in tableau.colours if colour.space == k)


class _TooManyError(Exception):
    """More than ``MOST_TRIALS`` images were tried."""


class _SymmetrySearch:
    """Searches the involution to the adjoint; ``reflections`` are x → 1 − x in stage algebras."""

    def __init__(
        self, tableau: Tableau, reflections: Mapping[int, Matrix], tolerance: fmpq
    ) -> None:
        self._tableau = tableau
        self._reflections = reflections
        self._tolerance = tolerance
        self._images: dict[int, dict[int, int]] = {k: {} for k in range(len(tableau.spaces))}
        self._turned = {edge: self._turn(edge) for edge in tableau.blocks}

    def _turn(self, edge: Edge) -> Matrix:
        """S A S_m with the reflections of stage algebras only."""
        k, m = edge
        block = self._tableau.blocks[edge]
        onto, before = (
            self._reflections.get(self._tableau.colours[m].space),
            self._reflections.get(k),
        )
        if onto is not None:
            block = multiply(block, onto)
        return block if before is None else multiply(before, block)

    def algebras_are_turned(self) -> bool:
        """Whether S A^{k,m} S_m + A^{k,m} = 𝟙 b_mᵀ and b_m S_m = b_m in stage algebras."""
        for colour in self._tableau.colours:
            S = self._reflections.get(colour.space)
            if S is not None and not self._are_close(apply_left(colour.b, S), colour.b, 2):
                return False
        for (k, m), block in self._tableau.blocks.items():
            colour = self._tableau.colours[m]
            if k in self._reflections and colour.space in self._reflections:
                wanted = outer(self._tableau.spaces[k].one, colour.b)
                found = add(self._turned[k, m], block)
                if not all(map(self._are_close, found, wanted, repeat(3))):
                    return False
        return True

    def renumbering(self, possible: _Images) -> dict[int, dict[int, int]] | None:
        """The image of each point stage by spaces, or None; _TooManyError after too many trials."""
        waiting = sorted(possible, key=lambda x: (len(possible[x]), x))
        path: list[tuple[Vertex, Iterator[int]]] = []
        in_vain = 0
        while True:
            free = next(((k, i) for k, i in waiting if i not in self._images[k]), None)
            if free is None:
                return self._images
            path.append((free, iter(sorted(possible[free], reverse=True))))
            while not self._is_placed(*path[-1], possible):
                check_time()
                path.pop()
                in_vain += 1
                if in_vain > MOST_TRIALS:
                    raise _TooManyError
                if not path:
                    return None
                k, i = path[-1][0]
                self._images[k].pop(self._images[k].pop(i), None)

    def _is_placed(self, stage: Vertex, images: Iterator[int], possible: _Images) -> bool:
        k, i = stage
        of_space = self._images[k]
        for j in images:
            if j in of_space or i not in possible[k, j] or not self._has_image(k, i, j):
                continue
            of_space[i], of_space[j] = j, i
            if self._sees(k, i, j) and self._is_seen(k, i, j):
                return True
            for x in {i, j}:
                del of_space[x]
        return False

    def _has_image(self, k: int, i: int, j: int) -> bool:
        """Whether the weights of two stages are equal, and their couplings with algebras fit."""
        tableau = self._tableau
        for colour in tableau.colours:
            if colour.space == k and not self._are_close(
                colour.b[i : i + 1], colour.b[j : j + 1], 2
            ):
                return False
        for (x, m), block in tableau.blocks.items():
            colour, turned = tableau.colours[m], self._turned[x, m]
            if x == k and colour.space in self._reflections:
                found, wanted = (turned[j], block[i]), colour.b
            elif x in self._reflections and colour.space == k:
                found = tuple(row[j] for row in turned), tuple(row[i] for row in block)
                wanted = tuple(colour.b[i] * x for x in tableau.spaces[x].one)
            else:
                continue
            if not self._are_close(tuple(map(operator.add, *found)), wanted, 3):
                return False
        return True

    def _sees(self, k: int, i: int, j: int) -> bool:
        """Whether a stage and its image see the placed stages as a method and its adjoint do."""
        for m, colour in enumerate(self._tableau.colours):
            if (k, m) in self._tableau.blocks:
                row, image, b = (
                    self._tableau.blocks[k, m][i],
                    self._tableau.blocks[k, m][j],
                    colour.b,
                )
                for x, y in self._images[colour.space].items():
                    if not within(image[y] + row[x] - b[x], 3 * self._tolerance):
                        return False
        return True

    def _is_seen(self, k: int, i: int, j: int) -> bool:
        """Whether placed stages see a stage and its image as a method and its adjoint do."""
        for (x_space, m), block in self._tableau.blocks.items():
            colour = self._tableau.colours[m]
            if colour.space == k:
                b = colour.b[i]
                for x, y in self._images[x_space].items():
                    if not within(block[y][j] + block[x][i] - b, 3 * self._tolerance):
                        return False
        return True

    def _are_close(self, row: Vector, other: Vector, times: int) -> bool:
        allowed = times * self._tolerance
        return all(within(x - y, allowed) for x, y in zip(row, other, strict=True))
