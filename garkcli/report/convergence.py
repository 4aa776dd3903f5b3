"""``gark converge``: the errors of a method over step sizes, and their order."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple, get_args

from flint import arb, fmpq

from garkcli.convergence import result as results
from garkcli.convergence.result import StepSizeRow as Step
from garkcli.exact.display import to_float
from garkcli.frozen import Frozen
from garkcli.page import schema as S  # noqa: N812 -- its names are those of kinds too
from garkcli.page.figures import for_programs, order_text, rounded, scientific
from garkcli.plots.convergence import errors_scene
from garkcli.problems.deferred import names_of
from garkcli.problems.oscillator import Oscillator
from garkcli.reason import Reason
from garkcli.report.problem import STEPPED, Run
from garkcli.report.remarks import FAILURE, FailedRun
from garkcli.tableau.garkmethod import derivation_of
from garkcli.tell import facts
from garkcli.tell.dialect import Plain, Status
from garkcli.tell.kinds import COUNT, DERIVATION, EXACT, POSITION, TEXT, TEXTS, TRUTH, choice
from garkcli.tell.parts import answer, part, plot, rows_of, table
from garkcli.tell.report import Report

HEADLINE, USUAL, DETAIL, DATA = facts.Level
MOST_STEPS = 10
_LONGEST_HEAD = 40  # characters of the name of an invariant above a column
NO_TIME = "no seconds where floats do not reach the error: the counts are for more digits"


class ConvergenceReport(Frozen):
    result: results.Convergence
    name: str
    has_work: bool = False
    against: str = "h"


class StepTold(NamedTuple):
    row: Step
    test: ConvergenceReport

    @property
    def invariant_errors(self) -> dict[str, arb]:
        problem = self.test.result.problem
        names = [] if isinstance(problem, Oscillator) else names_of(problem.invariants)
        return dict(zip(names, self.row.invariant_errors, strict=True))

    @property
    def below_round_off(self) -> list[str] | None:
        """The quantities whose error is below round-off; None without such."""
        energy = self.row.energy_error
        errors = {**({} if energy is None else {"energy": energy}), **self.invariant_errors}
        return [name for name, x in errors.items() if x.is_finite() and _is_below(x)] or None


def _is_below(x: arb) -> bool:
    return bool(x.contains(0) and not x.is_zero())


def _number(ball: arb) -> float | None:
    """A measured number, rounded for programs; None if it is unknown."""
    text = for_programs(ball)
    return float(text) if text else None


def _place(order: float) -> float:
    """Rounded to four decimals; never −0."""
    return round(order, 4) + 0.0


STEP_SIZE: facts.Kind[fmpq] = facts.Kind(
    facts.Json(S.SIZE, lambda h, _: to_float(h)), facts.Words(lambda h, d: d.number(h))
)
MEASURED: facts.Kind[arb] = facts.Kind(
    facts.Json(S.SIZE, lambda x, _: _number(x), csv=for_programs),
    facts.Words(lambda x, d: d.prose(rounded(x))),
)
SLOPE: facts.Kind[float] = facts.Kind(
    facts.Json(S.NUMBER, lambda x, _: _place(x)), facts.Words(lambda x, _: f"{x:.3f}")
)
OBSERVED: facts.Kind[float] = facts.Kind(
    facts.Json(S.NUMBER, lambda x, _: _place(x)), facts.Words(lambda x, _: order_text(x))
)
RESOLUTION: facts.Kind[float] = facts.Kind(facts.Json(S.SIZE, lambda x, _: float(f"{x:.3g}")))
SECONDS: facts.Kind[float] = facts.Kind(
    facts.Json(S.SIZE), facts.Words(lambda x, _: scientific(arb(x)))
)


def _short_name(name: str) -> str:
    return name if len(name) <= _LONGEST_HEAD else f"{name[:24]}…{name[-15:]}"


INVARIANT_ERRORS: facts.Kind[dict[str, arb]] = facts.Kind(
    facts.Json(
        {"type": "object", "additionalProperties": S.SIZE},
        lambda errors, _: {name: _number(x) for name, x in errors.items()},
        csv=lambda errors: {
            f"{name.replace(' ', '_')}_error": for_programs(x) for name, x in errors.items()
        },
    ),
    facts.Labels(
        lambda errors, d: [
            (d.prose(f"{_short_name(name)} error"), d.prose(rounded(x)))
            for name, x in errors.items()
        ]
    ),
)

COST: facts.Section[results.Cost] = facts.Section(
    facts.Row("steps", COUNT, lambda x: x.steps),
    facts.Row("evaluations", COUNT, lambda x: x.evaluations),
    facts.Row("newton_iterations", COUNT, lambda x: x.iterations, label="iterations"),
    facts.Row("jacobians", COUNT, lambda x: x.jacobians, label="Jacobians"),
    facts.maybe("seconds", SECONDS, lambda x: x.seconds),
)
STEP: facts.Section[StepTold] = facts.Section(
    facts.Row("h", STEP_SIZE, lambda x: x.row.h),
    facts.Row("h_exact", EXACT, lambda x: x.row.h, DATA),
    facts.Row("error", MEASURED, lambda x: x.row.error),
    facts.maybe("slope", SLOPE, lambda x: x.row.slope),
    facts.maybe("energy_error", MEASURED, lambda x: x.row.energy_error),
    facts.Row("invariant_errors", INVARIANT_ERRORS, lambda x: x.invariant_errors),
    facts.maybe("digits", POSITION, lambda x: x.row.digits),
    facts.optional("below_round_off", TEXTS, lambda x: x.below_round_off, DATA),
)
WORKED: facts.Section[StepTold] = facts.Section(
    STEP.rows, facts.maybe("work", part(COST), lambda x: x.row.cost)
)
_STEPS: facts.Section[StepTold] = facts.SectionChoice(
    lambda x: WORKED if x.test.has_work else STEP, STEP, WORKED
)


def steps(test: ConvergenceReport) -> list[StepTold]:
    return [StepTold(row, test) for row in test.result.rows]


def lines(x: ConvergenceReport | FailedRun) -> tuple[facts.Section[StepTold], list[StepTold]]:
    """The rows for CSV, without the column of energies if the problem has none."""
    if isinstance(x, FailedRun):
        return STEP, []
    section, found = WORKED if x.has_work else STEP, steps(x)
    if all(step.row.energy_error is not None for step in found):
        return section, found
    return facts.Section(row for row in section.rows if row.key != "energy_error"), found


def visible(x: results.Convergence) -> facts.Answer[int]:
    """The order to observe; a lower bound if the problem may hide some trees."""
    return facts.Answer(
        x.visible_order, Status(at_least=not x.visible.is_sharp), Reason("{}", x.visible.trees)
    )


def predicted(x: results.Convergence) -> facts.Answer[int]:
    """The order of the method, with the part that the problem hides."""
    hidden = f"its failing trees of order {x.predicted_order + 1} are not seen here"
    return facts.Answer(
        x.predicted_order,
        Status(at_least=x.predicted_order >= results.MAX_ORDER),
        Reason(hidden if x.hides_failure else ""),
    )


def verdict_words(x: results.Convergence, d: Plain) -> str:
    verdict = x.verdict
    if x.is_left_to_tiny_steps:
        return d.good("tiny steps agree")
    if verdict == "reduced":
        return d.note("reduced by stiffness")
    if verdict == "undecided":
        return d.note("undecided")
    return d.good("they agree") if verdict == "agree" else d.bad("THEY DISAGREE")


def _answer(x: results.Convergence, d: Plain) -> str:
    seen = d.known(str(x.visible_order), visible(x).status)
    observed = f"order {order_text(x.observed_order)} observed"
    if x.observed_order is None:
        observed = "no order observed"
    return f"{observed}, {seen} visible: {verdict_words(x, d)}"


def remarks(result: results.Convergence) -> list[str]:
    said = []
    if result.plateau:
        said.append(
            f"the last {result.plateau} rows show the rounding of the coefficients "
            "and are not fitted"
        )
    if result.stiff is not None:
        size = scientific(arb(result.stiff.resolution), 1)
        said.append(
            f"stiff: h ‖∂f/∂y‖ is {size} or more; classical order {result.predicted_order}"
            f"{_stage_orders(result.stiff)}"
            if result.stiff.is_stable
            else f"h ‖∂f/∂y‖ is {size} or more, and the steps are not stable there"
        )
    if result.is_at_rest:
        said.append("the solution does not move, so that no method makes an error: start elsewhere")
    elif result.is_exact:
        said.append("the method makes no error on this problem, which shows no order: take another")
    elif result.short_time is not None:
        said.append(_of_short_time(result))
    elif not result.has_settled:
        said.append("the rounding of the coefficients comes before the slopes have settled")
    if len(result.rows) == 1 and not result.is_exact:
        said.append("one step size shows no order")
    return said


def _stage_orders(stiff: results.Stiffness) -> str:
    if stiff.stage_order is None:
        return ""
    weak = stiff.weak_stage_order or 0
    weak_order = f", weak stage order {weak}" if weak > stiff.stage_order else ""
    return f", stage order {stiff.stage_order}{weak_order}"


def _of_short_time(result: results.Convergence) -> str:
    observed, short = result.observed_order, result.short_order
    time = scientific(arb(result.short_time), 1)
    tiny = f"with tiny steps, to t = {time}, it is {order_text(short)}"
    if result.verdict == "reduced":
        return tiny
    if observed is not None and short is not None:
        if abs(observed - short) <= results.CLOSE:
            return f"the problem hides the trees that fail, or their errors cancel: {tiny}"
        if abs(observed - round(observed)) <= results.CLOSE and short < observed:
            missed = f"conditions of order {round(short) + 1} are missed by little"
            return f"{missed}, which these step sizes do not show; {tiny}"
    return f"at these step sizes the order has not settled; {tiny}"


def notes(test: ConvergenceReport) -> list[str]:
    rows = test.result.rows
    is_timed = all(row.cost is not None and row.cost.seconds is not None for row in rows)
    return [*remarks(test.result), *([NO_TIME] if test.has_work and not is_timed else [])]


SHORT: facts.Section[results.Convergence] = facts.Section(
    facts.Row("t_end", EXACT, lambda x: x.short_time),
    facts.maybe("observed_order", OBSERVED, lambda x: x.short_order),
)
OF_STIFFNESS: facts.Rows[results.Stiffness] = (
    facts.maybe("stage_order", COUNT, lambda x: x.stage_order),
    facts.maybe("weak_stage_order", COUNT, lambda x: x.weak_stage_order),
)
STIFF: facts.Section[results.Convergence] = facts.Section(
    facts.maybe(
        "least_h_times_norm", RESOLUTION, lambda x: None if x.stiff is None else x.stiff.resolution
    ),
    facts.Row("classical_order", COUNT, lambda x: x.predicted_order),
    facts.via(lambda x: x.stiff, OF_STIFFNESS),
    facts.maybe("slope", SLOPE, lambda x: x.observed_order),
)
_RESULT: facts.Rows[results.Convergence] = [
    facts.Row("t_end", EXACT, lambda x: x.t_end, DATA),
    answer(_answer),
    facts.Row("visible_order", COUNT, visible),
    facts.Row("visible_order_is_exact", TRUTH, lambda x: x.visible.is_sharp, DATA),
    facts.Row("predicted_order", COUNT, predicted),
    facts.optional(
        "jacobian",
        choice("old", "diagonal"),
        lambda x: None if x.jacobian == "exact" else x.jacobian,
        label="Jacobian",
    ),
    facts.maybe("observed_order", OBSERVED, lambda x: x.observed_order, DATA),
    facts.Row("agrees", TRUTH, lambda x: x.agrees, DATA),
    facts.Row("verdict", choice(*get_args(results.Verdict)), lambda x: x.verdict, DATA),
    facts.Row("plateau", COUNT, lambda x: x.plateau, DATA),
    facts.optional("short", part(SHORT), lambda x: None if x.short_time is None else x, DATA),
    facts.optional("stiff", part(STIFF), lambda x: None if x.stiff is None else x, DATA),
    facts.Row("note", TEXT, lambda x: x.visible.trees, DATA),
]


def _form(problem: facts.Rows[Run]) -> facts.Section[ConvergenceReport]:
    return facts.Section(
        facts.Row("name", TEXT, lambda x: x.name, DATA),
        facts.Row("derivation", DERIVATION, lambda x: derivation_of(x.result.method), DATA),
        facts.via(lambda x: x.result, problem),
        facts.via(lambda x: x.result, _RESULT),
        facts.Row("notes", rows_of(_notes_rows), notes),
        facts.Row("steps", table(_STEPS, MOST_STEPS), steps),
        plot(
            lambda x: errors_scene([(x.name, x.result)], x.against),
            lambda x: len([*results.curve(x.result, x.against)]) > 1,
        ),
        title=lambda x, d: d.prose(x.name),
    )


def _notes_rows(texts: Sequence[str], d: Plain) -> list[tuple[str, str]]:
    return [("note", d.prose(x)) for x in texts]


FORMS = {kind: _form(problem) for kind, problem in STEPPED.items()}


def form(x: ConvergenceReport | FailedRun) -> facts.Section[Any]:
    return FAILURE if isinstance(x, FailedRun) else FORMS[type(x.result.problem)]


REPORT: Report[ConvergenceReport | FailedRun] = Report(
    "gark/converge/1",
    "report of gark converge",
    lambda: (*FORMS.values(), FAILURE),
    form,
    key="",
    lines=lines,
)  # fmt: skip


def whole(result: results.Convergence, name: str) -> ConvergenceReport:
    return ConvergenceReport(result, name or ("" if result.method is None else result.method.name))
