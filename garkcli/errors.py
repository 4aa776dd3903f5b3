"""Every mistake the program knows by name; nothing else reaches the command line.

GarkError                     what is wrong, and the cure
├── ExpressionError           a text that is no exact number; knows the offset of the fault
│   ├── LimitExceeded         … too long, too deep or too large to be a coefficient
│   └── UndefinedValue        … division by zero, an even root of a negative number, an unknown name
├── MethodError               numbers that do not make the method asked for
│   ├── ShapeMismatch         a matrix or row of the wrong size
│   ├── CoincidingNodes       a rule interpolates at nodes that are not distinct
│   ├── ZeroWeight            a conjugate divides by a weight that is zero
│   └── UnknownFamily         no such family, or not with that many stages
├── NoLegendreTransform       a Lagrangian whose Hamiltonian is not found
├── MethodFileError           one or more faults of a method or problem file, each with its position
└── UsageProblem              options that do not go together with the method at hand
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass


class GarkError(Exception):
    """Base of all errors of the program: ``message`` says what and where, ``help`` says the
    cure.
    """

    def __init__(self, message: str, help: str = "") -> None:  # noqa: A002 -- the word users see
        super().__init__(message)
        self.message = message
        self.help = help

    def __str__(self) -> str:
        return f"{self.message}; {self.help}" if self.help else self.message


class ExpressionError(GarkError):
    """A text is not an exact number. ``start`` and ``end`` are offsets into the text."""

    def __init__(self, message: str, help: str = "", start: int = 0, end: int = 0) -> None:  # noqa: A002
        super().__init__(message, help)
        self.start = start
        self.end = end


class LimitExceeded(ExpressionError):
    """A text is longer, deeper or larger than any coefficient needs to be."""


class UndefinedValue(ExpressionError):
    """A text is well formed but names no real number."""


class MethodError(GarkError):
    """Numbers that do not make the method asked for."""


class ShapeMismatch(MethodError):
    """A matrix or a row does not have the size its place asks for."""


class CoincidingNodes(MethodError):
    """Interpolation was asked for at nodes that are not distinct."""


class ZeroWeight(MethodError):
    """A symplectic conjugate was asked for where a weight is zero."""


class UnknownFamily(MethodError):
    """No family of that name, or not with that many stages."""


class NoLegendreTransform(GarkError):
    """The momenta of a Lagrangian could not be solved for its velocities."""


class UsageProblem(GarkError):
    """The options of a command do not fit the method or each other."""


@dataclass(frozen=True)
class Fault:
    """One fault of a method or problem file; ``line`` and ``column`` count from 1 and are 0 where
    unknown.
    """

    message: str
    help: str = ""
    line: int = 0
    column: int = 0


def did_you_mean(word: str, known: Iterable[str]) -> str:
    """The cure for a misspelt word: the nearest known one, or all of them.

    >>> did_you_mean("colocation", ["collocation", "interpolation"])
    "did you mean 'collocation'?"
    """
    from difflib import get_close_matches  # paid for by mistakes alone

    known = list(known)
    close = get_close_matches(word, known, n=1)
    return f"did you mean {close[0]!r}?" if close else f"one of: {', '.join(known)}"


def counted(count: int, noun: str, plural: str = "") -> str:
    """A number of things.

    >>> counted(1, "entry", "entries"), counted(2, "stage")
    ('1 entry', '2 stages')
    """
    return f"{count} {noun if count == 1 else plural or noun + 's'}"


class MethodFileError(GarkError):
    """A file that cannot be read as a method or a problem: every fault found in it, in file
    order.
    """

    def __init__(self, source: str, faults: Sequence[Fault], text: str = "") -> None:
        super().__init__("; ".join(fault.message for fault in faults))
        self.source = source
        self.faults = tuple(faults)
        self.text = text
