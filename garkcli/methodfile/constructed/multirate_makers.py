"""Multirate methods from the tableaus of their parts and the values of their couplings."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import TypeAlias

from garkcli.constructions.multirate import (
    Blocks,
    Coupling,
    by_blocks,
    by_rule,
    mis_coupling,
    mri,
    slowest_first,
)
from garkcli.errors import MethodError, counted
from garkcli.exact.field import Number
from garkcli.exact.matrix import Matrix, Vector
from garkcli.methodfile.numbers import Rows
from garkcli.tableau.method import Method
from garkcli.tableau.tableau import Tableau
from garkcli.transfer import RULES

Make: TypeAlias = Callable[[Sequence[Tableau], Vector], Tableau]
"""From the tableaus of the parts, the fast one first, and the values of numbers."""
SLOWEST_FIRST = "slowest-first"
COUPLINGS = (SLOWEST_FIRST, *RULES)
"""The couplings that have names."""


@dataclass(frozen=True)
class Infinitesimal:
    """What makes a multirate infinitesimal method.

    Attributes:
        coupling: of the slow stages, from the tableaus of the parts and the values of numbers.
        steps: small ones, between two slow stages.
    """

    coupling: Callable[[Sequence[Tableau], Vector], Coupling]
    steps: int

    def __call__(self, tableaus: Sequence[Tableau], values: Vector) -> Tableau:
        """The method."""
        fast = _diagonal(tableaus[0], "fast")
        return mri(self.coupling(tableaus, values), fast, self.steps)


def of_mis(steps: int) -> Make:
    """Constant couplings, from a slow method."""

    def coupling(tableaus: Sequence[Tableau], _: Vector) -> Coupling:
        return mis_coupling(_diagonal(tableaus[1], "mis"))

    return Infinitesimal(coupling, steps)


def named(word: str, steps: int) -> Make:
    """A coupling by name."""

    def made(tableaus: Sequence[Tableau], _: Vector) -> Tableau:
        fast, slow = _both(tableaus)
        if word == SLOWEST_FIRST:
            return slowest_first(slow, fast, steps)
        return by_rule(slow, fast, steps, RULES[word])

    return made


def given(blocks: Sequence[Sequence[Rows]]) -> Make:
    """Coupling matrices, from fast to slow and from slow to fast, one for each small step."""
    lengths = [[[len(row) for row in rows] for rows in every] for every in blocks]

    def made(tableaus: Sequence[Tableau], values: Vector) -> Tableau:
        fast, slow = _both(tableaus)
        rest = iter(values)
        of_fast = tuple(_filled(rows, rest) for rows in lengths[0])
        of_slow = tuple(_filled(rows, rest) for rows in lengths[1])
        _check_shape("fast-slow", of_fast[0], fast, slow)
        _check_shape("slow-fast", of_slow[0], slow, fast)
        return by_blocks(slow, fast, Blocks(of_fast, of_slow))

    return made


def _check_shape(key: str, matrix: Matrix, seeing: Method, seen: Method) -> None:
    """Refuse a coupling matrix of another shape than its methods.

    Raises:
        MethodError: that is the case.
    """
    rows, columns = seeing.stages, seen.stages
    if len(matrix) == rows and len(matrix[0]) == columns:
        return
    found = f"{len(matrix)} by {len(matrix[0])}"
    message = f"{key} is {found} and should be {rows} by {columns}"
    cure = "give a row for each stage that sees, a column for each seen"
    raise MethodError(message, cure)


def of_mri(count: int, powers: Sequence[int], steps: int) -> Make:
    """Polynomial couplings between so many nodes, for each slow part with so many powers."""
    lengths = [count] * (count - 1)

    def coupling(_: Sequence[Tableau], values: Vector) -> Coupling:
        rest = iter(values)
        nodes = tuple(next(rest) for _ in range(count))
        matrices = []
        for number in powers:
            of_part = [_filled(lengths, rest) for _ in range(number)]
            matrices.append(tuple(of_part))
        return Coupling(nodes, tuple(matrices))

    return Infinitesimal(coupling, steps)


def _filled(lengths: Sequence[int], rest: Iterator[Number]) -> Matrix:
    """A matrix with rows of these lengths."""
    return tuple(tuple(next(rest) for _ in range(length)) for length in lengths)


def _both(tableaus: Sequence[Tableau]) -> tuple[Method, Method]:
    """The fast method and the slow one."""
    fast, slow = tableaus
    return _diagonal(fast, "fast"), _diagonal(slow, "slow")


def _diagonal(tableau: Tableau, key: str) -> Method:
    """The one colour of the method that stands under a key.

    Raises:
        MethodError: it has several.
    """
    block = tableau.block(0, 0)
    if tableau.size != 1 or block is None:
        message = f"multirate, {key}: a method of {counted(tableau.size, 'colour')}, "
        message += "where one of one vector field is expected"
        raise MethodError(message, "give a method of one colour")
    return Method("", tableau.space(0), block, tableau.colours[0].b)
