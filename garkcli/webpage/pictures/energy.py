"""The energy error over a long time, on an orbit of Kepler's problem."""

from __future__ import annotations

from math import isfinite

from garkcli.api.runs import long_run
from garkcli.longtime.history import InvariantHistory, LongRun
from garkcli.longtime.longtime import usual
from garkcli.page.figures import measured
from garkcli.problems.builtin import hamiltonian
from garkcli.problems.oscillator import terms_of
from garkcli.stepping.fields import with_joined_terms
from garkcli.stepping.step import StepFailed
from garkcli.tableau.garkmethod import GarkMethod, word_for
from garkcli.webpage.pictures.drawing import Frame
from garkcli.webpage.pictures.elements import Point
from garkcli.webpage.pictures.large import is_large
from garkcli.webpage.pictures.picture import NotDrawn, Picture
from garkcli.webpage.pictures.scales import common_exponent, in_words, linear_marks, power_of_ten

STEPS = 5000
_POINTS = 600
_PROBLEM = "kepler"
_HEIGHT = 200
_TITLE = "Energy error over a long time"


def draw(method: GarkMethod) -> Picture:
    """The energy error of one method.

    Raises:
        NotDrawn: it is large or not for the problem, a step fails, or nothing is above round-off.
    """
    if is_large(method):
        raise NotDrawn(
            "The method has too many stages to be put to work for a picture; gark energy does it."
        )
    run = _run(method)
    history = run.invariants[0]
    if history.verdict in ("exact", "round-off"):
        raise NotDrawn(
            f"The energy error stays below round-off in {run.steps} steps of {run.step} on "
            "Kepler's problem."
        )
    svg = svg_of(run)
    note = _note(run, history)
    return Picture("energy", _TITLE, _description(run, history), svg, note)


def svg_of(run: LongRun) -> str:
    """The error of the first invariant over time as an SVG element.

    Raises:
        NotDrawn: it is nowhere above round-off, or a number at no time.
    """
    history = run.invariants[0]
    if history.verdict in ("exact", "round-off"):
        raise NotDrawn("The error stays below round-off.")
    points = _finite(run, history)
    if not points:
        raise NotDrawn("There is no error that is a number.")
    frame, exponent = _frame(points)
    factor = 10.0**-exponent
    scaled = [(t, e * factor) for t, e in points]
    frame.curve(0, scaled, 1.1)
    start, end = frame.x.low, frame.x.high
    frame.line((start, 0.0), (end, 0.0))
    _draw_drift(frame, history, points, factor)
    description = _description(run, history)
    label = "H(t) − H(0)" if run.energy else f"error of {history.name}"
    if exponent:
        label += f" in {power_of_ten(exponent)}"
    across = linear_marks(start, end, 6)
    marks = across, linear_marks(frame.y.low, frame.y.high, 6)
    return frame.finished(_TITLE, description, marks, ("time t", label))


def _run(method: GarkMethod) -> LongRun:
    problem = hamiltonian(_PROBLEM, terms_of(with_joined_terms(method.tableau)))
    step, _ = usual(problem)
    try:
        return long_run(method, problem, STEPS * step, step, points=_POINTS)
    except StepFailed as error:
        raise NotDrawn(f"A step fails on Kepler's problem: {error}.") from None


def _finite(run: LongRun, history: InvariantHistory) -> list[Point]:
    pairs = zip(run.times, history.errors, strict=True)
    return [(t, e) for t, e in pairs if isfinite(e)]


def _frame(points: list[Point]) -> tuple[Frame, int]:
    """The frame, and the power of ten that its numbers are in."""
    errors = [e for _, e in points]
    exponent = common_exponent(errors)
    factor = 10.0**-exponent
    low = min(0.0, *errors) * factor
    high = max(0.0, *errors) * factor
    around = 0.06 * (high - low) or 1.0
    start, _ = points[0]
    end, _ = points[-1]
    horizontal = start, end
    vertical = low - around, high + around
    return Frame.of(horizontal, vertical, _HEIGHT), exponent


def _draw_drift(
    frame: Frame, history: InvariantHistory, points: list[Point], factor: float
) -> None:
    """The line of a drift, in the middle of what the errors do besides."""
    drift = history.drift
    if drift is None or history.verdict != "drifts":
        return
    if history.shape != "line":
        return
    left = [e - drift * t for t, e in points]
    middle = (max(left) + min(left)) / 2
    times = frame.x.low, frame.x.high
    line = [(t, (middle + drift * t) * factor) for t in times]
    frame.curve(1, line, 1.6)
    names = "energy error", "its drift"
    frame.legend.extend(enumerate(names))


_WORDS = {
    "bounded": "no drift can be told",
    "drifts": "it drifts",
    "unstable": "it blows up, or the orbit escapes",
    "undecided": "the run does not tell whether it drifts",
}


def _largest(history: InvariantHistory) -> str:
    return in_words(measured(history.max_error, history.round_off, 2))


def _description(run: LongRun, history: InvariantHistory) -> str:
    largest = _largest(history)
    return (
        f"Energy error against time, from 0 to {run.end:g}: at most {largest}; "
        f"{_WORDS[history.verdict]}."
    )


def _note(run: LongRun, history: InvariantHistory) -> str:
    largest = _largest(history)
    return (
        f"Numerical: the {word_for(run.method)} on Kepler's problem, {run.steps} steps of "
        f"{run.step}; the largest error is {largest}, and {_WORDS[history.verdict]}."
    )
