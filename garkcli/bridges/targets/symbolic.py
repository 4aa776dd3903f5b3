"""Programs that compute with exact roots: Mathematica, and nodepy with SymPy."""

from __future__ import annotations

from flint import fmpq

from garkcli.bridges.numbers import Style
from garkcli.bridges.radicals import Radicals
from garkcli.bridges.registry import EVERYTHING, Bridge
from garkcli.exact.nodes import AlgebraicRoot
from garkcli.frozen import replace


class _Surds(Radicals):
    def rational(self, x: fmpq) -> str:
        return str(x.p) if x.q == 1 else f"({x})"

    def root(self, radicand: str, index: int) -> str:
        # the principal root of a negative number is not real
        return f"Sqrt[{radicand}]" if index == 2 else f"Surd[{radicand}, {index}]"

    def algebraic(self, root: AlgebraicRoot) -> str:
        """Mathematica numbers real roots first, in ascending order."""
        powers = [f"({a})*#^{k}" if k else f"({a})" for k, a in enumerate(root.coefficients) if a]
        return f"Root[{' + '.join(powers)} &, {root.number + 1}]"


MATHEMATICA = Style(
    digits=60,  # of numbers without radicals
    fraction="{p}/{q}",
    is_fraction_first=True,
    largest=10**4000,
    irrational=_Surds().text,
    exponent="*^",
    point=False,
)
"""Numbers are exact, so that N gives any number of digits."""


class _Rationals(Radicals):
    POWER = "**"

    def rational(self, x: fmpq) -> str:
        return f"Rational({x.p}, {x.q})"

    def root(self, radicand: str, index: int) -> str:
        # the principal root of a negative number is not real
        return f"sqrt({radicand})" if index == 2 else f"real_root({radicand}, {index})"

    def algebraic(self, root: AlgebraicRoot) -> str:
        """SymPy numbers real roots first, in ascending order."""
        terms = [f"{a}*x**{k}" for k, a in enumerate(root.coefficients) if a]
        return f"rootof({' + '.join(terms)}, {root.number})"


SYMPY = replace(
    MATHEMATICA,
    decimal='Rational("{x}")',
    fraction="Rational({p}, {q})",
    irrational=_Rationals().text,
    exponent="e",
)


BRIDGES = (
    Bridge(
        name="mathematica",
        summary="Mathematica: exact lists, and what NDSolve takes of explicit methods",
        kinds=EVERYTHING,
        suffix=".wl",
        style=MATHEMATICA,
        reads_back=True,
    ),
    Bridge(
        name="nodepy",
        summary="nodepy: a module with exact numbers of SymPy",
        suffix=".py",
        style=SYMPY,
    ),
)
