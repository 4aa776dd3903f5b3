"""Tables made ready for targets: named arrays, rows below the diagonal, a stage more; refusals."""

from __future__ import annotations

from collections.abc import Callable

from flint import arb, ctx, fmpq

from garkcli.bridges.cannot import CannotExport
from garkcli.bridges.payload import Payload
from garkcli.bridges.rounding import Cell
from garkcli.bridges.structure import Rows, Table, shared, table, vanishes
from garkcli.exact.display import to_ball
from garkcli.exact.field import ONE, ZERO
from garkcli.frozen import replace
from garkcli.tableau.pointwise import Row

_BITS = 1000
"""Of arithmetic with enclosures, far beyond what is written of them."""
_DIGITS = 300


def named_arrays(payload: Payload, before: str = "") -> list[tuple[str, Rows]]:
    """The arrays of a method, each with a name for programs: ``A``, ``b``; ``A1_2``, ``b2`` of
    several vector fields.

    Args:
        payload: the method.
        before: what is between the letter and its numbers.
    """
    found: list[tuple[str, Rows]] = []
    is_one = payload.size == 1
    for l, blocks in enumerate(payload.A, start=1):
        for m, block in enumerate(blocks, start=1):
            number = "" if is_one else f"{before}{l}_{m}"
            if block is not None:
                found.append((f"A{number}", block))
    for l in range(payload.size):
        number = "" if is_one else f"{before}{l + 1}"
        found.append((f"b{number}", (payload.b[l],)))
        found.append((f"c{number}", (payload.c[l],)))
        if payload.embedded is not None:
            found.append((f"embedded{number}", (payload.embedded[l],)))
        if payload.dense is not None:
            found.append((f"dense{number}", payload.dense[l]))
    return found


def below_diagonal(found: Table) -> Rows:
    """The rows of A below the diagonal, from the second on: one entry, two, …"""
    return tuple(row[:i] for i, row in enumerate(found.A) if i)


def diagonal(found: Table) -> Row:
    """The diagonal of A."""
    return tuple(row[i] for i, row in enumerate(found.A))


def error_weights(found: Table) -> Row | None:
    """The weights b − b̂ of the error estimate."""
    if found.embedded is None:
        return None
    return tuple(difference(x, y) for x, y in zip(found.b, found.embedded, strict=True))


def error_or_zero(found: Table) -> Row:
    """The same; zeros where there are no embedded weights."""
    return error_weights(found) or (ZERO,) * found.stages


def begins_at_start(found: Table) -> bool:
    """Whether the first stage is f(t, y) at the beginning of the step."""
    return all(map(vanishes, (*found.A[0], found.c[0])))


def is_first_same_as_last(found: Table) -> bool:
    """Whether the last stage of a step is the first of the next."""
    return begins_at_start(found) and found.is_fsal


def with_last_stage(found: Table) -> Table:
    """The same method with f(t + h, y at the end) as one more stage, whose weight is 0."""
    rows = [(*row, ZERO) for row in found.A]
    rows.append((*found.b, ZERO))
    embedded = found.embedded
    return replace(
        found,
        A=tuple(rows),
        b=(*found.b, ZERO),
        c=(*found.c, ONE),
        embedded=None if embedded is None else (*embedded, ZERO),
    )


def with_first_stage(found: Table) -> Table:
    """The same method with f(t, y) as one more stage before all, whose weight is 0."""
    zeros = (ZERO,) * (found.stages + 1)
    rows = [(ZERO, *row) for row in found.A]
    embedded = found.embedded
    return replace(
        found,
        A=(zeros, *rows),
        b=(ZERO, *found.b),
        c=(ZERO, *found.c),
        embedded=None if embedded is None else (ZERO, *embedded),
    )


def difference(x: Cell, y: Cell) -> Cell:
    """X − y: exact where both are of one field, else an enclosure."""
    if not isinstance(x, arb) and not isinstance(y, arb):
        try:
            return x - y
        except TypeError:
            pass  # of two number fields
    return _in_balls(lambda: ball(x) - ball(y))


def scaled(x: Cell, factor: fmpq) -> Cell:
    """A rational multiple of an entry."""
    if isinstance(x, arb):
        return _in_balls(lambda: ball(x) * arb(factor))
    return x * factor


def ball(x: Cell) -> arb:
    """An enclosure, far finer than what is written."""
    return x if isinstance(x, arb) else to_ball(x, _DIGITS)


def _in_balls(compute: Callable[[], arb]) -> arb:
    precision = ctx.prec
    try:
        ctx.prec = _BITS
        return compute()
    finally:
        ctx.prec = precision


def explicit_table(payload: Payload, target: str) -> Table:
    """The table of an explicit method for one vector field.

    Raises:
        CannotExport: it is implicit.
    """
    found = table(payload)
    if not found.is_explicit:
        raise CannotExport(
            f"{target} has explicit methods only; a stage of {payload.name} sees itself or a later"
            " one",
            "sundials, petsc, diffrax and matlab have implicit methods",
        )
    return found


def ends_with_value(payload: Payload, target: str) -> Table:
    """The table with a last stage at the end of the step.

    Raises:
        CannotExport: the method is implicit, or begins elsewhere than at the beginning.
    """
    found = explicit_table(payload, target)
    if not begins_at_start(found):
        raise CannotExport(
            f"the first stage of {target} is at the beginning of a step; that of {payload.name}"
            " has another node",
            "boost, desolve and numpy have such methods",
        )
    return found if found.is_fsal else with_last_stage(found)


def lower_table(payload: Payload, target: str) -> Table:
    """The table of an explicit or diagonally implicit method for one vector field.

    Raises:
        CannotExport: a stage sees a later one.
    """
    found = table(payload)
    if not found.is_diagonally_implicit:
        raise _sees_later(payload, target)
    return found


def imex_tables(payload: Payload, target: str) -> tuple[Table, Table]:
    """The explicit and the diagonally implicit table of a method for two vector fields.

    Raises:
        CannotExport: there are not two, or none of them is explicit.
    """
    if payload.size != 2:
        message = f"{target} has two vector fields; {payload.name} is for {payload.size}"
        raise CannotExport(message, "json, numpy, matlab and rootedtrees have any number")
    first, second = shared(payload)
    for found in (first, second):
        if not found.is_diagonally_implicit:
            raise _sees_later(payload, target)
    if first.is_explicit:
        return first, second
    if second.is_explicit:
        return second, first
    message = f"{target} has an explicit and an implicit table; both of {payload.name} are implicit"
    raise CannotExport(message, "json, numpy, matlab and rootedtrees have pairs like this")


def _sees_later(payload: Payload, target: str) -> CannotExport:
    return CannotExport(
        f"{target} solves one stage after the other; a stage of {payload.name} sees a later one",
        "json, numpy, matlab and rootedtrees have fully implicit methods",
    )
