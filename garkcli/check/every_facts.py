"""Facts about a family for all values of its parameters, and the exceptional values.

A question is answered once, with the parameters as unknowns. Where no polynomial vanishes that was
taken as nonzero on the way, the answer is the same; rational values there confirm it. With one
parameter, the finitely many other values are examined one by one.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence, Sized
from typing import Any, TypeAlias

from flint import fmpq_mpoly

from garkcli.check.every_family import EveryFamily, exact_value
from garkcli.errors import GarkError
from garkcli.exact.cells import Interval
from garkcli.exact.parametric import Parameters, factors
from garkcli.exact.polynomial import Polynomial
from garkcli.exact.polynomial_text import polynomial_text, root_decimal, root_text
from garkcli.exact.roots import RealRoot
from garkcli.frozen import Frozen, Mutable, replace
from garkcli.properties.verdict import Size, size_reason
from garkcli.reason import NO_REASON, Formula, Reason, Value, joined
from garkcli.tableau.family import ring_of
from garkcli.tableau.tableau import Tableau

Worded: TypeAlias = "Value | str"
MOST_SPECIAL = 60


MOST_ASKED = 60
"""The most answers to a question at zeros of polynomials."""


class FamilyFact(Frozen):
    """An answer for a family; ``special``, ``unknown`` and ``where`` are for a single parameter.

    Attributes:
        value: for all values except those below; None if the question does not apply.
        special: exceptional values with their answers.
        open: polynomials at whose zeros the answer may differ.
        zeros: polynomials at whose common zeros, real ones if there are any, and only there, an
            order is higher or a property holds.
        elsewhere: polynomials, with the answer at their zeros.
        unknown: undecided values.
        where: the intervals on which a property holds; otherwise None.
        is_undecided: whether no answer for almost all values is known.
        differs: whether two values with different answers are known.
        why: these two values, or why it is undecided.
    """

    value: Any
    special: tuple[tuple[RealRoot, Any], ...] = ()
    open: tuple[str, ...] = ()
    zeros: tuple[str, ...] = ()
    elsewhere: tuple[tuple[str, Any], ...] = ()
    unknown: tuple[RealRoot, ...] = ()
    where: tuple[Interval, ...] | None = None
    is_undecided: bool = False
    differs: bool = False
    why: Reason | str = ""

    @property
    def is_everywhere(self) -> bool:
        others = (*self.special, *self.elsewhere, *self.open, *self.zeros, *self.unknown)
        is_one = self.where is None and not self.is_undecided
        return is_one and not others

    def of(self, part: Callable[[Any], Any]) -> FamilyFact:
        def of(whole: Any) -> Any:
            return None if whole is None else part(whole)

        value = of(self.value)
        special = [(x, of(other)) for x, other in self.special]
        elsewhere = [(p, of(other)) for p, other in self.elsewhere]
        return replace(
            self,
            value=value,
            special=tuple(x for x in special if x[1] != value),
            elsewhere=tuple(x for x in elsewhere if x[1] != value),
        )


class Budget(Mutable):
    left: int


Question: TypeAlias = Callable[[Tableau], Any]
"""A question about a tableau with any coefficients."""
UNDECIDED = object()


def answer(ask: Question, tableau: Tableau) -> Any:
    try:
        return ask(tableau)
    except (GarkError, ZeroDivisionError):
        return None


def find(
    family: EveryFamily, ask: Question, is_of_stages: bool = False, budget: Budget | None = None
) -> FamilyFact:
    """Returns the answer to a question that only compares coefficients."""
    budget = budget or Budget(MOST_ASKED)
    budget.left -= 1
    try:
        if is_of_stages:
            value, told = _answer_in_points(family, ask)
        else:
            value, told = _answer_over(ask, family.tableau, family.ring)
    except TypeError:
        # numbers have signs, rational functions have none; stage algebras have no entries
        return by_samples(family, ask)
    known = factors(family.poles)
    critical = [
        p
        for p in factors(told)
        # what has roots of numbers alone is a number, and not zero
        if p not in known and not family.is_number(p) and family.can_vanish(p)
    ]
    _, sample = next(family.samples(critical), (None, None))
    if value is UNDECIDED or (sample is not None and answer(ask, sample) != value):
        return FamilyFact(None, is_undecided=True, why=NOT_DECIDED)
    if family.has_one:
        # the values at which a polynomial is zero, one by one
        special, unknown = [], []
        for number, root in enumerate(family.roots(critical)):
            exact = exact_value(root)
            there = UNDECIDED
            if exact is not None and number < MOST_SPECIAL:
                there = answer(ask, family.at(exact))
            if there is UNDECIDED:
                unknown.append(root)
            elif there != value:
                special.append((root, there))
        return FamilyFact(value, tuple(special), unknown=tuple(unknown))
    elsewhere, open_ = [], []
    for p in critical:
        # where it is zero, if that gives a parameter its value
        smaller = family.where_zero(p) if budget.left > 0 else None
        fact = None if smaller is None else find(smaller, ask, is_of_stages, budget)
        if fact is None or not fact.is_everywhere:
            open_.append(family.ring.text(p))
        elif fact.value != value:
            elsewhere.append((family.ring.text(p), fact.value))
    return FamilyFact(value, open=tuple(open_), elsewhere=tuple(elsewhere))


def _answer_over(ask: Question, tableau: Tableau, ring: Parameters) -> tuple[Any, list[fmpq_mpoly]]:
    with ring.telling_apart() as told:
        value = answer(ask, tableau)
    return value, list(told.values())


def _answer_in_points(family: EveryFamily, ask: Question) -> tuple[Any, list[fmpq_mpoly]]:
    """Returns the answer on point stages; TypeError without simple nodes or one parameter."""
    tableau = family.in_points
    if tableau is family.tableau:
        return _answer_over(ask, tableau, family.ring)
    if tableau is None or not family.has_one:
        raise TypeError
    ring = ring_of(tableau)
    value, told = _answer_over(ask, tableau, ring)
    return value, [family.norm(p, ring) for p in told]


NOT_DECIDED = "gark check --set judges single methods"


def by_samples(family: EveryFamily, ask: Question) -> FamilyFact:
    """Returns a fact that differs if two samples do, and is undecided otherwise."""
    first: tuple[Reason, Any] | None = None
    for values, method in family.samples():
        sample = answer(ask, method)
        if sample is UNDECIDED:
            continue
        at = joined(
            ", ", [Reason("{} = {}", Formula(x), Formula(str(y))) for x, y in values.items()]
        )
        if first is None:
            first = at, sample
        elif sample != first[1]:
            why = Reason("{} at {}, {} at {}", told(first[1]), first[0], told(sample), at)
            return FamilyFact(None, is_undecided=True, differs=True, why=why)
    return FamilyFact(None, is_undecided=True, why=NOT_DECIDED)


def told(value: object) -> Worded:
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, (Size, str)):
        return size_reason(str(value))
    return "no meaning" if value is None else str(value)


DIGITS = 12
MOST = 4
"""The most exceptional values and polynomials that are listed."""


def fact_reason(fact: FamilyFact, name: str, text: Callable[[object], Worded] = told) -> Reason:
    """Returns an answer with its exceptions; ``name`` is that of a single parameter."""
    if fact.where is not None:
        where = joined(" or ", [_interval(x, name) for x in fact.where])
        return Reason("{} for {} alone{}", text(True), where, _unknown(fact, name))
    if fact.differs:
        return Reason("not the same for every value: {}", fact.why)
    if fact.is_undecided:
        return Reason("not decided for every value: {}", fact.why)
    return Reason(
        "{}{}{}", _text(fact.value, text), exceptions(fact, name, text), _unknown(fact, name)
    )


def exceptions(fact: FamilyFact, name: str, text: Callable[[object], Worded] = told) -> Reason:
    groups: dict[str, tuple[object, list[RealRoot]]] = {}
    for root, value in fact.special:
        groups.setdefault(repr(value), (value, []))[1].append(root)
    parts = [
        Reason("; {} where {}", _text(value, text), values_reason(roots, name))
        for value, roots in groups.values()
    ]
    for polynomial, value in fact.elsewhere:
        parts.append(Reason("; {} where {}", _text(value, text), _zero(polynomial)))
    if fact.zeros:
        parts.append(
            Reason(
                "; {} where {}",
                (
                    text(not fact.value)
                    if isinstance(fact.value, bool)
                    else f"{fact.value + 1} or more"
                ),
                zeros_reason(fact.zeros),
            )
        )
    if fact.open:
        parts.append(Reason("; not decided where {}", _any_zero(fact.open)))
    return joined("", parts)


def _text(value: object, text: Callable[[object], Worded]) -> Worded:
    return "none" if value is None and text is not told else text(value)


def _unknown(fact: FamilyFact, name: str) -> Reason:
    if not fact.unknown:
        return NO_REASON
    return Reason("; not decided where {}", values_reason(fact.unknown, name))


def values_reason(roots: Sequence[RealRoot], name: str) -> Reason:
    groups: dict[str, list[RealRoot]] = {}
    for root in roots:
        groups.setdefault(str(root.polynomial), []).append(root)
    named = [_roots(same, name) for same in [*groups.values()][:MOST]]
    return Reason("{}{}", joined(" or ", named), _others(groups))


def _roots(same: Sequence[RealRoot], name: str) -> Reason:
    """Returns roots of a polynomial, with it unless they have a simple form."""
    first = same[0]
    values = Reason("{} = {}", Formula(name), joined(" or ", [_number(x) for x in same]))
    if first.exact is not None:
        return values
    polynomial = polynomial_text(Polynomial.from_flint(first.polynomial), name)
    return Reason("{}, {}", _zero(polynomial), values)


def _others(everything: Sized) -> str:
    more = len(everything) - MOST
    return f" and {more} more" if more > 0 else ""


def _zero(polynomial: str) -> Reason:
    return Reason("{} = 0", Formula(polynomial))


def zeros_reason(polynomials: Sequence[str]) -> Reason:
    return Reason("{}{}", joined(", ", [*map(_zero, polynomials[:MOST])]), _others(polynomials))


def _any_zero(polynomials: Sequence[str]) -> Reason:
    if len(polynomials) == 1:
        return zeros_reason(polynomials)
    shown = joined(", ", [*map(Formula, polynomials[:MOST])])
    return Reason("one of {}{} is 0", shown, _others(polynomials))


def _interval(interval: Interval, name: str) -> Reason:
    start, end = interval.start, interval.end
    if interval.is_point:
        assert start is not None
        return values_reason([start], name)
    reason = Reason("{}", Formula(name))
    if start is not None:
        reason = Reason(f"{{}} {'≤' if interval.has_start else '<'} {{}}", _number(start), reason)
    if end is not None:
        reason = Reason(f"{{}} {'≤' if interval.has_end else '<'} {{}}", reason, _number(end))
    return reason


def _number(root: RealRoot) -> Value:
    simple = root_text(root)
    return Reason(f"{root_decimal(root, DIGITS)}…") if simple is None else Formula(simple)
