r"""Numbers in LaTeX as texts of coefficients: ``\frac{1}{2} - \frac{\sqrt{3}}{6}``."""

from __future__ import annotations

import re

from garkcli.sources.found import Unreadable
from garkcli.sources.scalars import Scalar, Value, combined, negated, number, power, rooted, whole

MAX_CELL = 40_000
"""Longest text of a number."""
MAX_DEPTH = 30
"""Deepest nesting of braces and fractions."""
_IGNORED = re.compile(
    r"[$ \t\r\n]|\\(?:[,;:!> ]|quad|qquad|displaystyle|textstyle|left|right"
    r"|bigl?|bigr?|Bigl?|Bigr?|mathstrut)(?![A-Za-z])|\\[,;:! ]|~"
)
_ROOT_OF = re.compile(
    r"\\operatorname\{root\}\\left\(([-+0-9x^{} /]{1,4000}), *x *\\approx *"
    r"(-?[0-9.]{1,60})\\right\)"
)
"""The root of a polynomial nearest to a decimal, as gark writes it."""
_FACTOR = re.compile(r"([0-9])x")
_POWER = re.compile(r"\^\{([0-9]{1,2})\}")
_TOKEN = re.compile(
    r"(?P<number>[0-9]+(?:\.[0-9]*)?|\.[0-9]+)"
    r"|(?P<command>\\[A-Za-z]+)|(?P<sign>[-+*/^{}()\[\]]|−)"
)
_FRACTIONS = frozenset({r"\frac", r"\tfrac", r"\dfrac", r"\nicefrac", r"\sfrac", r"\cfrac"})
_PRODUCTS = frozenset({r"\cdot", r"\times", "*"})


def number_of(text: str) -> str:
    r"""The text of a coefficient.

    >>> number_of(r"\frac12-\frac{\sqrt{3}}{6}"), number_of(r"1.5 \cdot 10^{-16}")
    ('1/2 - sqrt(3)/6', '1.5*1e-16')

    Raises:
        Unreadable: it is no number.
    """
    if len(text) > MAX_CELL:
        raise Unreadable(f"a cell of more than {MAX_CELL} characters")
    roots: list[str] = []

    def noted(found: re.Match[str]) -> str:
        polynomial = _FACTOR.sub(r"\1*x", found[1])
        polynomial = _POWER.sub(r"**\1", polynomial)
        roots.append(f"root_of({polynomial}, {found[2]})")
        return f"\\rootof{{{len(roots) - 1}}}"

    value = _Parser(_ROOT_OF.sub(noted, text), roots).whole()
    if not isinstance(value, Scalar):
        raise Unreadable("this is no number")
    return value.text


class _Parser:
    """Recursive descent over one cell."""

    def __init__(self, text: str, roots: list[str]) -> None:
        self._roots = roots
        self._tokens: list[str] = []
        place = 0
        while place < len(text):
            ignored = _IGNORED.match(text, place)
            if ignored:
                place = ignored.end()
                continue
            found = _TOKEN.match(text, place)
            if found is None:
                raise Unreadable("a sign that no number has")
            self._tokens.append(found.group().replace("−", "-"))
            place = found.end()
        self._tokens.append("")
        self._place = 0
        self._depth = 0

    def whole(self) -> Value:
        value = self._sum()
        if self._next:
            raise Unreadable("more than one number")
        return value

    @property
    def _next(self) -> str:
        return self._tokens[self._place]

    def _advance(self) -> str:
        token = self._next
        if token:
            self._place += 1
        return token

    def _sum(self) -> Value:
        value = self._product()
        while self._next in {"+", "-"}:
            sign = self._advance()
            value = combined(sign, value, self._product())
        return value

    def _product(self) -> Value:
        value = self._factor()
        while True:
            if self._next in _PRODUCTS:
                self._advance()
                value = combined("*", value, self._factor())
            elif self._next == "/":
                self._advance()
                value = combined("/", value, self._factor())
            elif self._begins():
                value = combined("*", value, self._factor())
            else:
                return value

    def _begins(self) -> bool:
        token = self._next
        if not token:
            return False
        is_number = token[0].isdigit() or token[0] == "."
        return is_number or token in {"(", "{", r"\sqrt", r"\rootof", *_FRACTIONS}

    def _factor(self) -> Value:
        self._depth += 1
        if self._depth > MAX_DEPTH:
            raise Unreadable(f"nested more than {MAX_DEPTH} deep")
        try:
            if self._next == "-":
                self._advance()
                return negated(self._factor())
            if self._next == "+":
                self._advance()
                return self._factor()
            base = self._atom()
            if self._next == "^":
                self._advance()
                return power(base, self._argument())
            return base
        finally:
            self._depth -= 1

    def _atom(self) -> Value:
        token = self._advance()
        if token in _FRACTIONS:
            top = self._argument()
            return combined("/", top, self._argument())
        if token == r"\sqrt":
            return self._root()
        if token == r"\rootof":
            return self._root_of()
        if token in {"(", "{"}:
            value = self._sum()
            self._close(")" if token == "(" else "}")
            return value
        if token and (token[0].isdigit() or token[0] == "."):
            return number(f"0{token}" if token[0] == "." else token)
        raise Unreadable("a number is expected")

    def _root_of(self) -> Value:
        """A root of a polynomial, by its number among those of the cell."""
        place = whole(self._argument())
        if place is None or place >= len(self._roots):
            raise Unreadable("a root that is not there")
        return Scalar(self._roots[place])

    def _root(self) -> Value:
        index = 2
        if self._next == "[":
            self._advance()
            index = whole(self._sum()) or 0
            self._close("]")
        if index < 2:
            raise Unreadable("a root of no index")
        return rooted(self._argument(), index)

    def _argument(self) -> Value:
        r"""What stands in braces, or one sign: \frac12."""
        self._depth += 1
        if self._depth > MAX_DEPTH:
            raise Unreadable(f"nested more than {MAX_DEPTH} deep")
        token = self._next
        if token == "{":
            self._advance()
            value = self._sum()
            self._close("}")
        elif len(token) > 1 and token.isdigit():
            self._tokens[self._place] = token[1:]
            value = number(token[0])
        else:
            value = self._atom()
        self._depth -= 1
        return value

    def _close(self, closer: str) -> None:
        if self._advance() != closer:
            raise Unreadable(f"{closer} is expected")
