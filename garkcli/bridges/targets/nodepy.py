"""nodepy: a module with the method in exact numbers of SymPy."""

from __future__ import annotations

from flint import fmpq

from garkcli.bridges.numbers import Style
from garkcli.bridges.radicals import Radicals
from garkcli.bridges.registry import Bridge
from garkcli.exact.nodes import AlgebraicRoot


class _Rationals(Radicals):
    """Roots as SymPy has them."""

    POWER = "**"

    def rational(self, x: fmpq) -> str:
        return f"Rational({x.p}, {x.q})"

    def root(self, radicand: str, index: int) -> str:
        # the principal root of a negative number is no real one
        return f"sqrt({radicand})" if index == 2 else f"real_root({radicand}, {index})"

    def algebraic(self, root: AlgebraicRoot) -> str:
        """Real roots come first there, in ascending order."""
        terms = [f"{a}*x**{k}" for k, a in enumerate(root.coefficients) if a]
        return f"rootof({' + '.join(terms)}, {root.number})"


SYMPY = Style(
    digits=60,  # of numbers that have no radicals
    decimal='Rational("{x}")',
    fraction="Rational({p}, {q})",
    is_fraction_first=True,
    largest=10**4000,
    irrational=_Rationals().text,
    point=False,
)


BRIDGES = (
    Bridge(
        name="nodepy",
        summary="nodepy: a module with exact numbers of SymPy",
        suffix=".py",
        style=SYMPY,
    ),
)
