"""What a property is: its name in method files, its definition, and how it is decided."""

from __future__ import annotations

from collections.abc import Callable
from math import inf
from typing import TYPE_CHECKING, Any, Literal, TypeAlias

from garkcli.frozen import Frozen
from garkcli.reason import NO_REASON, Formula, Reason

if TYPE_CHECKING:
    from flint import fmpq

    from garkcli.exact.roots import RealRoot
    from garkcli.properties.subject import Subject

Kind: TypeAlias = Literal["truth", "count", "number"]
"""What a property is: true or false, a whole number, or a real number that may be infinite."""
KINDS: dict[Kind, str] = {
    "truth": "`true` or `false`",
    "count": 'a whole number, or `">= n"`',
    "number": "an exact number such as `2*sqrt(2)`, a decimal that it is rounded to,"
    ' `infinity`, or `">= x"`',
}
"""How a claim on each kind is written."""
_DIGITS = 12
_LONG = 60
"""Longer polynomials are not shown."""


class Size(Frozen):
    """A real number that may be infinite.

    Attributes:
        root: the number; None for ∞.
    """

    root: RealRoot | None

    def __float__(self) -> float:
        """A float next to it; nothing is decided with it."""
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
        """The number in the signs of a dialect."""
        return size_reason(str(self)).words(dialect)


def size_reason(text: str) -> Reason:
    """The text of a ``Size``, its formulas told from its words."""
    number, sign, polynomial = text.partition(", a root of ")
    if sign:
        return Reason(f"{number}{sign}{{}}", Formula(polynomial))
    return Reason(text) if text == "infinity" else Reason("{}", Formula(text))


Value: TypeAlias = "bool | int | Size"


class Verdict(Frozen):
    """What was found.

    Attributes:
        value: of the kind of the property; None where it has no meaning or is not decided.
        reason: the entry, the pole or the polynomial that decides; why there is no value.
        is_undecided: whether it has a meaning, but is not decided.
        is_at_least: whether a whole number may be larger.
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
        """The property has no meaning for the method."""
        return cls(None, why)

    @classmethod
    def undecided(cls, why: str) -> Verdict:
        """It has a meaning, and is undecided."""
        return cls(None, Reason(why), is_undecided=True)

    @classmethod
    def unless(cls, obstacle: Reason) -> Verdict:
        """True, or false with what is in its way."""
        return cls(not obstacle, obstacle)

    @property
    def why(self) -> str:
        """The reason as text."""
        return str(self.reason)


class NoProperties(Frozen):
    """A method for which no property has a meaning.

    Attributes:
        rounding: by how much its printed coefficients may be off.
        why: what the properties are of.
    """

    rounding: fmpq
    why: Reason

    def verdict(self, _: str) -> Verdict:
        """What is true of a property."""
        return Verdict.meaningless(self.why)


class Property(Frozen):
    """A property that a method file may claim.

    Attributes:
        key: its name in ``expect``.
        text: its definition, in whole sentences.
        source: where the definition comes from.
        kind: what its values are.
        decide: from a method to a verdict.
        meaning: for which methods it has a meaning; empty for all.
        is_cheap: whether every ``gark check`` decides it; the others are decided where they are
            claimed or asked for.
    """

    key: str
    text: str
    source: str
    kind: Kind
    decide: Callable[[Subject], Verdict]
    meaning: str = ""
    is_cheap: bool = True

    @property
    def field(self) -> str:
        """Its name in JSON."""
        return self.key.replace("-", "_")


SEES_ALL = "methods whose stages all see all vector fields"
"""For which methods some properties have a meaning."""


def claimed(
    source: str, kind: Kind = "truth", meaning: str = "", is_cheap: bool = True
) -> Callable[[Callable[[Subject], Verdict]], Property]:
    """The property that a function decides: its name is the key, its docstring the definition."""

    def made(decide: Callable[[Subject], Verdict]) -> Property:
        key, text = decide.__name__.replace("_", "-"), " ".join((decide.__doc__ or "").split())
        return Property(key, text, source, kind, decide, meaning, is_cheap)

    return made
