"""The same method with its stages in another order."""

from __future__ import annotations

from collections.abc import Sequence

from hypothesis import strategies as st

from garkcli.conversion.sheet import Place, Sheet, regrouped


def renumbered(sheet: Sheet, orders: Sequence[Sequence[int]]) -> Sheet:
    """The stages of each space in an order."""
    spaces: list[list[Place]] = []
    for k, order in enumerate(orders):
        spaces.append([(k, i) for i in order])
    homes = [colour.space for colour in sheet.tableau.colours]
    return regrouped(sheet, spaces, homes)


@st.composite
def orders_of(draw: st.DrawFn, sheet: Sheet) -> list[list[int]]:
    """An order of the stages of every space."""
    orders = []
    for space in sheet.tableau.spaces:
        stages = list(range(space.stages))
        orders.append(draw(st.permutations(stages)))
    return orders
