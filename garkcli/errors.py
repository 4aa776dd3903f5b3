"""Every mistake the program knows by name; nothing else reaches the command line.

GarkError                     what is wrong, and the cure
├── ExpressionError           a text that is no exact number; knows the offset of the fault
│   ├── LimitExceeded         … too long, too deep or too large to be a coefficient
│   └── UndefinedValue        … division by zero, an even root of a negative number, an unknown name
├── MethodError               numbers that do not make the method asked for
│   ├── ShapeMismatch         a matrix or row of the wrong size
│   ├── CoincidingNodes       a rule interpolates at nodes that are not distinct
│   ├── BlockTooLarge         interpolation whose exact entries would fill the memory
│   ├── TooManyTerms          a product of polynomials in the parameters that would fill it
│   ├── ZeroWeight            a conjugate divides by a weight that is zero
│   └── UnknownFamily         no such family, or not with that many stages
├── TreeError                 a text that is no tree, or trees that there are none of
├── NoLegendreTransform       a Lagrangian whose Hamiltonian is not found
├── MethodFileError           one or more faults of a method or problem file, each with its position
│   └── HasFreeParameters     a family of methods where one method is expected
├── NotDecided                work that takes too long, or is not small
└── UsageProblem              options that do not go together with the method at hand
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from functools import lru_cache
from itertools import pairwise
from typing import Any, Literal, TypeAlias

from garkcli.frozen import Frozen

UNKNOWN = "fault"
"""The code of errors without a kind."""


class GarkError(Exception):
    """Base of all errors of the program; its text is message and cure.

    Attributes:
        message: what is wrong, and where.
        help: the cure, or empty.
        code: the kind of error, as ``gark explain`` knows it.
        meant: the word that was meant, or empty.

    >>> print(GarkError("no order is given", "write 4", code="missing-key"))
    no order is given; write 4
    """

    code = UNKNOWN

    def __init__(self, message: str, help: str = "", *, code: str = "", meant: str = "") -> None:
        super().__init__(message)
        self.message = message
        self.help = help
        self.code = code or type(self).code
        self.meant = meant

    def __str__(self) -> str:
        if not self.help:
            return self.message
        return f"{self.message}; {self.help}"

    def __reduce__(self) -> tuple[Any, ...]:
        return _made_again, (type(self), self.args), self.__dict__


def _made_again(kind: type[GarkError], args: tuple[Any, ...]) -> GarkError:
    return kind.__new__(kind, *args)


class ExpressionError(GarkError):
    """A text is not an exact number; ``start`` and ``end`` are offsets of the fault, from 0.

    >>> from garkcli.exact.expression import parse
    >>> try:
    ...     parse("1/2 +")
    ... except ExpressionError as error:
    ...     print(error.start, error.message)
    5 the text ends where a number is expected
    """

    def __init__(
        self,
        message: str,
        help: str = "",
        start: int = 0,
        end: int = 0,
        *,
        code: str = "",
        meant: str = "",
    ) -> None:
        super().__init__(message, help, code=code, meant=meant)
        self.start = start
        self.end = end


class LimitExceeded(ExpressionError):
    """A text is longer, deeper or larger than any coefficient needs to be."""

    code = "number-too-large"


class UndefinedValue(ExpressionError):
    """A text is well formed but names no real number."""


class MethodError(GarkError):
    """Numbers that do not make the method asked for.

    >>> from garkcli import format_tree
    >>> format_tree(3)
    Traceback (most recent call last):
        ...
    garkcli.errors.MethodError: a tree is expected, not int; give its text, such as '[[],[]]'
    """


class ShapeMismatch(MethodError):
    """A matrix or a row does not have the size its place asks for."""

    code = "wrong-size"


class CoincidingNodes(MethodError):
    """Interpolation was requested at nodes that are not distinct."""

    code = "coinciding-nodes"


class BlockTooLarge(MethodError):
    """Interpolation was requested whose exact entries would take minutes, or all memory."""

    code = "too-many"


class TooManyTerms(MethodError):
    """Polynomials in free parameters would be multiplied out to more terms than fit."""

    code = "number-too-large"


class ZeroWeight(MethodError):
    """A symplectic conjugate divides by a weight that is zero.

    Attributes:
        reason: the message as a value, which outputs word.

    >>> from garkcli import load
    >>> try:
    ...     load("explicit-midpoint").conjugate
    ... except ZeroWeight as error:
    ...     print(error.reason)
    the symplectic conjugate divides by the weights b, b_1 = 0
    """

    code = "zero-weight"

    def __init__(self, reason: Any, help: str = "") -> None:
        super().__init__(str(reason), help)
        self.reason = reason


class VanishingDenominator(MethodError, ZeroDivisionError):
    code = "division-by-zero"


class UnknownFamily(MethodError):
    """No family of that name, or not with that many stages."""


class TreeError(GarkError, ValueError):
    """A text is no tree, or there are no trees of that order or of those colours.

    >>> from garkcli import parse_tree
    >>> try:
    ...     parse_tree("[[]")
    ... except TreeError as error:
    ...     print(error)
    ',' or ']' is missing at character 4; branches are separated by commas and closed by ']'
    """

    code = "no-such-tree"

    __str__ = GarkError.__str__


class NoLegendreTransform(GarkError):
    """The momenta of a Lagrangian could not be solved for its velocities."""

    code = "no-legendre-transform"


class NotDecided(GarkError):
    """Work takes longer than the time that it has (``is_late``), or is not small."""

    code = "not-found"

    def __init__(self, is_late: bool = False) -> None:
        if is_late:
            message, cure = "not decided in the time there is", "give it more seconds, or "
        else:
            message, cure = "not decided within the limits of gark", ""
        super().__init__(message, f"{cure}give parameters values")
        self.is_late = is_late


class UsageProblem(GarkError):
    """The options of a command do not fit the method or each other.

    >>> from garkcli import hamiltonian
    >>> hamiltonian("keppler")
    Traceback (most recent call last):
        ...
    garkcli.errors.UsageProblem: no problem 'keppler'; did you mean 'kepler'?
    """


Severity: TypeAlias = Literal["error", "warning", "note", "hint"]
"""Errors fail a check or an audit; warnings and notes are reported."""


class Remark(Frozen):
    """Something that is wrong with a file, a claim, a table or a call, or worth saying.

    Attributes:
        message: what is wrong.
        help: the cure, or empty.
        line: from 1; 0 if unknown.
        column: from 1; 0 if unknown.
        code: as ``gark explain`` knows it.
        level: how bad it is.
        claims: of a table, the declarations that are not true, as claims of a method file.
        meant: the word that was meant, or empty.
    """

    message: str
    help: str = ""
    line: int = 0
    column: int = 0
    code: str = UNKNOWN
    level: Severity = "error"
    claims: Mapping[str, str] | None = None
    meant: str = ""


MANY_WORDS = 50
"""Most words with all of which a misspelt one is compared; else with those of its first letter."""
MOST_WORDS = 8 * MANY_WORDS
"""Most words of the same first letter; the catalogue has hundreds."""
WORDS_SHOWN = 20
"""Most known words that are listed if none is near."""


def did_you_mean(word: str, known: Iterable[str]) -> str:
    """The cure for a misspelt word: the nearest known one, those it begins, or all known words.

    >>> did_you_mean("radau", ["radau-ia", "radau-iia", "gauss"])
    "did you mean 'radau-ia' or 'radau-iia'?"
    """
    known = list(known)
    word = str(word)  # Python may give anything
    words = _that_begin_like(word, known)
    close = nearest(word, words)
    if close:
        return f"did you mean {close!r}?"
    letters = _letters(word)
    begun = [x for x in words if len(letters) > 2 and _letters(x).startswith(letters)]
    if begun:
        return f"did you mean {' or '.join(map(repr, begun[:WORDS_SHOWN]))}?"
    if not known:
        return ""
    shown = ", ".join(known[:WORDS_SHOWN])
    more = ""
    if len(known) > WORDS_SHOWN:
        more = f", … ({len(known)} in all)"
    return f"one of: {shown}{more}"


def nearest(word: str, known: Iterable[str]) -> str:
    """The known word that a misspelt one was meant to be, by letters and digits alone; or empty.

    >>> nearest("LobattoIIIA", ["lobatto-iiia", "lobatto-iiib"]), nearest("Euler", ["gauss"])
    ('lobatto-iiia', '')
    """
    from difflib import get_close_matches  # paid for by mistakes alone

    letters = _letters(word[:MAX_WORD])
    words = _that_begin_like(word, list(known))
    spelt = {_letters(x): x for x in reversed(words)}  # of two alike the first stays
    if letters in spelt:
        return spelt[letters]
    # of three letters one may be wrong only if there are digits: rk5, but not foo
    cutoff = 0.7 if letters.isalpha() and len(letters) <= 3 else 0.6
    close = get_close_matches(letters, spelt, n=1, cutoff=cutoff)
    begun = [x for x in spelt if x.startswith(letters)]
    if len(begun) > 1 and len(letters) > 2:  # a word cut short is near to all that it begins
        return ""
    return spelt[close[0]] if close else ""


def _that_begin_like(word: str, known: list[str]) -> list[str]:
    if len(known) <= MANY_WORDS:
        return known
    first, own = word[:1].lower(), _pieces(word)
    alike = [x for x in known if x[:1].lower() == first][:MOST_WORDS]
    # a comparison letter by letter takes a hundred times as long as one of pieces
    return sorted(alike, key=lambda x: -len(own & _pieces(x)))[:MOST_NEAR]


MOST_NEAR = 20
"""Words that are compared letter by letter: those that share the most letters and pairs."""
MAX_WORD = 100


@lru_cache(MOST_WORDS * 4)
def _pieces(word: str) -> frozenset[str]:
    letters = _letters(word[:MAX_WORD])
    return frozenset([*letters, *map("".join, pairwise(letters))])


def _letters(word: str) -> str:
    return "".join(x for x in word.lower() if x not in "-_ ")


def printable(text: str) -> str:
    r"""A text from outside on one line, with control characters escaped."""
    if text.isprintable():
        return text
    return "".join(x if x.isprintable() else repr(x)[1:-1] for x in text)


def counted(count: int, noun: str, plural: str = "") -> str:
    if count == 1:
        return f"{count} {noun}"
    several = plural or noun + "s"
    return f"{count} {several}"


class MethodFileError(GarkError):
    """A file that cannot be read; its text has every fault with its place, its line, and its cure.

    Attributes:
        source: the file as it was named.
        faults: all of them, in file order.
        text: of the file.

    >>> from garkcli import loads
    >>> try:
    ...     loads("{A: [[1/2]], b: [1, 0]}")
    ... except MethodFileError as error:
    ...     print(error.source, [fault.message for fault in error.faults])
    <text> ['b has 2 entries, A is 1 by 1']
    """

    def __init__(self, source: str, faults: Sequence[Remark], text: str = "") -> None:
        message = "; ".join(fault.message for fault in faults)
        super().__init__(message, code=faults[0].code if faults else UNKNOWN)
        self.source = source
        self.faults = tuple(faults)
        self.text = text

    def __str__(self) -> str:
        lines = self.text.splitlines()
        parts: list[str] = []
        for fault in self.faults:
            place = printable(self.source)
            if fault.line:
                place += f":{fault.line}:{fault.column}"
            parts.append(f"{place}: {fault.message}")
            if 0 < fault.line <= len(lines):
                parts += excerpt(lines[fault.line - 1], fault.line, fault.column)
            if fault.help:
                parts.append(f"      help: {fault.help}")
        return "\n".join(parts)


class HasFreeParameters(MethodFileError):
    """A family of methods where one method is expected; nothing else is wrong with the file.

    >>> from garkcli import loads
    >>> try:
    ...     loads("{parameters: {t: free}, A: [[t]], b: [1]}")
    ... except HasFreeParameters as error:
    ...     print(error.faults[0].message)
    parameters: t is free: the file describes a family of methods
    """

    reading: Any = None
    """The parsed file, from which its family is made; None after pickling."""

    def __reduce__(self) -> tuple[Any, ...]:
        *made, state = super().__reduce__()
        return (*made, {**state, "reading": None})


EXCERPT_WIDTH = 72
"""Most columns that are shown of a line at fault."""


def excerpt(text: str, line: int, column: int, caret: str = "^") -> list[str]:
    r"""A line of a file, cut to the terminal, and a caret under ``column``, which counts from 1.

    >>> print("\n".join(excerpt("b: [0.5, O.5]", 3, 10)))
        3 | b: [0.5, O.5]
          |          ^
    """
    centred = column - 1 - EXCERPT_WIDTH // 2
    last = len(text) - EXCERPT_WIDTH
    start = max(0, min(centred, last))
    shown = text[start : start + EXCERPT_WIDTH].replace("\t", " ")
    before = printable(shown[: column - 1 - start])
    return [f"{line:5} | {printable(shown)}", f"      | {' ' * len(before)}{caret}"]
