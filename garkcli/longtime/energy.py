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
from garkcli.exact.display import to_float
from garkcli.exact.matrix import Matrix
from garkcli.longtime.history import (
    BLOW_UP,
    MAX_STEPS,
    SERIES,
    InvariantHistory,
    LongRun,
    Verdict,
)
from garkcli.longtime.record import extremes
from garkcli.longtime.rounding import energy_rate, power_of_ten
from garkcli.longtime.stability import stability
from garkcli.longtime.trend import Shape
from garkcli.problems.oscillator import Oscillator
from garkcli.stepping.linear import (
    conserves_energy,
    enclosure,
    linear_step,
    whole_steps,
)
from garkcli.tableau.tableau import Tableau

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Floats: TypeAlias = NDArray[np.float64]

_GOAL = 60  # bits of the largest energy error that balls have to get right
_CHUNK = 65536  # steps that a fit looks at at a time
_ROUNDING = 2.0**-42  # of a slope in all, of the largest error: floats are summed
_FLOOR = 1000  # energy errors below 2^-1000 count as zero: floats end there


@dataclass(frozen=True)
class _Line:
    """A drift fitted to energy errors, per step, and how good it is."""

    slope: float
    uncertainty: float


def oscillator_run(
    tableau: Tableau,
    problem: Oscillator,
    t_end: fmpq,
    step: fmpq,
    points: int = SERIES,
    tolerance: fmpq | None = None,
) -> LongRun:
    """The energy of ``problem`` under ``tableau`` to the time ``t_end``, judged by the step map,
    exactly. It starts from q = 1, p = ω/2, with the energy 5ω²/8.

    The drift is d in the least-squares fit H(t) − H(0) ≈ e + d t + a cos 2θn + b sin 2θn, with
    e^{±iθ} the directions of the eigenvalues of R(h); without a, b where these are real or turn too
    slowly to be told from a line. Its uncertainty is how far it is in the halves of the run from
    that in all of it. Where the error is bounded for all time, both are zero.

    Raises:
        UsageProblem: the split does not fit the structure, the step does not divide the time, there
            are more than ``MAX_STEPS`` of them, or the stage equations have no unique solution.
    """
    import numpy as np

    count = whole_steps(t_end, step)
    if count > MAX_STEPS:
        raise UsageProblem(
            f"{count} steps (limit {MAX_STEPS})",
            "choose a shorter time or a larger step",
        )
    R = linear_step(tableau, problem).at(step)
    fate = stability(R)
    energy = to_float(5 * problem.omega**2 / 8)
    is_exact = conserves_energy(R, problem.omega)
    errors = (
        np.zeros(count + 1) if is_exact else _energy_errors(R, problem.omega, count)
    )
    outside = np.flatnonzero(~(np.abs(errors) <= BLOW_UP * energy))
    if outside.size:
        errors = errors[: int(outside[0])]
    blew_up = len(errors) <= count
    done = len(errors) - 1
    h = to_float(step)

    line = _drift(errors, _angle(R, problem.omega))
    if is_exact or fate.fate == "elliptic":
        line = _Line(0.0, 0.0)
    largest = float(np.abs(errors).max())
    powers = _powers(problem.omega, energy, done * h)
    excused = energy_rate(tableau, tolerance, h, powers) * done * h
    verdict: Verdict = "drifts"
    if is_exact:
        verdict = "exact"
    elif blew_up:
        verdict = "unstable"
    elif fate.fate == "elliptic" or abs(line.slope) * done <= excused:
        verdict = "bounded"
    shape: Shape = "none"
    if verdict == "drifts":
        shape = "line" if abs(line.slope) > line.uncertainty else "curve"

    kept = np.union1d(extremes(errors, points - 2), [0, done])
    left = errors[kept] - line.slope * kept
    history = InvariantHistory(
        name="energy",
        initial=energy,
        max_error=largest,
        drift=None if blew_up else line.slope / h,
        uncertainty=None if blew_up else line.uncertainty / h,
        amplitude=float(left.max() - left.min()) / 2,
        round_off=power_of_ten(_ROUNDING * largest),
        coefficients=excused,
        verdict=verdict,
        shape=shape,
        errors=tuple(errors[kept].tolist()),
    )
    return LongRun(
        problem,
        step,
        t_end,
        done,
        None,
        (history,),
        tuple((kept * h).tolist()),
        stability=fate,
    )


def _powers(omega: fmpq, energy: float, time: float) -> tuple[float, float]:
    """What ``garkcli.longtime.rounding.Exchange`` finds along the exact solution: q̇p̈ and ṗq̈ are
    −ω²p² and ω⁴q², whose sizes sum to 2ω²H, and q̇ṗ = −d/dt ½ω²q² has a mean of at most H/t.
    """
    return energy / max(time, 1e-300), 2 * to_float(omega) ** 2 * energy


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
        if not (
            _are_sharp([x for form in forms for x in form]) and _are_sharp(energies)
        ):
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


def _starts(
    block: arb_mat, omega: arb, count: int
) -> tuple[list[tuple[arb, arb]], list[arb]]:
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

    (a, b), (c, d) = (
        [float(x) for x in row] for row in _scaled(R, omega, 128).tolist()
    )
    discriminant = ((a - d) / 2) ** 2 + b * c
    if discriminant >= 0:
        return None
    return float(2 * np.arctan2(np.sqrt(-discriminant), (a + d) / 2) % (2 * np.pi))


def _drift(errors: Floats, angle: float | None) -> _Line:
    """The drift of ``oscillator_run`` and its uncertainty."""
    import numpy as np

    slope = _slope(errors, angle)
    half = len(errors) // 2
    rounding = _ROUNDING * float(np.abs(errors).max()) / len(errors)
    halves = [_slope(part, angle) for part in (errors[: half + 1], errors[half:])]
    apart = max(abs(x - slope) for x in halves)
    return _Line(slope, apart + rounding)


def _slope(errors: Floats, angle: float | None) -> float:
    """The drift of ``oscillator_run``, per step; by normal equations, whose columns are nearly
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
