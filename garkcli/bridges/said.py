"""Orders that words say: in a comment above a table, in the docstring of its function or class."""

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
    rf"(?P<number>[0-9]{{1,2}}|{_ANY}))(?![\w.,/-]{{0,9}}[0-9])(?:[ -]accurate)?[ ]?"
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
"""Words that say of what else an order is."""
_OTHER_AFTER = re.compile(
    r"[0-9]|ode|odes|dae|daes|pde|pdes|ivp|equation|differential|ordinary|system|problem|derivative"
    r"|dense|interpol|error|estimat|embed|hermite|polynomial|term|optimi|backward|condition"
    r"|spline|extrapol|difference|to|in|for|if|when|stage|predict|initial|linear",
    re.IGNORECASE,
)
_COMMENT = re.compile(r"\s*(?:#(?!\s*(?:define|include|if|else|endif|undef))|//|!|%|\*|/\*)")
_AT_THE_END = re.compile(r"(?:#|//|!|%|/\*)(?P<text>[^\"']*)$")
_SCOPE = re.compile(
    r"(?P<indent>\s*)(?:@\w.*\s)?(?:static\s+)?"
    r"(?:def|class|function|struct|subroutine|module procedure)\b"
)
_REFERENCES = re.compile(r"\breferences?\b|\\cite", re.IGNORECASE)
"""Behind it are titles of publications."""
MAX_LINES = 60
"""Longest comment or docstring that is read."""
MAX_LENGTH = 1000
"""Longest line at whose end a comment is sought."""
MAX_SCOPE = 1000
"""So far above a table its function or class may begin."""


def order_said(text: str) -> int | None:
    """The order that a comment or a docstring says of a method; None if it says none, or two.

    >>> order_said("The 5th-order method of Tsitouras, of order five")
    5
    >>> order_said("order 5, or order 4") is None
    True
    >>> order_said("Solves a second-order equation, stage order 2"), order_said("Fourth-order RK")
    (None, 4)
    """
    said = set()
    for found in _ORDER.finditer(_REFERENCES.split(text)[0]):
        before = found["before"].strip().lower()
        if before in _OTHER_BEFORE or _OTHER_AFTER.match(found["after"]):
            continue
        text = (found["word"] or found["ordinal"] or found["number"]).lower()
        words = next((x for x in (_WORDS, _NUMBERS) if text in x), ())
        said.add(words.index(text) + 1 if words else int(text))
    return said.pop() if len(said) == 1 else None


def order_said_of(lines: Sequence[str], line: int) -> int | None:
    """The order that the source says of the table that begins at ``line``, from 1: the nearest
    comment or docstring that says one.
    """
    return next((x for x in map(order_said, _passages(lines, line)) if x is not None), None)


def _passages(lines: Sequence[str], line: int) -> Iterator[str]:
    """What is written about a table, the nearest first: on its line and above it, then in and above
    the function or the class around it.
    """
    at = line - 1
    if not 0 <= at < len(lines):
        return
    if not _SCOPE.match(lines[at]):
        end = _AT_THE_END.search(lines[at][:MAX_LENGTH])
        yield " ".join([*_above(lines, at), end["text"] if end else ""])
        at = _around(lines, at)
    if at >= 0:
        yield " ".join([*_above(lines, at), *_docstring(lines, at)])


def _around(lines: Sequence[str], at: int) -> int:
    """The line on which the function or class around a line begins; -1 where there is none."""
    width = len(lines[at]) - len(lines[at].lstrip())
    for i in range(at - 1, max(-1, at - MAX_SCOPE), -1):
        indent = len(lines[i]) - len(lines[i].lstrip())
        if lines[i].strip() and indent < width:
            if _SCOPE.match(lines[i]):
                return i
            width = indent
    return -1


def _above(lines: Sequence[str], at: int) -> list[str]:
    """The comment, or the docstring of Julia, that ends right above a line."""
    if at > 1 and _SCOPE.match(lines[at]) and not lines[at - 1].strip():
        # Fortran leaves a line between a comment and the head below it
        at -= 1
    first = at
    above = lines[at - 1].strip() if at else ""
    end = next((x for x in ('"""', "*/") if above.endswith(x)), "")
    begin = {'"""': '"""', "*/": "/*"}.get(end, "")
    if end:
        is_begun = above.startswith(begin) and len(above) > len(end)
        first = at - 1
        while not is_begun and first > max(0, at - MAX_LINES):
            first -= 1
            is_begun = begin in lines[first]
        return list(lines[first:at]) if is_begun else []
    while first > max(0, at - MAX_LINES) and _COMMENT.match(lines[first - 1]):
        first -= 1
    return list(lines[first:at])


def _docstring(lines: Sequence[str], at: int) -> list[str]:
    """The docstring of Python below the head of a function or class."""
    body = at + 1
    while body < min(len(lines), at + 12) and not lines[body - 1].rstrip().endswith(":"):
        body += 1
    if body >= len(lines):
        return []
    first = lines[body].strip().lstrip("rRuU")
    mark = first[:3]
    if mark not in {'"""', "'''"}:
        return []
    if mark in first[3:]:
        return [first]
    for end in range(body + 1, min(len(lines), body + MAX_LINES)):
        if mark in lines[end]:
            return list(lines[body : end + 1])
    return []
