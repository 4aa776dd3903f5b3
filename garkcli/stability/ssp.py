"""The SSP coefficient: the radius of absolute monotonicity of a tableau.

With K = (A 0; bᵀ 0), it is the largest r for which I + rK is regular and

    (I + rK)⁻¹ K ≥ 0,    (I + rK)⁻¹ 𝟙 ≥ 0

entry by entry (J. F. B. M. Kraaijevanger 1991). With a K_l for each colour, a point (r_1, …, r_N)
belongs to the region of absolute monotonicity of an additive method if, with I + Σ r_l K_l for I +
rK, the second condition holds, and the first one for each K_l in place of K, also with r_l = 0 (I.
Higueras 2006). The region contains all smaller points, so one number describes it on a line through
the origin. All entries are rational in r with denominator det(I + rA), which is 1 at r = 0; so each
condition fails first at a root of its numerator, or at once.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from garkcli.exact.field import ONE, ZERO, Number
from garkcli.exact.matrix import Matrix, apply, scale, transpose
from garkcli.exact.polynomial import Polynomial, reciprocal_characteristic
from garkcli.exact.roots import RealRoot, real_roots, sign
from garkcli.frozen import Frozen, replace
from garkcli.tableau.pointwise import in_points
from garkcli.tableau.tableau import Tableau


class SspCoefficient(Frozen):
    """The radius of absolute monotonicity; None if infinite."""

    value: RealRoot | None


class AdditiveRadius(Frozen):
    """The largest r with (r q_1, …, r q_N) in the region of absolute monotonicity, or None.
    ``ratios`` are the q_l ≥ 0; ``radius`` is None if undecided.
    """

    ratios: tuple[Number, ...]
    radius: SspCoefficient | None


def ssp_coefficient(
    tableau: Tableau, shares: Sequence[Number] | None = None
) -> SspCoefficient | None:
    """Returns the SSP coefficient; None if nodes are not simple or a block is missing.

    ``shares`` are r_l / r, by default 1. A colour with 0 has a zero vector field: it and its own
    stages are ignored.
    """
    part, ratios = driven_part(tableau, shares or [ONE] * tableau.size)
    return _radius(part, ratios)


def additive_radius(tableau: Tableau, ratios: Sequence[Number]) -> AdditiveRadius:
    """Returns the end of the region of absolute monotonicity in a direction. A colour with ratio 0
    keeps its vector field, without a step size of its own.
    """
    return AdditiveRadius(tuple(ratios), _radius(tableau, ratios))


def driven_part(tableau: Tableau, shares: Sequence[Number]) -> tuple[Tableau, list[Number]]:
    """The method for the vector fields with nonzero shares, and these shares."""
    driven = [l for l, share in enumerate(shares) if share]
    spaces = sorted({tableau.colours[l].space for l in driven})
    colours = []
    for l in driven:
        colour = tableau.colours[l]
        colours.append(replace(colour, space=spaces.index(colour.space)))
    blocks = {}
    for (k, m), block in tableau.blocks.items():
        if k in spaces and m in driven:
            blocks[spaces.index(k), driven.index(m)] = block
    kept = tuple(tableau.spaces[k] for k in spaces)
    return Tableau(kept, tuple(colours), blocks), [shares[l] for l in driven]


def _radius(tableau: Tableau, ratios: Sequence[Number]) -> SspCoefficient | None:
    exact = in_points(tableau)
    if exact is None or len(list(exact.edges())) < exact.size**2:
        return None
    whole, parts = stacked(exact, ratios)
    failures = []
    for condition in _conditions(whole, parts):
        failing = _first_failure(condition)
        if failing is not None:
            failures.append(failing)
    return SspCoefficient(min(failures, default=None))


def stacked(tableau: Tableau, ratios: Sequence[Number]) -> tuple[Matrix, list[Matrix]]:
    """Σ ratio_l K_l and the K_l, with the columns of colour l, on all stages and the new value."""
    starts = []
    size = 0
    for space in tableau.spaces:
        starts.append(size)
        size += space.stages
    parts = []
    for m, colour in enumerate(tableau.colours):
        K = _square(size + 1)
        column = starts[colour.space]
        for k, start in enumerate(starts):
            for i, row in enumerate(tableau.blocks.get((k, m), ()), start=start):
                end = column + len(row)
                K[i][column:end] = row
        end = column + len(colour.b)
        K[size][column:end] = colour.b
        parts.append(_frozen(K))
    total = _square(size + 1)
    for ratio, part in zip(ratios, parts, strict=True):
        for i, row in enumerate(part):
            for j, x in enumerate(row):
                total[i][j] = total[i][j] + ratio * x
    return _frozen(total), parts


def _square(size: int) -> list[list[Number]]:
    return [[ZERO] * size for _ in range(size)]


def _frozen(rows: list[list[Number]]) -> Matrix:
    return tuple(tuple(row) for row in rows)


def conditions_at(tableau: Tableau) -> list[Polynomial]:
    """The polynomials in r that decide for equal fields; their number depends on the size only."""
    return list(_conditions(*stacked(tableau, [ONE] * tableau.size), with_zeros=True))


def _conditions(
    K: Matrix, parts: Sequence[Matrix], with_zeros: bool = False
) -> Iterator[Polynomial]:
    """Polynomials in r that must not be negative from 0 to the radius. (I + rK)⁻¹ = Σ (−r)^k K^k,
    and d · (I + rK)⁻¹ with d(r) = det(I + rK) is a polynomial of degree at most n: finitely many
    terms of the product of the series determine it.
    """
    n = len(K)
    minus_K = scale(-ONE, K)
    denominator = reciprocal_characteristic(minus_K)
    yield denominator
    for part in parts:
        for column in transpose(part):
            if with_zeros or any(column):
                yield from _entries(denominator, minus_K, column, n)
    yield from _entries(denominator, minus_K, (ONE,) * n, n)


def _entries(
    denominator: Polynomial, minus_K: Matrix, vector: Sequence[Number], n: int
) -> list[Polynomial]:
    series: list[list[Number]] = [[] for _ in range(n)]
    state = tuple(vector)
    for _ in range(n + 1):
        for i, x in enumerate(state):
            series[i].append(x)
        state = apply(minus_K, state)
    products = (denominator * Polynomial(terms) for terms in series)
    return [Polynomial(product.coefficients[: n + 1]) for product in products]


def _first_failure(p: Polynomial) -> RealRoot | None:
    """The r ≥ 0 from which p is negative: 0, a root where its sign changes, or None."""
    if not p:
        return None
    signs = [sign(a) for a in p.coefficients if a]
    origin = RealRoot.rational(ZERO)
    if signs[0] < 0:
        return origin
    if min(signs) > 0:  # a sum of powers that are positive where r is
        return None
    for root, power in real_roots(p):
        if root > origin and power % 2 == 1:
            return root
    return None
