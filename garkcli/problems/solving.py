"""One equation for one unknown, in closed form: candidates for solutions, to be tested by who
asks.
"""

from __future__ import annotations

from typing import Any

MAX_SIZE = 300
"""Most operations of an equation that is solved."""


def solutions(f: Any, u: Any, c: Any) -> list[Any]:
    """Expressions for u that may solve f(u) = c; some do not, and some solutions are not found.

    Functions that hold u alone are undone from outside in; what is left is solved where it is a
    polynomial of degree 1 or 2 in u or in u², be it after a square root has been squared away.

    Args:
        f: a sympy expression in u.
        u: a symbol.
        c: the right-hand side, free of u.

    >>> from sympy.abc import u, c
    >>> solutions(1 + 2 * u**2, u, c)
    [sqrt(c/2 - 1/2), -sqrt(c/2 - 1/2)]
    """
    import sympy

    if u not in f.free_symbols or f.count_ops() > MAX_SIZE:
        return []
    if f == u:
        return [c]
    if f.is_Add or f.is_Mul:
        free, rest = f.as_independent(u, as_Add=f.is_Add)
        if free != (0 if f.is_Add else 1):
            return solutions(rest, u, c - free if f.is_Add else c / free)
    found: list[Any] = []
    inner = [x for x in f.args if u in x.free_symbols]
    if len(inner) == 1:
        for value in _undone(f, inner[0], c):
            found += solutions(inner[0], u, value)
    if not found:
        found = _by_polynomial(sympy.together(f - c), u)
    return found


def _undone(f: Any, inner: Any, c: Any) -> list[Any]:
    """The values of ``inner`` with which f = c."""
    import sympy

    if f.is_Pow and f.base == inner and f.exp.is_Rational:
        root = c ** (1 / f.exp)
        if f.exp.p % 2 == 0:
            return [root, -root]
        return [root, -((-c) ** (1 / f.exp))] if f.exp.q % 2 else [root]
    if f.is_Pow and f.exp == inner:
        return [sympy.log(c) / sympy.log(f.base)]
    inverses = {
        "exp": lambda: [sympy.log(c)],
        "log": lambda: [sympy.exp(c)],
        "sin": lambda: [sympy.asin(c)],
        "cos": lambda: [sympy.acos(c), -sympy.acos(c)],
        "tan": lambda: [sympy.atan(c)],
        "asin": lambda: [sympy.sin(c)],
        "acos": lambda: [sympy.cos(c)],
        "atan": lambda: [sympy.tan(c)],
        "sinh": lambda: [sympy.log(c + sympy.sqrt(c**2 + 1))],
        "cosh": lambda: [sympy.log(c + sympy.sqrt(c**2 - 1)), sympy.log(c - sympy.sqrt(c**2 - 1))],
        "tanh": lambda: [sympy.log((1 + c) / (1 - c)) / 2],
    }
    name = type(f).__name__
    return inverses[name]() if name in inverses else []


def _by_polynomial(f: Any, u: Any) -> list[Any]:
    """The zeros of a fraction: its numerator is a polynomial in u of small degree, with one square
    root at most.
    """
    import sympy

    numerator = f.as_numer_denom()[0]
    roots = [
        x
        for x in numerator.atoms(sympy.Pow)
        if u in x.free_symbols and x.exp.is_Rational and x.exp.q == 2
    ]
    if roots:
        base = roots[0].base
        if any(x.base != base for x in roots):
            return []
        r = sympy.Dummy("r")
        replaced = numerator.xreplace({x: r**x.exp.p for x in roots})
        even, odd = _parts(sympy.together(replaced).as_numer_denom()[0], r, base)
        if even is None:
            return []
        numerator = even**2 - base * odd**2
    try:
        polynomial = sympy.Poly(sympy.expand(numerator), u)
    except sympy.PolynomialError:
        return []
    coefficients = dict(polynomial.terms())
    if any(u in x.free_symbols for x in coefficients.values()):
        return []
    degrees = {n for (n,) in coefficients}
    if degrees <= {0, 1, 2}:
        return _quadratic(*(coefficients.get((n,), sympy.Integer(0)) for n in (2, 1, 0)))
    if degrees <= {0, 2, 4}:
        squares = _quadratic(*(coefficients.get((n,), sympy.Integer(0)) for n in (4, 2, 0)))
        return [sign * sympy.sqrt(x) for x in squares for sign in (1, -1)]
    return []


def _parts(f: Any, r: Any, square: Any) -> tuple[Any, Any]:
    """P and Q with f = P + r Q where r² is ``square``; None where f is no polynomial in r."""
    import sympy

    try:
        terms = sympy.Poly(sympy.expand(f), r).terms()
    except sympy.PolynomialError:
        return None, None
    even, odd = (
        sympy.Add(*(c * square ** (n // 2) for (n,), c in terms if n % 2 == k)) for k in (0, 1)
    )
    return even, odd


def _quadratic(a: Any, b: Any, c: Any) -> list[Any]:
    import sympy

    if a == 0:
        return [-c / b] if b != 0 else []
    root = sympy.sqrt(b**2 - 4 * a * c)
    return [(-b + root) / (2 * a), (-b - root) / (2 * a)]
