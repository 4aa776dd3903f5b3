"""nodepy: a module with the method in exact numbers of SymPy."""

from __future__ import annotations

from flint import fmpq

from garkcli.bridges.comments import HASH, head
from garkcli.bridges.lines import filled
from garkcli.bridges.numbers import Style
from garkcli.bridges.payload import Payload
from garkcli.bridges.radicals import Words
from garkcli.bridges.registry import Bridge
from garkcli.bridges.structure import table
from garkcli.exact.nodes import AlgebraicRoot
from garkcli.tableau.pointwise import Row

_DIGITS = 60  # of numbers that have no radicals


def _rational(x: fmpq) -> str:
    return f"Rational({x.p}, {x.q})"


def _root(radicand: str, index: int) -> str:
    # the principal root of a negative number is no real one
    return f"sqrt({radicand})" if index == 2 else f"real_root({radicand}, {index})"


def _algebraic(root: AlgebraicRoot) -> str:
    """Real roots come first there, in ascending order."""
    terms = []
    for k, a in enumerate(root.coefficients):
        if a:
            terms.append(f"{a}*x**{k}")
    return f"rootof({' + '.join(terms)}, {root.number})"


WORDS = Words(_rational, _root, _algebraic, "**")
SYMPY = Style(
    digits=_DIGITS,
    decimal='Rational("{x}")',
    fraction="Rational({p}, {q})",
    is_fraction_first=True,
    largest=10**4000,
    irrational=WORDS.text,
    point=False,
)


def write(payload: Payload) -> str:
    """An explicit method or pair, or an implicit method."""
    found = table(payload)
    kind = "RungeKuttaMethod"
    arguments = ["A=A", "b=b"]
    if found.is_explicit:
        kind = "ExplicitRungeKuttaMethod"
    if found.is_explicit and found.embedded is not None:
        kind = "ExplicitRungeKuttaPair"
        arguments.append("bhat=bhat")
    arguments.append(f'name="{payload.identifier("python")}"')
    note = "nodepy takes the row sums for the nodes. It needs six, which it does not ask for."
    lines = HASH.lines(head(payload, note))
    lines += [
        "",
        "import numpy as np",
        f"from nodepy.runge_kutta_method import {kind}",
        "from sympy import Rational, real_root, rootof, sqrt  # noqa: F401",
        "from sympy.abc import x  # noqa: F401",
        "",
        "A = np.array([",
    ]
    for row in found.A:
        lines += _row(payload, "    [", row, "],")
    lines.append("], dtype=object)")
    lines += _row(payload, "b = np.array([", found.b, "], dtype=object)")
    if len(arguments) > 3:
        embedded = found.embedded or ()
        lines += _row(payload, "bhat = np.array([", embedded, "], dtype=object)")
    made = f"{payload.identifier('python')} = {kind}({', '.join(arguments)})"
    return "\n".join([*lines, made]) + "\n"


def _row(payload: Payload, begin: str, row: Row, end: str) -> list[str]:
    return filled(payload.numbers(row, SYMPY), begin, end)


BRIDGES = (
    Bridge(
        name="nodepy",
        summary="nodepy: a module with exact numbers of SymPy",
        kinds=("rk",),
        suffix=".py",
        write=write,
    ),
)
