"""The kinds of values that results are made of, each once: its schema, its JSON, its words."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Protocol, TypeAlias

from flint import arb, fmpq

from garkcli.exact.display import decimal, plain_decimal, to_decimal, to_text
from garkcli.exact.polynomial import Polynomial
from garkcli.exact.polynomial_text import has_long_coefficients, integral, polynomial_text
from garkcli.exact.rewriting import decimal_latex
from garkcli.frozen import Frozen
from garkcli.ntrees.notation import format_tree
from garkcli.page import schema as S  # noqa: N812 -- its names are those of kinds too
from garkcli.page.exactly import ALGEBRAIC, ROOT_OF, root_data
from garkcli.page.safety import csv_cell
from garkcli.page.schema import Schema, array, nullable, one_of
from garkcli.reason import NO_REASON, Reason
from garkcli.tell import facts
from garkcli.tell.dialect import Plain, Status

if TYPE_CHECKING:
    from garkcli.exact.cells import Interval
    from garkcli.exact.field import Number
    from garkcli.exact.roots import RealRoot
    from garkcli.ntrees.tree import Tree
    from garkcli.order.certificate import Witness
    from garkcli.order.deciding import AnyOrder
    from garkcli.stability.ball_polynomials import Bounds
    from garkcli.stability.linear import StabilityFunction
    from garkcli.stability.oscillator import Ratio
    from garkcli.stability.ssp import SspCoefficient


def record(**fields: Schema) -> Schema:
    """An object with these fields and no others."""
    return {
        "type": "object",
        "required": [*fields],
        "properties": fields,
        "additionalProperties": False,
    }


def constant(value: object) -> facts.Kind[object]:
    """Returns a kind for programs whose value is the same in every report."""
    return facts.Kind(facts.Json({"const": value}))


def choice(*values: str | None) -> facts.Kind[str]:
    return facts.Kind(facts.Json({"enum": [*values]}), TEXT.shown)


def _truth_phrase(label: str, value: bool, answer: facts.Answer[bool], d: Plain) -> str:
    text = d.known(label if value else f"not {label}", answer.status)
    return f"{text}: {d.reason(answer.reason)}" if answer.reason else text


def truth_words(value: bool, d: Plain) -> str:
    return d.good("yes") if value else d.bad("no")


def counted(schema: Schema) -> facts.Kind[int]:
    return facts.Kind(facts.Json(schema), facts.Words(lambda x, _: str(x)))


TRUTH: facts.Kind[bool] = facts.Kind(
    facts.Json(S.FLAG), facts.Words(truth_words, phrase=_truth_phrase)
)
TRUE: facts.Kind[bool] = facts.Kind(facts.Json(S.TRUE))
COUNT = counted(S.COUNT)
INTEGER = counted(S.INTEGER)
POSITION = counted(S.POSITION)
INDEX: facts.Kind[int] = facts.Kind(
    facts.Json(S.POSITION, lambda x, _: x + 1), facts.Words(lambda x, _: str(x + 1))
)
TEXT: facts.Kind[str] = facts.Kind(facts.Json(S.TEXT), facts.Words(lambda x, d: d.prose(x)))
TEXTS: facts.Kind[Sequence[str]] = facts.Kind(
    facts.Json(array(S.TEXT), lambda x, _: list(x), csv=lambda x: csv_cell("; ".join(x))),
    facts.Words(lambda x, d: ", ".join(map(d.prose, x))),
)
FLOAT: facts.Kind[float] = facts.Kind(facts.Json(S.SIZE), facts.Words(lambda x, _: f"{x:.6g}"))
EXACT: facts.Kind[Number] = facts.Kind(
    facts.Json(S.EXACT, lambda x, _: to_text(x)), facts.Words(lambda x, d: d.number(x))
)
GAMMA: facts.Kind[Number] = facts.Kind(EXACT.what, facts.Words(lambda x, d: d.diagonal(x)))
EXACTS: facts.Kind[Sequence[Number]] = facts.Kind(
    facts.Json(array(S.EXACT), lambda xs, _: [to_text(x) for x in xs]),
    facts.Words(lambda xs, d: ", ".join(map(d.short, xs))),
)
TOLERANCE: facts.Kind[fmpq] = facts.Kind(
    facts.Json(S.TEXT, lambda x, _: decimal(x)), facts.Words(lambda x, _: decimal(x))
)
TREE: facts.Kind[Tree] = facts.Kind(
    facts.Json(S.TEXT, lambda x, _: format_tree(x)), facts.Words(lambda x, d: d.tree(x))
)


def truth(
    value: bool | None, why: Reason | str = "", open_because: Reason | str = ""
) -> facts.Answer[bool]:
    """Returns an answer with the reason against it, or why it is undecided."""
    if value is None:
        return facts.Answer(None, Status(open=as_reason(open_because or "it is open")))
    return facts.Answer(value, reason=NO_REASON if value else as_reason(why))


def as_reason(text: Reason | str) -> Reason:
    return Reason(text) if isinstance(text, str) else text


class OfFile(Protocol):
    @property
    def file(self) -> str: ...

    @property
    def name(self) -> str: ...


def _name(x: OfFile) -> facts.Answer[str]:
    """Reports show a name if it is not that of the file."""
    return facts.Answer(x.name, level=facts.Level.DETAIL if x.name != x.file else facts.Level.DATA)


FILE_AND_NAME: facts.Rows[OfFile] = (
    facts.Row("file", TEXT, lambda x: x.file, facts.Level.DATA),
    facts.Row("name", TEXT, _name, facts.Level.DETAIL),
)


def numeral_text(x: Number, d: Plain) -> str:
    return to_text(x) if d.places is None else to_decimal(x, d.places)


def _numeral(x: Number, d: Plain) -> str:
    text = numeral_text(x, d)
    return d.number(x) if d.places is None else d.formula(decimal_latex(text), text)


NUMERAL: facts.Kind[Number] = facts.Kind(facts.Json(S.NUMERAL, numeral_text), facts.Words(_numeral))

BLOCK: Schema = {**array(S.POSITION), "minItems": 1, "maxItems": 2}


def numbers_from_one(places: Sequence[Sequence[int]]) -> list[list[int]]:
    return [[x + 1 for x in place] for place in places]


BLOCKS: facts.Kind[Sequence[Sequence[int]]] = facts.Kind(
    facts.Json(array(BLOCK), lambda x, _: numbers_from_one(x)),
    facts.Words(lambda x, d: d.few([d.block("A", place) for place in x])),
)


class BlockTable(Frozen):
    """The number of conditions that hold, for each block that exists, up to a limit."""

    rows: Sequence[Sequence[int | None]]
    limit: int


ROW_OF_COUNTS: facts.Kind[BlockTable] = facts.Kind(
    facts.Json(array(S.COUNT), lambda x, _: list(x.rows[0])),
    facts.Words(lambda x, d: d.table(x.rows, x.limit)),
)
TABLE: facts.Kind[BlockTable] = facts.Kind(
    facts.Json(array(array(nullable(S.INTEGER))), lambda x, _: [list(row) for row in x.rows]),
    ROW_OF_COUNTS.shown,
)


WITNESS: facts.Section[Witness] = facts.Section(
    facts.Row("order", POSITION, lambda x: x.tree.order),
    facts.Row("tree", TREE, lambda x: x.tree),
    facts.Row("value", EXACT, lambda x: x.value),
    facts.Row("required", EXACT, lambda x: x.required),
    facts.Row("residual", EXACT, lambda x: x.residual),
    facts.optional("joint", TRUTH, lambda x: x.is_joint or None, facts.Level.DATA),
)


def order_answer(found: AnyOrder | None) -> facts.Answer[AnyOrder]:
    if found is None:
        return facts.Answer(None)
    within = getattr(found, "tolerance", None)
    undecided = getattr(found, "undecided", "")
    return facts.Answer(found, Status(within, found.is_lower_bound, Reason(undecided)))


def _largest_residual(found: AnyOrder) -> arb | None:
    return getattr(found, "largest_residual", None)


def _order_words(found: AnyOrder, answer: facts.Answer[AnyOrder], d: Plain) -> str:
    """``4, proved; order 5 fails at [[[[[]]]]] by -1/120``."""
    d, status = d.naming(answer.names), answer.status
    text = d.known(str(found.order), status)
    if status.within is None and not status.at_least:
        text += ", proved"
    elif (largest := _largest_residual(found)) is not None and not d.is_brief:
        text += f", residuals up to {d.size(largest)}"
    if status.open:
        return f"{text}; order {found.order + 1} is not decided: {d.reason(status.open)}"
    if found.witness is None:
        return f"{text}; the search stopped here"
    is_rounded = status.within is not None
    return f"{text}; {d.failure(found.witness, is_rounded, found.order + 1)}"


def order_cell(found: AnyOrder, d: Plain) -> str:
    return d.known(str(found.order), order_answer(found).status)


def _witness(answer: facts.Answer[AnyOrder], d: Plain) -> object:
    witness = None if answer.value is None else answer.value.witness
    return None if witness is None else WITNESS.data(witness, d)


def _within(answer: facts.Answer[AnyOrder], _: Plain) -> str | None:
    return None if answer.status.within is None else decimal(answer.status.within)


def _largest(answer: facts.Answer[AnyOrder], _: Plain) -> float | None:
    largest = None if answer.value is None else _largest_residual(answer.value)
    return None if largest is None else float(largest.upper())


ORDER: facts.Kind[AnyOrder] = facts.Kind(
    facts.Json(
        S.COUNT,
        lambda found, _: found.order,
        beside=(
            facts.FieldBeside("*witness", nullable(WITNESS.schema), _witness, is_optional=False),
            facts.FieldBeside(
                "*order_is_lower_bound", S.TRUE, lambda a, _: a.status.at_least or None
            ),
            facts.FieldBeside("*order_largest_residual", S.SIZE, _largest),
            facts.FieldBeside("*order_tolerance", S.TEXT, _within),
            facts.FieldBeside("*order_undecided", S.TRUE, lambda a, _: bool(a.status.open) or None),
        ),
    ),
    facts.Words(lambda found, _: str(found.order), _order_words),
)


Quotient: TypeAlias = "StabilityFunction | Ratio"


def ratio(variable: str) -> facts.Kind[Quotient]:
    def data(found: Quotient, _: Plain) -> dict[str, str]:
        over, under = integral([found.numerator, found.denominator])
        return {
            "numerator": polynomial_text(over, variable),
            "denominator": polynomial_text(under, variable),
        }

    return facts.Kind(
        facts.Json(record(numerator=S.TEXT, denominator=S.TEXT), data),
        facts.Words(lambda x, d: d.quotient(x.numerator, x.denominator, variable)),
    )


def term(variable: str, power: int) -> facts.Kind[Number]:
    def words(x: Number, d: Plain) -> str:
        return d.polynomial(Polynomial([fmpq(0)] * power + [x]), variable)

    return facts.Kind(None, facts.Words(words))


def polynomial(variable: str) -> facts.Kind[Polynomial]:
    """Returns a kind of polynomials with whole coefficients, in decimals if these are long."""

    def words(p: Polynomial, d: Plain) -> str:
        (whole,) = integral([p])
        return d.polynomial(p if d.is_brief and has_long_coefficients(whole) else whole, variable)

    return facts.Kind(
        facts.Json(S.TEXT, lambda p, _: polynomial_text(integral([p])[0], variable)),
        facts.Words(words),
    )


EXPRESSION: facts.Kind[str] = facts.Kind(
    facts.Json(S.TEXT), facts.Words(lambda x, d: d.expression(x))
)
ROOTS: facts.Kind[Sequence[RealRoot]] = facts.Kind(
    facts.Json(array(ALGEBRAIC), lambda xs, d: [root_data(x, d.digits) for x in xs]),
    facts.Words(lambda xs, d: ", ".join(map(d.root, xs))),
)


def radius_data(x: SspCoefficient, d: Plain) -> object:
    return "infinity" if x.value is None else root_data(x.value, d.digits)


RADIUS: facts.Kind[SspCoefficient] = facts.Kind(
    facts.Json(one_of(S.TEXT, ROOT_OF), radius_data),
    facts.Words(lambda x, d: d.infinity if x.value is None else d.root(x.value)),
)
"""The reach may be infinite."""

END: facts.Kind[RealRoot] = facts.Kind(facts.Json(ALGEBRAIC, lambda x, d: root_data(x, d.digits)))
INTERVAL: facts.Section[Interval] = facts.Section(
    facts.maybe("from", END, lambda x: x.start),
    facts.maybe("to", END, lambda x: x.end),
    facts.Row("from_included", TRUTH, lambda x: x.has_start),
    facts.Row("to_included", TRUTH, lambda x: x.has_end),
)
_PLACES = fmpq(10) ** 20
BOUNDS: facts.Section[Bounds] = facts.Section(
    facts.Row(
        "at_least",
        TEXT,
        lambda x: (
            "infinity"
            if x.low is None
            else plain_decimal(fmpq((x.low * _PLACES).floor()) / _PLACES)
        ),
    ),
    facts.maybe(
        "at_most",
        TEXT,
        lambda x: (
            None
            if x.low is None or x.high is None
            else plain_decimal(fmpq((x.high * _PLACES).ceil()) / _PLACES)
        ),
    ),
)
"""Rounded outwards."""
DERIVATION: facts.Kind[str] = facts.Kind(facts.Json(S.DERIVATION))


def claim_word(holds: bool | None, d: Plain) -> str:
    """``claim holds``, ``CLAIM FAILS`` or, of None, ``claim undecided``."""
    if holds:
        return d.good("claim holds")
    return d.note("claim undecided") if holds is None else d.bad("CLAIM FAILS")
