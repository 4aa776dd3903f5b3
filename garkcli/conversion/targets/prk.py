"""Two colours as the parts q and p of a partitioned method."""

from __future__ import annotations

from dataclasses import replace

from garkcli.conversion.sheet import CannotConvert, Sheet, sheet_of
from garkcli.conversion.target import Target
from garkcli.conversion.targets.ark import shared
from garkcli.errors import counted
from garkcli.tableau.garkmethod import GarkMethod
from garkcli.tableau.tableau import Part, Tableau


def as_prk(method: GarkMethod) -> Sheet:
    """The method as a partitioned one: colour 1 drives q, colour 2 drives p.

    Raises:
        CannotConvert: it has not two colours, or these neither share their stages nor leave
            themselves unseen.
    """
    sheet = sheet_of(method)
    tableau = sheet.tableau
    if tableau.size != 2:
        raise CannotConvert(
            f"a partitioned method has two parts, this one has {counted(tableau.size, 'colour')}",
            "--to gark has every number of colours",
        )
    if not _is_separable(tableau):
        together = shared(sheet)
        if together is None:
            raise CannotConvert(
                "the colours neither have the same stages nor leave themselves unseen (null)",
                "--to ark puts all stages together first",
            )
        sheet = together
    elif tableau.colours[1].is_linear:
        raise CannotConvert(
            "the file of a partitioned method says that q is linear, not p", "exchange the colours"
        )
    return _with_parts(sheet)


def _is_separable(tableau: Tableau) -> bool:
    """Whether each colour sees the other alone."""
    edges = {(0, 1), (1, 0)}
    return len(tableau.spaces) == 2 and set(tableau.edges()) == edges


def _with_parts(sheet: Sheet) -> Sheet:
    parts: tuple[Part, ...] = ("q", "p")
    colours = []
    numbered = enumerate(zip(sheet.tableau.colours, parts, strict=True))
    for l, (colour, part) in numbered:
        changed = replace(colour, name=part, term=l, part=part)
        colours.append(changed)
    tableau = replace(sheet.tableau, colours=tuple(colours))
    return replace(sheet, tableau=tableau)


TARGET = Target("prk", "two colours as the parts q and p", as_prk)
