"""Every colour with stages of its own, entry by entry."""

from __future__ import annotations

from dataclasses import replace

from garkcli.conversion.sheet import Sheet, each_its_own, sheet_of
from garkcli.conversion.target import Target
from garkcli.tableau.garkmethod import GarkMethod


def as_gark(method: GarkMethod) -> Sheet:
    """The method as a GARK method.

    The parts q and p of a partitioned method become colours whose vector fields are zero in the
    other part.
    """
    return without_parts(each_its_own(sheet_of(method)))


def without_parts(sheet: Sheet) -> Sheet:
    """The method for vector fields that drive all unknowns, its colours numbered."""
    colours = []
    for l, colour in enumerate(sheet.tableau.colours):
        changed = replace(colour, name=str(l + 1), term=l, part="y")
        colours.append(changed)
    tableau = replace(sheet.tableau, colours=tuple(colours))
    return replace(sheet, tableau=tableau)


TARGET = Target("gark", "every colour with stages of its own, block by block", as_gark)
