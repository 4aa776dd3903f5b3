"""Numbers of Python, NumPy, SymPy and FLINT as the text of a method file, exactly."""

from __future__ import annotations

import numbers
from decimal import Decimal
from math import isfinite
from sys import float_info
from typing import Any

from flint import fmpq, fmpz

from garkcli.errors import MethodError
from garkcli.exact.display import to_text
from garkcli.exact.field import Algebraic

FLOAT_DIGITS = 15
"""Decimal digits that every float keeps: a decimal of so many is the only one its float prints."""


def number_text(x: Any, where: str, is_rounded: bool) -> str:
    """The text of a coefficient.

    A float stands for the decimal that it prints. With more than 15 digits that is a rounded
    number, which only goes with a tolerance.

    Args:
        x: a number, or its text.
        where: what it is, for messages.
        is_rounded: whether a tolerance was given.

    Raises:
        MethodError: it is no number, or it was rounded and no tolerance was given.
    """
    if isinstance(x, str):
        return x
    if isinstance(x, bool) or type(x).__name__ == "bool_":
        raise MethodError(f"{where}: {x} is no number", "write 0 or 1")
    if isinstance(x, (fmpz, fmpq)):
        return str(x)
    if isinstance(x, Algebraic):
        return to_text(x)
    if isinstance(
        x, numbers.Rational
    ):  # int, Fraction, NumPy's integers, SymPy's rationals
        p, q = int(x.numerator), int(x.denominator)
        return str(p) if q == 1 else f"{p}/{q}"
    if isinstance(x, Decimal) and x.is_finite():
        return str(x)
    if _is_float(x):
        return _float_text(x, where, is_rounded)
    if type(x).__module__.partition(".")[0] == "sympy":
        return _sympy_text(x, where)
    raise MethodError(f"{where}: {_shown(x)} is no exact real number", _CURE)


_CURE = "give an int, a Fraction, a float, or its text, such as '1/2 - sqrt(3)/6'"


def _shown(x: Any) -> str:
    text = repr(x)
    text = text if len(text) <= 60 else f"{text[:60]}…"
    return f"{text} of type {type(x).__name__}"


def _is_float(x: Any) -> bool:
    """Whether it is a float of Python or of NumPy, which is known without importing NumPy."""
    return isinstance(x, float) or (
        type(x).__module__ == "numpy"
        and type(x).__name__.startswith(("float", "longdouble"))
    )


def _float_text(x: Any, where: str, is_rounded: bool) -> str:
    value = float(x)
    if not isfinite(value):
        raise MethodError(f"{where}: {value} is no number", "coefficients are finite")
    if value != x:
        cure = "give the text of the number, or a Fraction"
        raise MethodError(f"{where}: {x} has more digits than a float", cure)
    text = repr(value)
    mantissa = text.lower().partition("e")[0]
    digits = len(mantissa.replace(".", "").lstrip("-0").rstrip("0"))
    is_subnormal = 0 < abs(value) < float_info.min  # such floats keep fewer digits
    if (digits > FLOAT_DIGITS or is_subnormal) and not is_rounded:
        raise MethodError(
            f"{where}: {text} is a rounded number",
            "give it exactly, as a Fraction or a text such as '1/3', or say tolerance='1e-13'",
        )
    return text


def _sympy_text(x: Any, where: str, is_part: bool = False) -> str:
    """The text of a SymPy expression of rationals and real roots; SymPy is not imported.

    ``is_part`` puts parentheses around what would not hold together in a product or a power.
    """
    if x.is_Rational:
        text = str(x.p) if x.q == 1 else f"{x.p}/{x.q}"
        return f"({text})" if is_part and not text.isdigit() else text
    if x.is_Add:
        text = " + ".join(_sympy_text(part, where) for part in x.args)
        return f"({text})" if is_part else text
    if x.is_Mul:
        text = "*".join(_sympy_text(part, where, is_part=True) for part in x.args)
        return f"({text})" if is_part else text
    if x.is_Pow and x.exp.is_Rational:
        return _sympy_power(x, where)
    if getattr(x, "is_Float", False):
        cure = "give it exactly, as a Rational or a text"
        raise MethodError(f"{where}: {_shown(x)} is a rounded number", cure)
    raise MethodError(
        f"{where}: {_shown(x)} is made of more than rationals and real roots", _CURE
    )


def _sympy_power(x: Any, where: str) -> str:
    """A rational power of SymPy, in parentheses where it is more than a root."""
    p, q = int(x.exp.p), int(x.exp.q)
    if q == 1:
        return f"({_sympy_text(x.base, where, is_part=True)}**{p})"
    if not x.base.is_nonnegative:
        # SymPy's roots of negative numbers are complex, ours are real
        raise MethodError(f"{where}: {_shown(x)} is a root of a negative number", _CURE)
    inner = _sympy_text(x.base, where)
    root = f"{_ROOTS[q]}({inner})" if q in _ROOTS else f"root({inner}, {q})"
    return root if p == 1 else f"({root}**{p})"


_ROOTS = {2: "sqrt", 3: "cbrt"}
