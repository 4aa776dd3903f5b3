"""Pair orders of families with known weights, and the transfers of least error.

The conditions of the criterion of docs/pair-order.md are linear in unknown transfers.
"""

from __future__ import annotations

from collections.abc import Iterable
from functools import cached_property
from itertools import chain
from typing import cast

from flint import Ordering, fmpq, fmpq_mpoly, fmpz_mpoly_ctx

from garkcli.deadline import only_small
from garkcli.design.groebner import groebner_basis
from garkcli.design.ideal import Ideal, rational
from garkcli.design.member import is_admissible, value_of
from garkcli.design.solutions import solutions
from garkcli.errors import NotDecided
from garkcli.exact.field import Algebraic, Number
from garkcli.exact.matrix import Vector, dot
from garkcli.exact.parametric import Mixed, Parametric, fraction
from garkcli.exact.polynomial import Polynomial
from garkcli.exact.roots import sign, sign_at
from garkcli.frozen import replace
from garkcli.order.defects import Defects
from garkcli.order.pair_order import added
from garkcli.problems.draw import Draw
from garkcli.tableau.family import Family
from garkcli.tableau.stages import PointSpace
from garkcli.tableau.tableau import Edge, Method
from garkcli.transfer import legendre


class PairConditions:
    """Conditions for pair orders of a family that :func:`pair_conditions` has checked. For real
    values they are necessary and sufficient.
    """

    def __init__(self, family: Family) -> None:
        self.family = family
        self.defects = Defects(family.tableau)

    def of_order(self, order: int) -> list[fmpq_mpoly]:
        edges = list(self.family.tableau.edges())
        diagonal = [(l, l) for l in range(self.family.tableau.size)]
        polynomials = []
        for letter, number in added(order):
            polynomials += self.on(diagonal if letter == "B" else edges, letter, number)
        return polynomials

    def on(self, edges: Iterable[Edge], letter: str, number: int) -> list[fmpq_mpoly]:
        """B(k), C(k), D(k) or the even condition on some blocks."""
        defects = (self.defects.of(letter, l, m, number) for l, m in edges)
        return self.zeros(chain.from_iterable(defects))

    def obstacle(self, order: int) -> str:
        """Says which condition, the first up to an order, known numbers fail, and where; or is
        empty.
        """
        tableau, count = self.family.tableau, len(self.family.parameters)
        for lower in range(1, order + 1):
            for letter, number in added(lower):
                is_of_colours = letter == "B"
                edges = [(l, l) for l in range(tableau.size)] if is_of_colours else tableau.edges()
                for l, m in edges:
                    fixed = [
                        p for p in self.on([(l, m)], letter, number) if not any(p.degrees()[:count])
                    ]
                    if not fixed or not self.start.with_zeros(fixed).is_everything:
                        continue
                    what = "the even condition" if letter == "even" else f"{letter}({number})"
                    names = tableau.colours[l].name, tableau.colours[m].name
                    place = f"colour {names[0]}" if is_of_colours else f"block ({','.join(names)})"
                    return f"{what} fails on {place}"
        return ""

    def zeros(self, defects: Iterable[Number]) -> list[fmpq_mpoly]:
        ring = self.family.ring
        numerators = (fraction(cast("Mixed", x), ring)[0] for x in defects)
        return [p for p in numerators if p]

    @property
    def off_diagonal(self) -> list[Edge]:
        return [(l, m) for l, m in self.family.tableau.edges() if l != m]

    @cached_property
    def start(self) -> Ideal:
        return Ideal(self.family.ring).with_zeros(x.relation for x in self.family.radicals)

    def point(self, ideal: Ideal, draw: Draw | None = None) -> Ideal | None:
        """The zeros with free unknowns at 0, or at drawn multiples of 1/8; None if they are
        infinitely many.
        """
        solved = self.solved(ideal)
        if solved is None:
            return None
        leading = {next(i for i, k in enumerate(p.monoms()[0]) if k) for p in solved}
        free = [i for i in range(len(self.family.parameters)) if i not in leading]
        values = {i: fmpq(0 if draw is None else draw.between(-8, 8), 8) for i in free}
        finite = ideal.with_values(values)
        return finite if finite.dimension == 0 else None

    def solved(self, ideal: Ideal) -> list[fmpq_mpoly] | None:
        """A basis with unknowns as functions of later ones; None if it is not small."""
        context = fmpz_mpoly_ctx.get(list(self.family.ring.names), Ordering.lex)
        if any(p.degrees()[len(self.family.ring.names) :] for p in ideal.basis):
            return None  # UNIT is no unknown of the file
        given = [context.from_dict(dict(p.to_dict())) for p in ideal.basis]
        try:
            with only_small():
                basis = groebner_basis(given, context)
        except NotDecided:
            return None
        return [rational(p, self.family.ring) for p in reversed(basis)]


def pair_conditions(family: Family) -> PairConditions | None:
    """Returns the conditions; None if a hypothesis of the criterion fails for some value.

    The hypotheses: weights are positive numbers, nodes row sums, no block is empty and no colour
    linear.
    """
    tableau = family.tableau
    if tableau.is_partitioned or any(colour.is_linear for colour in tableau.colours):
        return None
    if not all(isinstance(space, PointSpace) for space in tableau.spaces):
        return None
    edges = set(tableau.edges())
    if any((m, l) not in edges for l, m in edges):
        return None
    conditions = PairConditions(family)
    start = conditions.start
    for l in range(tableau.size):
        first = next(((l, m) for m in (l, *range(tableau.size)) if (l, m) in edges), None)
        if first is None or not all(map(start.contains, conditions.on([first], "C", 1))):
            return None
    weights = [b for colour in tableau.colours for b in colour.b]
    return conditions if _are_positive(family, start, weights) else None


def _is_fixed(family: Family, x: Number) -> bool:
    if not isinstance(cast("object", x), Parametric):
        return True
    parts = fraction(cast("Mixed", x), family.ring)
    return not any(any(p.degrees()[: len(family.parameters)]) for p in parts)


def _are_positive(family: Family, start: Ideal, numbers: list[Number]) -> bool:
    if not all(_is_fixed(family, x) for x in numbers):
        return False
    gens = family.ring.context.gens()[: len(family.parameters)]
    radicals = replace(family, ranges={}, positive=(), not_negative=())
    for solution in solutions(start.with_zeros(gens)):
        for root in solution.real:
            if not is_admissible(radicals, solution, root):
                continue
            for x in numbers:
                over, under = fraction(cast("Mixed", x), family.ring)
                value = value_of(over, family.ring, solution.values)
                value = value / value_of(under, family.ring, solution.values)
                if isinstance(value, Algebraic):
                    is_positive = sign_at(Polynomial.from_flint(value.poly), root) > 0
                else:
                    is_positive = sign(value) > 0
                if not is_positive:
                    return False
    return True


def least_error(
    conditions: PairConditions, order: int, ideal: Ideal, is_stable: bool = False
) -> Ideal | None:
    """The Legendre transfer, of least principal error among all real ones whose pair has an order.

    ``ideal`` has the values with the order p, or the P-stable ones alone: if the first colour is
    Gauss s and p = 2s, P-stability implies the block from it. None if the theorem does not prove
    it least, or if it is not in the family.
    """
    family = conditions.family
    tableau = family.tableau
    size = tableau.size
    methods = []
    for l, colour in enumerate(tableau.colours):
        block = tableau.block(l, l)
        if block is None or not all(_is_fixed(family, x) for x in chain.from_iterable(block)):
            return None
        methods.append(Method(colour.name, tableau.space(l), block, colour.b))
    if len(conditions.off_diagonal) != size * (size - 1):
        return None
    if is_stable and (size != 2 or order != 2 * tableau.space(0).stages):
        return None
    if order % 2 == 0 and not all(
        all(map(conditions.start.contains, conditions.zeros(_of_even_order(conditions, l, order))))
        for l in range(size)
    ):
        return None
    zeros: list[Number] = []
    for l, m in [(0, 1)] if is_stable else conditions.off_diagonal:
        wanted = legendre(methods[l], methods[m], order // 2)
        given = tableau.block(l, m)
        assert given is not None
        pairs = zip(chain.from_iterable(given), chain.from_iterable(wanted), strict=True)
        zeros += [x - y for x, y in pairs]
    ideal_of_least = ideal.with_zeros(conditions.zeros(zeros))
    return None if ideal_of_least.is_everything or ideal_of_least.dimension > 0 else ideal_of_least


def _of_even_order(conditions: PairConditions, l: int, order: int) -> Vector:
    """Expressions that vanish if the error of a colour is least with C(k + 1), D(k + 1) elsewhere.
    B(p + 1), and b(c^(k+1) d) = 0 for the diagonal block and its conjugate, with d = A c^k −
    c^(k+1)/(k + 1). Empty if the colour has no further stages.
    """
    k = order // 2 - 1
    tableau, defects = conditions.family.tableau, conditions.defects
    space, b = tableau.space(l), tableau.colours[l].b
    if space.stages <= k + 1:
        return ()
    block = defects._map(l, l)

    def moment(i: int, j: int) -> Number:
        """b(c^i A c^j)."""
        (image,) = block.images([defects.power(l, j)])
        return dot(space.times(b, defects.power(l, i)), image)

    common = dot(b, defects.power(l, 2 * k + 2)) * fmpq(1, k + 1)
    product = dot(b, defects.power(l, k + 1)) * dot(b, defects.power(l, k))
    return (
        *defects.B(l, order + 1),
        moment(k + 1, k) - common,
        product - moment(k, k + 1) - common,
    )
