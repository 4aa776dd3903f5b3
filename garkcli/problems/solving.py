"""Solves one equation for one unknown in closed form: candidates that the caller has to test."""

from __future__ import annotations

from garkcli.problems.expr import Expr

MAX_SIZE = 300


def solutions(f: Expr, u: Expr, c: Expr) -> list[Expr]:
    """Returns candidates for u with f(u) = c; some are wrong, and some solutions may be missing.

    Functions of u are inverted from outside in; the rest is solved if it has degree 1 or 2 in u or
    u², possibly after squaring away a square root.

    >>> from sympy.abc import u, c
    >>> solutions(1 + 2 * u**2, u, c)
    [sqrt(c/2 - 1/2), -sqrt(c/2 - 1/2)]
    """
    import sympy

    if u not in f.free_symbols or f.count_ops() > MAX_SIZE:
        return []
    if f == u:
        return [c]
    if f.is_Add:
        free, rest = f.as_independent(u, as_Add=True)
        if free != 0:
            return solutions(rest, u, c - free)
    if f.is_Mul:
        free, rest = f.as_independent(u, as_Add=False)
        if free != 1:
            return solutions(rest, u, c / free)
    roots: list[Expr] = []
    inner = [x for x in f.args if u in x.free_symbols]
    if len(inner) == 1:
        for value in _undone(f, inner[0], c):
            roots += solutions(inner[0], u, value)
    if not roots:
        roots = _by_polynomial(sympy.together(f - c), u)
    return roots


def _undone(f: Expr, inner: Expr, c: Expr) -> list[Expr]:
    import sympy

    if f.is_Pow and f.base == inner and f.exp.is_Rational:
        return _root(f.exp, c)
    if f.is_Pow and f.exp == inner:
        return [sympy.log(c) / sympy.log(f.base)]
    name = type(f).__name__
    if name in _INVERSES:
        return [getattr(sympy, _INVERSES[name])(c)]
    if name == "cos":
        angle = sympy.acos(c)
        return [angle, -angle]
    if name == "sinh":
        root = sympy.sqrt(c**2 + 1)
        return [sympy.log(c + root)]
    if name == "cosh":
        root = sympy.sqrt(c**2 - 1)
        return [sympy.log(c + root), sympy.log(c - root)]
    if name == "tanh":
        return [sympy.log((1 + c) / (1 - c)) / 2]
    return []


_INVERSES = {
    "exp": "log",
    "log": "exp",
    "sin": "asin",
    "tan": "atan",
    "asin": "sin",
    "acos": "cos",
    "atan": "tan",
}


def _root(exponent: Expr, c: Expr) -> list[Expr]:
    """The real x with x**exponent = c."""
    inverse = 1 / exponent
    root = c**inverse
    if exponent.p % 2 == 0:
        return [root, -root]
    if exponent.q % 2:  # an odd root: of a negative number too
        return [root, -((-c) ** inverse)]
    return [root]


def _by_polynomial(f: Expr, u: Expr) -> list[Expr]:
    """The zeros of a fraction whose numerator is a polynomial in u."""
    import sympy

    numerator, _ = f.as_numer_denom()
    numerator = _without_root(numerator, u)
    if numerator is None:
        return []
    try:
        polynomial = sympy.Poly(sympy.expand(numerator), u)
    except sympy.PolynomialError:
        return []
    coefficients = dict.fromkeys(range(5), sympy.Integer(0))
    degrees = set()
    for (n,), x in polynomial.terms():
        if u in x.free_symbols:
            return []
        degrees.add(n)
        coefficients[n] = x
    c0, c1, c2, _, c4 = (coefficients[n] for n in range(5))
    if degrees <= {0, 1, 2}:
        return _quadratic(c2, c1, c0)
    zeros = []
    if degrees <= {0, 2, 4}:
        for square in _quadratic(c4, c2, c0):
            root = sympy.sqrt(square)
            zeros += [root, -root]
    return zeros


def _without_root(f: Expr, u: Expr) -> Expr:
    """Returns P² − S Q² for f = P + Q √S; f if no root has u in it, None if f has no such form."""
    import sympy

    roots = []
    for x in f.atoms(sympy.Pow):
        is_root = x.exp.is_Rational and x.exp.q == 2
        if is_root and u in x.free_symbols:
            roots.append(x)
    if not roots:
        return f
    square = roots[0].base
    if any(x.base != square for x in roots):
        return None
    r = sympy.Dummy("r")
    numerator, _ = sympy.together(f.xreplace({x: r**x.exp.p for x in roots})).as_numer_denom()
    try:
        terms = sympy.Poly(sympy.expand(numerator), r).terms()
    except sympy.PolynomialError:
        return None
    parts: tuple[list[Expr], list[Expr]] = ([], [])  # of P and of Q
    for (n,), coefficient in terms:
        parts[n % 2].append(coefficient * square ** (n // 2))
    P, Q = (sympy.Add(*x) for x in parts)
    return P**2 - square * Q**2


def _quadratic(a: Expr, b: Expr, c: Expr) -> list[Expr]:
    import sympy

    if a == 0:
        return [-c / b] if b != 0 else []
    root = sympy.sqrt(b**2 - 4 * a * c)
    return [(-b + root) / (2 * a), (-b - root) / (2 * a)]
