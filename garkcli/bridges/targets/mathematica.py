"""Mathematica: exact lists of any method, and what ``NDSolve`` takes of an explicit one."""

from __future__ import annotations

from collections.abc import Sequence

from flint import fmpq

from garkcli.bridges.comments import STARRED, head
from garkcli.bridges.lines import filled
from garkcli.bridges.numbers import Style
from garkcli.bridges.payload import Payload
from garkcli.bridges.radicals import Words
from garkcli.bridges.registry import Bridge
from garkcli.bridges.structure import table
from garkcli.exact.nodes import AlgebraicRoot
from garkcli.tableau.pointwise import Block, Row

_DIGITS = 60  # of numbers that have no radicals


def _rational(x: fmpq) -> str:
    return str(x.p) if x.q == 1 else f"({x})"


def _root(radicand: str, index: int) -> str:
    if index == 2:
        return f"Sqrt[{radicand}]"
    # the principal root of a negative number is no real one
    return f"Surd[{radicand}, {index}]"


def _algebraic(root: AlgebraicRoot) -> str:
    """Real roots come first there, in ascending order."""
    powers = []
    for k, a in enumerate(root.coefficients):
        if a:
            powers.append(f"({a})*#^{k}" if k else f"({a})")
    return f"Root[{' + '.join(powers)} &, {root.number + 1}]"


WORDS = Words(_rational, _root, _algebraic, "^")
MATHEMATICA = Style(
    digits=_DIGITS,
    fraction="{p}/{q}",
    is_fraction_first=True,
    largest=10**4000,
    irrational=WORDS.text,
    exponent="*^",
    point=False,
)
"""Exact, so that N makes as many digits of them as it is asked for."""


def write(payload: Payload) -> str:
    """An association of lists; of explicit methods also the function that ``NDSolve`` wants."""
    name = payload.class_name("mathematica")
    name = name[0].lower() + name[1:]
    usage = _usage(payload, name)
    lines = STARRED.lines(head(payload, *_notes(payload), *usage))
    lines += [f"{name} = <|"]
    lines += _keys(payload)
    lines += [f'  "order" -> {payload.orders.effective}', "|>;"]
    if usage:
        lines += _function(payload, name)
    return "\n".join(lines) + "\n"


def _notes(payload: Payload) -> list[str]:
    if payload.kind == "rk":
        return []
    return [
        'The "A" of vector fields l and m says how the stages of l see m; None where they do not.'
    ]


def _usage(payload: Payload, name: str) -> list[str]:
    """How ``NDSolve`` takes it, where it does: explicit methods alone."""
    if payload.kind != "rk" or not table(payload).is_explicit:
        return []
    orders = payload.orders
    options = [
        '"ExplicitRungeKutta"',
        f'"Coefficients" -> {name}Coefficients',
        f'"DifferenceOrder" -> {orders.effective}',
    ]
    if orders.embedded is not None:
        options.append(f'"EmbeddedDifferenceOrder" -> {orders.embedded}')
    options.append('"StiffnessTest" -> False')
    return [f"NDSolve[..., Method -> {{{', '.join(options)}}}]"]


def _function(payload: Payload, name: str) -> list[str]:
    """Rows below the diagonal, b, the nodes but the first, b - bhat; rounded as it is asked for."""
    stages = payload.stages[0]
    parts = [
        f'Table[Take[{name}["A"][[i]], i - 1], {{i, 2, {stages}}}]',
        f'{name}["b"]',
        f'Rest[{name}["c"]]',
    ]
    if payload.embedded is not None:
        parts.append(f'{name}["b"] - {name}["bhat"]')
    order = payload.orders.effective
    lines = [f"{name}Coefficients[{order}, precision_] := N[{{"]
    lines += [f"  {part}," for part in parts[:-1]]
    return [*lines, f"  {parts[-1]}", "}, precision];"]


def _keys(payload: Payload) -> list[str]:
    lines = []
    rows = {"b": payload.b, "c": payload.c, "bhat": payload.embedded}
    if payload.kind == "rk":
        lines += _matrix(payload, '  "A" -> ', payload.A[0][0] or (), ",")
        for key, of_colours in rows.items():
            if of_colours is not None:
                lines += _row(payload, f'  "{key}" -> ', of_colours[0], ",")
        return lines
    lines += _blocks(payload)
    for key, of_colours in rows.items():
        if of_colours is not None:
            lines += _matrix(payload, f'  "{key}" -> ', of_colours, ",")
    return lines


def _blocks(payload: Payload) -> list[str]:
    """A list of lists of matrices."""
    lines = ['  "A" -> {']
    last = payload.size - 1
    for l, blocks in enumerate(payload.A):
        lines.append("   {")
        for m, block in enumerate(blocks):
            end = "," if m < last else ""
            lines += _matrix(payload, "    ", block, end)
        lines.append("   }," if l < last else "   }")
    return [*lines, "  },"]


def _matrix(payload: Payload, begin: str, rows: Block | Sequence[Row], end: str) -> list[str]:
    if rows is None:
        return [f"{begin}None{end}"]
    lines = []
    for i, row in enumerate(rows):
        indent = " " * len(begin) + " " if i else begin + "{"
        close = f"}}{end}" if i == len(rows) - 1 else ","
        lines += _row(payload, indent, row, close)
    return lines


def _row(payload: Payload, begin: str, row: Row, end: str) -> list[str]:
    return filled(payload.numbers(row, MATHEMATICA), f"{begin}{{", f"}}{end}")


BRIDGES = (
    Bridge(
        name="mathematica",
        summary="Mathematica: exact lists, and what NDSolve takes of explicit methods",
        kinds=("rk", "ark", "prk", "gark"),
        suffix=".wl",
        write=write,
        reads_back=True,
    ),
)
