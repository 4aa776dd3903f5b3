"""Stiffly accurate methods, and those whose last stage is the first of the next step."""

from __future__ import annotations

from garkcli.exact.field import Number
from garkcli.tableau.pointwise import in_points
from garkcli.tableau.tableau import Tableau


def is_stiffly_accurate(tableau: Tableau) -> bool | None:
    """Whether a stage value is the new value: a_ij^{k,m} = b_j^{m} for all m and one stage i.

    For a GARK method that is meant globally (A. Sandu, M. Günther 2015): one stage of one method
    sees all vector fields with their weights. None where the nodes have no simple radicals.

    >>> from garkcli.families.registry import diagonal_method
    >>> from garkcli.tableau.forms import gark
    >>> is_stiffly_accurate(gark([diagonal_method("radau-iia", 2)], {}))
    True
    """
    exact = in_points(tableau)
    if exact is None:
        return None
    return any(
        _is_new_value(exact, k, i)
        for k, space in enumerate(exact.spaces)
        for i in range(space.stages)
    )


def is_first_same_as_last(tableau: Tableau) -> bool | None:
    """Whether the first stage is the old value and the last one the new value: FSAL.

    Then the last evaluation of a step is the first of the next. It is asked of every stage space.
    """
    exact = in_points(tableau)
    if exact is None:
        return None
    spaces = range(len(exact.spaces))
    return all(
        exact.spaces[k].stages > 1
        and _is_old_value(exact, k)
        and _is_new_value(exact, k, exact.spaces[k].stages - 1)
        for k in spaces
    )


def _row(
    tableau: Tableau, space: int, stage: int, colour: int
) -> tuple[Number, ...] | None:
    block = tableau.blocks.get((space, colour))
    return None if block is None else block[stage]


def _is_new_value(tableau: Tableau, space: int, stage: int) -> bool:
    rows = [_row(tableau, space, stage, m) for m in range(tableau.size)]
    weights = [colour.b for colour in tableau.colours]
    return all(row == b for row, b in zip(rows, weights, strict=True))


def _is_old_value(tableau: Tableau, space: int) -> bool:
    rows = [_row(tableau, space, 0, m) for m in range(tableau.size)]
    return not any(entry for row in rows if row is not None for entry in row)
