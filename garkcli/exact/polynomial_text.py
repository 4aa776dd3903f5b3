"""Polynomials and real algebraic numbers as text."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

from flint import arb, fmpq, fmpz

from garkcli.exact.display import BITS_OF_A_DIGIT, to_ball
from garkcli.exact.domain import square_free
from garkcli.exact.field import Algebraic, Number
from garkcli.exact.multivariate import Multivariate
from garkcli.exact.parametric import Parametric
from garkcli.exact.polynomial import Polynomial
from garkcli.exact.roots import RealRoot

LONG_COEFFICIENT = 16
"""Longer rational numbers are decimals where these are enough."""


def integral(polynomials: Sequence[Polynomial]) -> list[Polynomial]:
    """Polynomials with one positive factor to coprime integers; unchanged if one is irrational.

    >>> integral([Polynomial([2, fmpq(-11, 12)]), Polynomial([1, fmpq(1, 24)])])
    [Polynomial([48, -22]), Polynomial([24, 1])]
    """
    scale = integral_scale(a for p in polynomials for a in p.coefficients)
    return [p * scale for p in polynomials]


def integral_scale(numbers: Iterable[Number]) -> fmpq:
    """The positive factor that makes rational numbers coprime integers; 1 if one is irrational."""
    denominator, content = fmpz(1), fmpz(0)
    for a in numbers:
        if not isinstance(a, fmpq):
            return fmpq(1)
        # gcd(a, p/q) = gcd(...)/lcm(q) for numbers in lowest terms
        denominator = denominator.lcm(a.q)
        content = content.gcd(a.p)
    if not content:
        return fmpq(1)
    return fmpq(denominator, content)


def polynomial_text(p: Polynomial, variable: str) -> str:
    return sum_text([(a, power_text(variable, k)) for k, a in enumerate(p.coefficients)][::-1])


def polynomial_decimals(p: Polynomial, variable: str, digits: int = 8) -> str:
    """A polynomial with coefficients rounded to decimals, without trailing zeros."""
    powers = reversed([*enumerate(p.coefficients)])
    return sum_text([(_rounded(a, digits), power_text(variable, k)) for k, a in powers])


def _rounded(a: Number, digits: int) -> str:
    return ball_decimal(to_ball(a, digits + 4), digits) if a else ""


def is_long(a: Number) -> bool:
    """Whether a rational number, or one in a sum of roots, has many digits."""
    rationals = [x for x, _ in a.terms()] if isinstance(a, Algebraic) else [a]
    return any(len(str(x)) > LONG_COEFFICIENT for x in rationals)


def has_long_coefficients(*polynomials: Polynomial) -> bool:
    return any(is_long(a) for p in polynomials for a in p.coefficients)


def multivariate_decimals(p: Multivariate, variables: Sequence[str], digits: int = 8) -> str:
    return sum_text((_rounded(a, digits), power) for a, power in _terms(p, variables))


def multivariate_text(p: Multivariate, variables: Sequence[str]) -> str:
    """Writes a polynomial in several variables, the highest total degree first."""
    return sum_text(_terms(p, variables))


def _terms(p: Multivariate, variables: Sequence[str]) -> Iterator[tuple[Number, str]]:
    for exponents, a in p.terms:
        powers = [power_text(x, k) for x, k in zip(variables, exponents, strict=True) if k]
        yield a, "*".join(powers)


def sum_text(terms: Iterable[tuple[Number | Parametric | str, str]]) -> str:
    text = ""
    for a, power in terms:
        if not a:
            continue
        factor = str(a)
        is_negative = factor.startswith("-") and " " not in factor
        factor = f"({factor})" if " " in factor else factor.removeprefix("-")
        text += " - " if is_negative else " + "
        text += power if power and factor == "1" else "*".join(filter(None, [factor, power]))
    if text.startswith(" - "):
        return "-" + text.removeprefix(" - ")
    return text.removeprefix(" + ") or "0"


def power_text(variable: str, k: int, exponent: str = "") -> str:
    if k == 0:
        return ""
    if k == 1:
        return variable
    return f"{variable}^{exponent or k}"


def root_text(root: RealRoot) -> str | None:
    """A rational or quadratic root in radicals; None for others.

    >>> from flint import fmpz_poly
    >>> root_text(RealRoot(fmpz_poly([-1, -1, 1]), 1))
    '1/2 + sqrt(5)/2'
    """
    if root.exact is not None:
        return str(root.exact)
    if root.polynomial.degree() != 2:
        return None
    c, b, a = (fmpq(x) for x in root.polynomial.coeffs())
    middle = -b / (2 * a)
    radicand = middle * middle - c / a
    d = square_free(radicand)
    scale = (radicand / d).sqrt()
    radical = f"sqrt({d})"
    if scale.p != 1:
        radical = f"{scale.p}*{radical}"
    if scale.q != 1:
        radical += f"/{scale.q}"
    is_lower = root.number == 0
    if not middle:
        return f"-{radical}" if is_lower else radical
    sign = "-" if is_lower else "+"
    return f"{middle} {sign} {radical}"


def root_in_short(root: RealRoot) -> str:
    """A rational or quadratic root in radicals, else decimals with the polynomial.

    >>> from flint import fmpz_poly
    >>> root_in_short(RealRoot(fmpz_poly([-12, 6, -3, 1]), 0))
    '2.51274532662, a root of x^3 - 3*x^2 + 6*x - 12'
    """
    simple = root_text(root)
    if simple is not None:
        return simple
    polynomial = Polynomial([fmpq(a) for a in root.polynomial.coeffs()])
    return f"{root_decimal(root, 12)}, a root of {polynomial_text(polynomial, 'x')}"


def root_decimal(root: RealRoot, digits: int) -> str:
    return ball_decimal(root.ball(int(digits * BITS_OF_A_DIGIT) + 40), digits)


def ball_decimal(ball: arb, digits: int) -> str:
    text = str(ball.str(digits, radius=False))
    if "e" in text or "." not in text:
        return text
    return text.rstrip("0").rstrip(".")
