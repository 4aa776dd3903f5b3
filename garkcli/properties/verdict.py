"""Verdicts on properties, and their values: truths, whole numbers and sizes."""

from __future__ import annotations

from math import inf
from typing import TYPE_CHECKING, Any, Literal, TypeAlias

from garkcli.frozen import Frozen
from garkcli.reason import NO_REASON, Formula, Reason

if TYPE_CHECKING:
    from flint import fmpq

    from garkcli.exact.roots import RealRoot

Kind: TypeAlias = Literal["truth", "count", "number"]
"""True or false, an integer, or a real number that may be infinite."""
KINDS: dict[Kind, str] = {
    "truth": "`true` or `false`",
    "count": 'a whole number, or `">= n"`',
    "number": "an exact number such as `2*sqrt(2)`, a decimal that it is rounded to,"
    ' `infinity`, or `">= x"`',
}
"""The notation of claims of each kind."""
Asks: TypeAlias = Literal["zeros", "equations", "signs"]
"""The question that decides a property: which coefficients are zero, which equations they meet, or
which signs numbers have.

Rounded coefficients meet equations within their tolerance; other properties hold for all methods
there, or are undecided.
"""
_DIGITS = 12
_LONG = 60


class Size(Frozen):
    """A real number that may be infinite; ``root`` is None for ∞."""

    root: RealRoot | None

    def __float__(self) -> float:
        return inf if self.root is None else float(self.root)

    def __repr__(self) -> str:
        return f"<Size {self}>"

    def __str__(self) -> str:
        if self.root is None:
            return "infinity"
        from garkcli.exact.display import shortest  # few checks show such numbers
        from garkcli.exact.polynomial import Polynomial
        from garkcli.exact.polynomial_text import polynomial_text, root_decimal, root_text

        if self.root.exact is not None:
            return shortest(self.root.exact)
        simple = root_text(self.root)
        if simple is not None:
            return simple
        decimal = root_decimal(self.root, _DIGITS)
        polynomial = polynomial_text(Polynomial.from_flint(self.root.polynomial), "x")
        if len(polynomial) > _LONG:
            return decimal
        return f"{decimal}, a root of {polynomial}"

    def words(self, dialect: Any) -> str:
        return size_reason(str(self)).words(dialect)


def size_reason(text: str) -> Reason:
    number, sign, polynomial = text.partition(", a root of ")
    if sign:
        return Reason(f"{number}{sign}{{}}", Formula(polynomial))
    return Reason(text) if text == "infinity" else Reason("{}", Formula(text))


Value: TypeAlias = "bool | int | Size"


class Verdict(Frozen):
    """The verdict on a property.

    Attributes:
        value: None if the property is not defined or undecided.
        reason: the entry, pole or polynomial that decides; or why there is no value.
        is_undecided: whether it is defined but undecided.
        is_at_least: whether an integer value may be larger.

    >>> from garkcli import find_property
    >>> verdict = find_property("rk4", "a-stable")
    >>> verdict.value, str(verdict.reason)
    (False, 'R(z) is not bounded: its numerator has the larger degree')
    """

    value: Value | None
    reason: Reason = NO_REASON
    is_undecided: bool = False
    is_at_least: bool = False

    def __repr__(self) -> str:
        said = "yes" if self.value is True else "no"
        if self.value is None:
            said = "undecided" if self.is_undecided else "no meaning"
        elif not isinstance(self.value, bool):
            said = f"{'at least ' if self.is_at_least else ''}{self.value}"
        return f"<Verdict {said}{f': {self.why}' if self.reason else ''}>"

    @classmethod
    def meaningless(cls, why: Reason) -> Verdict:
        return cls(None, why)

    @classmethod
    def undecided(cls, why: str) -> Verdict:
        return cls(None, Reason(why), is_undecided=True)

    @classmethod
    def unless(cls, obstacle: Reason) -> Verdict:
        return cls(not obstacle, obstacle)

    @property
    def why(self) -> str:
        """The reason as text."""
        return str(self.reason)


class NoProperties(Frozen):
    """A method for which no property is defined, and the reason."""

    rounding: fmpq
    why: Reason

    def verdict(self, _: str) -> Verdict:
        return Verdict.meaningless(self.why)
