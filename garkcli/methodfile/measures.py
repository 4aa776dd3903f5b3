"""Claims on real numbers: exact, as a decimal, infinite, or at least so large."""

from __future__ import annotations

import re
from dataclasses import dataclass

from flint import fmpq
from yaml.nodes import Node

from garkcli.errors import ExpressionError
from garkcli.exact.domain import Domain
from garkcli.exact.expression import parse
from garkcli.exact.field import ZERO, Number
from garkcli.exact.polynomial import Polynomial
from garkcli.exact.roots import RealRoot, real_roots
from garkcli.methodfile.source import Source

INFINITY = "infinity"
_DECIMAL = re.compile(r"[0-9]*\.(?P<places>[0-9]*)(?:[eE](?P<exponent>[+-]?[0-9]{1,3}))?")
_AT_LEAST = re.compile(r">=\s*(.*)", re.DOTALL)


@dataclass(frozen=True)
class Measure:
    """A real number that is claimed.

    Attributes:
        text: as it is written.
        number: its value; None for ∞.
        half_unit: half a unit of the last place of a decimal, which claims no further digits; 0 for
            an exact number.
        is_least: whether the claim is that the number is at least so large.
    """

    text: str
    number: Number | None
    half_unit: fmpq = ZERO
    is_least: bool = False

    def __str__(self) -> str:
        return self.text

    def agrees(self, found: RealRoot | None, rounding: fmpq = ZERO) -> bool:
        """Whether the claim is true of a number, None for ∞.

        Args:
            found: the number.
            rounding: by how much it may be off, for coefficients within a tolerance.
        """
        if self.number is None:
            return found is None
        if found is None:
            return self.is_least
        if self.is_least:
            return _root(self.number - rounding) <= found
        off = self.half_unit + rounding
        return _root(self.number - off) <= found <= _root(self.number + off)


def _root(number: Number) -> RealRoot:
    ((root, _),) = real_roots(Polynomial([-number, 1]))
    return root


def read_measure(source: Source, node: Node, where: str) -> Measure | None:
    """The claim that a value makes; None, with a fault noted, where it is none."""
    text = source.scalar(node, where)
    if text is None:
        return None
    least = _AT_LEAST.fullmatch(text)
    body = (least[1] if least else text).strip()
    if body == INFINITY:
        return Measure(text, None)
    try:
        expression = parse(body)
        number = Domain([expression]).evaluate(expression)
    except ExpressionError as error:
        cure = error.help or "write a number such as 2*sqrt(2) or 2.785, or infinity"
        source.fault(node, f"{where}: {error.message}", cure, code=error.code)
        return None
    return Measure(text, number, _half_unit(body), least is not None)


def _half_unit(text: str) -> fmpq:
    decimal = _DECIMAL.fullmatch(text)
    if decimal is None:
        return ZERO
    exponent = int(decimal["exponent"] or 0) - len(decimal["places"])
    return fmpq(10) ** exponent / 2
