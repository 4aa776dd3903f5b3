"""The step of a family of one parameter on a linear problem, as polynomials in z and t.

For each value of the parameter t the step is M(z) = D(z)⁻¹ N(z) with D = det(I − zW)
(``garkcli.stability.linear``). Times common denominators of the coefficients both are
polynomials in t, of a degree that the size of W bounds: values at so many rational t determine
them.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from itertools import chain, count, islice
from math import isqrt
from typing import TypeAlias, cast

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


def largest_degree(numbers: Iterable[object], denominator: fmpq_mpoly, ring: Parameters) -> int:
    """The largest degree in t of numbers times a common denominator, and of that itself."""
    degrees = [int(denominator.total_degree())]
    for x in numbers:
        numerator, own = fraction(x, ring)
        if numerator:
            cleared = numerator * (denominator // own)
            degrees.append(int(cleared.total_degree()))
    return max(degrees)


def values_without(poles: fmpq_mpoly) -> Iterator[fmpq]:
    """0, 1, 2, … without the roots of a polynomial."""
    for k in count():
        t = fmpq(k)
        if poles(t):
            yield t


def through(points: Sequence[fmpq], values: Sequence[Polynomial]) -> fmpq_mpoly:
    """The polynomial in y and t with given polynomials in y at given t."""
    terms: dict[tuple[int, ...], fmpq] = {}
    for j in range(max(p.degree for p in values) + 1):
        coefficient = interpolated(points, [p[j] for p in values])
        for k, a in enumerate(coefficient.coefficients):
            if a:
                terms[j, k] = cast("fmpq", a)
    return PLANE.from_dict(terms)


Step: TypeAlias = "tuple[Polynomial, tuple[Polynomial, ...]]"
"""D and the entries of N, row by row."""


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


def step_plane(tableau: Tableau, ring: Parameters, fields: Sequence[Matrix]) -> StepPlane:
    """The step for every value of the one parameter.

    Args:
        tableau: entries are rational numbers and rational functions of the parameter.
        ring: the parameter.
        fields: y ↦ L^m y for each colour, rational.
    """
    unknowns = len(stage_system(tableau, fields).W)

    def step(method: Tableau) -> Step:
        whole = unreduced(stage_system(method, fields))
        return whole.denominator, tuple(chain.from_iterable(whole.numerators))

    return through_members(tableau, ring, unknowns, step)


def through_members(
    tableau: Tableau, ring: Parameters, unknowns: int, step: Callable[[Tableau], Step]
) -> StepPlane:
    """A step whose denominator is the determinant of as many equations as there are unknowns.

    Args:
        tableau: entries are rational numbers and rational functions of the parameter.
        ring: the parameter.
        unknowns: the number of equations of the stages.
        step: of a member, before common factors are divided out; polynomials in y.
    """
    entries = list(chain.from_iterable(chain.from_iterable(tableau.blocks.values())))
    weights = list(chain.from_iterable(colour.b for colour in tableau.colours))
    of_blocks = common_denominator(entries, ring)
    of_weights = common_denominator(weights, ring)
    # each row of the equations times the one denominator, each entry of N times the other
    degree = unknowns * largest_degree(entries, of_blocks, ring)
    degree += largest_degree(weights, of_weights, ring)
    allowed = values_without(of_blocks * of_weights)
    points = list(islice(allowed, degree + 1))
    [name] = ring.names
    denominators, numerators = [], []
    for t in points:
        check_time()
        denominator, entries_of_step = step(member(tableau, ring, {name: t}))
        scale = fmpq(of_blocks(t)) ** unknowns * fmpq(of_weights(t))
        denominators.append(denominator * scale)
        numerators.append([p * scale for p in entries_of_step])
    D = through(points, denominators)
    N = [through(points, values) for values in zip(*numerators, strict=True)]
    d = isqrt(len(N))
    common = D
    for p in N:
        common = common.gcd(p)
    reduced = [p // common for p in N]
    square = tuple(tuple(reduced[start : start + d]) for start in range(0, d * d, d))
    return StepPlane(D // common, square, tuple(in_one(p) for p in (of_blocks, of_weights)))
