"""nodepy: a module with the method in exact numbers of SymPy."""

from __future__ import annotations

from flint import fmpq

from garkcli.bridges.numbers import Style
from garkcli.bridges.radicals import Words
from garkcli.bridges.registry import Bridge
from garkcli.exact.nodes import AlgebraicRoot

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


BRIDGES = (
    Bridge(
        name="nodepy",
        summary="nodepy: a module with exact numbers of SymPy",
        kinds=("rk",),
        suffix=".py",
        style=SYMPY,
    ),
)
