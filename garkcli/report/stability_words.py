"""The words of ``gark stability`` for numbers, intervals and fractions."""

from __future__ import annotations

import re
from collections.abc import Sequence
from textwrap import wrap

from flint import arb

from garkcli.exact.cells import Interval
from garkcli.exact.field import Algebraic
from garkcli.exact.nodes import AlgebraicRoot, Expression
from garkcli.exact.polynomial import Polynomial
from garkcli.exact.polynomial_text import integral, polynomial_text, root_decimal, root_text
from garkcli.exact.rewriting import format_expression
from garkcli.exact.roots import RealRoot
from garkcli.page.paint import Paint, indented
from garkcli.report.stability_data import square_root
from garkcli.stability.bounds import Bounds
from garkcli.stability.ssp import SspCoefficient
from garkcli.tableau.tableau import Tableau

LABEL = 22
"""Columns of a label."""
LONGEST_POLYNOMIAL = 320
"""Signs of a polynomial in the text for people."""
WIDTH = 80
"""Columns of a terminal."""


_ROOT_OF = re.compile(r"root_of\([^,()]*, ([-+0-9.e]+)\)")
"""A root of a polynomial, as exact numbers are written."""


def short_roots(text: str) -> str:
    """A text with r(0.4358) in place of root_of(6*x**3-18*x**2+9*x-1, 0.4358).

    >>> short_roots("1 + 3*root_of(x**3-2, 1.259921050)**2")
    '1 + 3*r(1.259921050)**2'
    """
    return _ROOT_OF.sub(r"r(\1)", text)


def root_meanings(tableau: Tableau) -> list[str]:
    """What the short forms of roots stand for, a line each."""
    meanings = []
    for radical in _radicals(tableau):
        text = format_expression(radical)
        if isinstance(radical, AlgebraicRoot):
            meanings.append(f"  {short_roots(text)} = {text}")
    return meanings


def _radicals(tableau: Tableau) -> list[Expression]:
    """What generates the field of the coefficients."""
    rows = [row for block in tableau.blocks.values() for row in block]
    rows += [colour.b for colour in tableau.colours]
    for row in rows:
        for x in row:
            if isinstance(x, Algebraic):
                return [radical for radical, _ in x.field.radicals]
    return []


def line(label: str, text: str) -> list[str]:
    """A label and its text, which goes on in the same column."""
    text = short_roots(text)
    width = WIDTH - LABEL - 4
    pieces = wrap(text, width, break_long_words=False, break_on_hyphens=False)
    first, *others = pieces or [""]
    margin = " " * (LABEL + 4)
    head = f"    {label}".ljust(len(margin)) + first
    return [head.rstrip(), *indented(others, margin)]


def quotient(numerator: Polynomial, denominator: Polynomial, variable: str) -> str:
    """A fraction of two polynomials."""
    p, q = integral([numerator, denominator])
    top = polynomial_text(p, variable)
    bottom = polynomial_text(q, variable)
    return over(top, bottom)


def over(numerator: str, denominator: str) -> str:
    """A fraction of two texts."""
    if denominator == "1":
        return numerator
    bottom = f"({denominator})" if " " in denominator else denominator
    return f"({numerator}) / {bottom}"


def equation(root: RealRoot, variable: str, digits: int) -> str:
    """How a number is told: ``= 1/2``, ``= sqrt(2)/2``, or the polynomial it is a root of."""
    simple = root_text(root)
    if simple is not None:
        return f"= {simple}"
    polynomial = minimal_text(root, variable)
    decimals = root_decimal(root, digits)
    return f"= {decimals}…, a root of {polynomial}"


def minimal_text(root: RealRoot, variable: str) -> str:
    """The polynomial that a number is told by."""
    polynomial = Polynomial.from_flint(root.polynomial)
    text = polynomial_text(polynomial, variable)
    if len(text) > LONGEST_POLYNOMIAL:
        return f"a polynomial of degree {polynomial.degree}, in --format json"
    return text


def number(root: RealRoot, digits: int) -> str:
    """A root as a fraction, or in radicals and decimals."""
    simple = root_text(root)
    if simple is not None and root.exact is not None:
        return simple
    decimals = root_decimal(root, digits)
    if simple is None:
        return decimals
    return f"{simple} = {decimals}"


def real_text(intervals: Sequence[Interval], digits: int) -> str:
    """The interval of the negative real axis that begins at 0."""
    first = intervals[0] if intervals else None
    if first is None or first.start is None or first.start.exact != 0:
        return "z = 0 only"
    if first.end is None:
        return "z ≤ 0"
    if first.is_point:
        return "z = 0 only"
    end = number(first.end, digits)
    text = f"−z ≤ {end}"
    if root_text(first.end) is None:
        polynomial = minimal_text(first.end, "x")
        text += f", a root of {polynomial}"
    return text + _further(intervals)


def imaginary_text(intervals: Sequence[Interval], digits: int) -> str:
    """The interval of the imaginary axis around 0, from intervals of y²."""
    first = intervals[0] if intervals else None
    if first is None or first.is_point or first.start is None or first.start.exact != 0:
        return "y = 0 only"
    if first.end is None:
        return "all y"
    end = square_root(first.end, digits)
    square = equation(first.end, "x", digits)
    text = f"|y| ≤ {end}, y² {square}"
    return text + _further(intervals)


def _further(intervals: Sequence[Interval]) -> str:
    return " and further intervals" if len(intervals) > 1 else ""


def ssp_text(found: SspCoefficient | None, digits: int) -> str:
    """A radius of absolute monotonicity."""
    if found is None:
        return "not decided: the nodes have no simple radicals"
    if found.value is None:
        return "∞"
    if root_text(found.value):
        return number(found.value, digits)
    return equation(found.value, "x", digits).removeprefix("= ")


def interval_text(interval: Interval, digits: int) -> str:
    """An interval of x = z²."""
    assert interval.start is not None
    start = number(interval.start, digits)
    if interval.is_point:
        return f"x = {start}"
    left = "≤" if interval.has_start else "<"
    text = f"{start} {left} x"
    ends = [interval.start]
    if interval.end is not None:
        right = "≤" if interval.has_end else "<"
        end = number(interval.end, digits)
        end_of_z = square_root(interval.end, digits)
        text += f" {right} {end}, z to {end_of_z}"
        ends.append(interval.end)
    for x in ends:
        if root_text(x) is None:
            polynomial = minimal_text(x, "x")
            text += f"; a root of {polynomial}"
    return text


def decided(holds: bool | None, paint: Paint) -> str:
    """A verdict, or that there is none."""
    if holds is None:
        return "not decided"
    return paint.verdict(holds)


def bounds_text(found: Bounds, digits: int, before: str = "") -> str:
    """A number that is known between bounds: the digits that are certain."""
    low, high = found.low, found.high
    if low is None:
        return "no limit"
    if high is None:
        text = "not decided"
        if low > 0:
            least = _digits(arb(low), digits)
            text += f" beyond {before}{least}"
        return text
    if low == high:
        return f"{before}{low}"
    middle = (low + high) / 2
    radius = (high - low) / 2
    known = _digits(arb(middle, radius), digits)
    return f"{before}{known}"


def _digits(ball: arb, digits: int) -> str:
    """Zeros at the end are kept: they say how much is known."""
    return str(ball.str(digits, radius=False))
