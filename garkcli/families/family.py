"""What a family of diagonal methods is: how its members are chosen and made."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TypeAlias

from garkcli.exact.matrix import Vector
from garkcli.exact.nodes import Expression
from garkcli.frozen import Frozen
from garkcli.reference import Reference
from garkcli.tableau.tableau import Method

Given: TypeAlias = "str | int | Expression"
"""What an option is set to: a word, a whole number or a coefficient."""
Options: TypeAlias = Mapping[str, Given]


class Option(Frozen):
    """What a member is chosen by: its size, or more.

    Attributes:
        name: its key in method files.
        text: what it is, in a sentence.
        words: the words it may be; none for a number.
        smallest: of a whole number the least it may be; None for a coefficient.
        default: the word that is meant where it is left out; empty where it has to be given.
        shown: what is behind its key in an example; empty for the first that may.
    """

    name: str
    text: str
    words: tuple[str, ...] = ()
    smallest: int | None = None
    default: str = ""
    shown: str = ""

    @property
    def example(self) -> str:
        """What may be behind its key."""
        if self.shown:
            return self.shown
        if self.words:
            return self.words[0]
        return "1/3" if self.smallest is None else str(self.smallest + 1)


STAGES = Option("stages", "How many stages the member of the family has.", smallest=1)


class Recipe(Frozen):
    """One member, not made yet.

    Attributes:
        stages: how many it has.
        make: the method, from the values of ``numbers`` in one exact domain.
        numbers: what it takes besides rational numbers: coefficients that are given, irrational
            nodes.
    """

    stages: int
    make: Callable[[Vector], Method]
    numbers: tuple[Expression, ...] = ()


class Family(Frozen):
    """A family of diagonal methods.

    Attributes:
        name: as in method files.
        recipe: how the member of a size, with values for all options, is made.
        smallest: the least size it has.
        largest: the greatest one; equal to ``smallest`` for a single method.
        order: its order in terms of the size, or s for stages, for people.
        summary: one line.
        counted: what its size is.
        options: what else a member is chosen by.
        reference: where it was published.
    """

    name: str
    recipe: Callable[[int, Options], Recipe]
    smallest: int
    largest: int
    order: str
    summary: str
    counted: Option = STAGES
    options: tuple[Option, ...] = ()
    reference: Reference = Reference()

    @property
    def size(self) -> str:
        """The key in method files of what it is counted by."""
        return self.counted.name

    @property
    def is_single(self) -> bool:
        """Whether it is one method, or one for given options."""
        return self.smallest == self.largest

    @property
    def keys(self) -> tuple[str, ...]:
        """The keys that choose a member, besides ``family``."""
        return tuple(option.name for option in self.chosen)

    @property
    def chosen(self) -> tuple[Option, ...]:
        """What a member is chosen by."""
        return (self.counted, *self.options)


NONSTIFF = Reference(
    authors=("E. Hairer", "S. P. Nørsett", "G. Wanner"),
    title="Solving Ordinary Differential Equations I",
    publisher="Springer",
    year="1993",
)
"""The book that has most of the explicit families."""
MAX_STAGES = 200
"""Most stages of a member."""


def by_stages(make: Callable[[int], Method]) -> Callable[..., Recipe]:
    """The recipe of a family whose members have a number of stages and no options."""

    def recipe(stages: int, _: Options) -> Recipe:
        return Recipe(stages, lambda _: make(stages))

    return recipe


def of_stages(
    name: str,
    make: Callable[[int], Method],
    smallest: int,
    order: str,
    summary: str,
    reference: Reference = Reference(),  # noqa: B008 -- a value that does not change
) -> Family:
    """A family whose members have any number of stages and no options."""
    return Family(name, by_stages(make), smallest, MAX_STAGES, order, summary, reference=reference)
