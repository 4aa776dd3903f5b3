"""The energy error of the oscillator over a long time, far above its own rounding errors.

In the variables z = (ωq, p) the energy is H = ½|z|². With n = iK + j the error is summed as

    H(z_n) − H(z_0) = [H(z_{iK}) − H(z_0)] + z_{iK}ᵀ Q_j z_{iK},      Q_j = ½ ((R^j)ᵀ R^j − I).

Both parts are of the size of the error itself. The K forms Q_j and the block starts z_{iK} are
computed in balls, the outer sum of N = K² terms in floats: it loses a few units of its last digit.
"""

from __future__ import annotations

from math import isqrt
from typing import TYPE_CHECKING

from flint import arb, arb_mat, ctx, fmpq

from garkcli import numpy_on_use as np
from garkcli.doing import doing
from garkcli.exact.display import to_float
from garkcli.exact.matrix import Matrix
from garkcli.frozen import Frozen
from garkcli.longtime import history as histories
from garkcli.longtime.record import extremes
from garkcli.longtime.rounding import energy_rate, power_of_ten
from garkcli.longtime.trend import Shape
from garkcli.problems.oscillator import Oscillator
from garkcli.stepping.linear import conserves_energy, enclosure, linear_step
from garkcli.tableau.tableau import Tableau

if TYPE_CHECKING:
    from garkcli.arrays import Floats, Integers


ROUNDING = 2.0**-42
"""The rounding of a slope, relative to the largest error, as floats are summed."""
_CHUNK = 65536  # steps that a fit looks at at a time


class FittedLine(Frozen):
    """A fitted drift of energy errors, per step, with its uncertainty."""

    slope: float
    uncertainty: float


def drift_of(errors: Floats, angle: float | None) -> FittedLine:
    """Returns the slope of errors, and its distance from those of the halves; ``angle`` is 2θ."""
    slope = _slope(errors, angle)
    half = len(errors) // 2
    rounding = ROUNDING * float(np.abs(errors).max()) / len(errors)
    first = _slope(errors[: half + 1], angle)
    second = _slope(errors[half:], angle)
    apart = max(abs(first - slope), abs(second - slope))
    return FittedLine(slope, apart + rounding)


def _slope(errors: Floats, angle: float | None) -> float:
    """The slope per step, by normal equations, whose columns are nearly orthogonal."""
    largest = float(np.abs(errors).max())
    last = len(errors) - 1
    if last < 1 or largest == 0:
        return 0.0
    # two turns within the run: the least for which a wave is no line
    if angle is not None and min(angle, 2 * np.pi - angle) * last < 4 * np.pi:
        angle = None
    size = 2 if angle is None else 4
    gram = np.zeros((size, size))
    moments = np.zeros(size)
    for start in range(0, len(errors), _CHUNK):
        part = errors[start : start + _CHUNK] / largest
        n = np.arange(start, start + len(part), dtype=np.float64)
        columns = [np.ones_like(n), n / last - 0.5]
        if angle is not None:
            phase = angle * n
            columns.append(np.cos(phase))
            columns.append(np.sin(phase))
        A = np.stack(columns, axis=1)
        gram += A.T @ A
        moments += A.T @ part
    return float(np.linalg.solve(gram, moments)[1]) * largest / last


_GOAL = 60  # bits of the largest energy error that balls have to get right
_FLOOR = 1000  # energy errors below 2^-1000 count as zero: floats end there


class _Errors(Frozen):
    """H(z_n) − H(z_0) until a blow-up; ``is_exact`` if the step map conserves energy."""

    values: Floats
    is_exact: bool
    blew_up: bool


@doing("energy of the oscillator")
def oscillator_run(
    tableau: Tableau,
    problem: Oscillator,
    t_end: fmpq,
    step: fmpq,
    points: int = histories.SERIES,
    tolerance: fmpq | None = None,
) -> histories.LongRun:
    """The energy of ``problem`` from q = 1, p = ω/2 to ``t_end``, judged by the exact step map.

    The drift is d in the least-squares fit H(t) − H(0) ≈ e + d t + a cos 2θn + b sin 2θn, with
    e^{±iθ} the directions of the eigenvalues of R(h); without a, b if these are real or turn too
    slowly to be distinguished from a line. Its uncertainty is its distance from the drifts in the
    halves of the run. Both are zero if the error is bounded for all time. Raises UsageProblem as
    ``long_run``.
    """
    count = histories.count_steps(t_end, step)
    R = linear_step(tableau, problem).at(step)
    fate = histories.stability(R)
    energy = to_float(5 * problem.omega**2 / 8)
    errors = _errors(R, problem.omega, energy, count)
    done = len(errors.values) - 1
    h = to_float(step)

    line = drift_of(errors.values, _angle(R, problem.omega))
    if errors.is_exact or fate.fate == "elliptic":
        line = FittedLine(0.0, 0.0)
    rate = energy_rate(tableau, tolerance, h, _powers(problem.omega, energy, done * h))
    excused = rate * done * h
    kept = np.union1d(extremes(errors.values, points - 2), [0, done])
    history = _history(errors, energy, fate, line, excused, kept, h)
    times = tuple((kept * h).tolist())
    return histories.LongRun(problem, step, t_end, done, None, (history,), times, stability=fate)


def _history(
    errors: _Errors,
    energy: float,
    fate: histories.StepMapStability,
    line: FittedLine,
    excused: float,
    kept: Integers,
    h: float,
) -> histories.InvariantHistory:
    """The history of the energy, of which the errors with indices ``kept`` are kept."""
    verdict = _verdict(errors, energy, fate, line, excused)
    drift, uncertainty = None, None
    if not errors.blew_up:
        drift = line.slope / h
        uncertainty = line.uncertainty / h

    largest = float(np.abs(errors.values).max())
    kept_errors = errors.values[kept]
    left = kept_errors - line.slope * kept
    height = float(left.max() - left.min())
    return histories.InvariantHistory(
        name="energy",
        initial=energy,
        max_error=largest,
        drift=drift,
        uncertainty=uncertainty,
        amplitude=height / 2,
        round_off=power_of_ten(ROUNDING * largest),
        coefficients=excused,
        verdict=verdict,
        shape=_shape(verdict, line),
        errors=tuple(kept_errors.tolist()),
        doubt="rounding" if verdict == "undecided" else None,
    )


def _errors(R: Matrix, omega: fmpq, energy: float, count: int) -> _Errors:
    is_exact = conserves_energy(R, omega)
    if is_exact:
        values: Floats = np.zeros(count + 1)
    else:
        values = _energy_errors(R, omega, count)
    is_inside = np.abs(values) <= histories.BLOW_UP * energy  # and no nan
    outside = np.flatnonzero(~is_inside)
    if outside.size:
        values = values[: int(outside[0])]
    return _Errors(values, is_exact, blew_up=len(values) <= count)


def _verdict(
    errors: _Errors,
    energy: float,
    fate: histories.StepMapStability,
    line: FittedLine,
    excused: float,
) -> histories.Verdict:
    """The verdict from the step map and the errors. A drift that is at most ``excused``, the error
    from rounded coefficients, is undecided. A step multiplies areas, and the mean energy to first
    order, by det R: no line fits an energy that decays to nothing, but det R − 1 shows it.
    """
    if errors.is_exact:
        return "exact"
    if errors.blew_up:
        return "unstable"
    if fate.fate == "elliptic":
        return "bounded"
    area = abs(to_float(fate.determinant - 1)) * energy
    certain = max(abs(line.slope) - line.uncertainty, area)
    if not excused or certain * (len(errors.values) - 1) > excused:
        return "drifts"
    return "undecided" if abs(line.slope) > line.uncertainty else "bounded"


def _shape(verdict: histories.Verdict, line: FittedLine) -> Shape:
    if verdict not in ("drifts", "undecided"):
        return "none"
    return "line" if abs(line.slope) > line.uncertainty else "curve"


def _powers(omega: fmpq, energy: float, time: float) -> tuple[float, float]:
    """Along the exact solution |q̇p̈| + |ṗq̈| = 2ω²H, and the mean of q̇ṗ = −d/dt ½ω²q² is ≤ H/t."""
    first = energy / max(time, 1e-300)
    second = 2 * to_float(omega) ** 2 * energy
    return first, second


def _scaled(R: Matrix, omega: fmpq, bits: int) -> arb_mat:
    (a, b), (c, d) = R
    first = (a, b * omega)
    second = (c * (1 / omega), d)
    return enclosure((first, second), bits)


def _energy_errors(R: Matrix, omega: fmpq, count: int) -> Floats:
    """H(z_n) − H(z_0) for n = 0 … count; shorter, or not finite at the end, after a blow-up."""
    # some 2 √N products of matrices in a row, which may lose about half a bit each
    bits = 128 + isqrt(count)
    while (errors := _at_precision(R, omega, count, bits)) is None:
        bits *= 2
    return errors


def _at_precision(R: Matrix, omega: fmpq, count: int, bits: int) -> Floats | None:
    """The energy errors with balls of ``bits`` bits; None if these are too few."""
    with ctx.workprec(bits):
        forms, block = _forms(_scaled(R, omega, bits), isqrt(count) + 1)
        blocks = -(-(count + 1) // len(forms))  # rounded up
        starts, energies = _starts(block, arb(omega), blocks)
        entries = [x for form in forms for x in form]
        if not (_are_sharp(entries) and _are_sharp(energies)):
            return None
        products = []
        for x, y in starts:
            products += [x * x, x * y, y * y]
        Q = _in_floats(entries).reshape(-1, 3)
        z = _in_floats(products).reshape(-1, 3)
        first = _in_floats(energies)
    by_blocks = first[:, None] + z @ Q.T
    errors: Floats = by_blocks.ravel()[: count + 1]
    return errors


def _in_floats(balls: list[arb]) -> Floats:
    return np.array([float(x) for x in balls])


def _forms(step: arb_mat, length: int) -> tuple[list[tuple[arb, arb, arb]], arb_mat]:
    """Q_j as coefficients of z₁², z₁z₂, z₂² for j < length, and R^length."""
    power = step**0
    forms: list[tuple[arb, arb, arb]] = []
    while len(forms) < length:
        (a, b), (c, d) = power.tolist()
        sizes = [abs(x).mid() for x in (a, b, c, d)]
        if forms and max(sizes) > 1e50:
            break
        of_first = (a * a + c * c - 1) / 2
        of_product = a * b + c * d
        forms.append((of_first, of_product, (b * b + d * d - 1) / 2))
        power = step * power
    return forms, power


def _starts(block: arb_mat, omega: arb, count: int) -> tuple[list[tuple[arb, arb]], list[arb]]:
    """The block starts z_{iK} and their energy errors; fewer after a blow-up."""
    z = arb_mat([[omega], [omega / 2]])
    energy = 5 * omega**2 / 8
    starts, errors = [], []
    for _ in range(count):
        x, y = z.entries()
        error = (x * x + y * y) / 2 - energy
        starts.append((x, y))
        errors.append(error)
        if error.mid() > histories.BLOW_UP * energy:
            break
        z = block * z
    return starts, errors


def _are_sharp(balls: list[arb]) -> bool:
    largest = max(abs(x).mid() for x in balls)
    allowed = max(largest * arb(2) ** -_GOAL, arb(2) ** -_FLOOR)
    return all(x.rad() <= allowed for x in balls)


def _angle(R: Matrix, omega: fmpq) -> float | None:
    """2θ in [0, 2π), twice the argument of the eigenvalues of R; None if they are real."""
    a, b, c, d = map(float, _scaled(R, omega, 128).entries())
    # the eigenvalues are those of λ² − (a + d) λ + (ad − bc)
    real = (a + d) / 2
    apart = (a - d) / 2
    discriminant = apart**2 + b * c
    if discriminant >= 0:
        return None
    imaginary = np.sqrt(-discriminant)
    theta = np.arctan2(imaginary, real)
    return float(2 * theta % (2 * np.pi))
