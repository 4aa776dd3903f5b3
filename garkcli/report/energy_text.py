"""``gark energy``: conserved quantities over a long time, for people."""

from __future__ import annotations

from dataclasses import dataclass

from garkcli.exact.display import to_decimal, to_float
from garkcli.longtime.history import InvariantHistory, LongRun
from garkcli.longtime.rounding import power_of_ten
from garkcli.longtime.stability import Stability
from garkcli.longtime.symplecticity import Symplecticity
from garkcli.longtime.trend import LEAST
from garkcli.problems.hamiltonian import FLOAT_DIGITS
from garkcli.report.bandplot import terminal_band
from garkcli.report.convergence import describe
from garkcli.report.figures import measured
from garkcli.report.paint import Paint

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
_NEARLY = (
    2.0  # how many times round-off an uncertainty is that is nothing but round-off
)


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
    symplecticity: Symplecticity
    claims: tuple[Claim, ...] = ()


def text_of(report: Report, paint: Paint, is_long: bool = True) -> list[str]:
    """The lines of the report; a long one ends with a plot of the energy error."""
    run = report.run
    lines = [paint("strong", report.name)]
    lines += [f"  {line}" for line in _wrapped(describe(run.problem))]
    lines += [
        f"  {line}"
        for line in _wrapped(f"step {run.step} to t = {run.t_end}: {_steps(run)}")
    ]
    lines.append("")
    for history in run.invariants:
        lines += [*_history(history, run, paint), ""]
    lines += _symplectic(report, paint)
    if report.claims:
        lines.append("")
    for claim in report.claims:
        lines += _claim(claim, paint)
    if is_long and run.energy.max_error > 0:
        plot = terminal_band(run.times, run.energy.errors, "H(t) − H(0)")
        lines += ["", *(f"  {line}" for line in plot.splitlines())]
    return lines


def _claim(claim: Claim, paint: Paint) -> list[str]:
    verdict = (
        paint("good", "claim holds") if claim.holds else paint("bad", "CLAIM FAILS")
    )
    text = claim.claim if claim.holds else f"{claim.claim}, found: {claim.found}"
    first, *rest = _wrapped(text, 59)
    return [f"  {verdict}      {first}", *(f"  {'':<17}{line}" for line in rest)]


def _steps(run: LongRun) -> str:
    if run.digits is None:
        return f"{run.steps} steps, exact"
    how = "in floats" if run.digits <= FLOAT_DIGITS else f"{run.digits} digits"
    return f"{run.steps} steps, {how}"


def _history(history: InvariantHistory, run: LongRun, paint: Paint) -> list[str]:
    width = max(15, *(len(x.name) for x in run.invariants)) + 2
    rows = [(history.name, f"{history.initial:.6g} at the start")]
    if history.verdict != "exact":
        rows.append(("  largest error", measured(history.max_error, history.round_off)))
    if history.verdict not in ("exact", "round-off", "unstable"):
        oscillation = measured(history.amplitude, history.round_off, 3)
        rows.append(("  oscillation", f"± {oscillation}"))
        if history.drift is not None:
            rows.append(("  drift", _drift(history, run)))
    word, reason = _verdict(history, run)
    paragraphs = [f"{word}{reason}", *_cure(history)]
    rows.append(("  verdict", "; ".join(paragraphs)))
    lines = []
    for left, right in rows:
        first, *rest = _wrapped(right, 76 - width)
        lines.append(f"  {left:<{width}}{first}")
        lines += [f"  {'':<{width}}{line}" for line in rest]
    style = STYLES.get(history.verdict, "strong")
    return [line.replace(f" {word}", f" {paint(style, word)}", 1) for line in lines]


def _drift(history: InvariantHistory, run: LongRun) -> str:
    """Per unit of time and in all; digits below the uncertainty say nothing."""
    drift, uncertainty = history.drift or 0.0, history.uncertainty or 0.0
    time = run.end
    is_seen = abs(drift) > uncertainty
    if run.stability is not None:
        if run.stability.fate == "elliptic":
            return "none, for all time"
        if not is_seen:
            return "not at one rate in this run"
        rate = measured(drift, uncertainty, 3)
        return f"{rate} per unit of time, {measured(drift * time, uncertainty * time, 3)} in all"
    if is_seen or history.verdict == "drifts":
        rate = f"{drift:.2e} ± {uncertainty:.0e}"
        return f"{rate} per unit of time, {drift * time:.2e} in all"
    if uncertainty * time <= _NEARLY * history.round_off:
        return f"none above round-off, at most {history.round_off:.0e} in all"
    return f"none within {uncertainty:.0e} per unit of time, {uncertainty * time:.0e} in all"


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
            return "bounded", _bounded(history, run)
    return "DRIFTS", f": {_reason(history, run)}"


def _round_off(history: InvariantHistory, run: LongRun) -> str:
    if not history.round_off:
        return " at all"
    shows = (
        f"; --digits {2 * run.digits} shows more"
        if run.digits and run.digits <= 100
        else ""
    )
    return f" above round-off, at most {history.round_off:.0e} here{shows}"


def _unstable(history: InvariantHistory, run: LongRun) -> str:
    if run.escaped is None:
        return f": blown up after {run.steps} steps, at t = {run.end:g}"
    error = measured(history.errors[-1], history.round_off, 2)
    return f": the orbit escapes after t = {to_float(run.escaped):g}, where the error is {error}"


def _undecided(history: InvariantHistory, run: LongRun) -> str:
    if run.steps < LEAST:
        return f"fewer than {LEAST} steps"
    if history.shape == "line":
        ratio = _times(history)
        return (
            f"the slope is {ratio} times its uncertainty; a slow modulation may do that"
        )
    if history.shape == "none":
        return f"the motion turns back {run.turns} time{'s' * (run.turns != 1)} only"
    return "it moves to another level; that may happen once, or again and again"


def _cure(history: InvariantHistory) -> list[str]:
    """What decides an undecided run."""
    if history.verdict != "undecided":
        return []
    if history.longer is None:
        return ["a larger step, for a longer time, can tell"]
    return [f"--t-end {history.longer} can tell"]


def _bounded(history: InvariantHistory, run: LongRun) -> str:
    if run.stability is not None and run.stability.fate == "elliptic":
        return " for all time: det R(h) = 1 and |tr R(h)| < 2, decided exactly"
    in_all = (history.uncertainty or 0.0) * run.end
    if history.coefficients > in_all / 2:
        return ": no drift beyond what the rounding of the coefficients can cause"
    return ": no drift beyond its uncertainty"


def _reason(history: InvariantHistory, run: LongRun) -> str:
    if run.stability is not None:
        fate = FATES[run.stability.fate]
        return f"det R(h) − 1 = {_determinant(run.stability)}, {fate}"
    if history.shape == "line":
        return f"the slope is {_times(history)} times its uncertainty"
    if history.shape == "curve":
        rises = bool(history.drift and history.drift > 0)
        return (
            f"it {'rises' if rises else 'falls'} all along, by more than it oscillates"
        )
    return "it moves to another level and stays there"


def _times(history: InvariantHistory) -> str:
    """How many times its uncertainty the drift is, to one digit."""
    ratio = abs(history.drift or 0.0) / (history.uncertainty or 1.0)
    return f"{float(f'{ratio:.1g}'):g}"


def _determinant(stability: Stability) -> str:
    return "0" if stability.is_symplectic else to_decimal(stability.determinant - 1, 4)


def _symplectic(report: Report, paint: Paint) -> list[str]:
    found, stability = report.symplecticity, report.run.stability
    if found.is_proved:
        word = f"{paint('good', 'yes')}, by its coefficients"
    elif any(x.is_seen for x in found.defects) or (
        stability is not None and not stability.is_symplectic
    ):
        word = paint("strong", "no")
    else:
        is_hinted = stability is None and not found.defects
        word = (
            "not proved by its coefficients" + "; --symplecticity measures" * is_hinted
        )
    lines = [f"  symplectic       {word}"]
    if stability is not None:
        lines.append(
            f"  {'':<17}det R(h) − 1 = {_determinant(stability)}"
            + ", exactly" * stability.is_symplectic
        )
    return [*lines, *(f"  {'':<17}{line}" for line in _measured(found))]


def _measured(found: Symplecticity) -> list[str]:
    if not found.defects:
        return []
    largest = max(found.defects, key=lambda x: x.size)
    if any(x.is_seen for x in found.defects):
        good_to = power_of_ten(largest.error)
        size = f"MᵀJM − J has entries up to {largest.size:.3e}, good to {good_to:.0e},"
    else:
        bound = power_of_ten(max(x.error for x in found.defects))
        size = f"MᵀJM − J is below {bound:.0e}, what it is measured to,"
    return [
        size,
        *_wrapped("at t = " + ", ".join(str(x.time) for x in found.defects), 59),
    ]


def _wrapped(text: str, width: int = 76) -> list[str]:
    from textwrap import wrap

    return wrap(text, width)
