"""Computes the method that a rounded one is taken to be, to any number of digits.

Of the methods of the box that meet the rows of the search it is nearest to the print: the shifts x,
in units of their radii and at most 1, have the least sum of squares. With rows F and slopes J at x,
the next x' is the least one with F(x) + J·(x' − x) = 0. Smaller radii gain more digits a step; rows
that determine the method give Newton's method. Slopes are differences over steps far below the last
digit; all is in balls.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from flint import arb, arb_mat, ctx, fmpq

from garkcli.deadline import check_time
from garkcli.errors import MethodError
from garkcli.exact.display import BITS_OF_A_DIGIT
from garkcli.exact.enclosing import midpoint
from garkcli.order.place import BoxPlace
from garkcli.order.rows import System, of_tree

if TYPE_CHECKING:
    from garkcli.order.recovering import Recovery

SPARE_DIGITS = 12
AT_AN_END = 1 - 1e-6
"""A shift that is held at an end is released if it would be below this."""
MOST_STEPS = 60
"""Steps besides one for each bit; without progress the search ends earlier."""


def polished(search: Recovery, digits: int) -> BoxPlace:
    """The method nearest to the print that meets all rows, to ``digits`` digits after the point.
    Raises MethodError if rows are met to second order only, or the steps do not converge.
    """
    place = search.settled
    system = search.wanted
    if not any(system.values()):
        return place
    bits = int((digits + SPARE_DIGITS) * BITS_OF_A_DIGIT)
    # a shift times its radius is what a number is off by
    bits = max(bits, search.zero_bits)
    finer = search.finer(2 * bits + _finest(search) + 64)
    for _ in range(8):
        place = _Polishing(finer, system, bits).nearest(place.shifts)
        missed = finer.missed_at(place)
        if not missed:
            return place
        more: System = {
            name: {of_tree(u, finer.share(name, u.order)): [0] for u in trees}
            for name, trees in missed.items()
        }
        system = {
            name: {**system.get(name, {}), **more.get(name, {})} for name in {**system, **more}
        }
    raise _unknown()


def _finest(search: Recovery) -> int:
    return max((int(t.q.bit_length() - t.p.bit_length()) + 1 for t in search.box.radii), default=0)


def _unknown() -> MethodError:
    message = "its conditions are met to second order only: no more digits of it are known"
    cure = "a tolerance nearer to the printed digits may single it out"
    return MethodError(message, cure, code="cannot-convert")


class _Polishing:
    """The iteration to the nearest method; ``bits`` is the precision of its shifts. ``search`` has
    enough bits for the slopes.
    """

    def __init__(self, search: Recovery, system: System, bits: int) -> None:
        self.search = search
        self.system = system
        self.bits = bits
        reach = search.origin.rows(system).reach
        least = 1e-12 * search.radius
        self.scales = [arb(max(float(x), least)) for x in reach]
        # singular values are of the order of a radius where varieties cross, errors of its square
        self.grain = arb(2) ** -(3 * _finest(search) // 2 + 40)
        # a number that has to be at an end gets there from both sides
        self.end = 1 + arb(2) ** -(bits // 2)

    def nearest(self, shifts: Sequence[fmpq]) -> BoxPlace:
        x = [*shifts]
        slopes: arb_mat | None = None
        goal, before = arb(2) ** -self.bits, arb(2)
        with ctx.workprec(self.search.bits):
            for step in range(MOST_STEPS + self.bits):
                check_time()
                place = BoxPlace(self.search, x)
                values = self._values(place)
                if slopes is None:
                    slopes = self._slopes(x, values)
                moved, is_free = self._least(slopes, values, x)
                change = max(
                    (abs(new - arb(old)) for new, old in zip(moved, x, strict=True)), default=arb(0)
                )
                x = [min(max(midpoint(y), fmpq(-1)), fmpq(1)) for y in moved]
                if change < goal:
                    return self._checked(BoxPlace(self.search, x))
                if step > 6 and not change < before:
                    raise _unknown()
                # where the rows leave nothing free the old slopes do
                if is_free or not change < 1e-6 * before:
                    slopes = None
                before = change
        raise _unknown()

    def _values(self, place: BoxPlace) -> list[arb]:
        found = place.values(self.system)
        return [x / scale for x, scale in zip(found, self.scales, strict=True)]

    def _slopes(self, x: Sequence[fmpq], values: Sequence[arb]) -> arb_mat:
        h = fmpq(1, 1 << self.bits)
        columns = []
        for k in range(len(x)):
            check_time()
            beside = [y + h if i == k else y for i, y in enumerate(x)]
            there = self._values(BoxPlace(self.search, beside))
            columns.append([((a - b) / h).mid() for a, b in zip(there, values, strict=True)])
        return arb_mat([list(row) for row in zip(*columns, strict=True)])

    def _least(
        self, slopes: arb_mat, values: Sequence[arb], x: Sequence[fmpq]
    ) -> tuple[list[arb], bool]:
        """The least x' with F + J·(x' − x) = 0 and |x'_k| ≤ 1, and whether others are free. Numbers
        at an end are released if they pull inwards.
        """
        count = len(x)
        rows = slopes.tolist()
        here = arb_mat([[arb(y)] for y in x])
        wanted = [y - value for (y,), value in zip((slopes * here).tolist(), values, strict=True)]
        held = [0] * count
        for _ in range(3 * count + 10):
            free = [k for k in range(count) if not held[k]]
            chosen = _independent([[row[k] for k in free] for row in rows], self.grain)
            moved = [arb(end) for end in held]
            pulls = arb_mat(count, 1)
            if chosen:
                part = arb_mat([[rows[i][k] for k in free] for i in chosen])
                by_held = [
                    sum((rows[i][k] * held[k] for k in range(count) if held[k]), arb(0))
                    for i in chosen
                ]
                right = arb_mat([[wanted[i] - y] for i, y in zip(chosen, by_held, strict=True)])
                weights = (part * part.transpose()).mid().solve(right.mid()).mid()
                pulls = arb_mat([rows[i] for i in chosen]).transpose() * weights
                for k in free:
                    moved[k] = pulls[k, 0].mid()
            beyond = [k for k in free if abs(moved[k]) > self.end]
            if beyond:
                for k in beyond:
                    held[k] = 1 if moved[k] > 0 else -1
                continue
            loose = [k for k in range(count) if held[k] and pulls[k, 0] * held[k] < AT_AN_END]
            if not loose:
                return moved, len(chosen) < len(free)
            held[min(loose, key=lambda k: float((pulls[k, 0] * held[k]).mid()))] = 0
        raise _unknown()

    def _checked(self, place: BoxPlace) -> BoxPlace:
        small = arb(2) ** -(3 * self.bits // 4)
        if not place.is_inside or not all(abs(x) < small for x in self._values(place)):
            raise _unknown()
        return place


def _independent(rows: Sequence[Sequence[arb]], grain: arb) -> list[int]:
    """Independent rows by elimination, the largest rest first."""
    rest = {i: arb_mat([list(row)]) for i, row in enumerate(rows) if row}
    chosen: list[int] = []
    while rest:
        sizes = {i: float((row * row.transpose())[0, 0].mid().sqrt()) for i, row in rest.items()}
        i = max(sizes, key=sizes.__getitem__)
        row = rest.pop(i)
        square = (row * row.transpose())[0, 0].mid()
        if not square > grain * grain:
            break
        chosen.append(i)
        for j, other in rest.items():
            share = ((other * row.transpose())[0, 0] / square).mid()
            rest[j] = (other - row * share).mid()
    return sorted(chosen)
