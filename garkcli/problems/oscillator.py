"""The harmonic oscillator q̈ = −ω²q, split among the vector fields of a tableau.

H = ½p² + ½ω²q² is the sum of H^{l} = ½ k_l p² + ½ ω² v_l q², with Σ k_l = Σ v_l = 1. A colour
drives the whole field of its term, or its position or momentum part only.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, ClassVar, TypeAlias

from flint import fmpq

from garkcli.errors import ExpressionError, UsageProblem
from garkcli.exact.domain import Domain
from garkcli.exact.expression import parse
from garkcli.exact.field import ONE, ZERO
from garkcli.exact.given import AnyNumber, rational_of
from garkcli.exact.matrix import Matrix
from garkcli.frozen import Frozen, force_setattr
from garkcli.tableau.tableau import Colour, Tableau

Shares: TypeAlias = tuple[tuple[fmpq, fmpq], ...]
"""(k_l, v_l) for each term of a split."""


def _is_pair(given: object) -> bool:
    return isinstance(given, Sequence) and len(given) == 2


class Oscillator(Frozen):
    """q̇ = p, ṗ = −ω²q, divided among the terms of a split, with numbers of any kind.

    Attributes:
        omega: ω > 0, in radians per unit of time.
        shares: ``(k_l, v_l)`` for each term, of kinetic and potential energy; both columns sum to
            1.

    Errors:
        UsageProblem: ω is not positive, or a column does not sum to 1.

    >>> Oscillator(0.5, [(1, 0), (0, 1)])
    Oscillator(omega=1/2, shares=((1, 0), (0, 1)))
    >>> from flint import fmpq
    >>> Oscillator.default(3, fmpq(1)).shares
    ((1, 0), (0, 1/2), (0, 1/2))
    """

    omega: fmpq
    shares: Shares
    name: ClassVar[str] = "oscillator"

    if TYPE_CHECKING:

        def __init__(
            self, omega: AnyNumber, shares: Sequence[tuple[AnyNumber, AnyNumber]]
        ) -> None: ...

    def __post_init__(self) -> None:
        omega = rational_of(self.omega, "omega")
        if not all(_is_pair(share) for share in self.shares):
            message = f"the shares {self.shares!r} are not pairs"
            cure = "give (kinetic, potential) for each term, such as [(1, 0), (0, 1)]"
            raise UsageProblem(message, cure, code="split")
        shares = tuple(
            (
                rational_of(k, f"shares of term {term}, kinetic"),
                rational_of(v, f"shares of term {term}, potential"),
            )
            for term, (k, v) in enumerate(self.shares, start=1)
        )
        force_setattr(self, "omega", omega)
        force_setattr(self, "shares", shares)
        if self.omega <= 0:
            message = f"the frequency {self.omega} is not positive"
            raise UsageProblem(message, "give a positive rational, such as 1", code="split")
        for column, energy in enumerate(("kinetic", "potential")):
            total = sum((share[column] for share in self.shares), ZERO)
            if total != 1:
                message = f"the {energy} shares sum to {total}"
                cure = f"they are parts of one {energy} energy: make it 1"
                raise UsageProblem(message, cure, code="split")

    @classmethod
    def default(cls, terms: int, omega: AnyNumber = 1) -> Oscillator:
        """One term: unsplit. More: ½p² to the first, ½ω²q² in equal parts to the others."""
        if terms == 1:
            return cls(omega, ((ONE, ONE),))
        others = terms - 1
        potential = (ZERO, fmpq(1, others))
        return cls(omega, ((ONE, ZERO), *(potential,) * others))

    def drives(self, colour: Colour) -> tuple[fmpq, fmpq]:
        """(k, v): the parts of q̇ = p and of ṗ = −ω²q in the vector field of ``colour``."""
        k, v = self.shares[colour.term]
        if colour.part == "p":
            return ZERO, v
        if colour.part == "q":
            return k, ZERO
        return k, v

    def matrix(self, colour: Colour) -> Matrix:
        """L with (q, p)˙ = L (q, p) for the vector field of ``colour``, shape (2, 2)."""
        k, v = self.drives(colour)
        return ((ZERO, k), (-(self.omega * self.omega * v), ZERO))


def terms_of(tableau: Tableau) -> int:
    return 1 + max(colour.term for colour in tableau.colours)


def parse_shares(text: str, terms: int) -> Shares:
    """Parses ``kinetic:potential`` for each term; UsageProblem unless both columns sum to 1.

    >>> parse_shares("1:0, 0:1/2, 0:1/2", 3)
    ((1, 0), (0, 1/2), (0, 1/2))
    """
    cure = f"write {terms} pairs kinetic:potential, such as {example_shares(terms)}"
    parts = text.split(",")
    if len(parts) != terms:
        message = f"the split {text!r} has {len(parts)} pairs for {terms} terms"
        raise UsageProblem(message, cure, code="split")
    shares = []
    for part in parts:
        texts = part.split(":")
        if len(texts) != 2:
            raise UsageProblem(f"{part.strip()!r} is not a pair of shares", cure, code="split")
        kinetic, potential = map(_share, texts)
        shares.append((kinetic, potential))
    return Oscillator(ONE, tuple(shares)).shares  # checks the sums


def example_shares(terms: int) -> str:
    """The default split in the notation of ``parse_shares``."""
    return ",".join(f"{k}:{v}" for k, v in Oscillator.default(terms, ONE).shares)


def _share(text: str) -> fmpq:
    try:
        expression = parse(text)
        number = Domain([expression]).evaluate(expression)
    except ExpressionError as error:
        raise UsageProblem(
            f"the share {text.strip()!r}: {error.message}",
            error.help or "write a rational number, such as 1/2",
            code="split",
        ) from None
    if not isinstance(number, fmpq):
        message = f"the share {text.strip()!r} is irrational"
        raise UsageProblem(message, "write a rational number, such as 1/2", code="split")
    return number


def check_structure(tableau: Tableau, problem: Oscillator) -> None:
    """Raises UsageProblem unless shares are driven, and l sees m if L^l L^m ≠ 0."""
    terms = terms_of(tableau)
    if len(problem.shares) != terms:
        message = f"the split has {len(problem.shares)} terms, the method {terms}"
        raise UsageProblem(message, f"such as {example_shares(terms)}", code="split")
    for term, (kinetic, potential) in enumerate(problem.shares):
        if kinetic:
            _check_colour(tableau, term, "q", "kinetic")
        if potential:
            _check_colour(tableau, term, "p", "potential")
    driven = [problem.drives(colour) for colour in tableau.colours]
    for l, (k_l, v_l) in enumerate(driven):
        for m, (k_m, v_m) in enumerate(driven):
            is_needed = k_l * v_m or v_l * k_m  # L^l L^m is not zero
            if is_needed and tableau.block(l, m) is None:
                raise _unseen(tableau, l, m)


def _unseen(tableau: Tableau, l: int, m: int) -> UsageProblem:
    """Returns the error if colour l depends on what m drives, and its stages do not see m."""
    one = tableau.colours[l].name
    other = tableau.colours[m].name
    example = example_shares(terms_of(tableau))
    return UsageProblem(
        f"with this split the field of colour {one} depends on variables driven "
        f"by colour {other}, on which its stages do not depend",
        f"give the shares that the structure is for with --split, such as {example}",
        code="split",
    )


def _check_colour(tableau: Tableau, term: int, part: str, energy: str) -> None:
    if {x.part for x in tableau.colours if x.term == term}.isdisjoint({"y", part}):
        message = f"term {term + 1} has {energy} energy, but the method has no colour for it"
        cure = f"move the {energy} share to another term with --split"
        raise UsageProblem(message, cure, code="split")
