"""``gark energy``: conserved quantities over a long time."""

from __future__ import annotations

from collections.abc import Iterator
from math import isnan
from typing import Any, NamedTuple, get_args

from flint import fmpq

from garkcli.errors import counted
from garkcli.exact.display import to_decimal, to_float
from garkcli.frozen import Frozen, replace
from garkcli.longtime import history as histories
from garkcli.longtime.rounding import power_of_ten
from garkcli.longtime.symplecticity import Defect, Symplecticity
from garkcli.longtime.trend import LEAST, Shape
from garkcli.page import schema as S  # noqa: N812 -- its names are those of kinds too
from garkcli.page.figures import measured
from garkcli.plots.curves import energy_scene
from garkcli.problems.hamiltonian import FLOAT_DIGITS
from garkcli.report.problem import STEPPED, Run
from garkcli.report.remarks import FAILURE, FailedRun
from garkcli.tableau.garkmethod import derivation_of, word_for
from garkcli.tell import facts
from garkcli.tell.dialect import Plain
from garkcli.tell.kinds import COUNT, DERIVATION, EXACT, POSITION, TEXT, TRUTH, choice, claim_word
from garkcli.tell.parts import SAID, answer, part, parts, plot, rows_of, table
from garkcli.tell.report import Report

HEADLINE, USUAL, DETAIL, DATA = facts.Level
MOST_QUANTITIES = 10
FATES = {
    "elliptic": "the energy error is bounded for all time",
    "unstable": "the energy grows for ever",
    "contractive": "the energy decays for ever",
    "marginal": "energy is lost, but not all of it",
}
_NEARLY = 2.0
"""The largest ratio of an uncertainty to round-off at which it is round-off alone."""


class RunClaim(Frozen):
    claim: str
    found: str
    holds: bool | None


class EnergyReport(Frozen):
    name: str
    run: histories.LongRun
    symplecticity: Symplecticity | None = None
    claims: tuple[RunClaim, ...] = ()


class Quantity(NamedTuple):
    history: histories.InvariantHistory
    run: histories.LongRun


def _word(history: histories.InvariantHistory, d: Plain) -> str:
    news, word = histories.WORDS[history.verdict]
    return str(getattr(d, news)(word))


def _because(history: histories.InvariantHistory, run: histories.LongRun) -> str:
    match history.verdict:
        case "exact":
            return " by every step, exactly"
        case "round-off":
            text = f", at most {history.round_off:.0e} here"
            if run.digits and run.digits <= 100:
                text += f"; --digits {2 * run.digits} shows more"
            return text
        case "unstable":
            if run.escaped is None:
                return f": blown up after {run.steps} steps, at t = {run.end:g}"
            time = to_float(run.escaped)
            error = measured(history.errors[-1], history.round_off, 2)
            return f": the orbit escapes after t = {time:g}, where the error is {error}"
        case "undecided":
            return f": {'; '.join(filter(None, _undecided(history, run)))}"
        case "bounded" if run.stability is not None and run.stability.fate == "elliptic":
            return " for all time: det R(h) = 1 and |tr R(h)| < 2, decided exactly"
        case "bounded":
            return ": no drift beyond its uncertainty"
    if run.stability is not None:
        return f": det R(h) − 1 = {_determinant(run.stability)}, {FATES[run.stability.fate]}"
    if history.shape == "line":
        return f": the slope is {_times(history)} times its uncertainty"
    if history.shape == "curve":
        # the fitted slope of what is no line may be nothing but rounding
        return f": it {_direction(history)} all along, by more than it oscillates"
    return ": it moves to another level and stays there"


def _verdicts(run: histories.LongRun, d: Plain) -> list[tuple[str, str]]:
    return [(d.prose(x.name), _word(x, d) + d.prose(_because(x, run))) for x in run.invariants]


def _undecided(history: histories.InvariantHistory, run: histories.LongRun) -> tuple[str, str]:
    """Why a trend is undecided, and what would decide it."""
    longer = f"--t-end {history.longer}"
    can_tell = f"{longer} can tell"
    if history.longer is None:
        can_tell = "a larger step, for a longer time, can tell"
    doubts = {
        "steps": (f"fewer than {LEAST} steps", can_tell),
        "turns": (f"the motion turns back {counted(run.turns, 'time')} only", can_tell),
        "rest": ("the solution does not move", "start elsewhere"),
        "value": (
            f"it has no value at t = {history.no_value_at}",
            "choose an invariant that has one all along, or an earlier --t-end",
        ),
        "round-off": (
            "rounding may be as large as it is",
            f"--digits {2 * (run.digits or FLOAT_DIGITS)} can tell",
        ),
        "modulation": (
            f"the slope is {_times(history)} times its uncertainty; a slow modulation may do that",
            can_tell,
        ),
        "symplectic": (
            f"it {_direction(history)} throughout; for a symplectic method that is usually a slow "
            "oscillation",
            can_tell if history.longer is None else f"try {longer}",
        ),
        "rounding": (
            "drifts; rounding of the coefficients may be the cause",
            "coefficients with more digits can tell",
        ),
    }
    level = "it moves to another level; that may happen once, or again and again"
    return doubts.get(history.doubt or "", (level, can_tell if history.doubt else ""))


def _direction(history: histories.InvariantHistory) -> str:
    """Returns the direction of the slope or, without one, of the end."""
    drift = history.drift or 0.0
    went = drift if history.shape == "line" else history.errors[-1]
    return "rises" if went > 0 else "falls"


def _times(history: histories.InvariantHistory) -> str:
    """The drift over its uncertainty, in one digit."""
    drift = history.drift or 0.0
    uncertainty = history.uncertainty or 1.0
    times = abs(drift) / uncertainty
    digit = float(f"{times:.1g}")
    return f"{digit:g}"


def _determinant(stability: histories.StepMapStability) -> str:
    return to_decimal(stability.determinant - 1, 4)


def _is_measured(history: histories.InvariantHistory) -> bool:
    return history.verdict != "exact" and history.doubt not in ("rest", "value")


def _oscillates(history: histories.InvariantHistory) -> bool:
    is_noise = history.verdict in ("round-off", "unstable") or history.doubt == "round-off"
    return _is_measured(history) and not is_noise


def _largest(history: histories.InvariantHistory) -> str | None:
    return measured(history.max_error, history.round_off) if _is_measured(history) else None


def _oscillation(history: histories.InvariantHistory) -> str | None:
    if not _oscillates(history):
        return None
    return f"± {measured(history.amplitude, history.round_off, 3)}"


def _drift(x: Quantity) -> str | None:
    """Per unit of time and in all, in as many digits as are certain."""
    history, run = x
    if not _oscillates(history) or history.drift is None:
        return None
    drift = history.drift
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


def _symplectic(report: EnergyReport) -> Iterator[str]:
    found, stability = report.symplecticity, report.run.stability
    if found is None:
        return
    whose = word_for(report.run.method)
    coefficients = "its coefficients" if whose == "method" else f"the coefficients of the {whose}"
    is_lost = stability is not None and not stability.is_symplectic
    if found.is_proved:
        yield f"yes, by {coefficients}"
    elif is_lost or any(x.is_seen for x in found.defects):
        yield "no"
    elif stability is None and not found.defects:
        yield f"not proved by {coefficients}; --symplecticity measures"
    else:
        yield f"not proved by {coefficients}"
    if stability is not None:
        ending = ", exactly" if stability.is_symplectic else ""
        yield f"det R(h) − 1 = {_determinant(stability)}{ending}"
    if not found.defects:
        return
    times = ", ".join(str(x.time) for x in found.defects)
    largest = max(found.defects, key=lambda x: x.size)
    if any(x.is_seen for x in found.defects):
        size = f"has entries up to {largest.size:.3e}, good to {power_of_ten(largest.error):.0e}"
    else:
        bound = power_of_ten(max(x.error for x in found.defects))
        size = f"is below {bound:.0e}, what it is measured to"
    yield f"MᵀJM − J {size}, at t = {times}"


def _steps(run: histories.LongRun) -> str:
    how = "exact" if run.digits is None else "in floats"
    if run.digits is not None and run.digits > FLOAT_DIGITS:
        how = f"{run.digits} digits"
    return f"{run.steps} of {run.step}, {how}"


def _answer(run: histories.LongRun, d: Plain) -> str:
    return ", ".join(f"{d.prose(x.name)} {_word(x, d)}" for x in run.invariants)


def _claims(claims: tuple[RunClaim, ...], d: Plain) -> list[tuple[str, str]]:
    return [
        (claim_word(x.holds, d), d.prose(x.claim if x.holds else f"{x.claim}, found: {x.found}"))
        for x in claims
    ]


def _seen(run: histories.LongRun) -> tuple[histories.InvariantHistory, ...]:
    """The invariants whose errors exceed round-off, which depends on the machine."""
    return tuple(x for x in run.invariants if x.max_error > x.round_off)


SIZE: facts.Kind[float] = facts.Kind(facts.Json(S.SIZE))
NUMBER: facts.Kind[float] = facts.Kind(facts.Json(S.NUMBER))
INITIAL: facts.Kind[float] = facts.Kind(facts.Json(S.NUMBER), facts.Words(lambda x, _: f"{x:.6g}"))
TIME: facts.Kind[fmpq] = facts.Kind(facts.Json(S.SIZE, lambda x, _: to_float(x)))
QUANTITY: facts.Section[Quantity] = facts.Section(
    facts.Row("name", TEXT, lambda x: x.history.name, label=""),
    facts.Row("initial", INITIAL, lambda x: x.history.initial, label="at the start"),
    facts.Row("largest", SAID, lambda x: _largest(x.history), label="largest error"),
    facts.Row("oscillation_in_words", SAID, lambda x: _oscillation(x.history), label="oscillation"),
    facts.Row("drift_in_words", SAID, _drift, label="drift"),
    facts.Row("max_error", SIZE, lambda x: x.history.max_error, DATA),
    facts.Row("drift", NUMBER, lambda x: x.history.drift, DATA),
    facts.Row("drift_uncertainty", SIZE, lambda x: x.history.uncertainty, DATA),
    facts.Row(
        "drift_in_all",
        NUMBER,
        lambda x: None if x.history.drift is None else x.history.drift * x.run.end,
        DATA,
    ),
    facts.Row("oscillation", SIZE, lambda x: x.history.amplitude, DATA),
    facts.Row("round_off", SIZE, lambda x: x.history.round_off, DATA),
    facts.Row("rounded_coefficients", SIZE, lambda x: x.history.coefficients, DATA),
    facts.Row("verdict", choice(*get_args(histories.Verdict)), lambda x: x.history.verdict, DATA),
    facts.Row("trend", choice(*get_args(Shape)), lambda x: x.history.shape, DATA),
    facts.Row("t_end_to_decide", TIME, lambda x: x.history.longer, DATA),
    facts.Row("doubt", choice(*get_args(histories.Doubt), None), lambda x: x.history.doubt, DATA),
    facts.Row("no_value_at", TIME, lambda x: x.history.no_value_at, DATA),
)
RUN: facts.Rows[histories.LongRun] = [
    facts.Row("steps_in_words", SAID, _steps, label="steps"),
    facts.Row("step", TIME, lambda x: x.step, DATA),
    facts.Row("step_exact", EXACT, lambda x: x.step, DATA),
    facts.Row("t_end", TIME, lambda x: x.t_end, DATA),
    facts.Row("t_end_exact", EXACT, lambda x: x.t_end, DATA),
    facts.Row("steps", COUNT, lambda x: x.steps, DATA),
    facts.maybe("digits", POSITION, lambda x: x.digits, DATA),
    facts.maybe("turns", COUNT, lambda x: None if x.digits is None else x.turns, DATA),
    facts.Row("blew_up", TRUTH, lambda x: x.is_unstable and x.escaped is None, DATA),
    facts.Row("escaped_at", TIME, lambda x: x.escaped, DATA),
    facts.Row("drifts", TRUTH, lambda x: x.drifts, DATA),
    answer(_answer),
    facts.itself("verdicts", rows_of(_verdicts)),
    facts.Row(
        "quantities",
        table(QUANTITY, MOST_QUANTITIES),
        lambda run: [Quantity(x, run) for x in run.invariants],
        label="",
    ),
]
DEFECT: facts.Section[Defect] = facts.Section(
    facts.Row("t", TIME, lambda x: x.time),
    facts.Row("size", SIZE, lambda x: x.size),
    facts.Row("good_to", SIZE, lambda x: x.error),
)
OF_STEPS: facts.Rows[Symplecticity] = (
    facts.Row("proved", TRUTH, lambda x: x.is_proved),
    facts.Row("defects", parts(DEFECT), lambda x: x.defects),
)
SYMPLECTIC: facts.Section[EnergyReport] = facts.Section(
    facts.via(lambda x: x.symplecticity, OF_STEPS[:1]),
    facts.optional(
        "determinant_minus_1",
        TEXT,
        lambda x: None if x.run.stability is None else _determinant(x.run.stability),
    ),
    facts.via(lambda x: x.symplecticity, OF_STEPS[1:]),
)
CLAIM: facts.Section[RunClaim] = facts.Section(
    facts.Row("claim", TEXT, lambda x: x.claim),
    facts.Row("found", TEXT, lambda x: x.found),
    facts.maybe("holds", TRUTH, lambda x: x.holds),
)


def _form(problem: facts.Rows[Run]) -> facts.Section[EnergyReport]:
    return facts.Section(
        facts.Row("name", TEXT, lambda x: x.name, DATA),
        facts.Row("derivation", DERIVATION, lambda x: derivation_of(x.run.method), DATA),
        facts.via(lambda x: x.run, problem),
        facts.via(lambda x: x.run, RUN),
        facts.Row(
            "symplectic_in_words", SAID, lambda x: "; ".join(_symplectic(x)), label="symplectic"
        ),
        facts.Row("claims_in_words", rows_of(_claims), lambda x: x.claims),
        plot(
            lambda x: energy_scene(replace(x.run, invariants=_seen(x.run))),
            lambda x: bool(_seen(x.run)),
        ),
        facts.maybe(
            "symplectic", part(SYMPLECTIC), lambda x: None if x.symplecticity is None else x, DATA
        ),
        facts.Row("claims", parts(CLAIM), lambda x: x.claims, DATA),
        title=lambda x, d: d.prose(x.name),
    )


FORMS = {kind: _form(problem) for kind, problem in STEPPED.items()}


class Moment(NamedTuple):
    t: float
    errors: dict[str, float]


ERRORS: facts.Kind[dict[str, float]] = facts.Kind(
    facts.Json(
        {"type": "object"},
        csv=lambda errors: {
            f"{name.replace(' ', '_')}_error": "" if isnan(x) else repr(x)
            for name, x in errors.items()
        },
    )
)
MOMENT: facts.Section[Moment] = facts.Section(
    facts.Row("t", SIZE, lambda x: x.t), facts.Row("errors", ERRORS, lambda x: x.errors)
)


def _moments(report: EnergyReport) -> Iterator[Moment]:
    invariants = report.run.invariants
    for k, t in enumerate(report.run.times):
        yield Moment(t, {x.name: x.errors[k] for x in invariants})


def form(x: EnergyReport | FailedRun) -> facts.Section[Any]:
    return FAILURE if isinstance(x, FailedRun) else FORMS[type(x.run.problem)]


REPORT: Report[EnergyReport | FailedRun] = Report(
    "gark/energy/1",
    "report of gark energy",
    lambda: (*FORMS.values(), FAILURE),
    form,
    key="",
    lines=lambda x: (MOMENT, () if isinstance(x, FailedRun) else _moments(x)),
)


def whole(run: histories.LongRun, name: str) -> EnergyReport:
    return EnergyReport(name or ("" if run.method is None else run.method.name), run)
