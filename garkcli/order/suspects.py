"""Finds the entry that alone keeps a method from an order, the others being rounded."""

from __future__ import annotations

from collections.abc import Container, Sequence
from typing import TYPE_CHECKING, Any, Generic, TypeAlias, TypeVar

from flint import fmpq

from garkcli import numpy_on_use as np
from garkcli.deadline import check_time
from garkcli.exact.affine import Affine
from garkcli.exact.display import to_float
from garkcli.frozen import Frozen, replace
from garkcli.order.bounded import FLOOR, exactly, nearest
from garkcli.order.certificate import DEFAULT_LIMIT
from garkcli.order.conditions import conditions
from garkcli.order.place import BoxPlace
from garkcli.order.recovering import Recovery
from garkcli.order.repair import Repair
from garkcli.order.rounded import RoundedTableau
from garkcli.order.rows import of_tree
from garkcli.order.tolerance import unnatural, within

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from garkcli.exact.affine import Floats, Forms
    from garkcli.exact.field import Number
    from garkcli.exact.matrix import Matrix, Vector
    from garkcli.ntrees.tree import Tree
    from garkcli.order.rows import System

T = TypeVar("T")
MOST_NUMBERS = 300
MOST_SUSPECTS = 8
LEAST = 1e-24
"""Smaller squared slopes of a number, relative to all others, are rounding errors of zero."""
MAX_STEPS = 6
SLOWEST = 0.8
"""A number is given up if a step leaves more than this part of the residual."""
STRAIGHT = 0.01
"""The part of its radius by which a number may miss its value if slopes are not renewed."""
NEARLY = 1e-9
"""Tolerance of slopes that are 1."""
LONGEST = 1e9
"""A longer step, in radii, is the last: floats resolve it to a small part of a radius."""


def suspects(rounded: RoundedTableau, order: int, limit: int = DEFAULT_LIMIT) -> dict[Repair, int]:
    """Returns single entries whose change gives a larger order, with that, the others being within
    their rounding; the smallest change is first.
    """
    search = rounded.search
    changes = _changes(rounded, order, limit, lambda k, change: _repair(search, k, change))
    return {change.made: change.order for change in changes}


def suspected_numbers(
    rounded: RoundedTableau, order: int, limit: int = DEFAULT_LIMIT
) -> list[SuspectedNumber]:
    """The numbers that may be wrong, each perhaps part of several entries; see ``suspects``."""
    numbers = rounded.search.box.numbers

    def changed(k: int, change: fmpq) -> tuple[fmpq, fmpq]:
        old = numbers[k]
        assert isinstance(old, fmpq)
        return old, old + change

    return [
        SuspectedNumber(*change.made, change.order)
        for change in _changes(rounded, order, limit, changed)
    ]


class SuspectedNumber(Frozen):
    old: fmpq
    new: fmpq
    order: int


class _ChangedNumber(Frozen, Generic[T]):
    made: T
    order: int


def _changes(
    rounded: RoundedTableau, order: int, limit: int, made_of: Callable[[int, fmpq], T | None]
) -> list[_ChangedNumber[T]]:
    """The suspected numbers that ``made_of`` makes of index and change, unless it returns None."""
    search = rounded.search
    limit = min(limit, rounded.tableau.exact_to or limit)
    if order > limit or len(search.box.numbers) > MOST_NUMBERS:
        return []
    kept = search.order_of("method", limit)[0]
    found: dict[T, int] = {}
    tried = None
    for rank, candidate in _ranked(search, rounded.name, order, limit)[:MOST_SUSPECTS]:
        check_time()
        if found and rank != tried:
            break
        tried, k = rank, candidate.number
        wide = _around(search, candidate)
        if wide is None:
            continue
        reached, _, missed = wide.order_of(rounded.name, limit)
        if (
            reached < order
            or _is_rounding(rounded, reached + 1, missed)
            or wide.order_of("method", kept)[0] < kept
        ):
            continue
        printed = search.box.numbers[k]
        assert isinstance(printed, fmpq)
        change = _in_few_digits(wide, k, search) - printed
        made = made_of(k, change)
        if made is not None and not within(change, search.box.radii[k]):
            found[made] = reached
    return [_ChangedNumber(made, reached) for made, reached in found.items()]


def _is_rounding(rounded: RoundedTableau, order: int, missed: Sequence[Tree]) -> bool:
    sizes = (x.residual for x in conditions(rounded.tableau, missed))
    return bool(missed) and all(within(x, unnatural(order)) for x in sizes)


class _Candidate(Frozen):
    """A number whose change lets all conditions be met to first order. ``shift`` and its
    uncertainty ``doubt`` are in units of the radius. ``is_sure``: all conditions are met together,
    not each alone.
    """

    number: int
    shift: fmpq
    doubt: float
    is_sure: bool


_Rank: TypeAlias = tuple[bool, int]
"""Whether a candidate is sure to first order, and the order that it could give."""


def _ranked(search: Recovery, name: str, order: int, limit: int) -> list[tuple[_Rank, _Candidate]]:
    """The numbers that may be wrong: sure ones first, then by order and change."""
    best: dict[int, tuple[_Rank, _Candidate]] = {}
    among = None
    for q in range(order, limit + 1):
        group = _candidates(search, name, q, among)
        if not group and q == order < limit:
            continue  # a condition that an entry enters by its square has no slope there
        if not group:
            break
        among = {x.number for x in group}
        for x in group:
            rank = x.is_sure, q
            if x.number not in best or best[x.number][0] < rank:
                best[x.number] = rank, x
    return sorted(best.values(), key=lambda y: (not y[0][0], -y[0][1], abs(y[1].shift)))


def _candidates(
    search: Recovery, name: str, order: int, among: Container[int] | None = None
) -> list[_Candidate]:
    missed = [u for q in range(1, order + 1) for u in search.origin.missed(name, q)]
    system = search.independent({name: {of_tree(u): [0] for u in missed}}, search.origin)
    if not any(system.values()):
        return []
    rows = search.origin.rows(system)
    found = []
    for k in range(rows.slopes.shape[1]):
        check_time()
        if among is None or k in among:
            candidate = _candidate(search, system, rows, k)
            found += [] if candidate is None else [candidate]
    return found


def _candidate(search: Recovery, system: System, rows: Forms, k: int) -> _Candidate | None:
    """Returns the error of number k alone, the others within radii to first order, or None."""
    shift, unit = fmpq(0), to_float(search.box.radii[k])
    before = np.inf
    for _ in range(MAX_STEPS):
        own = rows.slopes[:, k]
        others = np.delete(rows.slopes, k, axis=1)
        scale = np.maximum(np.abs(others).sum(axis=1), 1e-12 * search.radius)
        c, own, others = rows.middle / scale, own / scale, others / scale[:, None]
        size, miss = float(own @ own), float(np.abs(c).max())
        if size < LEAST or not miss < SLOWEST * before:
            return None
        x = nearest(without(others, own), without(c, own), FLOOR)
        step = -float(own @ (c if x is None else c + others @ x)) / size
        shift += exactly(step)  # beyond the digits of a float
        # what is of second order, and what floats leave of the step, is within the rounding
        if step * step * unit < STRAIGHT and abs(step) < LONGEST:
            doubt = 0.5 * abs(step) + 2
            if x is None:  # where slopes are nearly dependent that may still be too much
                if np.abs(c + step * own).max() > 1:
                    return None
                doubt += 1 / float(np.abs(own).max())
            return _Candidate(k, shift, doubt, is_sure=x is not None)
        shifts = [fmpq(0)] * rows.slopes.shape[1]
        shifts[k] = shift
        before, rows = miss, BoxPlace(search, shifts).rows(system)
        if not np.isfinite(rows.slopes).all():
            return None
    return None


def without(rows: Floats, direction: Floats) -> Floats:
    rest: Floats = rows - np.multiply.outer(direction, direction @ rows) / (direction @ direction)
    return rest


def _around(search: Recovery, candidate: _Candidate) -> Recovery | None:
    k, box = candidate.number, search.box
    numbers, radii = list(box.numbers), list(box.radii)
    number = numbers[k]
    if not isinstance(number, fmpq):
        return None
    numbers[k] = number + radii[k] * candidate.shift
    radii[k] *= int(candidate.doubt) + 1
    other = Recovery(
        replace(box, numbers=tuple(numbers), radii=tuple(radii)), search.printed_further
    )
    other.targets.update({x: y for x, y in search.targets.items() if x not in other.targets})
    return other


def _in_few_digits(wide: Recovery, k: int, search: Recovery) -> fmpq:
    printed, near = search.box.numbers[k], wide.box.numbers[k]
    assert isinstance(printed, fmpq)
    assert isinstance(near, fmpq)
    step = fmpq(1)
    while step > 2 * search.box.radii[k]:
        step /= 10
    step = next((x for x in (step, step / 10, step / 100) if (printed / x).q == 1), step)
    value = near + wide.box.radii[k] * wide.place.shifts[k]
    return step * (value / step + fmpq(1, 2)).floor()


def _repair(search: Recovery, k: int, change: Number) -> Repair | None:
    """The entry that is ± number k, with its new value; None if there is none."""
    forms, printed = search.origin.defects("method").tableau.made, search.origin.exact("method")
    entries: list[tuple[Repair, Any]] = [
        (Repair(l, m, i, j, old, old), form)
        for l, m in forms.edges()
        for i, rows in enumerate(_paired(printed.block(l, m), forms.block(l, m)))
        for j, (old, form) in enumerate(zip(*rows, strict=True))
    ]
    weights = [(False, "method")] + [(True, "embedded")] * ("embedded" in search.targets)
    for is_embedded, name in weights:
        rows_of = (
            search.origin.exact(name).colours,
            search.origin.defects(name).tableau.made.colours,
        )
        for l, (own, made) in enumerate(zip(*rows_of, strict=True)):
            for j, (old, form) in enumerate(zip(own.b, made.b, strict=True)):
                entries.append((Repair(l, None, None, j, old, old, is_embedded), form))
    with_it = [x for x in entries if isinstance(x[1], Affine) and k in x[1].slopes]
    sole = [x for x in with_it if len(x[1].slopes) == 1] or (with_it if len(with_it) == 1 else [])
    for repair, form in sole:
        slope = form.slopes[k] / to_float(search.box.radii[k])
        if abs(abs(slope) - 1) < NEARLY and isinstance(repair.old, fmpq):
            return replace(repair, new=repair.old + (change if slope > 0 else -change))
    return None


def _paired(printed: Matrix | None, forms: Matrix | None) -> Iterator[tuple[Vector, Vector]]:
    return zip(printed or (), forms or (), strict=True)
