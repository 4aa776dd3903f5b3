"""Families of methods: tableaus whose entries are rational functions of parameters."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from flint import fmpq, fmpq_mpoly

from garkcli.exact.parametric import Parameters
from garkcli.exact.roots import RealRoot
from garkcli.tableau.embedded import NOTHING, Further
from garkcli.tableau.tableau import Tableau


@dataclass(frozen=True)
class Radical:
    """A root among the coefficients of a family: an unknown of its own.

    Attributes:
        name: of the unknown.
        relation: a polynomial that is zero at it.
        is_even: whether it is an even root: of its zeros the one is meant that is not negative.
        meant: the zero that is meant, where it is one of several real ones.
        text, latex: the root as it is written.
    """

    name: str
    relation: fmpq_mpoly
    is_even: bool = False
    meant: RealRoot | None = None
    text: str = ""
    latex: str = ""


@dataclass(frozen=True)
class Stability:
    """A kind of stability that is wanted.

    Attributes:
        kind: ``a-stable``, ``l-stable`` or ``p-stable``.
        colour: of which diagonal method, counted from 0; None for the whole.
    """

    kind: str
    colour: int | None = None

    def __str__(self) -> str:
        """As people write it, such as A-stable."""
        name = self.kind[0].upper() + self.kind[1:]
        return name if self.colour is None else f"{name} in colour {self.colour + 1}"

    def in_words(self, tableau: Tableau) -> str:
        """The same, and which vector fields are meant where a method has several colours."""
        if tableau.size == 1 or self.kind == "p-stable":
            return str(self)
        fields = "all colours with one λ" if self.colour is None else "the others with λ = 0"
        return f"{self} ({fields})"


@dataclass(frozen=True, repr=False, kw_only=True)
class Family:
    """A family of methods.

    Attributes:
        name: what people call it.
        tableau: its entries are rational numbers and ``Parametric`` ones.
        ring: the parameters, after them unknowns for radicals.
        parameters: the names of the free parameters.
        ranges: for each the least and the greatest value it may have, None where there is none.
        radicals: the roots among the coefficients.
        relations: polynomials that are zero at every method that is wanted of it.
        nonzero: polynomials that are zero at none.
        positive: those that are positive at the solutions that are taken.
        not_negative: those that are at least 0 there.
        order: which is wanted of them, where the file says so.
        stable: kinds of stability that the solutions that are taken have.
        unsettled: what is wanted of them and was not worked out in time, by its keys.
        further: its embedded weights and its dense output.
    """

    name: str
    tableau: Tableau
    ring: Parameters
    parameters: tuple[str, ...]
    ranges: Mapping[str, tuple[fmpq | None, fmpq | None]]
    radicals: tuple[Radical, ...]
    relations: tuple[fmpq_mpoly, ...] = ()
    nonzero: tuple[fmpq_mpoly, ...] = ()
    positive: tuple[fmpq_mpoly, ...] = ()
    not_negative: tuple[fmpq_mpoly, ...] = ()
    order: int | None = None
    stable: tuple[Stability, ...] = ()
    unsettled: tuple[str, ...] = ()
    further: Further = NOTHING

    def __repr__(self) -> str:
        return f"<Family {self.name}: {', '.join(self.parameters)}>"
