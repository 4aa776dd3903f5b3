"""``gark energy``: conserved quantities over a long time, for people."""

from __future__ import annotations

from dataclasses import dataclass

from garkcli.exact.display import to_decimal
from garkcli.longtime.courses import Course, LongRun
from garkcli.longtime.stability import Stability
from garkcli.longtime.symplecticity import Symplecticity
from garkcli.longtime.trend import LEAST
from garkcli.problems.hamiltonian import FLOAT_DIGITS
from garkcli.report.bandplot import terminal_band
from garkcli.report.convergence import describe
from garkcli.report.paint import Paint

FATES = {
    "turns": "the energy error is bounded for all time",
    "grows": "the energy grows for ever",
    "decays": "the energy decays for ever",
    "rests": "energy is lost, but not all of it",
}
"""What becomes of the energy of the oscillator."""


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
    lines = [
        paint("strong", report.name),
        *(f"  {line}" for line in _wrapped(describe(run.problem))),
    ]
    lines += [f"  step {run.step} to t = {run.t_end}: {_steps(run)}", ""]
    for course in run.courses:
        lines += [*_course(course, run, paint), ""]
    lines += _symplectic(report, paint)
    if report.claims:
        lines.append("")
    for x in report.claims:
        verdict = paint("good", "claim holds") if x.holds else paint("bad", "CLAIM FAILS")
        lines.append(f"  {verdict}      {x.claim}" + ("" if x.holds else f", found: {x.found}"))
    energy = run.courses[0]
    if is_long and energy.max_error > 0:
        lines += [
            "",
            *(
                f"  {x}"
                for x in terminal_band(run.times, energy.errors, "H(t) − H(0)").splitlines()
            ),
        ]
    return lines


def _steps(run: LongRun) -> str:
    how = (
        "exact"
        if run.digits is None
        else "in floats"
        if run.digits <= FLOAT_DIGITS
        else f"{run.digits} digits"
    )
    return f"{run.steps} steps, {how}"


def _course(course: Course, run: LongRun, paint: Paint) -> list[str]:
    width = max(15, *(len(x.name) for x in run.courses)) + 2
    rows = [(course.name, f"{course.initial:.6g} at the start")]
    if course.verdict != "exact":
        rows.append(("  largest error", f"{course.max_error:.4e}"))
    if course.verdict not in ("exact", "round-off", "unstable"):
        rows.append(("  oscillation", f"± {course.amplitude:.2e}"))
        if course.drift is not None:
            rows.append(("  drift", _drift(course, run.end)))
    style = {
        "bounded": "good",
        "exact": "good",
        "round-off": "good",
        "drifts": "bad",
        "unstable": "bad",
    }
    word, reason = _verdict(course, run)
    lines = [f"  {left:<{width}}{right}" for left, right in rows]
    first, *rest = _wrapped(f"{word}{reason}", 76 - width)
    first = first.replace(word, paint(style.get(course.verdict, "strong"), word), 1)
    return [
        *lines,
        f"  {'  verdict':<{width}}{first}",
        *(f"  {'':<{width}}{line}" for line in rest),
    ]


def _drift(course: Course, time: float) -> str:
    """Per unit of time and in all; digits below the uncertainty say nothing."""
    drift, uncertainty = course.drift or 0.0, course.uncertainty or 0.0
    if abs(drift) <= uncertainty and course.verdict != "drifts":
        return f"none within {uncertainty:.0e} per unit of time, {uncertainty * time:.0e} in all"
    return f"{drift:.2e} ± {uncertainty:.0e} per unit of time, {drift * time:.2e} in all"


def _verdict(course: Course, run: LongRun) -> tuple[str, str]:
    """A word, and what it rests on."""
    match course.verdict:
        case "exact":
            return "conserved", " by every step, exactly"
        case "round-off" if not course.round_off:
            return "no error", " at all"
        case "round-off":
            more = (
                f"; --digits {2 * run.digits} shows more"
                if run.digits and run.digits <= 100
                else ""
            )
            return "no error", f" above round-off, at most {course.round_off:.0e} here{more}"
        case "unstable":
            end = run.end
            return "UNSTABLE", f": blown up after {run.steps} steps, at t = {end:g}"
        case "undecided":
            if run.steps < LEAST:
                return "undecided", f": fewer than {LEAST} steps"
            times = f"{run.turns} time{'s' * (run.turns != 1)}"
            return "undecided", f": the motion turns back {times} only; a longer --t-end can tell"
        case "bounded" if run.stability is None:
            return "bounded", ": no drift beyond its uncertainty"
        case "bounded" if run.stability.fate != "turns":  # type: ignore[union-attr]
            return "bounded", ": no drift beyond what the rounding of the coefficients can cause"
        case "bounded":
            return "bounded", " for all time: det R(h) = 1 and |tr R(h)| < 2, decided exactly"
    return "DRIFTS", f": {_reason(course, run)}"


def _reason(course: Course, run: LongRun) -> str:
    if run.stability is not None:
        return f"det R(h) − 1 = {_determinant(run.stability)}, {FATES[run.stability.fate]}"
    if course.shape == "line":
        return f"the slope is {abs(course.drift or 0) / (course.uncertainty or 1):.2g} times its uncertainty"
    if course.shape == "curve":
        return f"it {'rises' if course.drift and course.drift > 0 else 'falls'} all along, not at one rate"
    return "it moves to another level and stays there"


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
        word = "not proved by its coefficients" + "; --symplecticity measures" * is_hinted
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
        size = f"MᵀJM − J has entries up to {largest.size:.3e}, good to {largest.error:.0e},"
    else:
        size = (
            f"MᵀJM − J is below {max(x.error for x in found.defects):.0e}, what it is measured to,"
        )
    return [size, *_wrapped("at t = " + ", ".join(str(x.time) for x in found.defects), 59)]


def _wrapped(text: str, width: int = 76) -> list[str]:
    from textwrap import wrap

    return wrap(text, width)
