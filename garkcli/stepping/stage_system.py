"""The stages of a method on a linear problem: one linear system.

With the vector field y ↦ L^m y of colour m, L^m ∈ K^{d×d}, the stage values obey

    Y^k = 𝟙 ⊗ y₀ + h Σ_m (A^{k,m} ⊗ L^m) Y^{space(m)},    y₁ = y₀ + h Σ_m (b_m ⊗ L^m) Y^{space(m)}.

Keeping of each Y^k only the components X that some vector field looks at, these are

    X = E y₀ + h W X,    y₁ = y₀ + h B X,    hence    y₁ = (I + h B (I − hW)⁻¹ E) y₀.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import TypeAlias

from garkcli.exact.field import ONE, ZERO, Number
from garkcli.exact.matrix import Matrix
from garkcli.tableau.tableau import Tableau

_Rows: TypeAlias = list[list[Number]]


@dataclass(frozen=True)
class StageSystem:
    """W, E and B of this module's heading, over the domain K of the coefficients.

    Attributes:
        W: shape (n, n), n the number of unknown stage values that are used.
        E: shape (n, d).
        B: shape (d, n).
    """

    W: Matrix
    E: Matrix
    B: Matrix


@dataclass(frozen=True)
class _Term:
    """What the field of a colour does: component ``driven`` of y gets ``factor`` times component
    ``seen``.
    """

    colour: int
    driven: int
    seen: int
    factor: Number


def stage_system(
    tableau: Tableau, fields: Sequence[Matrix], pattern: Sequence[Matrix] | None = None
) -> StageSystem:
    """The linear system of the stages.

    Args:
        tableau: the method.
        fields: L^m for each colour m, all of one shape (d, d).
        pattern: matrices that are zero only where the L^m are zero for all parameters of a problem,
            so that the unknowns are the same for all; None for the L^m themselves.
    """
    d = len(fields[0])
    if pattern is None:
        pattern = fields
    terms = list(_terms(fields, pattern))
    first, n = _first_unknowns(tableau, terms)
    W = _zeros(n, n)
    E = _zeros(n, d)
    B = _zeros(d, n)
    for term in terms:
        colour = tableau.colours[term.colour]
        column = first[colour.space, term.seen]
        _add(B, term.driven, column, term.factor, (colour.b,))
        for (space, component), row in first.items():
            if component != term.driven:
                continue
            block = tableau.blocks.get((space, term.colour))
            if block is not None:
                _add(W, row, column, term.factor, block)
    for (space, component), row in first.items():
        ones = tuple((x,) for x in tableau.spaces[space].one)
        _add(E, row, component, ONE, ones)
    return StageSystem(_frozen(W), _frozen(E), _frozen(B))


def _terms(fields: Sequence[Matrix], pattern: Sequence[Matrix]) -> Iterator[_Term]:
    """The entries of all L^m that are not zero in the pattern."""
    for m, (L, kept) in enumerate(zip(fields, pattern, strict=True)):
        for i, row in enumerate(kept):
            for j, is_kept in enumerate(row):
                if is_kept:
                    yield _Term(m, i, j, L[i][j])


def _first_unknowns(
    tableau: Tableau, terms: Sequence[_Term]
) -> tuple[dict[tuple[int, int], int], int]:
    """The number of the first unknown of each (stage space, component of y) that some field looks
    at, and how many unknowns there are.
    """
    first: dict[tuple[int, int], int] = {}
    n = 0
    for term in terms:
        colour = tableau.colours[term.colour]
        place = colour.space, term.seen
        if place not in first:
            first[place] = n
            n += tableau.space(term.colour).stages
    return first, n


def _zeros(rows: int, columns: int) -> _Rows:
    return [[ZERO] * columns for _ in range(rows)]


def _frozen(rows: _Rows) -> Matrix:
    return tuple(tuple(row) for row in rows)


def _add(matrix: _Rows, row: int, column: int, factor: Number, block: Matrix) -> None:
    """Add a multiple of a block whose upper left corner is at (row, column)."""
    for i, entries in enumerate(block, start=row):
        for j, x in enumerate(entries, start=column):
            matrix[i][j] = matrix[i][j] + factor * x
