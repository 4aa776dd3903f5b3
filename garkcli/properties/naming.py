"""Names of stages and entries in sentences, counted from 1."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from itertools import pairwise

from flint import fmpq

from garkcli.exact.display import shortest, to_decimal
from garkcli.exact.field import Number
from garkcli.properties.pattern import Vertex
from garkcli.reason import Formula, Place, Reason
from garkcli.tableau.tableau import Tableau

_SHORT = 24


def number_words(number: Number) -> Formula | str:
    text = shortest(number)
    if len(text) > _SHORT:
        return f"about {to_decimal(number, 6)}"
    return text if isinstance(number, fmpq) and "." in text else Formula(text)


def entry(tableau: Tableau, space: int, m: int, i: int, j: int) -> Place:
    """An entry of a block, as ``a[2,1]``; with several colours ``a{q,p}[2,1]``."""
    seer = next(l for l, x in enumerate(tableau.colours) if x.space == space)
    return place("a", tableau, [seer, m], i, j)


def place(letter: str, tableau: Tableau, colours: Sequence[int], *indices: int) -> Place:
    """Returns an entry, or without indices a block or row, with its colours if several."""
    names = [tableau.colours[l].name for l in colours] if tableau.size > 1 else []
    return Place(letter, tuple(names), indices)


def entry_is(place: Place, number: Number) -> Reason:
    """A sentence such as ``b[1] is -1/4``."""
    return Reason("{} is {}", place, number_words(number))


def stages_name(tableau: Tableau, vertices: Iterable[Vertex]) -> str:
    """Names stages by colour.

    >>> from garkcli.families.registry import diagonal_method
    >>> from garkcli.tableau.forms import gark
    >>> stages_name(gark([diagonal_method("gauss", 4)], {}), [(0, 0), (0, 1), (0, 3)])
    'stages 1-2, 4'
    """
    by_space: dict[int, list[int]] = {}
    for space, stage in sorted(vertices):
        by_space.setdefault(space, []).append(stage + 1)
    parts = []
    for space, stages in by_space.items():
        part = f"{'stage' if len(stages) == 1 else 'stages'} {_ranges(stages)}"
        if len(tableau.spaces) > 1:
            names = [x.name for x in tableau.colours if x.space == space]
            part += f" of {'colour' if len(names) == 1 else 'colours'} {', '.join(names)}"
        parts.append(part)
    return " and ".join(parts)


def _ranges(numbers: Sequence[int]) -> str:
    """Ascending numbers, with runs contracted: ``1-3, 5, 7-8``."""
    runs = [[numbers[0]]]
    for before, number in pairwise(numbers):
        if number == before + 1:
            runs[-1].append(number)
        else:
            runs.append([number])
    return ", ".join(f"{run[0]}-{run[-1]}" if len(run) > 1 else str(run[0]) for run in runs)
