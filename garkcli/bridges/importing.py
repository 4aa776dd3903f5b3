"""The text of the method file of a table."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from functools import lru_cache
from typing import TypeAlias

from flint import fmpq

from garkcli.errors import ExpressionError, printable
from garkcli.exact.display import decimal
from garkcli.exact.domain import Domain
from garkcli.exact.expression import parse
from garkcli.exact.field import Number
from garkcli.exact.nodes import Literal
from garkcli.grammar.editing import quoted
from garkcli.page.plaintext import plain_line
from garkcli.sources.found import FoundTable, Row, Rows

Tree: TypeAlias = "str | Sequence[Tree] | Mapping[str, Tree] | None"
SHORT = 8
"""Decimals with fewer digits become fractions."""
_LONG = re.compile(rf"[0-9]{{{SHORT},}}|[0-9]\.[0-9]{{{SHORT - 1},}}")
_TAIL = re.compile(r"(?<=[0-9.])0{6,}(?![0-9])")
_INTEGER = re.compile(r"-?(?:0|[1-9][0-9]*)")


def numbers_of(table: FoundTable) -> Iterator[str]:
    blocks = [block or () for blocks in table.A for block in blocks]
    for rows in (*blocks, table.b, [row or () for row in table.c], table.embedded or ()):
        for row in rows:
            yield from row


def place_of(table: FoundTable) -> str:
    return f"{table.source}:{table.line}"


def fmpq_of(text: str) -> fmpq:
    """0 for texts that are no rational numbers."""
    value = parsed(text)
    return value if isinstance(value, fmpq) else fmpq(0)


def parsed(text: str) -> Number | None:
    try:
        expression = parse(text)
        if isinstance(expression, Literal):
            return expression.value
        return Domain([expression]).evaluate(expression)
    except ExpressionError:
        return None


def written(table: FoundTable, name: str, tolerance: fmpq | None, claims: Mapping[str, str]) -> str:
    whence = plain_line(printable(place_of(table)))
    lines = [f"# from {whence}, read as {table.format}", "gark: 1"]
    if name:
        lines.append(f"name: {quoted(name)}")
    lines += _lines(_coefficients(table), "")
    if tolerance:
        lines.append(f"tolerance: {decimal(tolerance)}")
    if claims:
        expectations = ", ".join(f"{key}: {value}" for key, value in claims.items())
        lines.append(f"expect: {{{expectations}}}")
    return "\n".join(lines) + "\n"


def _lines(value: Mapping[str, Tree] | Sequence[Tree], indent: str) -> Iterator[str]:
    """YAML lines: values under their keys, or items behind dashes; rows in brackets."""
    is_keyed = isinstance(value, Mapping)
    pairs = value.items() if isinstance(value, Mapping) else (("-", x) for x in value)
    for key, x in pairs:
        head = f"{indent}{key}:" if is_keyed else f"{indent}-"
        if x is None:
            yield from () if is_keyed else (f"{head} null",)
        elif isinstance(x, str):
            yield f"{head} {entry_text(x) if key == 'gamma' else x}"
        elif isinstance(x, Mapping) or not all(isinstance(number, str) for number in x):
            yield head
            yield from _lines(x, f"{indent}  ")
        else:
            yield f"{head} [{', '.join(entry_text(str(number)) for number in x)}]"


def _coefficients(table: FoundTable) -> Mapping[str, Tree]:
    if table.form is not None:
        return table.form
    if table.gamma is not None:
        return {"rosenbrock": _rosenbrock(table)}
    if table.is_multirate:
        return {"multirate": {**_slow(table), "fast": "exact"}}
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
    embedded = None if table.embedded is None else table.embedded[l]
    dense = None if table.dense is None else table.dense[l : l + 1]
    return {"A": A, "b": table.b[l], "c": c, "embedded": embedded, "dense": _polynomials(dense)}


def _rosenbrock(table: FoundTable) -> Mapping[str, Tree]:
    beside = {"c": table.c[0], "d": table.d}
    if table.diagonal is None:
        embedded = None if table.embedded is None else table.embedded[0]
        printed = {"alpha": table.A[0][0], "gamma": table.gamma, "b": table.b[0], **beside}
        return {**printed, "embedded": embedded, "dense": _polynomials(table.dense)}
    diagonal = table.diagonal[0] if len(set(table.diagonal)) == 1 else table.diagonal
    stored = {"A": table.A[0][0], "C": table.gamma, "gamma": diagonal, "m": table.b[0], **beside}
    return {"transformed": {**stored, "e": table.error}}


def _slow(table: FoundTable) -> Mapping[str, Tree]:
    coupling = table.coupling
    if coupling is None:
        assert table.A[0][0] is not None
        return {"mis": _colour(table, 0, table.A[0][0], table.c[0])}
    parts = dict(coupling.parts)
    # the parts that the embedded step changes
    embedded: Tree = {key: rows for key, rows in coupling.embedded.items() if rows}
    if len(parts) == 1:
        (key,) = parts
        embedded = coupling.embedded.get(key)
        # the only part
        parts = parts if coupling.restart else {"gamma": parts[key]}
    return {
        "mri": {
            "restart": coupling.restart or None,
            "c": coupling.c,
            **parts,
            "embedded": embedded or None,
        }
    }


def _polynomials(dense: Sequence[Rows] | None) -> Mapping[str, Tree] | None:
    if dense is None:
        return None
    degree = max((len(row) for rows in dense for row in rows), default=0)
    return {"degree": str(degree), "weights": dense if len(dense) > 1 else dense[0]}


def _sums(table: FoundTable, l: int) -> Row:
    """Nodes for sources without them: the row sums of the diagonal block."""
    block = table.A[l][l]
    if block is None:
        return ("0",) * len(table.b[l])
    return tuple(" + ".join(f"({x})" for x in row) for row in block)


def _prk(table: FoundTable) -> Mapping[str, Tree]:
    """The form ``prk``: the rows of q.A are the positions at which forces are evaluated."""
    sees_both = table.A[0][0] is not None and table.A[-1][1] is not None
    is_general = len(table.A) == 1 or (sees_both and not table.structure)
    of_q, of_p = (0, -1) if is_general else (1, 0)
    q = _colour(table, 0, table.A[of_q][0], table.c[of_q])
    p = _colour(table, 1, table.A[of_p][1], table.c[of_p])
    structure = "general" if is_general else table.structure or "separable"
    return {"prk": {"q": q, "p": p}, "structure": structure}


@lru_cache(maxsize=4096)
def entry_text(text: str) -> str:
    """A number of a method file: a fraction in lowest terms, or long decimals and roots unchanged.

    >>> entry_text("1.0/3.0"), entry_text("0.25"), entry_text("root(2, 5)")
    ('1/3', '1/4', '"root(2, 5)"')
    """
    if _INTEGER.fullmatch(text):
        return text
    short = fraction_of(text)
    if short:
        return short
    is_plain = not set(text) & set(",#:{}[]&*!|>'\"%@`\\\n")
    return text if is_plain and text[:1] not in "-?" else quoted(text)


def fraction_of(text: str) -> str:
    """The exact fraction of a text without long decimals and roots; empty for others."""
    if _LONG.search(_TAIL.sub("", text)) and {*text} & {*".eq"}:
        return ""
    value = parsed(text)
    return str(value) if isinstance(value, fmpq) else ""
