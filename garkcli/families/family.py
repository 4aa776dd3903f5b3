"""Families of diagonal methods, the choice of their members, and recipes."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TypeAlias

from garkcli.exact.matrix import Vector
from garkcli.exact.nodes import Expression
from garkcli.frozen import Frozen
from garkcli.reference import Reference
from garkcli.tableau.tableau import Method

Given: TypeAlias = "str | int | Expression"
Options: TypeAlias = Mapping[str, Given]


class Option(Frozen):
    """An option that chooses a member of a family: its size, or another one.

    Attributes:
        words: the allowed words; empty for a number.
        smallest: the smallest integer allowed; None for a coefficient.
        default: the default word; empty if the option is required.
        shown: the value in an example; empty for the first allowed one.
    """

    name: str
    text: str
    words: tuple[str, ...] = ()
    smallest: int | None = None
    default: str = ""
    shown: str = ""

    @property
    def example(self) -> str:
        if self.shown:
            return self.shown
        if self.words:
            return self.words[0]
        return "1/3" if self.smallest is None else str(self.smallest + 1)


STAGES = Option("stages", "How many stages the member of the family has.", smallest=1)


class Recipe(Frozen):
    """``make`` takes values of the irrational ``numbers`` in one domain."""

    stages: int
    make: Callable[[Vector], Method]
    numbers: tuple[Expression, ...] = ()


class MethodFamily(Frozen):
    """``order`` is in terms of the size ``counted``, for people."""

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
        return self.counted.name

    @property
    def is_single(self) -> bool:
        return self.smallest == self.largest

    @property
    def needed(self) -> tuple[Option, ...]:
        size = () if self.is_single else (self.counted,)
        return (*size, *(option for option in self.options if option.default == ""))

    @property
    def stands_alone(self) -> bool:
        """Whether the name alone is a method."""
        return not self.needed

    @property
    def example(self) -> str:
        """``gauss-2``."""
        size = max(2, self.smallest)
        if self.needed == (self.counted,):
            return f"{self.name}-{size}"
        chosen = {x.name: str(size) if x is self.counted else x.example for x in self.needed}
        return f"{{family: {self.name}, {', '.join(f'{x}: {y}' for x, y in chosen.items())}}}"

    @property
    def keys(self) -> tuple[str, ...]:
        return tuple(option.name for option in self.chosen)

    @property
    def chosen(self) -> tuple[Option, ...]:
        return (self.counted, *self.options)


NONSTIFF = Reference(
    authors=("E. Hairer", "S. P. Nørsett", "G. Wanner"),
    title="Solving Ordinary Differential Equations I",
    publisher="Springer",
    year="1993",
)
MAX_STAGES = 200


def by_stages(make: Callable[[int], Method]) -> Callable[..., Recipe]:
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
    largest: int = MAX_STAGES,
) -> MethodFamily:
    """Members have any number of stages and no options."""
    return MethodFamily(
        name, by_stages(make), smallest, largest, order, summary, reference=reference
    )
