"""Stiffly accurate and FSAL methods."""

from __future__ import annotations

from collections.abc import Sequence

from flint import fmpq

from garkcli.exact.field import ZERO
from garkcli.exact.matrix import Vector
from garkcli.frozen import Frozen
from garkcli.order.tolerance import within
from garkcli.tableau.polynomial_space import PolynomialSpace
from garkcli.tableau.tableau import Tableau


class FirstSameAsLast(Frozen):
    """A stage space whose first stage is not the old value, or whose last is not the new one."""

    not_first: int | None = None
    not_last: int | None = None

    @property
    def holds(self) -> bool:
        return self.not_first is None and self.not_last is None


def is_stiffly_accurate(tableau: Tableau, tolerance: fmpq = ZERO) -> bool:
    """Returns whether a stage is the new value: a_ij^{k,m} = b_j^{m} for all m and one i; for a
    GARK method globally (A. Sandu, M. Günther 2015).

    >>> from garkcli.families.registry import diagonal_method
    >>> from garkcli.tableau.forms import gark
    >>> is_stiffly_accurate(gark([diagonal_method("radau-iia", 30)], {}))
    True
    """
    wanted = new_value(tableau)
    for k, space in enumerate(tableau.spaces):
        if isinstance(space, PolynomialSpace):
            from garkcli.properties.family_entries import common_nodes

            if common_nodes(tableau, k, wanted).degree > 0:
                return True
        elif any(not missed_entries(tableau, k, i, wanted, tolerance) for i in range(space.stages)):
            return True
    return False


def first_same_as_last(tableau: Tableau, tolerance: fmpq = ZERO) -> FirstSameAsLast:
    """Whether in every stage space the first stage is the old value, the last one the new one."""
    spaces = range(len(tableau.spaces))
    old, new = old_value(tableau), new_value(tableau)
    for k in spaces:
        if not _is_stage(tableau, k, 0, old):
            return FirstSameAsLast(not_first=k)
    for k in spaces:
        is_single = tableau.spaces[k].stages == 1
        if is_single or not _is_stage(tableau, k, -1, new, tolerance):
            return FirstSameAsLast(not_last=k)
    return FirstSameAsLast()


def new_value(tableau: Tableau) -> list[Vector]:
    return [tuple(colour.b) for colour in tableau.colours]


def old_value(tableau: Tableau) -> list[Vector]:
    return [(ZERO,) * tableau.space(m).stages for m in range(tableau.size)]


def missed_entries(
    tableau: Tableau, k: int, i: int, wanted: Sequence[Vector], tolerance: fmpq = ZERO
) -> list[tuple[int, int]]:
    """The entries (colour, stage) of a stage that differ from ``wanted``, rounded ones by more than
    twice their rounding; missing blocks count as zeros.
    """
    missed = []
    for m, row in enumerate(wanted):
        block = tableau.blocks.get((k, m))
        found = (ZERO,) * len(row) if block is None else block[i]
        for j, (a, b) in enumerate(zip(found, row, strict=True)):
            if a != b and not (tolerance and within(a - b, 2 * tolerance)):
                missed.append((m, j))
    return missed


def _is_stage(
    tableau: Tableau, k: int, i: int, wanted: Sequence[Vector], tolerance: fmpq = ZERO
) -> bool:
    space = tableau.spaces[k]
    if not isinstance(space, PolynomialSpace):
        return not missed_entries(tableau, k, i, wanted, tolerance)
    from garkcli.properties.family_entries import is_family_stage

    return is_family_stage(tableau, k, range(space.stages)[i], wanted)
