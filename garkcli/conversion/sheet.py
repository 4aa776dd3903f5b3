"""A method entry by entry, with its further weights: the data of conversions."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from itertools import chain
from typing import TypeAlias

from garkcli.errors import LimitExceeded, MethodError
from garkcli.exact.domain import Domain
from garkcli.exact.field import ZERO, Algebraic, Number, with_radicals
from garkcli.exact.matrix import Matrix, Vector
from garkcli.exact.nodes import Expression
from garkcli.frozen import Frozen, replace
from garkcli.tableau.embedded import NOTHING, Further, as_colours, from_colours
from garkcli.tableau.garkmethod import GarkMethod
from garkcli.tableau.pointwise import in_points
from garkcli.tableau.stages import PointSpace
from garkcli.tableau.tableau import Edge, Tableau


class OneField:
    """The smallest field that contains some numbers, and the map into it.

    Only numbers from one ``NumberField`` object can be added; those of two files are not, even if
    both are in ℚ(√3). LimitExceeded if they generate too large a field.

    >>> from garkcli.exact.expression import parse
    >>> c = [parse(text) for text in ("sqrt(12)", "2*sqrt(3)", "sqrt(5)")]
    >>> one, other, third = (Domain([x]).evaluate(x) for x in c)
    >>> into = OneField([one, other, third])
    >>> into.number(one) == into.number(other)
    True
    >>> into.number(one) * into.number(third)
    2*sqrt(3)*sqrt(5)
    """

    def __init__(self, numbers: Iterable[Number]) -> None:
        irrational = (x for x in numbers if isinstance(x, Algebraic))
        fields = {id(x.field): x.field for x in irrational}.values()
        self._images: dict[int, list[Number]] = {}
        self._fields = fields  # kept, so that ids stay theirs
        if len(fields) < 2:
            return
        radicals: list[Expression] = []
        for field in fields:
            radicals += [radical for radical, _ in field.radicals]
        domain = Domain(radicals)
        for field in fields:
            self._images[id(field)] = [domain.evaluate(x) for x, _ in field.radicals]

    def number(self, number: Number) -> Number:
        if not isinstance(number, Algebraic) or not self._images:
            return number
        image: Number = with_radicals(number, self._images[id(number.field)])
        return image


Place: TypeAlias = tuple[int, int] | None
"""A stage (space, index) of the old method; None for an added one, with zeros."""


class CannotConvert(MethodError):
    """The method has no such form; the message says why."""

    code = "cannot-convert"


class Sheet(Frozen):
    """A method on point stages with its further weights; all numbers are from one field."""

    tableau: Tableau
    further: Further = NOTHING


def sheet_of(method: GarkMethod) -> Sheet:
    """CannotConvert if the nodes have no simple radicals."""
    exact = in_points(method.tableau)
    if exact is None:
        message = "the nodes have no simple radicals, so the method cannot be spelled out exactly"
        cure = "gark tableau --format yaml --digits 17 writes decimals"
        raise CannotConvert(message, cure, code="no-radicals")
    return in_one_field([Sheet(exact, method.further)])[0]


def in_one_field(sheets: Sequence[Sheet]) -> list[Sheet]:
    """Comparable sheets; CannotConvert if the numbers generate too large a field."""
    rows = chain.from_iterable(map(all_rows, sheets))
    try:
        field = OneField(chain.from_iterable(rows))
    except LimitExceeded as error:
        message = f"the numbers have no common field: {error.message}"
        raise CannotConvert(message, "compare decimals", code="no-radicals") from None
    return [_mapped(sheet, field) for sheet in sheets]


def all_rows(sheet: Sheet) -> Iterator[Vector]:
    for space in sheet.tableau.spaces:
        yield space.nodes
    for colour in sheet.tableau.colours:
        yield colour.b
        yield colour.c
    for block in sheet.tableau.blocks.values():
        yield from block
    for rows in sheet.further.rows:
        yield from rows


def _mapped(sheet: Sheet, field: OneField) -> Sheet:
    return Sheet(sheet.tableau.changed(field.number), sheet.further.changed(field.number))


def regrouped(sheet: Sheet, spaces: Sequence[Sequence[Place]], homes: Sequence[int]) -> Sheet:
    """Moves stages to other spaces; ``homes`` are the new spaces of colours. Raises CannotConvert
    if stages of one space see different colours.
    """
    homes = [*homes] * (1 + len(sheet.further.rows))

    def change(tableau: Tableau) -> Tableau:
        colours = []
        for l, colour in enumerate(tableau.colours):
            places = spaces[homes[l]]
            b = _chosen(colour.b, colour.space, places)
            nodes = list(_nodes(tableau, places))
            for new, place in enumerate(places):
                if place is not None and place[0] == colour.space:
                    nodes[new] = colour.c[place[1]]
            colours.append(replace(colour, space=homes[l], b=b, c=tuple(nodes)))
        blocks: dict[Edge, Matrix] = {}
        for k, places in enumerate(spaces):
            for m, home in enumerate(homes):
                block = _block(tableau, m, places, spaces[home])
                if block is not None:
                    blocks[k, m] = block
        made = tuple(PointSpace(_nodes(tableau, places)) for places in spaces)
        return Tableau(made, tuple(colours), blocks)

    return of_weights(sheet, change)


def arranged(sheet: Sheet, spaces: Sequence[Sequence[Place]]) -> Sheet:
    return regrouped(sheet, spaces, [colour.space for colour in sheet.tableau.colours])


def _nodes(tableau: Tableau, places: Iterable[Place]) -> Vector:
    return tuple(
        ZERO if place is None else tableau.spaces[place[0]].nodes[place[1]] for place in places
    )


def _chosen(row: Vector, space: int, places: Iterable[Place]) -> Vector:
    return tuple(ZERO if place is None or place[0] != space else row[place[1]] for place in places)


def _block(
    tableau: Tableau, m: int, rows: Sequence[Place], columns: Sequence[Place]
) -> Matrix | None:
    """Returns the entries at places; None if the new stages do not see the colour."""
    space = tableau.colours[m].space
    seeing = {place[0] for place in rows if place is not None}
    blind = [k for k in seeing if (k, m) not in tableau.blocks]
    if len(blind) == len(seeing):
        return None
    if blind:
        name = tableau.colours[m].name
        raise CannotConvert(
            f"some stages do not depend on colour {name}, and would if all shared their stages",
            "a null block is kept by --to gark",
        )
    made: list[Vector] = []
    for place in rows:
        if place is None:
            made.append((ZERO,) * len(columns))
            continue
        k, stage = place
        made.append(_chosen(tableau.blocks[k, m][stage], space, columns))
    return tuple(made)


def each_its_own(sheet: Sheet) -> Sheet:
    old = sheet.tableau
    spaces = [[(x.space, i) for i in range(len(x.b))] for x in old.colours]
    return regrouped(sheet, spaces, range(old.size))


def of_weights(sheet: Sheet, change: Callable[[Tableau], Tableau | None]) -> Sheet:
    """The method with its further weights after a change of the tableau.

    Each further row of weights is changed like that of one more colour, which no stage sees.
    CannotConvert if the change returns None.
    """
    changed = change(as_colours(sheet.tableau, sheet.further))
    if changed is None:
        raise CannotConvert("equal stages are not sought", "spell it out", code="no-radicals")
    return Sheet(*from_colours(changed, sheet.further))
