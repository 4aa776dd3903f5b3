"""``gark converge``: the errors of a method over step sizes, the order that they show."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple, get_args

from flint import arb, fmpq

from garkcli.convergence.result import (
    CLOSE,
    MAX_ORDER,
    Convergence,
    Cost,
    Stiffness,
    Verdict,
    curve,
)
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
from garkcli.tell.dialect import Plain, Status
from garkcli.tell.facts import (
    Answer,
    Json,
    Kind,
    Labels,
    Level,
    Row,
    Rows,
    Section,
    SectionChoice,
    Words,
    maybe,
    optional,
    via,
)
from garkcli.tell.kinds import COUNT, DERIVATION, EXACT, POSITION, TEXT, TEXTS, TRUTH, choice
from garkcli.tell.parts import answer, part, plot, rows_of, table
from garkcli.tell.report import Report

HEADLINE, USUAL, DETAIL, DATA = Level
MOST_STEPS = 10
"""Rows of a usual table in a terminal."""
_LONGEST_HEAD = 40  # characters of the name of an invariant above a column
NO_TIME = "no seconds where floats do not reach the error: the counts are for more digits"


class ConvergenceReport(Frozen):
    """The test of one method; attributes as in ``Compared``."""

    result: Convergence
    name: str
    has_work: bool = False
    against: str = "h"


class StepTold(NamedTuple):
    """A step size of a test."""

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
    """An order or a slope, rounded to four decimals; never −0."""
    return round(order, 4) + 0.0


STEP_SIZE: Kind[fmpq] = Kind(
    Json(S.SIZE, lambda h, _: to_float(h)), Words(lambda h, d: d.number(h))
)
MEASURED: Kind[arb] = Kind(
    Json(S.SIZE, lambda x, _: _number(x), csv=for_programs), Words(lambda x, d: d.prose(rounded(x)))
)
SLOPE: Kind[float] = Kind(Json(S.NUMBER, lambda x, _: _place(x)), Words(lambda x, _: f"{x:.3f}"))
OBSERVED: Kind[float] = Kind(
    Json(S.NUMBER, lambda x, _: _place(x)), Words(lambda x, _: order_text(x))
)
RESOLUTION: Kind[float] = Kind(Json(S.SIZE, lambda x, _: float(f"{x:.3g}")))
SECONDS: Kind[float] = Kind(Json(S.SIZE), Words(lambda x, _: scientific(arb(x))))


def _short_name(name: str) -> str:
    return name if len(name) <= _LONGEST_HEAD else f"{name[:24]}…{name[-15:]}"


INVARIANT_ERRORS: Kind[dict[str, arb]] = Kind(
    Json(
        {"type": "object", "additionalProperties": S.SIZE},
        lambda errors, _: {name: _number(x) for name, x in errors.items()},
        csv=lambda errors: {
            f"{name.replace(' ', '_')}_error": for_programs(x) for name, x in errors.items()
        },
    ),
    Labels(
        lambda errors, d: [
            (d.prose(f"{_short_name(name)} error"), d.prose(rounded(x)))
            for name, x in errors.items()
        ]
    ),
)

COST: Section[Cost] = Section(
    Row("steps", COUNT, lambda x: x.steps),
    Row("evaluations", COUNT, lambda x: x.evaluations),
    Row("newton_iterations", COUNT, lambda x: x.iterations, label="iterations"),
    Row("jacobians", COUNT, lambda x: x.jacobians, label="Jacobians"),
    maybe("seconds", SECONDS, lambda x: x.seconds),
)
STEP: Section[StepTold] = Section(
    Row("h", STEP_SIZE, lambda x: x.row.h),
    Row("h_exact", EXACT, lambda x: x.row.h, DATA),
    Row("error", MEASURED, lambda x: x.row.error),
    maybe("slope", SLOPE, lambda x: x.row.slope),
    maybe("energy_error", MEASURED, lambda x: x.row.energy_error),
    Row("invariant_errors", INVARIANT_ERRORS, lambda x: x.invariant_errors),
    maybe("digits", POSITION, lambda x: x.row.digits),
    optional("below_round_off", TEXTS, lambda x: x.below_round_off, DATA),
)
WORKED: Section[StepTold] = Section(STEP.rows, maybe("work", part(COST), lambda x: x.row.cost))
_STEPS: Section[StepTold] = SectionChoice(
    lambda x: WORKED if x.test.has_work else STEP, STEP, WORKED
)


def steps(test: ConvergenceReport) -> list[StepTold]:
    return [StepTold(row, test) for row in test.result.rows]


def lines(x: ConvergenceReport | FailedRun) -> tuple[Section[StepTold], list[StepTold]]:
    """The rows for CSV, without the column of energies if the problem has none."""
    if isinstance(x, FailedRun):
        return STEP, []
    section, found = WORKED if x.has_work else STEP, steps(x)
    if all(step.row.energy_error is not None for step in found):
        return section, found
    return Section(row for row in section.rows if row.key != "energy_error"), found


def visible(x: Convergence) -> Answer[int]:
    """The order to observe; a lower bound if the problem may hide some trees."""
    return Answer(
        x.visible_order, Status(at_least=not x.visible.is_sharp), Reason("{}", x.visible.trees)
    )


def predicted(x: Convergence) -> Answer[int]:
    """The order of the method, with the part that the problem hides."""
    hidden = f"its failing trees of order {x.predicted_order + 1} are not seen here"
    return Answer(
        x.predicted_order,
        Status(at_least=x.predicted_order >= MAX_ORDER),
        Reason(hidden if x.hides_failure else ""),
    )


def verdict_words(x: Convergence, d: Plain) -> str:
    verdict = x.verdict
    if x.is_left_to_tiny_steps:
        return d.good("tiny steps agree")
    if verdict == "reduced":
        return d.note("reduced by stiffness")
    if verdict == "undecided":
        return d.note("undecided")
    return d.good("they agree") if verdict == "agree" else d.bad("THEY DISAGREE")


def _answer(x: Convergence, d: Plain) -> str:
    seen = d.known(str(x.visible_order), visible(x).status)
    observed = f"order {order_text(x.observed_order)} observed"
    if x.observed_order is None:
        observed = "no order observed"
    return f"{observed}, {seen} visible: {verdict_words(x, d)}"


def remarks(result: Convergence) -> list[str]:
    """Remarks on the verdict."""
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


def _stage_orders(stiff: Stiffness) -> str:
    if stiff.stage_order is None:
        return ""
    weak = stiff.weak_stage_order or 0
    weak_order = f", weak stage order {weak}" if weak > stiff.stage_order else ""
    return f", stage order {stiff.stage_order}{weak_order}"


def _of_short_time(result: Convergence) -> str:
    observed, short = result.observed_order, result.short_order
    time = scientific(arb(result.short_time), 1)
    tiny = f"with tiny steps, to t = {time}, it is {order_text(short)}"
    if result.verdict == "reduced":
        return tiny
    if observed is not None and short is not None:
        if abs(observed - short) <= CLOSE:
            return f"the problem hides the trees that fail, or their errors cancel: {tiny}"
        if abs(observed - round(observed)) <= CLOSE and short < observed:
            missed = f"conditions of order {round(short) + 1} are missed by little"
            return f"{missed}, which these step sizes do not show; {tiny}"
    return f"at these step sizes the order has not settled; {tiny}"


def notes(test: ConvergenceReport) -> list[str]:
    rows = test.result.rows
    is_timed = all(row.cost is not None and row.cost.seconds is not None for row in rows)
    return [*remarks(test.result), *([NO_TIME] if test.has_work and not is_timed else [])]


SHORT: Section[Convergence] = Section(
    Row("t_end", EXACT, lambda x: x.short_time),
    maybe("observed_order", OBSERVED, lambda x: x.short_order),
)
OF_STIFFNESS: Rows[Stiffness] = (
    maybe("stage_order", COUNT, lambda x: x.stage_order),
    maybe("weak_stage_order", COUNT, lambda x: x.weak_stage_order),
)
STIFF: Section[Convergence] = Section(
    maybe(
        "least_h_times_norm", RESOLUTION, lambda x: None if x.stiff is None else x.stiff.resolution
    ),
    Row("classical_order", COUNT, lambda x: x.predicted_order),
    via(lambda x: x.stiff, OF_STIFFNESS),
    maybe("slope", SLOPE, lambda x: x.observed_order),
)
_RESULT: Rows[Convergence] = [
    Row("t_end", EXACT, lambda x: x.t_end, DATA),
    answer(_answer),
    Row("visible_order", COUNT, visible),
    Row("visible_order_is_exact", TRUTH, lambda x: x.visible.is_sharp, DATA),
    Row("predicted_order", COUNT, predicted),
    optional(
        "jacobian",
        choice("old", "diagonal"),
        lambda x: None if x.jacobian == "exact" else x.jacobian,
        label="Jacobian",
    ),
    maybe("observed_order", OBSERVED, lambda x: x.observed_order, DATA),
    Row("agrees", TRUTH, lambda x: x.agrees, DATA),
    Row("verdict", choice(*get_args(Verdict)), lambda x: x.verdict, DATA),
    Row("plateau", COUNT, lambda x: x.plateau, DATA),
    optional("short", part(SHORT), lambda x: None if x.short_time is None else x, DATA),
    optional("stiff", part(STIFF), lambda x: None if x.stiff is None else x, DATA),
    Row("note", TEXT, lambda x: x.visible.trees, DATA),
]


def _form(problem: Rows[Run]) -> Section[ConvergenceReport]:
    return Section(
        Row("name", TEXT, lambda x: x.name, DATA),
        Row("derivation", DERIVATION, lambda x: derivation_of(x.result.method), DATA),
        via(lambda x: x.result, problem),
        via(lambda x: x.result, _RESULT),
        Row("notes", rows_of(_notes_rows), notes),
        Row("steps", table(_STEPS, MOST_STEPS), steps),
        plot(
            lambda x: errors_scene([(x.name, x.result)], x.against),
            lambda x: len([*curve(x.result, x.against)]) > 1,
        ),
        title=lambda x, d: d.prose(x.name),
    )


def _notes_rows(texts: Sequence[str], d: Plain) -> list[tuple[str, str]]:
    return [("note", d.prose(x)) for x in texts]


FORMS = {kind: _form(problem) for kind, problem in STEPPED.items()}
"""By the kind of the problem."""


def form(x: ConvergenceReport | FailedRun) -> Section[Any]:
    return FAILURE if isinstance(x, FailedRun) else FORMS[type(x.result.problem)]


REPORT: Report[ConvergenceReport | FailedRun] = Report(
    "gark/converge/1",
    "report of gark converge",
    lambda: (*FORMS.values(), FAILURE),
    form,
    key="",
    lines=lines,
)  # fmt: skip


def whole(result: Convergence, name: str) -> ConvergenceReport:
    """A test under the name of its method if there is no other."""
    return ConvergenceReport(result, name or ("" if result.method is None else result.method.name))
