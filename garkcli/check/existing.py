"""Proofs that a method within the rounding of a printed one has a certain order."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

from flint import ctx, fmpq

from garkcli.doing import doing
from garkcli.errors import MethodError
from garkcli.exact.traces import Told, Trace, Untold, told
from garkcli.frozen import Frozen
from garkcli.ntrees.tree import Tree
from garkcli.order.certificate import DEFAULT_LIMIT
from garkcli.order.existence import Existence, exclusion, prove_existence
from garkcli.order.meant import meant
from garkcli.order.recovering import Recovery
from garkcli.order.rounded import RoundedOrder, RoundedTableau, find_order_within
from garkcli.tableau.garkmethod import GarkMethod
from garkcli.tableau.tableau import Tableau
from garkcli.upward import Shown

MOST_PARTS = 100_000
"""Most operations in the entries that are made of printed numbers."""


class PrintedNumber(Frozen):
    """A number of a rounded method; an exact one is within ``width`` of its ``centre``."""

    printed: fmpq
    radius: fmpq
    centre: fmpq
    width: fmpq


class ExistenceProof(Shown, Frozen):
    """A proof that a method whose numbers are within their radii has an order.

    Attributes:
        tableau: its entries say how: traces and exact numbers.
        conditions: all trees up to the order, each with its column of W (``order.existence``).
        witness: trees with factors whose sum of conditions vanishes for no method within the radii;
            None if unknown.
    """

    name: str
    order: RoundedOrder
    numbers: tuple[PrintedNumber, ...]
    tableau: Tableau
    conditions: tuple[tuple[Tree, tuple[fmpq, ...]], ...]
    witness: tuple[tuple[Tree, fmpq], ...] | None

    def __repr__(self) -> str:
        return f"<ExistenceProof of order {self.order.order}>"


@doing("proof")
def prove_method_exists(method: GarkMethod, limit: int = DEFAULT_LIMIT) -> ExistenceProof:
    """Proves the order of a method within the rounding, and none higher; raises MethodError."""
    rounded = meant(method.tableau, method.tolerance, method.further)
    if isinstance(rounded, Tableau):
        message = (
            "the coefficients are exact, so there is no rounding within which to prove anything"
        )
        raise MethodError(message, "prove_method proves their orders", code="not-rounded")
    order, search = find_order_within(rounded, limit), rounded.search
    existence = prove_existence(search, order.order) if order.order else None
    if existence is None:
        raise _not_proved(order, _why_not(search, order.order))
    try:
        tableau, used = _traced(search)
        numbers = _numbers(search, existence)
    except Untold as error:
        raise _not_proved(order, str(error)) from None
    W = [existence.W[k] for k in used]
    return ExistenceProof(
        name=method.name,
        order=order,
        numbers=tuple(numbers[k] for k in used),
        tableau=tableau,
        conditions=tuple(zip(existence.trees, zip(*W, strict=True), strict=True)),
        witness=_witness(rounded, order),
    )


def _not_proved(order: RoundedOrder, why: str) -> MethodError:
    message = f"order {order.order} within the tolerance has no proof that others can check: {why}"
    cure = "give the coefficients exactly, without a tolerance; gark convert --to recovered"
    return MethodError(message, f"{cure} --recognise finds them for many methods", code="rounded")


def _why_not(search: Recovery, order: int) -> str:
    if not order:
        return "there is no order to prove"
    if search.settled.slack:
        return "its conditions are met to second order only"
    return "its conditions depend on each other, or are more than its rounded numbers"


def _traced(search: Recovery) -> tuple[Tableau, list[int]]:
    count = len(search.box.numbers)
    everything = _made(search, [Trace(k) for k in range(count)])
    used = sorted({k for x in _entries(everything) for k in _numbers_in(told(x))})
    place = {k: Trace(i) for i, k in enumerate(used, start=1)}
    return _made(search, [place.get(k, fmpq(0)) for k in range(count)]), used


def _made(search: Recovery, numbers: Sequence[Any]) -> Tableau:
    with ctx.workprec(search.bits):
        made = search.targets["method"](search.box.make(numbers))
    if sum(x.length for x in _entries(made) if isinstance(x, Trace)) > MOST_PARTS:
        raise Untold("its entries are made of its numbers in too many steps")
    return made


def _entries(tableau: Tableau) -> Iterator[Any]:
    for colour in tableau.colours:
        yield from colour.b
    for block in tableau.blocks.values():
        for row in block:
            yield from row


def _numbers_in(told: Told) -> Iterator[int]:
    if isinstance(told, int):
        yield told
    elif isinstance(told, list):
        for x in told[1:]:
            yield from _numbers_in(x)


def _numbers(search: Recovery, existence: Existence) -> list[PrintedNumber]:
    numbers = []
    given = zip(search.box.numbers, search.box.radii, strict=True)
    moved = zip(existence.shifts, existence.widths, strict=True)
    for (x, t), (shift, width) in zip(given, moved, strict=True):
        if not isinstance(x, fmpq):
            raise Untold("a rounded number is printed as an irrational one")
        numbers.append(PrintedNumber(x, t, x + t * shift, t * width))
    return numbers


def _witness(rounded: RoundedTableau, order: RoundedOrder) -> Any:
    if order.witness is None:
        return None
    if not rounded.explains(order.witness.tree):
        return ((order.witness.tree, fmpq(1)),)
    return exclusion(rounded.search, order.order + 1)
