"""Stability on linear, oscillating and contractive problems, decided exactly."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from markupsafe import Markup

from garkcli.api.calls import find_stability
from garkcli.page.paint import Paint
from garkcli.report.stability import quotient_latex
from garkcli.report.stability_colours import fraction_latex
from garkcli.report.stability_text import Fact, linear_facts, nonlinear_fact, oscillator_facts
from garkcli.report.stability_words import decided
from garkcli.stability.oscillator import OscillatorStability
from garkcli.stability.summary import LinearStability, Stability
from garkcli.webpage.mathml import typeset
from garkcli.webpage.reported import Reported
from garkcli.webpage.section import Content, Section

_DIGITS = 12
"""Of numbers that have no simple radicals, as in ``gark stability``."""
_LONGEST = 400
"""Signs of a formula in LaTeX; longer ones are left to ``gark stability``."""
_PLAIN = Paint(False)


@dataclass(frozen=True)
class Part:
    """What a kind of problems tells.

    Attributes:
        title: the kind.
        formulas: what decides it, typeset.
        facts: labels with texts.
    """

    title: str
    formulas: tuple[Markup, ...]
    facts: tuple[Fact, ...]


def _content(method: Reported) -> Content | None:
    file = method.outcome.file
    if method.free is not None:
        return {"free": method.free, "file": file}
    if method.method is None:
        return None
    if method.is_slow:
        return {"parts": [], "near": "", "file": file}
    found = find_stability(method.method)
    parts = list(_parts(found))
    near = method.data["tolerance"] or ""
    return {"parts": parts, "near": near, "file": file}


def _parts(found: Stability) -> Iterator[Part]:
    """The linear test equation, the oscillator, contractive problems."""
    for number, linear in enumerate(found.linear):
        yield _linear(linear, number, found)
    if found.oscillator is not None:
        yield _oscillator(found.oscillator)
    if found.tolerance is None:
        yield Part("Nonlinear", (), (nonlinear_fact(found, _PLAIN),))
    elif found.linear:
        verdict = decided(found.algebraic_within, _PLAIN)
        yield Part("Nonlinear", (), (("algebraically stable", verdict),))


def _linear(one: LinearStability, number: int, found: Stability) -> Part:
    """The stability function: of all colours, the first, or of one with the others at 0."""
    title = "Linear test equation"
    if number:
        title += f", colour {one.name} alone"
    elif len(found.linear) > 1:
        title += ", all colours alike"
    formulas = []
    if found.colours is not None and not number:
        formulas.append(fraction_latex(found.colours) or "")
    if one.within is None:
        R = one.R
        quotient = quotient_latex(R.numerator, R.denominator, "z")
        formulas.append(f"R(z) = {quotient}")
    facts = linear_facts(one, _DIGITS, _PLAIN)
    return Part(title, _typeset(formulas), tuple(facts))


def _oscillator(found: OscillatorStability) -> Part:
    """The step matrix M on the harmonic oscillator."""
    trace, area = found.trace, found.determinant
    over = quotient_latex(trace.numerator, trace.denominator, "x")
    det = quotient_latex(area.numerator, area.denominator, "x")
    formulas = [rf"\operatorname{{tr}} M = {over}", rf"\det M = {det}"]
    facts = oscillator_facts(found, _DIGITS, _PLAIN)
    title = "Oscillator, z = hω, x = z²"
    return Part(title, _typeset(formulas), tuple(facts))


def _typeset(formulas: list[str]) -> tuple[Markup, ...]:
    """Those that are there and fit."""
    shown = [x.replace("&", "").strip() for x in formulas]
    return tuple(typeset(x) for x in shown if x and len(x) <= _LONGEST)


SECTION = Section("stability", "Stability", _content)
