"""One member of a family: its tableau, whether it is admitted, and its stability."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import suppress
from typing import Any, Literal, TypeAlias, cast

from flint import fmpq, fmpq_mpoly

from garkcli.deadline import check_time
from garkcli.design.solutions import Solution, value_at
from garkcli.errors import MethodError, NotDecided, VanishingDenominator
from garkcli.exact.cells import Interval, has, where_not_negative
from garkcli.exact.field import ONE, ZERO, Algebraic, Number
from garkcli.exact.parametric import Parameters, Parametric, fraction, unknowns_of
from garkcli.exact.polynomial import Polynomial, in_one
from garkcli.exact.roots import RealRoot, number_of, sign, sign_at
from garkcli.frozen import replace
from garkcli.stability.linear import is_a_stable, is_l_stable, stability_function
from garkcli.stability.oscillator import usual_oscillator
from garkcli.tableau.conjugate import conjugate
from garkcli.tableau.embedded import Further
from garkcli.tableau.family import OSCILLATING, Family, Radical, RequiredStability
from garkcli.tableau.forms import pair
from garkcli.tableau.tableau import Tableau

Whose: TypeAlias = Literal["method", "conjugate", "pair"]
TABLEAUS: dict[Whose, Callable[[Tableau], Tableau]] = {
    "method": lambda tableau: tableau,
    "conjugate": conjugate,
    "pair": pair,
}


def member(tableau: Tableau, ring: Parameters, values: Mapping[str, Number]) -> Tableau:
    """The tableau at values of one field; VanishingDenominator if a denominator is zero there."""
    return tableau.changed(_At([values[name] for name in ring.names]).number)


def further_member(further: Further, ring: Parameters, values: Mapping[str, Number]) -> Further:
    return further.changed(_At([values[name] for name in ring.names]).number)


def value_of(polynomial: fmpq_mpoly, ring: Parameters, values: Mapping[str, Number]) -> Number:
    return _At([values[name] for name in ring.names]).polynomial(polynomial)


class _At:
    def __init__(self, values: list[Number]) -> None:
        self.values = values
        functions = [x for x in cast("list[object]", values) if isinstance(x, Parametric)]
        self._ring = functions[0].ring if functions else None
        self._monomials = None if self._ring is None else _monomials(values, self._ring)

    def number(self, x: object) -> Number:
        if not isinstance(x, Parametric):
            return cast("fmpq", x)
        denominator = self.polynomial(x.denominator)
        if not denominator:
            raise no_method(f"it is that of {x}")
        return self.polynomial(x.numerator) / denominator

    def polynomial(self, polynomial: fmpq_mpoly) -> Number:
        check_time()
        if self._ring is not None and self._monomials is not None:
            # the values are monomials in parameters of another ring
            composed = polynomial.compose(*self._monomials, ctx=self._ring.context)
            return cast("Number", self._ring.quotient(composed, self._ring.constant(fmpq(1))))
        total: Number = ZERO
        for exponents, a in polynomial.to_dict().items():
            term: Number = ONE * fmpq(a)
            for value, exponent in zip(self.values, exponents, strict=True):
                for _ in range(int(exponent)):
                    term = term * value
            total = total + term
        return total


def no_method(which: str) -> VanishingDenominator:
    return VanishingDenominator("a denominator is zero: no method has these values", which)


def _monomials(values: list[Number], ring: Parameters) -> list[fmpq_mpoly] | None:
    """Values as polynomials with one term each; None if one is no such polynomial."""
    monomials = []
    for x in values:
        if not isinstance(x, (fmpq, Parametric)):
            return None
        numerator, denominator = fraction(x, ring)
        if len(numerator) > 1 or not denominator.is_one():
            return None
        monomials.append(numerator)
    return monomials


def restricted(
    family: Family,
    ring: Parameters,
    values: Mapping[str, Any],
    parameters: Sequence[str],
    radicals: Sequence[Radical],
) -> Family:
    """The methods whose unknowns have ``values``: numbers, or functions of fewer unknowns.
    ``parameters`` and ``radicals`` are among the fewer, with relations in any ring.
    """

    def moved(polynomials: Sequence[fmpq_mpoly]) -> tuple[fmpq_mpoly, ...]:
        # a quotient has the sign of the product
        quotients = (fraction(value_of(p, family.ring, values), ring) for p in polynomials)
        return tuple(p * q for p, q in quotients)

    return replace(
        family,
        tableau=member(family.tableau, family.ring, values),
        ring=ring,
        parameters=tuple(parameters),
        ranges={name: family.ranges.get(name, (None, None)) for name in parameters},
        radicals=tuple(
            replace(x, relation=x.relation.project_to_context(ring.context)) for x in radicals
        ),
        relations=moved(family.relations),
        nonzero=moved(family.nonzero),
        positive=moved(family.positive),
        not_negative=moved(family.not_negative),
    )


def not_negative(family: Family) -> Iterator[fmpq_mpoly]:
    """Polynomials that are at least 0 at every method of a family."""
    gens = dict(zip(family.ring.names, family.ring.context.gens(), strict=True))
    for radical in family.radicals:
        if radical.is_even:
            yield gens[radical.name]
    for name, (least, greatest) in family.ranges.items():
        if least is not None:
            yield gens[name] - least
        if greatest is not None:
            yield greatest - gens[name]
    yield from family.not_negative


def admitted(family: Family, name: str) -> tuple[Interval, ...]:
    """The numbers that the constraints on an unknown alone allow."""
    index = family.ring.names.index(name)
    univariate = (p for p in not_negative(family) if unknowns_of(p) == [index])
    return where_not_negative([in_one(p, index) for p in univariate])


def is_admissible(family: Family, solution: Solution, root: RealRoot) -> bool:
    """Whether even roots are not negative, parameters within ranges, and wanted signs right."""
    for radical in family.radicals:
        value = solution.values[radical.name]
        if radical.meant is not None and value_at(value, root) != radical.meant:
            return False

    def sign_of(polynomial: fmpq_mpoly) -> int:
        value = value_of(polynomial, family.ring, solution.values)
        if isinstance(value, Algebraic):
            return sign_at(Polynomial.from_flint(value.poly), root)
        return sign(value)

    is_positive = all(sign_of(p) > 0 for p in family.positive)
    return is_positive and all(sign_of(p) >= 0 for p in not_negative(family))


def is_in(intervals: Sequence[Interval], value: Number, root: RealRoot) -> bool:
    """Whether an element of ℚ[u]/modulus, at a real root u, is in a union of intervals."""
    return has(intervals, value_at(value, root))


MOST_DEGREE = 6


def method_at(
    tableau: Tableau, ring: Parameters, solution: Solution, root: RealRoot
) -> Tableau | None:
    """The method at a root; None if its field is too large. Raises ZeroDivisionError at a pole."""
    u = number_of(root, MOST_DEGREE)
    if u is None:
        return None
    values = {
        name: Polynomial.from_flint(x.poly)(u) if isinstance(x, Algebraic) else x
        for name, x in solution.values.items()
    }
    return member(tableau, ring, values)


def refuse_levels(family: Family) -> None:
    """Raises MethodError for bounds on objectives, which only a search meets."""
    for key, bound in family.levels:
        name = key.removeprefix("-")
        message = f"design: {name}: {bound} needs a search"
        raise MethodError(message, "add --search N --minimise WHAT", code="wanted-without-meaning")


def is_as_stable(family: Family, whose: Whose, solution: Solution, root: RealRoot) -> bool | None:
    """Whether a method is as stable as wanted; None if undecided."""
    if not family.stable:
        return True
    with suppress(NotDecided):
        for wanted in family.stable:
            tableau = method_at(family.tested(wanted).tableau, family.ring, solution, root)
            if tableau is None:
                return None
            if not is_stable(wanted, TABLEAUS[whose](tableau)):
                return False
        return True
    return None


def is_stable(wanted: RequiredStability, tableau: Tableau) -> bool:
    """Whether a method has a kind of stability; False if it is not applicable."""
    if wanted.kind in OSCILLATING:
        oscillator = usual_oscillator(tableau)
        if oscillator is None:
            return False
        return oscillator.is_p_stable if wanted.kind == "p-stable" else oscillator.is_i_stable
    R = stability_function(tableau, shares_of(tableau, wanted.colour))
    return is_l_stable(R) if wanted.kind == "l-stable" else is_a_stable(R)


def shares_of(tableau: Tableau, colour: int | None) -> list[Number]:
    """The λ of each colour of the linear test equation: 1 for all, or for one and 0 for others."""
    return [ONE if colour in (None, l) else ZERO for l in range(tableau.size)]
