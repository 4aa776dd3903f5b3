"""``gark stability`` for people."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import TypeAlias

from garkcli.exact.cells import Interval
from garkcli.exact.display import decimal, to_text
from garkcli.exact.polynomial_text import integral, polynomial_text, root_text
from garkcli.page.paint import Paint
from garkcli.page.plain import printable
from garkcli.report.stability_colours import colours_text
from garkcli.report.stability_data import StabilityReport, degrees, factors
from garkcli.report.stability_region import region_lines
from garkcli.report.stability_words import (
    WIDTH,
    bounds_text,
    decided,
    equation,
    imaginary_text,
    interval_text,
    line,
    minimal_text,
    number,
    quotient,
    real_text,
    root_meanings,
    ssp_text,
)
from garkcli.stability.linear import poles_are_right
from garkcli.stability.oscillator import OscillatorStability, Ratio
from garkcli.stability.sector import Sector
from garkcli.stability.slow_interval import SlowInterval
from garkcli.stability.summary import LinearStability, Stability
from garkcli.stability.two_frequencies import TwoFrequencies
from garkcli.stability.within import StabilityWithin

Fact: TypeAlias = tuple[str, str]
"""A label and a text; the label is empty where it is that of the fact before."""


def text_of(report: StabilityReport, paint: Paint) -> Iterator[str]:
    """The lines of one report."""
    yield from _title(report, paint)
    within = report.found.tolerance
    if within is None:
        yield "  decided exactly"
    else:
        methods = f"all methods within {decimal(within)}"
        yield f"  coefficients rounded: decided for {methods}, or not"
    yield from root_meanings(report.found.tableau)
    if report.slow is not None:
        yield from _slow_text(report.slow, report.digits, paint)
        return
    if report.springs is not None:
        yield from _springs_text(report.springs, report.digits)
        return
    found = report.found
    several = len(found.linear) > 1
    for linear in found.linear:
        yield ""
        yield from _linear_text(linear, several, report.digits, paint)
    if within is not None:
        yield from _rounded_text(found, paint)
        return
    if found.linear:
        yield ""
        yield from region_lines(found.linear[0].R)
    if found.colours is not None:
        yield ""
        yield from colours_text(found.colours, report.digits, paint)
    if found.oscillator is not None:
        yield ""
        yield from _oscillator_text(found.oscillator, report.digits, paint)
    yield ""
    yield from _nonlinear_text(found, paint)


def _title(report: StabilityReport, paint: Paint) -> Iterator[str]:
    """The file and the name of the method: below each other where they are long."""
    file = printable(report.file)
    name = printable(report.name)
    painted = paint("strong", name)
    if name == file:
        yield painted
    elif len(f"{file}: {name}") <= WIDTH:
        yield f"{file}: {painted}"
    else:
        yield f"{file}:"
        yield f"  {painted}"


def _linear_text(
    found: LinearStability, is_one_of_many: bool, digits: int, paint: Paint
) -> Iterator[str]:
    whose = ""
    if is_one_of_many and found.name == "all":
        whose = ", all colours alike"
    elif is_one_of_many:
        whose = f", colour {found.name} alone"
    title = paint("strong", "linear test equation")
    yield f"  {title}{whose}, z = hλ"
    R = found.R
    if found.within is None:
        yield from line("R(z)", quotient(R.numerator, R.denominator, "z"))
    yield from _lines(linear_facts(found, digits, paint))


def _lines(facts: Iterable[Fact]) -> Iterator[str]:
    for label, text in facts:
        yield from line(label, text)


def linear_facts(found: LinearStability, digits: int, paint: Paint) -> Iterator[Fact]:
    """What R(z) tells, without itself."""
    if found.real is None or found.imaginary is None:
        yield "A-stable", decided(found.a_stable, paint)
        yield "L-stable", decided(found.l_stable, paint)
        if found.within is not None:
            yield from _within_facts(found.within, digits)
        return
    limit = found.R.at_infinity()
    yield "R(∞)", "unbounded" if limit is None else to_text(limit)
    a_stable = decided(found.a_stable, paint)
    if not found.a_stable:
        reason = _why_not_a_stable(found)
        a_stable += f": {reason}"
    yield "A-stable", a_stable
    yield "L-stable", decided(found.l_stable, paint)
    yield "A(α)-stable", _sector_text(found.sector, digits)
    yield "real axis", real_text(found.real, digits)
    yield "imaginary axis", imaginary_text(found.imaginary, digits)
    yield "SSP coefficient", ssp_text(found.ssp, digits)


def _why_not_a_stable(found: LinearStability) -> str:
    R = found.R
    if R.at_infinity() is None:
        return "R is unbounded"
    if not poles_are_right(R.denominator):
        return "a pole is not in the right half plane"
    E = polynomial_text(found.e_polynomial, "x")
    return f"|R(iy)| > 1 where E(y²) < 0, E = {E}"


def _sector_text(sector: Sector | None, digits: int) -> str:
    if sector is None:
        return "not decided: too many stages"
    if sector.cosine is None:
        return "no"
    simple = root_text(sector.cosine)
    if simple == "0":
        return "α = 90°"
    angle = degrees(sector.cosine, digits)
    cosine = equation(sector.cosine, "x", digits)
    return f"α = {angle}°, cos α {cosine}"


def _oscillator_text(found: OscillatorStability, digits: int, paint: Paint) -> Iterator[str]:
    title = paint("strong", "oscillator")
    yield f"  {title}, z = hω, x = z²"
    yield from line("trace", _ratio(found.trace))
    yield from line("determinant", _ratio(found.determinant))
    yield from _lines(oscillator_facts(found, digits, paint))


def oscillator_facts(found: OscillatorStability, digits: int, paint: Paint) -> Iterator[Fact]:
    """What the step matrix tells, without itself."""
    [discriminant] = integral([found.discriminant])
    yield "4D² − N²", polynomial_text(discriminant, "x")
    yield from _stable_facts(found.stable, digits)
    p_stable = paint.verdict(found.is_p_stable)
    if not found.is_p_stable:
        reason = _why_not_p_stable(found, digits)
        p_stable += f": {reason}"
    yield "P-stable", p_stable
    yield "phase lag", _phase_text(found)
    yield "conserved form", _conserved_text(found)


def _ratio(ratio: Ratio) -> str:
    return quotient(ratio.numerator, ratio.denominator, "x")


def _stable_facts(intervals: Sequence[Interval], digits: int) -> Iterator[Fact]:
    if not intervals:
        yield "stable", "for no x"
    label = "stable"
    for interval in intervals:
        yield label, interval_text(interval, digits)
        label = ""


def _why_not_p_stable(found: OscillatorStability, digits: int) -> str:
    first = found.stable[0] if found.stable else None
    if first is None or not first.has_start or first.is_point:
        return "unstable for small step sizes"
    assert first.end is not None
    end = number(first.end, digits)
    where = "beyond" if first.has_end else "at"
    return f"not stable {where} x = {end}"


def _phase_text(found: OscillatorStability) -> str:
    order = found.phase.order
    if order is None:
        return "none: the frequency is exact"
    if found.phase.constant is None:
        return "order 0: the frequency is wrong for small step sizes"
    constant = to_text(found.phase.constant)
    return f"order {order}: {constant} z^{order + 1}"


def _conserved_text(found: OscillatorStability) -> str:
    if not found.determinant.is_one:
        return "none: the determinant is not 1"
    form = found.conserved
    if form is None:
        return "every one: the step is a multiple of the identity"
    names = ("(ωq)²", "ωq p", "p²")
    parts = []
    for p, name in zip(integral(form), names, strict=True):
        factor = polynomial_text(p, "z")
        if len(p.coefficients) > 1:
            parts.append(f"({factor}) {name}")
        elif factor == "1":
            parts.append(name)
        elif p:
            parts.append(f"{factor} {name}")
    return " + ".join(parts)


def _nonlinear_text(found: Stability, paint: Paint) -> Iterator[str]:
    title = paint("strong", "nonlinear")
    yield f"  {title}"
    yield from line(*nonlinear_fact(found, paint))


def nonlinear_fact(found: Stability, paint: Paint) -> Fact:
    """Whether the method is algebraically stable, and why it is not."""
    label = "algebraically stable"
    if found.algebraic is None:
        return label, "has no meaning: colours do not see one another"
    reasons = []
    if not found.algebraic.weights_are_positive:
        reasons.append("a weight is negative")
    if not found.algebraic.form_is_positive:
        reasons.append("B A + Aᵀ B − b bᵀ is not positive semidefinite")
    verdict = paint.verdict(found.algebraic.holds)
    if reasons:
        told = ", ".join(reasons)
        verdict += f": {told}"
    return label, verdict


def _springs_text(found: TwoFrequencies, digits: int) -> Iterator[str]:
    yield ""
    yield f"  two springs, a = (hω_slow)² = {found.slow}, x = (hω_fast)²"
    yield from line("trace", _ratio(found.trace))
    yield from line("determinant", _ratio(found.determinant))
    label = "factors of 4D² − N²"
    for factor, power in factors(found.discriminant):
        text = polynomial_text(factor, "x")
        if power > 1:
            text += f", {power} times"
        yield from line(label, text)
        label = ""
    yield from _lines(_stable_facts(found.stable, digits))


def _slow_text(found: SlowInterval, digits: int, paint: Paint) -> Iterator[str]:
    yield ""
    yield "  two springs, x = (hω_fast)²"
    yield f"  for every a = (hω_slow)² from {found.low} to {found.high}"
    yield from _lines(_stable_facts(found.stable, digits))
    for x in found.open_points:
        point = number(x, digits)
        polynomial = minimal_text(x, "x")
        single = f"x = {point} alone, a root of {polynomial}"
        yield from line("not decided", single)
    verdict = decided(found.is_stable_for_all, paint)
    yield from line("stable for all x > 0", verdict)


def _within_facts(found: StabilityWithin, digits: int) -> Iterator[Fact]:
    """What is known of rounded coefficients besides A- and L-stability."""
    real = bounds_text(found.real, digits, "−z ≤ ")
    imaginary = bounds_text(found.imaginary, digits, "y² ≤ ")
    ssp = bounds_text(found.ssp, digits)
    yield "real axis", real
    yield "imaginary axis", imaginary
    yield "SSP coefficient", ssp


def _rounded_text(found: Stability, paint: Paint) -> Iterator[str]:
    """The rest for rounded coefficients."""
    yield ""
    if not found.linear:
        yield "  oscillator: not decided for rounded coefficients"
        return
    title = paint("strong", "nonlinear")
    verdict = decided(found.algebraic_within, paint)
    yield f"  {title}"
    yield from line("algebraically stable", verdict)
