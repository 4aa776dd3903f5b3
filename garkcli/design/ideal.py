"""Ideals of polynomials over ℚ by Gröbner bases, made in python-flint within limits."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping
from functools import cached_property
from operator import methodcaller
from typing import Any

from flint import Ordering, fmpq, fmpq_mat, fmpq_mpoly, fmpq_poly, fmpz, fmpz_mpoly, fmpz_mpoly_ctx

from garkcli.deadline import check_time
from garkcli.design import groebner
from garkcli.exact.apart import apart
from garkcli.exact.parametric import Parameters, factors
from garkcli.exact.polynomial import Polynomial


def least_meeting(sets: Collection[frozenset[int]]) -> int:
    """The size of a smallest set that meets each of these nonempty sets, by branch and bound.

    Take an element of the smallest set and exclude those before it; disjoint sets bound it below.

    >>> least_meeting([frozenset({1, 2}), frozenset({2, 3}), frozenset({4})])
    2
    """
    every = frozenset().union(*sets)
    return _least(_smallest(sets), 0, len(every))


def _least(left: list[frozenset[int]], taken: int, known: int) -> int:
    """The least size with more elements, at most the ``known`` one."""
    check_time()
    if taken + _apart(left) >= known:
        return known
    if not left:
        return taken
    for element in sorted(left[0]):
        unmet = [one for one in left if element not in one]
        known = _least(unmet, taken + 1, known)
        without = [one - {element} for one in left]
        if not all(without):  # the last element of a set cannot be excluded
            break
        left = _smallest(without)
    return known


def _apart(sets: list[frozenset[int]]) -> int:
    """The number of disjoint sets found greedily, the smallest first: a lower bound."""
    seen: set[int] = set()
    count = 0
    for one in sets:
        if seen.isdisjoint(one):
            seen |= one
            count += 1
    return count


def _smallest(sets: Collection[frozenset[int]]) -> list[frozenset[int]]:
    kept: list[frozenset[int]] = []
    for one in sorted(set(sets), key=lambda x: (len(x), sorted(x))):
        if not any(other <= one for other in kept):
            kept.append(one)
    return kept


UNIT = "_unit"
"""The unknown that keeps a product from vanishing: UNIT · product = 1."""


class Ideal:
    """An ideal of ℚ[t_1, …, t_k]; zeros of the polynomials ``nonzero`` do not count.

    Attributes:
        nonzero: irreducible factors of these, each once.
        basis: a reduced Gröbner basis, primitive over ℤ; empty for the zero ideal.
        is_proved: otherwise the basis may be of a larger ideal, whose zeros are only some.
    """

    def __init__(self, ring: Parameters, nonzero: Iterable[fmpq_mpoly] = ()) -> None:
        self.ring = ring
        self.nonzero = tuple(factors(nonzero))
        names = [*ring.names, UNIT] if self.nonzero else list(ring.names)
        self._context = fmpz_mpoly_ctx.get(names, Ordering.degrevlex)
        self.basis = self._unit
        self.is_proved = True

    @property
    def _unit(self) -> list[fmpz_mpoly]:
        """UNIT · Π nonzero − 1, if there are nonzero polynomials."""
        if not self.nonzero:
            return []
        product = self._context.gen(self.variables - 1)
        for polynomial in self.nonzero:
            product *= self._integral(polynomial)
        return groebner.reduced([product - 1], self._context)

    def _with_basis(self, basis: list[fmpz_mpoly], is_proved: bool = True) -> Ideal:
        grown = Ideal(self.ring)
        grown.nonzero, grown._context = self.nonzero, self._context
        grown.basis, grown.is_proved = basis, is_proved
        return grown

    @property
    def variables(self) -> int:
        return int(self._context.nvars())

    def _integral(self, polynomial: fmpq_mpoly) -> fmpz_mpoly:
        terms = polynomial.to_dict()
        denominator = integral_scale(polynomial)
        tail = (0,) if self.nonzero else ()
        return self._context.from_dict({(*e, *tail): (a * denominator).p for e, a in terms.items()})

    def with_zeros(self, polynomials: Iterable[fmpq_mpoly]) -> Ideal:
        check_time()
        return self._with_generators([self._integral(polynomial) for polynomial in polynomials])

    def _with_generators(self, new: list[fmpz_mpoly]) -> Ideal:
        if groebner.is_small([*self.basis, *new]):
            new = [groebner.remainder(p, self.basis, self._context) for p in new]
        new = [p for p in new if p]
        if not new or self.is_everything:
            return self
        return self._with_basis(
            groebner.groebner_basis([*self.basis, *new], self._context), self.is_proved
        )

    def with_zeros_in_turn(
        self, polynomials: Iterable[fmpq_mpoly], generators: Iterable[fmpq_mpoly]
    ) -> tuple[Ideal, int]:
        """The ideal with further polynomials ≠ 0, and their number.

        If all leave no zeros, they are the fewest first ones that leave none. ``generators`` are of
        this ideal, without that of UNIT.
        """
        new = [self._integral(p) for p in polynomials]
        old = [*self._unit, *(self._integral(p) for p in generators)]
        basis, taken = groebner.grown_basis(self.basis, old, new, self._context)
        return self._with_basis(basis, self.is_proved), taken

    def with_values(self, values: Mapping[int, fmpq]) -> Ideal:
        """The ideal with x − c for unknowns x by place; substituting first shortens the basis."""
        new = []
        for place, value in values.items():
            new.append(self._context.gen(place) * value.q - value.p)
        for p in self.basis:
            total: dict[tuple[int, ...], fmpq] = {}
            for e, a in p.to_dict().items():
                term = fmpq(a)
                for place, value in values.items():
                    term *= value ** int(e[place])
                left = tuple(0 if place in values else int(k) for place, k in enumerate(e))
                total[left] = total.get(left, fmpq(0)) + term
            scale = _common([a.q for a in total.values()])
            new.append(self._context.from_dict({e: (a * scale).p for e, a in total.items() if a}))
        return self._with_basis([], self.is_proved)._with_generators(new)

    def with_zeros_unproved(self, polynomials: Iterable[fmpq_mpoly]) -> Ideal:
        """The ideal with further polynomials by msolve, perhaps a larger one, with only some of the
        zeros. Raises NotDecided if msolve is missing or late.
        """
        new = [self._integral(polynomial) for polynomial in polynomials]
        return self._with_basis(
            groebner.unproved_basis([*self.basis, *new], self._context), is_proved=False
        )

    def contains(self, polynomial: fmpq_mpoly) -> bool:
        return not groebner.remainder(self._integral(polynomial), self.basis, self._context)

    @property
    def is_everything(self) -> bool:
        return any(p.is_constant() for p in self.basis)

    @property
    def is_trivial(self) -> bool:
        return len(self.basis) <= bool(self.nonzero)

    @cached_property
    def closure(self) -> Ideal:
        """The elimination ideal without UNIT, with the zeros at which ``nonzero`` does not vanish.

        UNIT gets the weight N, by substituting its N-th power. As soon as no basis element has UNIT
        behind a leading monomial without it, the elements without UNIT are the basis: they alone
        reduce every polynomial without UNIT to 0.
        """
        elimination = Ideal(self.ring)
        if self.nonzero and self.dimension == 0:
            return elimination._with_basis(self._relations(elimination._context), self.is_proved)
        basis, weight = self.basis, 1
        while True:
            if self.nonzero:
                without = [p for p in basis if not groebner.leading(p)[-1]]
                degrees = [int(p.total_degree()) for p in without if p.degrees()[-1]]
            else:
                without, degrees = basis, []
            if not degrees:
                shorter = [p.project_to_context(elimination._context) for p in without]
                return elimination._with_basis(shorter, self.is_proved)
            weight = max(2 * weight, 1 + max(degrees))
            powers = [*[1] * (self.variables - 1), weight]
            raised = [p.inflate(powers) for p in self.basis]
            basis = groebner.groebner_basis(raised, self._context)

    def _relations(self, context: fmpz_mpoly_ctx) -> list[fmpz_mpoly]:
        """A Gröbner basis of the polynomials without UNIT in an ideal of dimension 0. A monomial
        without it that is a combination of smaller ones modulo the ideal leads a basis element
        (J.-C. Faugère, P. Gianni, D. Lazard, T. Mora, 1993).
        """
        size = len(self.ring.names)
        one = fmpq_mat(self.degree, 1)
        one[0, 0] = fmpq(1)  # 1 is the least monomial
        columns = {(0,) * size: one}
        echelon = _Echelon(self.degree)
        leading: list[groebner.Exponents] = []
        relations = []
        waiting = {(0,) * size}
        while waiting:
            check_time()
            e = min(waiting, key=groebner.degrevlex)
            waiting.remove(e)
            if any(groebner.divides(x, e) for x in leading):
                continue
            if any(e):
                i, lower = next(x for x in lowered(e) if x[1] in columns)
                columns[e] = self.multiplications[i] * columns[lower]
            terms = echelon.relation(e, columns[e])
            if terms is None:
                waiting.update(_raised(e))
                continue
            leading.append(e)
            scale = _common([a.q for a in terms.values()])
            relations.append(context.from_dict({m: (a * scale).p for m, a in terms.items()}))
        return groebner.reduced(relations, context)

    @property
    def without_unit(self) -> list[fmpq_mpoly]:
        size = len(self.ring.names)
        free = (p for p in self.basis if not any(p.degrees()[size:]))
        return [rational(p, self.ring) for p in free]

    @property
    def cleared(self) -> list[fmpq_mpoly]:
        """Polynomials without UNIT with the zeros of the ideal, up to zeros of ``nonzero``. They
        are its basis with 1/Π nonzero in place of UNIT, times a power of Π.
        """
        context = self.ring.context
        product = context.constant(fmpq(1))
        for factor in self.nonzero:
            product *= factor * integral_scale(factor)
        size = len(self.ring.names)
        cleared = []
        for p in self.basis:
            check_time()
            terms = [(tuple(map(int, e)), a) for e, a in p.to_dict().items()]
            highest = max(sum(e[size:]) for e, _ in terms)
            total = context.constant(fmpq(0))
            for e, a in terms:
                monomial = context.from_dict({e[:size]: fmpq(a)})
                total += monomial * product ** (highest - sum(e[size:]))
            if total:
                cleared.append(total)
        return cleared

    @cached_property
    def polynomials(self) -> list[fmpz_mpoly]:
        """Square-free polynomials without UNIT with the zeros of the ideal. They generate the
        radical in dimension 0.
        """
        return self.closure.square_free.basis

    @property
    def square_free(self) -> Ideal:
        """An ideal with the same zeros, the radical if they are finitely many. Then the square-free
        polynomials in one unknown each suffice (A. Seidenberg, *Constructions in algebra*, 1974).
        Otherwise its basis elements are square-free.
        """
        if self.dimension == 0:
            return self._with_generators([self._in_one(k) for k in range(self.variables)])
        parts = [without_multiples(p) for p in self.basis]
        if all(
            p.total_degree() == q.total_degree() for p, q in zip(parts, self.basis, strict=True)
        ):
            return self
        return self._with_generators(parts).square_free

    @cached_property
    def dimension(self) -> int:
        """The dimension of the set of its complex zeros; −1 if there are none. It is the largest
        number of unknowns such that each leading monomial has one of the others.
        """
        if self.is_everything:
            return -1
        return self.variables - least_meeting(self._supports)

    @property
    def _supports(self) -> set[frozenset[int]]:
        return {frozenset(i for i, k in enumerate(groebner.leading(p)) if k) for p in self.basis}

    @property
    def independent(self) -> tuple[int, ...] | None:
        """Algebraically independent unknowns, as many as the dimension, by leading monomials. None
        if every choice contains UNIT.
        """
        size = len(self.ring.names)
        left = {one for one in self._supports if size not in one}
        others = size - self.dimension
        if least_meeting(left) > others:
            return None
        chosen = []
        for i in range(size):
            without = {one - {i} for one in left}
            if all(without) and least_meeting(without) <= others:
                chosen.append(i)
                left = without
            else:
                others -= 1
                left = {one for one in left if i not in one}
        return tuple(chosen)

    @cached_property
    def degree(self) -> int:
        """The number of complex zeros with multiplicities, in dimension 0."""
        return len(self.monomials)

    @cached_property
    def monomials(self) -> list[groebner.Exponents]:
        """Monomials not divisible by leading ones, ascending: a basis of ℚ[t]/I in dimension 0."""
        first = [groebner.leading(p) for p in self.basis]
        monomials: list[groebner.Exponents] = []
        level = [(0,) * self.variables]
        while level:
            monomials += level
            following: dict[groebner.Exponents, None] = {}
            for e in level:
                check_time()
                for raised in _raised(e):
                    if not any(groebner.divides(x, raised) for x in first):
                        following[raised] = None
            level = list(following)
        return monomials

    @cached_property
    def multiplications(self) -> list[fmpq_mat]:
        """Multiplication by each unknown in ℚ[t]/I, in the basis ``monomials``, in dimension 0.

        A monomial m on the border is a leading one, whose remainder is in the basis of the ideal,
        or x m' with m' on the border: its remainder is x times that of m', whose monomials are
        smaller than m'. From the smallest monomial on, each remainder costs one product of a
        matrix and a column (J.-C. Faugère, P. Gianni, D. Lazard, T. Mora, 1993).
        """
        index = {e: k for k, e in enumerate(self.monomials)}
        size = len(index)
        matrices = [fmpq_mat(size, size) for _ in range(self.variables)]
        tails = {groebner.leading(p): _tail(p, index) for p in self.basis}
        columns: dict[groebner.Exponents, fmpq_mat] = {}
        places: dict[groebner.Exponents, list[tuple[int, int]]] = {}
        for e, k in index.items():
            for i, raised in enumerate(_raised(e)):
                places.setdefault(raised, []).append((i, k))
        for raised in sorted(places, key=groebner.degrevlex):
            check_time()
            if raised in index:
                column = _unit(index[raised], size)
            elif raised in tails:
                column = columns[raised] = tails[raised]
            else:
                i, lower = next(x for x in lowered(raised) if x[1] in columns)
                column = columns[raised] = matrices[i] * columns[lower]
            for i, k in places[raised]:
                for row in range(size):
                    matrices[i][row, k] = column[row, 0]
        return matrices

    def _in_one(self, variable: int) -> fmpz_mpoly:
        """The polynomial with simple zeros that are the values of one unknown."""
        characteristic = characteristic_polynomial(self.multiplications[variable])
        p = Polynomial.from_flint(characteristic).square_free().to_flint().numer()
        before, after = (0,) * variable, (0,) * (self.variables - variable - 1)
        terms = {(*before, k, *after): a for k, a in enumerate(p.coeffs()) if a}
        return self._context.from_dict(terms)


class _Echelon:
    """Independent columns in echelon form, with the combination of monomials that each is."""

    def __init__(self, size: int) -> None:
        self.size = size
        self._rows: dict[int, tuple[list[fmpq], dict[groebner.Exponents, fmpq]]] = {}

    def relation(
        self, e: groebner.Exponents, column: fmpq_mat
    ) -> dict[groebner.Exponents, fmpq] | None:
        """The monomial minus earlier ones, if dependent; None otherwise, and it is added."""
        rest = [column[k, 0] for k in range(self.size)]
        terms = {e: fmpq(1)}
        for k in range(self.size):
            if not rest[k]:
                continue
            if k not in self._rows:
                self._rows[k] = rest, terms
                return None
            others, known = self._rows[k]
            factor = rest[k] / others[k]
            rest = [a - factor * b for a, b in zip(rest, others, strict=True)]
            for m, a in known.items():
                terms[m] = terms.get(m, fmpq(0)) - factor * a
        return {m: a for m, a in terms.items() if a}


MOST_ROWS = 50


def characteristic_polynomial(matrix: fmpq_mat) -> fmpq_poly:
    check_time()
    work = methodcaller("charpoly")
    polynomial: fmpq_poly = work(matrix) if matrix.nrows() <= MOST_ROWS else apart(work, matrix)
    return polynomial


def integral_scale(polynomial: fmpq_mpoly) -> fmpz:
    return _common([a.q for a in polynomial.coeffs()])


def _common(denominators: Iterable[fmpz]) -> fmpz:
    common = fmpz(1)
    for q in denominators:
        common = common.lcm(q)
    return common


def rational(p: fmpz_mpoly, ring: Parameters) -> fmpq_mpoly:
    size = len(ring.names)
    terms = {tuple(map(int, e[:size])): fmpq(a) for e, a in p.to_dict().items()}
    return ring.context.from_dict(terms)


def without_multiples(p: Any) -> Any:
    product = p.context().constant(1)
    for factor, _ in p.factor_squarefree()[1]:
        product *= factor
    return product


def _raised(e: groebner.Exponents) -> list[groebner.Exponents]:
    return [(*e[:i], e[i] + 1, *e[i + 1 :]) for i in range(len(e))]


def lowered(e: groebner.Exponents) -> Iterator[tuple[int, groebner.Exponents]]:
    for i, exponent in enumerate(e):
        if exponent:
            yield i, (*e[:i], exponent - 1, *e[i + 1 :])


def _tail(p: fmpz_mpoly, index: Mapping[groebner.Exponents, int]) -> fmpq_mat:
    column = fmpq_mat(len(index), 1)
    scale = -fmpq(p.leading_coefficient())
    for exponents, a in list(p.to_dict().items()):
        key = tuple(int(x) for x in exponents)
        if key in index:
            column[index[key], 0] = fmpq(a) / scale
    return column


def _unit(k: int, size: int) -> fmpq_mat:
    column = fmpq_mat(size, 1)
    column[k, 0] = fmpq(1)
    return column
