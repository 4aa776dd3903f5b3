"""``gark design --minimise`` for people."""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from textwrap import wrap

from garkcli.design.minimise.objective import Level
from garkcli.design.minimise.refining import DECIMALS
from garkcli.design.minimise.result import Candidate, Limit, Minimum
from garkcli.design.solutions import value_at
from garkcli.errors import counted
from garkcli.exact.polynomial import Polynomial
from garkcli.exact.polynomial_text import polynomial_text, root_decimal, root_text
from garkcli.exact.roots import RealRoot

INDENT = " " * 4
LONG = 40
"""Fractions of more characters are shown as decimals; JSON and files have them."""
SHOWN = 10
"""Most minimisers that are shown; JSON has all."""


def render(minimum: Minimum, digits: int, width: int) -> str:
    """The minimum as text, to stand below the design.

    Args:
        minimum: what was found.
        digits: of numbers without simple radicals.
        width: columns to fill.
    """
    lines = [""]
    order = minimum.step.order
    summary = minimum.objective.summary.format(next=order + 1)
    head = f"{minimum.objective.key}: {summary}"
    lines += wrap(head, width, initial_indent="  ", subsequent_indent=INDENT)
    lines += _lines(minimum, digits, width)
    return "\n".join(lines) + "\n"


def _lines(minimum: Minimum, digits: int, width: int) -> Iterator[str]:
    if minimum.value is None and not minimum.is_infinite:
        yield f"  no method of order {minimum.step.order} was found"
        return
    best, none = "least", "no minimum"
    if isinstance(minimum.objective, Level):
        best, none = "greatest", "no maximum"
    value = _value_text(minimum.value, digits)
    if not minimum.minimisers:
        if minimum.extent in {"critical-points", "found"}:
            none += " of what was found"
        yield f"  {none}: it comes near {value}"
        for limit in minimum.limits:
            yield f"{INDENT}as {_toward(limit, digits)}"
        return
    yield from wrap(
        f"{best} value {value}, {_among(minimum)}",
        width,
        initial_indent="  ",
        subsequent_indent=INDENT,
    )
    for candidate in minimum.minimisers[:SHOWN]:
        yield ""
        yield from _candidate(minimum, candidate, digits, width)
    more = len(minimum.minimisers) - SHOWN
    if more > 0:
        yield f"  and {counted(more, 'method')} more, see --format json"


def _among(minimum: Minimum) -> str:
    """What was compared."""
    order = minimum.step.order
    match minimum.extent:
        case "all":
            return f"of all methods of order {order}"
        case "nearly":
            return f"and no method of order {order} has one that is less by more than 1e-9 of it"
        case "critical-points":
            points = counted(minimum.candidates, "critical point")
            return (
                f"the least of {points}, which are all there are; whether it is less towards"
                " infinity or where denominators vanish is open"
            )
        case "found":
            return "the best of what was found"


def _candidate(minimum: Minimum, candidate: Candidate, digits: int, width: int) -> Iterator[str]:
    found = candidate.found
    root = found.solution.real[candidate.index]
    for name in minimum.design.family.parameters:
        value = value_at(found.solution.values[name], root)
        text = f"{name} = {_number_text(value, digits)}"
        yield from wrap(text, width, initial_indent=INDENT, subsequent_indent=INDENT + "  ")
    if candidate.proof == "exists":
        yield (f"{INDENT}within 1e-{DECIMALS} of a critical point that exists, by Krawczyk's test")
    if candidate.proof == "numerical":
        yield f"{INDENT}better than what was tried around it"
    if candidate.is_constant:
        yield f"{INDENT}and others: the value is the same at all methods near it"
    if found.order is not None:
        least = "at least " if found.order.is_lower_bound else ""
        order = f"{least}{found.order.order}"
        yield (f"{INDENT}order {order} of the {minimum.design.whose}, by a certificate of its own")


def _toward(limit: Limit, digits: int) -> str:
    toward = limit.toward
    end = "∞" if toward.is_right else "-∞"
    if toward.end is not None:
        end = _number_text(toward.end, digits)
    return f"{limit.parameter} → {end}"


def _value_text(value: RealRoot | None, digits: int) -> str:
    """Radicals where there are simple ones, and decimals."""
    if value is None:
        return "∞"
    decimals = root_decimal(value, digits)
    simple = root_text(value)
    if simple is None:
        return f"{decimals}…"
    if len(simple) > LONG:
        return f"{decimals}…"
    if simple == decimals:
        return simple
    is_whole = value.exact is not None and Fraction(decimals) == Fraction(simple)
    return f"{simple} = {decimals}" + ("" if is_whole else "…")


def _number_text(value: RealRoot, digits: int) -> str:
    """Radicals where there are simple ones; else decimals and the polynomial."""
    simple = root_text(value)
    decimals = root_decimal(value, digits)
    if value.exact is not None:
        text = str(simple)
        return text if len(text) <= LONG else f"{decimals}…"
    if simple is not None:
        return f"{simple} = {decimals}…"
    polynomial = polynomial_text(Polynomial.from_flint(value.polynomial), "x")
    return f"{decimals}…, a root of {polynomial}"
