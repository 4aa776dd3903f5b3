"""Pseudorandom integers, the same with every version of Python, unlike ``random.randint``."""

from __future__ import annotations

_WORD = 2**64
# the constants of SplitMix64: Steele, Lea, Flood, Fast splittable pseudorandom number generators,
# OOPSLA 2014, section 4 (mix64variant13)
_STEP = 0x9E3779B97F4A7C15
_FIRST_FACTOR = 0xBF58476D1CE4E5B9
_SECOND_FACTOR = 0x94D049BB133111EB


class Draw:
    """A sequence of integers determined by ``seed`` modulo 2^64: SplitMix64.

    >>> draw = Draw(1234567)
    >>> draw.word(), draw.word()
    (6457827717110365317, 3203168211198807973)
    """

    def __init__(self, seed: int) -> None:
        self._state = seed % _WORD

    def word(self) -> int:
        """The next integer, from 0 to 2^64 − 1."""
        self._state = (self._state + _STEP) % _WORD
        z = self._state
        z = (z ^ (z >> 30)) * _FIRST_FACTOR % _WORD
        z = (z ^ (z >> 27)) * _SECOND_FACTOR % _WORD
        return z ^ (z >> 31)

    def between(self, low: int, high: int) -> int:
        return low + self.word() * (high - low + 1) // _WORD

    def sign(self) -> int:
        return 2 * self.between(0, 1) - 1
