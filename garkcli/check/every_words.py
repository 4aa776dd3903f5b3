"""What is true of a family in words: the answer, and for which values it is another."""

from __future__ import annotations

from collections.abc import Callable, Sequence, Sized

from garkcli.check.every_facts import Fact, told
from garkcli.exact.cells import Interval
from garkcli.exact.polynomial import Polynomial
from garkcli.exact.polynomial_text import polynomial_text, root_decimal, root_text
from garkcli.exact.roots import RealRoot

DIGITS = 12
"""Of values that have no simple radicals."""
MOST = 4
"""Most single values and polynomials that are named; the others are counted."""


def fact_text(fact: Fact, name: str, text: Callable[[object], str] = told) -> str:
    """An answer with its exceptions.

    Args:
        fact: the answer.
        name: of the one parameter, where there is one.
        text: a value in words.
    """
    if fact.where is not None:
        where = " or ".join(interval_text(x, name) for x in fact.where)
        return f"{text(True)} for {where} alone{_unknown(fact, name)}"
    if fact.differs:
        return f"not the same for every value: {fact.why}"
    if fact.is_undecided:
        return f"not decided for every value: {fact.why}"
    parts = [_text(fact.value, text)]
    for value, roots in _grouped(fact):
        parts.append(f"{_text(value, text)} where {values_text(roots, name)}")
    for polynomial, value in fact.elsewhere:
        parts.append(f"{_text(value, text)} where {polynomial} = 0")
    if fact.zeros:
        beyond = _beyond(fact, text)
        parts.append(f"{beyond} where {zeros_text(fact.zeros)}")
    if fact.open:
        parts.append(f"not decided where {any_zero_text(fact.open)}")
    return "; ".join(parts) + _unknown(fact, name)


def _text(value: object, text: Callable[[object], str]) -> str:
    return "none" if value is None else text(value)


def _beyond(fact: Fact, text: Callable[[object], str]) -> str:
    """What there is at the common zeros of polynomials."""
    if isinstance(fact.value, bool):
        return text(not fact.value)
    return f"{fact.value + 1} or more"


def _unknown(fact: Fact, name: str) -> str:
    if not fact.unknown:
        return ""
    return f"; not decided where {values_text(fact.unknown, name)}"


def _grouped(fact: Fact) -> list[tuple[object, list[RealRoot]]]:
    """Single values by the answer there."""
    groups: dict[str, tuple[object, list[RealRoot]]] = {}
    for root, value in fact.special:
        groups.setdefault(repr(value), (value, []))[1].append(root)
    return list(groups.values())


def values_text(roots: Sequence[RealRoot], name: str) -> str:
    """Some values of the parameter, those of one polynomial together."""
    groups: dict[str, list[RealRoot]] = {}
    for root in roots:
        groups.setdefault(str(root.polynomial), []).append(root)
    named = list(groups.values())[:MOST]
    texts = [_roots_text(same, name) for same in named]
    shown = " or ".join(texts)
    return shown + _others(groups)


def _roots_text(same: Sequence[RealRoot], name: str) -> str:
    """Some roots of one polynomial, which is told where they have no simple form."""
    first = same[0]
    numbers = " or ".join(map(_number, same))
    values = f"{name} = {numbers}"
    if first.exact is not None:
        return values
    return f"{_polynomial(first, name)} = 0, {values}"


def _others(everything: Sized) -> str:
    """How many there are beyond those that are named."""
    more = len(everything) - MOST
    return f" and {more} more" if more > 0 else ""


def zeros_text(polynomials: Sequence[str]) -> str:
    """That polynomials are zero, all of them."""
    equations = [f"{p} = 0" for p in polynomials[:MOST]]
    shown = ", ".join(equations)
    return shown + _others(polynomials)


def any_zero_text(polynomials: Sequence[str]) -> str:
    """That one of some polynomials is zero."""
    if len(polynomials) == 1:
        return zeros_text(polynomials)
    shown = ", ".join(polynomials[:MOST])
    return f"one of {shown}{_others(polynomials)} is 0"


def interval_text(interval: Interval, name: str) -> str:
    """The values of the parameter in an interval."""
    start, end = interval.start, interval.end
    if interval.is_point:
        assert start is not None
        return values_text([start], name)
    text = name
    if start is not None:
        sign = "≤" if interval.has_start else "<"
        text = f"{_number(start)} {sign} {text}"
    if end is not None:
        sign = "≤" if interval.has_end else "<"
        text = f"{text} {sign} {_number(end)}"
    return text


def _number(root: RealRoot) -> str:
    return root_text(root) or f"{root_decimal(root, DIGITS)}…"


def _polynomial(root: RealRoot, name: str) -> str:
    return polynomial_text(Polynomial.from_flint(root.polynomial), name)
