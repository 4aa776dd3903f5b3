"""Properties of a family, for all values of its parameters or for a set of values. Most only ask
which coefficients are zero or equal. Those with inequalities are decided for one parameter, between
the zeros of the polynomials whose signs matter; A-, L- and P-stability by ``design.stable_set``.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from itertools import chain, pairwise
from typing import Any

from garkcli.check.every_facts import UNDECIDED, FamilyFact, Question, answer, by_samples, find
from garkcli.check.every_family import EveryFamily, exact_value
from garkcli.design.stable_set import stable_set
from garkcli.design.stable_values import Wanted
from garkcli.errors import GarkError
from garkcli.exact.cells import Interval, Point, roots_of, where
from garkcli.exact.field import ONE, Number
from garkcli.exact.matrix import characteristic_coefficients, identity
from garkcli.exact.parametric import Parametric, fraction
from garkcli.exact.polynomial import Polynomial, in_one
from garkcli.exact.roots import RealRoot
from garkcli.order.simplifying import Simplifying, simplifying
from garkcli.properties.subject import Property, Subject
from garkcli.properties.subject import find as find_by_key
from garkcli.stability.algebraic import contractivity
from garkcli.tableau.tableau import Tableau

STABLE: dict[str, Wanted] = {
    "a-stable": "a-stable",
    "l-stable": "l-stable",
    "p-stable": "p-stable",
    "i-stable": "i-stable",
}
"""The properties decided by a decomposition of the plane."""


_NOTHING = Simplifying((), (), ())


class OrMore(int):
    def __str__(self) -> str:
        return f"at least {int(self)}"


def is_comparing(prop: Property) -> bool:
    """Whether a property asks only which coefficients are zero or equal."""
    return prop.asks != "signs" and prop.kind != "number"


def find_property(family: EveryFamily, key: str, limit: int) -> FamilyFact:
    def ask(tableau: Tableau) -> Any:
        # the order is requested with rounded coefficients only, B and C for one property
        known = simplifying(tableau, limit, "BC") if key == "stage-order" else _NOTHING
        verdict = Subject(tableau, 1, known, limit).verdict(key)
        value = verdict.value
        if verdict.is_undecided:
            return UNDECIDED
        if verdict.is_at_least and isinstance(value, int):
            return OrMore(value)
        return value if value is None or isinstance(value, (bool, int)) else str(value)

    if is_comparing(find_by_key(key)):
        return find(family, ask, is_of_stages=True)
    if family.has_one and key in STABLE:
        try:
            values = stable_set(family.family, STABLE[key])
        except GarkError:
            return FamilyFact(None)
        return _of_set(family, values.found, values.undecided)
    if family.has_one and key in SIGNS:
        if key == "algebraically-stable" and not _is_complete(family.tableau):
            return FamilyFact(None)
        return _by_signs(family, ask, SIGNS[key](family.tableau))
    if key in ROWS and not any(isinstance(x, Parametric) for x in ROWS[key](family.tableau)):
        return find(family, ask)  # nothing with a parameter is asked
    return by_samples(family, ask)


def _is_complete(tableau: Tableau) -> bool:
    colours = range(tableau.size)
    return all(tableau.block(l, m) is not None for l in colours for m in colours)


def _of_set(
    family: EveryFamily, values: tuple[Interval, ...], unknown: tuple[RealRoot, ...] = ()
) -> FamilyFact:
    if not values:
        return FamilyFact(False, unknown=unknown)
    if _is_all(family, values):
        return FamilyFact(True, unknown=unknown)
    return FamilyFact(None, unknown=unknown, where=values)


def _is_all(family: EveryFamily, values: tuple[Interval, ...]) -> bool:
    least, greatest = family.ends
    poles = roots_of(map(in_one, family.poles))
    first, last = values[0], values[-1]
    has_start = first.has_start or first.start in (None, *poles)
    has_end = last.has_end or last.end in (None, *poles)
    is_whole = first.start == least and last.end == greatest
    # between two intervals there is nothing but a pole
    are_joined = all(
        left.end == right.start and left.end in poles for left, right in pairwise(values)
    )
    return has_start and has_end and is_whole and are_joined


def _by_signs(family: EveryFamily, ask: Question, numbers: list[object]) -> FamilyFact:
    critical: list[Polynomial] = []
    critical += [in_one(p) for p in family.poles]
    for x in numbers:
        critical += [in_one(p) for p in fraction(x, family.ring) if p]
    critical += [Polynomial.from_flint(x.polynomial) for x in family.ends if x is not None]
    unknown: list[RealRoot] = []

    def holds(t: Point) -> bool:
        root = t if isinstance(t, RealRoot) else RealRoot.rational(t)
        if not family.is_inside(root):
            return False
        exact = exact_value(root)
        if exact is None:
            unknown.append(root)
            return False
        fact = answer(ask, family.at(exact))
        if fact is UNDECIDED:
            unknown.append(root)
        return fact is True

    return _of_set(family, where(holds, critical), tuple(unknown))


def _weights(tableau: Tableau) -> list[object]:
    """Returns the coefficients of det(1 − z G), G the diagonal form of the weights."""
    numbers: list[object] = []
    for l, colour in enumerate(tableau.colours):
        gram = tableau.space(l).form(colour.b, identity(len(colour.b)))
        numbers += characteristic_coefficients(gram)
    return numbers


def _nodes(tableau: Tableau) -> list[object]:
    numbers: list[object] = []
    for colour in tableau.colours:
        numbers += [*colour.c, *(ONE - x for x in colour.c)]
    return numbers


def _algebraic(tableau: Tableau) -> list[object]:
    """Returns numbers whose signs decide algebraic stability: the coefficients of det(1 − z M)."""
    return [*characteristic_coefficients(contractivity(tableau)), *_weights(tableau)]


SIGNS: dict[str, Callable[[Tableau], list[object]]] = {
    "positive-weights": _weights,
    "nodes-in-unit-interval": _nodes,
    "algebraically-stable": _algebraic,
}
"""The numbers whose signs decide a property."""
ROWS: dict[str, Callable[[Tableau], Iterator[Number]]] = {
    "positive-weights": lambda tableau: chain.from_iterable(x.b for x in tableau.colours),
    "nodes-in-unit-interval": lambda tableau: chain.from_iterable(x.c for x in tableau.colours),
}
"""The entries that decide a property."""
