"""What is true of a family for every value of its parameters, and of which values it is not.

A question about coefficients that are rational functions is answered once, with the parameters as
unknowns; the polynomials that counted as different from zero on the way are kept. Wherever
none of them is zero the answer is the same. The answer that counts is the ordinary one for some
rational values there. With one parameter the finitely many others are examined one by one.
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
from garkcli.properties.property import Size, size_reason
from garkcli.reason import NO_REASON, Formula, Reason, Value, joined
from garkcli.tableau.family import ring_of
from garkcli.tableau.tableau import Tableau

Worded: TypeAlias = "Value | str"
"""What a reason has in it."""
MOST_SPECIAL = 60
"""Most single values that are examined."""


MOST_ASKED = 60
"""How often a question is asked where polynomials are zero."""


class Fact(Frozen):
    """An answer for a family.

    Attributes:
        value: for every value of the parameters but those below; None where there is none.
        special: single values of the one parameter, each with the answer there.
        open: several parameters: polynomials; where one is zero the answer may be another.
        zeros: several parameters: polynomials at whose common zeros, real ones if there are any,
            and only there, an order is higher, or what is else not true is.
        elsewhere: several parameters: polynomials, each with the answer wherever it is zero.
        unknown: single values of the one parameter that are not decided.
        where: of what is true on whole intervals of the one parameter, these; else None.
        is_undecided: whether no answer is known that holds but for these.
        differs: whether two values are known for which it is not the same.
        why: these two, or what is in the way of knowing it.
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
        """Whether the answer is the same for every value."""
        others = (*self.special, *self.elsewhere, *self.open, *self.zeros, *self.unknown)
        is_one = self.where is None and not self.is_undecided
        return is_one and not others

    def of(self, part: Callable[[Any], Any]) -> Fact:
        """The same of a part of the answer."""

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
    """How often a question may still be asked."""

    left: int


Question: TypeAlias = Callable[[Tableau], Any]
"""Something to be asked of a tableau, whatever its coefficients are; answers are compared."""
UNDECIDED = object()
"""The answer of a question that is not decided for a tableau."""


def answer(ask: Question, tableau: Tableau) -> Any:
    """The answer to a question; None where it has no meaning."""
    try:
        return ask(tableau)
    except (GarkError, ZeroDivisionError):
        return None


def find(
    family: EveryFamily, ask: Question, is_of_stages: bool = False, budget: Budget | None = None
) -> Fact:
    """The answer to a question that only compares coefficients with each other.

    Args:
        family: of methods.
        ask: the question.
        is_of_stages: whether it is about entries, stage by stage.
        budget: how often it may be asked; None for the usual.
    """
    budget = budget or Budget(MOST_ASKED)
    budget.left -= 1
    try:
        if is_of_stages:
            value, told = _asked_in_points(family, ask)
        else:
            value, told = _asked(ask, family.tableau, family.ring)
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
        return Fact(None, is_undecided=True, why=NOT_DECIDED)
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
        return Fact(value, tuple(special), unknown=tuple(unknown))
    elsewhere, open_ = [], []
    for p in critical:
        # where it is zero, if that gives a parameter its value
        smaller = family.where_zero(p) if budget.left > 0 else None
        fact = None if smaller is None else find(smaller, ask, is_of_stages, budget)
        if fact is None or not fact.is_everywhere:
            open_.append(family.ring.text(p))
        elif fact.value != value:
            elsewhere.append((family.ring.text(p), fact.value))
    return Fact(value, open=tuple(open_), elsewhere=tuple(elsewhere))


def _asked(ask: Question, tableau: Tableau, ring: Parameters) -> tuple[Any, list[fmpq_mpoly]]:
    """The answer with the parameters as unknowns, and what counted as different from zero."""
    with ring.telling_apart() as told:
        value = answer(ask, tableau)
    return value, list(told.values())


def _asked_in_points(family: EveryFamily, ask: Question) -> tuple[Any, list[fmpq_mpoly]]:
    """The same with a coordinate for each stage.

    Raises:
        TypeError: there are no simple nodes, or several parameters beside them.
    """
    tableau = family.in_points
    if tableau is family.tableau:
        return _asked(ask, tableau, family.ring)
    if tableau is None or not family.has_one:
        raise TypeError
    ring = ring_of(tableau)
    value, told = _asked(ask, tableau, ring)
    return value, [family.norm(p, ring) for p in told]


NOT_DECIDED = "gark check --set judges single methods"


def by_samples(family: EveryFamily, ask: Question) -> Fact:
    """That the answers differ is known from two of them; that they do not is not."""
    first: tuple[Reason, Any] | None = None
    for values, method in family.samples():
        found = answer(ask, method)
        if found is UNDECIDED:
            continue
        at = joined(
            ", ", [Reason("{} = {}", Formula(x), Formula(str(y))) for x, y in values.items()]
        )
        if first is None:
            first = at, found
        elif found != first[1]:
            why = Reason("{} at {}, {} at {}", told(first[1]), first[0], told(found), at)
            return Fact(None, is_undecided=True, differs=True, why=why)
    return Fact(None, is_undecided=True, why=NOT_DECIDED)


def told(value: object) -> Worded:
    """An answer in a word, or the number."""
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, (Size, str)):
        return size_reason(str(value))
    return "no meaning" if value is None else str(value)


DIGITS = 12
"""Of values that have no simple radicals."""
MOST = 4
"""Most single values and polynomials that are named; the others are counted."""


def fact_reason(fact: Fact, name: str, text: Callable[[object], Worded] = told) -> Reason:
    """An answer with its exceptions.

    Args:
        fact: the answer.
        name: of the one parameter, where there is one.
        text: a value in words.
    """
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


def exceptions(fact: Fact, name: str, text: Callable[[object], Worded] = told) -> Reason:
    """Where the answer is another one, each after a semicolon."""
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


def _unknown(fact: Fact, name: str) -> Reason:
    if not fact.unknown:
        return NO_REASON
    return Reason("; not decided where {}", values_reason(fact.unknown, name))


def values_reason(roots: Sequence[RealRoot], name: str) -> Reason:
    """Some values of the parameter, those of one polynomial together."""
    groups: dict[str, list[RealRoot]] = {}
    for root in roots:
        groups.setdefault(str(root.polynomial), []).append(root)
    named = [_roots(same, name) for same in [*groups.values()][:MOST]]
    return Reason("{}{}", joined(" or ", named), _others(groups))


def _roots(same: Sequence[RealRoot], name: str) -> Reason:
    """Some roots of one polynomial, which is reported where they have no simple form."""
    first = same[0]
    values = Reason("{} = {}", Formula(name), joined(" or ", [_number(x) for x in same]))
    if first.exact is not None:
        return values
    polynomial = polynomial_text(Polynomial.from_flint(first.polynomial), name)
    return Reason("{}, {}", _zero(polynomial), values)


def _others(everything: Sized) -> str:
    """How many there are beyond those that are named."""
    more = len(everything) - MOST
    return f" and {more} more" if more > 0 else ""


def _zero(polynomial: str) -> Reason:
    return Reason("{} = 0", Formula(polynomial))


def zeros_reason(polynomials: Sequence[str]) -> Reason:
    """That polynomials are zero, all of them."""
    return Reason("{}{}", joined(", ", [*map(_zero, polynomials[:MOST])]), _others(polynomials))


def _any_zero(polynomials: Sequence[str]) -> Reason:
    """That one of some polynomials is zero."""
    if len(polynomials) == 1:
        return zeros_reason(polynomials)
    shown = joined(", ", [*map(Formula, polynomials[:MOST])])
    return Reason("one of {}{} is 0", shown, _others(polynomials))


def _interval(interval: Interval, name: str) -> Reason:
    """The values of the parameter in an interval."""
    start, end = interval.start, interval.end
    if interval.is_point:
        assert start is not None
        return values_reason([start], name)
    found = Reason("{}", Formula(name))
    if start is not None:
        found = Reason(f"{{}} {'≤' if interval.has_start else '<'} {{}}", _number(start), found)
    if end is not None:
        found = Reason(f"{{}} {'≤' if interval.has_end else '<'} {{}}", found, _number(end))
    return found


def _number(root: RealRoot) -> Value:
    simple = root_text(root)
    return Reason(f"{root_decimal(root, DIGITS)}…") if simple is None else Formula(simple)
