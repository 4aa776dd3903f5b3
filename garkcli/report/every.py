"""``gark check`` and ``gark stability`` of files with free parameters: the kinds of values, lifted
to answers with exceptions.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any

from garkcli.check.every_facts import Fact, exceptions, fact_reason, zeros_reason
from garkcli.check.every_facts import told as told_value
from garkcli.check.every_family import EveryFamily
from garkcli.check.every_properties import find_property
from garkcli.design.stability_functions import FamilyFunction, family_functions
from garkcli.exact.display import to_text
from garkcli.exact.polynomial_text import power_text, sum_text
from garkcli.frozen import Frozen, replace
from garkcli.page import schema as S  # noqa: N812 -- its names are those of kinds too
from garkcli.page.exactly import ALGEBRAIC, root_data, sum_latex
from garkcli.properties.registry import KEYS
from garkcli.reason import NO_REASON, Formula, Reason, joined
from garkcli.report import check as c
from garkcli.report.design_values import conditions
from garkcli.tell import kinds
from garkcli.tell.facts import Answer, Kind, Level, Row, Section, Status, maybe, optional
from garkcli.tell.parts import part, parts, rows_of
from garkcli.tell.report import Report

if TYPE_CHECKING:
    from garkcli.check.every_orders import EveryOrder
    from garkcli.tell.dialect import Plain

HEADLINE, USUAL, DETAIL, DATA = Level
MOST = 8
"""Most polynomials that are named."""
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
    where=S.array(kinds.INTERVAL),
    why=S.TEXT,
)
FACT["required"] = FACT["required"][:-2]


def fact_data(f: Fact, inner: Kind, d: Plain) -> dict[str, Any]:
    """An answer for every value, its exceptions, what is open."""

    def data(x: Any) -> Any:
        return None if x is None else inner.data(x, d)

    found = {
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
        found["where"] = [kinds.interval_data(x, d) for x in f.where]
    return {**found, "why": str(f.why)} if f.why else found


def lifted(inner: Kind) -> Kind:
    """The same kind of value for a family: only the exceptions are new."""

    def words(f: Fact, d: Plain) -> str:
        from garkcli.tell.dialect import Plain

        assert inner.words is not None
        inner_words, plain = inner.words, Plain(colours=d.colours)
        return d.reason(fact_reason(f, d.parameter, lambda x: inner_words(x, plain)))

    return Kind(FACT, lambda f, d: fact_data(f, inner, d), words)


ANY = Kind(VALUE, words=lambda x, d: d.reason(Reason("{}", told_value(x))))
WITNESS = kinds.record(order=S.POSITION, tree=S.TEXT, residual=S.TEXT)


def _witness(o: EveryOrder, _: Any = None) -> dict[str, Any] | None:
    if o.witness is None:
        return None
    data = kinds.witness_data(o.witness)
    return {key: data[key] for key in WITNESS["properties"]}


ORDER_PARTS = Section(
    Row("order", kinds.COUNT),
    maybe("witness", Kind(WITNESS), _witness),
    Row("fact", lifted(kinds.COUNT)),
    maybe("dimension", Kind(S.INTEGER)),
    Row("weights", kinds.TEXTS, lambda o: list(o.poles)),
)


def _higher(o: EveryOrder, name: str) -> Reason:
    """For which values the order is higher."""
    higher = o.order + 1
    if o.dimension is not None and o.dimension < 0:
        return Reason(f"; no value has order {higher}")
    special = tuple(x for x in o.fact.special if x[1] is not None)
    if special:
        return exceptions(Fact(o.order, special), name, lambda x: f"order {x}")
    if o.fact.zeros:
        return Reason(f"; order {higher} or more where {{}}", zeros_reason(o.fact.zeros))
    return Reason(f"; no real value of the file has order {higher}")


def _order_words(answer: Answer, d: Plain) -> str:
    """``2; order 3 is missed at [[]] by …; order 3 where …``."""
    o = answer.value
    if o.witness is None:
        return f"{d.known(str(o.order), Status(at_least=True))}: no further was looked"
    text = f"{o.order}; {d.failure(o.witness)}{d.reason(_higher(o, d.parameter))}"
    if o.poles:
        zero = joined(" or ", [Reason("{} = 0", Formula(p)) for p in o.poles[:MOST]])
        text += f"; none where a weight is zero: {d.reason(zero)}"
    return text


EVERY_ORDER = Kind(
    ORDER_PARTS.schema,
    lambda o, d: ORDER_PARTS.data(o, d),
    answer_words=_order_words,
    cell=lambda o, _: f"{o.order} for every value",
)
BLOCK_LISTS = Kind(
    kinds.BLOCKS.schema,
    lambda x, _: kinds.numbers_from_one(x),
    lambda x, d: f"no: {d.few([d.block('A', edge) for edge in x])}" if x else "yes",
)


def of(name: str) -> Callable[[Any], Fact]:
    """B, C or D as a table, or a bound by them."""

    def get(e: Any) -> Fact:
        fact: Fact = e.simplifying(name)
        return fact.of(lambda x: kinds.Table(x, e.limit)) if name in "BCD" else fact

    return get


def of_several(key: str) -> Row:
    """An order of the conjugate or the pair, or why there is none; a detail of one colour."""

    def get(e: Any) -> Answer:
        value = getattr(e, key)
        reason = NO_REASON if value is not None else e.obstacle
        return Answer(value, reason=reason, level=None if e.tableau.size > 1 else DETAIL)

    return maybe(key, EVERY_ORDER, get)


def with_time(key: str) -> Row:
    """The order on problems with time, where the nodes are not the row sums."""
    return Row(key, TOLD_ORDER, lambda e: None if e.is_consistent else getattr(e, key))


RESTRICTIONS = Kind(S.array(S.TEXT), lambda f, _: list(map(str, conditions(f.family, f.poles))))
TOLD_ORDER = replace(EVERY_ORDER, is_data=False)
FAMILY = [
    Row("every_value", kinds.TRUE, lambda _: True, DATA),
    Row("unknowns", kinds.TEXTS, lambda e: list(e.parameters), DATA),
    Row("restrictions", RESTRICTIONS, lambda e: e.family, DATA),
    Row("colours", kinds.TEXTS, lambda e: [x.name for x in e.tableau.colours], DATA),
    Row("order", EVERY_ORDER, level=HEADLINE),
    of_several("conjugate_order"),
    of_several("pair_order"),
    with_time("nonautonomous_order"),
    maybe("embedded_order", EVERY_ORDER),
    with_time("embedded_nonautonomous_order"),
    Row(
        "dense",
        replace(kinds.TEXT, is_data=False),
        lambda e: e.file.further.dense and "judged for values of the parameters: --set NAME=1/2",
        label="dense output",
    ),
    Row("B", lifted(kinds.ROW_OF_COUNTS), of("B")),
    Row("C", lifted(kinds.TABLE), of("C")),
    Row("D", lifted(kinds.TABLE), of("D")),
    Row("bound", lifted(kinds.COUNT), of("bound"), DETAIL),
    Row("sharp_bound", lifted(kinds.COUNT), of("sharp-bound"), DETAIL),
    Row("inconsistent_blocks", lifted(BLOCK_LISTS), "inconsistent", label="consistent"),
    Row("symplectic", lifted(kinds.TRUTH)),
    Row("holding", replace(kinds.TEXTS, is_data=False), label="properties"),
]


def verdicts(o: Any) -> Any:
    """All properties, where they were requested."""
    return {key: o.every.verdict(key) for key in KEYS} if o.wants_properties else None


VERDICTS = Kind(
    {"type": "object", "properties": dict.fromkeys(KEYS, FACT), "additionalProperties": False},
    lambda found, d: {key: fact_data(x, ANY, d) for key, x in found.items()},
    rows=lambda found, d: [
        (key, d.reason(fact_reason(x, d.parameter, told_value))) for key, x in found.items()
    ],
)
EVERY = Section(
    *kinds.FILE_AND_NAME,
    *c.OK,
    *(row.of(lambda o: o.every) for row in FAMILY),
    c.LEFT_BEHIND,
    *c.CLAIMS,
    optional("every_property", VERDICTS, verdicts),
    title=c.title,
    columns=c.COLUMNS,
)


# stability

STABILITIES = ("a-stable", "l-stable", "p-stable", "i-stable", "algebraically-stable")
"""What is decided, of one parameter."""
LIMIT = 60


class EveryStability(Frozen):
    """What is known of the stability of a family.

    Attributes:
        file: its path.
        name: what people call it.
        family: of methods.
        functions: R for all colours together, and for each.
    """

    file: str
    name: str
    family: EveryFamily
    functions: tuple[FamilyFunction, ...]

    @property
    def facts(self) -> dict[str, Fact]:
        """The kinds of stability."""
        return {key: find_property(self.family, key, LIMIT) for key in STABILITIES}


def every_stability(file: str, name: str, family: EveryFamily) -> EveryStability:
    """The stability of a family."""
    return EveryStability(file, name, family, family_functions(family.tableau, family.ring))


def _text(coefficients: Sequence[Any], variable: str) -> str:
    """A polynomial, lowest power first, its coefficients in brackets where they are sums."""
    return sum_text((a, power_text(variable, k)) for k, a in enumerate(coefficients))


def _latex(coefficients: Sequence[Any], variable: str) -> str:
    return sum_latex((a, power_text(variable, k, f"{{{k}}}")) for k, a in enumerate(coefficients))


def _sum(variable: str) -> Kind:
    return Kind(
        S.array(S.EXACT),
        lambda xs, _: [to_text(x) for x in xs],
        lambda xs, d: d.formula(_latex(xs, variable), _text(xs, variable)),
    )


FUNCTION = Section(
    Row("name", kinds.TEXT, level=DATA),
    Row("numerator", _sum("z")),
    Row("denominator", _sum("z")),
    maybe("R_infinity", kinds.EXACT, "at_infinity"),
    Row("e_polynomial", _sum("x"), level=DETAIL),
)


def _variable(preferred: str, parameters: Sequence[str]) -> str:
    """The letter of a polynomial whose coefficients have parameters: none of these."""
    others = (x for x in f"{preferred}wuvsxyzabcdefghijklmnopqrt" if x not in parameters)
    return next(others, f"{preferred}_")


def _function_rows(found: Any, d: Plain) -> list[tuple[str, str]]:
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
        rows.append((f"E({x}){which}", _sum(x)(f.e_polynomial).words(d)))
    return rows


def _stability_rows(x: Any, d: Plain) -> list[tuple[str, str]]:
    """For which values each kind of stability holds, or what decides it."""
    rows = []
    for key, fact in x.facts.items():
        text = fact_reason(fact, d.parameter, told_value)
        if fact.is_undecided and not fact.differs:
            text = Reason(f"--set all but one, then gark design --{key}")
            if x.family.has_one or key == "algebraically-stable":
                text = Reason(f"not decided for every value: --set {d.parameter}=1/2")
        rows.append((key, d.reason(text)))
    return [*rows, ("intervals, SSP", d.prose(f"numbers: --set {d.parameter}=1/2"))]


STABLE = Section(
    *(
        Row(key.replace("-", "_"), lifted(ANY), lambda x, key=key: x.facts[key])  # type: ignore[misc]
        for key in STABILITIES
    )
)
EVERY_STABILITY = Section(
    *kinds.FILE_AND_NAME,
    Row("unknowns", kinds.TEXTS, lambda x: list(x.family.family.parameters), DATA),
    Row("restrictions", RESTRICTIONS, lambda x: x.family, DATA),
    Row("functions", parts(FUNCTION), level=DATA),
    Row("stability", part(STABLE), ".", DATA),
    Row("functions_in_words", rows_of(_function_rows), "."),
    Row("stability_in_words", rows_of(_stability_rows), "."),
    title=lambda x, d: f"{d.prose(x.file)}: {c.every_value(x.family, d)}",
)
STABILITY: Report[EveryStability] = Report(
    "gark/stability-every/1",
    "report of gark stability for every value of parameters",
    lambda: [EVERY_STABILITY],
    lambda _: EVERY_STABILITY,
    lambda x: {
        "parameter": x.family.family.parameters[0],
        "colours": [colour.name for colour in x.family.tableau.colours],
    },
    key="",
)
