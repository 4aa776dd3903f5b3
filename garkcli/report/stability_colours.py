"""``gark stability`` of methods of several colours: R(z1, z2, …), implicit-explicit pairs, SSP."""

from __future__ import annotations

from collections.abc import Iterator

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
    names = [f"z{k + 1}" for k in range(found.size)]
    meanings = ", ".join(f"{z} = hλ{k + 1}" for k, z in enumerate(names))
    yield f"  {paint('strong', 'every colour')}, {meanings}"
    yield from line(f"R({', '.join(names)})", _fraction_text(found, names))
    label = "additive SSP radii"
    if any(radius.radius is None for radius in found.radii):
        yield from line(label, ssp_text(None, digits))
    else:
        for radius in found.radii:
            end = ssp_text(radius.radius, digits)
            yield from line(label, f"{_direction_text(radius)}, r ≤ {end}")
            label = ""
    if found.pair is not None:
        yield ""
        yield from _pair_text(found.pair, found, digits, paint)


def _fraction_text(found: Colours, names: list[str]) -> str:
    if found.R is None:
        return f"too large: {found.lines} lines determine it (limit {MOST_LINES})"
    P, Q = integral_parts(found.R)
    text = over(multivariate_text(P, names), multivariate_text(Q, names))
    if len(text) > LONGEST_FRACTION:
        terms = f"{len(P.terms)} terms over {len(Q.terms)}"
        text = f"{terms}, written out by --format json and latex"
    if not found.R.is_reduced:
        text += "; perhaps not in lowest terms"
    return text


def integral_parts(R: Fraction) -> tuple[Multivariate, Multivariate]:
    """Numerator and denominator with integers as coefficients, where they are rational."""
    P, Q = R.numerator, R.denominator
    scale = integral_scale(a for p in (P, Q) for _, a in p.terms)
    constant = Multivariate.of(P.variables, {(0,) * P.variables: scale})
    return P * constant, Q * constant


def _direction_text(found: AdditiveRadius) -> str:
    """``(r, 0)``, ``(r, 2r)``: the point of the region that is meant."""
    parts = []
    for ratio in found.ratios:
        factor = "" if ratio == 1 else f"{ratio} "
        parts.append(f"{factor}r" if ratio else "0")
    return f"({', '.join(parts)})"


def _pair_text(
    pair: ImexPair, found: Colours, digits: int, paint: Paint
) -> Iterator[str]:
    e, i = f"z{pair.explicit + 1}", f"z{pair.implicit + 1}"
    title = paint("strong", "implicit-explicit pair")
    yield f"  {title}: {e} with |R| ≤ 1 for every {i}, Re {i} ≤ 0"
    yield from line("real axis", _ray_text(found.real, f"−{e}", digits))
    yield from line("imaginary axis", _ray_text(found.imaginary, f"|{e}|", digits))
    yield ""
    yield from damped_lines(pair, found.explicit_alone)


def _ray_text(ray: Ray | None, what: str, digits: int) -> str:
    if ray is None:
        return "not decided"
    if ray.end is None:
        return "no limit"
    if ray.end.exact == 0:
        return "none"
    return f"{what} ≤ {equation(ray.end, 'x', digits).removeprefix('= ')}"


def fraction_latex(found: Colours) -> str | None:
    """R as a line of an ``align*``; None where it is too large."""
    if found.R is None:
        return None
    names = [f"z_{{{k + 1}}}" for k in range(found.size)]
    P, Q = integral_parts(found.R)
    top, bottom = multivariate_latex(P, names), multivariate_latex(Q, names)
    fraction = top if bottom == "1" else rf"\frac{{{top}}}{{{bottom}}}"
    return f"  R({', '.join(names)}) &= {fraction}"
