"""The one form of a method: reduced, spelled out, its stages sorted."""

from __future__ import annotations

from garkcli.conversion.sheet import Sheet, each_its_own, of_weights, sheet_of
from garkcli.conversion.stage_order import in_order
from garkcli.conversion.target import Target
from garkcli.conversion.targets.ark import shared
from garkcli.properties.reduction import reduced
from garkcli.tableau.garkmethod import GarkMethod


def as_canonical(method: GarkMethod) -> Sheet:
    """The smallest method that does the same, its stages in an order of their own.

    Methods that differ in the numbers of their stages, in stages without influence or in stages
    that stand there twice, or in whether colours share their stages, have the same canonical form.
    """
    sheet = sheet_of(method)
    if not sheet.tableau.is_partitioned:
        sheet = each_its_own(sheet)
    smaller = in_order(of_weights(sheet, reduced))
    if smaller.tableau.is_partitioned:
        return smaller
    return shared(smaller) or smaller


TARGET = Target("canonical", "reduced, spelled out, its stages sorted", as_canonical)
