"""Symmetric methods: those that are their own adjoint.

The adjoint, the inverse of the step with −h, has the blocks 𝟙 b_mᵀ − A^{l,m} and the same weights
(E. Hairer, C. Lubich, G. Wanner, Geometric Numerical Integration, section V.2). A method is
symmetric when a renumbering of the stages of each space, the same for all blocks, turns one into
the other. In the stage algebra of a family it is the reflection x → 1 − x of the nodes.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import product

from flint import fmpq_poly

from garkcli.exact.field import ZERO
from garkcli.exact.matrix import Matrix, add, apply_left, identity, multiply, outer
from garkcli.tableau.point_space import PointSpace
from garkcli.tableau.polynomial_space import PolynomialSpace
from garkcli.tableau.stages import StageSpace
from garkcli.tableau.tableau import Tableau

MOST_RENUMBERINGS = 2000
"""Renumberings that are tried where nodes coincide."""


def is_symmetric(tableau: Tableau) -> bool | None:
    """Whether a method is its own adjoint; None where too many renumberings would have to be tried.

    >>> from garkcli.families.registry import diagonal_method
    >>> from garkcli.tableau.forms import gark
    >>> is_symmetric(gark([diagonal_method("gauss", 5)], {}))
    True
    """
    choices = [
        list(_first(_reflections(tableau, k))) for k in range(len(tableau.spaces))
    ]
    total = 1
    for found in choices:
        total *= len(found)
    if total > MOST_RENUMBERINGS:
        return None
    return any(_turns_into_adjoint(tableau, chosen) for chosen in product(*choices))


def _first(reflections: Iterator[Matrix]) -> Iterator[Matrix]:
    for _, reflection in zip(range(MOST_RENUMBERINGS + 1), reflections, strict=False):
        yield reflection


def _turns_into_adjoint(tableau: Tableau, reflections: Sequence[Matrix]) -> bool:
    """Whether S A^{k,m} S_m + A^{k,m} = 𝟙 b_mᵀ and b_m S_m = b_m for reflections S = S⁻¹."""
    for colour in tableau.colours:
        if apply_left(colour.b, reflections[colour.space]) != tuple(colour.b):
            return False
    for (k, m), block in tableau.blocks.items():
        colour = tableau.colours[m]
        turned = multiply(reflections[k], multiply(block, reflections[colour.space]))
        if add(turned, block) != outer(tableau.spaces[k].one, colour.b):
            return False
    return True


def _reflections(tableau: Tableau, k: int) -> Iterator[Matrix]:
    """The maps of one stage space that may do it, as matrices on coordinates."""
    space = tableau.spaces[k]
    if isinstance(space, PolynomialSpace):
        yield from _reflected_polynomials(space)
    elif isinstance(space, PointSpace):
        yield from _involutions(_keys(tableau, k, space))


def _reflected_polynomials(space: PolynomialSpace) -> Iterator[Matrix]:
    """X → 1 − x on ℚ[x]/(M), where M has nodes that lie symmetric to 1/2."""
    reflected = space.modulus(fmpq_poly([1, -1]))
    if reflected * reflected[space.stages] != space.modulus:
        return
    columns = []
    power = fmpq_poly([1])
    for _ in range(space.stages):
        columns.append([power[i] for i in range(space.stages)])
        power = power * fmpq_poly([1, -1]) % space.modulus
    yield tuple(zip(*columns, strict=True))


def _keys(tableau: Tableau, k: int, space: StageSpace) -> list[tuple[object, object]]:
    """What a stage has, and what its image must have: increments to it, and weights.

    Row sums r of A turn into (sum of weights) − r, and weights stay.
    """
    mine = []
    image = []
    for i in range(space.stages):
        sums = []
        turned = []
        for m, colour in enumerate(tableau.colours):
            block = tableau.blocks.get((k, m))
            if block is None:
                continue
            ones = tableau.spaces[colour.space].one
            total = sum((b * x for b, x in zip(colour.b, ones, strict=True)), ZERO)
            row = sum((a * x for a, x in zip(block[i], ones, strict=True)), ZERO)
            sums.append(row)
            turned.append(total - row)
        weights = tuple(colour.b[i] for colour in tableau.colours if colour.space == k)
        mine.append((tuple(sums), weights))
        image.append((tuple(turned), weights))
    return list(zip(mine, image, strict=True))


def _involutions(keys: list[tuple[object, object]]) -> Iterator[Matrix]:
    """Permutations that are their own inverse and take each stage to one with fitting sums."""
    size = len(keys)
    images: list[int | None] = [None] * size

    def extended(i: int) -> Iterator[Matrix]:
        while i < size and images[i] is not None:
            i += 1
        if i == size:
            unit = identity(size)
            yield tuple(unit[j] for j in images if j is not None)
            return
        for j in reversed(range(i, size)):
            if (
                images[j] is None
                and keys[i][1] == keys[j][0]
                and keys[j][1] == keys[i][0]
            ):
                images[i], images[j] = j, i
                yield from extended(i + 1)
                images[i] = images[j] = None

    yield from extended(0)
