"""Polynomials in y of each method of a family of one parameter t, as polynomials in y and t: its
step M(z) = D(z)⁻¹ N(z) on a linear problem, D = det(I − zW) (``garkcli.stability.linear``).

Times common denominators of the coefficients they are polynomials in the parameter t, of a degree
that the number of equations bounds: values at so many rational t determine them.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from itertools import chain, count, islice
from math import isqrt
from typing import cast

from flint import fmpq, fmpq_mpoly

from garkcli.deadline import check_time
from garkcli.design.member import member
from garkcli.exact.matrix import Matrix
from garkcli.exact.parametric import Parameters, common_denominator, fraction
from garkcli.exact.polynomial import Polynomial, in_one, interpolated
from garkcli.exact.projection import PLANE
from garkcli.frozen import Frozen
from garkcli.stability.linear import unreduced
from garkcli.stepping.linear import stage_system
from garkcli.tableau.tableau import Tableau


def over_line(
    tableau: Tableau,
    ring: Parameters,
    size: int,
    decided: Callable[[Tableau], Sequence[Polynomial]],
) -> list[fmpq_mpoly]:
    """Polynomials in y for each value of a parameter t as polynomials in y and t, times a power of
    the common denominator of the coefficients.

    Args:
        tableau: entries are rational numbers and rational functions of the parameter.
        ring: the parameter.
        size: the degree in the entries that the polynomials have at most.
        decided: the polynomials in y of one method.
    """
    [name] = ring.names
    denominator = common_denominator(tableau.entries, ring)
    numerators = (fraction(x, ring) for x in tableau.entries)
    degrees = [int((p * (denominator // q)).total_degree()) for p, q in numerators if p]
    degree = size * max([int(denominator.total_degree()), *degrees])
    points = list(islice((t for t in map(fmpq, count()) if denominator(t)), degree + 1))
    rows: list[Sequence[Polynomial]] = []
    for t in points:
        check_time()
        scale = fmpq(denominator(t)) ** size
        rows.append([p * scale for p in decided(member(tableau, ring, {name: t}))])
    return [_through(points, values) for values in zip(*rows, strict=True)]


def _through(points: Sequence[fmpq], values: Sequence[Polynomial]) -> fmpq_mpoly:
    """The polynomial in y and t with given polynomials in y at given t."""
    terms: dict[tuple[int, ...], fmpq] = {}
    for j in range(max(p.degree for p in values) + 1):
        coefficient = interpolated(points, [p[j] for p in values])
        for k, a in enumerate(coefficient.coefficients):
            if a:
                terms[j, k] = cast("fmpq", a)
    return PLANE.from_dict(terms)


class StepPlane(Frozen):
    """M = N/D without a common factor of D and all entries of N.

    Attributes:
        denominator: D, with y for z, or for what else the step is a function of.
        numerators: shape (d, d).
        poles: polynomials in t: where one is zero there is no method.
    """

    denominator: fmpq_mpoly
    numerators: tuple[tuple[fmpq_mpoly, ...], ...]
    poles: tuple[Polynomial, ...]

    @classmethod
    def of(
        cls,
        tableau: Tableau,
        ring: Parameters,
        unknowns: int,
        step: Callable[[Tableau], Sequence[Polynomial]],
    ) -> StepPlane:
        """A step whose denominator is the determinant of as many equations as there are unknowns.

        Args:
            tableau: entries are rational numbers and rational functions of the parameter.
            ring: the parameter.
            unknowns: the number of equations of the stages.
            step: D and the entries of N, row by row, of a member; polynomials in y.
        """
        D, *N = over_line(tableau, ring, unknowns + 1, step)
        d = isqrt(len(N))
        common = D
        for p in N:
            common = common.gcd(p)
        reduced = [p // common for p in N]
        square = tuple(tuple(reduced[start : start + d]) for start in range(0, d * d, d))
        poles = in_one(common_denominator(tableau.entries, ring))
        return cls(D // common, square, (poles,))


def step_plane(tableau: Tableau, ring: Parameters, fields: Sequence[Matrix]) -> StepPlane:
    """The step for every value of the one parameter.

    Args:
        tableau: entries are rational numbers and rational functions of the parameter.
        ring: the parameter.
        fields: y ↦ L^m y for each colour, rational.
    """

    def step(method: Tableau) -> list[Polynomial]:
        whole = unreduced(stage_system(method, fields))
        return [whole.denominator, *chain.from_iterable(whole.numerators)]

    return StepPlane.of(tableau, ring, len(stage_system(tableau, fields).W), step)
