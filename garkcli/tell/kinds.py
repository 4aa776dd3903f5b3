"""The kinds of values that results are made of, each once: its schema, its JSON, its words."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any

from flint import fmpq

from garkcli.exact.display import decimal, decimal_latex, plain_decimal, to_decimal, to_text
from garkcli.exact.field import Number
from garkcli.exact.polynomial import Polynomial
from garkcli.exact.polynomial_text import has_long_coefficients, integral, polynomial_text
from garkcli.frozen import Frozen
from garkcli.ntrees.notation import format_tree
from garkcli.page import schema as S  # noqa: N812 -- its names are those of kinds too
from garkcli.page.exactly import ALGEBRAIC, ROOT_OF, root_data
from garkcli.page.plain import csv_cell
from garkcli.page.schema import Schema, array, nullable, one_of
from garkcli.reason import NO_REASON, Reason
from garkcli.tell.facts import Answer, Beside, Kind, Level, Row, Status

if TYPE_CHECKING:
    from garkcli.exact.cells import Interval
    from garkcli.order.certificate import Witness
    from garkcli.order.deciding import AnyOrder
    from garkcli.stability.ball_polynomials import Bounds
    from garkcli.tell.dialect import Plain


def record(**fields: Schema) -> Schema:
    """An object with just these fields."""
    return {
        "type": "object",
        "required": [*fields],
        "properties": fields,
        "additionalProperties": False,
    }


def constant(value: object) -> Kind:
    """What is the same in every report; for programs."""
    return Kind({"const": value})


def choice(*values: str | None) -> Kind:
    """One of a few words."""
    return Kind({"enum": [*values]}, words=lambda x, d: d.prose(x))


def _truth_phrase(label: str, answer: Answer, d: Plain) -> str:
    text = d.known(label if answer.value else f"not {label}", answer.status)
    return f"{text}: {d.reason(answer.reason)}" if answer.reason else text


TRUTH = Kind(S.FLAG, words=lambda x, d: d.good("yes") if x else d.bad("no"), phrase=_truth_phrase)
TRUE = Kind(S.TRUE)
COUNT = Kind(S.COUNT, words=lambda x, d: str(x))
INTEGER = Kind(S.INTEGER, words=lambda x, d: str(x))
POSITION = Kind(S.POSITION, words=lambda x, d: str(x))
INDEX = Kind(S.POSITION, lambda x, _: x + 1, lambda x, _: str(x + 1))
"""What the program counts from 0, and people from 1."""
TEXT = Kind(S.TEXT, words=lambda x, d: d.prose(x))
TEXTS = Kind(
    array(S.TEXT),
    lambda x, _: list(x),
    lambda x, d: ", ".join(map(d.prose, x)),
    csv=lambda x: csv_cell("; ".join(x)),
)
FLOAT = Kind(S.SIZE, words=lambda x, d: f"{x:.6g}")
UPPER = Kind(S.SIZE, lambda ball, _: float(ball.upper()), lambda x, d: d.size(x))
"""The upper end of a ball."""
EXACT = Kind(S.EXACT, lambda x, _: to_text(x), lambda x, d: d.number(x))
EXACTS = Kind(
    array(S.EXACT),
    lambda xs, _: [to_text(x) for x in xs],
    lambda xs, d: ", ".join(map(d.short, xs)),
)
TOLERANCE = Kind(S.TEXT, lambda x, _: decimal(x), lambda x, d: decimal(x))
TREE = Kind(S.TEXT, lambda x, _: format_tree(x), lambda x, d: d.tree(x))


def truth(value: bool | None, why: Reason | str = "", open_because: Reason | str = "") -> Answer:
    """A truth that may be undecided.

    Args:
        value: None for open.
        why: it is not so.
        open_because: it is not decided.
    """
    if value is None:
        return Answer(None, Status(open=as_reason(open_because or "it is open")))
    return Answer(value, reason=NO_REASON if value else as_reason(why))


def as_reason(text: Reason | str) -> Reason:
    """Words as a reason without values."""
    return Reason(text) if isinstance(text, str) else text


def _named(x: Any) -> Answer:
    """The name, told where it says more than the file."""
    return Answer(x.name, level=Level.DETAIL if x.name != x.file else Level.DATA)


FILE_AND_NAME = (Row("file", TEXT, level=Level.DATA), Row("name", TEXT, _named, Level.DETAIL))
"""Where a result is from, and what people call it."""


def numeral_text(x: Number, d: Plain) -> str:
    """A number exactly, or in as many decimals as are requested."""
    return to_text(x) if d.places is None else to_decimal(x, d.places)


def _numeral(x: Number, d: Plain) -> str:
    text = numeral_text(x, d)
    return d.number(x) if d.places is None else d.formula(decimal_latex(text), text)


NUMERAL = Kind(S.NUMERAL, numeral_text, _numeral)

# blocks and places

BLOCK: Schema = {**array(S.POSITION), "minItems": 1, "maxItems": 2}
"""The colours of a block of A, or of a row of weights."""


def numbers_from_one(places: Sequence[Sequence[int]]) -> list[list[int]]:
    """Blocks as people number them."""
    return [[x + 1 for x in place] for place in places]


BLOCKS = Kind(
    array(BLOCK),
    lambda x, _: numbers_from_one(x),
    lambda x, d: d.few([d.block("A", place) for place in x]),
)


class Table(Frozen):
    """How many conditions hold, one number per block; none where there is no block.

    Attributes:
        rows: of blocks, or a single one.
        limit: where the search stopped.
    """

    rows: Sequence[Any]
    limit: int


ROW_OF_COUNTS = Kind(
    array(S.COUNT), lambda x, _: list(x.rows), lambda x, d: d.table([x.rows], x.limit)
)
TABLE = Kind(
    array(array(nullable(S.INTEGER))),
    lambda x, _: [list(row) for row in x.rows],
    lambda x, d: d.table(x.rows, x.limit),
)


# orders

WITNESS: Schema = record(
    order=S.POSITION, tree=S.TEXT, value=S.EXACT, required=S.EXACT, residual=S.EXACT
)


def witness_data(witness: Witness) -> dict[str, Any]:
    """The condition that fails."""
    return {
        "order": witness.tree.order,
        "tree": format_tree(witness.tree),
        "value": to_text(witness.value),
        "required": to_text(witness.required),
        "residual": to_text(witness.residual),
    }


def order_answer(found: AnyOrder | None) -> Answer:
    """An order, exact or rounded, as a value with its status."""
    if found is None:
        return Answer(None)
    within = getattr(found, "tolerance", None)
    undecided = getattr(found, "undecided", "")
    return Answer(found, Status(within, found.is_lower_bound, Reason(undecided)))


def _order_words(answer: Answer, d: Plain) -> str:
    """``4, proved; order 5 fails at [[[[[]]]]] by -1/120``."""
    found, status = answer.value, answer.status
    d = d.naming(answer.names)
    text = d.known(str(found.order), status)
    if status.within is None and not status.at_least:
        text += ", proved"
    elif status.within is not None and not d.is_brief:
        text += f", residuals up to {d.size(found.largest_residual)}"
    if status.open:
        return f"{text}; order {found.order + 1} is not decided: {d.reason(status.open)}"
    if found.witness is None:
        return f"{text}: no further was looked"
    is_rounded = status.within is not None
    return f"{text}; {d.failure(found.witness, is_rounded, found.order + 1)}"


def order_cell(found: AnyOrder, d: Plain) -> str:
    """An order as it is known: ``4 within 1e-9``."""
    return d.known(str(found.order), order_answer(found).status)


def _within(answer: Answer, _: Plain) -> str | None:
    return None if answer.status.within is None else decimal(answer.status.within)


def _largest(answer: Answer, _: Plain) -> float | None:
    return None if answer.status.within is None else float(answer.value.largest_residual.upper())


ORDER = Kind(
    S.COUNT,
    lambda found, _: found.order,
    answer_words=_order_words,
    cell=order_cell,
    beside=(
        Beside(
            "*witness",
            nullable(WITNESS),
            lambda a, _: a.value.witness and witness_data(a.value.witness),
            is_optional=False,
        ),
        Beside("*order_is_lower_bound", S.TRUE, lambda a, _: a.status.at_least or None),
        Beside("*order_largest_residual", S.SIZE, _largest),
        Beside("*order_tolerance", S.TEXT, _within),
        Beside("*order_undecided", S.TRUE, lambda a, _: bool(a.status.open) or None),
    ),
)


# numbers that a search bounds


# polynomials, roots, intervals


def ratio(variable: str) -> Kind:
    """A rational function."""

    def data(found: Any, _: Plain) -> dict[str, str]:
        over, under = integral([found.numerator, found.denominator])
        return {
            "numerator": polynomial_text(over, variable),
            "denominator": polynomial_text(under, variable),
        }

    return Kind(
        record(numerator=S.TEXT, denominator=S.TEXT),
        data,
        lambda x, d: d.quotient(x.numerator, x.denominator, variable),
    )


def term(variable: str, power: int) -> Kind:
    """A number times a power of a variable."""

    def words(x: Any, d: Plain) -> str:
        return d.polynomial(Polynomial([fmpq(0)] * power + [x]), variable)

    return Kind(S.EXACT, words=words)


def polynomial(variable: str) -> Kind:
    """A polynomial, told with whole coefficients; in decimals, where these are long, as it is."""

    def words(p: Polynomial, d: Plain) -> str:
        (whole,) = integral([p])
        return d.polynomial(p if d.is_brief and has_long_coefficients(whole) else whole, variable)

    return Kind(S.TEXT, lambda p, _: polynomial_text(integral([p])[0], variable), words)


def expression(text: Callable[[Any], str] = str, latex: Callable[[Any], str] | None = None) -> Kind:
    """A symbolic expression: a polynomial in the unknowns of a file, a formula.

    Args:
        text: of a value, for programs too.
        latex: of a value, where the text is not what method files write.
    """

    def words(x: Any, d: Plain) -> str:
        return d.expression(text(x), None if latex is None else lambda: latex(x))

    return Kind(S.TEXT, lambda x, _: text(x), words)


EXPRESSION = expression()
ROOTS = Kind(
    array(ALGEBRAIC),
    lambda xs, d: [root_data(x, d.digits) for x in xs],
    lambda xs, d: ", ".join(map(d.root, xs)),
)
RADIUS = Kind(
    one_of(S.TEXT, ROOT_OF),
    lambda x, d: "infinity" if x.value is None else root_data(x.value, d.digits),
    lambda x, d: d.infinity if x.value is None else d.root(x.value),
)
"""How far something reaches, without end too."""

_END = nullable(ALGEBRAIC)
INTERVAL: Schema = record(**{"from": _END, "to": _END}, from_included=S.FLAG, to_included=S.FLAG)


def interval_data(x: Interval, d: Plain) -> dict[str, Any]:
    """An interval with algebraic ends."""

    def end(root: Any) -> Any:
        return None if root is None else root_data(root, d.digits)

    return {
        "from": end(x.start),
        "to": end(x.end),
        "from_included": x.has_start,
        "to_included": x.has_end,
    }


def intervals(variable: str) -> Kind:
    """Where on a line something holds."""
    return Kind(
        array(INTERVAL),
        lambda xs, d: [interval_data(x, d) for x in xs],
        lambda xs, d: " or ".join(d.interval(x, variable) for x in xs) or "nowhere",
    )


_PLACES = fmpq(10) ** 20
BOUNDS: Schema = record(at_least=S.TEXT, at_most=nullable(S.TEXT))


def bounds_data(found: Bounds) -> dict[str, Any]:
    """Bounds, rounded outwards."""
    if found.low is None:
        return {"at_least": "infinity", "at_most": None}
    low = plain_decimal(fmpq((found.low * _PLACES).floor()) / _PLACES)
    if found.high is None:
        return {"at_least": low, "at_most": None}
    return {
        "at_least": low,
        "at_most": plain_decimal(fmpq((found.high * _PLACES).ceil()) / _PLACES),
    }


def claim_word(holds: bool | None, d: Plain) -> str:
    """What became of a claim: None stands for one that is undecided."""
    if holds:
        return d.good("claim holds")
    return d.note("claim undecided") if holds is None else d.bad("CLAIM FAILS")
