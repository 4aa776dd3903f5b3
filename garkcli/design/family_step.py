"""Polynomials in z of all methods of a family, as polynomials in z and one or two parameters.

Such is the step M(z) = D(z)⁻¹ N(z) on a linear problem, D = det(I − zW)
(``garkcli.stability.linear``). Times common denominators of coefficients they are polynomials in
the parameters, whose degrees the number of equations bounds: enough rational points determine them.

With coefficients in a number field ℚ(θ), θ is a further unknown. Then the norms, with rational
coefficients, decide: their zeros are those of all conjugates, which stay apart between two points
at which any of them meet.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from functools import cached_property
from itertools import chain
from math import isqrt
from typing import TypeAlias

from flint import Ordering, fmpq, fmpq_mpoly, fmpq_mpoly_ctx

from garkcli.deadline import check_time
from garkcli.design.member import member, no_method, value_of
from garkcli.exact import projection
from garkcli.exact.field import ZERO, Algebraic, Number, NumberField, poly_of
from garkcli.exact.matrix import Matrix
from garkcli.exact.parametric import Parameters, common_denominator, factors, fraction
from garkcli.exact.polynomial import Polynomial, interpolated
from garkcli.frozen import Frozen
from garkcli.stability.linear import unreduced
from garkcli.stepping.linear import stage_system
from garkcli.tableau.tableau import Tableau

THETA = "_theta"
VARIABLES = {1: ("y", "t"), 2: ("z", "y", "t")}
"""The variable of the step, then the parameters, the last one first."""
_Terms: TypeAlias = "dict[tuple[int, ...], Number]"


class Flat(Frozen):
    """A line or a plane of methods; ``constants`` of one field are values of other unknowns."""

    tableau: Tableau
    ring: Parameters
    constants: Mapping[str, Number] = {}

    @property
    def names(self) -> tuple[str, ...]:
        return tuple(x for x in self.ring.names if x not in self.constants)

    @property
    def field(self) -> NumberField | None:
        fields = (x.field for x in self.constants.values() if isinstance(x, Algebraic))
        return next(fields, None)

    @cached_property
    def context(self) -> fmpq_mpoly_ctx:
        """ℚ[y, t] or ℚ[z, y, t], with θ as the last unknown if there is a field."""
        names = VARIABLES[len(self.names)]
        return fmpq_mpoly_ctx.get([*names, *[THETA] * (self.field is not None)], Ordering.lex)

    def over(self, p: fmpq_mpoly) -> fmpq_mpoly:
        gens = dict(zip(self.context.names(), self.context.gens(), strict=True))
        variables = VARIABLES[len(self.names)][:0:-1]
        values = {name: gens[x] for name, x in zip(self.names, variables, strict=True)}
        for name, number in self.constants.items():
            powers = enumerate(poly_of(number).coeffs())
            terms = (gens.get(THETA, self.context.constant(1)) ** k * a for k, a in powers)
            values[name] = sum(terms, self.context.constant(0))
        return p.compose(*(values[name] for name in self.ring.names), ctx=self.context)

    def along(self, p: fmpq_mpoly) -> Polynomial:
        return in_t(self.over(p), self.field)

    def polynomials(
        self, size: int, of_method: Callable[[Tableau], Sequence[Polynomial]]
    ) -> list[fmpq_mpoly]:
        """Polynomials of each method in the variable of the step, the parameters and θ. A power of
        the common denominator is a factor. ``size`` bounds their degree in the entries. Raises
        VanishingDenominator if a denominator is zero at all methods.
        """
        common = common_denominator(self.tableau.entries, self.ring)
        parts = (fraction(x, self.ring) for x in self.tableau.entries)
        cleared = [common, *(p * (common // q) for p, q in parts if p)]
        degrees = [size * int(max(x)) for x in zip(*(p.degrees() for p in cleared), strict=True)]
        poles = common.degrees()
        index = self.ring.names.index

        def interpolated_over(
            values: Mapping[str, fmpq], names: Sequence[str]
        ) -> list[_Terms] | None:
            """The terms with values of the first parameters; None if all others are poles."""
            if not names:
                check_time()
                numbers = {**values, **self.constants}
                scale = value_of(common, self.ring, numbers) ** size
                if not scale:
                    return None
                found = of_method(member(self.tableau, self.ring, numbers))
                return [{(k,): p[k] * scale for k in range(p.degree + 1)} for p in found]
            name, *others = names
            place = index(name)
            points, rows = [], []
            for t in map(fmpq, range(degrees[place] + int(poles[place]) + 1)):
                row = interpolated_over({**values, name: t}, others)
                if row is not None:
                    points.append(t)
                    rows.append(row)
                if len(points) > degrees[place]:
                    return [_through(points, column) for column in zip(*rows, strict=True)]
            return None

        found = interpolated_over({}, self.names)
        if found is None:  # by a relation of the constants
            raise no_method(f"it is that of {self.tableau}")
        return [self.context.from_dict(self._terms(x)) for x in found]

    def _terms(self, terms: _Terms) -> dict[tuple[int, ...], fmpq]:
        if self.field is None:
            return {e: fmpq(a) for e, a in terms.items() if isinstance(a, fmpq) and a}
        powers = ((e, enumerate(poly_of(a).coeffs())) for e, a in terms.items())
        return {(*e, i): x for e, coefficients in powers for i, x in coefficients if x}


def _through(points: Sequence[fmpq], values: Sequence[_Terms]) -> _Terms:
    """The polynomial with given polynomials at given values of one more parameter."""
    terms: _Terms = {}
    for e in dict.fromkeys(chain(*values)):
        through = interpolated(points, [x.get(e, ZERO) for x in values])
        terms |= {(*e, k): a for k, a in enumerate(through.coefficients) if a}
    return terms


def in_t(p: fmpq_mpoly, field: NumberField | None = None) -> Polynomial:
    if field is None:
        return projection.in_t(p)
    rows: dict[int, list[fmpq]] = {}
    size = p.degrees()[2] + 1
    for (_, k, i), a in p.to_dict().items():
        rows.setdefault(int(k), [fmpq(0)] * size)[int(i)] = a
    zero = [fmpq(0)]
    degrees = range(max(rows, default=-1) + 1)
    return Polynomial([field.from_coordinates(rows.get(k, zero)) for k in degrees])


class FamilyStep(Frozen):
    """M = N/D without a common rational factor of D and all entries of N, of shape (d, d).
    Coefficients are in ``field``, generated by θ; at the zeros of ``poles`` there is no method.
    """

    denominator: fmpq_mpoly
    numerators: tuple[tuple[fmpq_mpoly, ...], ...]
    poles: tuple[fmpq_mpoly, ...]
    field: NumberField | None = None

    @classmethod
    def of(
        cls, flat: Flat, unknowns: int, step: Callable[[Tableau], Sequence[Polynomial]]
    ) -> FamilyStep:
        """The step N/D of all members, where D is a determinant of ``unknowns`` equations. ``step``
        returns D and the entries of N of one member, row by row.
        """
        D, *N = flat.polynomials(unknowns + 1, step)
        d = isqrt(len(N))
        common = D
        for p in N:
            common = common.gcd(p)
        reduced = [p // common for p in N]
        square = tuple(tuple(reduced[start : start + d]) for start in range(0, d * d, d))
        poles = flat.over(common_denominator(flat.tableau.entries, flat.ring))
        return cls(D // common, square, (poles,), flat.field)

    def norm(self, p: fmpq_mpoly) -> fmpq_mpoly:
        """The product of the conjugates of a polynomial, without θ."""
        context = p.context()
        if self.field is None or THETA not in context.names():
            return p
        powers = enumerate(self.field.modulus.coeffs())
        theta = context.gen(context.variable_to_index(THETA))
        modulus = sum((theta**k * a for k, a in powers), theta * 0)
        without = fmpq_mpoly_ctx.get(context.names()[:-1], Ordering.lex)
        return projection.resultant(p, modulus, THETA).project_to_context(without)

    def in_t(self, p: fmpq_mpoly) -> Polynomial:
        is_over_field = THETA in p.context().names()
        return in_t(p, self.field if is_over_field else None)

    def curves(self, polynomials: Iterable[fmpq_mpoly]) -> list[fmpq_mpoly]:
        """Irreducible curves in the plane of both parameters that contain the zeros."""
        return factors(projection.in_plane(self.norm(p), y=1, t=2) for p in polynomials if p)

    def coefficients(self, p: fmpq_mpoly) -> list[fmpq_mpoly]:
        """Coefficients of the powers of the variable of the step, from the lowest."""
        return [projection.coefficient_of(p, k) for k in range(p.degrees()[0] + 1)]

    def at_y(self, p: fmpq_mpoly, y: fmpq) -> Polynomial:
        first, *others = p.context().gens()
        return self.in_t(p.compose(first * 0 + y, *others))

    def seen(self, polynomials: Iterable[fmpq_mpoly], ends: Sequence[fmpq]) -> list[fmpq_mpoly]:
        """Polynomials in the parameters between whose zeros those of the others stay apart."""
        return projection.seen_along(factors(map(self.norm, polynomials)), ends)

    def meeting(self, p: fmpq_mpoly, q: fmpq_mpoly) -> list[fmpq_mpoly]:
        """Polynomials in the parameters between whose zeros others have as many common zeros."""
        if common := self.norm(projection.resultant(p, q)):
            return [common]
        return self.seen([p, q], [])


def family_step(flat: Flat, fields: Sequence[Matrix]) -> FamilyStep:
    """The step for every value of the parameters; ``fields`` are the maps y ↦ L^m y, rational."""

    def step(method: Tableau) -> list[Polynomial]:
        fraction = unreduced(stage_system(method, fields))
        return [fraction.denominator, *chain.from_iterable(fraction.numerators)]

    return FamilyStep.of(flat, len(stage_system(flat.tableau, fields).W), step)
