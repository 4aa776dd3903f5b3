"""A family made ready to be judged for every value: what is fixed is put in, roots have rules."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import product

from flint import fmpq, fmpq_mpoly, fmpz_mpoly

from garkcli.check.every_ranges import FREE, can_vanish, carried, is_within
from garkcli.check.every_relations import (
    is_linear,
    moved_nonzero,
    moved_rules,
    rules_of,
    solved,
    value_of,
)
from garkcli.design.conditions import FamilyConditions
from garkcli.design.member import member
from garkcli.errors import MethodError
from garkcli.exact.field import Number
from garkcli.exact.parametric import Parameters, Parametric
from garkcli.exact.polynomial import in_one
from garkcli.exact.roots import RealRoot, number_of, real_roots, sign_at
from garkcli.tableau.family import Family, family_in_points
from garkcli.tableau.stages import PointSpace
from garkcli.tableau.tableau import Tableau

MOST_DEGREE = 6
"""Values of a larger degree are not looked at over their number field."""
_SAMPLES = [fmpq(*x) for x in ((2, 7), (3, 5), (7, 4), (-5, 3), (11, 3))]
"""Where parameters are tried."""
MOST_SAMPLES = 40


@dataclass(frozen=True)
class EveryFamily:
    """A family without relations but those of its roots.

    Attributes:
        family: its tableau has entries in the parameters that are left, ``family.parameters``,
            and in roots of numbers.
    """

    family: Family

    @property
    def tableau(self) -> Tableau:
        """The tableau for every value."""
        return self.family.tableau

    @property
    def ring(self) -> Parameters:
        """The parameters, and unknowns for roots of numbers."""
        return self.family.ring

    @property
    def has_one(self) -> bool:
        """Whether one rational parameter is all there is: then single values are looked at."""
        return len(self.ring.names) == 1

    @cached_property
    def poles(self) -> tuple[fmpq_mpoly, ...]:
        """Polynomials: where one is zero there is no method."""
        shown = FamilyConditions(self.tableau, self.ring).denominators
        return (*shown, *self.family.nonzero)

    @cached_property
    def in_points(self) -> Tableau | None:
        """The tableau with one coordinate a stage, the roots of its nodes as unknowns with rules.

        None where the nodes have no simple radicals, or there are roots among the coefficients.
        """
        return self.printed(self.tableau)

    def printed(self, tableau: Tableau) -> Tableau | None:
        """The same of a tableau that is made of this one, such as the conjugate."""
        if all(isinstance(x, PointSpace) for x in tableau.spaces):
            return tableau
        if len(self.family.parameters) != len(self.ring.names):
            return None
        return family_in_points(tableau, self.ring)

    @cached_property
    def relations(self) -> list[fmpq_mpoly]:
        """What the roots among the coefficients satisfy: zero."""
        ring = self.ring
        return [ring.context.gen(rule.index) ** rule.degree - rule.instead for rule in ring.rules]

    @cached_property
    def weights(self) -> list[fmpq_mpoly]:
        """Polynomials of which one is zero where a weight is, each irreducible."""
        found: dict[str, fmpq_mpoly] = {}
        for colour in self.tableau.colours:
            numbers: tuple[object, ...] = colour.b
            for b in numbers:
                if isinstance(b, Parametric):
                    for factor, _ in b.numerator.factor()[1]:
                        if not self.is_number(factor):
                            found[str(factor)] = factor
        return list(found.values())

    @property
    def lost(self) -> list[fmpq_mpoly]:
        """Those of the weights that may be zero for values that the file admits."""
        poles = {str(f) for p in self.poles for f, _ in p.factor()[1]}
        return [p for p in self.weights if str(p) not in poles and self.can_vanish(p)]

    def common_zeros(self, polynomials: Sequence[fmpq_mpoly | fmpz_mpoly]) -> tuple[str, ...]:
        """Polynomials as text, but for what roots of numbers satisfy; none where one of them is
        zero for no value that the file admits.
        """
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
        """The method for a value of the one parameter."""
        [name] = self.ring.names
        return member(self.tableau, self.ring, {name: value})

    def is_inside(self, value: RealRoot) -> bool:
        """Whether there is a method for a value of the one parameter, and the file admits it."""
        if any(not sign_at(in_one(p), value) for p in self.poles):
            return False
        [ends] = self.family.ranges.values()
        return is_within(value, ends)

    def can_vanish(self, p: fmpq_mpoly) -> bool:
        """Whether a polynomial may be zero for values that the file admits."""
        return can_vanish(p, self.ring, self.family.ranges)

    def is_number(self, p: fmpq_mpoly) -> bool:
        """Whether there are at most roots of numbers in a polynomial."""
        roots = {rule.index for rule in self.ring.rules}
        return {k for k, e in enumerate(p.degrees()) if e} <= roots

    def norm(self, p: fmpq_mpoly, ring: Parameters) -> fmpq_mpoly:
        """A polynomial in the one parameter that is zero where one with roots of nodes is.

        Args:
            p: a polynomial.
            ring: of it; its first unknown is the parameter.
        """
        for rule in reversed(ring.rules):
            relation = ring.context.gen(rule.index) ** rule.degree
            p = p.resultant(relation - rule.instead, ring.names[rule.index])
        terms: dict[tuple[int, ...], fmpq] = {}
        for exponents, a in p.to_dict().items():
            terms[(int(exponents[0]),)] = a
        return self.ring.context.from_dict(terms)

    def roots(self, polynomials: Sequence[fmpq_mpoly]) -> list[RealRoot]:
        """The values of the one parameter, in ascending order, at which one is zero."""
        found: set[RealRoot] = set()
        for p in polynomials:
            found.update(root for root, _ in real_roots(in_one(p)))
        return sorted(root for root in found if self.is_inside(root))

    def where_zero(self, p: fmpq_mpoly) -> EveryFamily | None:
        """The methods with a zero of a polynomial; None where it gives no parameter its value, or
        the range of that one is none of another.
        """
        names = ranged_last(self.family)
        if not any(is_linear(p, self.ring, name) for name in names):
            return None
        fixed = solved([p], self.ring, names)
        left = [name for name in self.family.parameters if name not in fixed]
        if not left:
            return None
        values: dict[str, object] = {}
        roots = self.ring.names[len(names) :]
        smaller = Parameters([*left, *roots])
        smaller.shown = self.ring.shown
        smaller.rules = tuple(moved_rules(self.ring, smaller))
        for name in smaller.names:
            values[name] = smaller.parameter(name)
        for name, value in fixed.items():
            values[name] = value_of(value, self.ring, values)
        try:
            tableau = member(self.tableau, self.ring, values)  # type: ignore[arg-type]
            followed = {name: values[name] for name in fixed}
            ranges = carried(followed, self.family.ranges, left)
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
        """Methods of the family with rational parameters; none where there are roots beside them.

        Args:
            apart: polynomials that are not zero there.
        """
        if len(self.family.parameters) != len(self.ring.names):
            return
        choices = [list(self._tried(name)) for name in self.ring.names]
        count = 0
        for offset, _ in enumerate(_SAMPLES):
            # each parameter begins elsewhere: equal values are special
            rows = [
                [c[(offset + k + i) % len(c)] for i in range(len(c))] for k, c in enumerate(choices)
            ]
            for values in product(*(row[:2] for row in rows)):
                count += 1
                if count > MOST_SAMPLES:
                    return
                if any(not p(*values) for p in (*apart, *self.poles)):
                    continue
                named = dict(zip(self.ring.names, values, strict=True))
                yield named, member(self.tableau, self.ring, named)

    def _tried(self, name: str) -> Iterator[fmpq]:
        """Values of a parameter within its range."""
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
    """The parameters, those without a range first: they are put in first."""
    ranges = family.ranges
    return sorted(family.parameters, key=lambda name: ranges[name] != FREE)


def exact_value(root: RealRoot) -> Number | None:
    """A value as a number; None where its field is too large."""
    return number_of(root, MOST_DEGREE)


def every_family(family: Family) -> EveryFamily:
    """The family with what its relations fix put in.

    Raises:
        MethodError: a relation that is no value of an unknown, or roots that depend on parameters.
    """
    relations = [*family.relations]
    for name, (least, greatest) in family.ranges.items():
        if least is not None and least == greatest:
            index = family.ring.names.index(name)
            relations.append(family.ring.context.gen(index) - least)
    fixed = solved(relations, family.ring, ranged_last(family))
    left = [x for x in family.parameters if x not in fixed]
    if not left:
        raise MethodError(
            "what the file asks of its parameters leaves none of them free",
            "gark design finds their values",
            code="no-value-left",
        )
    names = [*left, *(radical.name for radical in family.radicals)]
    ring = Parameters(names)
    ring.shown = {x.name: (x.text, x.latex) for x in family.radicals}
    ring.rules = tuple(rules_of(family, ring))
    values: dict[str, object] = {x: ring.parameter(x) for x in names}
    for name in reversed(fixed):
        values[name] = value_of(fixed[name], family.ring, values)
    followed = {name: values[name] for name in fixed}
    ranges = carried(followed, family.ranges, left)
    if any(least is not None and least == most for least, most in ranges.values()):
        # ranges that meet in one number fix a parameter
        narrowed = {**family.ranges, **ranges}
        return every_family(replace(family, ranges=narrowed))
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
        not_negative=(),
    )
    return EveryFamily(made)
