"""Parses coefficients: the few signs they may be written with, and nothing that could run.

The grammar, with ``^`` meaning ``**``::

    sum      = term { ("+" | "-") term }
    term     = factor { ("*" | "/") factor }
    factor   = ("+" | "-") factor | power
    power    = atom [ "**" ["+" | "-"] integer ]
    atom     = number | name | function "(" sum [ "," integer ] ")" | "(" sum ")"
             | "√" atom | "root_of" "(" sum "," sum ")"
    function = "sqrt" | "cbrt" | "root"

Numbers are read as written: ``0.1`` is one tenth. ``garkcli.exact.formula`` extends the grammar for
problems.
"""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Callable, Iterator
from typing import ClassVar, NoReturn

from flint import fmpq

from garkcli.errors import ExpressionError, LimitExceeded
from garkcli.exact.nodes import Chain, Expression, Literal, Name, Power, Root

MAX_LENGTH = 20_000
"""Longest text of one coefficient, in characters."""
MAX_DEPTH = 60
"""Deepest nesting of parentheses, signs and functions."""
MAX_DIGITS = 1_000
"""Most digits of one number with its decimal exponent written out."""
MAX_EXPONENT = 64
MAX_ROOT = 12


_TOKEN = re.compile(
    r"[ \t\r\n]*(?:(?P<number>(?:[0-9]+(?:\.[0-9]*)?|\.[0-9]+)(?:[eE][+-]?[0-9]+)?)"
    r"|(?P<name>[A-Za-z_][A-Za-z_0-9]*)|(?P<op>\*\*|[-+*/^(),]|√)|(?P<end>$))"
)
ROOT_SIGN = "√"
INDEX_OF_ROOT = {"sqrt": 2, "cbrt": 3}
_SIGN_CURES = dict.fromkeys("−–—", "use the sign - (hyphen)") | {
    **dict.fromkeys("\N{FRACTION SLASH}\N{DIVISION SLASH}\N{DIVISION SIGN}", "use the sign /"),
    "\N{VULGAR FRACTION ONE THIRD}": "write 1/3",
    "\N{VULGAR FRACTION ONE QUARTER}": "write 1/4",
    "³": "write x**3",
    "½": "write 1/2",
    "²": "write x**2",
    "·": "use the sign *",
    "×": "use the sign *",
}
FUNCTIONS = frozenset({*INDEX_OF_ROOT, "root", "root_of"})
"""Names that parameters cannot have."""


def named_sign(sign: str) -> str:
    """A sign in quotes, beyond ASCII with its number and name: many look like a sign of ASCII.

    >>> named_sign("["), named_sign("−")
    ("'['", "'−' (U+2212, minus sign)")
    """
    name = unicodedata.name(sign, "").lower()
    if sign.isascii() or not name:
        return repr(sign)
    return f"{sign!r} (U+{ord(sign):04X}, {name})"


def parse(text: str) -> Expression:
    """Parses ``text``; raises ExpressionError with its offset, LimitExceeded beyond a limit above.

    >>> parse("1/2 - sqrt(3)/6").signs
    '+-'
    """
    return Parser(text).whole()


class Parser:
    """Recursive descent over the tokens of one text; subclasses extend the grammar.

    ``noun`` and ``value_noun`` name the text and its operands in messages; ``example`` is the cure
    for an empty text, ``cure`` lists the allowed signs, ``functions`` is the cure for an unknown
    function.
    """

    noun: ClassVar[str] = "coefficient"
    value_noun: ClassVar[str] = "number"
    example: ClassVar[str] = "write a number, such as 1/2"
    cure: ClassVar[str] = (
        "write digits 0-9, + - * / ** ( ), sqrt(x), cbrt(x), root(x, n), root_of(p, r)"
    )
    functions: ClassVar[str] = "there are sqrt(x), cbrt(x), root(x, n) and root_of(p, r)"

    def __init__(self, text: str) -> None:
        if len(text) > MAX_LENGTH:
            message = f"a {self.noun} of {len(text)} characters (limit {MAX_LENGTH})"
            raise LimitExceeded(message, "write it shorter", 0, MAX_LENGTH)
        self.text = text
        self.depth = 0
        self.tokens = self._tokens()
        self.kind, self.value, self.start, self.end = next(self.tokens)
        self.last_end = 0

    def _tokens(self) -> Iterator[tuple[str, str, int, int]]:
        position = 0
        while True:
            match = _TOKEN.match(self.text, position)
            if match is None:
                rest = self.text[position:]
                offset = position + len(rest) - len(rest.lstrip(" \t\r\n"))
                sign = self.text[offset]
                cure = _SIGN_CURES.get(sign, self.cure)
                message = f"the sign {named_sign(sign)} is not allowed in a {self.value_noun}"
                raise ExpressionError(message, cure, offset, offset + 1, code="not-a-number")
            kind = match.lastgroup or "end"
            start, end = match.span(kind)
            yield kind, match.group(kind), start, end
            position = end

    def _advance(self) -> str:
        value, self.last_end = self.value, self.end
        if self.kind != "end":
            self.kind, self.value, self.start, self.end = next(self.tokens)
        return value

    def _fail(self, message: str, cure: str = "") -> NoReturn:
        end = max(self.end, self.start + 1)
        raise ExpressionError(message, cure, self.start, end, code="not-a-number")

    def _expect(self, sign: str, opened: int) -> None:
        if self.value != sign:
            actual = "the end" if self.kind == "end" else repr(self.value)
            self._fail(
                f"{sign!r} expected, {actual} found",
                f"the parenthesis at column {opened + 1} is open",
            )
        self._advance()

    def whole(self) -> Expression:
        if self.kind == "end":
            self._fail(f"no {self.value_noun} here", self.example)
        result = self._sum()
        if self.kind != "end":
            is_factor = self.kind in {"name", "number"} or self.value in {"(", ROOT_SIGN}
            cure = "write products with *" if is_factor else ""
            if self.value == ",":
                cure = "write decimals with a point: 0.5"
            self._fail(f"unexpected {self.value!r}", cure)
        return result

    def _sum(self) -> Expression:
        return self._chain("+-", self._term)

    def _term(self) -> Expression:
        return self._chain("*/", self._factor)

    def _chain(self, signs: str, operand: Callable[[], Expression]) -> Expression:
        start = self.start
        joined, operands = signs[0], [operand()]
        while self.kind == "op" and self.value in {signs[0], signs[1]}:
            joined += self._advance()
            operands.append(operand())
        if len(operands) == 1:
            return operands[0]
        return Chain(joined, tuple(operands), start=start, end=self.last_end)

    def _factor(self) -> Expression:
        self.depth += 1
        if self.depth > MAX_DEPTH:
            message = f"nested more than {MAX_DEPTH} deep"
            raise LimitExceeded(
                message, "write it flatter", self.start, self.start + 1, code="file-too-large"
            )
        try:
            if self.kind == "op" and self.value in {"+", "-"}:
                start = self.start
                sign = self._advance()
                inner = self._factor()
                if sign == "+":
                    return inner
                end = self.last_end
                if isinstance(inner, Literal):
                    return Literal(-inner.value, start=start, end=end, text=inner.text)
                return Chain("-", (inner,), start=start, end=end)
            return self._power()
        finally:
            self.depth -= 1

    def _power(self) -> Expression:
        start = self.start
        base = self._atom()
        if self.kind != "op" or self.value not in {"**", "^"}:
            return base
        self._advance()
        negative = False
        if self.kind == "op" and self.value in {"+", "-"}:
            negative = self._advance() == "-"
        power = self._raised(base, negative, start)
        if self.kind == "op" and self.value in {"**", "^"}:
            self._fail("a power of a power", "use parentheses and small exponents")
        return power

    def _raised(self, base: Expression, is_negative: bool, start: int) -> Expression:
        """Parses an exponent without its sign and returns the power of ``base``."""
        exponent = self._integer("an exponent", MAX_EXPONENT)
        if is_negative:
            exponent = -exponent
        return Power(base, exponent, start=start, end=self.last_end)

    def _integer(self, what: str, limit: int) -> int:
        if self.kind != "number" or not self.value.isdigit():
            self._fail(
                f"{what} is a small whole number", "for roots write sqrt(…), cbrt(…) or root(…, n)"
            )
        if len(self.value) > 4 or int(self.value) > limit:
            message = f"{what} is larger than {limit}"
            raise LimitExceeded(message, "use a smaller one", self.start, self.end)
        return int(self._advance())

    def _atom(self) -> Expression:
        start = self.start
        if self.kind == "number":
            text = self._advance()
            return Literal(read_decimal(text, start), start=start, end=self.last_end, text=text)
        if self.kind == "name":
            name = self._advance()
            if self.value == "(":
                return self._function(name, start)
            return Name(name, start=start, end=self.last_end)
        if self.value == "(":
            self._advance()
            inner = self._sum()
            self._expect(")", start)
            return inner
        if self.value == ROOT_SIGN:
            self.depth += 1
            if self.depth > MAX_DEPTH:
                message = f"nested more than {MAX_DEPTH} deep"
                raise LimitExceeded(
                    message, "write it flatter", start, start + 1, code="file-too-large"
                )
            self._advance()
            radicand = self._atom()
            self.depth -= 1
            return Root(radicand, 2, start=start, end=self.last_end)
        if self.kind == "end":
            self._fail(f"the text ends where a {self.value_noun} is expected")
        return self._fail(f"a {self.value_noun} is expected here")

    def _function(self, name: str, start: int) -> Expression:
        if name not in FUNCTIONS:
            raise ExpressionError(
                f"{name!r} is not a function of {self.noun}s",
                self.functions,
                start,
                self.last_end,
                code="unknown-function",
            )
        opened = self.start
        self._advance()
        radicand = self._sum()
        if name == "root_of":
            from garkcli.exact.root_of import root_nearest  # few methods have such roots

            self._expect(",", opened)
            near = self._sum()
            self._expect(")", opened)
            return root_nearest(radicand, near, start, self.last_end)
        index = INDEX_OF_ROOT.get(name, 0)
        if not index:
            self._expect(",", opened)
            index = self._integer("the index of a root", MAX_ROOT)
            if index < 2:
                self._fail("the index of a root is 2 or more")
        self._expect(")", opened)
        return Root(radicand, index, start=start, end=self.last_end)


def read_decimal(text: str, start: int = 0) -> fmpq:
    """The exact value of a decimal.

    >>> read_decimal("0.1"), read_decimal("25e-3")
    (1/10, 1/40)
    """
    mantissa, _, exponent = text.lower().partition("e")
    whole, _, fraction = mantissa.partition(".")
    shift = 0
    if exponent:
        # An exponent of eight signs is beyond the limit and not read.
        shift = int(exponent) if len(exponent) < 8 else MAX_DIGITS + 1
    digits = len(whole) + len(fraction)
    if digits + abs(shift) > MAX_DIGITS:
        message = f"a number of more than {MAX_DIGITS} digits"
        raise LimitExceeded(message, "write fewer digits", start, start + len(text))
    digits = int(whole + fraction)
    scale = shift - len(fraction)
    if scale >= 0:
        return fmpq(digits * 10**scale)
    return fmpq(digits, 10**-scale)
