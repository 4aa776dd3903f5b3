"""Numbers of other languages as texts of coefficients: combined as text, never computed."""

from __future__ import annotations

from garkcli.errors import ExpressionError
from garkcli.exact.expression import parse
from garkcli.exact.polynomial import Polynomial
from garkcli.exact.polynomial_text import root_decimal
from garkcli.exact.root_of import polynomial_in_x
from garkcli.exact.roots import real_roots
from garkcli.frozen import Frozen
from garkcli.sources.found import Unreadable

SUM, PRODUCT, ATOM = range(3)
"""Precedence of the parts of a text."""
LEVELS = {"+": SUM, "-": SUM, "*": PRODUCT, "/": PRODUCT}


class Scalar(Frozen):
    """A number as text, with its precedence."""

    text: str
    level: int = ATOM

    def inside(self, level: int) -> str:
        """The text as an operand of an operator with precedence ``level``."""
        return self.text if self.level >= level else f"({self.text})"


def number(text: str) -> Scalar:
    """A number as written: with a sign its precedence is that of a sum, a fraction has that of a
    product.
    """
    if text.startswith("-"):
        return Scalar(text, SUM)
    return Scalar(text, PRODUCT if "/" in text else ATOM)


def combined(sign: str, left: Scalar, right: Scalar) -> Scalar:
    """The text of a sum, a difference, a product or a quotient.

    >>> combined("/", number("1"), Scalar("1+2", SUM)).text
    '1/(1+2)'
    """
    level = LEVELS[sign]
    before = left.inside(level)
    # a − (b − c) and a/(b/c) need their parentheses
    after = right.inside(level + 1)
    spaced = f" {sign} " if level == SUM else sign
    return Scalar(f"{before}{spaced}{after}", level)


def rooted(radicand: Scalar, index: int) -> Scalar:
    inner = radicand.text
    names = {2: f"sqrt({inner})", 3: f"cbrt({inner})"}
    return Scalar(names.get(index, f"root({inner}, {index})"))


def negated(value: Scalar) -> Scalar:
    """The text of the value with the other sign."""
    return Scalar(f"-{value.inside(PRODUCT)}", SUM)


def real_root(polynomial: Scalar, place: int) -> Scalar:
    """A real root of a polynomial in x, by its number from 1 in ascending order.

    Raises:
        Unreadable: there is no such root.
    """
    try:
        parsed = Polynomial.from_flint(polynomial_in_x(parse(polynomial.text)))
        roots = [root for root, _ in real_roots(parsed)]
    except ExpressionError as error:
        raise Unreadable(error.message) from None
    if not 0 < place <= len(roots):
        raise Unreadable("a root that is not real")
    near = root_decimal(roots[place - 1], DIGITS_OF_ROOTS)
    return Scalar(f"root_of({polynomial.text}, {near})")


DIGITS_OF_ROOTS = 30
"""Digits of the decimal that identifies a root."""
