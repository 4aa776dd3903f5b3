"""Objectives of a search in floats, with their gradients.

An objective is a smooth function of the unknowns x, or a *level*: the y up to which inequalities
g(x, y) ≥ 0 hold, which is made as large as possible as a further unknown.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any, TypeAlias, TypeVar

from flint import fmpq

from garkcli.design.minimise.objective import Either, Level, Objective
from garkcli.design.minimise.objectives import (
    OBJECTIVES,
    oscillator_of,
    refuse_one_colour,
    refuse_partitioned,
)
from garkcli.design.search.one_point import Functions
from garkcli.design.search.one_point import Matrix as Entries
from garkcli.design.search.rational import RationalFunction
from garkcli.design.search.residuals import Residuals
from garkcli.errors import UsageProblem
from garkcli.exact.field import ONE
from garkcli.exact.matrix import Matrix
from garkcli.exact.parametric import Parameters
from garkcli.frozen import Frozen
from garkcli.stability.ssp import stacked
from garkcli.stepping.linear import stage_system
from garkcli.tableau.family import Family
from garkcli.tableau.forms import on_linear_problems
from garkcli.tableau.stages import PointSpace
from garkcli.tableau.tableau import Tableau

if TYPE_CHECKING:
    from garkcli.design.search.chart import Gradient
    from garkcli.design.search.rational import Array

T = TypeVar("T")
SAMPLES = 40
"""Points of an interval at which a stability function is held against 1."""
HEAVIEST = 1e5
"""The largest weight of a point near 0: rounding must not look like an inequality that fails."""
FAR = 1.5
"""Points of the imaginary axis, for A-stability, are y = (1/t - 1)^FAR with t between 0 and 1."""


class Trees:
    """The order conditions at one point, kept until the next point: an optimiser wants values and
    gradients one after the other.

    Args:
        conditions: of all trees up to some order.
    """

    def __init__(self, conditions: Residuals) -> None:
        self.table = conditions.table
        self.at = kept(conditions.at_one)


def kept(function: Callable[[Array], T]) -> Callable[[Array], T]:
    """A function that remembers its last value."""
    last: dict[bytes, T] = {}

    def at(x: Array) -> T:
        key = x.tobytes()
        if key not in last:
            value = function(x)
            last.clear()
            last[key] = value
        return last[key]

    return at


class Smooth(Frozen):
    """A function of the unknowns to be made small.

    Attributes:
        at: its value and its gradient, shape (unknowns,), at a point, shape (unknowns,).
        parts: if it is a sum of squares, what is squared, with derivatives.
    """

    at: Callable[[Array], tuple[float, Array]]
    parts: Callable[[Array], Gradient] | None = None


class Reach(Frozen):
    """A level to be made large.

    Attributes:
        at: the inequalities at a point of the unknowns, with y as the last one.
    """

    at: Callable[[Array], Gradient]


Goal: TypeAlias = Smooth | Reach


def goal_of(
    objective: Objective | Level, tableau: Tableau, order: int, ring: Parameters, trees: Trees
) -> Goal:
    """The objective in floats.

    Args:
        objective: one of ``OBJECTIVES``.
        tableau: of the methods.
        order: of the methods.
        ring: the unknowns.
        trees: the conditions up to the next order.

    Raises:
        UsageProblem: it has no meaning for the methods.
    """
    match objective.key:
        case "error":
            return squared_error(trees, is_coupling=False)
        case "error-coupling":
            refuse_one_colour(tableau)
            return squared_error(trees, is_coupling=True)
        case "-ssp":
            return Reach(_Contractive(tableau, ring).at)
        case "-real-interval":
            return Reach(_Bounded.on_line(tableau, ring, -1.0, order).at)
        case "-imaginary-interval":
            return Reach(_Bounded.on_line(tableau, ring, 1.0j, order).at)
        case "-oscillator-interval":
            return Reach(_Oscillating(tableau, ring, order).at)
    assert isinstance(objective, Objective)
    quotient = objective.formula(tableau, order, ring)
    whole = RationalFunction(ring.quotient(quotient.numerator, quotient.denominator), ring)
    return Smooth(_alone(whole, len(ring.names)))


def meant(name: str, tableau: Tableau) -> Objective | Level:
    """The objective of a name, for a tableau."""
    objective = OBJECTIVES[name]
    return objective.meant(tableau) if isinstance(objective, Either) else objective


def _alone(function: RationalFunction, unknowns: int) -> Callable[[Array], tuple[float, Array]]:
    functions = Functions([function], unknowns)

    def at(x: Array) -> tuple[float, Array]:
        values, gradients = functions.at(x)
        return float(values[0]), gradients[0]

    return at


def squared_error(trees: Trees, is_coupling: bool) -> Smooth:
    """Σ e(u)² over the trees of the highest order, e(u) = (b·𝒜[u] − 1/γ(u)) / σ(u).

    Args:
        trees: the conditions up to that order.
        is_coupling: whether trees of one colour are left out.
    """
    import numpy as np

    table = trees.table
    ids = [u for u in table.ids(table.max_order) if table.is_mixed[u] or not is_coupling]
    scale = np.array(
        [
            table.admissible.kinds[int(table.root[u])].integrated(table.max_order)
            / (int(table.gamma[u]) * int(table.sigma[u]))
            for u in ids
        ]
    )

    def at(x: Array) -> tuple[float, Array]:
        values, gradients = trees.at(x)
        e = scale * values[ids]
        return float(e @ e), 2.0 * (scale * e) @ gradients[ids]

    def parts(x: Array) -> Gradient:
        values, gradients = trees.at(x)
        return scale * values[ids], scale[:, None] * gradients[ids]

    return Smooth(at, parts)


def _matrix(rows: Matrix, ring: Parameters) -> Entries:
    """A matrix of rational functions, at points."""
    return Entries([[RationalFunction(x, ring) for x in row] for row in rows], len(ring.names))


class _Contractive:
    """The conditions of absolute monotonicity (``garkcli.stability.ssp``): with M = (I + rK)⁻¹,
    M K_l ≥ 0 for each colour and M 𝟙 ≥ 0.
    """

    def __init__(self, tableau: Tableau, ring: Parameters) -> None:
        import numpy as np

        tableau.demand_fields("the SSP coefficient")
        if not all(isinstance(x, PointSpace) for x in tableau.spaces):
            message = "-ssp: families by name have no rational entries"
            cure = "spell the tableau out, stage by stage"
            raise UsageProblem(message, cure, code="no-radicals")
        _, parts = stacked(tableau, [ONE] * tableau.size)
        self.parts = [_matrix(part, ring) for part in parts]
        # entries of M K_l that are zero for all methods decide nothing
        reach = np.linalg.matrix_power(
            np.eye(len(parts[0])) + sum(map(_pattern, parts)), len(parts[0])
        )
        self.used = [np.nonzero(reach @ _pattern(part)) for part in parts]

    def at(self, point: Array) -> Gradient:
        import numpy as np

        x, r = point[:-1], point[-1]
        found = [part.at(x) for part in self.parts]
        total = np.sum(found, axis=0)
        K, dK = total[0], total[1:]
        M = np.linalg.inv(np.eye(len(K)) + r * K)
        dM = np.concatenate([-r * (M @ dK @ M), (-M @ K @ M)[None]])
        values, slopes = [M.sum(1)], [dM.sum(2)]
        for k, (rows, columns) in zip(found, self.used, strict=True):
            slope = dM @ k[0]
            slope[:-1] += M @ k[1:]
            values.append((M @ k[0])[rows, columns])
            slopes.append(slope[:, rows, columns])
        return np.concatenate(values), np.concatenate(slopes, axis=1).transpose()


def _pattern(rows: Matrix) -> Array:
    """Where a matrix has entries, as 0 and 1."""
    import numpy as np

    return np.array([[float(bool(x)) for x in row] for row in rows])


class _Step:
    """The step on a linear problem at some complex z: M(z) = I + z B (I − zW)⁻¹ E."""

    def __init__(self, tableau: Tableau, ring: Parameters, fields: Sequence[Matrix]) -> None:
        system = stage_system(tableau, fields)
        self.W, self.B = _matrix(system.W, ring), _matrix(system.B, ring)
        self.E = _matrix(system.E, ring)

    def at(self, x: Array, z: Array) -> tuple[Array, Array, Array]:
        """M, its derivatives by the unknowns, and by z.

        Args:
            x: shape (unknowns,).
            z: shape (points,).
        """
        import numpy as np

        every = self.W.at(x), self.B.at(x), self.E.at(x)
        (W, B, E), (dW, dB, dE) = [m[0] for m in every], [m[1:] for m in every]
        z = z[:, None, None]
        inverse = np.linalg.inv(np.eye(len(W)) - z * W)
        right, left = inverse @ E, B @ inverse
        M = np.eye(len(B)) + z * (B @ right)
        slopes = z * (dB[:, None] @ right)
        slopes = slopes + z * (left @ dE[:, None]) + z * z * (left @ dW[:, None] @ right)
        by_z = B @ right + z * (left @ W @ right)
        return M, slopes, by_z


class _Bounded:
    """|R(z)| ≤ 1 at points of a line, times weights, so that points near 0 count too."""

    def __init__(self, step: _Step, direction: complex, points: Array, power: int) -> None:
        self.step = step
        self.direction = direction
        self.points = points
        self.power = power

    @classmethod
    def on_line(
        cls, tableau: Tableau, ring: Parameters, direction: complex, order: int
    ) -> _Bounded:
        """On an interval from 0 on, whose length is the last unknown."""
        import numpy as np

        refuse_partitioned(tableau)
        step = _Step(on_linear_problems(tableau), ring, [((ONE,),)] * tableau.size)
        return cls(step, direction, np.arange(1, SAMPLES + 1) / SAMPLES, order + 1)

    def at(self, point: Array) -> Gradient:
        """The inequalities and their derivatives, the length of the interval the last unknown."""
        return self.over(point[:-1], float(point[-1]))

    def over(self, x: Array, length: float) -> Gradient:
        """The inequalities on an interval of some length."""
        import numpy as np

        z = self.direction * length * self.points
        M, slopes, by_z = (found[..., 0, 0] for found in self.step.at(x, z))
        weight = np.minimum(np.minimum(1.0, self.points) ** -self.power, HEAVIEST)
        value = 1 - np.abs(M) ** 2
        derivatives = -2 * (M.conj() * slopes).real
        by_length = -2 * (M.conj() * by_z * self.direction * self.points).real
        return weight * value, (weight * np.concatenate([derivatives, by_length[None]])).transpose()


class AStable:
    """|R(iy)| ≤ 1 at points of the whole imaginary axis.

    Args:
        family: on linear problems.
        colour: the one that is driven, counted from 0; None for all.
        order: of the methods.
    """

    def __init__(self, family: Family, colour: int | None, order: int) -> None:
        import numpy as np

        tableau = family.tableau
        shares = [fmpq(int(colour in (None, l))) for l in range(tableau.size)]
        step = _Step(tableau, family.ring, [((share,),) for share in shares])
        t = np.arange(1, SAMPLES + 1) / (SAMPLES + 1)
        self._bounded = _Bounded(step, 1.0j, (1 / t - 1) ** FAR, order + 1)

    def at(self, x: Array) -> Gradient:
        """The inequalities and their derivatives by the unknowns."""
        values, derivatives = self._bounded.over(x, 1.0)
        return values, derivatives[:, :-1]


class _Oscillating:
    """All powers of the step on the oscillator are bounded: det M ≤ 1 and |tr M| ≤ 1 + det M at
    points of an interval of hω from 0 on, whose length is the last unknown.
    """

    def __init__(self, tableau: Tableau, ring: Parameters, order: int) -> None:
        import numpy as np

        problem = oscillator_of(tableau)
        fields = [problem.matrix(colour) for colour in tableau.colours]
        self.step = _Step(tableau, ring, fields)
        self.points = np.arange(1, SAMPLES + 1) / SAMPLES
        self.power = order + 1

    def at(self, point: Array) -> Gradient:
        import numpy as np

        x, length = point[:-1], float(point[-1])
        M, slopes, by_z = self.step.at(x, length * self.points)
        every: Any = np.concatenate([slopes, (by_z * self.points[:, None, None])[None]])
        det = M[:, 0, 0] * M[:, 1, 1] - M[:, 0, 1] * M[:, 1, 0]
        of_det = every[..., 0, 0] * M[:, 1, 1] + M[:, 0, 0] * every[..., 1, 1]
        of_det = of_det - every[..., 0, 1] * M[:, 1, 0] - M[:, 0, 1] * every[..., 1, 0]
        trace = M[:, 0, 0] + M[:, 1, 1]
        of_trace = every[..., 0, 0] + every[..., 1, 1]
        small = np.minimum(1.0, self.points)
        near, far = np.minimum(small**-self.power, HEAVIEST), small**-2.0
        values = [near * (1 - det), far * (1 + det - trace), 1 + det + trace]
        derivatives = [-near * of_det, far * (of_det - of_trace), of_det + of_trace]
        return np.concatenate(values), np.concatenate(derivatives, axis=1).transpose()
