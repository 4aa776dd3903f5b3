"""``gark stability`` for people."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from textwrap import wrap

from garkcli.exact.cells import Interval
from garkcli.exact.display import decimal, to_float, to_text
from garkcli.exact.polynomial import Polynomial
from garkcli.exact.roots import RealRoot
from garkcli.report.exactly import integral, polynomial_text, root_decimal, root_text
from garkcli.report.paint import Paint
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
        yield f"  coefficients rounded: decided for all methods within {decimal(within)}, or not"
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
    pieces = wrap(
        text, WIDTH - LABEL - 4, break_long_words=False, break_on_hyphens=False
    ) or [""]
    first = f"    {label.ljust(LABEL)}{pieces[0]}".rstrip()
    return [first, *(" " * (LABEL + 4) + piece for piece in pieces[1:])]


def _quotient(numerator: Polynomial, denominator: Polynomial, variable: str) -> str:
    over, under = (
        polynomial_text(p, variable) for p in integral([numerator, denominator])
    )
    if under == "1":
        return over
    return f"({over}) / ({under})" if " " in under else f"({over}) / {under}"


def _linear_text(
    found: LinearStability, is_one_of_many: bool, digits: int, paint: Paint
) -> Iterator[str]:
    whose = ""
    if is_one_of_many:
        whose = (
            ", all colours alike"
            if found.name == "all"
            else f", colour {found.name} alone"
        )
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
        # the margin keeps points on the very edge inside on every machine
        return abs(_horner(P, z)) <= abs(_horner(Q, z)) * (1 + 1e-9)

    reach = _reach([P, Q])
    right = reach / 3 if len(Q) == 1 else reach
    picture = terminal_region(is_inside, -reach, right, reach, width=52, height=15)
    yield "    |R(z)| ≤ 1, roughly"
    yield from (f"    {line}" for line in picture.splitlines())


def _reach(polynomials: Sequence[Sequence[float]]) -> float:
    """A radius that holds all zeros and poles, by Fujiwara's bound, with some room."""
    reach = 2.0
    for p in polynomials:
        n = len(p) - 1
        sizes = [abs(p[n - k] / p[n]) ** (1 / k) for k in range(1, n + 1)]
        reach = max([reach, *sizes])
    return float(f"{1.6 * reach:.1g}")


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
    return (
        f"|R(iy)| > 1 where E(y²) < 0, E = {polynomial_text(found.e_polynomial, 'x')}"
    )


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
    polynomial = polynomial_text(Polynomial.from_flint(root.polynomial), variable)
    return f"= {root_decimal(root, digits)}…, a root of {polynomial}"


def _number(root: RealRoot, digits: int) -> str:
    simple = root_text(root)
    if simple is None:
        return root_decimal(root, digits)
    return (
        simple if root.exact is not None else f"{simple} = {root_decimal(root, digits)}"
    )


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
        polynomial = polynomial_text(Polynomial.from_flint(first.end.polynomial), "x")
        text += f", a root of {polynomial}"
    return text + (" and further intervals" if len(intervals) > 1 else "")


def _imaginary_text(intervals: Sequence[Interval], digits: int) -> str:
    first = intervals[0] if intervals else None
    if first is None or first.is_point or first.start is None or first.start.exact != 0:
        return "y = 0 only"
    if first.end is None:
        return "all y"
    text = f"|y| ≤ {square_root(first.end, digits)}, y² {_equation(first.end, 'x', digits)}"
    return text + (" and further intervals" if len(intervals) > 1 else "")


def _ssp_text(found: SspCoefficient | None, digits: int) -> str:
    if found is None:
        return "not decided: the nodes have no simple radicals"
    if found.value is None:
        return "∞"
    simple = root_text(found.value)
    return (
        _number(found.value, digits)
        if simple
        else _equation(found.value, "x", digits)[2:]
    )


def _oscillator_text(
    found: OscillatorStability, digits: int, paint: Paint
) -> Iterator[str]:
    yield f"  {paint('strong', 'oscillator')}, z = hω, x = z²"
    yield from _line("trace", _ratio(found.trace))
    yield from _line("determinant", _ratio(found.determinant))
    yield from _line(
        "4D² − N²", polynomial_text(integral([found.discriminant])[0], "x")
    )
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
    for number, interval in enumerate(intervals):
        text = _interval_text(interval, digits)
        yield from _line("stable" if number == 0 else "", text)


def _interval_text(interval: Interval, digits: int) -> str:
    assert interval.start is not None
    start = _number(interval.start, digits)
    if interval.is_point:
        return f"x = {start}"
    left = "≤" if interval.has_start else "<"
    if interval.end is None:
        text = f"{start} {left} x"
        ends: list[RealRoot] = [interval.start]
    else:
        right = "≤" if interval.has_end else "<"
        text = f"{start} {left} x {right} {_number(interval.end, digits)}"
        ends = [interval.start, interval.end]
    if interval.end is not None:
        text += f", z to {square_root(interval.end, digits)}"
    roots = [x for x in ends if root_text(x) is None]
    for x in roots:
        text += (
            f"; a root of {polynomial_text(Polynomial.from_flint(x.polynomial), 'x')}"
        )
    return text


def _why_not_p_stable(found: OscillatorStability, digits: int) -> str:
    if not found.stable or not found.stable[0].has_start or found.stable[0].is_point:
        return "unstable for small step sizes"
    end = found.stable[0].end
    assert end is not None
    beyond = "at" if not found.stable[0].has_end else "beyond"
    return f"not stable {beyond} x = {_number(end, digits)}"


def _phase_text(found: OscillatorStability) -> str:
    if found.phase.order is None:
        return "none: the frequency is exact"
    return f"order {found.phase.order}: {to_text(found.phase.constant)} z^{found.phase.order + 1}"


def _conserved_text(found: OscillatorStability) -> str:
    if not found.determinant.is_one:
        return "none: the determinant is not 1"
    form = found.conserved
    if form is None:
        return "every one: the step is a multiple of the identity"
    names = ("(ωq)²", "ωq p", "p²")
    parts = [
        f"({polynomial_text(p, 'z')}) {name}"
        if len(p.coefficients) > 1
        else (name if p == Polynomial([1]) else f"{polynomial_text(p, 'z')} {name}")
        for p, name in zip(integral(form), names, strict=True)
        if p
    ]
    return " + ".join(parts)


def _nonlinear_text(found: Stability, paint: Paint) -> Iterator[str]:
    yield f"  {paint('strong', 'nonlinear')}"
    if found.algebraic is None:
        yield from _line(
            "algebraically stable", "has no meaning: colours do not see one another"
        )
        return
    reasons = []
    if not found.algebraic.weights_are_positive:
        reasons.append("a weight is negative")
    if not found.algebraic.form_is_positive:
        reasons.append("B A + Aᵀ B − b bᵀ is not positive semidefinite")
    reason = f": {', '.join(reasons)}" if reasons else ""
    yield from _line(
        "algebraically stable", paint.verdict(found.algebraic.holds) + reason
    )


def _springs_text(found: TwoFrequencies, digits: int) -> Iterator[str]:
    yield ""
    yield f"  two springs, a = (hω_slow)² = {found.slow}, x = (hω_fast)²"
    yield from _line("trace", _ratio(found.trace))
    yield from _line("determinant", _ratio(found.determinant))
    for number, (factor, power) in enumerate(factors(found.discriminant)):
        text = polynomial_text(factor, "x") + (f", {power} times" if power > 1 else "")
        yield from _line("factors of 4D² − N²" if number == 0 else "", text)
    yield from _stable_text(found.stable, digits)
