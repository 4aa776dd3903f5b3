"""``gark stability --format json``: exact numbers and polynomials as text."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from flint import arb, ctx, fmpq

from garkcli.exact.cells import Interval
from garkcli.exact.display import decimal, plain_decimal, to_text
from garkcli.exact.polynomial import Polynomial
from garkcli.exact.polynomial_text import (
    BITS_A_DIGIT,
    ball_decimal,
    integral,
    polynomial_text,
)
from garkcli.exact.roots import RealRoot
from garkcli.report.exactly import root_data
from garkcli.stability.bounds import Bounds
from garkcli.stability.linear import StabilityFunction
from garkcli.stability.oscillator import OscillatorStability
from garkcli.stability.sector import Sector
from garkcli.stability.slow_interval import SlowInterval
from garkcli.stability.ssp import SspCoefficient
from garkcli.stability.summary import LinearStability, Stability
from garkcli.stability.two_frequencies import TwoFrequencies

if TYPE_CHECKING:
    from garkcli.stability.springs_plane import SpringsPlane


PLACES = fmpq(10) ** 20
"""Decimal places of bounds."""


@dataclass(frozen=True)
class StabilityReport:
    """What is printed of one file.

    Attributes:
        file: its path as given.
        name: the name of the method.
        found: its stability.
        springs: the two-frequency problem where it was asked for.
        digits: decimals of algebraic numbers.
        plane: both frequencies in floats, for a picture.
        slow: the two-frequency problem for an interval of slow frequencies.
    """

    file: str
    name: str
    found: Stability
    springs: TwoFrequencies | None = None
    digits: int = 12
    plane: SpringsPlane | None = None
    slow: SlowInterval | None = None


def as_data(report: StabilityReport) -> dict[str, Any]:
    """One report as plain data."""
    found, digits = report.found, report.digits
    head: dict[str, Any] = {
        "file": report.file,
        "name": report.name,
        "kind": found.kind,
    }
    head["tolerance"] = None if found.tolerance is None else decimal(found.tolerance)
    if report.slow is not None:
        return {**head, "kind": "slow-interval", **_slow_data(report.slow, digits)}
    if report.springs is not None:
        return {
            **head,
            "kind": "two-frequencies",
            **_springs_data(report.springs, digits),
        }
    data = dict(head)
    if found.linear:
        data |= _linear_data(found.linear[0], digits)
        data["colours"] = [
            {"name": one.name, **_linear_data(one, digits)} for one in found.linear[1:]
        ]
    if found.oscillator is not None:
        data |= _oscillator_data(found.oscillator, digits)
    data["algebraically_stable"] = (
        found.algebraic_within if found.algebraic is None else found.algebraic.holds
    )
    return data


def _ratio_data(
    numerator: Polynomial, denominator: Polynomial, variable: str
) -> dict[str, str]:
    over, under = integral([numerator, denominator])
    return {
        "numerator": polynomial_text(over, variable),
        "denominator": polynomial_text(under, variable),
    }


def _linear_data(found: LinearStability, digits: int) -> dict[str, Any]:
    within = found.within
    data = _exact_data(found, digits)
    if within is not None:
        data["real_interval"] = _bounds_data(within.real)
        data["imaginary_interval"] = _bounds_data(within.imaginary)
        data["ssp"] = _bounds_data(within.ssp)
    return data


def _bounds_data(found: Bounds) -> Any:
    """Bounds, rounded outwards; null where none is known."""
    low, high = found.low, found.high
    if low is None:
        return {"at_least": "infinity", "at_most": None}
    down = fmpq((low * PLACES).floor()) / PLACES
    up = None if high is None else fmpq((high * PLACES).ceil()) / PLACES
    return {
        "at_least": plain_decimal(down),
        "at_most": None if up is None else plain_decimal(up),
    }


def _exact_data(found: LinearStability, digits: int) -> dict[str, Any]:
    R: StabilityFunction = found.R
    limit = R.at_infinity()
    return {
        "R": _ratio_data(R.numerator, R.denominator, "z"),
        "R_infinity": None if limit is None else to_text(limit),
        "a_stable": found.a_stable,
        "l_stable": found.l_stable,
        "A_alpha": _sector_data(found.sector, digits),
        "real_interval": _end_data(found.real, digits),
        "imaginary_interval": _end_data(found.imaginary, digits),
        "ssp": ssp_data(found.ssp, digits),
    }


def _sector_data(sector: Sector | None, digits: int) -> Any:
    if sector is None or sector.cosine is None:
        return None
    return {
        "degrees": degrees(sector.cosine, digits),
        "cosine": root_data(sector.cosine, digits),
    }


def _end_data(intervals: Sequence[Interval] | None, digits: int) -> Any:
    """The first interval, by its end: in −z on the real axis, in y² on the imaginary one."""
    if intervals is None:
        return None
    if not intervals:
        return {"to": "0"}
    if intervals[0].end is None:
        return {"to": None}
    return {"to": root_data(intervals[0].end, digits)}


def ssp_data(found: SspCoefficient | None, digits: int) -> Any:
    """A radius of absolute monotonicity for programs."""
    if found is None:
        return None
    return "infinity" if found.value is None else root_data(found.value, digits)


def intervals_data(intervals: Sequence[Interval], digits: int) -> list[dict[str, Any]]:
    """Intervals for programs."""
    return [
        {
            "from": None if x.start is None else root_data(x.start, digits),
            "to": None if x.end is None else root_data(x.end, digits),
            "from_included": x.has_start,
            "to_included": x.has_end,
        }
        for x in intervals
    ]


def _oscillator_data(found: OscillatorStability, digits: int) -> dict[str, Any]:
    form = found.conserved
    conserved = None
    if form is not None:
        texts = [polynomial_text(p, "z") for p in integral(form)]
        conserved = {"qq": texts[0], "qp": texts[1], "pp": texts[2]}
    constant = found.phase.constant
    return {
        "trace": _ratio_data(found.trace.numerator, found.trace.denominator, "x"),
        "determinant": _ratio_data(
            found.determinant.numerator, found.determinant.denominator, "x"
        ),
        "discriminant": polynomial_text(integral([found.discriminant])[0], "x"),
        "stable": intervals_data(found.stable, digits),
        "p_stable": found.is_p_stable,
        "phase_order": found.phase.order,
        "phase_constant": None if constant is None else to_text(constant),
        "conserved": conserved,
    }


def _springs_data(found: TwoFrequencies, digits: int) -> dict[str, Any]:
    listed = factors(found.discriminant)
    return {
        "slow": str(found.slow),
        "trace": _ratio_data(found.trace.numerator, found.trace.denominator, "x"),
        "determinant": _ratio_data(
            found.determinant.numerator, found.determinant.denominator, "x"
        ),
        "factors": [
            {"factor": polynomial_text(p, "x"), "multiplicity": n} for p, n in listed
        ],
        "stable": intervals_data(found.stable, digits),
    }


def _slow_data(found: SlowInterval, digits: int) -> dict[str, Any]:
    return {
        "slow": {"from": str(found.low), "to": str(found.high)},
        "stable": intervals_data(found.stable, digits),
        "stable_for_every_fast": found.is_stable_for_all,
        "open_points": [root_data(x, digits) for x in found.open_points],
    }


def factors(p: Polynomial) -> list[tuple[Polynomial, int]]:
    """The irreducible factors over ℚ, with their multiplicities; p itself over a number field."""
    if not p.is_rational or not p:
        return [(p, 1)]
    found = p.to_flint().numer().factor()[1]
    return [(Polynomial.from_flint(factor), power) for factor, power in found]


def degrees(cosine: RealRoot, digits: int) -> str:
    """The angle of a cosine, in degrees."""
    bits = int(digits * BITS_A_DIGIT) + 64
    before = ctx.prec
    try:
        ctx.prec = bits
        angle = cosine.ball(bits).acos() * 180 / arb.pi()
        return ball_decimal(angle, digits)
    finally:
        ctx.prec = before


def square_root(root: RealRoot, digits: int) -> str:
    """The square root of a number that is not negative, as a decimal."""
    bits = int(digits * BITS_A_DIGIT) + 64
    before = ctx.prec
    try:
        ctx.prec = bits
        return ball_decimal(root.ball(bits).sqrt(), digits)
    finally:
        ctx.prec = before
