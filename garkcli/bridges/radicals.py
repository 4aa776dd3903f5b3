"""Irrational numbers in the languages with exact roots."""

from __future__ import annotations

from abc import ABC, abstractmethod

from flint import fmpq

from garkcli.exact.field import Algebraic
from garkcli.exact.rewriting import PlainText


class Radicals(PlainText, ABC):
    POWER = "^"

    @abstractmethod
    def rational(self, x: fmpq) -> str:
        """A positive rational number, as a factor without parentheses."""

    def text(self, x: Algebraic) -> str:
        text = ""
        for coefficient, word in x.terms():
            factors = [self.tight(x.field.radicals[index][0]) for index in word]
            if not factors or abs(coefficient) != 1:
                factors.insert(0, self.rational(abs(coefficient)))
            text += (" - " if coefficient < 0 else " + ") + "*".join(factors)
        return "-" + text[3:] if text.startswith(" - ") else text[3:]

    def number(self, value: fmpq) -> str:
        sign = "-" if value < 0 else ""
        return sign + self.rational(abs(value))

    def power(self, base: str, exponent: int) -> str:
        return f"{base}{self.POWER}{exponent}"
