"""Polynomials in y of all methods of a family of one parameter t, as polynomials in y and t, such
as the step M(z) = D(z)⁻¹ N(z) on a linear problem, D = det(I − zW) (``garkcli.stability.linear``).

Times common denominators of the coefficients they are polynomials in the parameter t, whose degree
the number of equations bounds: values at enough rational t determine them.

With coefficients in a number field ℚ(θ), θ is a third unknown. Then the norms, with rational
coefficients, decide: their curves are those of all conjugates, which stay apart between two t at
which any of them meet.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from itertools import chain, count, islice
from math import isqrt

from flint import Ordering, fmpq, fmpq_mpoly, fmpq_mpoly_ctx

from garkcli.deadline import check_time
from garkcli.design.member import member, value_of
from garkcli.exact import projection
from garkcli.exact.field import Algebraic, Number, NumberField, poly_of
from garkcli.exact.matrix import Matrix
from garkcli.exact.parametric import Parameters, common_denominator, factors, fraction
from garkcli.exact.polynomial import Polynomial, interpolated
from garkcli.exact.projection import PLANE
from garkcli.frozen import Frozen
from garkcli.stability.linear import unreduced
from garkcli.stepping.linear import stage_system
from garkcli.tableau.tableau import Tableau

THETA = "_theta"
OVER_FIELD = fmpq_mpoly_ctx.get(["y", "t", THETA], Ordering.lex)
"""ℚ[y, t, θ]."""


class Line(Frozen):
    """The methods of a family along one parameter.

    Attributes:
        tableau: entries are rational numbers and rational functions.
        ring: the parameter and the constants.
        constants: numbers for the other unknowns of the ring, all of one field.
    """

    tableau: Tableau
    ring: Parameters
    constants: Mapping[str, Number] = {}

    @property
    def name(self) -> str:
        """The name of the parameter."""
        [name] = (x for x in self.ring.names if x not in self.constants)
        return name

    @property
    def field(self) -> NumberField | None:
        """The field of the constants; None for ℚ."""
        fields = (x.field for x in self.constants.values() if isinstance(x, Algebraic))
        return next(fields, None)

    def at(self, t: Number) -> Tableau:
        """The method at one value.

        Raises:
            VanishingDenominator: there is no method there.
        """
        return member(self.tableau, self.ring, {self.name: t, **self.constants})

    def along(self, p: fmpq_mpoly) -> Polynomial:
        """A polynomial in the parameter and the constants as one in the parameter."""
        place = self.ring.names.index(self.name)
        by_degree: dict[int, dict[tuple[int, ...], fmpq]] = {}
        for e, a in p.to_dict().items():
            rest = tuple(0 if k == place else int(x) for k, x in enumerate(e))
            by_degree.setdefault(int(e[place]), {})[rest] = a
        values = {self.name: fmpq(0), **self.constants}
        return Polynomial(
            [
                value_of(self.ring.context.from_dict(dict(by_degree.get(k, {}))), self.ring, values)
                for k in range(max(by_degree, default=-1) + 1)
            ]
        )


def over_line(
    line: Line, size: int, decided: Callable[[Tableau], Sequence[Polynomial]]
) -> list[fmpq_mpoly]:
    """Polynomials in y at each value of a parameter t as polynomials in y and t, and in θ if there
    are constants, times a power of the common denominator of the coefficients.

    Args:
        line: the methods.
        size: a bound on the degree of the polynomials in the entries.
        decided: the polynomials in y of one method.
    """
    ring, place = line.ring, line.ring.names.index(line.name)
    common = common_denominator(line.tableau.entries, ring)
    parts = (fraction(x, ring) for x in line.tableau.entries)
    degrees = [int((p * (common // q)).degrees()[place]) for p, q in parts if p]
    degree = size * max([int(common.degrees()[place]), *degrees])
    denominator = line.along(common)
    points = list(islice((t for t in map(fmpq, count()) if denominator(t)), degree + 1))
    rows: list[Sequence[Polynomial]] = []
    for t in points:
        check_time()
        scale = denominator(t) ** size
        rows.append([p * scale for p in decided(line.at(t))])
    return [_through(points, values, line.field) for values in zip(*rows, strict=True)]


def _through(
    points: Sequence[fmpq], values: Sequence[Polynomial], field: NumberField | None
) -> fmpq_mpoly:
    """The polynomial in y and t with given polynomials in y at given t."""
    terms: dict[tuple[int, ...], fmpq] = {}
    for j in range(max(p.degree for p in values) + 1):
        coefficient = interpolated(points, [p[j] for p in values])
        for k, a in enumerate(coefficient.coefficients):
            for i, x in enumerate(poly_of(a).coeffs()):
                if x:
                    terms[(j, k) if field is None else (j, k, i)] = x
    return (PLANE if field is None else OVER_FIELD).from_dict(terms)


class StepPlane(Frozen):
    """M = N/D without a common rational factor of D and all entries of N.

    Attributes:
        denominator: D, with y for the variable of the step.
        numerators: shape (d, d).
        poles: polynomials in t; at their zeros there is no method.
        field: of the coefficients, generated by θ; None for ℚ.
    """

    denominator: fmpq_mpoly
    numerators: tuple[tuple[fmpq_mpoly, ...], ...]
    poles: tuple[Polynomial, ...]
    field: NumberField | None = None

    @classmethod
    def of(
        cls, line: Line, unknowns: int, step: Callable[[Tableau], Sequence[Polynomial]]
    ) -> StepPlane:
        """A step whose denominator is the determinant of ``unknowns`` equations.

        Args:
            line: the methods.
            unknowns: the number of equations of the stages.
            step: D and the entries of N, row by row, of a member; polynomials in y.
        """
        D, *N = over_line(line, unknowns + 1, step)
        d = isqrt(len(N))
        common = D
        for p in N:
            common = common.gcd(p)
        reduced = [p // common for p in N]
        square = tuple(tuple(reduced[start : start + d]) for start in range(0, d * d, d))
        poles = line.along(common_denominator(line.tableau.entries, line.ring))
        return cls(D // common, square, (poles,), line.field)

    def norm(self, p: fmpq_mpoly) -> fmpq_mpoly:
        """The product of the conjugates of a polynomial, in y and t."""
        if self.field is None:
            return p
        powers = enumerate(self.field.modulus.coeffs())
        modulus = OVER_FIELD.from_dict({(0, 0, k): a for k, a in powers if a})
        return projection.resultant(p, modulus, THETA).project_to_context(PLANE)

    def in_t(self, p: fmpq_mpoly) -> Polynomial:
        """A polynomial without y as one in t."""
        if self.field is None:
            return projection.in_t(p)
        rows: dict[int, list[fmpq]] = {}
        size = p.degrees()[2] + 1
        for (_, k, i), a in p.to_dict().items():
            rows.setdefault(int(k), [fmpq(0)] * size)[int(i)] = a
        zero = [fmpq(0)]
        degrees = range(max(rows, default=-1) + 1)
        return Polynomial([self.field.from_coordinates(rows.get(k, zero)) for k in degrees])

    def coefficients(self, p: fmpq_mpoly) -> list[Polynomial]:
        """The coefficients of the powers of y, from the lowest."""
        return [self.in_t(projection.coefficient_of(p, k)) for k in range(p.degrees()[0] + 1)]

    def at_y(self, p: fmpq_mpoly, y: fmpq) -> Polynomial:
        first, *others = p.context().gens()
        return self.in_t(p.compose(first * 0 + y, *others))

    def projected(self, curves: Iterable[fmpq_mpoly], ends: Sequence[fmpq]) -> list[Polynomial]:
        """Polynomials in t: between their roots curves, and ends of an interval of y, stay
        apart.
        """
        return projection.projected(factors(map(self.norm, curves)), ends)

    def meeting(self, p: fmpq_mpoly, q: fmpq_mpoly) -> list[Polynomial]:
        """Polynomials in t: between their roots the number of common points of two curves is
        constant.
        """
        if common := self.norm(projection.resultant(p, q)):
            return [projection.in_t(common)]
        return self.projected([p, q], [])


def step_plane(line: Line, fields: Sequence[Matrix]) -> StepPlane:
    """The step for every value of the parameter.

    Args:
        line: the methods.
        fields: y ↦ L^m y for each colour, rational.
    """

    def step(method: Tableau) -> list[Polynomial]:
        fraction = unreduced(stage_system(method, fields))
        return [fraction.denominator, *chain.from_iterable(fraction.numerators)]

    return StepPlane.of(line, len(stage_system(line.tableau, fields).W), step)
