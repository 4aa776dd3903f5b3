"""From a table that was found to a method file: its text, its rounding, its claims."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from functools import lru_cache
from typing import TypeAlias

from flint import fmpq

from garkcli.bridges.judging import Digits, Judged, judged
from garkcli.errors import ExpressionError, printable
from garkcli.exact.display import decimal
from garkcli.exact.domain import Domain
from garkcli.exact.expression import parse
from garkcli.exact.field import Number
from garkcli.exact.nodes import Literal
from garkcli.frozen import Frozen, replace
from garkcli.methodfile.build import MethodFile
from garkcli.methodfile.load import loads
from garkcli.methodfile.printed import FEWEST_DIGITS
from garkcli.methodfile.writer import quoted
from garkcli.order.certificate import StageSpans
from garkcli.page.plaintext import plain_line
from garkcli.sources.found import FoundTable, Row, Rows
from garkcli.tableau.embedded import with_weights

Tree: TypeAlias = "str | Sequence[Tree] | Mapping[str, Tree] | None"
"""What is in a method file: words, rows of numbers, lists and mappings of these."""
SHORT = 8
"""A decimal with fewer digits is written as a fraction."""
_LONG = re.compile(rf"[0-9]{{{SHORT},}}|[0-9]\.[0-9]{{{SHORT - 1},}}")
_TAIL = re.compile(r"(?<=[0-9.])0{6,}(?![0-9])")
"""Zeros that a printed decimal ends with."""
_INTEGER = re.compile(r"-?(?:0|[1-9][0-9]*)")


class Imported(Frozen, eq=False):
    """A method out of a source.

    Attributes:
        table: as it was found.
        method: as its file is read.
        order: of the method, exactly or within the rounding of its digits.
        embedded_order: the same with the embedded weights; None without them.
        text: of the method file.
    """

    table: FoundTable
    method: MethodFile
    order: Judged
    embedded_order: Judged | None
    text: str

    @property
    def tolerance(self) -> fmpq | None:
        """The rounding that the method file admits."""
        return self.method.tolerance


def imported(table: FoundTable, name: str) -> Imported:
    """The method of a table, with the claims that hold.

    Args:
        table: as it was found.
        name: what the method file calls it.

    Raises:
        MethodFileError: its numbers make no method.
    """
    table, method, order, embedded_order = with_orders(table, read(table, name))
    tolerance = _tolerance(table, (order, embedded_order))
    text = written(table, name, tolerance, _claims(order, embedded_order))
    method = loads(text, place_of(table))
    return Imported(table, method, order, embedded_order, text)


def read(table: FoundTable, name: str = "") -> MethodFile:
    """The method of a table as it is, with no tolerance.

    Raises:
        MethodFileError: its numbers make no method.
    """
    return loads(written(table, name, None, {}), place_of(table))


def with_orders(
    table: FoundTable, method: MethodFile, limit: int | None = None
) -> tuple[FoundTable, MethodFile, Judged, Judged | None]:
    """A table and its method with their orders, up to ``limit``.

    An error estimate E means the embedded weights b − E or b + E: those of the declared order, else
    those of the higher order. Both have the same order where it is lower than that of b, as E then
    misses a condition, but for sums of weights that rounding spoils in one of them.

    Raises:
        MethodFileError: the numbers of the other sign make no method.
    """
    found = table, method, *orders_of(method, table, limit)
    _, _, order, embedded = found
    if table.turned is None or embedded is None:
        return found
    declared = table.embedded_order
    if 0 < embedded.order < order.order and declared in (None, embedded.order):
        return found
    turned = replace(table, embedded=table.turned, turned=None)
    other = read(turned, method.name)
    _, low = orders_of(other, turned, limit)
    if low is None or _fit(low, declared) <= _fit(embedded, declared):
        return found
    return turned, other, order, low


def _fit(found: Judged, declared: int | None) -> tuple[bool, int]:
    return found.order == declared, found.order


def orders_of(
    method: MethodFile, table: FoundTable, limit: int | None = None
) -> tuple[Judged, Judged | None]:
    """The order of a method and that of its embedded weights, within what their digits say, up to
    ``limit``.
    """
    admitted = fmpq_of(table.tolerance) if table.tolerance else None
    digits, spans = digits_of(method, table), StageSpans(method.tableau)
    order = judged(digits, method.tableau, table.order, limit, admitted, spans)
    if method.embedded is None:
        return order, None
    other = with_weights(method.tableau, method.embedded)
    return order, judged(digits, other, table.embedded_order, limit, admitted, spans)


def digits_of(method: MethodFile, table: FoundTable) -> Digits:
    """How exactly the coefficients of a table are written: also those that its method file has as
    fractions.
    """
    texts = {x for x in numbers_of(table) if len(x) > FEWEST_DIGITS and "." in x}
    short = [(parse(x), fmpq_of(x)) for x in sorted(texts) if _fraction(x)]
    units: dict[Number, fmpq] = {fmpq_of(text): unit for text, unit in table.units}
    return Digits((*method.printed, *short), units)


def numbers_of(table: FoundTable) -> Iterator[str]:
    """The coefficients of a table, but for its dense output."""
    blocks = [block or () for blocks in table.A for block in blocks]
    for rows in (*blocks, table.b, [row or () for row in table.c], table.embedded or ()):
        for row in rows:
            yield from row


def place_of(table: FoundTable) -> str:
    """Where a table is, as people write it."""
    return f"{table.source}:{table.line}"


def _tolerance(table: FoundTable, orders: Sequence[Judged | None]) -> fmpq | None:
    """The rounding that the file has to admit; None where everything holds exactly."""
    wanted = [x.tolerance for x in orders if x is not None]
    found = [x for x in wanted if x is not None]
    if table.tolerance:
        found.append(fmpq_of(table.tolerance))
    return max(found, default=None)


def fmpq_of(text: str) -> fmpq:
    """A rational number; 0 for anything else."""
    try:
        value = Domain([parse(text)]).evaluate(parse(text))
    except ExpressionError:
        return fmpq(0)
    return value if isinstance(value, fmpq) else fmpq(0)


def _claims(order: Judged, embedded: Judged | None) -> Mapping[str, str]:
    claims = {}
    if order.order:
        claims["order"] = order.claim
    if embedded is not None and embedded.order:
        claims["embedded-order"] = embedded.claim
    return claims


def written(table: FoundTable, name: str, tolerance: fmpq | None, claims: Mapping[str, str]) -> str:
    """The method file of a table.

    Args:
        table: as it was found.
        name: what the file calls it.
        tolerance: the rounding that it admits.
        claims: what it claims.
    """
    whence = plain_line(printable(place_of(table)))
    lines = [f"# from {whence}, read as {table.format}", "gark: 1"]
    if name:
        lines.append(f"name: {quoted(name)}")
    lines += _lines(_coefficients(table), "")
    if tolerance:
        lines.append(f"tolerance: {decimal(tolerance)}")
    if claims:
        told = ", ".join(f"{key}: {value}" for key, value in claims.items())
        lines.append(f"expect: {{{told}}}")
    return "\n".join(lines) + "\n"


def _lines(value: Mapping[str, Tree] | Sequence[Tree], indent: str) -> Iterator[str]:
    """YAML: what is known under its keys, or items behind dashes; rows in brackets."""
    is_keyed = isinstance(value, Mapping)
    pairs = value.items() if isinstance(value, Mapping) else (("-", x) for x in value)
    for key, x in pairs:
        head = f"{indent}{key}:" if is_keyed else f"{indent}-"
        if x is None:
            yield from () if is_keyed else (f"{head} null",)
        elif isinstance(x, str):
            yield f"{head} {x}"
        elif isinstance(x, Mapping) or not all(isinstance(number, str) for number in x):
            yield head
            yield from _lines(x, f"{indent}  ")
        else:
            yield f"{head} {row_text([str(number) for number in x])}"


def _coefficients(table: FoundTable) -> Mapping[str, Tree]:
    """What a method file has of the coefficients."""
    if table.parts:
        return _prk(table)
    if table.colours == 1 and table.A[0][0] is not None:
        return _colour(table, 0, table.A[0][0], table.c[0])
    weights = {"b": table.b, "embedded": table.embedded, "dense": _polynomials(table.dense)}
    if len(table.A) == 1:
        return {"ark": {"c": table.c[0], "A": table.A[0], **weights}}
    nodes = [row or _sums(table, l) for l, row in enumerate(table.c)]
    linear = ", ".join(str(l + 1) for l in table.linear)
    return {
        "tableau": {"c": nodes if any(table.c) else None, "A": table.A, **weights},
        "linear": f"[{linear}]" if linear else None,
    }


def _colour(table: FoundTable, l: int, A: Rows | None, c: Row | None) -> Mapping[str, Tree]:
    """One vector field: its matrix, its nodes, its weights and those beside them."""
    embedded = None if table.embedded is None else table.embedded[l]
    dense = None if table.dense is None else table.dense[l : l + 1]
    return {"A": A, "b": table.b[l], "c": c, "embedded": embedded, "dense": _polynomials(dense)}


def _polynomials(dense: Sequence[Rows] | None) -> Mapping[str, Tree] | None:
    """Dense output, a block for each of several colours."""
    if dense is None:
        return None
    degree = max(len(row) for rows in dense for row in rows)
    return {"degree": str(degree), "weights": dense if len(dense) > 1 else dense[0]}


def _sums(table: FoundTable, l: int) -> Row:
    """The row sums of the diagonal block, where a source gives nodes of other colours alone."""
    block = table.A[l][l]
    if block is None:
        return ("0",) * len(table.b[l])
    return tuple(" + ".join(f"({x})" for x in row) for row in block)


def _prk(table: FoundTable) -> Mapping[str, Tree]:
    """The form ``prk``: the rows of q.A are the positions at which forces are evaluated."""
    is_shared = len(table.A) == 1
    of_q = 0 if is_shared else 1
    q = _colour(table, 0, table.A[of_q][0], table.c[of_q])
    p = _colour(table, 1, table.A[0][1], table.c[0])
    structure = "general" if is_shared else table.structure or "separable"
    return {"prk": {"q": q, "p": p}, "structure": structure}


def row_text(row: Sequence[str]) -> str:
    """A row of a method file."""
    return f"[{', '.join(map(entry_text, row))}]"


@lru_cache(maxsize=4096)
def entry_text(text: str) -> str:
    """A number of a method file: fractions in lowest terms, long decimals and roots as they are.

    >>> entry_text("1.0/3.0"), entry_text("0.25"), entry_text("root(2, 5)")
    ('1/3', '1/4', '"root(2, 5)"')
    """
    if _INTEGER.fullmatch(text):
        return text
    short = _fraction(text)
    if short:
        return short
    is_plain = not set(text) & set(",#:{}[]&*!|>'\"%@`\\\n")
    return text if is_plain and text[:1] not in "-?" else quoted(text)


def _fraction(text: str) -> str:
    """The fraction that a text without long decimals and without roots is; empty for others."""
    if _LONG.search(_TAIL.sub("", text)) and not _is_quotient(text):
        return ""
    try:
        expression = parse(text)
        if isinstance(expression, Literal):
            return str(expression.value)
        value = Domain([expression]).evaluate(expression)
    except ExpressionError:
        return ""
    return str(value) if isinstance(value, fmpq) else ""


def _is_quotient(text: str) -> bool:
    """Whether a text is made of whole numbers, however long: those are exact."""
    return "." not in text and "e" not in text and "q" not in text
