"""The Baker–Campbell–Hausdorff formula without trees: the Hamiltonian of a composition of flows.

The logarithm of e^{c₁X₁} e^{c₂X₂} … is a polynomial in words, made a sum of nested brackets by
Dynkin's theorem: Σ_w c_w/|w| [w₁, [w₂, …]].
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Mapping, Sequence
from math import factorial
from typing import TypeAlias, TypeVar

from flint import fmpq

Words: TypeAlias = dict[str, fmpq]
"""A polynomial in letters that do not commute."""
H = TypeVar("H")


def logarithm(flows: Sequence[tuple[fmpq, str]], order: int) -> Words:
    """log(e^{c₁X₁} e^{c₂X₂} …) up to words of so many letters."""
    total: Words = {"": fmpq(1)}
    for c, letter in flows:
        powers = {letter * k: c**k / factorial(k) for k in range(order + 1)}
        total = _times(total, powers, order)
    rest = {word: x for word, x in total.items() if word}
    result: Words = defaultdict(lambda: fmpq(0))
    power: Words = {"": fmpq(1)}
    for k in range(1, order + 1):
        power = _times(power, rest, order)
        for word, x in power.items():
            result[word] += x * fmpq((-1) ** (k + 1), k)
    return result


def _times(u: Words, v: Words, order: int) -> Words:
    result: Words = defaultdict(lambda: fmpq(0))
    for a, x in u.items():
        for b, y in v.items():
            if len(a) + len(b) <= order:
                result[a + b] += x * y
    return result


def in_brackets(
    words: Words, letters: Mapping[str, H], bracket: Callable[[H, H], H], zero: H
) -> list[H]:
    """For 1, 2, … letters the sum of their brackets."""
    order = max(map(len, words))
    sums = [zero] * order
    for word, x in words.items():
        nested = letters[word[-1]]
        for letter in reversed(word[:-1]):
            nested = bracket(letters[letter], nested)
        sums[len(word) - 1] = sums[len(word) - 1] + nested * (x / len(word))  # type: ignore[operator]
    return sums
