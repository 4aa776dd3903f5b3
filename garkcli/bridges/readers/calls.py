"""What functions in sources mean: roots, wrappers that pass a number on."""

from __future__ import annotations

from collections.abc import Sequence

from garkcli.bridges.readers.lexing import Token
from garkcli.sources.allowance import Allowance
from garkcli.sources.found import Unreadable
from garkcli.sources.scalars import (
    Scalar,
    Value,
    combined,
    of_text,
    power,
    real_root,
    rooted,
    whole,
)


def passed_on(name: str, values: Sequence[Value]) -> Value:
    """What a type, a rounding or a wrapper passes on: a list, else a number, else a text.

    Raises:
        Unreadable: it has none of these.
    """
    lists = [value for value in values if isinstance(value, list)]
    if lists:
        return lists[-1]
    numbers = [value for value in values if isinstance(value, Scalar)]
    if numbers:
        return numbers[0]
    words = [value for value in values if isinstance(value, str)]
    if words:
        return of_text(words[0])
    raise Unreadable(f"{name} of what is no number")


def root_value(kind: str, values: Sequence[Value]) -> Value:
    if kind == "sqrt" and len(values) == 1:
        return rooted(values[0], 2)
    if kind == "cbrt" and len(values) == 1:
        return rooted(values[0], 3)
    if kind == "power" and len(values) == 2:
        return power(values[0], values[1])
    if kind == "rational" and len(values) == 2:
        return combined("/", values[0], values[1])
    if kind == "root" and len(values) == 2:
        index = whole(values[1])
        if index is not None and index > 1:
            return rooted(values[0], index)
    if kind == "algebraic" and len(values) == 2:
        return real_root(values[0], values[1])
    raise Unreadable("a function with other arguments than it has")


def end_of_argument(tokens: Sequence[Token], place: int, allowance: Allowance) -> int:
    """The place of the comma or bracket behind what cannot be read.

    Raises:
        Unreadable: there is none.
    """
    open_brackets = 0
    for end in range(place, len(tokens)):
        allowance.read_again(1)
        token = tokens[end]
        is_sign = token.kind == "sign"
        if is_sign and token.text in _OPENERS:
            open_brackets += 1
        elif is_sign and token.text in _CLOSERS:
            open_brackets -= 1
            if open_brackets < 0:
                return end
        elif not open_brackets and token.text in {",", ";"}:
            return end
    raise Unreadable("a bracket is not closed")


_OPENERS = frozenset("([{")
_CLOSERS = frozenset(")]}")
