"""Values of unknowns next to rounded numbers: of one method within the rounding.

Conditions of a family with rounded numbers contradict each other in their last digits. gark first
seeks values that meet them up to the rounding. From these it recovers one method, its numbers
within the tolerance and its unknowns near the values (``order.recovering``). At its numbers, known
to many bits, it solves the conditions again: then residuals and pivots are clearly zero or not.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from functools import cached_property
from typing import TYPE_CHECKING, Any, Protocol

from flint import arb, ctx, fmpq, fmpq_mpoly

from garkcli.deadline import check_time, within
from garkcli.design.conditions import FamilyConditions
from garkcli.design.member import TABLEAUS, Whose, member
from garkcli.design.rounded_system import RoundedSystem, Solved
from garkcli.design.search.least_squares import least_squares
from garkcli.design.search.search import Search
from garkcli.errors import MethodError, MethodFileError, NotDecided
from garkcli.exact.display import to_float
from garkcli.exact.enclosing import midpoint
from garkcli.exact.field import Number
from garkcli.exact.parametric import fraction
from garkcli.exact.rounding import in_decimals
from garkcli.frozen import Frozen
from garkcli.ntrees.tree import Tree
from garkcli.order.admissible import elementary_weight
from garkcli.order.certificate import DEFAULT_LIMIT
from garkcli.order.meant import derived
from garkcli.tableau.embedded import with_weights
from garkcli.tableau.family import Family
from garkcli.tableau.tableau import Tableau
from garkcli.upward import Shown

if TYPE_CHECKING:
    from garkcli.order.rounded import RoundedTableau

BITS = 300
STARTS = 100
TRIES = 20
"""Choices of free unknowns tried for the wanted ranges and signs."""
MOST = 5
WIDTHS = (30, 300, 3000, 30_000)
"""Tolerances within which values of unknowns may move."""
WIDEST = fmpq(1, 100)
LOOSE = 10_000
"""Largest residual, in tolerances, before a method is recovered."""
GRAINS = 1024
"""Residuals of at most so many grains are zeros when values are solved for."""
SAME = 1e-6
"""Solutions that differ by at most this in each unknown are one."""


class Rounding(Protocol):
    """A family with rounded numbers."""

    @property
    def family(self) -> Family:
        """The family as printed."""

    @property
    def tolerance(self) -> fmpq:
        """The rounding."""

    def at(self, shifts: Sequence[fmpq], bits: int) -> Family:
        """The family with its numbers shifted by shares of the tolerance; no shifts for none."""

    def generic(self) -> Family:
        """The family with indeterminates for known numbers, so that statements hold for all of
        these. Raises MethodFileError if it is too large.
        """

    def filled(self, values: Mapping[str, fmpq], digits: int, width: fmpq) -> Any:
        """The family with values that may move by ``width``: ``rounded``, and ``shifts`` of its
        numbers.
        """


class ValuesWithin(Frozen, eq=False):
    """Values of the unknowns in one method within the tolerance.

    Attributes:
        values: each to many digits.
        directions: derivatives of the others in the free ones, which determine them if linear.
        free: the unknowns that are free around it.
        distance: the largest change of a number of the file, in units of the tolerance.
        is_admitted: whether it has the wanted ranges and signs.
        digits: decimal places in which the conditions are 0 at the method.
        order: the highest order found for the method.
        embedded: the order of the embedded weights.
    """

    values: Mapping[str, fmpq]
    directions: Mapping[str, Mapping[str, fmpq]]
    free: tuple[str, ...]
    distance: float
    is_admitted: bool
    digits: int
    order: int
    embedded: int | None = None

    def text(self, name: str, digits: int) -> str:
        """The value of an unknown, rounded to so many decimals."""
        return in_decimals(self.values[name], digits)

    @property
    def dimension(self) -> int:
        """The dimension of the solutions around it."""
        return len(self.free)


def with_more(found: list[ValuesWithin], values: ValuesWithin) -> list[ValuesWithin]:
    """The solutions with one more, if it is new; admitted ones replace others."""
    if values.is_admitted:
        found = [x for x in found if x.is_admitted]
    elif any(x.is_admitted for x in found):
        return found
    if any(x.dimension for x in found):
        return found
    if values.dimension:
        return [values]
    for other in found:
        if all(abs(to_float(values.values[k] - x)) <= SAME for k, x in other.values.items()):
            return found
    return [*found, values]


class StepWithin(Frozen, eq=False):
    """Results for one order.

    Attributes:
        order: the order.
        found: methods with the order.
        is_linear: whether the conditions are linear in the unknowns.
        printed: the dimension of the solutions for the printed digits if linear, -1 without any.
        left: the residual of the conditions as printed, if nothing was found.
        witness: a tree with known numbers only that provably fails within the tolerance.
    """

    order: int
    found: tuple[ValuesWithin, ...] = ()
    is_linear: bool = True
    printed: int | None = None
    left: float | None = None
    witness: Tree | None = None

    @property
    def has_methods(self) -> bool | None:
        """Whether methods have the order; None if undecided."""
        if any(x.is_admitted for x in self.found):
            return True
        return None if self.witness is None else False


class DesignWithin(Shown, Frozen, eq=False):
    """Values of unknowns within a tolerance.

    Attributes:
        family: as printed.
        whose: the order of the method, its conjugate, or its pair.
        tolerance: the rounding of its numbers.
        steps: the highest order with methods, if any, and the lowest without.
    """

    family: Family
    whose: Whose
    tolerance: fmpq
    steps: tuple[StepWithin, ...]

    @property
    def digits(self) -> int:
        """Decimals that the tolerance determines, and two more."""
        return len(str(int((1 / self.tolerance).floor()))) + 1

    @property
    def best(self) -> StepWithin | None:
        """The highest order with methods."""
        return next((x for x in reversed(self.steps) if x.has_methods), None)

    def reaches(self, order: int = 1) -> bool | None:
        """Whether methods of the file have the order; None if undecided."""
        if self.best is not None and self.best.order >= order:
            return True
        last = self.steps[-1]
        return False if last.order <= order and last.has_methods is False else None

    def __repr__(self) -> str:
        highest = 0 if self.best is None else self.best.order
        return f"<DesignWithin {self.family.name}: order {highest} is found>"


def find_within(
    rounding: Rounding,
    order: int | None = None,
    whose: Whose = "method",
    seconds: float | None = None,
) -> DesignWithin:
    """Values of the unknowns for which methods within the tolerance have an order. ``order`` None
    is the highest with values; after ``seconds`` the rest stays undecided. Raises ZeroWeight if a
    weight is zero for every value, so there is no conjugate.
    """
    with within(seconds):
        return _ValueSearch(rounding, whose).design(order or rounding.family.order)


class _ValueSearch:
    def __init__(self, rounding: Rounding, whose: Whose) -> None:
        self.rounding = rounding
        self.whose = whose
        self.family = rounding.family
        self.tolerance = rounding.tolerance
        self.digits = len(str(int((1 / rounding.tolerance).floor()))) + 20
        self.bits = max(BITS, 8 * self.digits)
        self.printed = RoundedConditions(rounding.at((), self.bits), whose)

    def design(self, wanted: int | None) -> DesignWithin:
        steps: list[StepWithin] = []
        if wanted is not None:
            steps = [self._step(wanted)]
        if not steps or not steps[-1].has_methods:
            lower = self._lower(DEFAULT_LIMIT if wanted is None else wanted - 1)
            steps = [*lower, *steps] if wanted is not None else lower
        return DesignWithin(self.family, self.whose, self.tolerance, tuple(steps))

    def _lower(self, most: int) -> list[StepWithin]:
        steps: list[StepWithin] = []
        for order in range(1, most + 1):
            steps = [*steps[-1:], self._step(order)]
            if not steps[-1].has_methods:
                break
        return steps

    def _step(self, order: int) -> StepWithin:
        try:
            return self._examined(order)
        except NotDecided:
            return StepWithin(order)

    def _examined(self, order: int) -> StepWithin:
        import numpy as np

        if self.family.impossible or self.family.unsettled:
            return StepWithin(order)
        conditions = self.printed.of_order(order)
        system = RoundedSystem(conditions, self.unknowns, self.bits)
        start = [arb(x) for x in self._start()]
        printed = None
        if system.is_linear:
            exact = system.solve(start, arb(2) ** (100 - self.bits))
            assert exact is not None
            is_met = exact.left < arb(2) ** (100 - self.bits)
            printed = len(exact.free) if is_met else -1
        loose = (arb(self.tolerance) * LOOSE).min(arb("0.01"))
        found: list[ValuesWithin] = []
        seen: list[list[float]] = []
        left: arb | None = None
        for solved in self._solutions(system, order, start):
            if not solved.left < loose:
                left = solved.left if left is None else left.min(solved.left)
                if system.is_linear:
                    break
                continue
            point = [float(x) for x in solved.point]
            if any(np.allclose(point, other, rtol=0, atol=SAME) for other in seen):
                continue
            seen.append(point)
            values = self._recovered(solved, order)
            if values is not None:
                found = with_more(found, values)
            is_enough = any(x.is_admitted and x.dimension for x in found)
            if is_enough or len(found) >= MOST or len(seen) >= TRIES:
                break
        witness = None if found else self._witness(order)
        rest = None if left is None or found else float(left.mid())
        return StepWithin(order, tuple(found), system.is_linear, printed, rest, witness)

    @property
    def unknowns(self) -> int:
        return len(self.printed.family.ring.names)

    def _start(self) -> list[fmpq]:
        """0 for each unknown, or the middle of its range if that excludes 0."""
        start = []
        for name in self.printed.family.ring.names:
            low, high = self.family.ranges.get(name, (None, None))
            if (low is None or low <= 0) and (high is None or high >= 0):
                start.append(fmpq(0))
            else:
                ends = [x for x in (low, high) if x is not None]
                start.append(sum(ends, fmpq(0)) / len(ends))
        return start

    def _solutions(
        self, system: RoundedSystem, order: int, start: Sequence[arb]
    ) -> Iterator[Solved]:
        noise = arb(to_float(self.tolerance) ** (2 / 3))
        first = system.solve(start, noise)
        if first is not None:
            yield first
            if system.is_linear and not first.free:
                return
        search = Search(self.printed.family, order, self.whose)
        if system.is_linear:
            for point in search.starts(0, TRIES):
                solved = system.solve([arb(x) for x in point], noise)
                if solved is not None:
                    yield solved
            return
        import numpy as np

        columns = np.ascontiguousarray(np.array(list(search.starts(0, STARTS))).transpose())
        small = max(1e-13, 1000 * to_float(self.tolerance))
        minima = least_squares(search.conditions.at, columns, small=small)
        for k in np.flatnonzero(minima.succeeded):
            check_time()
            solved = system.solve([arb(float(x)) for x in minima.points[:, k]], noise)
            if solved is not None:
                yield solved

    # one method

    def _recovered(self, near: Solved, order: int) -> ValuesWithin | None:
        """The values of a method within the tolerance that has the order; None if none is found."""
        names = self.printed.family.ring.names
        values = dict(zip(names, map(midpoint, near.point), strict=True))
        parameters = {name: values[name] for name in self.family.parameters}
        widths = (width * self.tolerance for width in WIDTHS)
        for width in (x for x in widths if x <= WIDEST):
            check_time()
            try:
                filled = self.rounding.filled(parameters, self.digits, width)
                rounded = self._derived(filled)
                if rounded.search.order_of(rounded.name, order)[0] < order:
                    continue
                recovered = self._at(filled, rounded, values, order)
            except (MethodFileError, MethodError):
                return None
            if recovered is not None:
                return recovered
        return None

    def _derived(self, filled: Any) -> RoundedTableau:
        rounded: RoundedTableau = filled.rounded
        derived_tableau = derived(rounded, self.whose)
        assert not isinstance(derived_tableau, Tableau)
        return derived_tableau

    def _at(
        self, filled: Any, rounded: RoundedTableau, values: Mapping[str, fmpq], order: int
    ) -> ValuesWithin | None:
        """The solution at the numbers of one method; None if conditions contradict each other."""
        search = rounded.search
        search.settled  # noqa: B018 -- it moves to a method with all wants
        shifts = filled.shifts()
        conditions = RoundedConditions(self.rounding.at(shifts, search.bits), self.whose)
        system = RoundedSystem(conditions.of_order(order), self.unknowns, search.bits)
        solved = system.solve([arb(x) for x in values.values()], search.small)
        if solved is None or not solved.left < search.small:
            return None
        names = conditions.family.ring.names
        parameters = set(self.family.parameters)
        bound = {names[k]: solved.slopes(k) for _, k in solved.pivots if names[k] in parameters}
        directions = {
            name: {names[k]: midpoint(x) for k, x in slopes.items() if not abs(x) < search.small}
            for name, slopes in bound.items()
        }
        points = {names[k]: midpoint(x) for k, x in enumerate(solved.point)}
        grain = search.grain * GRAINS
        method_order, embedded = conditions.orders(points, grain)
        return ValuesWithin(
            values=points,
            directions=directions,
            free=tuple(names[k] for k in solved.free),
            distance=max((abs(to_float(x)) for x in shifts), default=0.0),
            is_admitted=conditions.admits(solved.point, search.small),
            digits=len(str(int((1 / search.grain).floor()))) - 1,
            order=method_order,
            embedded=embedded,
        )

    def _witness(self, order: int) -> Tree | None:
        """A tree whose condition has no unknowns and that no rounding explains."""
        trees = list(self.printed.of_known_numbers(order))
        if not trees:
            return None
        [start] = Search(self.printed.family, 1, self.whose).starts(0, 1)
        values = [fmpq(int(x * 1000) + 1, 1009) for x in start]
        parameters = dict(zip(self.family.parameters, values, strict=False))
        try:
            weights = GenericWeights(self.rounding.generic(), self.whose)
            rounded = self._derived(self.rounding.filled(parameters, self.digits, self.tolerance))
            unexplained = (x for x in trees if weights.are_known(x) and not rounded.explains(x))
            return next(unexplained, None)
        except (MethodFileError, MethodError):
            return None


class RoundedConditions:
    """Conditions on the unknowns of a family: those of its order, and all others."""

    def __init__(self, family: Family, whose: Whose) -> None:
        self.family = family
        self.whose = whose
        self._conditions = FamilyConditions(TABLEAUS[whose](family.tableau), family.ring)

    @cached_property
    def _relations(self) -> list[fmpq_mpoly]:
        roots = [x.relation for x in self.family.radicals]
        return [p for p in (*roots, *self.family.relations) if p]

    @cached_property
    def _known(self) -> dict[int, list[Any]]:
        return {}

    def _of(self, order: int) -> list[Any]:
        if order not in self._known:
            self._known[order] = [x for x in self._conditions.of_order(order) if x.polynomial]
        return self._known[order]

    def of_order(self, order: int) -> list[fmpq_mpoly]:
        residuals = [x.polynomial for k in range(1, order + 1) for x in self._of(k)]
        return [*self._relations, *residuals]

    def of_known_numbers(self, order: int) -> Iterator[Tree]:
        """The trees up to an order whose conditions fail and have no unknowns."""
        for k in range(1, order + 1):
            yield from (x.tree for x in self._of(k) if x.polynomial.is_constant())

    def orders(self, values: Mapping[str, Number], grain: fmpq) -> tuple[int, int | None]:
        """The orders with some values, of the method and of embedded weights, if any. Residuals
        below ``grain`` count as zero. Raises VanishingDenominator if no method has these values.
        """
        family, weights = self.family, self.family.further.embedded
        method = TABLEAUS[self.whose](member(family.tableau, family.ring, values))
        if weights is None or self.whose != "method":
            return _order_of(method, grain), None
        embedded = member(with_weights(family.tableau, weights), family.ring, values)
        return _order_of(method, grain), _order_of(embedded, grain)

    def admits(self, point: Sequence[arb], small: arb) -> bool:
        """Whether a point has the wanted ranges and signs, within its radii and ``small``."""
        family = self.family
        values = dict(zip(family.ring.names, point, strict=True))
        for name, (low, high) in family.ranges.items():
            if low is not None and values[name] < arb(low) - small:
                return False
            if high is not None and values[name] > arb(high) + small:
                return False

        def at(polynomials: Sequence[fmpq_mpoly]) -> list[arb]:
            system = RoundedSystem([p for p in polynomials if p], len(point), ctx.prec)
            return system.values(point)

        even = [x.name for x in family.radicals if x.is_even]
        roots = [family.ring.parameter(name).numerator for name in even]
        nonzero = at([*family.nonzero, *self._conditions.denominators])
        return (
            all(abs(x) > small for x in nonzero)
            and all(x > small for x in at(family.positive))
            and all(x > -small for x in at(family.not_negative))
            and all(x > -small for x in at(roots))
        )


def _order_of(tableau: Tableau, grain: fmpq) -> int:
    # residuals below grain count as zero
    from garkcli.order.rounded import tree_missed  # it imports numpy

    failing = (k for k in range(1, DEFAULT_LIMIT + 1) if tree_missed(tableau, k, 1, grain))
    return next(failing, DEFAULT_LIMIT + 1) - 1


class GenericWeights:
    """The elementary weights of a family whose known numbers are indeterminates."""

    def __init__(self, family: Family, whose: Whose) -> None:
        self.tableau = TABLEAUS[whose](family.tableau)
        self.ring = family.ring
        unknown = {*family.parameters, *(x.name for x in family.radicals)}
        self.unknowns = [k for k, name in enumerate(family.ring.names) if name in unknown]

    def are_known(self, tree: Tree) -> bool:
        parts = fraction(elementary_weight(self.tableau, tree), self.ring)
        return not any(part.degrees()[k] > 0 for part in parts for k in self.unknowns)
