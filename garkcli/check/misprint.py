"""The printed number that keeps a method of another kind, such as a Rosenbrock method, from an
order. Its tableau has the number in several entries, so that no entry alone is wrong.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from typing import TYPE_CHECKING, Protocol

from flint import fmpq

from garkcli.frozen import replace
from garkcli.methodfile.expectations import highest_order
from garkcli.order.meant import AnyTableau, meant, within_digits
from garkcli.order.repair import GAIN, HIGHEST_LOW

if TYPE_CHECKING:
    from garkcli.methodfile.build import MethodFile
    from garkcli.methodfile.printed import Printed
    from garkcli.order.certificate import Witness
    from garkcli.order.suspects import SuspectedNumber

FINE = fmpq(1, 10**30)
"""The radius of numbers that are taken as exact."""
SHORT = 10**6
"""Denominators of fractions that stand for a value known to ``FINE``."""


class FoundOrder(Protocol):
    """The order of a method, and a tree whose condition fails if one is known."""

    @property
    def order(self) -> int: ...
    @property
    def witness(self) -> Witness | None: ...


def misprints(
    method: MethodFile, order: FoundOrder, declared: int | None = None
) -> tuple[SuspectedNumber, ...]:
    """Returns the numbers of which one seems wrong: another value gives the claimed or declared
    order or, without one, two orders more. Only those that give the highest order are returned.
    """
    claimed = declared or highest_order(method.claims, ["order"])
    goal = claimed or order.order + GAIN
    is_searched = order.witness is not None and order.order < goal
    if not is_searched or not (claimed or order.order <= HIGHEST_LOW):
        return ()
    # imported here: few methods miss an order
    from garkcli.order.blame import FEW_CONDITIONS_UNASKED, MAX_CONDITIONS
    from garkcli.order.conditions import count_conditions
    from garkcli.order.rounded import RoundedTableau
    from garkcli.order.suspects import suspected_numbers

    most = MAX_CONDITIONS if claimed else FEW_CONDITIONS_UNASKED
    if count_conditions(method.tableau, goal) > most:
        return ()
    rounded = _rounded(method)
    if not isinstance(rounded, RoundedTableau):
        return ()
    found = [x for x in suspected_numbers(rounded, goal, goal + 1) if x.order >= goal]
    best = max((x.order for x in found), default=0)
    return tuple(_shortened(x) for x in found if x.order == best)


def _rounded(method: MethodFile) -> AnyTableau | None:
    """Returns the method within its tolerance, or within the digits of its decimals."""
    if method.tolerance:
        return meant(method.tableau, method.tolerance, method.further)
    return within_digits(method.tableau, _digits)


def _digits(printed: Printed) -> Sequence[fmpq]:
    from garkcli.methodfile.printed import left_open

    return [max(radius, FINE) for radius in left_open(printed)]


def _shortened(number: SuspectedNumber) -> SuspectedNumber:
    """Returns the number with a short fraction for its new value, if one is near enough."""
    new = Fraction(int(number.new.p), int(number.new.q))
    short = new.limit_denominator(SHORT)
    near = abs(short - new) <= 10 * Fraction(int(FINE.p), int(FINE.q))
    value = fmpq(short.numerator, short.denominator) if near else number.new
    return replace(number, new=value)
