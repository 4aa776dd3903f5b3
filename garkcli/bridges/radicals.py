"""Irrational numbers exactly, in the languages that have roots."""

from __future__ import annotations

from collections.abc import Callable

from flint import fmpq

from garkcli.exact.field import Algebraic
from garkcli.exact.nodes import AlgebraicRoot, Literal, Root
from garkcli.exact.rewriting import PlainText
from garkcli.frozen import Frozen


class Words(Frozen):
    """How a language writes what irrational numbers are made of.

    Attributes:
        rational: a rational number, as a factor that needs no parentheses.
        root: the real root of a text, of an index.
        algebraic: a real root of a polynomial.
        power: ``**`` or ``^``.
    """

    rational: Callable[[fmpq], str]
    root: Callable[[str, int], str]
    algebraic: Callable[[AlgebraicRoot], str]
    power: str

    def text(self, x: Algebraic) -> str:
        """The number as a sum of multiples of radicals."""
        writer = _Writer(self)
        text = ""
        for coefficient, word in x.terms():
            sign = " - " if coefficient < 0 else " + "
            factors = [self.rational(abs(coefficient))]
            for index in word:
                radical, _ = x.field.radicals[index]
                factors.append(writer.tight(radical))
            if factors[1:] and abs(coefficient) == 1:
                factors = factors[1:]
            text += sign + "*".join(factors)
        if text.startswith(" - "):
            return "-" + text.removeprefix(" - ")
        return text.removeprefix(" + ")


def has_square_roots_alone(x: Algebraic) -> bool:
    """Whether a number is a sum of multiples of square roots of rational numbers."""
    radicals = [x.field.radicals[i][0] for _, word in x.terms() for i in word]
    return all(
        isinstance(radical, Root) and radical.index == 2 and isinstance(radical.radicand, Literal)
        for radical in radicals
    )


class _Writer(PlainText):
    """Radicals in the words of a language."""

    def __init__(self, words: Words) -> None:
        self.words = words

    def number(self, value: fmpq) -> str:
        sign = "-" if value < 0 else ""
        return sign + self.words.rational(abs(value))

    def power(self, base: str, exponent: int) -> str:
        return f"{base}{self.words.power}{exponent}"

    def root(self, radicand: str, index: int) -> str:
        return self.words.root(radicand, index)

    def algebraic(self, root: AlgebraicRoot) -> str:
        return self.words.algebraic(root)
