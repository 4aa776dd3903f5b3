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
from garkcli.tell.dialect import Plain, Status
from garkcli.tell.facts import (
    Answer,
    FieldBeside,
    Json,
    Kind,
    Level,
    Row,
    Rows,
    Section,
    Words,
    maybe,
    optional,
)

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


def constant(value: object) -> Kind[object]:
    """A field with the same value in every report; for programs."""
    return Kind(Json({"const": value}))


def choice(*values: str | None) -> Kind[str]:
    """One of a few words."""
    return Kind(Json({"enum": [*values]}), TEXT.shown)


def _truth_phrase(label: str, value: bool, answer: Answer[bool], d: Plain) -> str:
    text = d.known(label if value else f"not {label}", answer.status)
    return f"{text}: {d.reason(answer.reason)}" if answer.reason else text


def truth_words(value: bool, d: Plain) -> str:
    """``yes`` or ``no``."""
    return d.good("yes") if value else d.bad("no")


def counted(schema: Schema) -> Kind[int]:
    """A number that is shown without change."""
    return Kind(Json(schema), Words(lambda x, _: str(x)))


TRUTH: Kind[bool] = Kind(Json(S.FLAG), Words(truth_words, phrase=_truth_phrase))
TRUE: Kind[bool] = Kind(Json(S.TRUE))
COUNT = counted(S.COUNT)
INTEGER = counted(S.INTEGER)
POSITION = counted(S.POSITION)
INDEX: Kind[int] = Kind(Json(S.POSITION, lambda x, _: x + 1), Words(lambda x, _: str(x + 1)))
"""Counted from 0 by the program, and from 1 by people."""
TEXT: Kind[str] = Kind(Json(S.TEXT), Words(lambda x, d: d.prose(x)))
TEXTS: Kind[Sequence[str]] = Kind(
    Json(array(S.TEXT), lambda x, _: list(x), csv=lambda x: csv_cell("; ".join(x))),
    Words(lambda x, d: ", ".join(map(d.prose, x))),
)
FLOAT: Kind[float] = Kind(Json(S.SIZE), Words(lambda x, _: f"{x:.6g}"))
EXACT: Kind[Number] = Kind(Json(S.EXACT, lambda x, _: to_text(x)), Words(lambda x, d: d.number(x)))
GAMMA: Kind[Number] = Kind(EXACT.what, Words(lambda x, d: d.diagonal(x)))
EXACTS: Kind[Sequence[Number]] = Kind(
    Json(array(S.EXACT), lambda xs, _: [to_text(x) for x in xs]),
    Words(lambda xs, d: ", ".join(map(d.short, xs))),
)
TOLERANCE: Kind[fmpq] = Kind(Json(S.TEXT, lambda x, _: decimal(x)), Words(lambda x, _: decimal(x)))
TREE: Kind[Tree] = Kind(Json(S.TEXT, lambda x, _: format_tree(x)), Words(lambda x, d: d.tree(x)))


def truth(
    value: bool | None, why: Reason | str = "", open_because: Reason | str = ""
) -> Answer[bool]:
    """A truth with the reason against it, or, of None, the reason why it is open."""
    if value is None:
        return Answer(None, Status(open=as_reason(open_because or "it is open")))
    return Answer(value, reason=NO_REASON if value else as_reason(why))


def as_reason(text: Reason | str) -> Reason:
    return Reason(text) if isinstance(text, str) else text


class OfFile(Protocol):
    """A result of a file."""

    @property
    def file(self) -> str: ...

    @property
    def name(self) -> str: ...


def _name(x: OfFile) -> Answer[str]:
    """The name, which reports show if it is not that of the file."""
    return Answer(x.name, level=Level.DETAIL if x.name != x.file else Level.DATA)


FILE_AND_NAME: Rows[OfFile] = (
    Row("file", TEXT, lambda x: x.file, Level.DATA),
    Row("name", TEXT, _name, Level.DETAIL),
)
"""The file of a result, and the name of its method."""


def numeral_text(x: Number, d: Plain) -> str:
    """A number exactly, or in as many decimals as are requested."""
    return to_text(x) if d.places is None else to_decimal(x, d.places)


def _numeral(x: Number, d: Plain) -> str:
    text = numeral_text(x, d)
    return d.number(x) if d.places is None else d.formula(decimal_latex(text), text)


NUMERAL: Kind[Number] = Kind(Json(S.NUMERAL, numeral_text), Words(_numeral))

BLOCK: Schema = {**array(S.POSITION), "minItems": 1, "maxItems": 2}
"""The colours of a block of A, or of a row of weights."""


def numbers_from_one(places: Sequence[Sequence[int]]) -> list[list[int]]:
    return [[x + 1 for x in place] for place in places]


BLOCKS: Kind[Sequence[Sequence[int]]] = Kind(
    Json(array(BLOCK), lambda x, _: numbers_from_one(x)),
    Words(lambda x, d: d.few([d.block("A", place) for place in x])),
)


class BlockTable(Frozen):
    """The number of conditions that hold, for each block that exists, up to a limit."""

    rows: Sequence[Sequence[int | None]]
    limit: int


ROW_OF_COUNTS: Kind[BlockTable] = Kind(
    Json(array(S.COUNT), lambda x, _: list(x.rows[0])), Words(lambda x, d: d.table(x.rows, x.limit))
)
TABLE: Kind[BlockTable] = Kind(
    Json(array(array(nullable(S.INTEGER))), lambda x, _: [list(row) for row in x.rows]),
    ROW_OF_COUNTS.shown,
)


WITNESS: Section[Witness] = Section(
    Row("order", POSITION, lambda x: x.tree.order),
    Row("tree", TREE, lambda x: x.tree),
    Row("value", EXACT, lambda x: x.value),
    Row("required", EXACT, lambda x: x.required),
    Row("residual", EXACT, lambda x: x.residual),
    optional("joint", TRUTH, lambda x: x.is_joint or None, Level.DATA),
)


def order_answer(found: AnyOrder | None) -> Answer[AnyOrder]:
    """An order, exact or rounded, as a value with its status."""
    if found is None:
        return Answer(None)
    within = getattr(found, "tolerance", None)
    undecided = getattr(found, "undecided", "")
    return Answer(found, Status(within, found.is_lower_bound, Reason(undecided)))


def _largest_residual(found: AnyOrder) -> arb | None:
    return getattr(found, "largest_residual", None)


def _order_words(found: AnyOrder, answer: Answer[AnyOrder], d: Plain) -> str:
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


def _witness(answer: Answer[AnyOrder], d: Plain) -> object:
    witness = None if answer.value is None else answer.value.witness
    return None if witness is None else WITNESS.data(witness, d)


def _within(answer: Answer[AnyOrder], _: Plain) -> str | None:
    return None if answer.status.within is None else decimal(answer.status.within)


def _largest(answer: Answer[AnyOrder], _: Plain) -> float | None:
    largest = None if answer.value is None else _largest_residual(answer.value)
    return None if largest is None else float(largest.upper())


ORDER: Kind[AnyOrder] = Kind(
    Json(
        S.COUNT,
        lambda found, _: found.order,
        beside=(
            FieldBeside("*witness", nullable(WITNESS.schema), _witness, is_optional=False),
            FieldBeside("*order_is_lower_bound", S.TRUE, lambda a, _: a.status.at_least or None),
            FieldBeside("*order_largest_residual", S.SIZE, _largest),
            FieldBeside("*order_tolerance", S.TEXT, _within),
            FieldBeside("*order_undecided", S.TRUE, lambda a, _: bool(a.status.open) or None),
        ),
    ),
    Words(lambda found, _: str(found.order), _order_words),
)


Quotient: TypeAlias = "StabilityFunction | Ratio"


def ratio(variable: str) -> Kind[Quotient]:
    def data(found: Quotient, _: Plain) -> dict[str, str]:
        over, under = integral([found.numerator, found.denominator])
        return {
            "numerator": polynomial_text(over, variable),
            "denominator": polynomial_text(under, variable),
        }

    return Kind(
        Json(record(numerator=S.TEXT, denominator=S.TEXT), data),
        Words(lambda x, d: d.quotient(x.numerator, x.denominator, variable)),
    )


def term(variable: str, power: int) -> Kind[Number]:
    def words(x: Number, d: Plain) -> str:
        return d.polynomial(Polynomial([fmpq(0)] * power + [x]), variable)

    return Kind(None, Words(words))


def polynomial(variable: str) -> Kind[Polynomial]:
    """With whole coefficients; in decimals if these are long."""

    def words(p: Polynomial, d: Plain) -> str:
        (whole,) = integral([p])
        return d.polynomial(p if d.is_brief and has_long_coefficients(whole) else whole, variable)

    return Kind(
        Json(S.TEXT, lambda p, _: polynomial_text(integral([p])[0], variable)), Words(words)
    )


EXPRESSION: Kind[str] = Kind(Json(S.TEXT), Words(lambda x, d: d.expression(x)))
"""A polynomial in the unknowns of a file."""
ROOTS: Kind[Sequence[RealRoot]] = Kind(
    Json(array(ALGEBRAIC), lambda xs, d: [root_data(x, d.digits) for x in xs]),
    Words(lambda xs, d: ", ".join(map(d.root, xs))),
)


def radius_data(x: SspCoefficient, d: Plain) -> object:
    return "infinity" if x.value is None else root_data(x.value, d.digits)


RADIUS: Kind[SspCoefficient] = Kind(
    Json(one_of(S.TEXT, ROOT_OF), radius_data),
    Words(lambda x, d: d.infinity if x.value is None else d.root(x.value)),
)
"""The reach of something, which may be without end."""

END: Kind[RealRoot] = Kind(Json(ALGEBRAIC, lambda x, d: root_data(x, d.digits)))
INTERVAL: Section[Interval] = Section(
    maybe("from", END, lambda x: x.start),
    maybe("to", END, lambda x: x.end),
    Row("from_included", TRUTH, lambda x: x.has_start),
    Row("to_included", TRUTH, lambda x: x.has_end),
)
_PLACES = fmpq(10) ** 20
BOUNDS: Section[Bounds] = Section(
    Row(
        "at_least",
        TEXT,
        lambda x: (
            "infinity"
            if x.low is None
            else plain_decimal(fmpq((x.low * _PLACES).floor()) / _PLACES)
        ),
    ),
    maybe(
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
DERIVATION: Kind[str] = Kind(Json(S.DERIVATION))


def claim_word(holds: bool | None, d: Plain) -> str:
    """``claim holds``, ``CLAIM FAILS`` or, of None, ``claim undecided``."""
    if holds:
        return d.good("claim holds")
    return d.note("claim undecided") if holds is None else d.bad("CLAIM FAILS")
