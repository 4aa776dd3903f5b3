"""Decides which stages of families are solved together, without their nodes.

With M the node polynomial of the columns and c_j a node, a_ij M'(c_j) is the value of
A(M/(x − c_j)) at c_i: an integer over a prime p that divides no denominator. Modulo a prime ideal
above p, c_j is a root r of M modulo p. So if the polynomial A(M/(x − r)) has no common divisor with
the row nodes modulo p, no entry of the column j is zero; and the same for the row of j. A stage
that sees all others and is seen by all makes one system of all. Stages with a zero row or column
are found by common divisors over ℚ, and belong to no system.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from itertools import product
from typing import TypeAlias

from flint import fmpq, fmpq_poly, nmod_poly

from garkcli.exact.field import Number, modulo
from garkcli.exact.matrix import Matrix
from garkcli.exact.roots import roots_below
from garkcli.frozen import Frozen
from garkcli.properties.family_entries import divided
from garkcli.properties.pattern import Shape
from garkcli.tableau.polynomial_space import PolynomialSpace
from garkcli.tableau.tableau import Tableau

Blocks: TypeAlias = dict[tuple[int, int], Matrix]
PRIMES = (2147483647, 2147483629, 2147483587, 2147483579, 2147483563, 2147483549)
"""Most of them have a root of a node polynomial, and few hide an entry."""


class _Space(Frozen):
    """A stage space; ``kept`` have no zero row or column, the roots of ``left`` are their nodes."""

    M: fmpq_poly
    left: fmpq_poly
    kept: tuple[int, ...]


def shape_of_families(tableau: Tableau, colours: Sequence[int]) -> Shape | None:
    """Returns the shape if all stages without a zero row or column are proved to be solved
    together.

    >>> from garkcli.families.registry import diagonal_method
    >>> from garkcli.tableau.forms import gark
    >>> shape_of_families(gark([diagonal_method("lobatto-iiia", 30)], {}), [0]).implicit_stages
    29
    """
    blocks = _rational_blocks(tableau, colours)
    spaces = None if blocks is None else _spaces(tableau, blocks)
    if blocks is None or spaces is None:
        return None
    vertices = []
    for k, space in spaces.items():
        vertices += [(k, i) for i in space.kept]
    if len(vertices) < 2:
        return None
    owners = {m: tableau.colours[m].space for m in colours}
    if not any(_has_centre(spaces, blocks, owners, p) for p in PRIMES):
        return None
    together = tuple(vertices)
    return Shape("fully implicit", len(together), (together,), None, "")


def _rational_blocks(tableau: Tableau, colours: Sequence[int]) -> Blocks | None:
    indices = sorted({tableau.colours[l].space for l in colours})
    found: Blocks = {}
    for place in product(indices, colours):
        block = tableau.blocks.get(place)
        if block is None or not all(isinstance(x, fmpq) for row in block for x in row):
            return None
        found[place] = block
    return found


def _spaces(tableau: Tableau, blocks: Blocks) -> dict[int, _Space] | None:
    """The stage spaces; None if one is no family, or irrational nodes are left out."""
    spaces = {}
    for k in dict.fromkeys(k for k, _ in blocks):
        space = tableau.spaces[k]
        if not isinstance(space, PolynomialSpace):
            return None
        found = _space(tableau, k, blocks, space.modulus)
        if found is None:
            return None
        spaces[k] = found
    return spaces


def _space(tableau: Tableau, k: int, blocks: Blocks, M: fmpq_poly) -> _Space | None:
    """The stages of a space that see something and are seen; None if a node is irrational."""
    sees_nothing, is_unseen = M, M
    for (seer, m), block in blocks.items():
        if seer == k:
            for column in zip(*block, strict=True):
                sees_nothing = sees_nothing.gcd(_poly(column))
        if tableau.colours[m].space == k:
            for row in block:
                # at a node y = c_j the value of the functional on M/(x − c_j)
                is_unseen = is_unseen.gcd(divided(M, row).to_flint())
    gone = sees_nothing * is_unseen / sees_nothing.gcd(is_unseen)
    dropped = set()
    _, factors = gone.factor()
    for factor, _ in factors:
        if factor.degree() > 1:
            return None
        node = -factor[0] / factor[1]
        dropped.add(roots_below(M, node))
    kept = [i for i in range(M.degree()) if i not in dropped]
    left = M / gone
    leading = left[left.degree()]
    return _Space(M, left / leading, tuple(kept))


def _poly(coefficients: Iterable[Number]) -> fmpq_poly:
    return fmpq_poly([a for a in coefficients if isinstance(a, fmpq)])


def _has_centre(spaces: dict[int, _Space], blocks: Blocks, owners: dict[int, int], p: int) -> bool:
    """Whether, modulo p, some stage sees all others and is seen by them."""
    try:
        left = {k: modulo(space.left, p) for k, space in spaces.items()}
        centre, r = _root(left, p)
        if centre is None:
            return False
        seers = dict(left)
        seen = dict(left)
        for (k, m), block in blocks.items():
            owner = owners[m]
            if centre not in {k, owner}:
                continue
            rows = [_residues(row, p) for row in block]
            M = modulo(spaces[owner].M, p)
            if owner == centre:
                coefficients = [int(a) for a in (M // nmod_poly([-r, 1], p)).coeffs()]
                entries = [
                    sum(a * b for a, b in zip(row, coefficients, strict=False)) % p for row in rows
                ]
                seers[k] = seers[k].gcd(nmod_poly(entries, p))
            if k == centre:
                sights = _at(rows, r, p)
                of_node = (nmod_poly(sights[::-1], p) * M).right_shift(M.degree())
                seen[owner] = seen[owner].gcd(of_node)
    except ZeroDivisionError:  # p divides a denominator
        return False
    hidden = (*seers.values(), *seen.values())
    return all(q.degree() == 0 for q in hidden)


def _root(left: dict[int, nmod_poly], p: int) -> tuple[int | None, int]:
    """A stage space and a root modulo p of its remaining node polynomial, or None."""
    for k, q in left.items():
        for root, _ in q.roots():
            return k, int(root) % p
    return None, 0


def _residues(numbers: Iterable[Number], p: int) -> list[int]:
    residues = []
    for x in numbers:
        assert isinstance(x, fmpq)
        denominator = int(x.q) % p
        if not denominator:
            raise ZeroDivisionError
        residues.append(int(x.p) * pow(denominator, -1, p) % p)
    return residues


def _at(rows: Sequence[Sequence[int]], r: int, p: int) -> list[int]:
    """Σ r^i row_i: the image of 1, x, … at the stage of the node r."""
    total = [0] * len(rows[0])
    power = 1
    for row in rows:
        total = [(t + power * a) % p for t, a in zip(total, row, strict=True)]
        power = power * r % p
    return total
