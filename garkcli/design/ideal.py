"""Ideals of polynomials over ℚ by Gröbner bases, made in python-flint within limits."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from copy import copy
from typing import Any, TypeAlias

from flint import (
    Ordering,
    fmpq,
    fmpq_mat,
    fmpq_mpoly,
    fmpz,
    fmpz_mpoly,
    fmpz_mpoly_ctx,
    fmpz_mpoly_vec,
)

from garkcli.design.covering import least_meeting
from garkcli.design.groebner import (
    Exponents,
    divides,
    groebner_basis,
    groebner_basis_apart,
    leading,
    unproved_basis,
)
from garkcli.exact.parametric import Parameters

FEW_TERMS = 150
"""Of all polynomials together, for which no process is started."""
UNIT = "_unit"
"""The unknown that keeps a product from being zero: UNIT · product = 1."""


class Ideal:
    """An ideal of ℚ[t_1, …, t_k], with polynomials that are not to vanish.

    Args:
        ring: the parameters.
        nonzero: polynomials whose zeros do not count.
        deadline: the reading of ``time.monotonic`` at which bases are given up; None for never.

    Attributes:
        nonzero: as given.
        deadline: as given.
        basis: a reduced Gröbner basis, primitive over ℤ; empty for the zero ideal.
        is_proved: whether it is one of the ideal; else of an ideal that is known to contain it, so
            that its zeros are zeros, and perhaps not all of them.
    """

    def __init__(
        self, ring: Parameters, nonzero: Sequence[fmpq_mpoly] = (), deadline: float | None = None
    ) -> None:
        self.ring = ring
        self.nonzero = tuple(nonzero)
        self.deadline = deadline
        self._has_unit = bool(nonzero)
        names = [*ring.names, UNIT] if nonzero else list(ring.names)
        self._context = fmpz_mpoly_ctx.get(names, Ordering.degrevlex)
        self.basis: list[fmpz_mpoly] = []
        self.is_proved = True
        if nonzero:
            product = self._context.gen(len(names) - 1)
            for polynomial in nonzero:
                product *= self._integral(polynomial)
            self.basis = [product - 1]

    @property
    def variables(self) -> int:
        """How many unknowns the basis has, that of ``nonzero`` among them."""
        return int(self._context.nvars())

    def _integral(self, polynomial: fmpq_mpoly) -> fmpz_mpoly:
        """A multiple of a polynomial over ℤ, in the context of the basis."""
        terms = polynomial.to_dict()
        denominator = integral_scale(polynomial)
        tail = (0,) if self._has_unit else ()
        whole = {(*e, *tail): (a * denominator).p for e, a in terms.items()}
        return self._context.from_dict(whole)

    def until(self, deadline: float | None) -> Ideal:
        """The same ideal with another deadline."""
        same = copy(self)
        same.deadline = deadline
        return same

    def with_zeros(self, polynomials: Iterable[fmpq_mpoly]) -> Ideal:
        """The ideal with further polynomials.

        Raises:
            NotDecided: its basis is beyond the limits.
        """
        new = []
        for polynomial in polynomials:
            rest = self._remainder(self._integral(polynomial))
            if rest:
                new.append(rest)
        if not new or self.is_everything:
            return self
        return self._with_basis(groebner_basis([*self.basis, *new], self._context, self.deadline))

    def with_zeros_apart(self, polynomials: Sequence[fmpq_mpoly]) -> Ideal:
        """The same; where polynomials have many terms all of it in a process, which the deadline
        ends.

        Raises:
            NotDecided: its basis is beyond the limits.
        """
        size = sum(len(p.to_dict()) for p in polynomials)
        if self.deadline is None or size <= FEW_TERMS:
            return self.with_zeros(polynomials)
        new = [self._integral(p) for p in polynomials if p]
        return self._with_basis(
            groebner_basis_apart([*self.basis, *new], self._context, self.deadline)
        )

    def _with_basis(self, basis: list[fmpz_mpoly]) -> Ideal:
        grown = copy(self)
        grown.basis = basis
        return grown

    def with_zeros_unproved(
        self, polynomials: Iterable[fmpq_mpoly], deadline: float | None
    ) -> Ideal:
        """The same by msolve: an ideal that contains it, so that its zeros are zeros of it.

        Raises:
            NotDecided: msolve is not there, or its answer is not in time.
        """
        new = [self._integral(polynomial) for polynomial in polynomials]
        grown = copy(self)
        grown.basis = unproved_basis([*self.basis, *new], self._context, deadline)
        grown.is_proved = False
        return grown

    def _remainder(self, polynomial: fmpz_mpoly) -> fmpz_mpoly:
        if not self.basis or not polynomial:
            return polynomial
        vector = fmpz_mpoly_vec(self.basis, self._context)
        dividend: Any = polynomial  # the types of python-flint lack the method
        rest: fmpz_mpoly = dividend.reduction_primitive_part(vector)
        return rest

    def contains(self, polynomial: fmpq_mpoly) -> bool:
        """Whether a polynomial vanishes wherever the ideal does, with multiplicity."""
        return not self._remainder(self._integral(polynomial))

    @property
    def is_everything(self) -> bool:
        """Whether the ideal has no zero, not even a complex one."""
        return any(p.is_constant() for p in self.basis)

    @property
    def is_trivial(self) -> bool:
        """Whether nothing is asked of the parameters."""
        return len(self.basis) <= self._has_unit

    @property
    def polynomials(self) -> list[fmpz_mpoly]:
        """The basis without what keeps denominators from vanishing.

        Where the ideal has UNIT as a polynomial in the others, as it has beside radicals, that
        stands in its place, and these polynomials generate all that have no UNIT.
        """
        if not self._has_unit:
            return self.basis
        unit = self.variables - 1
        for p in self.basis:
            scale = _alone(p, unit)
            if scale:
                instead = scale * self._context.gen(unit) - p
                others = [q for q in self.basis if q is not p]
                found = [_put(q, unit, instead, scale) for q in others]
                return [q for q in found if q]
        return [p for p in self.basis if not p.degrees()[unit]]

    @property
    def dimension(self) -> int:
        """The dimension of the set of its complex zeros; −1 where there are none.

        It is the largest number of unknowns of which no monomial is a leading one: each leading
        monomial has one of the others.
        """
        if self.is_everything:
            return -1
        supports = {frozenset(_support(p)) for p in self.basis}
        return self.variables - least_meeting(supports)

    @property
    def degree(self) -> int:
        """How many complex zeros there are, with multiplicities; the ideal has dimension 0."""
        first = [leading(p) for p in self.basis]
        return len(_standard(first, self.variables))

    def quotient(self) -> list[fmpq_mat]:
        """The algebra ℚ[t]/ideal: multiplication by each unknown as a matrix of its columns.

        The ideal has dimension 0.
        """
        monomials = _standard([leading(p) for p in self.basis], self.variables)
        index = {e: k for k, e in enumerate(monomials)}
        lower = [_monic(p) for p in self.basis]
        matrices = []
        for variable in range(self.variables):
            columns = []
            for e in monomials:
                raised = (*e[:variable], e[variable] + 1, *e[variable + 1 :])
                rest = _normal_form({raised: fmpq(1)}, lower)
                column = [fmpq(0)] * len(monomials)
                for exponents, a in rest.items():
                    column[index[exponents]] = a
                columns.append(column)
            matrices.append(fmpq_mat(columns).transpose())
        return matrices


def _alone(p: fmpz_mpoly, variable: int) -> int:
    """The coefficient of an unknown in p if no other monomial has it; else 0."""
    having = [(e, a) for e, a in p.to_dict().items() if e[variable]]
    if len(having) != 1:
        return 0
    [(exponents, a)] = having
    return int(a) if sum(exponents) == 1 else 0


def _put(p: fmpz_mpoly, variable: int, numerator: fmpz_mpoly, denominator: int) -> fmpz_mpoly:
    """A primitive multiple of p with numerator/denominator in place of an unknown."""
    context = p.context()
    degree = p.degrees()[variable]
    total = context.constant(0)
    for exponents, a in p.to_dict().items():
        k = int(exponents[variable])
        others = (*exponents[:variable], 0, *exponents[variable + 1 :])
        term = context.from_dict({others: a})
        total += term * numerator**k * denominator ** (degree - k)
    if not total:
        return total
    primitive: fmpz_mpoly = total.primitive()[1]
    return primitive if primitive.leading_coefficient() > 0 else -primitive


def integral_scale(polynomial: fmpq_mpoly) -> fmpz:
    """The common denominator of the coefficients."""
    denominator = fmpz(1)
    for a in polynomial.to_dict().values():
        denominator = denominator.lcm(a.q)
    return denominator


_Terms: TypeAlias = dict[Exponents, fmpq]


def _support(p: fmpz_mpoly) -> set[int]:
    """The unknowns in the leading monomial."""
    return {i for i, exponent in enumerate(leading(p)) if exponent}


def _monic(p: fmpz_mpoly) -> tuple[Exponents, _Terms]:
    """The leading monomial, and what it is equal to modulo p."""
    first = leading(p)
    scale = fmpq(p.leading_coefficient())
    rest = {}
    for exponents, a in p.to_dict().items():
        key = tuple(int(x) for x in exponents)
        if key != first:
            rest[key] = -fmpq(a) / scale
    return first, rest


def _standard(first: Sequence[Exponents], variables: int) -> list[Exponents]:
    """The monomials that no leading one divides, finitely many, the constant first."""
    found: list[Exponents] = []
    level = [(0,) * variables]
    while level:
        found += level
        following: dict[Exponents, None] = {}
        for e in level:
            for i in range(variables):
                raised = (*e[:i], e[i] + 1, *e[i + 1 :])
                if not any(divides(x, raised) for x in first):
                    following[raised] = None
        level = list(following)
    return found


def _normal_form(terms: _Terms, lower: Sequence[tuple[Exponents, _Terms]]) -> _Terms:
    """The remainder of a polynomial on division by a monic Gröbner basis."""
    rest: _Terms = {}
    while terms:
        exponents, a = terms.popitem()
        for first, instead in lower:
            if divides(first, exponents):
                shift = tuple(x - y for x, y in zip(exponents, first, strict=True))
                for e, b in instead.items():
                    place = tuple(x + y for x, y in zip(e, shift, strict=True))
                    _accumulate(terms, place, a * b)
                break
        else:
            _accumulate(rest, exponents, a)
    return rest


def _accumulate(terms: _Terms, place: Exponents, a: fmpq) -> None:
    total = terms.get(place, fmpq(0)) + a
    if total:
        terms[place] = total
    else:
        terms.pop(place, None)
