"""Numbers in lines of sources, and their misprints: another sign, another character."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from itertools import pairwise
from math import gcd

from flint import fmpq

from garkcli.exact.field import ZERO
from garkcli.frozen import Frozen

LONGEST = 60
_NUMBER = re.compile(r"(?P<whole>\d+)?(?:\.(?P<part>\d*))?(?:[eEdD](?P<power>[-+]?\d{1,3}))?")
_TOKEN = re.compile(r"(?<![\w.])(?:\d+\.?\d*|\.\d+)(?:[eEdD][-+]?\d{1,3}(?!\d))?")
_OVER = re.compile(r"[\w.()\s]*/{1,2}[\w.(\s]*")
"""Between numerator and denominator, including names of functions and types."""
_MINUS = re.compile(r"-(?=\s*(?:\w+\(\s*)?$)")


class Wanted(Frozen):
    """A value that a number should have, off by at most ``allowed``.

    Unless ``is_sure`` a sign or a digit must be wrong; ``is_estimate`` is None for numbers of
    neither error estimates nor embedded weights.
    """

    old: fmpq
    new: fmpq
    allowed: fmpq
    is_sure: bool = False
    is_estimate: bool | None = None


class NumberPlace(Frozen):
    """A positive number in a text: one token, or two with a quotient between them."""

    line: int
    tokens: tuple[re.Match[str], ...]

    @property
    def value(self) -> fmpq:
        return self.with_value(0, self.tokens[0][0])

    def with_value(self, k: int, text: str) -> fmpq:
        values = [_value(text if k == i else x[0]) for i, x in enumerate(self.tokens)]
        return values[0] if len(values) == 1 else values[0] / values[1] if values[1] else ZERO

    def is_as_short(self, k: int, text: str) -> bool:
        """Whether another text for token k leaves a fraction in lowest terms as it is."""
        texts = [x[0] for x in self.tokens]
        return _common(texts) > 1 or _common([*texts[:k], text, *texts[k + 1 :]]) == 1


def places(line: str, number: int) -> Iterator[NumberPlace]:
    tokens = [x for x in _TOKEN.finditer(line) if len(x[0]) <= LONGEST]
    yield from (NumberPlace(number, (x,)) for x in tokens)
    for over, under in pairwise(tokens):
        if _OVER.fullmatch(line[over.end() : under.start()]) and _value(under[0]):
            yield NumberPlace(number, (over, under))


def mistyped(line: str, place: NumberPlace, wanted: Wanted) -> Iterator[str]:
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
    before, after = line[:start], line[start:]
    plain = _MINUS.sub("", before)
    return plain + after if plain != before else f"{before}-{after}"


def _slips(number: str) -> Iterator[str]:
    """A number with one character inserted, deleted or replaced, or with two exchanged."""
    texts_once: dict[str, None] = {}
    for k in range(len(number) + 1):
        head, tail = number[:k], number[k:]
        texts = [head + x + tail for x in "0123456789."]
        if tail:
            texts += [head + tail[1:], *(head + x + tail[1:] for x in "0123456789")]
            texts.append(head + tail[1::-1] + tail[2:])
        texts_once |= dict.fromkeys(texts)
    is_long = number[:1] == "0" and number[1:2].isdigit()
    for text in texts_once:
        # 012 is 10 in some languages
        if _TOKEN.fullmatch(text) and text != number and (is_long or not re.match(r"0\d", text)):
            yield text


def written(line: str, place: NumberPlace, wanted: Wanted) -> Iterator[str]:
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
    """The common divisor of integers; 1 for other numbers, and for a single one."""
    values = [_value(x) for x in texts]
    integers = [int(x.p) for x in values if x.q == 1]
    return gcd(*integers) if len(integers) == len(values) > 1 else 1


def _decimal(p: int, q: int) -> str:
    """A decimal of at most eight places; empty if there is none."""
    places = next((k for k in range(1, 9) if 10**k % q == 0), 0)
    if not places:
        return ""
    digits = str(p * 10**places // q).rjust(places + 1, "0")
    return f"{digits[:-places]}.{digits[-places:]}"


def _value(text: str) -> fmpq:
    match = _NUMBER.fullmatch(text)
    assert match is not None
    integral, part, power = match["whole"] or "", match["part"] or "", int(match["power"] or 0)
    return fmpq(int(f"0{integral}{part}")) * fmpq(10) ** (power - len(part))
