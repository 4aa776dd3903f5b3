"""The sympy expressions that problems are made of: names of types, numbers, sums of products.

sympy is imported when the first one is made.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, TypeAlias

from flint import arb, fmpq

Expr: TypeAlias = Any
"""An expression or a symbol of sympy."""
Exprs: TypeAlias = tuple[Expr, ...]
"""Several, one a component."""
Vector: TypeAlias = Sequence[Expr]
"""The same as they are computed with."""
ExprMatrix: TypeAlias = Sequence[Vector]
"""Row by row."""
Place: TypeAlias = Mapping[Expr, arb]
"""Values of symbols, enclosed."""
Substitution: TypeAlias = Mapping[Expr, Expr]
"""What stands for symbols."""
Invariants: TypeAlias = Sequence[tuple[str, Expr]]
"""Names of first integrals, and what they are."""


def rational(x: fmpq) -> Expr:
    """A rational number as an expression."""
    import sympy

    return sympy.Rational(int(x.p), int(x.q))


def number(x: Expr) -> fmpq:
    """The number that a rational expression is."""
    return fmpq(int(x.p), int(x.q))


def dot(left: Vector, right: Vector) -> Expr:
    """Σ a_i x_i."""
    return sum(a * x for a, x in zip(left, right, strict=True))
