"""``gark stability`` of methods of several colours: R(z1, z2, …), implicit-explicit pairs, SSP."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from garkcli.exact.multivariate import Multivariate
from garkcli.exact.polynomial_text import integral_scale, multivariate_text
from garkcli.page.exactly import multivariate_latex
from garkcli.page.paint import Paint
from garkcli.report.stability_region import damped_lines
from garkcli.report.stability_words import equation, line, over, ssp_text
from garkcli.stability.colours import Colours
from garkcli.stability.damping import ImexPair, Ray
from garkcli.stability.fraction import MOST_LINES, Fraction
from garkcli.stability.ssp import AdditiveRadius

LONGEST_FRACTION = 600
"""Signs of a fraction in the text for people; JSON and LaTeX have longer ones."""


def colours_text(found: Colours, digits: int, paint: Paint) -> Iterator[str]:
    """The paragraphs about all colours, each with a z of its own."""
    numbers = range(1, found.size + 1)
    names = [f"z{k}" for k in numbers]
    meanings = [f"z{k} = hλ{k}" for k in numbers]
    title = paint("strong", "every colour")
    meaning = ", ".join(meanings)
    yield f"  {title}, {meaning}"
    variables = ", ".join(names)
    fraction = _fraction_text(found, names)
    yield from line(f"R({variables})", fraction)
    yield from _radii_text(found.radii, digits)
    if found.pair is not None:
        yield ""
        yield from _pair_text(found.pair, found, digits, paint)


def _radii_text(radii: Sequence[AdditiveRadius], digits: int) -> Iterator[str]:
    """How far the region of absolute monotonicity reaches in each direction."""
    label = "additive SSP radii"
    if any(radius.radius is None for radius in radii):
        yield from line(label, ssp_text(None, digits))
        return
    for radius in radii:
        end = ssp_text(radius.radius, digits)
        direction = _direction_text(radius)
        yield from line(label, f"{direction}, r ≤ {end}")
        label = ""


def _fraction_text(found: Colours, names: list[str]) -> str:
    if found.R is None:
        return f"too large: {found.lines} lines determine it (limit {MOST_LINES})"
    P, Q = integral_parts(found.R)
    top = multivariate_text(P, names)
    bottom = multivariate_text(Q, names)
    text = over(top, bottom)
    if len(text) > LONGEST_FRACTION:
        terms = f"{len(P.terms)} terms over {len(Q.terms)}"
        text = f"{terms}, written out by --format json and latex"
    if not found.R.is_reduced:
        text += "; perhaps not in lowest terms"
    return text


def integral_parts(R: Fraction) -> tuple[Multivariate, Multivariate]:
    """Numerator and denominator with integers as coefficients, where they are rational."""
    P = R.numerator
    Q = R.denominator
    terms = (*P.terms, *Q.terms)
    coefficients = [coefficient for _, coefficient in terms]
    scale = integral_scale(coefficients)
    unit = (0,) * P.variables
    constant = Multivariate.of(P.variables, {unit: scale})
    return P * constant, Q * constant


def _direction_text(found: AdditiveRadius) -> str:
    """``(r, 0)``, ``(r, 2r)``: the point of the region that is meant."""
    parts = []
    for ratio in found.ratios:
        part = f"{ratio} r"
        if ratio == 0:
            part = "0"
        elif ratio == 1:
            part = "r"
        parts.append(part)
    point = ", ".join(parts)
    return f"({point})"


def _pair_text(pair: ImexPair, found: Colours, digits: int, paint: Paint) -> Iterator[str]:
    e = f"z{pair.explicit + 1}"
    i = f"z{pair.implicit + 1}"
    title = paint("strong", "implicit-explicit pair")
    yield f"  {title}: {e} with |R| ≤ 1 for every {i}, Re {i} ≤ 0"
    real = _ray_text(found.real, f"−{e}", digits)
    yield from line("real axis", real)
    imaginary = _ray_text(found.imaginary, f"|{e}|", digits)
    yield from line("imaginary axis", imaginary)
    yield ""
    yield from damped_lines(pair, found.explicit_alone)


def _ray_text(ray: Ray | None, what: str, digits: int) -> str:
    if ray is None:
        return "not decided"
    if ray.end is None:
        return "no limit"
    if ray.end.exact == 0:
        return "none"
    end = equation(ray.end, "x", digits).removeprefix("= ")
    return f"{what} ≤ {end}"


def fraction_latex(found: Colours) -> str | None:
    """R as a line of an ``align*``; None where it is too large."""
    if found.R is None:
        return None
    numbers = range(1, found.size + 1)
    names = [f"z_{{{k}}}" for k in numbers]
    P, Q = integral_parts(found.R)
    top = multivariate_latex(P, names)
    bottom = multivariate_latex(Q, names)
    fraction = top
    if bottom != "1":
        fraction = rf"\frac{{{top}}}{{{bottom}}}"
    variables = ", ".join(names)
    return f"  R({variables}) &= {fraction}"
