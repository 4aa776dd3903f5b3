"""``gark energy``: conserved quantities over a long time, for people."""

from __future__ import annotations

from dataclasses import dataclass
from math import isfinite

from garkcli.exact.display import to_decimal, to_float
from garkcli.longtime.history import InvariantHistory, LongRun
from garkcli.longtime.rounding import power_of_ten
from garkcli.longtime.stability import Stability
from garkcli.longtime.symplecticity import Symplecticity
from garkcli.longtime.trend import LEAST
from garkcli.page.asciiplot import terminal_band
from garkcli.page.figures import measured
from garkcli.page.paint import Paint, counted, indented
from garkcli.problems.hamiltonian import FLOAT_DIGITS
from garkcli.report.problem import describe, driving
from garkcli.tableau.garkmethod import GarkMethod, word_for

FATES = {
    "elliptic": "the energy error is bounded for all time",
    "unstable": "the energy grows for ever",
    "contractive": "the energy decays for ever",
    "marginal": "energy is lost, but not all of it",
}
"""What becomes of the energy of the oscillator."""
STYLES = {
    "bounded": "good",
    "exact": "good",
    "round-off": "good",
    "drifts": "bad",
    "unstable": "bad",
}
"""How verdicts are painted; the others are neither good nor bad."""
_NEARLY = 2.0
"""How many times round-off an uncertainty is that is nothing but round-off."""
_HANGING = " " * 19
"""The margin of what goes on below a verdict or below a word on symplecticity."""


@dataclass(frozen=True)
class Claim:
    """What is claimed of a run, what was found, and whether the claim holds."""

    claim: str
    found: str
    holds: bool


@dataclass(frozen=True)
class Report:
    """A long run and what is said about it.

    Attributes:
        name: of the method.
        run: what became of the conserved quantities.
        symplecticity: of the steps.
        claims: that the command was given.
    """

    name: str
    run: LongRun
    symplecticity: Symplecticity | None
    claims: tuple[Claim, ...] = ()


def text_of(report: Report, paint: Paint, is_long: bool = True) -> list[str]:
    """The lines of the report; a long one ends with a plot of the energy error."""
    run = report.run
    lines = [paint("strong", report.name)]
    lines += indented(_wrapped(describe(run.problem)))
    steps = f"step {run.step} to t = {run.t_end}: {_steps(run)}"
    lines += indented(filter(None, [driving(run)]))
    lines += indented(_wrapped(steps))
    lines.append("")
    for history in run.invariants:
        lines += _history(history, run, paint)
        lines.append("")
    if report.symplecticity is None:
        lines.pop()
    else:
        lines += _symplectic(report.symplecticity, run.stability, run.method, paint)
    if report.claims:
        lines.append("")
    for claim in report.claims:
        lines += _claim(claim, paint)
    first = run.invariants[0]
    # noise is different on every machine, and nothing to look at
    if is_long and first.max_error > first.round_off:
        label = "H(t) − H(0)" if run.energy else f"error of {first.name}"
        # an invariant may have lost its value on the way
        points = [(t, x) for t, x in zip(run.times, first.errors, strict=True) if isfinite(x)]
        times, errors = zip(*points, strict=True)
        plot = terminal_band(times, errors, label)
        lines.append("")
        lines += indented(plot.splitlines())
    return lines


def _claim(claim: Claim, paint: Paint) -> list[str]:
    verdict = paint.verdict(claim.holds, "claim holds", "CLAIM FAILS")
    text = claim.claim
    if not claim.holds:
        text += f", found: {claim.found}"
    first, *rest = _wrapped(text, 59)
    lines = [f"  {verdict}      {first}"]
    lines += indented(rest, _HANGING)
    return lines


def _steps(run: LongRun) -> str:
    if run.digits is None:
        return f"{run.steps} steps, exact"
    how = "in floats"
    if run.digits > FLOAT_DIGITS:
        how = f"{run.digits} digits"
    return f"{run.steps} steps, {how}"


def _history(history: InvariantHistory, run: LongRun, paint: Paint) -> list[str]:
    """What became of one conserved quantity, in lines beside their labels."""
    names = [x.name for x in run.invariants]
    width = max(15, *map(len, names)) + 2
    word, reason = _verdict(history, run)
    paragraphs = [f"{word}{reason}", *_cure(history, run)]
    rows = _numbers(history, run)
    rows.append(("  verdict", "; ".join(paragraphs)))
    lines = []
    for label, text in rows:
        first, *rest = _wrapped(text, 76 - width)
        lines.append(f"  {label:<{width}}{first}")
        lines += indented(rest, " " * (width + 2))
    # lines are broken before they are painted: codes have no width
    style = STYLES.get(history.verdict, "strong")
    plain = f" {word}"
    painted = f" {paint(style, word)}"
    return [line.replace(plain, painted, 1) for line in lines]


def _numbers(history: InvariantHistory, run: LongRun) -> list[tuple[str, str]]:
    """The value at the start, and what of the errors says something, each with its label."""
    verdict, round_off = history.verdict, history.round_off
    rows = [(history.name, f"{history.initial:.6g} at the start")]
    if verdict == "exact" or history.doubt in ("rest", "value"):
        return rows
    rows.append(("  largest error", measured(history.max_error, round_off)))
    if verdict in ("round-off", "unstable") or history.doubt == "round-off":
        return rows
    oscillation = measured(history.amplitude, round_off, 3)
    rows.append(("  oscillation", f"± {oscillation}"))
    if history.drift is not None:
        rows.append(("  drift", _drift(history, run)))
    return rows


def _drift(history: InvariantHistory, run: LongRun) -> str:
    """Per unit of time and in all; digits below the uncertainty say nothing."""
    drift = history.drift or 0.0
    uncertainty = history.uncertainty or 0.0
    in_all = drift * run.end
    uncertain_in_all = uncertainty * run.end
    is_seen = abs(drift) > uncertainty
    if run.stability is not None:
        if run.stability.fate == "elliptic":
            return "none, for all time"
        if not is_seen:
            return "not at one rate in this run"
        rate = measured(drift, uncertainty, 3)
        total = measured(in_all, uncertain_in_all, 3)
        return f"{rate} per unit of time, {total} in all"
    if not is_seen and (history.verdict == "drifts" or history.doubt in ("symplectic", "rounding")):
        return "not at one rate in this run"
    if is_seen:
        rate = f"{drift:.2e} ± {uncertainty:.0e}"
        return f"{rate} per unit of time, {in_all:.2e} in all"
    if uncertain_in_all <= _NEARLY * history.round_off:
        return f"none above round-off, at most {history.round_off:.0e} in all"
    rate = f"{uncertainty:.0e} per unit of time"
    return f"none within {rate}, {uncertain_in_all:.0e} in all"


def _verdict(history: InvariantHistory, run: LongRun) -> tuple[str, str]:
    """A word, and what it rests on."""
    match history.verdict:
        case "exact":
            return "conserved", " by every step, exactly"
        case "round-off":
            return "no error", _round_off(history, run)
        case "unstable":
            return "UNSTABLE", _unstable(history, run)
        case "undecided":
            return "undecided", f": {_undecided(history, run)}"
        case "bounded":
            return "bounded", _bounded(run)
    return "DRIFTS", f": {_reason(history, run)}"


def _round_off(history: InvariantHistory, run: LongRun) -> str:
    text = f" above round-off, at most {history.round_off:.0e} here"
    if run.digits and run.digits <= 100:
        text += f"; --digits {2 * run.digits} shows more"
    return text


def _unstable(history: InvariantHistory, run: LongRun) -> str:
    if run.escaped is None:
        return f": blown up after {run.steps} steps, at t = {run.end:g}"
    time = to_float(run.escaped)
    error = measured(history.errors[-1], history.round_off, 2)
    return f": the orbit escapes after t = {time:g}, where the error is {error}"


def _undecided(history: InvariantHistory, run: LongRun) -> str:
    """Why."""
    match history.doubt:
        case "steps":
            return f"fewer than {LEAST} steps"
        case "turns":
            return f"the motion turns back {counted(run.turns, 'time')} only"
        case "rest":
            return "the solution does not move"
        case "value":
            return f"it has no value at t = {history.no_value_at}"
        case "round-off":
            return "rounding may be as large as it is"
        case "modulation":
            slope = f"the slope is {_times(history)} times its uncertainty"
            return f"{slope}; a slow modulation may do that"
        case "symplectic":
            direction = _direction(history)
            return (
                f"it {direction} throughout; for a symplectic method that is usually a slow "
                "oscillation"
            )
        case "rounding":
            return "drifts; rounding of the coefficients may be the cause"
    return "it moves to another level; that may happen once, or again and again"


def _cure(history: InvariantHistory, run: LongRun) -> list[str]:
    """What decides an undecided run."""
    match history.doubt:
        case None:
            return []
        case "rest":
            return ["start elsewhere"]
        case "value":
            return ["choose an invariant that has one all along, or an earlier --t-end"]
        case "round-off":
            return [f"--digits {2 * (run.digits or FLOAT_DIGITS)} can tell"]
        case "rounding":
            return ["coefficients with more digits can tell"]
    if history.longer is None:
        return ["a larger step, for a longer time, can tell"]
    if history.doubt == "symplectic":
        return [f"try --t-end {history.longer}"]
    return [f"--t-end {history.longer} can tell"]


def _bounded(run: LongRun) -> str:
    if run.stability is not None and run.stability.fate == "elliptic":
        return " for all time: det R(h) = 1 and |tr R(h)| < 2, decided exactly"
    return ": no drift beyond its uncertainty"


def _reason(history: InvariantHistory, run: LongRun) -> str:
    if run.stability is not None:
        fate = FATES[run.stability.fate]
        difference = _determinant(run.stability)
        return f"det R(h) − 1 = {difference}, {fate}"
    if history.shape == "line":
        times = _times(history)
        return f"the slope is {times} times its uncertainty"
    if history.shape == "curve":
        # the fitted slope of what is no line may be nothing but rounding
        return f"it {_direction(history)} all along, by more than it oscillates"
    return "it moves to another level and stays there"


def _direction(history: InvariantHistory) -> str:
    """Where a trend goes: by its slope, or by its end where no line fits it."""
    drift = history.drift or 0.0
    went = drift if history.shape == "line" else history.errors[-1]
    return "rises" if went > 0 else "falls"


def _times(history: InvariantHistory) -> str:
    """How many times its uncertainty the drift is, to one digit."""
    drift = history.drift or 0.0
    uncertainty = history.uncertainty or 1.0
    times = abs(drift) / uncertainty
    digit = float(f"{times:.1g}")
    return f"{digit:g}"


def _determinant(stability: Stability) -> str:
    if stability.is_symplectic:
        return "0"
    difference = stability.determinant - 1
    return to_decimal(difference, 4)


def _symplectic(
    found: Symplecticity, stability: Stability | None, method: GarkMethod | None, paint: Paint
) -> list[str]:
    whose = word_for(method)
    coefficients = "its coefficients" if whose == "method" else f"the coefficients of the {whose}"
    is_refuted = any(x.is_seen for x in found.defects)
    if stability is not None and not stability.is_symplectic:
        is_refuted = True
    if found.is_proved:
        yes = paint("good", "yes")
        word = f"{yes}, by {coefficients}"
    elif is_refuted:
        word = paint("strong", "no")
    else:
        word = f"not proved by {coefficients}"
        if stability is None and not found.defects:
            word += "; --symplecticity measures"
    texts = []
    if stability is not None:
        ending = ", exactly" if stability.is_symplectic else ""
        difference = _determinant(stability)
        texts.append(f"det R(h) − 1 = {difference}{ending}")
    texts += _measured(found)
    lines = [f"  symplectic       {word}"]
    lines += indented(texts, _HANGING)
    return lines


def _measured(found: Symplecticity) -> list[str]:
    if not found.defects:
        return []
    largest = max(found.defects, key=lambda x: x.size)
    if any(x.is_seen for x in found.defects):
        good_to = power_of_ten(largest.error)
        size = f"MᵀJM − J has entries up to {largest.size:.3e}, good to {good_to:.0e},"
    else:
        largest_error = max(x.error for x in found.defects)
        bound = power_of_ten(largest_error)
        size = f"MᵀJM − J is below {bound:.0e}, what it is measured to,"
    times = ", ".join(str(x.time) for x in found.defects)
    where = _wrapped(f"at t = {times}", 59)
    return [size, *where]


def _wrapped(text: str, width: int = 76) -> list[str]:
    from textwrap import wrap

    return wrap(text, width)
