"""Positions and velocities in steps: ``x + h*v + h**2/2*k``, ``v + h*k``."""

from __future__ import annotations

from collections.abc import Mapping

from garkcli.frozen import Frozen
from garkcli.sources.values import ZERO, Terms, Value, computed, is_zero, near

CLOSE = 1e-9
"""Coefficients that differ by less are equal."""
Row = Mapping[str, Value]


class Position(Frozen):
    """A position, a velocity with its multiple of h, multiples of slopes with h²."""

    base: str
    velocity: str
    node: Value
    row: Row


def position_of(form: Terms | None, h: str) -> Position | None:
    """A polynomial as a position; None for others."""
    base = velocity = ""
    node: Value = ZERO
    row: dict[str, Value] = {}
    for at, x in (form or {}).items():
        others = [name for name in at if name != h]
        powers = len(at) - len(others)
        if is_zero(x):
            continue
        if len(others) != 1 or powers > 2:
            return None
        (name,) = others
        if powers == 2:
            row[name] = x
        elif powers and not velocity:
            velocity, node = name, x
        elif powers or base or abs(near(x) - 1) > CLOSE:
            return None
        else:
            base = name
    return Position(base, velocity, node, row) if base and velocity else None


def velocity_of(form: Terms | None, h: str) -> tuple[str, Row] | None:
    """A polynomial as a base with multiples of slopes; None for others."""
    base = ""
    row: dict[str, Value] = {}
    for at, x in (form or {}).items():
        others = [name for name in at if name != h]
        if is_zero(x):
            continue
        if len(others) != 1 or len(at) > 2:
            return None
        if len(at) == 2:
            row[others[0]] = x
        elif base or abs(near(x) - 1) > CLOSE:
            return None
        else:
            base = others[0]
    return (base, row) if base else None


def is_of_velocities(
    form: Terms | None, h: str, rows: Mapping[str, Mapping[str, Row]], row: Row
) -> bool:
    """Whether a position fits the velocities of stages with slopes in ``row``.

    Args:
        form: a value or an argument.
        h: the step.
        rows: of each velocity, the multiples of slopes at the stages of its slopes.
        row: the multiples of the velocities of the stages, by their slopes.
    """
    x = position_of(form, h)
    if x is None or x.velocity not in rows:
        return True
    of = rows[x.velocity]
    if not row.keys() <= of.keys():
        return True
    return abs(near(x.node) - near(*row.values())) < CLOSE and is_product(x.row, row, of)


def is_product(made: Row, row: Row, of: Mapping[str, Row]) -> bool:
    """Whether a row is the product of another one with a matrix."""
    product: dict[str, Value] = {}
    for name, x in row.items():
        for other, y in of[name].items():
            term = computed("*", x, y, 0)
            product[other] = computed("+", product.get(other, ZERO), term, 0)
    names = {*product, *made}
    return all(
        abs(near(product.get(name, ZERO)) - near(made.get(name, ZERO))) < CLOSE for name in names
    )
