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
    """The size of a smallest set that has an element of each of these.

    By branch and bound: some element of the smallest set is taken, those before it are not; sets
    that have no element in common take one each. None of the sets is empty.

    Raises:
        NotDecided: the time is not enough.

    >>> least_meeting([frozenset({1, 2}), frozenset({2, 3}), frozenset({4})])
    2
    """
    every = frozenset().union(*sets)
    return _least(_smallest(sets), 0, len(every))


def _least(left: list[frozenset[int]], taken: int, known: int) -> int:
    """The least size by taking more elements, or a ``known`` one that is not more."""
    check_time()
    if taken + _apart(left) >= known:
        return known
    if not left:
        return taken
    for element in sorted(left[0]):
        unmet = [one for one in left if element not in one]
        known = _least(unmet, taken + 1, known)
        without = [one - {element} for one in left]
        if not all(without):  # of that set it was the last one
            break
        left = _smallest(without)
    return known


def _apart(sets: list[frozenset[int]]) -> int:
    """How many sets without a common element are found, the smallest first."""
    seen: set[int] = set()
    count = 0
    for one in sets:
        if seen.isdisjoint(one):
            seen |= one
            count += 1
    return count


def _smallest(sets: Collection[frozenset[int]]) -> list[frozenset[int]]:
    """The sets that have no other one within, the smaller first."""
    kept: list[frozenset[int]] = []
    for one in sorted(set(sets), key=lambda x: (len(x), sorted(x))):
        if not any(other <= one for other in kept):
            kept.append(one)
    return kept


UNIT = "_unit"
"""The unknown that keeps a product from being zero: UNIT · product = 1."""


class Ideal:
    """An ideal of ℚ[t_1, …, t_k], with polynomials that are not to vanish.

    Args:
        ring: the parameters.
        nonzero: polynomials whose zeros do not count.

    Attributes:
        nonzero: their irreducible factors, each once.
        basis: a reduced Gröbner basis, primitive over ℤ; empty for the zero ideal.
        is_proved: whether it is one of the ideal; else of an ideal that is known to contain it, so
            that its zeros are zeros, and perhaps not all of them.
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
        """UNIT · Π nonzero − 1, where there is any."""
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
        """How many unknowns the basis has, that of ``nonzero`` among them."""
        return int(self._context.nvars())

    def _integral(self, polynomial: fmpq_mpoly) -> fmpz_mpoly:
        """A multiple of a polynomial over ℤ, in the context of the basis."""
        terms = polynomial.to_dict()
        denominator = integral_scale(polynomial)
        tail = (0,) if self.nonzero else ()
        return self._context.from_dict({(*e, *tail): (a * denominator).p for e, a in terms.items()})

    def with_zeros(self, polynomials: Iterable[fmpq_mpoly]) -> Ideal:
        """The ideal with further polynomials.

        Raises:
            NotDecided: the time for its basis is not enough.
        """
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
        """The ideal with further polynomials; where it is everything, with as few of them, the
        first ones, as make it everything.

        Args:
            polynomials: the further ones, none of them zero.
            generators: of this ideal, but for that with UNIT.

        Returns:
            the ideal, and of how many of the further polynomials it is.

        Raises:
            NotDecided: the time for its basis is not enough.
        """
        new = [self._integral(p) for p in polynomials]
        given = [*self._unit, *(self._integral(p) for p in generators)]
        basis, taken = groebner.grown_basis(self.basis, given, new, self._context)
        return self._with_basis(basis, self.is_proved), taken

    def with_values(self, values: Mapping[int, fmpq]) -> Ideal:
        """The ideal with x − c for some unknowns x, by their places, and numbers c. These are put
        into its basis before, which makes that shorter.

        Raises:
            NotDecided: the time for its basis is not enough.
        """
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
        """The same by msolve: an ideal that contains it, so that its zeros are zeros of it.

        Raises:
            NotDecided: msolve is not there, or its answer is not in time.
        """
        new = [self._integral(polynomial) for polynomial in polynomials]
        return self._with_basis(
            groebner.unproved_basis([*self.basis, *new], self._context), is_proved=False
        )

    def contains(self, polynomial: fmpq_mpoly) -> bool:
        """Whether a polynomial vanishes wherever the ideal does, with multiplicity."""
        return not groebner.remainder(self._integral(polynomial), self.basis, self._context)

    @property
    def is_everything(self) -> bool:
        """Whether the ideal has no zero, not even a complex one."""
        return any(p.is_constant() for p in self.basis)

    @property
    def is_trivial(self) -> bool:
        """Whether nothing is asked of the parameters."""
        return len(self.basis) <= bool(self.nonzero)

    @cached_property
    def closure(self) -> Ideal:
        """The ideal of all its polynomials without UNIT: each of its zeros at which ``nonzero``
        does not vanish is a zero of this one.

        UNIT counts for N degrees, by its N-th power in its place. Where no member of the basis has
        UNIT behind a leading monomial without it, those that have none at all are the basis: every
        polynomial without UNIT has a remainder 0 by them alone.

        Raises:
            NotDecided: the time is not enough.
        """
        alone = Ideal(self.ring)
        if self.nonzero and self.dimension == 0:
            return alone._with_basis(self._relations(alone._context), self.is_proved)
        basis, weight = self.basis, 1
        while True:
            if self.nonzero:
                without = [p for p in basis if not groebner.leading(p)[-1]]
                degrees = [int(p.total_degree()) for p in without if p.degrees()[-1]]
            else:
                without, degrees = basis, []
            if not degrees:
                shorter = [p.project_to_context(alone._context) for p in without]
                return alone._with_basis(shorter, self.is_proved)
            weight = max(2 * weight, 1 + max(degrees))
            powers = [*[1] * (self.variables - 1), weight]
            raised = [p.inflate(powers) for p in self.basis]
            basis = groebner.groebner_basis(raised, self._context)

    def _relations(self, context: fmpz_mpoly_ctx) -> list[fmpz_mpoly]:
        """The polynomials without UNIT of an ideal of dimension 0, as a Gröbner basis: of the
        monomials without it, the smallest first, each that is a combination of smaller ones modulo
        the ideal is the leading one of a member (J.-C. Faugère, P. Gianni, D. Lazard, T. Mora,
        1993).

        Raises:
            NotDecided: the time is not enough.
        """
        size = len(self.ring.names)
        one = fmpq_mat(self.degree, 1)
        one[0, 0] = fmpq(1)  # the least monomial is 1
        columns = {(0,) * size: one}
        echelon = _Echelon(self.degree)
        leading: list[groebner.Exponents] = []
        found = []
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
            found.append(context.from_dict({m: (a * scale).p for m, a in terms.items()}))
        return groebner.reduced(found, context)

    @property
    def without_unit(self) -> list[fmpq_mpoly]:
        """The polynomials of the basis that have no UNIT."""
        size = len(self.ring.names)
        free = (p for p in self.basis if not any(p.degrees()[size:]))
        return [rational(p, self.ring) for p in free]

    @property
    def cleared(self) -> list[fmpq_mpoly]:
        """Polynomials without UNIT whose zeros are those of the ideal, but for zeros of
        ``nonzero``: its basis with 1/Π nonzero in place of UNIT, times a power of Π.

        Raises:
            NotDecided: the time is not enough.
        """
        context = self.ring.context
        product = context.constant(fmpq(1))
        for factor in self.nonzero:
            product *= factor * integral_scale(factor)
        size = len(self.ring.names)
        found = []
        for p in self.basis:
            check_time()
            terms = [(tuple(map(int, e)), a) for e, a in p.to_dict().items()]
            highest = max(sum(e[size:]) for e, _ in terms)
            total = context.constant(fmpq(0))
            for e, a in terms:
                monomial = context.from_dict({e[:size]: fmpq(a)})
                total += monomial * product ** (highest - sum(e[size:]))
            if total:
                found.append(total)
        return found

    @cached_property
    def polynomials(self) -> list[fmpz_mpoly]:
        """Polynomials without UNIT whose zeros are those of the ideal, but for zeros of
        ``nonzero``; none of them has a multiple factor, and where there are finitely many zeros
        they generate all polynomials that vanish there.

        Raises:
            NotDecided: the time is not enough.
        """
        return self.closure.square_free.basis

    @property
    def square_free(self) -> Ideal:
        """An ideal with the same zeros, where there are finitely many the radical: the square-free
        polynomials in one unknown each are then enough (A. Seidenberg, *Constructions in algebra*,
        1974). Otherwise the polynomials of its basis have no multiple factors.

        Raises:
            NotDecided: the time is not enough.
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
        """The dimension of the set of its complex zeros; −1 where there are none.

        It is the largest number of unknowns of which no monomial is a leading one: each leading
        monomial has one of the others.

        Raises:
            NotDecided: the time is not enough.
        """
        if self.is_everything:
            return -1
        return self.variables - least_meeting(self._supports)

    @property
    def _supports(self) -> set[frozenset[int]]:
        """The unknowns of each leading monomial."""
        return {frozenset(i for i, k in enumerate(groebner.leading(p)) if k) for p in self.basis}

    @property
    def independent(self) -> tuple[int, ...] | None:
        """As many unknowns as its dimension of which no monomial is a leading one, so that nothing
        relates them: the first ones; None where UNIT is among all that there are so many of.

        Raises:
            NotDecided: the time is not enough.
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
        """How many complex zeros there are, with multiplicities; the ideal has dimension 0."""
        return len(self.monomials)

    @cached_property
    def monomials(self) -> list[groebner.Exponents]:
        """Those that no leading one divides, the smallest first: a basis of ℚ[t]/ideal, which has
        dimension 0.

        Raises:
            NotDecided: the time is not enough.
        """
        first = [groebner.leading(p) for p in self.basis]
        found: list[groebner.Exponents] = []
        level = [(0,) * self.variables]
        while level:
            found += level
            following: dict[groebner.Exponents, None] = {}
            for e in level:
                check_time()
                for raised in _raised(e):
                    if not any(groebner.divides(x, raised) for x in first):
                        following[raised] = None
            level = list(following)
        return found

    @cached_property
    def multiplications(self) -> list[fmpq_mat]:
        """The algebra ℚ[t]/ideal: multiplication by each unknown as a matrix of its columns, in
        the basis of ``monomials``; the ideal has dimension 0.

        A monomial m on the border is a leading one, whose remainder is in the basis of the ideal,
        or x m' with m' on the border: its remainder is x times that of m', whose monomials are
        smaller than m'. So the border is done from the smallest monomial on, and each remainder
        costs one product of a matrix and a column (J.-C. Faugère, P. Gianni, D. Lazard, T. Mora,
        1993).

        Raises:
            NotDecided: the time is not enough.
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
        """The polynomial in one unknown whose simple zeros are its values at the zeros."""
        found = characteristic_polynomial(self.multiplications[variable])
        p = Polynomial.from_flint(found).square_free().to_flint().numer()
        before, after = (0,) * variable, (0,) * (self.variables - variable - 1)
        terms = {(*before, k, *after): a for k, a in enumerate(p.coeffs()) if a}
        return self._context.from_dict(terms)


class _Echelon:
    """Columns that are independent, in echelon form, each a combination of monomials.

    Args:
        size: the number of rows.
    """

    def __init__(self, size: int) -> None:
        self.size = size
        self._rows: dict[int, tuple[list[fmpq], dict[groebner.Exponents, fmpq]]] = {}

    def relation(
        self, e: groebner.Exponents, column: fmpq_mat
    ) -> dict[groebner.Exponents, fmpq] | None:
        """The monomial as a combination of those before it, as a polynomial that is zero; None, and
        it is one more, where it is independent of them.
        """
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
"""Characteristic polynomials of larger matrices are made in a process of their own."""


def characteristic_polynomial(matrix: fmpq_mat) -> fmpq_poly:
    """Of a matrix of rational numbers.

    Raises:
        NotDecided: the time is not enough.
    """
    check_time()
    work = methodcaller("charpoly")
    found: fmpq_poly = work(matrix) if matrix.nrows() <= MOST_ROWS else apart(work, matrix)
    return found


def integral_scale(polynomial: fmpq_mpoly) -> fmpz:
    """The common denominator of the coefficients."""
    return _common([a.q for a in polynomial.coeffs()])


def _common(denominators: Iterable[fmpz]) -> fmpz:
    common = fmpz(1)
    for q in denominators:
        common = common.lcm(q)
    return common


def rational(p: fmpz_mpoly, ring: Parameters) -> fmpq_mpoly:
    """The same polynomial over ℚ, in the parameters; it has no UNIT."""
    size = len(ring.names)
    terms = {tuple(map(int, e[:size])): fmpq(a) for e, a in p.to_dict().items()}
    return ring.context.from_dict(terms)


def without_multiples(p: Any) -> Any:
    """The square-free part of a polynomial in several variables."""
    product = p.context().constant(1)
    for factor, _ in p.factor_squarefree()[1]:
        product *= factor
    return product


def _raised(e: groebner.Exponents) -> list[groebner.Exponents]:
    """A monomial times each unknown."""
    return [(*e[:i], e[i] + 1, *e[i + 1 :]) for i in range(len(e))]


def lowered(e: groebner.Exponents) -> Iterator[tuple[int, groebner.Exponents]]:
    """A monomial without each of its unknowns."""
    for i, exponent in enumerate(e):
        if exponent:
            yield i, (*e[:i], exponent - 1, *e[i + 1 :])


def _tail(p: fmpz_mpoly, index: Mapping[groebner.Exponents, int]) -> fmpq_mat:
    """What the leading monomial is equal to modulo p, as a column."""
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
