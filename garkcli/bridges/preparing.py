"""From a method to what writers get: entries at points, zeros proved, orders decided."""

from __future__ import annotations

import re

from flint import arb, fmpq

from garkcli.bridges.cannot import CannotExport
from garkcli.bridges.orders import find_orders
from garkcli.bridges.payload import Kind, Payload
from garkcli.doing import doing
from garkcli.errors import MethodError, printable
from garkcli.exact.field import ZERO
from garkcli.frozen import replace
from garkcli.methodfile.build import MethodFile
from garkcli.methodfile.constructed.multirate import coupling_of
from garkcli.properties.family_entries import is_nonzero_at, nodes_of
from garkcli.tableau.embedded import with_weights
from garkcli.tableau.garkmethod import GarkMethod, derived_name
from garkcli.tableau.pointwise import Block, Cell, Entries, entries, in_points, numeric_entries
from garkcli.tableau.polynomial_space import PolynomialSpace
from garkcli.tableau.tableau import Tableau

EXTRA = 120
"""Digits of enclosures beyond those that are written: nines and zeros show rounding."""
USUAL = 40
"""More digits than any target writes where none are requested."""


@doing("numbers and orders")
def prepared(method: GarkMethod, digits: int | None = None) -> Payload:
    """What writers get of a method.

    Args:
        method: as it was read from a file, or the conjugate or the pair of such a method.
        digits: of every number, where they are requested.

    Raises:
        CannotExport: no target writes a method like this.
        MethodError: it was not read from a file.
    """
    file = method if method.base is None else method.base
    if not isinstance(file, MethodFile):
        message = f"{method!r} is no method file"
        raise MethodError(message, "give what load, loads or from_arrays return", code="other-file")
    tableau = method.tableau
    if tableau.has_parameters:
        message = f"{method.name} has free parameters"
        raise CannotExport(message, "give each a value: --set NAME=VALUE", code="free-parameters")
    found = _seen(_entries(tableau, digits))
    embedded, dense = method.embedded, method.dense
    other = None if embedded is None else with_weights(tableau, embedded)
    return Payload(
        name=printable(
            _name(file) if method is file else derived_name(method.derivation, _name(file))
        ),
        kind=kind_of(tableau),
        tableau=in_points(tableau) or tableau,
        A=found.A,
        b=found.b,
        c=found.c,
        is_exact=found.is_exact,
        orders=find_orders(tableau, other, method.tolerance),
        embedded=embedded,
        dense=None if dense is None else dense.weights,
        tolerance=method.tolerance,
        structure=file.structure,
        reference=printable(str(file.reference)),
        digits=digits,
        coupling=coupling_of(file) if method is file else None,
        derivation=method.derivation,
    )


def _name(method: MethodFile) -> str:
    """Its name; without one that of its file, whatever folder it is in."""
    if method.name != method.source:
        return method.name
    base = re.split(r"[\\/]", method.source)[-1]
    return re.sub(r"(\.gark)?\.ya?ml$", "", base)


def kind_of(tableau: Tableau) -> Kind:
    """Which form a tableau has."""
    parts = [colour.part for colour in tableau.colours]
    if parts == ["q", "p"]:
        return "prk"
    if tableau.is_partitioned:
        return "gark"
    if tableau.size == 1:
        return "rk"
    shares_stages = len(tableau.spaces) == 1
    is_complete = len(tableau.blocks) == tableau.size
    return "ark" if shares_stages and is_complete else "gark"


def _entries(tableau: Tableau, digits: int | None) -> Entries:
    """The entries, exact where that is possible; enclosures of zero are exact zeros."""
    exact = entries(tableau)
    if exact.is_exact:
        return exact
    wanted = max(digits or 0, USUAL) + EXTRA
    fine = numeric_entries(tableau, wanted)
    colours = range(tableau.size)
    c = tuple(_nodes(tableau, l, fine.c[l]) for l in colours)

    def blocks(l: int) -> tuple[Block, ...]:
        return tuple(_block(tableau, fine, l, m) for m in colours)

    return replace(fine, c=c, A=tuple(map(blocks, colours)))


def _seen(found: Entries) -> Entries:
    """The entries, with zeros for the block that a method for one vector field lacks."""
    (first, *further), *_ = found.A
    if further or first is not None:
        return found
    zeros = (ZERO,) * len(found.b[0])
    return replace(found, A=(((zeros,) * len(zeros),),))


def _nodes(tableau: Tableau, l: int, row: tuple[Cell, ...]) -> tuple[Cell, ...]:
    """The nodes of a colour, rational ones exact."""
    colour = tableau.colours[l]
    space = tableau.spaces[colour.space]
    is_own = isinstance(space, PolynomialSpace) and colour.c == space.nodes
    if not isinstance(space, PolynomialSpace) or not is_own:
        return tuple(map(_exact_where_known, colour.c, row))
    found = []
    for root, cell in zip(nodes_of(space), row, strict=True):
        found.append(cell if root.exact is None else root.exact)
    return tuple(found)


def _exact_where_known(exact: object, cell: Cell) -> Cell:
    return exact if isinstance(exact, fmpq) else cell


def _block(tableau: Tableau, fine: Entries, l: int, m: int) -> Block:
    """A block, with zeros that are proved to be zero."""
    block = fine.A[l][m]
    if block is None:
        return None
    place = tableau.colours[l].space, m
    rows = []
    for i, row in enumerate(block):
        cells = list(row)
        for j, cell in enumerate(row):
            may_be_zero = isinstance(cell, arb) and cell.contains(0)
            if may_be_zero and is_nonzero_at(tableau, place, i, j) is False:
                cells[j] = fmpq(0)
        rows.append(tuple(cells))
    return tuple(rows)
