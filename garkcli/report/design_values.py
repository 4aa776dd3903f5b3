"""Restrictions on values of parameters: polynomials that are zero, and inequalities."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from typing import Any, TypeAlias

from flint import fmpq, fmpq_mpoly, fmpz_mpoly

from garkcli.design.ideal import integral_scale
from garkcli.design.member import admitted
from garkcli.exact.cells import has, roots_of
from garkcli.exact.parametric import factors
from garkcli.exact.polynomial import in_one
from garkcli.exact.polynomial_text import root_text
from garkcli.reason import Reason
from garkcli.tableau.family import Family, Radical
from garkcli.tell.dialect import Plain
from garkcli.tell.kinds import EXPRESSION

AnyPolynomial: TypeAlias = "fmpq_mpoly | fmpz_mpoly"
_NAME = re.compile(r"[A-Za-z_]\w*")


def zeros(family: Family, polynomials: Sequence[AnyPolynomial]) -> list[str]:
    known = [_terms(x.relation) for x in family.radicals]
    return [_text(family, p) for p in polynomials if _terms(p) not in known]


def equation(family: Family, p: Any) -> str:
    """Solved for the first unknown if that is alone."""
    exponents = [int(k) for k in p.monoms()[0]]
    if sum(exponents) > 1:
        return f"{_text(family, p)} = 0"
    first = p.context().gens()[exponents.index(1)]
    return f"{first} = {_written(family, first - p / p.leading_coefficient())}"


def conditions(family: Family, nonzero: Iterable[fmpq_mpoly]) -> list[Reason]:
    """Restrictions of the file, and that no polynomial of ``nonzero`` vanishes."""

    def holds(p: fmpq_mpoly, relation: str) -> Reason:
        return Reason(f"{{}} {relation} 0", EXPRESSION(_text(family, p)))

    numbers: set[str] = set()
    for radical in family.radicals:
        if _is_number(family, radical, numbers):
            numbers.add(radical.name)
    names = family.ring.names
    named = {*family.parameters, *(x.name for x in family.radicals if x.name not in numbers)}
    given = [p for p in factors(nonzero) if not named.isdisjoint(_names(names, p))]
    found = [holds(p, "≠") for p in given if _may_vanish(family, p)]
    ends, others = _bounds(family)
    for name, bounds in ends.items():
        least, greatest = (EXPRESSION(x) if x else None for x in bounds)
        if least is None or greatest is None:
            parts = [x for x in (least, EXPRESSION(name), greatest) if x is not None]
            found.append(Reason("{} ≤ {}", *parts))
        else:
            found.append(Reason("{} ≤ {} ≤ {}", least, EXPRESSION(name), greatest))
    roots = [x for x in family.radicals if x.is_even and x.name not in numbers]
    found += [Reason("{} is real", EXPRESSION(x.text)) for x in roots]
    for relation, polynomials in ((">", family.positive), ("≥", others)):
        found += [holds(p, relation) for p in polynomials if not p.is_constant()]
    return list(dict.fromkeys(found))


def _names(names: Sequence[str], p: fmpq_mpoly) -> list[str]:
    return [name for name, degree in zip(names, p.degrees(), strict=True) if degree]


def where(texts: Sequence[Reason], d: Plain) -> str:
    """`` where a ≠ 0 and b > 0``; empty without conditions."""
    if not texts:
        return ""
    *others, last = map(d.reason, texts)
    return f" where {', '.join(others)} and {last}" if others else f" where {last}"


LONG = 40
"""A polynomial stands for an end with more signs."""


def _bounds(family: Family) -> tuple[dict[str, list[str]], list[fmpq_mpoly]]:
    """Bounds of unknowns, by ranges and by numbers that may not be negative; the other numbers."""
    ends = {}
    others = list(family.not_negative)
    for name, rational in family.ranges.items():
        found = admitted(family, name)
        whole = [x for interval in found for x in (interval.start, interval.end)]
        texts = ["" if x is None else root_text(x) or " " * LONG for x in whole]
        if len(found) == 1 and max(map(len, texts)) < LONG:
            others = [p for p in others if _names(family.ring.names, p) != [name]]
        else:
            texts = ["" if x is None else str(x) for x in rational]
        if any(texts):
            ends[name] = texts
    return ends, others


def _terms(p: AnyPolynomial) -> dict[tuple[int, ...], fmpq]:
    terms = {tuple(map(int, e)): fmpq(a) for e, a in p.to_dict().items()}
    highest = terms[max(terms)]
    return {e: a / highest for e, a in terms.items()}


def _text(family: Family, p: AnyPolynomial) -> str:
    """The polynomial times a positive number, with whole coefficients."""
    if isinstance(p, fmpq_mpoly):
        p = p * integral_scale(p)
    return _written(family, p)


def _written(family: Family, p: AnyPolynomial) -> str:
    written = {name: text for name, (text, _) in family.ring.shown.items()}
    written |= {x.name: x.text for x in family.radicals}
    return _NAME.sub(lambda found: written.get(found[0], found[0]), str(p))


def _may_vanish(family: Family, p: fmpq_mpoly) -> bool:
    """Whether a polynomial may be zero; of one parameter whether it is in its range."""
    used = [k for k, degree in enumerate(p.degrees()) if degree]
    if len(used) > 1:
        return True
    [index] = used
    inside = admitted(family, family.ring.names[index])
    return any(has(inside, root) for root in roots_of([in_one(p, index)]))


def _is_number(family: Family, radical: Radical, numbers: set[str]) -> bool:
    """Whether no parameter is under a root, given which of the roots inside are numbers."""
    degrees = zip(family.ring.names, radical.relation.degrees(), strict=True)
    return all(name in {radical.name, *numbers} for name, degree in degrees if degree)
