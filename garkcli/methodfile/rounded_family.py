"""Files with unknowns and rounded numbers: filled with values, and with other numbers."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from flint import ctx, fmpq

from garkcli.errors import MethodError
from garkcli.exact.affine import constant
from garkcli.exact.enclosing import midpoint
from garkcli.exact.nodes import Expression, Literal, parts
from garkcli.exact.rounding import in_decimals
from garkcli.frozen import Frozen
from garkcli.methodfile.build import Builder, part_of
from garkcli.methodfile.family import FamilyFile, loads_family
from garkcli.methodfile.load import described
from garkcli.methodfile.number_tolerances import NumberTolerances
from garkcli.methodfile.rounding import Rounded
from garkcli.methodfile.values import Values
from garkcli.order.rounded import RoundedTableau
from garkcli.tableau.box import Box


class Filled(Frozen, eq=False):
    """``given`` says which rounded numbers are values of unknowns."""

    rounded: RoundedTableau
    given: tuple[bool, ...]

    def shifts(self) -> tuple[fmpq, ...]:
        """The distances of the numbers in the file from the exact ones, in radii."""
        off = zip(self.rounded.search.place.shifts, self.given, strict=True)
        return tuple(x for x, is_given in off if not is_given)


class RoundedFamily(Frozen, eq=False):
    family: FamilyFile

    @property
    def tolerance(self) -> fmpq:
        assert self.family.tolerance is not None
        return self.family.tolerance

    def at(self, shifts: Sequence[fmpq], bits: int) -> FamilyFile:
        return family_at(self.family, shifts, bits)

    def generic(self) -> FamilyFile:
        family = self.family
        return loads_family(
            family.text,
            family.source,
            family.settings,
            is_design=False,
            numbers=Rounded.indeterminates,
        )

    def filled(self, values: Mapping[str, fmpq], digits: int, width: fmpq) -> Filled:
        return filled(self.family, values, digits, width)


def filled(family: FamilyFile, values: Mapping[str, fmpq], digits: int, width: fmpq) -> Filled:
    """Nonzero values may be wrong by ``width``. MethodFileError if they make no method, MethodError
    if stages are joined that would differ with other last digits.
    """
    texts = {name: in_decimals(x, digits) for name, x in values.items()}
    reader, description = described(family.text, family.source, {**family.settings, **texts})
    text = part_of(reader.source, reader.numbers, description)
    known = Values(reader.numbers)
    reader.source.close()
    made = Builder(text, known)
    given = {id(x) for name in texts for x in _literals(reader.numbers.parameters[name].expression)}
    assert family.tolerance is not None
    assert description.tolerance is not None
    entries = reader.numbers.entries
    tolerances = NumberTolerances(description.tolerance, description.content, entries)
    rounded = Rounded(entries, known, tolerances, given)
    pairs = zip(rounded.radii, rounded.is_given, strict=True)
    radii = tuple(width if is_given else radius for radius, is_given in pairs)
    box = Box(rounded.numbers, radii, rounded.maker(text))
    tableau = RoundedTableau.of(made.tableau, family.tolerance, box, made.further)
    if tableau.search.box is not box:
        message = "stages are joined that would differ with other last digits"
        raise MethodError(message, "write the method out", code="rounded")
    return Filled(tableau, rounded.is_given)


def family_at(family: FamilyFile, shifts: Sequence[fmpq], bits: int) -> FamilyFile:
    def moved(rounded: Rounded) -> Mapping[int, Expression]:
        printed, radii = rounded.numbers, rounded.radii
        offs = shifts or (fmpq(0),) * len(printed)
        centres = [x if isinstance(x, fmpq) else midpoint(constant(x)) for x in printed]
        return rounded.literals(
            [x + t * off for x, t, off in zip(centres, radii, offs, strict=True)]
        )

    with ctx.workprec(bits):
        return loads_family(family.text, family.source, family.settings, numbers=moved)


def _literals(expression: Expression) -> list[Expression]:
    if isinstance(expression, Literal):
        return [expression]
    return [y for x in parts(expression) for y in _literals(x)]
