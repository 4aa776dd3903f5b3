"""Mathematica: exact lists of any method, and what ``NDSolve`` takes of an explicit one."""

from __future__ import annotations

from flint import fmpq

from garkcli.bridges.numbers import Style
from garkcli.bridges.radicals import Words
from garkcli.bridges.registry import Bridge
from garkcli.exact.nodes import AlgebraicRoot

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
"""Exact, so that N makes as many digits of them as it is requested."""


BRIDGES = (
    Bridge(
        name="mathematica",
        summary="Mathematica: exact lists, and what NDSolve takes of explicit methods",
        kinds=("rk", "ark", "prk", "gark"),
        suffix=".wl",
        style=MATHEMATICA,
        reads_back=True,
    ),
)
