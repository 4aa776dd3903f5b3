"""Affine rows in bounded numbers: steps that make all of them zero, and proofs that none does."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from flint import arb, ctx, fmpq

from garkcli import numpy_on_use as np
from garkcli.deadline import check_time
from garkcli.exact.affine import UNIT, Forms
from garkcli.exact.display import to_float

if TYPE_CHECKING:
    from garkcli.exact.affine import Floats

INDEPENDENT = 1e-6
"""Rows with a smaller part outside the span of the others count as dependent."""
END = 1 - 1e-8
"""Bound of a step to first order: second-order terms have the rest."""
RIDGE = 1e-3
"""Cost of a shift by its radius, in the compromise between rows that exclude each other."""
MISS = 1e-9
"""Rows with smaller residuals count as met to first order: small slopes were dropped."""
FLOOR = 1e-10
"""Singular values below this part of the largest count as rounding."""


class Solver:
    """Newton steps with the slopes of ``rows`` at one method; ``groups`` of numbers are tied."""

    def __init__(
        self, rows: Forms, radius: float, groups: Sequence[int], fixed: Floats | None = None
    ) -> None:
        self.rows = rows
        self.groups = np.array(groups, int)
        scale = np.maximum(rows.reach, 1e-12 * radius)
        self.balls = [arb(float(x)) for x in scale]
        self.alone = rows.slopes / scale[:, None]
        self.slopes = together(self.alone, self.groups)
        self.fixed = np.zeros(self.slopes.shape[1], bool) if fixed is None else fixed
        self._inverse: Floats | None = None
        self._cut = 0.0

    def nearest(self, parts: Sequence[arb], shifts: Sequence[fmpq], cut: float) -> Floats | None:
        """Returns the shifts nearest to the print to first order; None if none meet the rows."""
        here = np.array([to_float(x) for x in shifts])
        floats = np.array([float(x.mid()) for x in parts])
        near = nearest(self.slopes, floats - self.alone @ here, cut)
        if near is None:
            return None
        self.fixed = np.abs(near) >= END
        self._inverse = None
        each: Floats = near[self.groups]
        return each

    def step(self, parts: Sequence[arb], unit: arb, cut: float) -> Floats:
        """The smallest change that makes all rows zero to first order, in some unit."""
        if self._inverse is None or cut < 1e-3 * self._cut:
            self._inverse = _pseudo_inverse(np.where(self.fixed, 0.0, self.slopes), cut)
            self._cut = cut
        change = -(self._inverse @ np.array([float((x / unit).mid()) for x in parts]))
        change[self.fixed] = 0.0  # exactly
        each: Floats = change[self.groups]
        return each


def together(slopes: Floats, groups: Floats) -> Floats:
    count = int(groups.max(initial=-1)) + 1
    if count == slopes.shape[1]:
        return slopes
    sums = np.zeros((slopes.shape[0], count))
    for k, group in enumerate(groups):
        sums[:, group] += slopes[:, k]
    return sums


def orthonormal(rows: Floats) -> Floats:
    """Returns a basis of the span of rows, without directions that are rounding."""
    norms = np.maximum(np.linalg.norm(rows, axis=1), 1e-300)
    _, s, v = np.linalg.svd(rows / norms[:, None], full_matrices=False)
    basis: Floats = v[: int((s > INDEPENDENT).sum())]
    return basis


def scaled(rows: Forms) -> tuple[Floats, Floats, Floats]:
    scale = np.maximum(rows.reach + rows.remainders, 1e-300)
    return rows.middle / scale, rows.slopes / scale[:, None], scale


def excludes(rows: Forms, y: Floats) -> bool:
    """Whether y · rows is nonzero in the whole box: a proof that no method meets them all."""
    count = len(rows)
    with ctx.workprec(200):
        centre = abs(sum((arb(float(a)) * x for a, x in zip(y, rows.centres, strict=True)), arb(0)))
    sizes = np.abs(y)
    slope = np.abs(y @ rows.slopes).sum() + sizes @ rows.remainders
    lost = (
        (count + rows.slopes.shape[1] + 8) * UNIT * (sizes @ rows.reach + sizes @ rows.remainders)
    )
    return bool(centre > (slope + lost) * (1 + UNIT))


def compromise(G: Floats, c: Floats) -> Floats:
    """Shifts with Σ |c + G x| about minimal and a penalty for |x_k| > 1."""
    misses, shifts = np.ones(len(c)), np.zeros(G.shape[1])
    for _ in range(12):
        check_time()
        loose = 1 / np.maximum(1, np.abs(shifts)) ** 4
        allowed = RIDGE * np.maximum(np.abs(misses), 1e-6)
        gram = (G * loose) @ G.T
        gram[np.diag_indices_from(gram)] += allowed
        forces = np.linalg.solve(gram, c)
        misses, shifts = allowed * forces, -loose * (G.T @ forces)
    return misses


def bounded_least_squares(G: Floats, c: Floats) -> Floats:
    # active sets (P. Stark, R. Parker, *Bounded-variable least-squares*, 1995)
    count = G.shape[1]
    if len(G) > count:  # sums of squares up to a constant
        q, G = np.linalg.qr(G)
        c = q.T @ c
    x: Floats = np.clip(np.linalg.lstsq(G, -c, rcond=1e-12)[0], -1, 1)
    bound = np.where(np.abs(x) == 1, x, 0).astype(int)  # −1, 1: at that end
    for _ in range(3 * count + 10):
        check_time()
        free = bound == 0
        if free.any():
            right = -(c + G[:, ~free] @ x[~free])
            wanted = np.linalg.lstsq(G[:, free], right, rcond=1e-12)[0]
            step = wanted - x[free]
            room = np.where(step > 0, 1 - x[free], -1 - x[free])
            with np.errstate(all="ignore"):
                share = np.where(step != 0, room / step, np.inf)
            least = float(share.min(initial=np.inf))
            if least < 1:
                x[free] += max(least, 0.0) * step
                places = np.flatnonzero(free)
                for k in places[share <= least]:
                    bound[k] = 1 if step[np.searchsorted(places, k)] > 0 else -1
                    x[k] = bound[k]
                continue
            x[free] = wanted
        slope = (G.T @ (c + G @ x)) * bound
        worst = int(np.argmax(slope))
        if slope[worst] <= 1e-13:
            break
        bound[worst] = 0
    return x


def nearest(J: Floats, c: Floats, cut: float) -> Floats | None:
    """The smallest x with |x_k| ≤ 1 and c + J x = 0, up to rounding; None if none is found. Entries
    beyond an end are held close to it, or at it if needed (numbers halfway between two decimals are
    rounded by their radius), and released if the others pull them back.
    """
    for end, miss in ((END, 1e-4 * (1 - END)), (1.0, MISS), (END, MISS)):
        x = _nearest(J, c, cut, end, miss)
        if x is not None:
            return np.where(np.abs(x) < END, x, np.sign(x)) if end == 1 else x
    return None


def _nearest(J: Floats, c: Floats, cut: float, end: float, miss: float) -> Floats | None:
    """Returns ``nearest`` with |x_k| ≤ ``end`` and residuals up to ``miss``."""
    count = J.shape[1]
    held = np.zeros(count)
    for _ in range(count + 20):
        free = held == 0
        if not free.any():
            return None
        inverse = _pseudo_inverse(J[:, free], cut)
        x = held.copy()
        x[free] = -(inverse @ (c + J @ held))
        if np.abs(c + J @ x).max(initial=0) > miss:
            return None
        beyond = np.abs(x) > end
        if beyond.any():
            held[beyond] = end * np.sign(x[beyond])
            continue
        pull = J.T @ (inverse.T @ x[free]) * np.sign(held)
        loose = (held != 0) & (pull < end * (1 - 1e-9))
        if not loose.any():
            return x
        held[int(np.argmin(np.where(loose, pull, np.inf)))] = 0
    return None


def _pseudo_inverse(J: Floats, cut: float) -> Floats:
    """J⁺ without singular values below ``cut`` times the largest."""
    u, s, v = np.linalg.svd(J, full_matrices=False)
    rank = int((s > cut * s[0]).sum())
    inverse: Floats = (v[:rank].T / s[:rank]) @ u[:, :rank].T
    return inverse


def exactly(x: float) -> fmpq:
    return fmpq(*x.as_integer_ratio())


def dyadic(x: float, bits: int) -> fmpq:
    return fmpq(int(x * 2.0**bits), 1 << bits)
