"""Numbers of other languages as texts of coefficients: put together as text, never computed."""

from __future__ import annotations

from typing import TypeAlias, Union

from garkcli.errors import ExpressionError
from garkcli.exact.expression import parse
from garkcli.exact.polynomial import Polynomial
from garkcli.exact.polynomial_text import root_decimal
from garkcli.exact.root_of import polynomial_in_x
from garkcli.exact.roots import real_roots
from garkcli.frozen import Frozen
from garkcli.sources.found import MAX_LENGTH, Unreadable

SUM, PRODUCT, ATOM = range(3)
"""How tightly the parts of a text hold together."""
LEVELS = {"+": SUM, "-": SUM, "*": PRODUCT, "/": PRODUCT, "^": ATOM}
ROOTS = {"sqrt": "sqrt", "cbrt": "cbrt", "root": "root"}


class Scalar(Frozen):
    """A number as text, and how tightly it holds together."""

    text: str
    level: int = ATOM

    def inside(self, level: int) -> str:
        """The text as an operand of something that holds together like ``level``."""
        return self.text if self.level >= level else f"({self.text})"


class Unknown:
    """What stands somewhere and cannot be read: it is no number, and not nothing either."""


UNKNOWN = Unknown()
Value: TypeAlias = Union[Scalar, "list[Value]", str, Unknown, None]
"""A number, a list of values, words in quotes, what cannot be read, nothing (NULL)."""


def number(text: str) -> Scalar:
    """A number as it is written; one with a sign holds together like a sum."""
    return Scalar(text, SUM if text.startswith("-") else ATOM)


def of_text(text: str) -> Scalar:
    """The number that stands between quotes: ``Fraction("1/3")``.

    >>> of_text("0.5"), of_text("1/3").text
    (Scalar(text='0.5', level=2), '(1/3)')
    """
    plain = text.strip()
    if plain.replace(".", "", 1).isdigit():
        return number(plain)
    return _checked(f"({plain})", ATOM)


def transposed(value: Value) -> Value:
    """A matrix with its rows as columns; a row as a column.

    Raises:
        Unreadable: it has no rows of one length.
    """
    if not isinstance(value, list):
        return value
    if is_row(value):
        return [[x] for x in value]
    rows = [row for row in value if isinstance(row, list)]
    lengths = {len(row) for row in rows}
    if len(rows) != len(value) or len(lengths) != 1:
        raise Unreadable("a transpose of what is no matrix")
    if lengths == {1}:
        return [row[0] for row in rows]
    return [list(column) for column in zip(*rows, strict=True)]


def combined(sign: str, left: Value, right: Value) -> Value:
    """The value of two operands; a list is divided and multiplied entry by entry.

    >>> combined("/", number("1"), Scalar("1+2", SUM)).text
    '1/(1+2)'

    Raises:
        Unreadable: they do not go together.
    """
    if isinstance(left, list) and isinstance(right, list):
        if sign in "*/^" or len(left) != len(right):
            raise Unreadable("an operation on lists")
        pairs = zip(left, right, strict=True)
        return [combined(sign, x, y) for x, y in pairs]
    if isinstance(left, list) and sign in "*/":
        return [combined(sign, x, right) for x in left]
    if isinstance(right, list) and sign == "*":
        return [combined(sign, left, x) for x in right]
    if not isinstance(left, Scalar) or not isinstance(right, Scalar):
        raise Unreadable("an operation on what is no number")
    return _combined(sign, left, right)


def _combined(sign: str, left: Scalar, right: Scalar) -> Scalar:
    level = LEVELS[sign]
    if sign == "^":
        base = left.inside(ATOM)
        if base == "10":
            # 1.5 \cdot 10^{-16}
            return Scalar(f"1e{_exponent(right)}")
        return _checked(f"{base}**{_exponent(right)}", PRODUCT)
    before = left.inside(level)
    # a − (b − c) and a/(b/c) need their parentheses
    after = right.inside(level + 1)
    spaced = f" {sign} " if level == SUM else sign
    return _checked(f"{before}{spaced}{after}", level)


def _exponent(exponent: Scalar) -> str:
    """A whole number; ``2.0`` is one."""
    text = exponent.text.strip("() ")
    whole, point, rest = text.partition(".")
    if point and not rest.strip("0"):
        text = whole
    if not text.lstrip("+-").isdigit():
        raise Unreadable("a power that is no whole number")
    return text


def power(base: Value, exponent: Value) -> Value:
    """A power; those to 1/2 and 1/3 are roots.

    Raises:
        Unreadable: it is none that a coefficient may have.
    """
    if isinstance(base, Scalar) and isinstance(exponent, Scalar):
        plain = exponent.text.strip("() ").replace(" ", "")
        index = _INDICES.get(plain)
        if index:
            return rooted(base, index)
    return combined("^", base, exponent)


_INDICES = {
    "1/2": 2,
    "0.5": 2,
    "1.0/2": 2,
    "1.0/2.0": 2,
    "1/3": 3,
    "1.0/3": 3,
    "1.0/3.0": 3,
    "1/4": 4,
    "1/5": 5,
}


def rooted(radicand: Value, index: int) -> Scalar:
    """A root.

    Raises:
        Unreadable: it is that of no number.
    """
    if not isinstance(radicand, Scalar):
        raise Unreadable("a root of what is no number")
    inner = radicand.text
    names = {2: f"sqrt({inner})", 3: f"cbrt({inner})"}
    return _checked(names.get(index, f"root({inner}, {index})"), ATOM)


def negated(value: Value) -> Value:
    """The same with its sign changed.

    Raises:
        Unreadable: it has none.
    """
    if isinstance(value, list):
        return [negated(x) for x in value]
    if not isinstance(value, Scalar):
        raise Unreadable("a sign before what is no number")
    return _checked(f"-{value.inside(PRODUCT)}", SUM)


def real_root(polynomial: Value, number: Value) -> Scalar:
    """A real root of a polynomial in x, by its number from 1 in ascending order.

    Raises:
        Unreadable: there is none.
    """
    place = whole(number)
    if not isinstance(polynomial, Scalar) or place is None:
        raise Unreadable("a root of what is no polynomial")
    try:
        found = Polynomial.from_flint(polynomial_in_x(parse(polynomial.text)))
        roots = [root for root, _ in real_roots(found)]
    except ExpressionError as error:
        raise Unreadable(error.message) from None
    if not 0 < place <= len(roots):
        raise Unreadable("a root that is not real")
    near = root_decimal(roots[place - 1], DIGITS_OF_ROOTS)
    return _checked(f"root_of({polynomial.text}, {near})", ATOM)


DIGITS_OF_ROOTS = 30
"""Of the decimal that tells a root from the others."""


def _checked(text: str, level: int) -> Scalar:
    if len(text) > MAX_LENGTH:
        raise Unreadable(f"a number of more than {MAX_LENGTH} characters")
    return Scalar(text, level)


def is_matrix(value: Value) -> bool:
    """Whether it is a list of lists of numbers."""
    if not isinstance(value, list) or not value:
        return False
    return all(isinstance(row, list) for row in value)


def is_row(value: Value) -> bool:
    """Whether it is a list of numbers."""
    if not isinstance(value, list) or not value:
        return False
    return all(isinstance(x, Scalar) for x in value)


def row_of(value: Value) -> tuple[str, ...]:
    """The texts of a list of numbers.

    Raises:
        Unreadable: it is none.
    """
    if not isinstance(value, list):
        raise Unreadable("a list of numbers is expected")
    texts = []
    for x in value:
        if not isinstance(x, Scalar):
            raise Unreadable("a list of numbers is expected")
        texts.append(x.text)
    return tuple(texts)


def rows_of(value: Value) -> tuple[tuple[str, ...], ...]:
    """The texts of a list of lists of numbers.

    Raises:
        Unreadable: it is none.
    """
    if not isinstance(value, list):
        raise Unreadable("a matrix is expected")
    return tuple(row_of(row) for row in value)


def whole(value: Value) -> int | None:
    """A whole number that is written as such; None for anything else."""
    if not isinstance(value, Scalar):
        return None
    text = value.text
    is_short = len(text) < 6
    return int(text) if is_short and text.lstrip("-").isdigit() else None
