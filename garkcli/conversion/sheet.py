"""A method entry by entry, with its further rows of weights: what conversions work on."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from typing import TypeAlias

from garkcli.conversion.one_field import OneField, all_numbers
from garkcli.errors import LimitExceeded, MethodError
from garkcli.exact.field import ZERO, Number
from garkcli.exact.matrix import Matrix, Vector
from garkcli.tableau.embedded import DenseOutput
from garkcli.tableau.garkmethod import GarkMethod
from garkcli.tableau.point_space import PointSpace
from garkcli.tableau.pointwise import in_points
from garkcli.tableau.tableau import Colour, Edge, Tableau

Rows: TypeAlias = tuple[Vector, ...]
"""A row of weights a colour, one weight a stage of that colour."""
Place: TypeAlias = tuple[int, int] | None
"""A stage (space, number) of the method before; None for one that is added, with zeros."""


class CannotConvert(MethodError):
    """A method that has no such form; the message says why."""

    code = "cannot-convert"


@dataclass(frozen=True)
class Sheet:
    """A method with one coordinate a stage.

    Attributes:
        tableau: over point spaces, all numbers from one field.
        further: rows of weights besides b: the embedded ones, then the coefficients of θ, θ², …
            of the dense ones; a row a colour each.
        has_embedded: whether the first of these are embedded ones.
    """

    tableau: Tableau
    further: tuple[Rows, ...] = ()
    has_embedded: bool = False

    @property
    def embedded(self) -> Rows | None:
        """The embedded weights; None where there are none."""
        return self.further[0] if self.has_embedded else None

    @property
    def powers(self) -> tuple[Rows, ...]:
        """What stands before θ, θ², … in the dense weights."""
        return self.further[1:] if self.has_embedded else self.further

    @property
    def dense(self) -> DenseOutput | None:
        """The dense weights; None where there are none."""
        if not self.powers:
            return None
        weights = []
        for l in range(self.tableau.size):
            rows = [power[l] for power in self.powers]
            weights.append(tuple(zip(*rows, strict=True)))
        return DenseOutput(tuple(weights))


def sheet_of(method: GarkMethod) -> Sheet:
    """The entries of a method, with its embedded weights and its dense output.

    Raises:
        CannotConvert: its nodes have no simple radicals.
    """
    exact = in_points(method.tableau)
    if exact is None:
        raise CannotConvert(
            "the nodes have no simple radicals, so the method cannot be spelled out exactly",
            "gark tableau --format yaml --digits 17 writes decimals",
            code="no-radicals",
        )
    has_embedded = method.embedded is not None
    sheet = Sheet(exact, _further(method), has_embedded)
    return in_one_field([sheet])[0]


def _further(method: GarkMethod) -> tuple[Rows, ...]:
    rows: list[Rows] = []
    if method.embedded is not None:
        rows.append(method.embedded)
    if method.dense is not None:
        powers = range(1, method.dense.degree + 1)
        rows += [method.dense.coefficients(power) for power in powers]
    return tuple(rows)


def in_one_field(sheets: Sequence[Sheet]) -> list[Sheet]:
    """The same sheets with numbers that can be compared with each other.

    Raises:
        CannotConvert: the numbers generate too large a field.
    """
    rows: list[Vector] = []
    for sheet in sheets:
        rows += all_rows(sheet)
    try:
        field = OneField(all_numbers(rows))
    except LimitExceeded as error:
        raise CannotConvert(
            f"the numbers have no common field: {error.message}",
            "compare decimals",
            code="no-radicals",
        ) from None
    return [_mapped(sheet, field) for sheet in sheets]


def all_rows(sheet: Sheet) -> Iterator[Vector]:
    """All rows of numbers."""
    for space in sheet.tableau.spaces:
        yield space.nodes
    for colour in sheet.tableau.colours:
        yield colour.b
        yield colour.c
    for block in sheet.tableau.blocks.values():
        yield from block
    for rows in sheet.further:
        yield from rows


def _mapped(sheet: Sheet, field: OneField) -> Sheet:
    """The sheet with each number as it is in a larger field."""
    old = sheet.tableau
    spaces = [PointSpace(field.vector(space.nodes)) for space in old.spaces]
    colours = []
    for colour in old.colours:
        b, c = field.vector(colour.b), field.vector(colour.c)
        colours.append(replace(colour, b=b, c=c))
    blocks = {key: field.matrix(block) for key, block in old.blocks.items()}
    tableau = Tableau(tuple(spaces), tuple(colours), blocks)
    further = tuple(field.matrix(rows) for rows in sheet.further)
    return replace(sheet, tableau=tableau, further=further)


def regrouped(sheet: Sheet, spaces: Sequence[Sequence[Place]], homes: Sequence[int]) -> Sheet:
    """The method with its stages arranged anew.

    Args:
        sheet: the method.
        spaces: for each new stage space its stages.
        homes: for each colour the new space that has all of its stages.

    Raises:
        CannotConvert: a new space has stages that see a colour, and others that do not.
    """
    old = sheet.tableau
    made = [PointSpace(_nodes(old, places)) for places in spaces]
    colours = []
    for l, colour in enumerate(old.colours):
        places = spaces[homes[l]]
        b = _chosen(colour.b, colour.space, places)
        c = _nodes_of(old, colour, places)
        colours.append(replace(colour, space=homes[l], b=b, c=c))
    blocks: dict[Edge, Matrix] = {}
    for k, places in enumerate(spaces):
        for m, home in enumerate(homes):
            block = _block(old, m, places, spaces[home])
            if block is not None:
                blocks[k, m] = block
    tableau = Tableau(tuple(made), tuple(colours), blocks)
    places_of = [spaces[home] for home in homes]
    further = [_weights(old, rows, places_of) for rows in sheet.further]
    return replace(sheet, tableau=tableau, further=tuple(further))


def _weights(tableau: Tableau, rows: Rows, places_of: Sequence[Sequence[Place]]) -> Rows:
    """Weights at the new stages of each colour."""
    found = []
    for l, colour in enumerate(tableau.colours):
        row = _chosen(rows[l], colour.space, places_of[l])
        found.append(row)
    return tuple(found)


def arranged(sheet: Sheet, spaces: Sequence[Sequence[Place]]) -> Sheet:
    """The method with the stages of each space arranged anew, its colours where they are."""
    homes = [colour.space for colour in sheet.tableau.colours]
    return regrouped(sheet, spaces, homes)


def _nodes(tableau: Tableau, places: Iterable[Place]) -> Vector:
    """The nodes of stages; 0 at those that are added."""
    nodes: list[Number] = []
    for place in places:
        if place is None:
            nodes.append(ZERO)
        else:
            space, stage = place
            nodes.append(tableau.spaces[space].nodes[stage])
    return tuple(nodes)


def _nodes_of(tableau: Tableau, colour: Colour, places: Sequence[Place]) -> Vector:
    """The same, for the stages of a colour those that the colour has."""
    nodes = list(_nodes(tableau, places))
    for new, place in enumerate(places):
        if place is None:
            continue
        space, stage = place
        if space == colour.space:
            nodes[new] = colour.c[stage]
    return tuple(nodes)


def _chosen(row: Vector, space: int, places: Iterable[Place]) -> Vector:
    """A row over the stages of one space; 0 at all others."""
    chosen: list[Number] = []
    for place in places:
        if place is None or place[0] != space:
            chosen.append(ZERO)
        else:
            _, stage = place
            chosen.append(row[stage])
    return tuple(chosen)


def _block(
    tableau: Tableau, m: int, rows: Sequence[Place], columns: Sequence[Place]
) -> Matrix | None:
    """What new stages see of a colour; None where they do not see it."""
    space = tableau.colours[m].space
    seeing = {place[0] for place in rows if place is not None}
    blind = [k for k in seeing if (k, m) not in tableau.blocks]
    if len(blind) == len(seeing):
        return None
    if blind:
        name = tableau.colours[m].name
        raise CannotConvert(
            f"some stages do not see colour {name}, and would see it where all share their stages",
            "a null block is kept by --to gark",
        )
    made: list[Vector] = []
    for place in rows:
        if place is None:
            made.append((ZERO,) * len(columns))
            continue
        k, stage = place
        row = tableau.blocks[k, m][stage]
        made.append(_chosen(row, space, columns))
    return tuple(made)


def each_its_own(sheet: Sheet) -> Sheet:
    """The method with stages of its own for every colour."""
    old = sheet.tableau
    spaces = [_places(old, colour.space) for colour in old.colours]
    return regrouped(sheet, spaces, range(old.size))


def _places(tableau: Tableau, space: int) -> list[Place]:
    stages = tableau.spaces[space].stages
    return [(space, i) for i in range(stages)]


def of_weights(sheet: Sheet, change: Callable[[Tableau], Tableau | None]) -> Sheet:
    """What a change of the tableau makes of the method and of its further weights.

    The change sees each further row of weights as that of one more colour, which no stage sees.

    Raises:
        CannotConvert: the change is not made.
    """
    old = sheet.tableau
    colours = list(old.colours)
    for rows in sheet.further:
        for colour, row in zip(old.colours, rows, strict=True):
            colours.append(replace(colour, b=row))
    changed = change(replace(old, colours=tuple(colours)))
    if changed is None:
        raise CannotConvert("equal stages are not looked for", "spell it out", code="no-radicals")
    weights = [colour.b for colour in changed.colours]
    starts = range(old.size, len(weights), old.size)
    further = [tuple(weights[k : k + old.size]) for k in starts]
    own = changed.colours[: old.size]
    tableau = replace(changed, colours=own)
    return replace(sheet, tableau=tableau, further=tuple(further))
