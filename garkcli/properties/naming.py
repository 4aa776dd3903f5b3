"""What sentences about a method call its stages and entries, counted from 1."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from itertools import pairwise

from garkcli.exact.display import to_decimal, to_text
from garkcli.exact.field import Number
from garkcli.properties.pattern import Vertex
from garkcli.tableau.tableau import Tableau

_SHORT = 24
"""Longer numbers are shown in decimals."""


def number_text(number: Number) -> str:
    """A number as it is, or its first digits."""
    text = to_text(number)
    if len(text) <= _SHORT:
        return text
    return f"about {to_decimal(number, 6)}"


def entry_name(tableau: Tableau, space: int, m: int, i: int, j: int) -> str:
    """An entry of a block, ``a[2,1]``; of several colours ``a{q,p}[2,1]``.

    >>> from garkcli.families.registry import diagonal_method
    >>> from garkcli.tableau.forms import gark
    >>> entry_name(gark([diagonal_method("heun", None)], {}), 0, 0, 1, 0)
    'a[2,1]'
    """
    seer, *_ = _names_of(tableau, space)
    return place_name("a", tableau, [seer, tableau.colours[m].name], i, j)


def weight_name(tableau: Tableau, m: int, j: int) -> str:
    """A weight of a colour, ``b[1]``."""
    return place_name("b", tableau, [tableau.colours[m].name], j)


def place_name(letter: str, tableau: Tableau, colours: Sequence[str], *indices: int) -> str:
    """An entry of a block or a row, counted from 0; its colours where there are several."""
    whose = f"{{{','.join(colours)}}}" if tableau.size > 1 else ""
    return f"{letter}{whose}[{','.join(str(i + 1) for i in indices)}]"


def stages_name(tableau: Tableau, vertices: Iterable[Vertex]) -> str:
    """Stages by colour.

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
        noun = "stage" if len(stages) == 1 else "stages"
        numbers = ranges(stages)
        whose = _of_colours(tableau, space)
        parts.append(f"{noun} {numbers}{whose}")
    return " and ".join(parts)


def _names_of(tableau: Tableau, space: int) -> list[str]:
    """The colours that share a stage space."""
    return [x.name for x in tableau.colours if x.space == space]


def _of_colours(tableau: Tableau, space: int) -> str:
    if len(tableau.spaces) == 1:
        return ""
    names = _names_of(tableau, space)
    word = "colour" if len(names) == 1 else "colours"
    listed = ", ".join(names)
    return f" of {word} {listed}"


def ranges(numbers: Sequence[int]) -> str:
    """Ascending numbers with runs drawn together.

    >>> ranges([1, 2, 3, 5, 7, 8])
    '1-3, 5, 7-8'
    """
    runs = [[numbers[0]]]
    for before, number in pairwise(numbers):
        if number == before + 1:
            runs[-1].append(number)
        else:
            runs.append([number])
    texts = []
    for first, *others in runs:
        text = str(first)
        if others:
            text += f"-{others[-1]}"
        texts.append(text)
    return ", ".join(texts)
