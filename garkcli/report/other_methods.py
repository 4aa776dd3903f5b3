"""``gark check`` of Rosenbrock, Nyström, multirate and other kinds of methods."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Never, TypeAlias, TypeVar

from garkcli.constructions.derivatives import words_of
from garkcli.constructions.nystrom import Nystrom
from garkcli.constructions.rosenbrock import Rosenbrock
from garkcli.errors import counted
from garkcli.frozen import replace
from garkcli.report import check as c
from garkcli.tell import facts, kinds
from garkcli.tell.dialect import Plain, Status
from garkcli.tell.parts import SAID, part, parts, picture, told

if TYPE_CHECKING:
    from garkcli.check.nystrom import NystromAnalysis, NystromDense
    from garkcli.check.outcome import OtherAnalysis, Outcome
    from garkcli.check.rare_kinds import DerivativesAnalysis, InfinitesimalAnalysis, NprkAnalysis
    from garkcli.check.rosenbrock import RosenbrockAnalysis
    from garkcli.order.deciding import AnyOrder
    from garkcli.order.dense import DenseOrder
    from garkcli.tableau.tableau import Tableau

HEADLINE, USUAL, DETAIL, DATA = facts.Level
A = TypeVar("A", bound="OtherAnalysis")
Linear: TypeAlias = "RosenbrockAnalysis | DerivativesAnalysis"
"""Methods that are Runge–Kutta methods on linear problems."""


def _names(a: OtherAnalysis) -> list[str]:
    return [colour.name for colour in a.tableau.colours]


def _order(
    key: str, level: facts.Level = USUAL, label: str | None = None
) -> facts.Row[OtherAnalysis]:
    claim = key.replace("_", "-")

    def get(a: OtherAnalysis) -> facts.Answer[AnyOrder]:
        view = a.view(claim)
        if view is None:
            return facts.Answer(None)
        order, tableau = view
        names = [x.name for x in tableau.colours] if tableau.size > 1 else []
        return replace(kinds.order_answer(order), names=names)

    row = facts.Row if key == "order" else facts.maybe
    return row(key, kinds.ORDER, get, level, label=label)


def _trees_that_fail(*claims: str) -> facts.Row[OtherAnalysis]:
    def get(a: OtherAnalysis) -> list[c.Failing]:
        return c.each_once({claim: a.view(claim) for claim in claims})

    return facts.Row("trees_that_fail", picture(c.drawn), get, DETAIL)


ERROR_ESTIMATE: facts.Row[OtherAnalysis] = facts.maybe(
    "error_estimate",
    part(c.ESTIMATE, c.estimate_phrase),
    lambda a: None if a.embedded is None else a.embedded.estimator,
)
EXACT_TO: facts.Row[OtherAnalysis] = facts.Row(
    "exact_to", kinds.POSITION, lambda a: a.tableau.exact_to, DATA
)
DENSE: facts.Row[OtherAnalysis] = facts.maybe(
    "dense", part(c.DENSE, c.dense_words), lambda a: a.dense, label="dense output"
)


def _truth(key: str) -> facts.Row[Linear]:
    def get(a: Linear) -> facts.Answer[bool]:
        v = a.subject.verdict(key)
        assert v.value is None or isinstance(v.value, bool)
        return facts.Answer(
            v.value, Status(open=v.reason) if v.is_undecided else Status(), v.reason
        )

    return facts.maybe(key.replace("-", "_"), kinds.TRUTH, get, DATA)


def _stability_words(a: Linear, d: Plain) -> str:
    """``A-stable, R(∞) = 0``."""
    words = []
    for key, name in (("a-stable", "A-stable"), ("l-stable", "L-stable")):
        v = a.subject.verdict(key)
        if v.is_undecided:
            words.append(f"{name} not decided: {d.reason(v.reason)}")
        else:
            words.append(d.known(name if v.value else f"not {name}", Status(a.tolerance)))
            if not v.value and key == "a-stable":
                words[-1] += f": {d.reason(v.reason)}" if v.reason else ""
                break
    limit = a.subject.at_infinity
    if limit is not None and limit:
        words.append(f"{d.prose('R(∞)')} = {d.number(limit)}")
    return ", ".join(words)


STABILITY: facts.Rows[Linear] = (
    facts.itself("stability", told(_stability_words)),
    _truth("a-stable"),
    _truth("l-stable"),
    facts.maybe("R_infinity", kinds.EXACT, lambda a: a.subject.at_infinity, DATA),
    facts.optional(
        "R",
        kinds.ratio("z"),
        lambda a: None if a.tolerance else a.subject.on_linear_problems.linear,
        DETAIL,
        label="R(z)",
    ),
)


def _form(
    get: Callable[[Outcome], A | None], flag: str, words: facts.Wording[A], analysis: facts.Rows[A]
) -> facts.Section[Outcome]:
    def method(a: A, d: Plain) -> str:
        return c.with_arithmetic(words(a, d), a)

    return facts.Section(
        kinds.FILE_AND_NAME,
        c.IS_OK,
        facts.Row(flag, kinds.TRUE, lambda _: True, DATA),
        facts.via(
            get, [facts.itself("method", told(method)), *c.OF_ALL_KINDS, c.COLOURS_OF, *analysis]
        ),
        c.LEFT_BEHIND,
        c.IN_FULL,
        facts.Row("misprints", parts(c.MISPRINT), lambda o: o.misprints, DATA),
        c.CLAIMS,
        title=c.title,
        columns=c.COLUMNS,
    )


def rosenbrock_words(tableau: Tableau) -> str:
    """``Rosenbrock, 2 colours, stages 3, 4``."""
    colours = tableau.size // 2
    stages = [space.stages for space in tableau.spaces[:colours]]
    if colours == 1:
        return f"Rosenbrock, {counted(stages[0], 'stage')}"
    return f"Rosenbrock, {counted(colours, 'colour')}, stages {', '.join(map(str, stages))}"


def _with_gamma(a: RosenbrockAnalysis, d: Plain) -> str:
    text = rosenbrock_words(a.tableau)
    diagonal = set(Rosenbrock.of(a.tableau).diagonal)
    return f"{text}, {d.prose('γ')} = {d.diagonal(diagonal.pop())}" if len(diagonal) == 1 else text


OF_ROSENBROCK_TREES = (
    "f' is f with one branch; W the matrix, with one; E the error of the Jacobian, with one, which "
    "counts two orders; t time; g with several branches, which counts none"
)
OF_ROSENBROCK: facts.Rows[RosenbrockAnalysis] = (
    _order("order", HEADLINE),
    _order("w_order", label="with any matrix W"),
    _order("old_jacobian_order", label="old Jacobian f' + hE"),
    _order("nonautonomous_order", label="order for f(t, y)"),
    _order("index_1_order", label="index 1, 0 = g(y, z)"),
    _order("index_1_y_order", DETAIL, "index 1, error in y"),
    _order("index_1_z_order", DETAIL, "index 1, error in z"),
    _order("embedded_order"),
    _order("embedded_w_order", DETAIL, "embedded, any W"),
    _order("embedded_old_jacobian_order", DETAIL, "embedded, f' + hE"),
    _order("embedded_nonautonomous_order", DETAIL, "embedded for f(t, y)"),
    _order("embedded_index_1_order", DETAIL, "embedded, index 1"),
    ERROR_ESTIMATE,
    facts.maybe(
        "dense_order",
        kinds.COUNT,
        lambda a: None if a.dense is None else c.dense_answer(a.dense.order, _names(a)),
    ),
    DENSE,
    *STABILITY,
    _trees_that_fail("order", "w-order", "index-1-order", "embedded-order"),
    facts.Row("in the trees", SAID, lambda _: OF_ROSENBROCK_TREES, DETAIL),
)
ROSENBROCK = _form(lambda o: o.rosenbrock, "rosenbrock", _with_gamma, OF_ROSENBROCK)


OF_NYSTROM_TREES = "q is g in the step of q, q' is g in that of q′, q'0 is q′ as it begins"


def _nystrom_words(a: NystromAnalysis, d: Plain) -> str:
    force = "g(q)" if Nystrom.of(a.tableau).A is None else "g(q, q′)"
    return d.prose(f"Nyström for q″ = {force}, {counted(a.tableau.spaces[0].stages, 'stage')}")


def _dense(
    key: str,
    of: Callable[[NystromDense], DenseOrder],
    level: facts.Level = USUAL,
    label: str | None = None,
) -> facts.Row[NystromAnalysis]:
    def get(a: NystromAnalysis) -> facts.Answer[int] | None:
        return None if a.dense is None else c.dense_answer(of(a.dense), _names(a))

    return facts.maybe(key, kinds.COUNT, get, level, label=label)


OF_NYSTROM: facts.Rows[NystromAnalysis] = (
    _order("order", HEADLINE),
    _order("position_order", label="order of q"),
    _order("velocity_order", label="order of q′"),
    _order("embedded_order"),
    _order("embedded_position_order", label="embedded, q"),
    _order("embedded_velocity_order", label="embedded, q′"),
    ERROR_ESTIMATE,
    _dense("dense_order", lambda x: x.order, DETAIL),
    _dense("dense_position_order", lambda x: x.position_order, label="dense, q"),
    _dense("dense_velocity_order", lambda x: x.velocity_order, label="dense, q′"),
    DENSE,
    facts.Row("in the trees", SAID, lambda _: OF_NYSTROM_TREES, DETAIL),
    _trees_that_fail("order", "position-order", "velocity-order", "embedded-order"),
)
NYSTROM = _form(lambda o: o.nystrom, "nystrom", _nystrom_words, OF_NYSTROM)


OF_NPRK_TREES = "1 and 2 are the arguments of F that branches are in"


OF_NPRK: facts.Rows[NprkAnalysis] = (
    _order("order", HEADLINE),
    _order("embedded_order"),
    ERROR_ESTIMATE,
    facts.Row("in the trees", SAID, lambda _: OF_NPRK_TREES),
    _trees_that_fail("order", "embedded-order"),
)
NPRK = _form(
    lambda o: o.nprk,
    "nprk",
    lambda a, _: (
        f"nonlinearly partitioned, {counted(a.tableau.spaces[0].stages, 'pair')} of stages"
    ),
    OF_NPRK,
)


OF_DERIVATIVES: facts.Rows[DerivativesAnalysis] = (
    EXACT_TO,
    _order("order", HEADLINE),
    _order("nonautonomous_order", label="order for f(t, y)"),
    _order("embedded_order"),
    _order("embedded_nonautonomous_order", DETAIL, "embedded for f(t, y)"),
    ERROR_ESTIMATE,
    *STABILITY,
    _trees_that_fail("order", "embedded-order"),
)
DERIVATIVES = _form(
    lambda o: o.derivatives, "derivatives", lambda a, _: words_of(a.tableau), OF_DERIVATIVES
)


def _multirate_words(a: InfinitesimalAnalysis, _: Plain) -> str:
    slow = a.tableau.size - 1
    text = f"multirate, {counted(a.tableau.spaces[-1].stages, 'slow stage')}"
    return f"{text}{f' of {slow} slow parts' if slow > 1 else ''}, fast part exact"


OF_MULTIRATE: facts.Rows[InfinitesimalAnalysis] = (
    EXACT_TO,
    _order("order", HEADLINE),
    _order("slow_order", label="slow method"),
    _order("nonautonomous_order", label="order for f(t, y)"),
    _order("embedded_order"),
    _order("embedded_nonautonomous_order", DETAIL, "embedded for f(t, y)"),
    ERROR_ESTIMATE,
    _trees_that_fail("order", "embedded-order"),
)
MULTIRATE = _form(lambda o: o.infinitesimal, "multirate", _multirate_words, OF_MULTIRATE)
TOLD_BY: dict[str, tuple[facts.Section[Outcome], facts.Rows[Never]]] = {
    "RosenbrockAnalysis": (ROSENBROCK, OF_ROSENBROCK),
    "NystromAnalysis": (NYSTROM, OF_NYSTROM),
    "NprkAnalysis": (NPRK, OF_NPRK),
    "DerivativesAnalysis": (DERIVATIVES, OF_DERIVATIVES),
    "InfinitesimalAnalysis": (MULTIRATE, OF_MULTIRATE),
}
