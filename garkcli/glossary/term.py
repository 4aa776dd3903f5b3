"""What a term of the field is."""

from __future__ import annotations

from dataclasses import dataclass

PAPER = (
    "A. Zanna, Discrete Variational Methods and Symplectic Generalized Additive Runge–Kutta Methods"
)
"""The paper; sources name its sections."""


def paper(section: str) -> str:
    """A section of the paper as a source."""
    return f"{PAPER}, {section}"


@dataclass(frozen=True)
class Term:
    """A term with its meaning.

    Attributes:
        name: as people look for it.
        text: what it is, in whole sentences.
        formula: the definition in signs; empty where there is none.
        source: where it comes from: the paper's section or another.
        labels: what reports call it, and other names.
        see: names of terms near it.
    """

    name: str
    text: str
    formula: str = ""
    source: str = ""
    labels: tuple[str, ...] = ()
    see: tuple[str, ...] = ()
