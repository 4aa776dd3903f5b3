"""Objectives of a search in floats, with their gradients.

An objective is a smooth function of the unknowns x, or a *level*: the y up to which inequalities
g(x, y) ≥ 0 hold, a further unknown to maximise.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable, Sequence
from typing import TYPE_CHECKING, Any, TypeAlias, TypeVar

from flint import fmpq

from garkcli.design.minimise import objective as aims
from garkcli.design.minimise import objectives
from garkcli.design.minimise.measures import at_infinity, coefficients_of, numbers_of
from garkcli.design.minimise.sums import Wanted, objective_of
from garkcli.design.search.one_point import Functions
from garkcli.design.search.one_point import Matrix as Entries
from garkcli.design.search.rational import RationalFunction, as_float
from garkcli.design.search.residuals import Residuals
from garkcli.errors import UsageProblem
from garkcli.exact.field import ONE
from garkcli.exact.matrix import Matrix
from garkcli.exact.parametric import Parameters, Parametric
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
FINE = 16
"""Pieces between two of these, to see the minima between them."""
INNER = 3e-8
"""Distance of a stability function from 1 for the optimiser: rounding keeps it below 1."""
HEAVIEST = 1e5
"""Largest weight of a point near 0, so that rounding does not violate inequalities."""
EXACT = 1e8
"""Largest weight of a point from which a value at 0 is extrapolated: rounding grows with it."""
NOTHING = 1e-10
TINY = 1e-20
FAR = 1.5
"""Points of a half line are (1/t - 1)^FAR with t between 0 and 1."""


class TreeConditions:
    """The order conditions at the last point, remembered for values and gradients apart."""

    def __init__(self, conditions: Residuals) -> None:
        self.table = conditions.table
        self.at = kept(conditions.at_one)


def kept(function: Callable[[Array], T]) -> Callable[[Array], T]:
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
    """A function to minimise, with its gradient; ``parts`` are the terms of a sum of squares."""

    at: Callable[[Array], tuple[float, Array]]
    parts: Callable[[Array], Gradient] | None = None


class Reach(Frozen):
    """A level y to maximise, the last unknown of inequalities; ``margin`` is a lower bound on
    these.
    """

    at: Callable[[Array], Gradient]
    margin: float = 0.0


class Bound(Frozen):
    """Functions whose largest absolute value is to minimise."""

    at: Callable[[Array], Gradient]


Goal: TypeAlias = Smooth | Reach | Bound


class Setting:
    """Methods, with their errors in floats and their conditions up to the next order."""

    def __init__(
        self, subject: aims.ObjectiveSubject, ring: Parameters, trees: TreeConditions
    ) -> None:
        self.subject = subject
        self.tableau = subject.tableau
        self.order = subject.order
        self.ring = ring
        self.trees = trees
        self._further: dict[tuple[bool, int], TreeConditions] = {(False, subject.order + 1): trees}

    def errors(self, above: int, is_embedded: bool = False, is_coupling: bool = False) -> Errors:
        """The errors e(u) of all trees of an order. It is ``above`` that of the embedded weights,
        or, for their own errors at 1, of the methods.
        """
        tableau, order = self.tableau, self.order
        if is_embedded or above > 1:
            embedded, order = self.subject.embedded
            tableau = embedded if is_embedded else tableau
        key = is_embedded, order + above
        if key not in self._further:
            self._further[key] = TreeConditions(Residuals(tableau, self.ring, order + above))
        return errors_of(self._further[key], order + above, is_coupling)

    def functions(self, numbers: Iterable[object]) -> Functions:
        distinct = {x for x in numbers if isinstance(x, Parametric)}
        functions = [RationalFunction(x, self.ring) for x in distinct]
        return Functions(functions, len(self.ring.names))

    def sizes(self, numbers: Iterable[object]) -> Bound:
        import numpy as np

        every = list(numbers)
        functions = self.functions(every)
        sizes = [abs(as_float(x)) for x in every if isinstance(x, fmpq)]
        largest = np.array([max(sizes, default=0.0)])

        def at(x: Array) -> Gradient:
            values, slopes = functions.at(x)
            return np.append(values, largest), np.concatenate([slopes, np.zeros((1, len(x)))])

        return Bound(at)


def goal_of(objective: aims.Single, setting: Setting) -> Goal:
    """An objective in floats; UsageProblem if it is not applicable."""
    if objective.key in GOALS:
        return GOALS[objective.key](setting)
    assert isinstance(objective, aims.Objective)
    quotient = objective.formula(setting.subject, setting.ring)
    number = setting.ring.quotient(quotient.numerator, quotient.denominator)
    function = RationalFunction(number, setting.ring)
    return Smooth(_gradient_of(function, len(setting.ring.names)))


def terms_of(wanted: Wanted, tableau: Tableau) -> list[tuple[fmpq, aims.Single]]:
    """Objectives with their weights, which are negative for levels."""
    if isinstance(wanted, aims.WeightedSum):
        return list(wanted.terms)
    one = wanted.meant(tableau) if isinstance(wanted, aims.Either) else wanted
    return [(fmpq(-1 if isinstance(one, aims.LevelObjective) else 1), one)]


def levels_of(family: Family) -> list[tuple[aims.LevelObjective, fmpq]]:
    levels = [(objectives.OBJECTIVES[key], bound) for key, bound in family.levels]
    return [(x, bound) for x, bound in levels if isinstance(x, aims.LevelObjective)]


def objective_on(name: str, tableau: Tableau) -> aims.Single | aims.WeightedSum:
    objective = objective_of(name)
    return objective.meant(tableau) if isinstance(objective, aims.Either) else objective


def _gradient_of(
    function: RationalFunction, unknowns: int
) -> Callable[[Array], tuple[float, Array]]:
    functions = Functions([function], unknowns)

    def at(x: Array) -> tuple[float, Array]:
        values, gradients = functions.at(x)
        return float(values[0]), gradients[0]

    return at


Errors: TypeAlias = "Callable[[Array], Gradient]"
"""e(u) = (b·𝒜[u] − 1/γ(u)) / σ(u) of some trees, with derivatives."""


def errors_of(trees: TreeConditions, order: int, is_coupling: bool = False) -> Errors:
    """The errors of the trees of an order, or of those with several colours."""
    import numpy as np

    table = trees.table
    ids = [u for u in table.ids(order) if table.is_mixed[u] or not is_coupling]
    scale = np.array(
        [
            table.admissible.kinds[int(table.root[u])].integrated(order)
            / (int(table.gamma[u]) * int(table.sigma[u]))
            for u in ids
        ]
    )

    def at(x: Array) -> Gradient:
        values, gradients = trees.at(x)
        return scale * values[ids], scale[:, None] * gradients[ids]

    return at


def squared(parts: Errors) -> Smooth:
    def at(x: Array) -> tuple[float, Array]:
        e, slopes = parts(x)
        return float(e @ e), 2.0 * e @ slopes

    return Smooth(at, parts)


def quotient_of_norms(numerator: Errors, denominator: Errors | None = None) -> Smooth:
    import numpy as np

    def parts(x: Array) -> Gradient:
        e, slopes = numerator(x)
        size = 1.0 if denominator is None else max(float(np.linalg.norm(denominator(x)[0])), TINY)
        return e / size, slopes / size

    def at(x: Array) -> tuple[float, Array]:
        e, slopes = parts(x)
        value = max(float(np.linalg.norm(e)), TINY)
        gradient = e @ slopes / value
        if denominator is not None:
            d, of_d = denominator(x)
            gradient = gradient - value * (d @ of_d) / max(float(d @ d), TINY**2)
        return value, gradient

    return Smooth(at, parts)


def difference(one: Errors, other: Errors) -> Errors:
    def at(x: Array) -> Gradient:
        (e, of_e), (d, of_d) = one(x), other(x)
        return e - d, of_e - of_d

    return at


def _coupling(setting: Setting) -> Goal:
    objectives.refuse_one_colour(setting.tableau)
    return squared(setting.errors(1, is_coupling=True))


def _nonzero(setting: Setting) -> Goal:
    import numpy as np

    counts = Counter(coefficients_of(setting.tableau))
    unknown = {x: n for x, n in counts.items() if isinstance(x, Parametric)}
    known = sum(n for x, n in counts.items() if x and x not in unknown)
    functions = Functions(entries_of(setting.tableau, setting.ring), len(setting.ring.names))
    times = np.array(list(unknown.values()), float)

    def at(x: Array) -> tuple[float, Array]:
        values, _ = functions.at(x)
        return known + float(times @ (np.abs(values) > NOTHING)), np.zeros(len(x))

    return Smooth(at)


def entries_of(tableau: Tableau, ring: Parameters) -> list[RationalFunction]:
    unknown = (x for x in coefficients_of(tableau) if isinstance(x, Parametric))
    return [RationalFunction(x, ring) for x in dict.fromkeys(unknown)]


def _at_infinity(setting: Setting, tableau: Tableau, key: str) -> Goal:
    numerator, denominator = at_infinity(tableau, key)
    return setting.sizes([numerator / denominator])


def _interval(direction: complex) -> Callable[[Setting], Goal]:
    return lambda setting: Reach(
        _OnInterval(setting.tableau, setting.ring, direction, setting.order).at, INNER
    )


def _pair(setting: Setting, top: str) -> Goal:
    """B, C or E: ‖ê‖, ‖ê − e‖ or ‖e‖ two orders above the embedded weights, over ‖ê‖ one above."""
    own, embedded = setting.errors(2), setting.errors(2, is_embedded=True)
    above = {"B": embedded, "C": difference(embedded, own), "E": own}[top]
    return quotient_of_norms(above, setting.errors(1, is_embedded=True))


GOALS: dict[str, Callable[[Setting], Goal]] = {
    "error": lambda x: squared(x.errors(1)),
    "error-coupling": _coupling,
    "-ssp": lambda x: Reach(_Contractive(x.tableau, x.ring).at),
    "-real-interval": _interval(-1.0),
    "-imaginary-interval": _interval(1.0j),
    "-sector": lambda x: Reach(_Rays(x.tableau, x.ring).at),
    "-oscillator-interval": lambda x: Reach(_Oscillating(x.tableau, x.ring, x.order).at),
    "A": lambda x: quotient_of_norms(x.errors(1)),
    "largest-error": lambda x: Bound(x.errors(1)),
    "embedded-A": lambda x: quotient_of_norms(x.errors(1, is_embedded=True)),
    "B": lambda x: _pair(x, "B"),
    "C": lambda x: _pair(x, "C"),
    "D": lambda x: x.sizes(numbers_of(x.subject)),
    "E": lambda x: _pair(x, "E"),
    "largest": lambda x: x.sizes(coefficients_of(x.tableau)),
    "nonzero": _nonzero,
    "infinity": lambda x: _at_infinity(x, x.tableau, "infinity"),
    "embedded-infinity": lambda x: _at_infinity(x, x.subject.embedded[0], "embedded-infinity"),
}
"""The goals of objectives by key; of others the exact formula is evaluated."""


def _matrix(rows: Matrix, ring: Parameters) -> Entries:
    return Entries([[RationalFunction(x, ring) for x in row] for row in rows], len(ring.names))


class _Contractive:
    """M K_l ≥ 0 for each colour and M 𝟙 ≥ 0, M = (I + rK)⁻¹ (``garkcli.stability.ssp``)."""

    def __init__(self, tableau: Tableau, ring: Parameters) -> None:
        import numpy as np

        tableau.demand_fields("the SSP coefficient")
        if not all(isinstance(x, PointSpace) for x in tableau.spaces):
            message = "-ssp: families by name have no rational entries"
            cure = "spell the tableau out, stage by stage"
            raise UsageProblem(message, cure, code="no-radicals")
        _, parts = stacked(tableau, [ONE] * tableau.size)
        self.parts = [_matrix(part, ring) for part in parts]
        # entries of M K_l that vanish for all methods give no inequality
        reach = np.linalg.matrix_power(
            np.eye(len(parts[0])) + sum(map(_pattern, parts)), len(parts[0])
        )
        self.used = [np.nonzero(reach @ _pattern(part)) for part in parts]

    def at(self, point: Array) -> Gradient:
        import numpy as np

        x, r = point[:-1], point[-1]
        parts = [part.at(x) for part in self.parts]
        total = np.sum(parts, axis=0)
        K, dK = total[0], total[1:]
        M = np.linalg.inv(np.eye(len(K)) + r * K)
        dM = np.concatenate([-r * (M @ dK @ M), (-M @ K @ M)[None]])
        values, slopes = [M.sum(1)], [dM.sum(2)]
        for k, (rows, columns) in zip(parts, self.used, strict=True):
            slope = dM @ k[0]
            slope[:-1] += M @ k[1:]
            values.append((M @ k[0])[rows, columns])
            slopes.append(slope[:, rows, columns])
        return np.concatenate(values), np.concatenate(slopes, axis=1).transpose()


def _pattern(rows: Matrix) -> Array:
    import numpy as np

    return np.array([[float(bool(x)) for x in row] for row in rows])


class _Step:
    """The step on a linear problem at some complex z: M(z) = I + z B (I − zW)⁻¹ E."""

    def __init__(self, tableau: Tableau, ring: Parameters, fields: Sequence[Matrix]) -> None:
        system = stage_system(tableau, fields)
        self.pattern = _pattern(system.W)
        self.W, self.B = _matrix(system.W, ring), _matrix(system.B, ring)
        self.E = _matrix(system.E, ring)

    def at(self, x: Array, z: Array) -> tuple[Array, Array, Array]:
        """M and its derivatives in the unknowns and in z, at points z."""
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

    def values(self, x: Array, z: Array) -> Array:
        import numpy as np

        W, B, E = (m.at(x)[0] for m in (self.W, self.B, self.E))
        z = z[:, None, None]
        # before NumPy 2 a matrix beside a stack of them is a stack of vectors
        stages = np.linalg.solve(np.eye(len(W)) - z * W, E[None])
        M: Array = np.eye(len(B)) + z * (B @ stages)
        return M


class _Bounded:
    """|R(z)| ≤ 1 at points of a line, weighted so that points near 0 count too."""

    def __init__(self, step: _Step, direction: complex, power: int) -> None:
        self.step = step
        self.direction = direction
        self.power = power

    def weights(self, points: Array) -> Array:
        import numpy as np

        near: Array = np.minimum(np.minimum(1.0, points) ** -self.power, HEAVIEST)
        return near

    def over(self, x: Array, length: float, points: Array, weight: Array | None = None) -> Gradient:
        """Inequalities at multiples of a length, with derivatives by unknowns and by length."""
        import numpy as np

        z = self.direction * length * points
        M, slopes, by_z = (found[..., 0, 0] for found in self.step.at(x, z))
        weight = self.weights(points) if weight is None else weight
        value = 1 - np.abs(M) ** 2
        derivatives = -2 * (M.conj() * slopes).real
        by_length = -2 * (M.conj() * by_z * self.direction * points).real
        return weight * value, (weight * np.concatenate([derivatives, by_length[None]])).transpose()


class _OnInterval(_Bounded):
    """|R| ≤ 1 at points of [0, length], minima among them, and 0; length is the last unknown."""

    def __init__(self, tableau: Tableau, ring: Parameters, direction: complex, order: int) -> None:
        import numpy as np

        objectives.refuse_partitioned(tableau)
        step = _Step(on_linear_problems(tableau), ring, [((ONE,),)] * tableau.size)
        super().__init__(step, direction, 2 * (order // 2 + 1))
        self.grid = np.linspace(1 / SAMPLES, 1, (SAMPLES - 1) * FINE + 1)
        # 1 − |R(iy)|² over its first power of y is a polynomial in y² if R is one
        count = len(step.pattern) - order // 2
        is_exact = (
            direction.imag and not np.linalg.matrix_power(step.pattern, len(step.pattern)).any()
        )
        if not is_exact or count**self.power > EXACT:
            count = 0
        self.near = np.arange(1, count + 1) / max(count, 1)
        squares = self.near**2
        others = [np.delete(squares, k) for k in range(count)]
        # Lagrange's polynomials at 0
        self.at_zero = np.array(
            [np.prod(x / (x - u)) for u, x in zip(squares, others, strict=True)]
        )

    def at(self, point: Array) -> Gradient:
        import numpy as np

        x, length = point[:-1], float(point[-1])
        values, slopes = self.over(x, length, self._least(x, length))
        if len(self.near):
            first, of_first = self.over(x, length, self.near, self.near**-self.power)
            values = np.append(values, self.at_zero @ first)
            slopes = np.concatenate([slopes, (self.at_zero @ of_first)[None]])
        return values, slopes

    def _least(self, x: Array, length: float) -> Array:
        """Ends of pieces, or the minimum within by a parabola through three neighbours."""
        import numpy as np

        R = self.step.values(x, self.direction * length * self.grid)[:, 0, 0]
        values = self.weights(self.grid) * (1 - np.abs(R) ** 2)
        left, middle, right = values[:-2], values[1:-1], values[2:]
        curvature = left - 2 * middle + right
        points = self.grid[::FINE].copy()
        for k in np.flatnonzero((middle < left) & (middle <= right) & (curvature > 0)):
            shift = (left[k] - right[k]) / curvature[k] / 2
            points[k // FINE + 1] = self.grid[k + 1] + shift * (self.grid[1] - self.grid[0])
        return points


class AStable:
    """|R(iy)| ≤ 1 on the imaginary axis; λ ≠ 0 for one colour, from 0, or for all if None."""

    def __init__(self, family: Family, colour: int | None, order: int) -> None:
        tableau = family.tableau
        shares = [fmpq(int(colour in (None, l))) for l in range(tableau.size)]
        step = _Step(tableau, family.ring, [((share,),) for share in shares])
        self._bounded = _Bounded(step, 1.0j, order + 1)
        self._points = whole_axis()

    def at(self, x: Array) -> Gradient:
        values, derivatives = self._bounded.over(x, 1.0, self._points)
        return values, derivatives[:, :-1]


class _Rays:
    """|R| ≤ 1 at the edges of a sector; its angle in degrees ≤ 90 is the last unknown."""

    def __init__(self, tableau: Tableau, ring: Parameters) -> None:
        objectives.refuse_partitioned(tableau)
        self.step = _Step(on_linear_problems(tableau), ring, [((ONE,),)] * tableau.size)
        self.distances = whole_axis()

    def at(self, point: Array) -> Gradient:
        import numpy as np

        x, angle = point[:-1], float(point[-1])
        radian = np.pi / 180
        z = -self.distances * np.exp(-1j * radian * angle)
        M, slopes, by_z = (found[..., 0, 0] for found in self.step.at(x, z))
        weight = 1 / np.minimum(1.0, self.distances)
        value = 1 - np.abs(M) ** 2
        derivatives = -2 * (M.conj() * slopes).real
        by_angle = -2 * (M.conj() * by_z * z * -1j * radian).real
        below = np.zeros((len(point), 1))
        below[-1] = -1 / 90
        inequalities = weight * np.concatenate([derivatives, by_angle[None]])
        return (
            np.append(weight * value, 1 - angle / 90),
            np.concatenate([inequalities, below], axis=1).transpose(),
        )


def whole_axis() -> Array:
    import numpy as np

    t = np.arange(1, SAMPLES + 1) / (SAMPLES + 1)
    points: Array = (1 / t - 1) ** FAR
    return points


class _Oscillating:
    """Bounded powers of the step on the oscillator: det M ≤ 1 and |tr M| ≤ 1 + det M. They hold at
    points of an interval of hω from 0, whose length is the last unknown.
    """

    def __init__(self, tableau: Tableau, ring: Parameters, order: int) -> None:
        import numpy as np

        problem = objectives.oscillator_of(tableau)
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
