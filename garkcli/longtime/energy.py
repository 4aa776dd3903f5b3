"""The energy error over a long time, far above its own rounding errors.

In the variables z = (ωq, p) the energy is H = ½|z|². With n = iK + j the error is summed as

    H(z_n) − H(z_0) = [H(z_{iK}) − H(z_0)] + z_{iK}ᵀ Q_j z_{iK},      Q_j = ½ ((R^j)ᵀ R^j − I).

Both parts are of the size of the error itself. The K forms Q_j and the block starts z_{iK} are
computed in balls, the outer sum of N = K² terms in floats: it loses a few units of its own last
digit, whatever the method's error.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import isqrt
from typing import TYPE_CHECKING, TypeAlias

from flint import arb, arb_mat, ctx, fmpq

from garkcli.errors import UsageProblem
from garkcli.exact.matrix import Matrix
from garkcli.longtime.stability import Stability, stability
from garkcli.problems.oscillator import Oscillator
from garkcli.stepping.linear import conserves_energy, enclosure, linear_step, whole_steps
from garkcli.tableau.tableau import Tableau

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Floats: TypeAlias = NDArray[np.float64]

MAX_STEPS = 10_000_000
"""Most steps: each is a float in memory."""
SERIES = 2000
"""Most points of the series kept for a plot."""
BLOW_UP = 1e30
"""How many times the energy the energy error may become before a run ends as unstable."""
_GOAL = 60  # bits of the largest energy error that balls have to get right
_CHUNK = 65536  # steps that a fit looks at at a time
_ROUNDING = 2.0**-42  # of a slope in all, of the largest error: floats are summed
_FLOOR = 1000  # energy errors below 2^-1000 count as zero: floats end there


@dataclass(frozen=True)
class Drift:
    """The energy error over a long time.

    Attributes:
        problem: the oscillator and its split; q(0) = 1, p(0) = ω/2.
        step: h.
        t_end: the time asked for.
        steps: how many steps were done; fewer than t_end/h only if the energy ``blew_up``.
        initial_energy: H(0) = 5ω²/8.
        max_energy_error: max |H(t_n) − H(0)|, absolute.
        drift: d in the least-squares fit H(t) − H(0) ≈ e + d t + a cos 2θn + b sin 2θn, with
            e^{±iθ} the directions of the eigenvalues of R(h); without a, b where these are real or
            turn too slowly to be told from a line. Energy per unit of time.
        uncertainty: of ``drift``: how far it is in the halves of the run from that in all of it.
        amplitude: half the range of H(t) − H(0) − d t.
        stability: what becomes of the energy for ever, decided exactly.
        is_exact: whether H is conserved exactly.
        blew_up: whether the energy error passed ``BLOW_UP`` times the energy.
        times: times for a plot, at most ``SERIES``, ascending.
        energy_errors: H(t) − H(0), with its sign, at these times: extremes of equal spans.
    """

    problem: Oscillator
    step: fmpq
    t_end: fmpq
    steps: int
    initial_energy: float
    max_energy_error: float
    drift: float
    uncertainty: float
    amplitude: float
    stability: Stability
    is_exact: bool
    blew_up: bool
    times: tuple[float, ...]
    energy_errors: tuple[float, ...]


def drift(
    tableau: Tableau, problem: Oscillator, t_end: fmpq, step: fmpq, points: int = SERIES
) -> Drift:
    """Follow the energy of ``problem`` under ``tableau`` to the time ``t_end``; keep a series of
    ``points``.

    Raises:
        UsageProblem: the split does not fit the structure, the step does not divide the time, there
            are more than ``MAX_STEPS`` of them, or the stage equations have no unique solution.
    """
    import numpy as np

    count = whole_steps(t_end, step)
    if count > MAX_STEPS:
        raise UsageProblem(
            f"{count} steps (limit {MAX_STEPS})", "choose a shorter time or a larger step"
        )
    R = linear_step(tableau, problem).at(step)
    energy = float(5 * problem.omega**2 / 8)
    is_exact = conserves_energy(R, problem.omega)
    errors = np.zeros(count + 1) if is_exact else _energy_errors(R, problem.omega, count)
    too_large = np.flatnonzero(~(np.abs(errors) <= BLOW_UP * energy))
    if too_large.size:
        errors = errors[: int(too_large[0])]
    kept = np.union1d(extremes(errors, points - 2), [0, len(errors) - 1])
    slope, uncertainty = _drift(errors, _angle(R, problem.omega))
    left = errors[kept] - slope * kept
    return Drift(
        problem,
        step,
        t_end,
        len(errors) - 1,
        energy,
        float(np.abs(errors).max()),
        slope / float(step),
        uncertainty / float(step),
        float(left.max() - left.min()) / 2,
        stability(R),
        is_exact,
        bool(too_large.size) or len(errors) <= count,
        tuple((kept * float(step)).tolist()),
        tuple(errors[kept].tolist()),
    )


def _scaled(R: Matrix, omega: fmpq, bits: int) -> arb_mat:
    """R in the variables (ωq, p)."""
    (a, b), (c, d) = R
    return enclosure(((a, b * omega), (c * (1 / omega), d)), bits)


def _energy_errors(R: Matrix, omega: fmpq, count: int) -> Floats:
    """H(z_n) − H(z_0) for n = 0 … count; shorter, or not finite at the end, when it blows up."""
    bits = 128 + isqrt(count)
    while (errors := _at_precision(R, omega, count, bits)) is None:
        bits *= 2
    return errors


def _at_precision(R: Matrix, omega: fmpq, count: int, bits: int) -> Floats | None:
    """The same with balls of ``bits`` bits; None where these are too few."""
    import numpy as np

    with ctx.workprec(bits):
        step = _scaled(R, omega, bits)
        forms, block = _forms(step, isqrt(count) + 1)
        starts, energies = _starts(block, arb(omega), -(-(count + 1) // len(forms)))
        if not (_are_sharp([x for form in forms for x in form]) and _are_sharp(energies)):
            return None
        Q = np.array([[float(x) for x in form] for form in forms])
        z = np.array([[float(x * x), float(x * y), float(y * y)] for x, y in starts])
        first = np.array([float(x) for x in energies])
    errors: Floats = (first[:, None] + z @ Q.T).ravel()[: count + 1]
    return errors


def _forms(step: arb_mat, length: int) -> tuple[list[tuple[arb, arb, arb]], arb_mat]:
    """Q_j as coefficients of z₁², z₁z₂, z₂² for j < length, and R^length; fewer when they grow out
    of floats.
    """
    power = step**0
    forms: list[tuple[arb, arb, arb]] = []
    while len(forms) < length:
        (a, b), (c, d) = power.tolist()
        if forms and max(abs(x).mid() for x in (a, b, c, d)) > 1e50:
            break
        forms.append(((a * a + c * c - 1) / 2, a * b + c * d, (b * b + d * d - 1) / 2))
        power = step * power
    return forms, power


def _starts(block: arb_mat, omega: arb, count: int) -> tuple[list[tuple[arb, arb]], list[arb]]:
    """The block starts z_{iK} and their energy errors; fewer when the energy blows up."""
    z = arb_mat([[omega], [omega / 2]])
    energy = 5 * omega**2 / 8
    starts, errors = [], []
    for _ in range(count):
        x, y = z[0, 0], z[1, 0]
        starts.append((x, y))
        errors.append((x * x + y * y) / 2 - energy)
        if errors[-1].mid() > BLOW_UP * energy:
            break
        z = block * z
    return starts, errors


def _are_sharp(balls: list[arb]) -> bool:
    """Whether all radii are far below the largest of the numbers."""
    largest = max(abs(x).mid() for x in balls)
    allowed = max(largest * arb(2) ** -_GOAL, arb(2) ** -_FLOOR)
    return all(x.rad() <= allowed for x in balls)


def _angle(R: Matrix, omega: fmpq) -> float | None:
    """2θ in [0, 2π), twice the argument of the eigenvalues of R; None when they are real."""
    import numpy as np

    (a, b), (c, d) = ([float(x) for x in row] for row in _scaled(R, omega, 128).tolist())
    discriminant = ((a - d) / 2) ** 2 + b * c
    if discriminant >= 0:
        return None
    return float(2 * np.arctan2(np.sqrt(-discriminant), (a + d) / 2) % (2 * np.pi))


def _drift(errors: Floats, angle: float | None) -> tuple[float, float]:
    """D of the fit in ``Drift`` and its uncertainty, per step."""
    import numpy as np

    slope, half = _slope(errors, angle), len(errors) // 2
    rounding = _ROUNDING * float(np.abs(errors).max()) / len(errors)
    halves = (_slope(part, angle) for part in (errors[: half + 1], errors[half:]))
    return slope, max(abs(x - slope) for x in halves) + rounding


def _slope(errors: Floats, angle: float | None) -> float:
    """D of the fit in ``Drift``, per step; by normal equations, whose columns are nearly
    orthogonal.
    """
    import numpy as np

    largest = float(np.abs(errors).max())
    last = len(errors) - 1
    if last < 1 or largest == 0:
        return 0.0
    # two turns within the run: the least for which a wave is no line
    if angle is not None and min(angle, 2 * np.pi - angle) * last < 4 * np.pi:
        angle = None
    size = 2 if angle is None else 4
    gram, moments = np.zeros((size, size)), np.zeros(size)
    for start in range(0, len(errors), _CHUNK):
        part = errors[start : start + _CHUNK] / largest
        n = np.arange(start, start + len(part), dtype=np.float64)
        columns = [np.ones_like(n), n / last - 0.5]
        if angle is not None:
            columns += [np.cos(angle * n), np.sin(angle * n)]
        A = np.stack(columns, axis=1)
        gram += A.T @ A
        moments += A.T @ part
    return float(np.linalg.solve(gram, moments)[1]) * largest / last


def extremes(errors: Floats, points: int) -> NDArray[np.int64]:
    """Indices of the least and the greatest value of equal spans, so that a wave keeps its height
    in a plot.
    """
    import numpy as np

    if len(errors) <= points:
        return np.arange(len(errors))
    spans = np.array_split(np.arange(len(errors)), points // 2)
    chosen = {int(span[pick(errors[span])]) for span in spans for pick in (np.argmin, np.argmax)}
    return np.array(sorted(chosen))
