"""Exact forms of decimals, proposed from their digits."""

from __future__ import annotations

import re
from decimal import Decimal

from flint import arb, ctx, fmpq, fmpq_poly

from garkcli.design.search.recognise import minimal_polynomial, rational
from garkcli.exact.display import decimal
from garkcli.exact.polynomial import Polynomial
from garkcli.exact.polynomial_text import polynomial_text, root_text
from garkcli.exact.roots import real_roots
from garkcli.frozen import Frozen
from garkcli.order.tolerance import rounded_up

FEWEST_DIGITS = 6
LAST_PLACES = 2
BITS_A_DIGIT = 3.3
"""Bits of a decimal digit, rounded down."""
MAX_DEGREE = 4
PRECISION = 4_000
"""Precision of comparisons with decimals, none of which has so many bits."""
MAX_DIGITS = 1_000
"""Longer decimals are left unchanged."""
_DECIMAL = re.compile(r"-?[0-9]*\.[0-9]*(?:e[-+]?[0-9]{1,3})?")


class Proposal(Frozen):
    """An exact form of a decimal, as text, and their distance as a decimal, rounded up."""

    printed: str
    exact: str
    distance: str


def significant_digits(text: str) -> int:
    """The number of significant digits of a decimal; 0 for other texts."""
    if not _DECIMAL.fullmatch(text) or not any(x.isdigit() for x in text):
        return 0
    return len("".join(map(str, Decimal(text).as_tuple().digits)).strip("0"))


def proposed(text: str) -> Proposal | None:
    """The shortest exact form of a decimal, if its digits support one.

    >>> proposed("0.78867513459481288").exact, proposed("0.3333333333333333").exact
    ('1/2 + sqrt(3)/6', '1/3')
    """
    digits = significant_digits(text)
    if not FEWEST_DIGITS <= digits <= MAX_DIGITS:
        return None
    value = fmpq(*Decimal(text).as_integer_ratio())
    form = exact_form(value, digits, text)
    return None if form is None else _near(text, value, *form)


def exact_form(value: fmpq, digits: int, text: str) -> tuple[str, arb | fmpq] | None:
    """The shortest exact number with these correct digits; ``text`` identifies a root."""
    bits = int(digits * BITS_A_DIGIT)
    with ctx.workprec(bits + 64):
        ball = arb(value).mid()
        fraction = rational(ball, bits)
        minimal = None if fraction is not None else minimal_polynomial(ball, bits)
    if fraction is not None:
        return str(fraction), fraction
    if minimal is None or not 1 < minimal.degree() <= MAX_DEGREE:
        return None
    polynomial = Polynomial.from_flint(fmpq_poly(minimal))
    roots = [root for root, _ in real_roots(polynomial)]
    if not roots:
        return None
    root = min(roots, key=lambda root: abs(root.ball(256) - value).mid())
    plain = polynomial_text(polynomial, "x").replace("^", "**")
    return root_text(root) or f"root_of({plain}, {text})", root.ball(PRECISION)


def _near(text: str, value: fmpq, exact: str, number: arb | fmpq) -> Proposal | None:
    unit = fmpq(10) ** int(Decimal(text).as_tuple().exponent)
    with ctx.workprec(PRECISION):
        distance = abs(arb(number) - arb(value))
        if not distance <= LAST_PLACES * unit:
            return None
        return Proposal(text, exact, decimal(rounded_up(distance)))
