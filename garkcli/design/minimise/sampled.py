"""Polynomials in two variables from their values at rational parameters."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from itertools import count
from typing import cast

from flint import fmpq, fmpq_mpoly

from garkcli.design.member import member
from garkcli.exact.parametric import Parameters, common_denominator, fraction
from garkcli.exact.polynomial import Polynomial, interpolated
from garkcli.exact.projection import PLANE
from garkcli.tableau.tableau import Tableau


def in_plane(
    tableau: Tableau,
    ring: Parameters,
    entries: Sequence[object],
    size: int,
    decided: Callable[[Tableau], Sequence[Polynomial]],
) -> list[fmpq_mpoly]:
    """Polynomials in y for each value of a parameter t as polynomials in y and t.

    Args:
        tableau: of one parameter.
        ring: that.
        entries: of the tableau.
        size: the degree in the entries that the polynomials have at most.
        decided: the polynomials in y of one method.
    """
    [name] = ring.names
    denominator = common_denominator(entries, ring)
    degree = int(denominator.total_degree())
    for x in entries:
        over, under = fraction(x, ring)
        cleared = over * (denominator // under)
        if cleared:
            degree = max(degree, int(cleared.total_degree()))
    points: list[fmpq] = []
    rows: list[Sequence[Polynomial]] = []
    for k in count():
        t = fmpq(k)
        scale = fmpq(denominator(t))
        if not scale:
            continue
        found = decided(member(tableau, ring, {name: t}))
        points.append(t)
        rows.append([p * scale**size for p in found])
        if len(points) > degree * size:
            break
    return [_through(points, values) for values in zip(*rows, strict=True)]


def _through(
    points: Sequence[fmpq], values: Sequence[Polynomial]
) -> fmpq_mpoly:
    """The polynomial in y and t with given polynomials in y at given t."""
    terms: dict[tuple[int, ...], fmpq] = {}
    for j in range(max(p.degree for p in values) + 1):
        coefficient = interpolated(points, [p[j] for p in values])
        for k, a in enumerate(coefficient.coefficients):
            if a:
                terms[j, k] = cast("fmpq", a)
    return PLANE.from_dict(terms)
