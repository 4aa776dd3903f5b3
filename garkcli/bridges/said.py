"""Orders in words: in a comment above a table, or in the docstring of its function or class."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

_WORDS = (
    *("first", "second", "third", "fourth", "fifth", "sixth", "seventh", "eighth", "ninth"),
    *("tenth", "eleventh", "twelfth"),
)
_NUMBERS = (
    *("one", "two", "three", "four", "five", "six", "seven", "eight", "nine", "ten"),
    *("eleven", "twelve"),
)
_ORDINAL, _ANY = "|".join(_WORDS), "|".join(_NUMBERS)
_ORDER = re.compile(
    rf"(?P<before>[\w-]{{1,30}}[ \t]|)\b(?:(?P<word>{_ORDINAL})[ -]order"
    r"|(?P<ordinal>[0-9]{1,2})(?:st|nd|rd|th)[ -]order"
    rf"|order(?:[ ]of[ ]accuracy)?(?:[ ](?:of|is)|:|[ ]=)?[ ]"
    rf"(?P<number>[0-9]{{1,2}}|{_ANY}))(?![\w.,/-]{{0,9}}[0-9]|st|nd|rd|th)(?:[ -]accurate)?[ ]?"
    r"(?P<after>[\w-]*)",
    re.IGNORECASE,
)
_OTHER_BEFORE = frozenset(
    {
        *("stage", "weak", "strong", "phase", "embedded", "dense", "pseudo", "pseudo-", "linear"),
        *("dispersion", "dissipation", "lower", "higher", "interpolation", "estimated", "error"),
        *("at", "than", "effective", "q", "p"),
    }
)
_OTHER_AFTER = re.compile(
    r"[0-9]|ode|odes|dae|daes|pde|pdes|ivp|equation|differential|ordinary|system|problem|derivative"
    r"|dense|interpol|error|estimat|embed|hermite|polynomial|term|optimi|backward|condition"
    r"|spline|extrapol|difference|to|in|for|if|when|stage|predict|initial|linear|finite|central"
    r"|upwind|weno|compact|spatial|flux|reconstruct|taylor|moment|tensor|filter",
    re.IGNORECASE,
)
_COMMENT = re.compile(r"\s*(?:#(?!\s*(?:define|include|if|else|endif|undef))|//|!|%|\*|/\*)")
_AT_THE_END = re.compile(r"(?:#|//|!|%|/\*)(?P<text>[^\"']*)$")
_SCOPE = re.compile(
    r"(?P<indent>\s*)(?:@\w.*\s)?(?:static\s+)?"
    r"(?:def|class|function|struct|subroutine|module procedure)\b"
)
_REFERENCES = re.compile(r"\breferences?\b|\\cite", re.IGNORECASE)
"""Titles of publications follow."""
MAX_LINES = 60
MAX_LENGTH = 1000
MAX_SCOPE = 1000
"""Most lines from a table up to the head of its function or class."""


def order_said(text: str) -> int | None:
    """The order of a method in a comment or docstring; None if it gives none, or two.

    >>> order_said("The 5th-order method of Tsitouras, of order five")
    5
    >>> order_said("order 5, or order 4") is None
    True
    >>> order_said("Solves a second-order equation, stage order 2"), order_said("Fourth-order RK")
    (None, 4)
    """
    said = set()
    plain = " ".join(text.split())
    for match in _ORDER.finditer(_REFERENCES.split(plain)[0]):
        before = match["before"].strip().lower()
        if before in _OTHER_BEFORE or _OTHER_AFTER.match(match["after"]):
            continue
        text = (match["word"] or match["ordinal"] or match["number"]).lower()
        words = next((x for x in (_WORDS, _NUMBERS) if text in x), ())
        said.add(words.index(text) + 1 if words else int(text))
    return said.pop() if len(said) == 1 else None


def order_said_of(lines: Sequence[str], line: int) -> int | None:
    return next((x for x in map(order_said, _passages(lines, line)) if x is not None), None)


def _passages(lines: Sequence[str], line: int) -> Iterator[str]:
    """Yields the comments at and above the line of a table, then in and above the function or
    class.
    """
    at = line - 1
    if not 0 <= at < len(lines):
        return
    if not _SCOPE.match(lines[at]):
        end = _AT_THE_END.search(lines[at][:MAX_LENGTH])
        yield " ".join([*_above(lines, at), end["text"] if end else ""])
        at = _around(lines, at)
    if at >= 0:
        # a docstring of Python follows the end of the head
        ends = (i for i in range(at, min(len(lines) - 1, at + 11)) if lines[i].rstrip()[-1:] == ":")
        below = next((_quoted(lines, i + 1, 1) for i in ends), [])
        yield " ".join([*_above(lines, at), *below])


def _around(lines: Sequence[str], at: int) -> int:
    width = _indent(lines[at])
    for i in range(at - 1, max(-1, at - MAX_SCOPE), -1):
        if lines[i].strip() and _indent(lines[i]) < width:
            if _SCOPE.match(lines[i]):
                return i
            width = _indent(lines[i])
    return -1


def _indent(line: str) -> int:
    return len(line) - len(line.lstrip())


def _above(lines: Sequence[str], at: int) -> Sequence[str]:
    """The comment, or the docstring of Julia, that ends right above a line."""
    if at > 1 and _SCOPE.match(lines[at]) and not lines[at - 1].strip():
        # Fortran has an empty line between a comment and the head below it
        at -= 1
    first = at
    while first > max(0, at - MAX_LINES) and _COMMENT.match(lines[first - 1]):
        first -= 1
    return _quoted(lines, at - 1, -1) or lines[first:at]


def _quoted(lines: Sequence[str], at: int, step: int) -> Sequence[str]:
    """The lines of a quoted text with one end on a line: down for step 1, up for -1."""
    text = lines[at].strip().lstrip("rRuU") if at >= 0 else ""
    mark = text[:3] if step > 0 else text[-3:]
    if step < 0 and text.endswith("*/"):
        mark = "/*"
    elif mark not in {'"""', "'''"}:
        return []
    if text.count(mark) > (mark != "/*"):
        return [text]
    others = range(at + step, at + step * MAX_LINES, step)
    other = next((i for i in others if 0 <= i < len(lines) and mark in lines[i]), None)
    return [] if other is None else lines[min(at, other) : max(at, other) + 1]
