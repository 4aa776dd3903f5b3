"""The transfers of a family with a P-stable pair, with roots among the coefficients.

By Theorem F of docs/pair-order.md that depends on the operators S and R made of A^{2,1}: nonzero
singular values are double, apart from what the step does not see. With a(λ) of half the power sums
of S S* this says a(S S*) S = 0 where the step sees all of them: equations in the coefficients.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from itertools import chain, zip_longest
from typing import Any

from flint import Ordering, fmpq, fmpq_mpoly, fmpz_mpoly_ctx

from garkcli.design.groebner import groebner_basis
from garkcli.design.ideal import Ideal, integral_scale
from garkcli.design.member import TABLEAUS, member
from garkcli.design.pairs import PairConditions
from garkcli.design.stability_kinds import driven
from garkcli.errors import NotDecided
from garkcli.exact import matrix as matrices
from garkcli.exact.field import ONE, ZERO, Number
from garkcli.exact.parametric import Parameters, Rule, fraction
from garkcli.frozen import Frozen
from garkcli.problems.oscillator import Oscillator, terms_of
from garkcli.tableau.family import Family
from garkcli.tableau.tableau import Tableau

HALF = fmpq(1, 2)


def stable_zeros(criterion: PairConditions, ideal: Ideal, order: int) -> list[fmpq_mpoly]:
    """Polynomials whose common real zeros are the values with a P-stable pair of an order.

    None if all are P-stable, a constant if none is. Weights are positive; ``ideal`` has the
    values whose pair has the order. Raises NotDecided if other stability is wanted, or the step
    may not see some of four stages; UsageProblem if P-stability is not applicable.
    """
    family = criterion.family
    solved = criterion.solved(ideal)
    if solved is None or {x.kind for x in family.stable} != {"p-stable"}:
        raise NotDecided
    driven(TABLEAUS["pair"](family.tableau), "p-stable")
    ring, values = _solved(family, solved)
    S = operator_of(member(family.tableau, family.ring, values))
    size = min(len(S.left), len(S.right))
    is_seen = size <= (order - 1) // 2 + 1  # powers of the nodes then span one of the spaces
    if is_seen:
        conditions = (*S.doubled(size // 2), *S.across.doubled((size - 1) // 2))
        zeros = [p for p in (fraction(x, ring)[0] for x in conditions) if p]
    elif size <= 3:
        zeros = _eliminated(_seen_doubled(S, size, ring), family)
    else:
        raise NotDecided
    used = [k for k in range(len(family.parameters)) if any(p.degrees()[k] for p in zeros)]
    if not family.radicals and len(used) < 2:
        raise NotDecided  # the set of one coordinate says more
    return zeros


class Operator(Frozen):
    """A linear map T between stage spaces, of shape (s_2, s_1), with weights of inner products.
    ``left`` are those of the codomain, ``right`` of the domain.
    """

    matrix: matrices.Matrix
    left: matrices.Vector
    right: matrices.Vector

    @property
    def adjoint(self) -> Operator:
        """B_1⁻¹ Tᵀ B_2."""
        rows = tuple(
            tuple(x * b / under for x, b in zip(column, self.left, strict=True))
            for column, under in zip(matrices.transpose(self.matrix), self.right, strict=True)
        )
        return Operator(rows, self.right, self.left)

    @property
    def across(self) -> Operator:
        """(I − 𝟙b_2ᵀ) T (I − 𝟙b_1ᵀ), the part orthogonal to 𝟙 on both sides."""
        ones = (ONE,) * len(self.left)
        T = matrices.subtract(
            self.matrix, matrices.outer(ones, matrices.apply_left(self.left, self.matrix))
        )
        T = matrices.subtract(
            T, matrices.outer(matrices.apply(T, (ONE,) * len(self.right)), self.right)
        )
        return Operator(T, self.left, self.right)

    @property
    def square(self) -> matrices.Matrix:
        """T T*."""
        return matrices.multiply(self.matrix, self.adjoint.matrix)

    def doubled(self, degree: int) -> Iterable[Number]:
        """Numbers that vanish exactly if at most ``degree`` singular values are not 0, all double.
        They are entries of a(T T*) T for the monic a of that degree with half its power sums.
        """
        T = self if len(self.left) < len(self.right) else self.adjoint
        K, result = T.square, T.matrix
        coefficients: list[Any] = [ONE]
        sums: list[Any] = []
        power = K
        for k in range(1, degree + 1):
            sums.append(sum((power[i][i] for i in range(len(K))), ZERO) * HALF)
            power = matrices.multiply(power, K)
            # Newton's identities
            total = sum((a * s for a, s in zip(coefficients[::-1], sums, strict=True)), ZERO)
            coefficients.append(-total / fmpq(k))
            result = matrices.add(
                matrices.multiply(K, result), matrices.scale(coefficients[-1], T.matrix)
            )
        return chain.from_iterable(result)


def operator_of(tableau: Tableau) -> Operator:
    """S = A − ½𝟙bᵀ, from the stages that drive q to those that drive p on the oscillator."""
    split = Oscillator.default(terms_of(tableau))
    shares = [split.drives(colour) for colour in tableau.colours]
    moving = [l for l, (k, _) in enumerate(shares) if k]
    forcing = [m for m, (_, v) in enumerate(shares) if v]
    right = tuple(shares[l][0] * x for l in moving for x in tableau.colours[l].b)
    left = tuple(shares[m][1] * x for m in forcing for x in tableau.colours[m].b)
    rows = []
    for m in forcing:
        blocks: list[Any] = [tableau.block(m, l) for l in moving]
        for parts in zip(*blocks, strict=True):
            entries = (shares[l][0] * x for l, row in zip(moving, parts, strict=True) for x in row)
            rows.append(tuple(a - b * HALF for a, b in zip(entries, right, strict=True)))
    return Operator(tuple(rows), left, right)


def _seen_doubled(S: Operator, size: int, ring: Parameters) -> list[fmpq_mpoly]:
    """Equations for double singular values, at most three, that the step may not see. They hold for
    parameters, α and β if α is double for S and β for R, as far as the step sees.
    """
    larger = Parameters(["_alpha", "_beta", *ring.names])
    alpha, beta, *gens = larger.context.gens()
    zero, one = alpha * 0, larger.constant(ONE)

    def lifted(x: Number) -> fmpq_mpoly:
        p, q = fraction(x, ring)
        if not q.is_constant():
            raise NotDecided
        return p.compose(*gens, ctx=larger.context) / q.leading_coefficient()

    R = S.across
    ones = (ONE,) * len(S.right), (ONE,) * len(S.left)
    next_to_them = matrices.apply(S.adjoint.matrix, ones[1]), matrices.apply(S.matrix, ones[0])
    zeros: list[fmpq_mpoly] = []
    polynomials = []
    for T, seen, root in ((S, ones, alpha), (R, next_to_them, beta if size == 3 else zero)):
        for map_, w in zip((T, T.adjoint), seen, strict=True):
            image = matrices.apply(map_.matrix, w)
            twice = matrices.apply(map_.square, image) if root else image
            zeros += [lifted(x) - root * lifted(y) for x, y in zip(twice, image, strict=True)]
        c = [lifted(x) for x in matrices.characteristic_coefficients(T.square)]
        # root is a root of this polynomial, or 0
        zeros.append(sum((x * root ** (len(c) - k) for k, x in enumerate(c)), zero))
        polynomials.append((c, [one, -root]))
    (of_S, a), (of_R, b) = polynomials
    sides = _product(of_S, _product(b, b)), _product(of_R, _product(a, a))
    return zeros + [p - q for p, q in zip_longest(*sides, fillvalue=zero)]


def _product(p: Sequence[fmpq_mpoly], q: Sequence[fmpq_mpoly]) -> list[fmpq_mpoly]:
    product = [p[0] * 0] * (len(p) + len(q) - 1)
    for i, a in enumerate(p):
        for j, b in enumerate(q):
            product[i + j] += a * b
    return product


def _eliminated(zeros: Sequence[fmpq_mpoly], family: Family) -> list[fmpq_mpoly]:
    """Polynomials that vanish if others do for some values of their first two unknowns."""
    names = zeros[0].context().names()
    context = fmpz_mpoly_ctx.get(names, Ordering.lex)
    raised = (
        x.relation.compose(*zeros[0].context().gens()[2:], ctx=zeros[0].context())
        for x in family.radicals
    )
    integral = []
    for p in (*zeros, *raised):
        unit = integral_scale(p)
        integral.append(context.from_dict({e: (a * unit).p for e, a in p.to_dict().items()}))
    basis = groebner_basis([p for p in integral if p], context)
    return [
        family.ring.context.from_dict({e[2:]: fmpq(a) for e, a in p.to_dict().items()})
        for p in basis
        if not any(p.degrees()[:2])
    ]


def _solved(family: Family, solved: Sequence[fmpq_mpoly]) -> tuple[Parameters, dict[str, Any]]:
    """The unknowns as functions of the free ones, in a ring that reduces roots."""
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
    # the rule of a root may contain later roots
    ring.rules = tuple(sorted(rules, key=lambda x: -x.index))
    one = ring.constant(fmpq(1))
    values = {
        name: ring.quotient(leading.get(k, gens[k]), one) for k, name in enumerate(ring.names)
    }
    return ring, values
