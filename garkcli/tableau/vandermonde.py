"""Vandermonde matrices of irrational nodes, in balls: coordinates to values there, and back."""

from __future__ import annotations

from functools import lru_cache
from typing import Any

from flint import arb, arb_mat, ctx

from garkcli.tableau.polynomial_space import PolynomialSpace

_BITS_OF_A_STAGE = 16


def powers_of_nodes(space: PolynomialSpace) -> arb_mat:
    """The Vandermonde matrix of the nodes, a row for each in ascending order, at the current
    precision.
    """
    return _powers_of_nodes(space, ctx.prec)


def coordinates_at_nodes(space: PolynomialSpace) -> arb_mat:
    """The inverse of the Vandermonde matrix: values at the nodes to coordinates, at the current
    precision.

    Raises:
        ZeroDivisionError: the precision is too small.
    """
    found = _coordinates_at_nodes(space, ctx.prec)
    if found is None:
        raise ZeroDivisionError
    return found


@lru_cache(maxsize=32)
def _powers_of_nodes(space: PolynomialSpace, bits: int) -> arb_mat:
    # isolating the roots takes long, and hardly longer with the bits that the inverse needs
    nodes = _nodes(space, max(bits, _BITS_OF_A_STAGE * space.stages))
    exponents = range(space.stages)
    return arb_mat([[node**k for k in exponents] for node in nodes])


@lru_cache(maxsize=32)
def _nodes(space: PolynomialSpace, bits: int) -> list[arb]:
    with ctx.workprec(bits):
        roots: list[tuple[Any, int]] = space.modulus.numer().complex_roots()  # type: ignore[assignment]
        return sorted((root.real for root, _ in roots), key=float)


@lru_cache(maxsize=32)
def _coordinates_at_nodes(space: PolynomialSpace, bits: int) -> arb_mat | None:
    try:
        return _powers_of_nodes(space, bits).inv()
    except ZeroDivisionError:
        return None
