"""Numbers in lines of sources, and what people type for them: another sign, another character."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from itertools import pairwise
from math import gcd

from flint import fmpq

from garkcli.exact.field import ZERO
from garkcli.frozen import Frozen

LONGEST = 60
"""Characters of the longest number that is mended."""
_NUMBER = re.compile(r"(?P<whole>\d+)?(?:\.(?P<part>\d*))?(?:[eEdD](?P<power>[-+]?\d{1,3}))?")
_TOKEN = re.compile(r"(?<![\w.])(?:\d+\.?\d*|\.\d+)(?:[eEdD][-+]?\d{1,3}(?!\d))?")
_OVER = re.compile(r"[\w.()\s]*/{1,2}[\w.(\s]*")
"""What is between a numerator and its denominator, names of functions and types besides."""
_MINUS = re.compile(r"-(?=\s*(?:\w+\(\s*)?$)")
"""The sign at the end of what is before a number."""


class Wanted(Frozen):
    """A value that another number may have to have.

    Attributes:
        old, new: the number in the table.
        allowed: by how much the new one may be another.
        is_sure: whether it may be any other number: otherwise a sign or a digit is wrong.
        is_estimate: whether it is one of an error estimate, False for one of embedded weights;
            None for others.
    """

    old: fmpq
    new: fmpq
    allowed: fmpq
    is_sure: bool = False
    is_estimate: bool | None = None


class Place(Frozen):
    """Where a text has a positive number: one token, or two with a quotient between them."""

    line: int
    tokens: tuple[re.Match[str], ...]

    @property
    def value(self) -> fmpq:
        """The number that is there."""
        return self.with_value(0, self.tokens[0][0])

    def with_value(self, k: int, text: str) -> fmpq:
        """The number with another text for token k."""
        values = [_value(text if k == i else x[0]) for i, x in enumerate(self.tokens)]
        return values[0] if len(values) == 1 else values[0] / values[1] if values[1] else ZERO

    def is_as_short(self, k: int, text: str) -> bool:
        """Whether a fraction in lowest terms stays one with another text for token k."""
        texts = [x[0] for x in self.tokens]
        return _common(texts) > 1 or _common([*texts[:k], text, *texts[k + 1 :]]) == 1


def places(line: str, number: int) -> Iterator[Place]:
    """The numbers of a line."""
    tokens = [x for x in _TOKEN.finditer(line) if len(x[0]) <= LONGEST]
    yield from (Place(number, (x,)) for x in tokens)
    for over, under in pairwise(tokens):
        if _OVER.fullmatch(line[over.end() : under.start()]) and _value(under[0]):
            yield Place(number, (over, under))


def mistyped(line: str, place: Place, wanted: Wanted) -> Iterator[str]:
    """A line with another sign, or another digit, of a number."""
    start, is_turned = place.tokens[0].start(), wanted.old * wanted.new < 0
    if is_turned:
        if abs(wanted.old + wanted.new) <= wanted.allowed:
            yield _turned(line, start)
        return
    near = [
        (abs(place.with_value(k, text) - abs(wanted.new)), len(text) != len(token[0]), k, text)
        for k, token in enumerate(place.tokens)
        for text in _slips(token[0])
        if _value(text) != _value(token[0]) and place.is_as_short(k, text)
    ]
    for *_, k, text in sorted(x for x in near if x[0] <= wanted.allowed)[:3]:
        token = place.tokens[k]
        yield line[: token.start()] + text + line[token.end() :]


def _turned(line: str, start: int) -> str:
    """A line with the other sign of the number at a place."""
    before, after = line[:start], line[start:]
    plain = _MINUS.sub("", before)
    return plain + after if plain != before else f"{before}-{after}"


def _slips(number: str) -> Iterator[str]:
    """A number with one character more, less or another, or with two exchanged."""
    found: dict[str, None] = {}
    for k in range(len(number) + 1):
        head, tail = number[:k], number[k:]
        texts = [head + x + tail for x in "0123456789."]
        if tail:
            texts += [head + tail[1:], *(head + x + tail[1:] for x in "0123456789")]
            texts.append(head + tail[1::-1] + tail[2:])
        found |= dict.fromkeys(texts)
    is_long = number[:1] == "0" and number[1:2].isdigit()
    for text in found:
        # 012 is 10 in some languages
        if _TOKEN.fullmatch(text) and text != number and (is_long or not re.match(r"0\d", text)):
            yield text


def written(line: str, place: Place, wanted: Wanted) -> Iterator[str]:
    """A line with another number, written as the old one is."""
    p, q = abs(int(wanted.new.p)), int(wanted.new.q)
    first, last = place.tokens[0], place.tokens[-1]
    point = re.sub(r"^\d*|[eEdD].*$", "", first[0])
    if len(place.tokens) > 1:
        between = line[first.end() : last.start()]
        new = f"{p}{point}{between}{q}{re.sub(r'^[0-9]*|[eEdD].*$', '', last[0])}"
    else:
        decimal = _decimal(p, q) if point else ""
        end = ".0" if point else ""
        new = decimal or (f"{p}{end}" if q == 1 else f"{p}{end}/{q}{end}")
    changed = line[: first.start()] + new + line[last.end() :]
    yield _turned(changed, first.start()) if wanted.old * wanted.new < 0 else changed


def _common(texts: Sequence[str]) -> int:
    """What whole numbers have in common; 1 of others, and of a single number."""
    values = [_value(x) for x in texts]
    whole = [int(x.p) for x in values if x.q == 1]
    return gcd(*whole) if len(whole) == len(values) > 1 else 1


def _decimal(p: int, q: int) -> str:
    """A short decimal; empty where there is none."""
    places = next((k for k in range(1, 9) if 10**k % q == 0), 0)
    if not places:
        return ""
    digits = str(p * 10**places // q).rjust(places + 1, "0")
    return f"{digits[:-places]}.{digits[-places:]}"


def _value(text: str) -> fmpq:
    """The number that a token is, without a sign."""
    found = _NUMBER.fullmatch(text)
    assert found is not None
    whole, part, power = found["whole"] or "", found["part"] or "", int(found["power"] or 0)
    return fmpq(int(f"0{whole}{part}")) * fmpq(10) ** (power - len(part))
