"""Types of sympy expressions, numbers, and sums of products; sympy is imported on first use."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, TypeAlias

from flint import arb, fmpq

Expr: TypeAlias = Any
Exprs: TypeAlias = tuple[Expr, ...]
Vector: TypeAlias = Sequence[Expr]
ExprMatrix: TypeAlias = Sequence[Vector]
Place: TypeAlias = Mapping[Expr, arb]
Substitution: TypeAlias = Mapping[Expr, Expr]
Invariants: TypeAlias = Sequence[tuple[str, Expr]]


def rational(x: fmpq) -> Expr:
    import sympy

    return sympy.Rational(int(x.p), int(x.q))


def number(x: Expr) -> fmpq:
    return fmpq(int(x.p), int(x.q))


def dot(left: Vector, right: Vector) -> Expr:
    return sum(a * x for a, x in zip(left, right, strict=True))
