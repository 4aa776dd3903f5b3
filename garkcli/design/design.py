"""The values of the parameters of a family for which it has an order: exactly, and all of them."""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Iterable, Iterator, Sequence
from contextlib import suppress
from functools import partial
from time import monotonic
from typing import Any, cast, get_args

from flint import fmpq, fmpq_mpoly, fmpz_mpoly

from garkcli.deadline import check_time, only_small, seconds_left, until, within
from garkcli.design import member as members
from garkcli.design import stable_parts
from garkcli.design.conditions import FamilyCondition, FamilyConditions
from garkcli.design.critical import smooth_points
from garkcli.design.ideal import Ideal, without_multiples
from garkcli.design.minimise.squared_error import squared_error
from garkcli.design.msolve import find_msolve
from garkcli.design.pairs import PairConditions, pair_conditions
from garkcli.design.parts import Part, Pieces, diagonal_unknowns, nodes_as_coordinates, parts_of
from garkcli.design.real_points import has_methods, has_point, without_complex
from garkcli.design.solutions import Solution, solutions
from garkcli.design.stable_set import BEYOND, stable_set
from garkcli.design.stable_transfers import stable_zeros
from garkcli.design.stable_values import StableValues, Wanted
from garkcli.design.steps import (
    AllValues,
    Decided,
    Found,
    Knowledge,
    Many,
    NoValue,
    Solutions,
    Step,
    Undecided,
    Variety,
    Zeros,
)
from garkcli.design.want import numerators
from garkcli.errors import NotDecided, UsageProblem, ZeroWeight
from garkcli.exact.parametric import fraction
from garkcli.exact.roots import RealRoot
from garkcli.frozen import Frozen, replace
from garkcli.ntrees.tree import Tree
from garkcli.order.certificate import DEFAULT_LIMIT, Order, find_order
from garkcli.order.dense import dense_order
from garkcli.order.predictor import predictor_orders
from garkcli.tableau.embedded import with_weights
from garkcli.tableau.family import Family
from garkcli.tableau.stages import PointSpace
from garkcli.tableau.tableau import Tableau
from garkcli.upward import Shown


class Design(Shown, Frozen):
    """The values of the parameters of a family for each order.

    Attributes:
        family: as read from the file.
        whose: the order of the method, its conjugate, or its pair.
        tableau: of the method, conjugate or pair; its entries are rational functions.
        steps: one for each order, from 1 on.
        criterion: the criterion behind the real values; None if all conditions were examined.
    """

    family: Family
    whose: members.Whose
    tableau: Tableau
    steps: tuple[Step, ...]
    criterion: PairConditions | None = None

    @property
    def last(self) -> Step:
        """The step of the highest order."""
        return self.steps[-1]

    def criterion_of(self, step: Step) -> PairConditions | None:
        """The criterion behind the values of a step; None by msolve, which takes all conditions."""
        return self.criterion if step.is_all else None

    def is_of_real_values(self, step: Step) -> bool:
        """Whether complex values outside the set of a step may have the order."""
        if self.criterion_of(step) is not None:
            return step.order > 2
        return step.is_all and bool(self.family.real)

    def parts(self, step: Step) -> list[Part]:
        """The solution set of a step in parts, with nodes as coordinates; raises NotDecided."""
        ideal, family = step.ideal, self.family
        assert ideal is not None
        if isinstance(ideal, Pieces):
            return list(ideal.parts)
        kept = diagonal_unknowns(self.tableau, ideal.ring) if family.stable else ()

        def generators() -> Iterator[fmpq_mpoly]:
            yield from (x.relation for x in family.radicals)
            yield from family.relations
            conditions = FamilyConditions(self.tableau, family.ring)
            for k in range(1, step.order + 1):
                yield from (x.polynomial for x in conditions.of_order(k) if x.polynomial)

        is_of_trees = self.criterion is None and ideal.is_proved
        nodes = nodes_as_coordinates(self.tableau, ideal.ring)
        return list(parts_of(ideal, nodes, kept, generators if is_of_trees else None))

    def reaches(self, order: int = 1) -> bool | None:
        """Whether methods of the file have the order; None if undecided."""
        for step in self.steps:
            if step.order == order:
                return step.has_methods
        return False if self.last.has_methods is False else None

    def __repr__(self) -> str:
        orders = [step.order for step in self.steps if step.may_have_methods]
        highest = max(orders, default=0)
        return f"<Design {self.family.name}: order {highest} is reached>"


SHARE = 0.25
"""The part of the time for python-flint if msolve is there too: its results are proved."""
PART = 0.25
"""The part of the remaining time for a real method of a family."""
STABLE = 0.5
"""The part of it for the P-stable transfers of a pair."""
CLAIMS: dict[members.Whose, str] = {
    "method": "order",
    "conjugate": "conjugate-order",
    "pair": "pair-order",
}


def find_parameters(
    family: Family,
    order: int | None = None,
    whose: members.Whose = "method",
    seconds: float | None = None,
) -> Design:
    """The values of the parameters for which members of a family have an order. ``order`` None is
    the highest that some value has; after ``seconds`` the rest stays undecided. Raises ZeroWeight
    if a weight is zero for every value, so there is no conjugate.
    """
    tableau = members.TABLEAUS[whose](family.tableau)
    with within(seconds):
        criterion = pair_conditions(family) if whose == "pair" else None
        conditions = FamilyConditions(tableau, family.ring)
        finding = _Finding(family, whose, conditions, criterion, order or family.order)
        return Design(family, whose, tableau, tuple(finding.steps()), criterion)


class _Finding(Frozen):
    family: Family
    whose: members.Whose
    conditions: FamilyConditions
    criterion: PairConditions | None = None

    wanted: int | None = None

    def steps(self) -> list[Step]:
        """A step for each order, up to the wanted, the last with values or an undecided one."""
        wanted = self.wanted
        if self.family.unsettled:
            return [Undecided(wanted or 1, None)]
        left = seconds_left()
        first = None
        if wanted is not None and left is not None and find_msolve() is not None:
            first = monotonic() + SHARE * left
        steps: list[Step] = []
        for k in range(1, (wanted or DEFAULT_LIMIT) + 1):
            step: Step
            try:
                with until(first):
                    lower = steps[-1] if steps else None
                    step = self._none_of(k, lower) or self._step(k, lower.ideal if lower else None)
            except NotDecided as error:
                step = Undecided(wanted or k, None, error.is_late)
                if first is not None:
                    with suppress(NotDecided):
                        step = self._at_once(step.order)
            if isinstance(step, NoValue) and self.criterion is not None and steps:
                steps[-1] = self._solved(steps[-1], is_last=True)
            is_last = self.criterion is None or wanted is None or k == wanted
            steps.append(self._solved(step, is_last))
            if not steps[-1].may_have_methods or step.order == wanted:
                break
        return _with_lower(steps)

    def _none_of(self, order: int, lower: Step | None) -> NoValue | None:
        if not isinstance(lower, Solutions) or self.criterion is not None or not lower.is_all:
            return None
        left = [x.solution.values for x in lower.found]
        if not left or any(x.order is None or x.order.order >= order for x in lower.found):
            return None
        for condition in self.conditions.of_order(order):
            polynomial = condition.polynomial
            left = [x for x in left if not members.value_of(polynomial, self.family.ring, x)]
            if not left:
                nothing = self._start().with_zeros([self.family.ring.constant(fmpq(1))])
                return NoValue(order, nothing, witness=condition.tree)
        return None

    def _start(self) -> Ideal:
        ring, count = self.family.ring, len(self.family.parameters)
        roots = Ideal(ring).with_zeros(x.relation for x in self.family.radicals)
        nonzero = [
            p
            for p in (*self.conditions.denominators, *self.family.nonzero)
            if any(p.degrees()[:count]) or not roots.with_zeros([p]).is_everything
        ]
        return Ideal(ring, nonzero).with_zeros(x.relation for x in self.family.radicals)

    def _step(self, order: int, lower: Ideal | Pieces | None) -> Step:
        """The values that reach ``order``, with all other wants; raises NotDecided. ``lower`` is
        the ideal of the order below, None if there is none.
        """
        start = self._start()
        criterion = self.criterion
        if lower is None:
            relations = self.family.relations
            if self.wanted is not None and criterion is None and not self.family.real:
                with suppress(NotDecided), only_small():
                    lower = start.with_zeros(relations)
                if lower is None:
                    check_time()
                    with suppress(NotDecided):
                        return self._in_pieces(self.wanted, self._conditions(self.wanted), start)
            lower = lower or start.with_zeros(relations)
        if criterion is not None:
            assert isinstance(lower, Ideal)
            return _reached(order, lower.with_zeros(criterion.of_order(order)), start)
        if isinstance(lower, Pieces):
            return self._in_pieces(order, self._conditions(order), start)
        coming = (x for x in self.conditions.of_order(order) if x.polynomial)
        ideal, done, large = _as_long_as_small(lower, coming)
        if large is not None:
            known = (
                *self._relations,
                *self._conditions_below(order),
                *(x.polynomial for x in done),
            )
            new = [large, *coming]
            with suppress(NotDecided):
                if not self.family.real:  # already solved by the criterion
                    return self._in_pieces(order, [*done, *new], start)
            check_time()
            ideal, taken = ideal.with_zeros_in_turn([x.polynomial for x in new], known)
            done += new[:taken]
        return _reached(order, ideal, start, done[-1].tree if done else None)

    def _in_pieces(self, order: int, new: Sequence[FamilyCondition], start: Ideal) -> Step:
        """The zeros of conditions ``new`` of an order in parts, by solving linear equations first.
        ``start`` has the equations for all parameters. Raises NotDecided after too many steps.
        """
        known = [*self._relations, *self._conditions_below(order)]
        tableau, ring = self.conditions.tableau, self.family.ring
        kept = diagonal_unknowns(tableau, ring) if self.family.stable else ()
        changes = nodes_as_coordinates(tableau, ring)

        def pieces(count: int) -> Pieces:
            zeros = [*known, *(x.polynomial for x in new[:count])]
            return Pieces.of(zeros, start.nonzero, changes, kept)

        zeros_in_parts = pieces(len(new))
        if not zeros_in_parts.is_everything:
            if zeros_in_parts.dimension > 0:
                return Variety(order, zeros_in_parts)
            return Solutions(order, zeros_in_parts.ideal(start))
        few = bisect_left(range(len(new)), x=True, key=lambda k: pieces(k).is_everything)
        return NoValue(order, zeros_in_parts, witness=new[few - 1].tree if few else None)

    @property
    def _relations(self) -> list[fmpq_mpoly]:
        """Equations besides the order conditions: of roots, and of wants."""
        return [*(x.relation for x in self.family.radicals), *self.family.relations]

    def _conditions(self, order: int) -> list[FamilyCondition]:
        return [x for x in self.conditions.of_order(order) if x.polynomial]

    def _conditions_below(self, order: int) -> list[fmpq_mpoly]:
        return [x.polynomial for k in range(1, order) for x in self._conditions(k)]

    def _at_once(self, order: int) -> Step:
        """Solves all conditions up to an order in one system by msolve; NotDecided if it fails."""
        polynomials = (*self._relations, *self._conditions_below(order + 1))
        ideal = self._start().with_zeros_unproved(polynomials)
        if ideal.is_everything:
            return Undecided(order, ideal)
        return Variety(order, ideal) if ideal.dimension > 0 else Solutions(order, ideal)

    def _solved(self, step: Step, is_last: bool) -> Step:
        """The step with its polynomials and solutions, and the real values if it is the last. It is
        undecided if the solutions take too long.
        """
        if not isinstance(step, Decided):
            return step
        ideal = step.ideal
        try:
            solved = None
            if self.criterion is not None and isinstance(ideal, Ideal):
                solved = self.criterion.solved(ideal)
            polynomials, nonzero = _described(ideal) if solved is None else (solved, [])
            step = replace(step, polynomials=tuple(polynomials), nonzero=tuple(nonzero))
            if isinstance(step, Solutions) and isinstance(ideal, Ideal):
                step = replace(step, found=self._solutions_of(ideal))
        except NotDecided as error:
            return Undecided(step.order, ideal, error.is_late)
        if is_last and isinstance(step, Many):
            return replace(step, known=self._known(step))
        return step

    def _known(self, step: Many) -> Knowledge:
        ideal, left = step.ideal, seconds_left()
        if isinstance(ideal, Pieces):
            with suppress(NotDecided), within(None if left is None else PART * left):
                return self._known_of_pieces(step, ideal)
            return Knowledge()
        if self.criterion is not None and self.family.stable:
            with suppress(NotDecided), within(None if left is None else STABLE * left):
                return self._stable_transfers(step.order, ideal, self.criterion)
            left = seconds_left()
        with suppress(NotDecided), within(None if left is None else PART * left):
            return self._known_of(step, ideal)
        return Knowledge()

    def _known_of(self, step: Many, ideal: Ideal, real: Ideal | None = None) -> Knowledge:
        """The knowledge of real values; ``real`` is an ideal with the real zeros of ``ideal``."""
        if self.criterion is not None and self._has_point(self.criterion, ideal):
            return Knowledge(is_real=True)
        real = without_complex(real or ideal)
        known = Knowledge()
        if real.basis != ideal.basis:
            known = Knowledge(within=Zeros(real, tuple(_described(real)[0])))
        if real.is_everything and ideal.is_proved:
            return replace(known, is_real=False)
        if real.dimension == 0:
            finite = self._solutions_of(real)
            is_open = any(x.open for x in finite)
            is_real = True if any(x.accepted for x in finite) else None if is_open else False
            return replace(known, found=finite, is_real=is_real)
        if self.family.stable and isinstance(step, Variety):
            return self._with_stable(step, known)
        if len(self.family.parameters) > 1:
            known = replace(known, stable=_sets(self.family, self.whose))
            verdicts = [x.has_values for x in known.stable]
            if False in verdicts or verdicts == [True]:
                return replace(known, is_real=False not in verdicts)
        known = replace(known, is_real=has_methods(self.family, ideal, real, self._is_method))
        if known.is_real is None:
            with suppress(NotDecided), only_small():
                return self._by_smooth_points(step, ideal, real, known)
        return known

    def _by_smooth_points(
        self, step: Many, ideal: Ideal, real: Ideal, known: Knowledge
    ) -> Knowledge:
        """The knowledge by critical points: one of them is a method, or all methods are singular
        points, at which the gradients of the equations are dependent.
        """
        smooth = smooth_points(real)
        if smooth is None:
            return known
        ring = self.family.ring
        for point in smooth.points:
            is_defined = all(members.value_of(p, ring, point.values) for p in ideal.nonzero)
            if is_defined and any(self._is_method(point, root) for root in point.real):
                return replace(known, is_real=True)
        if smooth.points:
            return known
        return self._known_of(step, ideal, real.with_zeros(smooth.others))

    def _known_of_pieces(self, step: Many, pieces: Pieces) -> Knowledge:
        if self.family.stable:
            return self._with_stable(step, Knowledge())
        verdicts = (has_point(self.family, part, self._is_method) for part in pieces.parts)
        return Knowledge(is_real=any(verdicts) or None)

    def _with_stable(self, step: Many, known: Knowledge) -> Knowledge:
        """Knowledge of methods of the wanted stability; NotDecided for several unknowns."""
        tableau = members.TABLEAUS[self.whose](self.family.tableau)
        parts = Design(self.family, self.whose, tableau, (step,), self.criterion).parts(step)
        decided: list[stable_parts.StablePart] = []
        sets: list[tuple[StableValues, ...]] = []
        is_complete = True
        for part in parts:
            try:
                decided.append(stable_parts.stable_part(self.family, self.whose, part))
            except NotDecided:
                try:
                    sets += stable_parts.on_charts(self.family, self.whose, part)
                except NotDecided:
                    is_complete = False
        is_real = stable_parts.has_stable_method(self.family, self.whose, decided)
        verdicts = [*map(stable_parts.has_values_of_all, sets), is_real]
        if True in verdicts:
            is_real = True
        elif None in verdicts or not is_complete:
            is_real = None
        stable: tuple[StableValues, ...] = ()
        if is_complete and not sets:
            stable = stable_parts.joined(self.family, decided)
        elif is_complete and not decided and len(sets) == 1:
            [stable] = sets
        if is_real is None and any(not x.found and not x.undecided for x in stable):
            is_real = False
        return replace(known, is_real=is_real, stable=stable)

    def _stable_transfers(self, order: int, ideal: Ideal, criterion: PairConditions) -> Knowledge:
        """The knowledge of all transfers, with the ideal of P-stable ones; raises NotDecided."""
        stable = without_complex(ideal.with_zeros(stable_zeros(criterion, ideal, order)))
        solved, is_real = criterion.solved(stable), None
        if solved is None:
            raise NotDecided
        if stable.is_everything:
            is_real = False
        else:
            free = replace(self.family, stable=())
            is_real = has_methods(free, stable, stable, partial(members.is_admissible, free))
        new = tuple(p for p in solved if not ideal.contains(p))
        return Knowledge(is_real=is_real, of_stable=Zeros(stable, new))

    def _has_point(self, criterion: PairConditions, ideal: Ideal) -> bool:
        """Whether the values with all free unknowns at 0 give a method."""
        point = criterion.point(ideal)
        if point is None:
            return False
        roots = ((x, root) for x in solutions(point) for root in x.real)
        return any(self._is_method(x, root) for x, root in roots)

    def _solutions_of(self, ideal: Ideal) -> tuple[Found, ...]:
        """The solutions of an ideal of dimension 0, each with its order by the certificate."""
        finite = []
        for solution in solutions(ideal):
            check_time()
            accepted = [
                index
                for index, root in enumerate(solution.real)
                if members.is_admissible(self.family, solution, root)
            ]
            _ = solution.real_values  # computed now, since reports show them after the time limit
            order = order_of(self.family, self.whose, solution)
            further = further_of(self.family, self.whose, solution)
            candidate = Found(solution, order, tuple(accepted), **further)
            finite.append(candidate if order is None else self._sorted(candidate))
        return tuple(finite)

    def _sorted(self, found: Found) -> Found:
        by_verdict: dict[bool | None, list[int]] = {True: [], False: [], None: []}
        for index in found.accepted:
            verdict = members.is_as_stable(
                self.family, self.whose, found.solution, found.solution.real[index]
            )
            by_verdict[verdict].append(index)
        accepted, unstable, undecided = (tuple(by_verdict[key]) for key in (True, False, None))
        return replace(found, accepted=accepted, unstable=unstable, open=undecided)

    def _is_method(self, solution: Solution, root: RealRoot) -> bool:
        stable = members.is_admissible(self.family, solution, root) and members.is_as_stable(
            self.family, self.whose, solution, root
        )
        return bool(stable)


def _reached(order: int, ideal: Ideal, start: Ideal, witness: Tree | None = None) -> Step:
    if ideal.is_everything:
        return NoValue(order, ideal, witness=witness)
    if ideal.basis == start.basis:
        return AllValues(order, ideal)
    return Variety(order, ideal) if ideal.dimension > 0 else Solutions(order, ideal)


def _as_long_as_small(
    ideal: Ideal, conditions: Iterator[FamilyCondition]
) -> tuple[Ideal, list[FamilyCondition], FamilyCondition | None]:
    """The ideal while it is small, the conditions in it, and the one that makes it large."""
    done: list[FamilyCondition] = []
    while not ideal.is_everything:
        condition = next(conditions, None)
        if condition is None:
            break
        try:
            with only_small():
                ideal = ideal.with_zeros([condition.polynomial])
        except NotDecided:
            check_time()
            return ideal, done, condition
        done.append(condition)
    return ideal, done, None


def _described(ideal: Ideal | Pieces) -> tuple[Sequence[fmpq_mpoly | fmpz_mpoly], list[fmpq_mpoly]]:
    """Returns polynomials, and others that vanish nowhere on the zeros of an ideal. The zeros of
    the first at which none of the second vanishes are those of the ideal.
    """
    if isinstance(ideal, Pieces):
        return _each_once(ideal.equations), list(ideal.nonzero)
    if ideal.dimension <= 0:
        return ideal.polynomials, []
    with suppress(NotDecided), only_small():
        closure = ideal.closure
        allowed = (closure.with_zeros([p]).is_everything for p in ideal.nonzero)
        nonzero = [p for p, is_never in zip(ideal.nonzero, allowed, strict=True) if not is_never]
        return ideal.polynomials, nonzero
    check_time()
    return _each_once(ideal.cleared), list(ideal.nonzero)


def _each_once(polynomials: Iterable[fmpq_mpoly]) -> list[fmpq_mpoly]:
    return list({str(p): p for p in map(without_multiples, polynomials)}.values())


def _with_lower(steps: Sequence[Step]) -> list[Step]:
    completed: list[Step] = []
    is_reached = False
    for step in reversed(steps):
        if is_reached and isinstance(step, Many):
            step = replace(step, known=replace(step.known, is_real=True))
        is_reached = is_reached or step.has_methods is True
        completed.insert(0, step)
    return completed


def order_of(family: Family, whose: members.Whose, solution: Solution) -> Order | None:
    """The exact order by the certificate; None if there is no method."""
    try:
        return find_order(
            members.TABLEAUS[whose](members.member(family.tableau, family.ring, solution.values))
        )
    except (ZeroDivisionError, ZeroWeight):
        return None


def further_of(family: Family, whose: members.Whose, solution: Solution) -> dict[str, Any]:
    is_spelled_out = all(isinstance(x, PointSpace) for x in family.tableau.spaces)
    if whose != "method" or not is_spelled_out:
        return {}
    orders: dict[str, Any] = {}
    with suppress(ZeroDivisionError):
        at = family.ring, solution.values
        tableau, further = (
            members.member(family.tableau, *at),
            members.further_member(family.further, *at),
        )
        if further.dense is not None:
            orders["dense"] = dense_order(tableau, further.dense, DEFAULT_LIMIT)
        if further.predictor is not None:
            orders["predictor"] = predictor_orders(tableau, further.predictor, DEFAULT_LIMIT)
        if further.embedded is not None:
            embedded = with_weights(tableau, further.embedded)
            order = find_order(embedded)
            error = squared_error(embedded, order.order + 1, None)
            orders["embedded"] = order, error.numerator / error.denominator
    return orders


def estimates_nothing(design: Design, step: Step) -> bool:
    """Whether the embedded weights equal b at all values of a step, by its ideal."""
    rows, ring, ideal = design.family.further.embedded, design.family.ring, step.ideal
    if rows is None or ideal is None or not step.is_all:
        return False
    pairs = zip(rows, (colour.b for colour in design.family.tableau.colours), strict=True)
    differences: list[Any] = [x - y for row, b in pairs for x, y in zip(row, b, strict=True)]
    zeros = numerators(differences, ring)
    if isinstance(ideal, Ideal):
        return all(map(ideal.contains, zeros))
    return all(
        part.ideal.contains(fraction(part.expressed(p, ring), part.ring)[0])
        for p in zeros
        for part in ideal.parts
    )


def stable_sets(design: Design) -> tuple[StableValues, ...]:
    """The values of one or two unknowns with each wanted stability, of the highest order reached.
    Empty if solutions are examined one by one.
    """
    family = design.family
    if any(step.known.stable for step in design.steps):
        *_, best = [design.last, *(step for step in design.steps if step.may_have_methods)]
        return best.known.stable
    if design.last.kind != "every-value" or len(family.parameters) != 1:
        return ()
    return _sets(family, design.whose)


def _sets(family: Family, whose: members.Whose) -> tuple[StableValues, ...]:
    """The set of each wanted stability; empty if one is no set of values of one or two unknowns.
    Raises UsageProblem for a stability that is not applicable, or NotDecided.
    """
    wanted = [
        x for kind in get_args(Wanted) for x in dict.fromkeys(family.stable) if x.kind == kind
    ]
    sets = []
    for x in wanted:
        try:
            values = stable_set(family.tested(x), cast("Wanted", x.kind), whose, colour=x.colour)
        except (NotDecided, UsageProblem) as error:
            if error.code in BEYOND or (isinstance(error, NotDecided) and not error.is_late):
                return ()
            raise
        sets.append(replace(values, is_embedded=x.is_embedded))
    return tuple(sets)
