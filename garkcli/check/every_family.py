"""A family prepared for statements about all values: fixed values are substituted, roots have
rules.

A polynomial is rewritten in u ≥ 0, with t = (l + g u)/(1 + u) for a range [l, g] and t = l ± u for
a half-line. It has no zero if no coefficient is negative and the coefficients at the corners are
positive; for [l, g] these are Bernstein coefficients up to positive factors. The converse fails.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import cached_property
from itertools import product
from math import prod
from typing import TypeAlias, cast

from flint import fmpq, fmpq_mpoly, fmpz_mpoly

from garkcli.deadline import checked
from garkcli.design.conditions import FamilyConditions
from garkcli.design.member import admitted, member
from garkcli.errors import MethodError
from garkcli.exact.cells import roots_of
from garkcli.exact.domain import Domain
from garkcli.exact.expression import parse
from garkcli.exact.field import ZERO, Number
from garkcli.exact.parametric import Parameters, Parametric, Rule, evaluated, factors, unknowns_of
from garkcli.exact.polynomial import Polynomial, in_one
from garkcli.exact.projection import coefficient_of
from garkcli.exact.roots import RealRoot, number_of, real_roots, sign_at
from garkcli.frozen import Frozen, replace
from garkcli.tableau.family import Family, family_in_points
from garkcli.tableau.stages import PointSpace
from garkcli.tableau.tableau import Tableau

Range: TypeAlias = tuple[fmpq | None, fmpq | None]
"""The ends of a range; None for infinity."""
_Chart: TypeAlias = Callable[[fmpq_mpoly], tuple[fmpq_mpoly, fmpq_mpoly]]
"""A parameter as a function of u: numerator and denominator."""

FREE: Range = (None, None)
MOST_TERMS = 300
"""A polynomial with more terms in u counts as one that may be zero."""


def can_vanish(p: fmpq_mpoly, ring: Parameters, ranges: Mapping[str, Range]) -> bool:
    """Returns False only if a polynomial certainly has no real zero within the ranges."""
    if not p:
        return True
    _, factors = p.factor()
    return any(_can_vanish(factor, ring, ranges) for factor, _ in factors)


def _can_vanish(p: fmpq_mpoly, ring: Parameters, ranges: Mapping[str, Range]) -> bool:
    used = unknowns_of(p)
    names = [ring.names[k] for k in used]
    has_roots = any(name not in ranges for name in names)
    terms_in_u = prod(int(degree) + 1 for degree in p.degrees())
    if has_roots or terms_in_u > MOST_TERMS:
        return True
    inside = [ranges[name] for name in names]
    if len(used) == 1:
        # all of them are known
        roots = real_roots(in_one(p, used[0]))
        return any(is_within(root, inside[0]) for root, _ in roots)
    return any(
        _may_vanish(p, used, inside, case) for case in checked(product(*map(_charts, inside)))
    )


def is_within(value: RealRoot, ends: Range) -> bool:
    least, greatest = ends
    below = least is not None and value < RealRoot.rational(least)
    above = greatest is not None and RealRoot.rational(greatest) < value
    return not below and not above


def _charts(ends: Range) -> Iterator[_Chart]:
    """Yields maps of u ≥ 0 onto the range; two for the whole line."""
    least, greatest = ends
    if least is not None and greatest is not None:
        yield lambda u: (least + greatest * u, 1 + u)
    elif least is not None:
        yield lambda u: (least + u, 1 + 0 * u)
    elif greatest is not None:
        yield lambda u: (greatest - u, 1 + 0 * u)
    else:
        yield lambda u: (u, 1 + 0 * u)
        yield lambda u: (-u, 1 + 0 * u)


def _may_vanish(
    p: fmpq_mpoly, used: Sequence[int], inside: Sequence[Range], case: Sequence[_Chart]
) -> bool:
    """Returns whether the coefficients in u leave the existence of a zero open."""
    values = {}
    for exponents, a in _rewritten(p, used, case).to_dict().items():
        values[tuple(map(int, exponents))] = fmpq(a)
    # a closed range has a corner at each end, the others at u = 0 alone
    degrees = [int(degree) for degree in p.degrees()]
    corners: list[tuple[int, ...]] = [(0,)] * len(degrees)
    for k, ends in zip(used, inside, strict=True):
        if None not in ends:
            corners[k] = (0, degrees[k])
    at_corners = [values.get(corner, ZERO) for corner in checked(product(*corners))]
    one = at_corners[0]
    are_signed_alike = all(a * one > 0 for a in at_corners)
    opposes = any(a * one < 0 for a in values.values())
    return opposes or not are_signed_alike


def _rewritten(p: fmpq_mpoly, used: Sequence[int], case: Sequence[_Chart]) -> fmpq_mpoly:
    context = p.context()
    u = context.gens()
    degrees = p.degrees()
    total = context.constant(0)
    for exponents, a in p.to_dict().items():
        term = context.constant(a)
        for k, chart in zip(used, case, strict=True):
            over, under = chart(u[k])
            power = int(exponents[k])
            rest = int(degrees[k]) - power
            term *= over**power
            term *= under**rest
        total += term
    return total


def carried(
    fixed: Mapping[str, object], ranges: Mapping[str, Range], left: Sequence[str]
) -> dict[str, Range]:
    """Returns the ranges left, cut by ``fixed`` numbers or polynomials; raises MethodError."""
    left_ranges = {name: ranges[name] for name in left}
    for name, value in fixed.items():
        least, greatest = ranges[name]
        if ranges[name] == FREE:
            continue
        other, slope, rest = _affine(name, value, left)
        low = None if least is None else least - rest
        high = None if greatest is None else greatest - rest
        if other is None:
            if (low is not None and low > 0) or (high is not None and high < 0):
                message = f"the file implies {name} = {value}, which is outside of its range"
                cure = "change the range, or what fixes the value"
                raise MethodError(message, cure, code="no-value-left")
            continue
        low = None if low is None else low / slope
        high = None if high is None else high / slope
        left_ranges[other] = _common(
            other, left_ranges[other], (low, high) if slope > 0 else (high, low)
        )
    return left_ranges


def _affine(name: str, value: object, left: Sequence[str]) -> tuple[str | None, fmpq, fmpq]:
    """Returns the parameter in an affine value, its factor and the constant; None in a number."""
    if isinstance(value, fmpq):
        return None, ZERO, value
    assert isinstance(value, Parametric)
    p = value.numerator
    used = unknowns_of(p)
    index = used[0]
    other = value.ring.names[index]
    is_polynomial = value.denominator.is_one()
    is_affine = len(used) == 1 and p.degrees()[index] == 1
    if not is_polynomial or not is_affine or other not in left:
        text = value.ring.text(p)
        message = f"{name} has a range, and its value {text} follows from others"
        cure = "give the range to one of these, or values with --set"
        raise MethodError(message, cure, code="no-value-left")
    line = in_one(p, index)
    slope, rest = line[1], line[0]
    assert isinstance(slope, fmpq)
    assert isinstance(rest, fmpq)
    return other, slope, rest


def _common(name: str, one: Range, other: Range) -> Range:
    both = [one, other]
    starts = [start for start, _ in both if start is not None]
    ends = [end for _, end in both if end is not None]
    least = max(starts, default=None)
    greatest = min(ends, default=None)
    if least is not None and greatest is not None and greatest < least:
        message = f"the ranges leave no value of {name}"
        cure = "change one of them, or what fixes the others"
        raise MethodError(message, cure, code="no-value-left")
    return least, greatest


def moved_rules(old: Parameters, new: Parameters) -> Iterator[Rule]:
    shift = len(old.names) - len(new.names)
    for rule in old.rules:
        yield Rule(rule.index - shift, rule.degree, rule.instead.project_to_context(new.context))


def solved(
    relations: Sequence[fmpq_mpoly], ring: Parameters, unknowns: Sequence[str]
) -> dict[str, fmpq_mpoly]:
    """Returns the values of unknowns in which relations are linear, in terms of those left."""
    fixed: dict[str, fmpq_mpoly] = {}
    waiting = [p for p in relations if p]
    while waiting:
        p = waiting.pop(0)
        name = next((x for x in unknowns if is_linear(p, ring, x)), None)
        if name is None:
            message = f"the file demands {p} = 0, which determines none of its parameters"
            cure = "give values with --set, or ask gark design"
            raise MethodError(message, cure, code="no-value-left")
        x = ring.context.gen(ring.names.index(name))
        value = x - p / p.derivative(ring.names.index(name)).leading_coefficient()
        fixed[name] = value
        inside = list(ring.context.gens())
        inside[ring.names.index(name)] = value
        waiting = [q for q in (w.compose(*inside) for w in waiting) if q]
    return fixed


def is_linear(p: fmpq_mpoly, ring: Parameters, name: str) -> bool:
    index = ring.names.index(name)
    return p.degrees()[index] == 1 and p.derivative(index).is_constant()


def value_of(p: fmpq_mpoly, ring: Parameters, values: dict[str, object]) -> object:
    return evaluated(p, [values.get(name) for name in ring.names])


def moved_nonzero(family: Family, values: dict[str, object]) -> tuple[fmpq_mpoly, ...]:
    """Returns the divisors of a family at values of its unknowns; MethodError if one is zero."""
    polynomials = []
    for p in family.nonzero:
        value = value_of(p, family.ring, values)
        if not value:
            message = f"the file divides by {family.ring.text(p)}, which is zero under its demands"
            cure = "change its demands on the parameters, such as given nodes"
            raise MethodError(message, cure, code="division-by-zero")
        if isinstance(value, Parametric):
            polynomials.append(value.numerator)
    return tuple(polynomials)


def rules_of(family: Family, ring: Parameters) -> Iterator[Rule]:
    """Yields the rules for powers of the roots, of the degree that is left by earlier roots."""
    for number, radical in enumerate(family.radicals):
        index = family.ring.names.index(radical.name)
        before = {family.ring.names.index(x.name) for x in family.radicals}
        if not {*unknowns_of(radical.relation)} <= before:
            message = f"{radical.text} depends on a free parameter"
            cure = "give values with --set, or put a parameter in place of the root"
            raise MethodError(message, cure, code="no-value-left")
        degree = int(radical.relation.degrees()[index])
        # whether it has the degree of its relation over the field of those before it
        known = family.radicals[: number + 1]
        field = Domain([parse(x.text) for x in known]).field
        due = prod(int(x.relation.degrees()[family.ring.names.index(x.name)]) for x in known)
        if field is None or field.degree != due:
            message = f"{radical.text} is an expression in the roots before it"
            raise MethodError(message, "write it with these roots", code="no-value-left")
        place = ring.names.index(radical.name)
        leading = coefficient_of(radical.relation, degree, index).leading_coefficient()
        relation = radical.relation.project_to_context(ring.context) / leading
        yield Rule(place, degree, ring.context.gen(place) ** degree - relation)


MOST_DEGREE = 6
"""Values of larger degree are not examined over their number field."""
_SAMPLES = [fmpq(*x) for x in ((2, 7), (3, 5), (7, 4), (-5, 3), (11, 3))]
MOST_SAMPLES = 40


class EveryFamily(Frozen):
    """A family whose only relations are those of its roots of numbers."""

    family: Family

    @property
    def tableau(self) -> Tableau:
        return self.family.tableau

    @property
    def ring(self) -> Parameters:
        return self.family.ring

    @property
    def has_one(self) -> bool:
        """Whether there is one rational parameter and nothing else."""
        return len(self.ring.names) == 1

    @cached_property
    def poles(self) -> tuple[fmpq_mpoly, ...]:
        """Polynomials at whose zeros there is no method."""
        return (*FamilyConditions(self.tableau, self.ring).denominators, *self.family.nonzero)

    @cached_property
    def in_points(self) -> Tableau | None:
        """The tableau on point stages, with roots as unknowns; None without simple radicals."""
        return self.printed(self.tableau)

    def printed(self, tableau: Tableau) -> Tableau | None:
        if all(isinstance(x, PointSpace) for x in tableau.spaces):
            return tableau
        if len(self.family.parameters) != len(self.ring.names):
            return None
        return family_in_points(tableau, self.ring)

    @cached_property
    def relations(self) -> list[fmpq_mpoly]:
        ring = self.ring
        return [ring.context.gen(rule.index) ** rule.degree - rule.instead for rule in ring.rules]

    @cached_property
    def weights(self) -> list[fmpq_mpoly]:
        """Irreducible polynomials; where one is zero, a weight is."""
        numbers: list[object] = [b for colour in self.tableau.colours for b in colour.b]
        numerators = factors(b.numerator for b in numbers if isinstance(b, Parametric))
        return [p for p in numerators if not self.is_number(p)]

    @property
    def lost(self) -> list[fmpq_mpoly]:
        poles = factors(self.poles)
        return [p for p in self.weights if p not in poles and self.can_vanish(p)]

    def common_zeros(self, polynomials: Sequence[fmpq_mpoly | fmpz_mpoly]) -> tuple[str, ...]:
        """Returns polynomials as text; none if one of them vanishes at no admitted value."""
        ring = self.ring
        texts = []
        for p in polynomials:
            terms = {tuple(map(int, e[: len(ring.names)])): fmpq(a) for e, a in p.to_dict().items()}
            reduced = ring.reduced(ring.context.from_dict(terms))
            if not self.can_vanish(reduced):
                return ()
            if reduced:
                texts.append(ring.text(reduced if ring.rules else p))
        return tuple(dict.fromkeys(texts))

    def at(self, value: Number) -> Tableau:
        [name] = self.ring.names
        return member(self.tableau, self.ring, {name: value})

    def is_inside(self, value: RealRoot) -> bool:
        """Whether the file admits a value of the parameter and there is a method for it."""
        return self._admits(value) and all(sign_at(in_one(p), value) for p in self.poles)

    def _admits(self, value: RealRoot) -> bool:
        [ends] = self.family.ranges.values()
        return is_within(value, ends) and all(sign_at(p, value) >= 0 for p in self.bounds)

    @cached_property
    def bounds(self) -> list[Polynomial]:
        """Polynomials of a single parameter that have to be nonnegative, from algebraic ends."""
        return [in_one(p, 0) for p in self.family.not_negative]

    @cached_property
    def ends(self) -> tuple[RealRoot | None, RealRoot | None]:
        [name] = self.family.parameters
        [inside] = admitted(self.family, name)
        return inside.start, inside.end

    def can_vanish(self, p: fmpq_mpoly) -> bool:
        """Returns whether a polynomial may be zero for values that the file admits."""
        if self.bounds and unknowns_of(p) == [0]:
            return any(self._admits(root) for root in roots_of([in_one(p, 0)]))
        return can_vanish(p, self.ring, self.family.ranges)

    def is_number(self, p: fmpq_mpoly) -> bool:
        roots = {rule.index for rule in self.ring.rules}
        return {*unknowns_of(p)} <= roots

    def norm(self, p: fmpq_mpoly, ring: Parameters) -> fmpq_mpoly:
        """Returns the norm over roots of nodes, in the parameter, the first unknown of ``ring``."""
        for rule in reversed(ring.rules):
            relation = ring.context.gen(rule.index) ** rule.degree
            p = p.resultant(relation - rule.instead, ring.names[rule.index])
        return p.project_to_context(self.ring.context, {0: 0})

    def roots(self, polynomials: Sequence[fmpq_mpoly]) -> list[RealRoot]:
        return [root for root in roots_of(map(in_one, polynomials)) if self.is_inside(root)]

    def where_zero(self, p: fmpq_mpoly) -> EveryFamily | None:
        """Returns the subfamily where p is zero; None if p or its range determines no parameter."""
        names = ranged_last(self.family)
        if not any(is_linear(p, self.ring, name) for name in names):
            return None
        fixed = solved([p], self.ring, names)
        left = [name for name in self.family.parameters if name not in fixed]
        if not left:
            return None
        values: dict[str, object] = {}
        smaller = Parameters([*left, *self.ring.names[len(names) :]])
        smaller.shown = self.ring.shown
        smaller.rules = tuple(moved_rules(self.ring, smaller))
        for name in smaller.names:
            values[name] = smaller.parameter(name)
        for name, value in fixed.items():
            values[name] = value_of(value, self.ring, values)
        try:
            tableau = member(self.tableau, self.ring, values)  # type: ignore[arg-type]
            ranges = carried({name: values[name] for name in fixed}, self.family.ranges, left)
            nonzero = moved_nonzero(self.family, values)
        except (ZeroDivisionError, MethodError):
            return None
        made = replace(
            self.family,
            tableau=tableau,
            ring=smaller,
            parameters=tuple(left),
            ranges=ranges,
            nonzero=nonzero,
        )
        return EveryFamily(made)

    def samples(
        self, apart: Sequence[fmpq_mpoly] = ()
    ) -> Iterator[tuple[dict[str, fmpq], Tableau]]:
        if len(self.family.parameters) != len(self.ring.names):
            return
        choices = [list(self._tried(name)) for name in self.ring.names]
        count = 0
        for offset, _ in enumerate(_SAMPLES):
            # each parameter begins elsewhere: equal values are special
            rows = [
                [c[(offset + k + i) % len(c)] for i in range(len(c))] for k, c in enumerate(choices)
            ]
            for values in checked(product(*(row[:2] for row in rows))):
                count += 1
                if count > MOST_SAMPLES:
                    return
                if any(not p(*values) for p in (*apart, *self.poles)):
                    continue
                if any(p(*values) < 0 for p in self.family.not_negative):
                    continue
                named = dict(zip(self.ring.names, values, strict=True))
                yield named, member(self.tableau, self.ring, named)

    def _tried(self, name: str) -> Iterator[fmpq]:
        least, greatest = self.family.ranges[name]
        for x in _SAMPLES:
            share = (x + 2) / 6
            if least is not None and greatest is not None:
                yield least + (greatest - least) * share
            elif least is not None:
                yield least + x * x
            elif greatest is not None:
                yield greatest - x * x
            else:
                yield x


def ranged_last(family: Family) -> list[str]:
    """Returns the parameters in the order of elimination, those without a range first."""
    ranges = family.ranges
    return sorted(family.parameters, key=lambda name: ranges[name] != FREE)


def exact_value(root: RealRoot) -> Number | None:
    return number_of(root, MOST_DEGREE)


def every_family(family: Family) -> EveryFamily:
    """Returns the family with its relations solved; MethodError if one is not linear."""
    relations = [*family.relations]
    for name, (least, greatest) in family.ranges.items():
        if least is not None and least == greatest:
            relations.append(family.ring.context.gen(family.ring.names.index(name)) - least)
    fixed = solved(relations, family.ring, ranged_last(family))
    left = [x for x in family.parameters if x not in fixed]
    if not left:
        message = "the demands of the file leave no parameter free"
        raise MethodError(message, "gark design finds their values", code="no-value-left")
    names = [*left, *(radical.name for radical in family.radicals)]
    ring = Parameters(names)
    ring.shown = {x.name: (x.text, x.latex) for x in family.radicals}
    ring.rules = tuple(rules_of(family, ring))
    values: dict[str, object] = {x: ring.parameter(x) for x in names}
    for name in reversed(fixed):
        values[name] = value_of(fixed[name], family.ring, values)
    ranges = carried({name: values[name] for name in fixed}, family.ranges, left)
    if any(least is not None and least == most for least, most in ranges.values()):
        # ranges that meet in one number fix a parameter
        return every_family(replace(family, ranges={**family.ranges, **ranges}))
    tableau = member(family.tableau, family.ring, values)  # type: ignore[arg-type]
    made = replace(
        family,
        tableau=tableau,
        ring=ring,
        parameters=tuple(left),
        ranges=ranges,
        relations=(),
        radicals=(),
        nonzero=moved_nonzero(family, values),
        positive=(),
        not_negative=_moved_bounds(family, values, left),
    )
    return EveryFamily(made)


def _moved_bounds(
    family: Family, values: dict[str, object], left: Sequence[str]
) -> tuple[fmpq_mpoly, ...]:
    """Returns ``not_negative`` for the values of unknowns; MethodError if one is out of range."""
    polynomials = []
    for p in family.not_negative:
        name = family.ring.names[unknowns_of(p)[0]]
        value = value_of(p, family.ring, values)
        if isinstance(value, Parametric):
            polynomials.append(value.numerator)
        elif cast("fmpq", value) < 0:
            message = f"the file implies {name} = {values[name]}, which is outside of its range"
            raise MethodError(message, "change the range", code="no-value-left")
    if polynomials and len(left) > 1:
        name = left[unknowns_of(polynomials[0])[0]]
        message = f"the range of {name} has an algebraic end, and {len(left)} parameters are free"
        cure = "write rational ends, or give values to the others with --set"
        raise MethodError(message, cure, code="no-value-left")
    return tuple(polynomials)
