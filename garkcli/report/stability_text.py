"""``gark stability`` for people."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from textwrap import wrap

from garkcli.exact.cells import Interval
from garkcli.exact.display import decimal, to_float, to_text
from garkcli.exact.polynomial import Polynomial
from garkcli.exact.polynomial_text import (
    integral,
    polynomial_text,
    root_decimal,
    root_text,
)
from garkcli.exact.roots import RealRoot
from garkcli.report.paint import Paint, indented
from garkcli.report.plain import printable
from garkcli.report.region_text import terminal_region
from garkcli.report.stability_data import StabilityReport, degrees, factors, square_root
from garkcli.stability.linear import StabilityFunction, poles_are_right
from garkcli.stability.oscillator import OscillatorStability, Ratio
from garkcli.stability.sector import Sector
from garkcli.stability.ssp import SspCoefficient
from garkcli.stability.summary import LinearStability, Stability
from garkcli.stability.two_frequencies import TwoFrequencies

LABEL = 22
"""Columns of a label."""
WIDTH = 80
"""Columns of a terminal."""


def text_of(report: StabilityReport, paint: Paint) -> Iterator[str]:
    """The lines of one report."""
    file, name = printable(report.file), printable(report.name)
    if name == file:
        yield paint("strong", file)
    elif len(file) + len(name) + 2 <= WIDTH:
        yield f"{file}: {paint('strong', name)}"
    else:
        yield f"{file}:"
        yield f"  {paint('strong', name)}"
    within = report.found.tolerance
    if within is None:
        yield "  decided exactly"
    else:
        methods = f"all methods within {decimal(within)}"
        yield f"  coefficients rounded: decided for {methods}, or not"
    if report.springs is not None:
        yield from _springs_text(report.springs, report.digits)
        return
    found = report.found
    for linear in found.linear:
        yield ""
        yield from _linear_text(linear, len(found.linear) > 1, report.digits, paint)
    if within is not None:
        return
    if found.linear:
        yield ""
        yield from _region_lines(found.linear[0].R)
    if found.oscillator is not None:
        yield ""
        yield from _oscillator_text(found.oscillator, report.digits, paint)
    yield ""
    yield from _nonlinear_text(found, paint)


def _line(label: str, text: str) -> list[str]:
    """A label and its text, which goes on in the same column."""
    width = WIDTH - LABEL - 4
    pieces = wrap(text, width, break_long_words=False, break_on_hyphens=False)
    first, *others = pieces or [""]
    head = f"    {label.ljust(LABEL)}{first}"
    return [head.rstrip(), *indented(others, " " * (LABEL + 4))]


def _quotient(numerator: Polynomial, denominator: Polynomial, variable: str) -> str:
    p, q = integral([numerator, denominator])
    over, under = polynomial_text(p, variable), polynomial_text(q, variable)
    if under == "1":
        return over
    return f"({over}) / ({under})" if " " in under else f"({over}) / {under}"


def _linear_text(
    found: LinearStability, is_one_of_many: bool, digits: int, paint: Paint
) -> Iterator[str]:
    whose = ""
    if is_one_of_many and found.name == "all":
        whose = ", all colours alike"
    elif is_one_of_many:
        whose = f", colour {found.name} alone"
    yield f"  {paint('strong', 'linear test equation')}{whose}, z = hλ"
    if found.real is None or found.imaginary is None:
        yield from _line("A-stable", _decided(found.a_stable, paint))
        yield from _line("L-stable", _decided(found.l_stable, paint))
        return
    R = found.R
    yield from _line("R(z)", _quotient(R.numerator, R.denominator, "z"))
    limit = R.at_infinity()
    yield from _line("R(∞)", "unbounded" if limit is None else to_text(limit))
    reason = "" if found.a_stable else f": {_why_not_a_stable(found)}"
    yield from _line("A-stable", _decided(found.a_stable, paint) + reason)
    yield from _line("L-stable", _decided(found.l_stable, paint))
    yield from _line("A(α)-stable", _sector_text(found.sector, digits))
    yield from _line("real axis", _real_text(found.real, digits))
    yield from _line("imaginary axis", _imaginary_text(found.imaginary, digits))
    yield from _line("SSP coefficient", _ssp_text(found.ssp, digits))


def _region_lines(R: StabilityFunction) -> Iterator[str]:
    """A small picture of the region |R(z)| ≤ 1."""
    P = [to_float(a) for a in R.numerator.coefficients]
    Q = [to_float(a) for a in R.denominator.coefficients]

    def is_inside(z: complex) -> bool:
        over, under = abs(_horner(P, z)), abs(_horner(Q, z))
        # the margin keeps points on the very edge inside on every machine
        return over <= under * (1 + 1e-9)

    reach = _reach([P, Q])
    right = reach / 3 if len(Q) == 1 else reach
    picture = terminal_region(is_inside, -reach, right, reach, width=51, height=15)
    yield "    |R(z)| ≤ 1, roughly"
    yield from indented(picture.splitlines(), " " * 4)


def _reach(polynomials: Sequence[Sequence[float]]) -> float:
    """A radius that holds all zeros and poles, by Fujiwara's bound, with some room."""
    reach = 2.0
    for *others, leading in polynomials:
        for k, a in enumerate(reversed(others), start=1):
            size = abs(a / leading)
            reach = max(reach, size ** (1 / k))
    with_room = 1.6 * reach
    return float(f"{with_room:.1g}")


def _horner(coefficients: Sequence[float], z: complex) -> complex:
    value = 0j
    for a in reversed(coefficients):
        value = value * z + a
    return value


def _decided(holds: bool | None, paint: Paint) -> str:
    return "not decided" if holds is None else paint.verdict(holds)


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
    return f"α = {angle}°, cos α {_equation(sector.cosine, 'x', digits)}"


def _equation(root: RealRoot, variable: str, digits: int) -> str:
    """How a number is told: ``= 1/2``, ``= sqrt(2)/2``, or the polynomial it is a root of."""
    simple = root_text(root)
    if simple is not None:
        return f"= {simple}"
    polynomial = _minimal_text(root, variable)
    return f"= {root_decimal(root, digits)}…, a root of {polynomial}"


def _minimal_text(root: RealRoot, variable: str) -> str:
    """The polynomial that a number is told by."""
    polynomial = Polynomial.from_flint(root.polynomial)
    return polynomial_text(polynomial, variable)


def _number(root: RealRoot, digits: int) -> str:
    simple = root_text(root)
    if simple is not None and root.exact is not None:
        return simple
    decimals = root_decimal(root, digits)
    return decimals if simple is None else f"{simple} = {decimals}"


def _real_text(intervals: Sequence[Interval], digits: int) -> str:
    first = intervals[0] if intervals else None
    if first is None or first.start is None or first.start.exact != 0:
        return "z = 0 only"
    if first.end is None:
        return "z ≤ 0"
    if first.is_point:
        return "z = 0 only"
    text = f"−z ≤ {_number(first.end, digits)}"
    if root_text(first.end) is None:
        text += f", a root of {_minimal_text(first.end, 'x')}"
    return text + _further(intervals)


def _imaginary_text(intervals: Sequence[Interval], digits: int) -> str:
    first = intervals[0] if intervals else None
    if first is None or first.is_point or first.start is None or first.start.exact != 0:
        return "y = 0 only"
    if first.end is None:
        return "all y"
    end = square_root(first.end, digits)
    text = f"|y| ≤ {end}, y² {_equation(first.end, 'x', digits)}"
    return text + _further(intervals)


def _further(intervals: Sequence[Interval]) -> str:
    return " and further intervals" if len(intervals) > 1 else ""


def _ssp_text(found: SspCoefficient | None, digits: int) -> str:
    if found is None:
        return "not decided: the nodes have no simple radicals"
    if found.value is None:
        return "∞"
    if root_text(found.value):
        return _number(found.value, digits)
    return _equation(found.value, "x", digits).removeprefix("= ")


def _oscillator_text(
    found: OscillatorStability, digits: int, paint: Paint
) -> Iterator[str]:
    yield f"  {paint('strong', 'oscillator')}, z = hω, x = z²"
    yield from _line("trace", _ratio(found.trace))
    yield from _line("determinant", _ratio(found.determinant))
    [discriminant] = integral([found.discriminant])
    yield from _line("4D² − N²", polynomial_text(discriminant, "x"))
    yield from _stable_text(found.stable, digits)
    reason = "" if found.is_p_stable else f": {_why_not_p_stable(found, digits)}"
    yield from _line("P-stable", paint.verdict(found.is_p_stable) + reason)
    yield from _line("phase lag", _phase_text(found))
    yield from _line("conserved form", _conserved_text(found))


def _ratio(ratio: Ratio) -> str:
    return _quotient(ratio.numerator, ratio.denominator, "x")


def _stable_text(intervals: Sequence[Interval], digits: int) -> Iterator[str]:
    if not intervals:
        yield from _line("stable", "for no x")
    label = "stable"
    for interval in intervals:
        yield from _line(label, _interval_text(interval, digits))
        label = ""


def _interval_text(interval: Interval, digits: int) -> str:
    assert interval.start is not None
    start = _number(interval.start, digits)
    if interval.is_point:
        return f"x = {start}"
    left = "≤" if interval.has_start else "<"
    text = f"{start} {left} x"
    ends = [interval.start]
    if interval.end is not None:
        right = "≤" if interval.has_end else "<"
        end, end_of_z = _number(interval.end, digits), square_root(interval.end, digits)
        text += f" {right} {end}, z to {end_of_z}"
        ends.append(interval.end)
    for x in ends:
        if root_text(x) is None:
            text += f"; a root of {_minimal_text(x, 'x')}"
    return text


def _why_not_p_stable(found: OscillatorStability, digits: int) -> str:
    first = found.stable[0] if found.stable else None
    if first is None or not first.has_start or first.is_point:
        return "unstable for small step sizes"
    assert first.end is not None
    end = _number(first.end, digits)
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
        elif p:
            parts.append(name if p == Polynomial([1]) else f"{factor} {name}")
    return " + ".join(parts)


def _nonlinear_text(found: Stability, paint: Paint) -> Iterator[str]:
    yield f"  {paint('strong', 'nonlinear')}"
    label = "algebraically stable"
    if found.algebraic is None:
        meaning = "has no meaning: colours do not see one another"
        yield from _line(label, meaning)
        return
    reasons = []
    if not found.algebraic.weights_are_positive:
        reasons.append("a weight is negative")
    if not found.algebraic.form_is_positive:
        reasons.append("B A + Aᵀ B − b bᵀ is not positive semidefinite")
    verdict = paint.verdict(found.algebraic.holds)
    if reasons:
        verdict += f": {', '.join(reasons)}"
    yield from _line(label, verdict)


def _springs_text(found: TwoFrequencies, digits: int) -> Iterator[str]:
    yield ""
    yield f"  two springs, a = (hω_slow)² = {found.slow}, x = (hω_fast)²"
    yield from _line("trace", _ratio(found.trace))
    yield from _line("determinant", _ratio(found.determinant))
    label = "factors of 4D² − N²"
    for factor, power in factors(found.discriminant):
        text = polynomial_text(factor, "x")
        if power > 1:
            text += f", {power} times"
        yield from _line(label, text)
        label = ""
    yield from _stable_text(found.stable, digits)
