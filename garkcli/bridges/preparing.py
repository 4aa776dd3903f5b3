"""Methods as input of writers: entries at points, zeros proved, orders decided."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence

from flint import arb, fmpq

from garkcli.bridges.cannot import CannotExport
from garkcli.bridges.orders import find_orders
from garkcli.bridges.own_arrays import own_arrays, own_kind
from garkcli.bridges.payload import Kind, Payload
from garkcli.constructions.rosenbrock import Rosenbrock, is_rosenbrock
from garkcli.doing import doing
from garkcli.errors import MethodError, printable
from garkcli.exact.display import to_float
from garkcli.exact.field import ZERO
from garkcli.frozen import replace
from garkcli.methodfile.build import MethodFile
from garkcli.methodfile.constructed.multirate import coupling_of
from garkcli.properties.family_entries import is_nonzero_at, nodes_of
from garkcli.tableau.embedded import DenseOutput
from garkcli.tableau.garkmethod import GarkMethod, derived_name
from garkcli.tableau.gauss_points import has_gauss_nodes
from garkcli.tableau.pointwise import Block, Cell, Entries, Row, entries, in_points
from garkcli.tableau.polynomial_space import PolynomialSpace
from garkcli.tableau.tableau import Tableau

EXTRA = 120
"""Digits of enclosures beyond the written ones: nines and zeros reveal rounding."""
USUAL = 40
"""More digits than any target writes by default."""


@doing("numbers and orders")
def prepared(method: GarkMethod, digits: int | None = None) -> Payload:
    """CannotExport if no target writes the method, MethodError if it was not read from a file."""
    file = method if method.base is None else method.base
    if not isinstance(file, MethodFile):
        message = f"{method!r} is no method file"
        raise MethodError(message, "give what load, loads or from_arrays return", code="other-file")
    if method.tableau.has_parameters:
        message = f"{method.name} has free parameters"
        raise CannotExport(message, "give each a value: --set NAME=VALUE", code="free-parameters")
    printed, method = method, _with_digits(method, file, digits)
    moved_within = None if method is printed else _tolerance(printed)
    tableau, row = method.tableau, None
    own = own_kind(tableau)
    orders = find_orders(tableau, method.embedded, method.tolerance)
    embedded, dense = method.embedded, method.dense
    if is_rosenbrock(tableau):
        row = Rosenbrock.of(tableau)
        N = len(row.b)
        embedded, dense = embedded and embedded[:N], dense and DenseOutput(dense.weights[:N])
        tableau = row.without_jacobian
    cells = _NO_ENTRIES if own else _entries(tableau, digits)
    kind: Kind = own or (kind_of(tableau) if row is None else "row")
    if own is None and tableau.exact_to is not None:
        kind = "mri"
    return Payload(
        name=printable(
            derived_name(method.derivation, _name(file)) if method.derivation else _name(file)
        ),
        kind=kind,
        tableau=tableau if own else in_points(tableau) or tableau,
        A=cells.A,
        b=cells.b,
        c=cells.c,
        is_exact=cells.is_exact,
        orders=orders,
        embedded=None if own else embedded,
        own=own_arrays(own, tableau, method.further) if own else None,
        dense=None if own or dense is None else dense.weights,
        predictor=method.predictor,
        tolerance=method.tolerance,
        embedded_tolerance=method.embedded_tolerance,
        dense_tolerance=method.dense_tolerance,
        structure=file.structure,
        reference=printable(str(file.reference)),
        digits=digits,
        moved_within=moved_within,
        rosenbrock=row,
        coupling=coupling_of(file) if not method.derivation else None,
        derivation=method.derivation,
    )


_NO_ENTRIES = Entries((), (), (), is_exact=True, digits=0, have_radicals=True)


def _tolerance(method: GarkMethod) -> fmpq | None:
    """The largest rounding of its numbers; None if all are exact."""
    tolerances = (method.tolerance, method.embedded_tolerance, method.dense_tolerance)
    return max((t for t in tolerances if t is not None), default=None)


def _with_digits(method: GarkMethod, file: MethodFile, digits: int | None) -> GarkMethod:
    """The method, or one with more digits that rounds to it if its file has too few."""
    tolerance = _tolerance(method)
    if tolerance is None or digits is None:
        return method
    sizes = [abs(to_float(x)) for row in method.tableau.rows for x in row if x]
    places = digits + max(0, -math.floor(math.log10(min(sizes, default=1.0))))
    if fmpq(10) ** -places >= tolerance:
        return method
    if not method.tableau.is_gark:
        message = (
            f"{method.name} is rounded to fewer digits, and of a method of its kind gark does not"
            " recover more"
        )
        raise CannotExport(message, "leave out --digits")
    # exact files have all digits
    from garkcli.api.methods import conjugate, pair
    from garkcli.conversion.convert import convert

    recovered: GarkMethod = convert(file, "recovered", digits=places).method
    derive = {"conjugate": conjugate, "pair": pair}.get(method.derivation)
    if derive is not None:
        recovered = derive(recovered)
    return recovered


def _name(method: MethodFile) -> str:
    if method.name != method.source:
        return method.name
    base = re.split(r"[\\/]", method.source)[-1]
    return re.sub(r"(\.gark)?\.ya?ml$", "", base)


def kind_of(tableau: Tableau) -> Kind:
    if [colour.part for colour in tableau.colours] == ["q", "p"]:
        return "prk"
    if tableau.size == 1 and not tableau.is_partitioned:
        return "rk"
    shares_stages = len(tableau.spaces) == 1 and len(tableau.blocks) == tableau.size
    return "ark" if shares_stages and not tableau.is_partitioned else "gark"


def _entries(tableau: Tableau, digits: int | None) -> Entries:
    """The entries, exact if possible; enclosures of zero and missing blocks become exact zeros."""
    cells = entries(tableau, max(digits or 0, USUAL) + EXTRA)
    if not cells.is_exact:
        A = [
            tuple(_block(tableau, l, m, block) for m, block in enumerate(blocks))
            for l, blocks in enumerate(cells.A)
        ]
        c = [_nodes(tableau, l, row) for l, row in enumerate(cells.c)]
        cells = replace(cells, c=tuple(c), A=tuple(A))
    if tableau.size == 1 and cells.A[0][0] is None:
        zeros = (ZERO,) * len(cells.b[0])
        return replace(cells, A=(((zeros,) * len(zeros),),))
    return cells


def _nodes(tableau: Tableau, l: int, row: Row) -> Row:
    colour = tableau.colours[l]
    space = tableau.spaces[colour.space]
    exact: Sequence[object] = colour.c
    if isinstance(space, PolynomialSpace):
        if colour.c != space.nodes:
            return row
        if has_gauss_nodes(space):
            # isolating the zeros of a Legendre polynomial takes long; the middle one is 1/2
            middle = space.stages // 2 if space.stages % 2 else None
            exact = [fmpq(1, 2) if i == middle else None for i in range(space.stages)]
        else:
            exact = [root.exact for root in nodes_of(space)]
    pairs = zip(exact, row, strict=True)
    return tuple(x if isinstance(x, fmpq) else cell for x, cell in pairs)


def _block(tableau: Tableau, l: int, m: int, block: Block) -> Block:
    """A block, with exact zeros for entries that are proved to vanish."""
    place = tableau.colours[l].space, m

    def cell(i: int, j: int, x: Cell) -> Cell:
        may_be_zero = isinstance(x, arb) and x.contains(0)
        return ZERO if may_be_zero and is_nonzero_at(tableau, place, i, j) is False else x

    if block is None:
        return None
    return tuple(tuple(cell(i, j, x) for j, x in enumerate(row)) for i, row in enumerate(block))
