"""``gark check`` and ``gark stability`` of files with free parameters."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, TypeVar, cast

from garkcli.check.every_facts import FamilyFact, exceptions, fact_reason, zeros_reason
from garkcli.check.every_facts import told as told_value
from garkcli.check.every_family import EveryFamily
from garkcli.check.every_properties import find_property
from garkcli.design.stability_functions import Coefficients, FamilyFunction, family_functions
from garkcli.exact.display import to_text
from garkcli.exact.polynomial_text import power_text, sum_text
from garkcli.frozen import Frozen, replace
from garkcli.page import schema as S  # noqa: N812 -- its names are those of kinds too
from garkcli.page.exactly import ALGEBRAIC, root_data, sum_latex
from garkcli.properties.registry import KEYS
from garkcli.reason import Formula, Reason, joined
from garkcli.report import check as c
from garkcli.report.design_values import conditions
from garkcli.tell import facts, kinds
from garkcli.tell.dialect import Plain, Status
from garkcli.tell.parts import SAID, part, parts, rows_of
from garkcli.tell.report import Report

if TYPE_CHECKING:
    from garkcli.check.every_orders import EveryOrder
    from garkcli.check.every_value import EveryValue
    from garkcli.check.outcome import Outcome
    from garkcli.order.certificate import Witness

HEADLINE, USUAL, DETAIL, DATA = facts.Level
V = TypeVar("V")
MOST = 8
VALUE: S.Schema = {
    "type": ["boolean", "integer", "string", "array", "null"],
    "description": "The answer; null where there is none.",
}
FACT: S.Schema = kinds.record(
    decided=S.FLAG,
    every_value=S.FLAG,
    value=VALUE,
    special=S.array(kinds.record(at=ALGEBRAIC, value=VALUE)),
    elsewhere=S.array(kinds.record(zero=S.TEXT, value=VALUE)),
    zeros=S.array(S.TEXT),
    open=S.array(S.TEXT),
    unknown=S.array(ALGEBRAIC),
    where=S.array(kinds.INTERVAL.schema),
    why=S.TEXT,
)
FACT["required"] = FACT["required"][:-2]


def fact_data(f: FamilyFact, inner: facts.Kind[V], d: Plain) -> dict[str, object]:
    """A value for almost all parameters, with exceptions and open cases."""

    def data(x: V | None) -> object:
        return None if x is None or inner.what is None else inner.what.data(x, d)

    found: dict[str, object] = {
        "decided": not f.is_undecided or f.differs,
        "every_value": f.is_everywhere,
        "value": data(f.value),
        "special": [{"at": root_data(at), "value": data(x)} for at, x in f.special],
        "elsewhere": [{"zero": p, "value": data(x)} for p, x in f.elsewhere],
        "zeros": list(f.zeros),
        "open": list(f.open),
        "unknown": [root_data(x) for x in f.unknown],
    }
    if f.where is not None:
        found["where"] = [kinds.INTERVAL.data(x, d) for x in f.where]
    return {**found, "why": str(f.why)} if f.why else found


def lifted(inner: facts.Kind[V]) -> facts.Kind[FamilyFact]:
    def words(f: FamilyFact, d: Plain) -> str:
        plain, of_value = (
            Plain(colours=d.colours),
            cast("Callable[[object, Plain], str]", inner.words),
        )
        return d.reason(fact_reason(f, d.parameter, lambda x: of_value(x, plain)))

    return facts.Kind(facts.Json(FACT, lambda f, d: fact_data(f, inner, d)), facts.Words(words))


ANY: facts.Kind[object] = facts.Kind(
    facts.Json(VALUE), facts.Words(lambda x, d: d.reason(Reason("{}", told_value(x))))
)


WITNESS: facts.Section[Witness] = facts.Section(
    *kinds.WITNESS.rows[:2], facts.Row("residual", kinds.TEXT, lambda x: str(x.residual))
)
ORDER_PARTS: facts.Section[EveryOrder] = facts.Section(
    facts.Row("order", kinds.COUNT, lambda x: x.order),
    facts.maybe("witness", part(WITNESS), lambda x: x.witness),
    facts.Row("fact", lifted(kinds.COUNT), lambda x: x.fact),
    facts.maybe("dimension", kinds.INTEGER, lambda x: x.dimension),
    facts.Row("weights", kinds.TEXTS, lambda o: list(o.poles)),
)


def _higher(o: EveryOrder, name: str) -> Reason:
    higher = o.order + 1
    if o.dimension is not None and o.dimension < 0:
        return Reason(f"; no value has order {higher}")
    special = tuple(x for x in o.fact.special if x[1] is not None)
    if special:
        return exceptions(FamilyFact(o.order, special), name, lambda x: f"order {x}")
    if o.fact.zeros:
        return Reason(f"; order {higher} or more where {{}}", zeros_reason(o.fact.zeros))
    return Reason(f"; no real value of the file has order {higher}")


def _order_words(o: EveryOrder, _: facts.Answer[EveryOrder], d: Plain) -> str:
    """``2; order 3 is missed at [[]] by …; order 3 where …``."""
    if o.witness is None:
        return f"{d.known(str(o.order), Status(at_least=True))}; the search stopped here"
    text = f"{o.order}; {d.failure(o.witness)}{d.reason(_higher(o, d.parameter))}"
    if o.poles:
        zero = joined(" or ", [Reason("{} = 0", Formula(p)) for p in o.poles[:MOST]])
        text += f"; none where a weight is zero: {d.reason(zero)}"
    return text


EVERY_ORDER: facts.Kind[EveryOrder] = facts.Kind(
    ORDER_PARTS, facts.Words(lambda o, _: f"{o.order} for every value", whole=_order_words)
)
BLOCK_LISTS: facts.Kind[Sequence[tuple[int, int]]] = facts.Kind(
    kinds.BLOCKS.what,
    facts.Words(lambda x, d: f"no: {d.few([d.block('A', edge) for edge in x])}" if x else "yes"),
)


def of_blocks(name: str, kind: facts.Kind[kinds.BlockTable]) -> facts.Row[EveryValue]:
    def get(e: EveryValue) -> FamilyFact:
        rows = (lambda x: [x]) if name == "B" else (lambda x: x)
        return e.simplifying(name).of(lambda x: kinds.BlockTable(rows(x), e.limit))

    return facts.Row(name, lifted(kind), get)


def of_several(key: str, get: Callable[[EveryValue], EveryOrder | None]) -> facts.Row[EveryValue]:
    """An order of the conjugate or the pair, or why there is none; a detail of one colour."""

    def answer(e: EveryValue) -> facts.Answer[EveryOrder]:
        answer = facts.Answer(get(e), level=None if e.tableau.size > 1 else DETAIL)
        return replace(answer, reason=c.no_order(answer, e.obstacle))

    return facts.maybe(key, EVERY_ORDER, answer)


RESTRICTIONS: facts.Kind[EveryFamily] = facts.Kind(
    facts.Json(S.array(S.TEXT), lambda f, _: list(map(str, conditions(f.family, f.poles))))
)
TOLD_ORDER: facts.Kind[EveryOrder] = facts.Kind(None, EVERY_ORDER.shown)
JUDGED_LATER = "judged for values of the parameters: --set NAME=1/2"
FAMILY: facts.Rows[EveryValue] = [
    facts.Row("every_value", kinds.TRUE, lambda _: True, DATA),
    facts.Row("unknowns", kinds.TEXTS, lambda e: list(e.parameters), DATA),
    facts.Row("restrictions", RESTRICTIONS, lambda e: e.family, DATA),
    facts.Row("colours", kinds.TEXTS, lambda e: [x.name for x in e.tableau.colours], DATA),
    facts.Row("order", EVERY_ORDER, lambda x: x.order, HEADLINE),
    of_several("conjugate_order", lambda e: e.conjugate_order),
    of_several("pair_order", lambda e: e.pair_order),
    facts.Row(
        "nonautonomous_order",
        TOLD_ORDER,
        lambda e: None if e.is_consistent else e.nonautonomous_order,
    ),
    facts.maybe("embedded_order", EVERY_ORDER, lambda x: x.embedded_order),
    facts.Row(
        "embedded_nonautonomous_order",
        TOLD_ORDER,
        lambda e: None if e.is_consistent else e.embedded_nonautonomous_order,
    ),
    facts.Row(
        "dense",
        SAID,
        lambda e: JUDGED_LATER if e.file.further.dense else None,
        label="dense output",
    ),
    of_blocks("B", kinds.ROW_OF_COUNTS),
    of_blocks("C", kinds.TABLE),
    of_blocks("D", kinds.TABLE),
    facts.Row("bound", lifted(kinds.COUNT), lambda e: e.simplifying("bound"), DETAIL),
    facts.Row("sharp_bound", lifted(kinds.COUNT), lambda e: e.simplifying("sharp-bound"), DETAIL),
    facts.Row(
        "inconsistent_blocks", lifted(BLOCK_LISTS), lambda x: x.inconsistent, label="consistent"
    ),
    facts.Row("symplectic", lifted(kinds.TRUTH), lambda x: x.symplectic),
    facts.Row(
        "holding", facts.Kind(None, kinds.TEXTS.shown), lambda x: x.holding, label="properties"
    ),
]


def verdicts(o: Outcome) -> dict[str, FamilyFact] | None:
    if not o.wants_properties or o.every is None:
        return None
    return {key: o.every.verdict(key) for key in KEYS}


VERDICTS: facts.Kind[dict[str, FamilyFact]] = facts.Kind(
    facts.Json(
        {"type": "object", "properties": dict.fromkeys(KEYS, FACT), "additionalProperties": False},
        lambda found, d: {key: fact_data(x, ANY, d) for key, x in found.items()},
    ),
    facts.Labels(
        lambda found, d: [
            (key, d.reason(fact_reason(x, d.parameter, told_value))) for key, x in found.items()
        ]
    ),
)
EVERY: facts.Section[Outcome] = facts.Section(
    kinds.FILE_AND_NAME,
    c.OK,
    facts.via(lambda o: o.every, FAMILY),
    c.LEFT_BEHIND,
    c.CLAIMS,
    facts.optional("every_property", VERDICTS, verdicts),
    title=c.title,
    columns=c.COLUMNS,
)


STABILITIES = ("a-stable", "l-stable", "p-stable", "i-stable", "algebraically-stable")
LIMIT = 60


class EveryStability(Frozen):
    """R of all colours together, and of each."""

    file: str
    name: str
    family: EveryFamily
    functions: tuple[FamilyFunction, ...]

    @property
    def facts(self) -> dict[str, FamilyFact]:
        return {key: find_property(self.family, key, LIMIT) for key in STABILITIES}


def every_stability(file: str, name: str, family: EveryFamily) -> EveryStability:
    return EveryStability(file, name, family, family_functions(family.tableau, family.ring))


def _text(coefficients: Coefficients, variable: str) -> str:
    """Lowest power first; sums have brackets."""
    return sum_text((a, power_text(variable, k)) for k, a in enumerate(coefficients))


def _latex(coefficients: Coefficients, variable: str) -> str:
    return sum_latex((a, power_text(variable, k, f"{{{k}}}")) for k, a in enumerate(coefficients))


def _sum(variable: str) -> facts.Kind[Coefficients]:
    return facts.Kind(
        facts.Json(S.array(S.EXACT), lambda xs, _: [to_text(x) for x in xs]),
        facts.Words(lambda xs, d: d.formula(_latex(xs, variable), _text(xs, variable))),
    )


FUNCTION: facts.Section[FamilyFunction] = facts.Section(
    facts.Row("name", kinds.TEXT, lambda x: x.name, DATA),
    facts.Row("numerator", _sum("z"), lambda x: x.numerator),
    facts.Row("denominator", _sum("z"), lambda x: x.denominator),
    facts.maybe("R_infinity", kinds.EXACT, lambda x: x.at_infinity),
    facts.Row("e_polynomial", _sum("x"), lambda x: x.e_polynomial, DETAIL),
)


def _variable(preferred: str, parameters: Sequence[str]) -> str:
    """A letter that is no parameter."""
    others = (x for x in f"{preferred}wuvsxyzabcdefghijklmnopqrt" if x not in parameters)
    return next(others, f"{preferred}_")


def _function_rows(found: EveryStability, d: Plain) -> list[tuple[str, str]]:
    names = found.family.family.parameters
    z = _variable("z", names)
    x = _variable("x", [*names, z])
    rows = []
    for f in found.functions:
        which = "" if f.name == "all" else f" of colour {d.prose(f.name)}"
        over, under = (_text(p, z) for p in (f.numerator, f.denominator))
        up, down = (_latex(p, z) for p in (f.numerator, f.denominator))
        latex = up if down == "1" else rf"\frac{{{up}}}{{{down}}}"
        top, bottom = (f"({p})" if " " in p else p for p in (over, under))
        text = over if under == "1" else f"{top} / {bottom}"
        rows.append((f"R({z}){which}", d.formula(latex, text)))
        limit = f.at_infinity
        rows.append(
            (f"{d.prose('R(∞)')}{which}", "unbounded" if limit is None else d.number(limit))
        )
        rows.append((f"E({x}){which}", _sum(x).words(f.e_polynomial, d)))
    return rows


def _stability_rows(x: EveryStability, d: Plain) -> list[tuple[str, str]]:
    """Returns each kind of stability with its values, or the way to decide it."""
    rows = []
    for key, fact in x.facts.items():
        text = fact_reason(fact, d.parameter, told_value)
        if fact.is_undecided and not fact.differs:
            text = Reason(f"--set all but one, then gark design --{key}")
            if x.family.has_one or key == "algebraically-stable":
                text = Reason(f"not decided for every value: --set {d.parameter}=1/2")
        rows.append((key, d.reason(text)))
    return [*rows, ("intervals, SSP", d.prose(f"numbers: --set {d.parameter}=1/2"))]


def _stable(key: str) -> facts.Row[EveryStability]:
    return facts.Row(key.replace("-", "_"), lifted(ANY), lambda x: x.facts[key])


STABLE = facts.Section(map(_stable, STABILITIES))
EVERY_STABILITY: facts.Section[EveryStability] = facts.Section(
    kinds.FILE_AND_NAME,
    facts.Row("unknowns", kinds.TEXTS, lambda x: list(x.family.family.parameters), DATA),
    facts.Row("restrictions", RESTRICTIONS, lambda x: x.family, DATA),
    facts.Row("functions", parts(FUNCTION), lambda x: x.functions, DATA),
    facts.itself("stability", part(STABLE), DATA),
    facts.itself("functions_in_words", rows_of(_function_rows)),
    facts.itself("stability_in_words", rows_of(_stability_rows)),
    title=lambda x, d: f"{d.prose(x.file)}: {c.every_value(x.family, d)}",
)
STABILITY: Report[EveryStability] = Report.only(
    "gark/stability-every/1",
    "report of gark stability for every value of parameters",
    EVERY_STABILITY,
    lambda x: {
        "parameter": x.family.family.parameters[0],
        "colours": [colour.name for colour in x.family.tableau.colours],
    },
)
