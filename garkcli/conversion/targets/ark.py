"""All colours on the same stages: an additive method."""

from __future__ import annotations

from dataclasses import replace

from garkcli.conversion.sheet import CannotConvert, Place, Sheet, of_weights, regrouped, sheet_of
from garkcli.conversion.stage_order import in_solving_order
from garkcli.conversion.target import Target
from garkcli.conversion.targets.gark import without_parts
from garkcli.properties.reduction import merged
from garkcli.tableau.garkmethod import GarkMethod
from garkcli.tableau.tableau import Tableau


def as_ark(method: GarkMethod) -> Sheet:
    """The method as an additive one.

    Where the colours have the same stages already these are shared. Otherwise the stages of all
    colours stand one after the other, each with zeros in the columns of the others, and those that
    are equal become one.

    Raises:
        CannotConvert: a colour is linear, or some stages do not see every colour.
    """
    sheet = without_parts(sheet_of(method))
    linear = [x.name for x in sheet.tableau.colours if x.is_linear]
    if linear:
        raise CannotConvert(
            f"colour {linear[0]} is linear, which an additive method does not say",
            "--to gark keeps it",
        )
    together = shared(sheet)
    if together is None:
        together = in_solving_order(_one_after_the_other(sheet))
    return _with_one_row_of_nodes(together)


def shared(sheet: Sheet) -> Sheet | None:
    """The method with one stage space, where stage i of every colour is the same; else None."""
    tableau = sheet.tableau
    first, *others = range(len(tableau.spaces))
    for k in others:
        if not _are_alike(tableau, first, k):
            return None
    stages = tableau.spaces[first].stages
    places: list[Place] = [(first, i) for i in range(stages)]
    # the weights stay as they are: every space is the first one
    colours = [replace(x, space=first) for x in tableau.colours]
    blocks = {key: x for key, x in tableau.blocks.items() if key[0] == first}
    together = replace(tableau, colours=tuple(colours), blocks=blocks)
    alone = replace(sheet, tableau=together)
    return regrouped(alone, [places], [0] * tableau.size)


def _are_alike(tableau: Tableau, one: int, other: int) -> bool:
    """Whether two spaces have the same nodes and see the same."""
    if tableau.spaces[one].nodes != tableau.spaces[other].nodes:
        return False
    return all(
        tableau.blocks.get((one, m)) == tableau.blocks.get((other, m)) for m in range(tableau.size)
    )


def _one_after_the_other(sheet: Sheet) -> Sheet:
    places: list[Place] = []
    for k, space in enumerate(sheet.tableau.spaces):
        places += [(k, i) for i in range(space.stages)]
    together = regrouped(sheet, [places], [0] * sheet.tableau.size)
    return of_weights(together, merged)


def _with_one_row_of_nodes(sheet: Sheet) -> Sheet:
    """The method, where its colours have the same nodes.

    Raises:
        CannotConvert: they do not.
    """
    tableau = sheet.tableau
    nodes = tableau.colours[0].c
    for colour in tableau.colours:
        if colour.c != nodes:
            raise CannotConvert(
                f"colour {colour.name} has nodes of its own; an additive"
                " method has one row of them",
                "--to gark keeps them",
            )
    return sheet


TARGET = Target("ark", "all colours on the same stages", as_ark)
