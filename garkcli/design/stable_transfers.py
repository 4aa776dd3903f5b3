"""Which transfers of a family have a P-stable pair, whatever roots are among its coefficients.

The conditions for the order are linear in unknown transfers, so that those that are solved for are
functions of the others over a number field. The step M = N/D may depend on all of them through one
polynomial y: every coefficient of D and N in z is α + βy with rational α and β (Theorem E of
docs/pair-order.md). Then the engine for one parameter finds the stable y, among those that real
unknowns reach: from a least or up to a greatest one where y is a sum of squares or its negative.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from flint import fmpq, fmpq_mpoly

from garkcli.design.fewer import step_polynomials
from garkcli.design.ideal import Ideal
from garkcli.design.member import TABLEAUS, member
from garkcli.design.pairs import PairConditions
from garkcli.design.stability_kinds import StepStability, driven
from garkcli.design.stable_values import decided
from garkcli.design.step_plane import StepPlane
from garkcli.errors import LimitExceeded, NotDecided
from garkcli.exact.cells import Interval
from garkcli.exact.domain import Domain
from garkcli.exact.expression import parse
from garkcli.exact.field import ZERO, Number
from garkcli.exact.parametric import Parameters, Rule
from garkcli.exact.projection import PLANE
from garkcli.exact.roots import RealRoot, sign
from garkcli.tableau.family import Family

Table = dict[tuple[int, ...], Number]
"""A polynomial in the parameters over the field of the roots, by exponents; none of 0."""


def stable_zeros(criterion: PairConditions, ideal: Ideal) -> list[fmpq_mpoly]:
    """Polynomials that are zero exactly at the real values whose pair is P-stable: none where all
    are, a constant where none is.

    Args:
        criterion: of a family of which P-stability is wanted.
        ideal: of the values with an order of the pair.

    Raises:
        NotDecided: the step depends on several numbers, or other stability is wanted, or the set is
            no set of zeros, or the time is not enough.
        UsageProblem: P-stability has no meaning for the methods.
    """
    family = criterion.family
    solved = criterion.solved(ideal)
    if solved is None or {x.kind for x in family.stable} != {"p-stable"}:
        raise NotDecided
    ring, values = _solved(family, solved)
    tableau = TABLEAUS["pair"](member(family.tableau, family.ring, values))
    D, entries = step_polynomials(tableau, ring, driven(tableau, "p-stable"))
    powers = [_by_power(p, family) for p in (D, *entries)]
    y, plane = _plane(powers, _Numbers(family))
    used = [k for k in range(len(family.parameters)) if y.degrees()[k]]
    if not family.radicals and len(used) < 2:
        raise NotDecided  # the set of one coordinate says more
    bound = _extreme(_Numbers(family).table(y), used)
    return _zeros(y, used, plane, bound)


def _solved(family: Family, solved: Sequence[fmpq_mpoly]) -> tuple[Parameters, dict[str, Any]]:
    """The unknowns as functions of the free ones, in the ring in which roots are reduced."""
    ring, count = Parameters(family.ring.names), len(family.parameters)
    gens = ring.context.gens()
    leading: dict[int, fmpq_mpoly] = {}
    rules = []
    for p in solved:
        exponents = [int(k) for k in p.monoms()[0]]
        place = next(k for k, power in enumerate(exponents) if power)
        if sum(exponents) != exponents[place] or (place < count and exponents[place] > 1):
            raise NotDecided
        rest = gens[place] ** exponents[place] - p / p.leading_coefficient()
        if place < count:
            leading[place] = rest
        else:
            rules.append(Rule(place, exponents[place], rest))
    if len(rules) < len(family.radicals) or any(any(x.instead.degrees()[:count]) for x in rules):
        raise NotDecided  # parameters are under a root
    # that of a root may have later roots in it
    ring.rules = tuple(sorted(rules, key=lambda x: -x.index))
    one = ring.constant(fmpq(1))
    values = {
        name: ring.quotient(leading.get(k, gens[k]), one) for k, name in enumerate(ring.names)
    }
    return ring, values


def _by_power(polynomial: fmpq_mpoly, family: Family) -> dict[int, fmpq_mpoly]:
    """The coefficients of a polynomial in z, which comes first, and the unknowns."""
    found: dict[int, dict[tuple[int, ...], fmpq]] = {}
    for exponents, a in polynomial.to_dict().items():
        k, *others = map(int, exponents)
        found.setdefault(k, {})[tuple(others)] = a
    return {k: family.ring.context.from_dict(dict(x)) for k, x in found.items()}


class _Numbers:
    """The roots among the coefficients of a family as numbers of one field."""

    def __init__(self, family: Family) -> None:
        roots = [parse(x.text) for x in family.radicals]
        try:
            domain = Domain(roots)
        except LimitExceeded:
            raise NotDecided from None
        self.count = len(family.parameters)
        self.roots = [domain.evaluate(x) for x in roots]

    def table(self, polynomial: fmpq_mpoly) -> Table:
        """A polynomial in the parameters and these roots."""
        found = Table()
        for exponents, a in polynomial.to_dict().items():
            key = tuple(map(int, exponents))
            term: Number = fmpq(a)
            for root, power in zip(self.roots, key[self.count :], strict=True):
                term = term * root**power
            found[key[: self.count]] = found.get(key[: self.count], ZERO) + term
        return {key: a for key, a in found.items() if a}


def _plane(
    functions: Sequence[Mapping[int, fmpq_mpoly]], numbers: _Numbers
) -> tuple[fmpq_mpoly, StepPlane]:
    """The number y on which a step depends, and the step as a function of it.

    Args:
        functions: D and the entries of N, each by the powers of z.
        numbers: the roots in them.

    Raises:
        NotDecided: there is no such number.
    """
    origin = (0,) * numbers.count
    tables = [{k: numbers.table(p) for k, p in x.items()} for x in functions]
    if any(map(any, tables[0][0])):
        raise NotDecided  # D(0) = 1, times a denominator
    y, unit, first = functions[0][0] * 0, Table(), origin
    for x, of_x in zip(functions, tables, strict=True):
        for k in sorted(of_x):
            if not unit and any(map(any, of_x[k])):
                y, unit = x[k], of_x[k]
                first = max(unit)
    planes = []
    for one in tables:
        terms: dict[tuple[int, ...], fmpq] = {}
        for k, table in one.items():
            slope = table.get(first, ZERO) / unit[first] if unit else ZERO
            rest = {key: table.get(key, ZERO) - slope * unit.get(key, ZERO) for key in table | unit}
            constant = rest.pop(origin, ZERO)
            if any(rest.values()) or not isinstance(slope, fmpq) or not isinstance(constant, fmpq):
                raise NotDecided
            terms[k, 0], terms[k, 1] = constant, slope
        planes.append(PLANE.from_dict(terms))
    D, *entries = planes
    common = D
    for p in entries:
        common = common.gcd(p)
    a, b, c, d = (p // common for p in entries)
    return y, StepPlane(D // common, ((a, b), (c, d)), ())


def _extreme(table: Table, used: Sequence[int]) -> tuple[int, fmpq] | None:
    """1 and the least value of a polynomial of degree 2, or −1 and the greatest one, by completing
    squares; None where it reaches every number.

    Raises:
        NotDecided: the value is irrational, or the degree is larger.
    """
    if not table:
        return None
    if any(sum(key) > 2 for key in table):
        raise NotDecided

    def at(*places: int) -> Number:
        return table.get(tuple(places.count(k) for k in range(len(next(iter(table))))), ZERO)

    # half of the second derivatives, the first ones at 0, the value there
    H = {(i, j): at(i, j) * fmpq(1, 1 if i == j else 2) for i in used for j in used}
    g = {i: at(i) for i in used}
    value, left, signs = at(), list(used), set[int]()
    while any(H[i, j] for i in left for j in left):
        i = next((i for i in left if H[i, i]), None)
        if i is None:
            return None
        signs.add(sign(H[i, i]))
        left.remove(i)
        value = value - g[i] * g[i] / (H[i, i] * 4)
        for j in left:
            g[j] = g[j] - g[i] * H[i, j] / H[i, i]
            for k in left:
                H[j, k] = H[j, k] - H[i, j] * H[i, k] / H[i, i]
    if len(signs) != 1 or any(g[i] for i in left):
        return None
    if not isinstance(value, fmpq):
        raise NotDecided
    return signs.pop(), value


def _zeros(
    y: fmpq_mpoly, used: Sequence[int], plane: StepPlane, bound: tuple[int, fmpq] | None
) -> list[fmpq_mpoly]:
    """Where y has a value for which a step is stable."""
    ends: tuple[fmpq | None, fmpq | None] = (None, None)
    if bound is not None:
        ends = (bound[1], None) if bound[0] > 0 else (None, bound[1])
    found, undecided = decided(StepStability(plane), ends)
    start, end = (None if x is None else RealRoot.rational(x) for x in ends)
    if undecided:
        raise NotDecided
    if found == (Interval(start, end, start is not None, end is not None),):
        return []
    points = [x.start.exact if x.is_point and x.start else None for x in found]
    if bound is not None and points == [bound[1]]:
        return [y.derivative(k) for k in used]
    product = y * 0 + 1
    for x in points:
        if x is None:
            raise NotDecided
        product = product * (y - x)
    return [product]
