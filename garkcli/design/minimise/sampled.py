"""Polynomials in two variables from their values at rational parameters."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from itertools import islice

from flint import fmpq, fmpq_mpoly

from garkcli.deadline import check_time
from garkcli.design.member import member
from garkcli.design.sampling import largest_degree, through, values_without
from garkcli.exact.parametric import Parameters, common_denominator
from garkcli.exact.polynomial import Polynomial
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
    degree = size * largest_degree(entries, denominator, ring)
    points = list(islice(values_without(denominator), degree + 1))
    rows: list[Sequence[Polynomial]] = []
    for t in points:
        check_time()
        scale = fmpq(denominator(t)) ** size
        found = decided(member(tableau, ring, {name: t}))
        rows.append([p * scale for p in found])
    return [through(points, values) for values in zip(*rows, strict=True)]
