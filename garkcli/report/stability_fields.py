"""What ``gark stability --format json`` tells: exact numbers and polynomials as text."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Generic, NamedTuple, TypeVar

from flint import fmpq

from garkcli.exact.cells import Interval
from garkcli.exact.display import plain_decimal, to_text
from garkcli.exact.polynomial import Polynomial
from garkcli.exact.polynomial_text import integral, multivariate_text, polynomial_text
from garkcli.exact.roots import RealRoot
from garkcli.page.exactly import ALGEBRAIC, ROOT_OF, root_data
from garkcli.page.record import Field, Record
from garkcli.page.schema import (
    COUNT,
    EXACT,
    FLAG,
    NULL,
    POSITION,
    TEXT,
    Schema,
    array,
    nullable,
    one_of,
)
from garkcli.report.stability_colours import integral_parts
from garkcli.report.stability_data import degrees, factors
from garkcli.stability.bounds import Bounds
from garkcli.stability.colours import Colours
from garkcli.stability.damping import Ray
from garkcli.stability.fraction import Fraction
from garkcli.stability.linear import StabilityFunction
from garkcli.stability.oscillator import OscillatorStability, Ratio
from garkcli.stability.sector import Sector
from garkcli.stability.slow_interval import SlowInterval
from garkcli.stability.ssp import AdditiveRadius, SspCoefficient
from garkcli.stability.summary import LinearStability
from garkcli.stability.two_frequencies import TwoFrequencies

Part = TypeVar("Part")
PLACES = fmpq(10) ** 20
"""Decimal places of bounds."""


class Shown(NamedTuple, Generic[Part]):
    """A part of the report, and how many digits its algebraic numbers have."""

    part: Part
    digits: int

    def root(self, root: RealRoot | None) -> object:
        """An algebraic number; None stays None."""
        if root is None:
            return None
        return root_data(root, self.digits)

    def radius(self, found: SspCoefficient | None) -> object:
        """A radius of absolute monotonicity, which may be infinite; None where not decided."""
        if found is None:
            return None
        if found.value is None:
            return "infinity"
        return self.root(found.value)


def _record(**schemas: Schema) -> Schema:
    """An object with just these fields."""
    return {
        "type": "object",
        "required": [*schemas],
        "properties": schemas,
        "additionalProperties": False,
    }


# polynomials and their quotients

RATIO: Schema = _record(numerator=TEXT, denominator=TEXT)


def ratio(found: Ratio | StabilityFunction, variable: str) -> dict[str, str]:
    """A rational function, with integers where they do."""
    over, under = integral([found.numerator, found.denominator])
    return {
        "numerator": polynomial_text(over, variable),
        "denominator": polynomial_text(under, variable),
    }


def _factor(found: tuple[Polynomial, int]) -> str:
    factor, _ = found
    return polynomial_text(factor, "x")


def _numerator(R: Fraction) -> str:
    over, _ = _multivariate(R)
    return over


def _denominator(R: Fraction) -> str:
    _, under = _multivariate(R)
    return under


FRACTION: Record[Fraction] = Record(
    Field("numerator", TEXT, _numerator),
    Field("denominator", TEXT, _denominator),
    Field("lowest_terms", FLAG, lambda x: x.is_reduced),
)
_FACTOR: Record[tuple[Polynomial, int]] = Record(
    Field("factor", TEXT, _factor), Field("multiplicity", POSITION, lambda x: x[1])
)


def _multivariate(R: Fraction) -> list[str]:
    """Numerator and denominator in z1, z2, …"""
    parts = integral_parts(R)
    count = parts[0].variables
    names = [f"z{k}" for k in range(1, count + 1)]
    return [multivariate_text(p, names) for p in parts]


# intervals

_ROOT_OR_NULL: Schema = nullable(ALGEBRAIC)
_END: Schema = _record(to=_ROOT_OR_NULL)
_INTERVAL: Record[Shown[Interval]] = Record(
    Field("from", _ROOT_OR_NULL, lambda x: x.root(x.part.start)),
    Field("to", _ROOT_OR_NULL, lambda x: x.root(x.part.end)),
    Field("from_included", FLAG, lambda x: x.part.has_start),
    Field("to_included", FLAG, lambda x: x.part.has_end),
)


_BOUNDS: Schema = _record(at_least=TEXT, at_most=nullable(TEXT))
"""Of rounded coefficients: what holds for all methods within the tolerance."""


def _bounds(found: Bounds) -> dict[str, str | None]:
    """Bounds, rounded outwards; null where none is known."""
    low, high = found.low, found.high
    if low is None:
        return {"at_least": "infinity", "at_most": None}
    places_down = (low * PLACES).floor()
    at_least = plain_decimal(fmpq(places_down) / PLACES)
    at_most = None
    if high is not None:
        places_up = (high * PLACES).ceil()
        at_most = plain_decimal(fmpq(places_up) / PLACES)
    return {"at_least": at_least, "at_most": at_most}


def _end(shown: Shown[Any], intervals: Sequence[Interval] | None) -> dict[str, object] | None:
    """The first interval, by its end: in −z on the real axis, in y² on the imaginary one."""
    if intervals is None:
        return None
    if not intervals:
        return {"to": "0"}
    end = intervals[0].end
    return {"to": shown.root(end)}


def _ray(shown: Shown[Any], ray: Ray | None) -> dict[str, object] | None:
    if ray is None:
        return None
    return {"to": shown.root(ray.end)}


def _intervals(
    shown: Shown[OscillatorStability] | Shown[TwoFrequencies] | Shown[SlowInterval],
) -> list[Shown[Interval]]:
    return [Shown(x, shown.digits) for x in shown.part.stable]


# the linear test equation


def _sector(shown: Shown[LinearStability]) -> dict[str, object] | None:
    sector: Sector | None = shown.part.sector
    if sector is None or sector.cosine is None:
        return None
    angle = degrees(sector.cosine, shown.digits)
    return {"degrees": angle, "cosine": shown.root(sector.cosine)}


def _limit(shown: Shown[LinearStability]) -> str | None:
    limit = shown.part.R.at_infinity()
    if limit is None:
        return None
    return to_text(limit)


def _real_interval(shown: Shown[LinearStability]) -> object:
    found = shown.part
    if found.within is not None:
        return _bounds(found.within.real)
    return _end(shown, found.real)


def _imaginary_interval(shown: Shown[LinearStability]) -> object:
    found = shown.part
    if found.within is not None:
        return _bounds(found.within.imaginary)
    return _end(shown, found.imaginary)


def _ssp(shown: Shown[LinearStability]) -> object:
    found = shown.part
    if found.within is not None:
        return _bounds(found.within.ssp)
    return shown.radius(found.ssp)


_LIMIT: Schema = one_of(NULL, _END, _BOUNDS)
_SECTOR: Schema = _record(degrees=TEXT, cosine=ALGEBRAIC)
LINEAR: tuple[Field[Shown[LinearStability]], ...] = (
    Field("R", RATIO, lambda x: ratio(x.part.R, "z")),
    Field("R_infinity", nullable(EXACT), _limit),
    Field("a_stable", nullable(FLAG), lambda x: x.part.a_stable),
    Field("l_stable", nullable(FLAG), lambda x: x.part.l_stable),
    Field("A_alpha", nullable(_SECTOR), _sector),
    Field("real_interval", _LIMIT, _real_interval),
    Field("imaginary_interval", _LIMIT, _imaginary_interval),
    Field("ssp", one_of(NULL, TEXT, ROOT_OF, _BOUNDS), _ssp),
)
OF_COLOUR: Record[Shown[LinearStability]] = Record(
    Field("name", TEXT, lambda x: x.part.name), *LINEAR
)


# several colours, each with a z of its own


def _explicit(shown: Shown[Colours]) -> str | None:
    pair, names = shown.part.pair, shown.part.names
    if pair is None:
        return None
    return names[pair.explicit]


def _implicit(shown: Shown[Colours]) -> str | None:
    pair, names = shown.part.pair, shown.part.names
    if pair is None:
        return None
    return names[pair.implicit]


def _direction(shown: Shown[AdditiveRadius]) -> list[str]:
    return [str(ratio) for ratio in shown.part.ratios]


def _radius(shown: Shown[AdditiveRadius]) -> object:
    return shown.radius(shown.part.radius)


def _real_ray(shown: Shown[Colours]) -> dict[str, object] | None:
    return _ray(shown, shown.part.real)


def _imaginary_ray(shown: Shown[Colours]) -> dict[str, object] | None:
    return _ray(shown, shown.part.imaginary)


_END_OR_NULL: Schema = nullable(_END)
RADIUS: Record[Shown[AdditiveRadius]] = Record(
    Field("direction", array(EXACT), _direction), Field("radius", _ROOT_OR_NULL, _radius)
)
IMEX: Record[Shown[Colours]] = Record(
    Field("explicit", TEXT, _explicit),
    Field("implicit", TEXT, _implicit),
    Field("real_interval", _END_OR_NULL, _real_ray),
    Field("imaginary_interval", _END_OR_NULL, _imaginary_ray),
)


# the oscillator, and two springs


def _discriminant(shown: Shown[OscillatorStability]) -> str:
    [discriminant] = integral([shown.part.discriminant])
    return polynomial_text(discriminant, "x")


def _phase_constant(shown: Shown[OscillatorStability]) -> str | None:
    constant = shown.part.phase.constant
    if constant is None:
        return None
    return to_text(constant)


def _conserved(shown: Shown[OscillatorStability]) -> dict[str, str] | None:
    form = shown.part.conserved
    if form is None:
        return None
    qq, qp, pp = (polynomial_text(p, "z") for p in integral(form))
    return {"qq": qq, "qp": qp, "pp": pp}


def _slow_ends(shown: Shown[SlowInterval]) -> dict[str, str]:
    found = shown.part
    return {"from": str(found.low), "to": str(found.high)}


def _always_stable(shown: Shown[SlowInterval]) -> bool | None:
    return shown.part.is_stable_for_all


def _open_points(shown: Shown[SlowInterval]) -> list[object]:
    return [shown.root(x) for x in shown.part.open_points]


_CONSERVED: Schema = _record(qq=TEXT, qp=TEXT, pp=TEXT)
OSCILLATOR: tuple[Field[Shown[OscillatorStability]], ...] = (
    Field("trace", RATIO, lambda x: ratio(x.part.trace, "x")),
    Field("determinant", RATIO, lambda x: ratio(x.part.determinant, "x")),
    Field("discriminant", TEXT, _discriminant),
    _INTERVAL.every("stable", _intervals),
    Field("p_stable", nullable(FLAG), lambda x: x.part.is_p_stable),
    Field("phase_order", nullable(COUNT), lambda x: x.part.phase.order),
    Field("phase_constant", nullable(EXACT), _phase_constant),
    Field("conserved", nullable(_CONSERVED), _conserved),
)
SPRINGS: tuple[Field[Shown[TwoFrequencies]], ...] = (
    Field("slow", EXACT, lambda x: str(x.part.slow)),
    Field("trace", RATIO, lambda x: ratio(x.part.trace, "x")),
    Field("determinant", RATIO, lambda x: ratio(x.part.determinant, "x")),
    _FACTOR.every("factors", lambda x: factors(x.part.discriminant)),
    _INTERVAL.every("stable", _intervals),
)
_FROM_TO: Schema = _record(**{"from": EXACT, "to": EXACT})
SLOW_INTERVAL: tuple[Field[Shown[SlowInterval]], ...] = (
    Field("slow", _FROM_TO, _slow_ends),
    _INTERVAL.every("stable", _intervals),
    Field("stable_for_every_fast", nullable(FLAG), _always_stable),
    Field("open_points", array(ALGEBRAIC), _open_points),
)
