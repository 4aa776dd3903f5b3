"""Vandermonde matrices of irrational nodes, in balls: coordinates to values there, and back."""

from __future__ import annotations

from functools import lru_cache
from typing import Any

from flint import arb_mat, ctx

from garkcli.tableau.polynomial_space import PolynomialSpace


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
def _powers_of_nodes(space: PolynomialSpace, _: int) -> arb_mat:
    roots: list[tuple[Any, int]] = space.modulus.numer().complex_roots()  # type: ignore[assignment]
    nodes = sorted((root.real for root, _ in roots), key=float)
    exponents = range(space.stages)
    return arb_mat([[node**k for k in exponents] for node in nodes])


@lru_cache(maxsize=32)
def _coordinates_at_nodes(space: PolynomialSpace, bits: int) -> arb_mat | None:
    try:
        return _powers_of_nodes(space, bits).inv()
    except ZeroDivisionError:
        return None
