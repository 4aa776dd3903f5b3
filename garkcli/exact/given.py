"""Converts numbers of Python, NumPy, SymPy and FLINT to the text of a method file, exactly."""

from __future__ import annotations

import numbers
from decimal import Decimal
from math import isfinite
from sys import float_info
from typing import Any, SupportsFloat, TypeAlias

from flint import fmpq, fmpz

from garkcli.errors import ExpressionError, MethodError
from garkcli.exact.display import to_text
from garkcli.exact.field import Algebraic

AnyNumber: TypeAlias = "SupportsFloat | str"
"""A number of Python, NumPy, SymPy or FLINT, exact up to 15 digits, or a text as ``"1/3"``."""
FLOAT_DIGITS = 15
"""Any decimal with so many digits is the shortest one of its float."""


MAX_BITS = 10_000
"""Longer numbers are refused: Python does not print more than 4300 digits."""
EXACTLY = "give it exactly, as a Fraction or a text such as '1/3'"
OR_ROUNDED = f"{EXACTLY}, or say tolerance='1e-13'"


def number_text(x: Any, where: str, is_rounded: bool, cure: str = OR_ROUNDED) -> str:
    """The text of a coefficient; MethodError for other values. ``where`` is for messages. A float
    is the decimal that it prints; with more than 15 digits it needs a tolerance.
    """
    if isinstance(x, str):
        return x
    kind = type(x)
    if isinstance(x, bool) or kind.__name__ == "bool_":
        raise MethodError(f"{where}: {x} is not a number", "write 0 or 1", code="not-a-number")
    if isinstance(x, (fmpz, fmpq)):
        return str(x)
    if isinstance(x, Algebraic):
        return to_text(x)
    if isinstance(x, numbers.Rational):
        # int, Fraction, NumPy's integers, SymPy's rationals
        p, q = int(x.numerator), int(x.denominator)
        if max(abs(p), q).bit_length() > MAX_BITS:
            message = f"{where}: a number of more than 1000 digits"
            raise MethodError(message, "no coefficient needs so many", code="number-too-large")
        return _fraction_text(p, q)
    if isinstance(x, Decimal) and x.is_finite():
        return str(x)
    if _is_float(x):
        return _float_text(x, where, is_rounded, cure)
    if kind.__module__.partition(".")[0] == "sympy":
        return _sympy_text(x, where)
    message = f"{where}: {_shown(x)} is not an exact real number"
    raise MethodError(message, _CURE, code="not-a-number")


_CURE = "give an int, a Fraction, a float, or its text, such as '1/2 - sqrt(3)/6'"


def _fraction_text(p: int, q: int) -> str:
    if q == 1:
        return str(p)
    return f"{p}/{q}"


def _shown(x: Any) -> str:
    text = repr(x)
    if len(text) > 60:
        text = f"{text[:60]}…"
    return f"{text} of type {type(x).__name__}"


def _is_float(x: Any) -> bool:
    # without importing NumPy
    if isinstance(x, float):
        return True
    kind = type(x)
    is_of_numpy = kind.__module__ == "numpy"
    return is_of_numpy and kind.__name__.startswith(("float", "longdouble"))


def _float_text(x: Any, where: str, is_rounded: bool, cure: str) -> str:
    value = float(x)
    if not isfinite(value):
        message = f"{where}: {value} is not a number"
        raise MethodError(message, "coefficients are finite", code="not-a-number")
    if value != x:
        message = f"{where}: {x} has more digits than a float"
        raise MethodError(message, "give its text, or a Fraction", code="number-too-large")
    text = repr(value)
    mantissa, *_ = text.lower().partition("e")
    is_long = len(mantissa.replace(".", "").lstrip("-0").rstrip("0")) > FLOAT_DIGITS
    # subnormal floats keep fewer digits
    is_subnormal = 0 < abs(value) < float_info.min
    if (is_long or is_subnormal) and not is_rounded:
        message = f"{where}: {text} is a rounded number"
        raise MethodError(message, cure, code="arrays")
    return text


def _sympy_text(x: Any, where: str, is_part: bool = False) -> str:
    """The text of rationals and real roots of SymPy, without importing it."""
    if x.is_Pow and x.exp.is_Rational:
        return _sympy_power(x, where)
    if x.is_Rational:
        text = _fraction_text(x.p, x.q)
        is_whole = text.isdigit()
        return f"({text})" if is_part and not is_whole else text
    if x.is_Add:
        parts = [_sympy_text(part, where) for part in x.args]
        text = " + ".join(parts)
    elif x.is_Mul:
        parts = [_sympy_text(part, where, is_part=True) for part in x.args]
        text = "*".join(parts)
    else:
        raise _unreadable(x, where)
    return f"({text})" if is_part else text


def _unreadable(x: Any, where: str) -> MethodError:
    if getattr(x, "is_Float", False):
        cure = "give it exactly, as a Rational or a text"
        message = f"{where}: {_shown(x)} is a rounded number"
        return MethodError(message, cure, code="arrays")
    made_of = "more than rationals and real roots"
    message = f"{where}: {_shown(x)} is made of {made_of}"
    return MethodError(message, _CURE, code="not-a-number")


def _sympy_power(x: Any, where: str) -> str:
    p = int(x.exp.p)
    q = int(x.exp.q)
    if q == 1:
        base = _sympy_text(x.base, where, is_part=True)
        return f"({base}**{p})"
    if not x.base.is_nonnegative:
        # SymPy's roots of negative numbers are complex, ours are real
        message = f"{where}: {_shown(x)} is a root of a negative number"
        raise MethodError(message, _CURE, code="not-real")
    inner = _sympy_text(x.base, where)
    root = f"root({inner}, {q})"
    if q in _ROOTS:
        root = f"{_ROOTS[q]}({inner})"
    if p == 1:
        return root
    return f"({root}**{p})"


_ROOTS = {2: "sqrt", 3: "cbrt"}


def complex_parts(text: str) -> tuple[str, str]:
    """The texts of the real and imaginary parts of a complex number.

    >>> complex_parts("0.01+2i"), complex_parts("1e-3 - 3/4*i"), complex_parts("-j")
    (('0.01', '2'), ('1e-3', '-3/4'), ('0', '-1'))
    """
    text = "".join(text.split())
    if not text.endswith(("i", "j")):
        return text, "0"
    body = text[:-1].removesuffix("*")
    # a sign that is not that of an exponent, nor of the whole
    signs = [k for k, sign in enumerate(body) if k and sign in "+-" and body[k - 1] not in "eE"]
    cut = signs[-1] if signs else 0
    imaginary = body[cut:].removeprefix("+")
    return body[:cut] or "0", f"{imaginary}1" if imaginary in {"", "-"} else imaginary


def rational_of(x: Any, where: str, is_rounded: bool = False) -> fmpq:
    """The rational value of any kind of number.

    ``where`` names it in messages; ``is_rounded`` accepts floats of more than 15 digits. Raises
    MethodError for other values, for a text with the position of the error.

    >>> rational_of(0.1, "h"), rational_of("1/3 - 1/4", "h")
    (1/10, 1/12)
    """
    if isinstance(x, fmpq):
        return x
    from garkcli.exact.domain import Domain  # most numbers need no parser
    from garkcli.exact.expression import parse

    text = number_text(x, where, is_rounded, EXACTLY)
    try:
        expression = parse(text)
        number = Domain([expression]).evaluate(expression)
    except ExpressionError as error:
        place = f"character {error.start + 1} of {text!r}"
        message = f"{where}: {error.message}, {place}"
        cure = error.help or "write a rational number, such as 1/4"
        raise MethodError(message, cure, code="not-a-number") from None
    if isinstance(number, Algebraic):
        cure = "give a rational number, such as '1/4'"
        raise MethodError(f"{where}: {text} is irrational", cure, code="arrays")
    return number
