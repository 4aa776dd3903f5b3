"""The forms that methods can be converted to, by name."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from garkcli.conversion import sheet as sheets
from garkcli.conversion.printed import InForm, in_2n, in_registers, in_shu_osher
from garkcli.conversion.rosenbrock import PRINTED, TRANSFORMED
from garkcli.conversion.stages import in_order, in_solving_order
from garkcli.errors import counted
from garkcli.frozen import Frozen, field, replace
from garkcli.properties.reduction import merged, reduced
from garkcli.tableau.forms import pair
from garkcli.tableau.garkmethod import GarkMethod
from garkcli.tableau.tableau import Part


class Target(Frozen):
    """A form that ``--to`` names.

    Attributes:
        convert: makes the entries in this form, or raises ``CannotConvert``.
        claims: the new keys of claims; without it each claim that holds for the result stays.
        makes_another: whether the result is another method.
        printed: makes the coefficients of a low-storage form; None for a tableau.
    """

    name: str
    summary: str
    convert: Callable[[GarkMethod], sheets.Sheet]
    claims: Mapping[str, str] = field(default_factory=dict)
    makes_another: bool = False
    printed: InForm | None = None


def as_gark(method: GarkMethod) -> sheets.Sheet:
    """The parts q and p become colours whose vector fields are zero in the other part."""
    return without_parts(sheets.each_its_own(sheets.sheet_of(method)))


def without_parts(sheet: sheets.Sheet) -> sheets.Sheet:
    colours = []
    for l, colour in enumerate(sheet.tableau.colours):
        colours.append(replace(colour, name=str(l + 1), term=l, part="y"))
    return replace(sheet, tableau=replace(sheet.tableau, colours=tuple(colours)))


def as_ark(method: GarkMethod) -> sheets.Sheet:
    """The method as an additive one; CannotConvert if a colour is linear, or some stages do not see
    every colour.

    If the colours have the same stages, they share them. Otherwise the stages of all colours follow
    each other, each with zeros in the columns of the others, and equal ones are merged.
    """
    sheet = without_parts(sheets.sheet_of(method))
    linear = [x.name for x in sheet.tableau.colours if x.is_linear]
    if linear:
        message = f"colour {linear[0]} is linear, which an additive method cannot express"
        raise sheets.CannotConvert(message, "--to gark keeps it")
    together = shared(sheet)
    if together is None:
        places: list[sheets.Place] = []
        for k, space in enumerate(sheet.tableau.spaces):
            places += [(k, i) for i in range(space.stages)]
        in_one_space = sheets.regrouped(sheet, [places], [0] * sheet.tableau.size)
        together = in_solving_order(sheets.of_weights(in_one_space, merged))
    tableau = together.tableau
    nodes = tableau.colours[0].c
    for colour in tableau.colours:
        if colour.c != nodes:
            raise sheets.CannotConvert(
                f"colour {colour.name} has nodes of its own; an additive"
                " method has one row of them",
                "--to gark keeps them",
            )
    return together


def shared(sheet: sheets.Sheet) -> sheets.Sheet | None:
    """Returns the method with one stage space, if stage i of all colours is the same; or None."""
    tableau = sheet.tableau
    first, *others = range(len(tableau.spaces))
    colours = range(tableau.size)
    for k in others:
        if tableau.spaces[k].nodes != tableau.spaces[first].nodes:
            return None
        if any(tableau.blocks.get((k, m)) != tableau.blocks.get((first, m)) for m in colours):
            return None
    places: list[sheets.Place] = [(first, i) for i in range(tableau.spaces[first].stages)]
    # the weights stay as they are: every space is the first one
    seen = tuple(replace(x, space=first) for x in tableau.colours)
    blocks = {key: x for key, x in tableau.blocks.items() if key[0] == first}
    alone = replace(sheet, tableau=replace(tableau, colours=seen, blocks=blocks))
    return sheets.regrouped(alone, [places], [0] * tableau.size)


def as_prk(method: GarkMethod) -> sheets.Sheet:
    """Colour 1 drives q, colour 2 p; CannotConvert if stages are neither shared nor unseen."""
    sheet = sheets.sheet_of(method)
    tableau = sheet.tableau
    if tableau.size != 2:
        raise sheets.CannotConvert(
            f"a partitioned method has two parts, this one has {counted(tableau.size, 'colour')}",
            "--to gark has every number of colours",
        )
    if not (len(tableau.spaces) == 2 and set(tableau.edges()) == {(0, 1), (1, 0)}):
        together = shared(sheet)
        if together is None:
            message = "the colours neither have the same stages nor leave themselves unseen (null)"
            raise sheets.CannotConvert(message, "--to ark puts all stages together first")
        sheet = together
    elif tableau.colours[1].is_linear:
        message = "the file of a partitioned method says that q is linear, not p"
        raise sheets.CannotConvert(message, "exchange the colours")
    parts: tuple[Part, ...] = ("q", "p")
    colours = []
    for l, (colour, part) in enumerate(zip(sheet.tableau.colours, parts, strict=True)):
        colours.append(replace(colour, name=part, term=l, part=part))
    return replace(sheet, tableau=replace(sheet.tableau, colours=tuple(colours)))


def as_pair(method: GarkMethod) -> sheets.Sheet:
    """The pair (Q, P) of a method and its conjugate, as a GARK method: colours V¹…Vᴺ, then F¹…Fᴺ.

    Further weights are not those of the pair, and left out. ZeroWeight if a conjugate would divide
    by zero.
    """
    both = GarkMethod(tableau=pair(method.tableau))
    return without_parts(sheets.each_its_own(sheets.sheet_of(both)))


def as_canonical(method: GarkMethod) -> sheets.Sheet:
    """The smallest method with the same step, with its stages in canonical order.

    Methods that differ in numbering, in unused or repeated stages, or in whether colours share
    stages, have the same canonical form.
    """
    sheet = sheets.sheet_of(method)
    if not sheet.tableau.is_partitioned:
        sheet = sheets.each_its_own(sheet)
    smaller = in_order(sheets.of_weights(sheet, reduced))
    if smaller.tableau.is_partitioned:
        return smaller
    return shared(smaller) or smaller


def as_rosenbrock(_: GarkMethod) -> sheets.Sheet:
    """Always raises ``CannotConvert``: no GARK method has the forms of Rosenbrock methods."""
    raise sheets.CannotConvert(
        "this form is for Rosenbrock methods", "--to spelled-out has all numbers"
    )


RECOVERED = "recovered"
"""The form with other numbers than the file has."""
TARGETS: Mapping[str, Target] = {
    target.name: target
    for target in (
        Target("spelled-out", "the form that it has, every entry a number", sheets.sheet_of),
        Target("gark", "every colour with stages of its own, block by block", as_gark),
        Target("ark", "all colours on the same stages", as_ark),
        Target("prk", "two colours as the parts q and p", as_prk),
        Target(
            "pair",
            "the symplectic pair as one method of 2N colours",
            as_pair,
            {"pair-order": "order", "pair-bound": "bound", "pair-sharp-bound": "sharp-bound"},
            makes_another=True,
        ),
        Target("2N", "low storage: two registers of Williamson", sheets.sheet_of, printed=in_2n),
        *(
            Target(
                f"{n}R",
                f"low storage: {n} registers of van der Houwen",
                sheets.sheet_of,
                printed=in_registers(n),
            )
            for n in range(2, 6)
        ),
        Target(
            "shu-osher",
            "the form of Shu and Osher with the SSP coefficient, without negative numbers",
            sheets.sheet_of,
            printed=in_shu_osher,
        ),
        Target("canonical", "reduced, spelled out, its stages sorted", as_canonical),
        Target(RECOVERED, "of a rounded method the one that its digits mean", sheets.sheet_of),
        Target(PRINTED, "of a Rosenbrock method alpha, gamma and b", as_rosenbrock),
        Target(TRANSFORMED, "of a Rosenbrock method A, C and m of programs", as_rosenbrock),
    )
}
