"""Symmetric methods: those that are their own adjoint.

The adjoint, the inverse of the step with −h, has the blocks 𝟙 b_mᵀ − A^{l,m} and the same weights
(E. Hairer, C. Lubich, G. Wanner, Geometric Numerical Integration, section V.2). A method is
symmetric when a renumbering of the stages of each space, the same for all blocks, turns one into
the other. In the stage algebra of a family it is the reflection x → 1 − x of the nodes.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import islice, product
from math import prod

from flint import fmpq, fmpq_poly

from garkcli.exact.field import ZERO, Number
from garkcli.exact.matrix import Matrix, Vector, add, apply_left, identity, multiply, outer
from garkcli.frozen import Frozen
from garkcli.order.tolerance import within
from garkcli.tableau.polynomial_space import PolynomialSpace
from garkcli.tableau.stages import PointSpace, StageSpace
from garkcli.tableau.tableau import Tableau

MOST_RENUMBERINGS = 2000
"""Renumberings that are tried where nodes coincide."""


class Reflection(Frozen):
    """A map of one stage space that is its own inverse.

    Attributes:
        matrix: the map of coordinates.
        images: for each stage the one that it becomes; None for x → 1 − x in a stage algebra.
    """

    matrix: Matrix
    images: tuple[int, ...] | None


class Symmetry(Frozen):
    """Whether a method is its own adjoint.

    Attributes:
        holds: None where too many renumberings would have to be tried, or where rounding leaves it
            open.
        reflections: the renumbering of each stage space that shows it; empty where it does not
            hold.
    """

    holds: bool | None
    reflections: tuple[Reflection, ...] = ()


def symmetry(tableau: Tableau, tolerance: fmpq = ZERO) -> Symmetry:
    """Whether a method is its own adjoint, with the renumbering of the stages.

    Args:
        tableau: the method.
        tolerance: the rounding of its coefficients: an equation between three of them may be off by
            three times that.

    >>> from garkcli.methodfile.load import loads
    >>> found = symmetry(loads("{A: [[0, 0], [1/2, 1/2]], b: [1/2, 1/2]}").tableau)
    >>> found.holds, found.reflections[0].images
    (True, (1, 0))
    """
    choices = []
    for k in range(len(tableau.spaces)):
        possible = _reflections(tableau, k, tolerance)
        choices.append(list(islice(possible, MOST_RENUMBERINGS + 1)))
    if prod(map(len, choices)) > MOST_RENUMBERINGS:
        return Symmetry(None)
    for chosen in product(*choices):
        if _turns_into_adjoint(tableau, chosen, tolerance):
            return Symmetry(True, chosen)
    has_algebra = any(isinstance(x, PolynomialSpace) for x in tableau.spaces)
    return Symmetry(None if tolerance and has_algebra else False)


def _turns_into_adjoint(tableau: Tableau, chosen: Sequence[Reflection], tolerance: fmpq) -> bool:
    """Whether S A^{k,m} S_m + A^{k,m} = 𝟙 b_mᵀ and b_m S_m = b_m for reflections S = S⁻¹."""
    for colour in tableau.colours:
        weights = apply_left(colour.b, chosen[colour.space].matrix)
        if not _are_close((weights,), (colour.b,), 2 * tolerance):
            return False
    for (k, m), block in tableau.blocks.items():
        colour = tableau.colours[m]
        onto = chosen[colour.space].matrix
        turned = multiply(chosen[k].matrix, multiply(block, onto))
        wanted = outer(tableau.spaces[k].one, colour.b)
        if not _are_close(add(turned, block), wanted, 3 * tolerance):
            return False
    return True


def _are_close(rows: Matrix, others: Matrix, allowed: fmpq) -> bool:
    """Whether matrices of entries are equal, or nearly so within a tolerance."""
    if rows == others or not allowed:
        return rows == others
    return all(
        within(x - y, allowed)
        for row, other in zip(rows, others, strict=True)
        for x, y in zip(row, other, strict=True)
    )


def _reflections(tableau: Tableau, k: int, tolerance: fmpq) -> Iterator[Reflection]:
    """The maps of one stage space that may do it."""
    space = tableau.spaces[k]
    if isinstance(space, PolynomialSpace):
        yield from _reflected_polynomials(space)
    elif isinstance(space, PointSpace):
        keys = _keys(tableau, k, space)
        allowed = (3 * len(keys) + 3) * tolerance  # sums are as long as stages
        yield from _involutions(
            [[_are_close((image,), (other,), allowed) for other, _ in keys] for _, image in keys]
        )


def _reflected_polynomials(space: PolynomialSpace) -> Iterator[Reflection]:
    """X → 1 − x on ℚ[x]/(M), where M has nodes that lie symmetric to 1/2."""
    reflected = space.modulus(fmpq_poly([1, -1]))
    if reflected * reflected[space.stages] != space.modulus:
        return
    columns = []
    power = fmpq_poly([1])
    for _ in range(space.stages):
        columns.append([power[i] for i in range(space.stages)])
        power = power * fmpq_poly([1, -1]) % space.modulus
    yield Reflection(tuple(zip(*columns, strict=True)), None)


def _keys(tableau: Tableau, k: int, space: StageSpace) -> list[tuple[Vector, Vector]]:
    """What a stage has, and what its image must have: row sums, then weights.

    Row sums r of A turn into (sum of weights) − r, and weights stay.
    """
    keys: list[tuple[Vector, Vector]] = []
    for i in range(space.stages):
        sums: list[Number] = []
        turned: list[Number] = []
        for m, colour in enumerate(tableau.colours):
            block = tableau.blocks.get((k, m))
            if block is None:
                continue
            row = sum(block[i], ZERO)
            total = sum(colour.b, ZERO)
            sums.append(row)
            turned.append(total - row)
        colours = [x for x in tableau.colours if x.space == k]
        weights = [colour.b[i] for colour in colours]
        own = (*sums, *weights)
        keys.append((own, (*turned, *weights)))
    return keys


def _involutions(fits: list[list[bool]]) -> Iterator[Reflection]:
    """Permutations that are their own inverse and take each stage to one that fits.

    Args:
        fits: for each pair of stages whether one may turn into the other.
    """
    size = len(fits)
    images: list[int | None] = [None] * size

    def extended(i: int) -> Iterator[Reflection]:
        while i < size and images[i] is not None:
            i += 1
        if i == size:
            unit = identity(size)
            found = tuple(j for j in images if j is not None)
            yield Reflection(tuple(unit[j] for j in found), found)
            return
        for j in reversed(range(i, size)):
            if images[j] is None and fits[i][j] and fits[j][i]:
                images[i], images[j] = j, i
                yield from extended(i + 1)
                images[i] = images[j] = None

    yield from extended(0)
