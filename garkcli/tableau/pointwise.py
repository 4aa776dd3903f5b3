"""A tableau entry by entry, as printed: in radicals if nodes have simple ones, else in decimals.

A block of a polynomial space has the entries A_{ij} = (A L_j)(c_i), L_j the Lagrange polynomials of
the nodes; with the Vandermonde matrices V of the nodes that is V_l A V_m⁻¹.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any, TypeAlias

from flint import arb, arb_mat, ctx

from garkcli.doing import doing
from garkcli.errors import LimitExceeded
from garkcli.exact.display import BITS_OF_A_DIGIT, to_ball
from garkcli.exact.domain import Domain
from garkcli.exact.field import Number, with_radicals
from garkcli.exact.matrix import Matrix, Vector, apply, apply_left, identity, multiply
from garkcli.exact.nodes import Expression
from garkcli.frozen import Frozen, replace
from garkcli.tableau import polynomial_space
from garkcli.tableau.embedded import Further
from garkcli.tableau.gauss_points import gauss_rows, is_gauss
from garkcli.tableau.stages import PointSpace, StageSpace
from garkcli.tableau.tableau import Edge, Method, Tableau

Cell: TypeAlias = Number | arb
Row: TypeAlias = tuple[Cell, ...]
Block: TypeAlias = tuple[Row, ...] | None


class Entries(Frozen):
    """The entries of a tableau: one row of nodes and weights per colour.

    Attributes:
        A: ``A[l][m]`` is a matrix, or None if the block does not exist.
        is_exact: whether the entries are exact numbers, not enclosures.
        digits: the correct decimal digits of enclosures.
        have_radicals: whether the nodes have simple radicals, so that exact entries exist.
        dense: the coefficients of dense output, for each colour a row per stage; or None.
        predictor: the matrices of 1, r, r², … for old and for new slopes; or empty.
    """

    c: tuple[Row, ...]
    A: tuple[tuple[Block, ...], ...]
    b: tuple[Row, ...]
    is_exact: bool
    digits: int
    have_radicals: bool = True
    embedded: tuple[Row, ...] | None = None
    dense: tuple[tuple[Row, ...], ...] | None = None
    predictor: tuple[tuple[str, tuple[tuple[Row, ...], ...]], ...] = ()

    def changed(self, change: Callable[[Cell], Cell]) -> Entries:
        def row(cells: Row) -> Row:
            return tuple(map(change, cells))

        def block(rows: Block) -> Block:
            if rows is None:
                return None
            return tuple(map(row, rows))

        c = tuple(map(row, self.c))
        A = [tuple(map(block, blocks)) for blocks in self.A]
        b = tuple(map(row, self.b))
        embedded = block(self.embedded)
        dense = self.dense
        if dense is not None:
            dense = tuple(tuple(map(row, rows)) for rows in dense)
        predictor = tuple(
            (name, tuple(tuple(map(row, matrix)) for matrix in matrices))
            for name, matrices in self.predictor
        )
        return replace(
            self, c=c, A=tuple(A), b=b, embedded=embedded, dense=dense, predictor=predictor
        )

    def beside(self, further: Further) -> Entries:
        dense = None if further.dense is None else further.dense.weights
        predictor = () if further.predictor is None else tuple(further.predictor.parts)
        return replace(self, embedded=further.embedded, dense=dense, predictor=predictor)

    def in_decimals(self, digits: int) -> Entries:
        def enclosed(cell: Cell) -> Cell:
            if isinstance(cell, arb):
                return cell
            return to_ball(cell, digits)

        return replace(self.changed(enclosed), is_exact=False, digits=digits)


@doing("entries")
def entries(tableau: Tableau, digits: int = 17) -> Entries:
    """Returns exact entries if all nodes are rational or quadratic, else enclosures."""
    exact = in_points(tableau)
    if exact is None:
        return numeric_entries(tableau, digits)
    colours = range(exact.size)
    return Entries(
        c=tuple(colour.c for colour in exact.colours),
        A=tuple(tuple(exact.block(l, m) for m in colours) for l in colours),
        b=tuple(colour.b for colour in exact.colours),
        is_exact=True,
        digits=digits,
    )


def method_in_points(method: Method, nodes: Vector) -> Method:
    """A family's method on point stages, with its nodes as exact numbers in ascending order."""
    space = PointSpace(nodes)
    V = space.reductions(space.stages)
    inverse = space.lifts()
    A = multiply(V, multiply(method.A, inverse))
    return replace(method, space=space, A=A, b=apply_left(method.b, inverse))


def in_points(tableau: Tableau) -> Tableau | None:
    """Returns the tableau on point stages; None if the nodes have no simple radicals, or generate
    too large a field with the coefficients.
    """
    radical_nodes = nodes_in_radicals(tableau)
    if not radical_nodes:
        return None if radical_nodes is None else tableau
    domain = _domain_with(tableau, radical_nodes)
    if domain is None:
        return None
    own = tableau.field.radicals if tableau.field else ()
    radicals = [domain.evaluate(radical) for radical, _ in own]
    return at_points(
        tableau, radical_nodes, domain, lambda x: with_radicals(x, radicals), lambda x: x
    )


def nodes_in_radicals(tableau: Tableau) -> dict[int, tuple[Expression, ...]] | None:
    """The nodes of the polynomial stage spaces; None if they have no simple radicals."""
    nodes: dict[int, tuple[Expression, ...]] = {}
    for k, space in enumerate(tableau.spaces):
        if isinstance(space, polynomial_space.PolynomialSpace):
            simple = polynomial_space.simple_nodes(space)
            if simple is None:
                return None
            nodes[k] = simple
    return nodes


def _domain_with(
    tableau: Tableau, radical_nodes: Mapping[int, Sequence[Expression]]
) -> Domain | None:
    """The domain of the coefficients and of these nodes; None if it is too large."""
    radicals: list[Expression] = []
    if tableau.field:
        radicals += [radical for radical, _ in tableau.field.radicals]
    for nodes in radical_nodes.values():
        radicals += nodes
    try:
        return Domain(radicals)
    except LimitExceeded:
        return None


def at_points(
    tableau: Tableau,
    nodes: Mapping[int, Sequence[Expression]],
    domain: Domain,
    coefficient: Callable[[Any], Any],
    number: Callable[[Number], Any],
) -> Tableau:
    """Returns blocks V_k A V_m⁻¹, weights b V⁻¹ and nodes V c with Vandermonde matrices V of nodes.

    ``nodes`` are those of the polynomial stage spaces, from ``domain``; ``coefficient`` maps
    coefficients and ``number`` numbers of the domain.
    """
    spaces: list[PointSpace] = []
    into: list[Matrix] = []
    back: list[Matrix] = []
    for k, old in enumerate(tableau.spaces):
        if k in nodes:
            space = PointSpace(tuple(map(domain.evaluate, nodes[k])))
            into.append(_mapped(space.reductions(space.stages), number))
            back.append(_mapped(space.lifts(), number))
            spaces.append(PointSpace(tuple(map(number, space.points))))
        else:
            spaces.append(PointSpace(tuple(map(coefficient, old.nodes))))
            into.append(identity(old.stages))
            back.append(identity(old.stages))
    blocks: dict[Edge, Matrix] = {}
    for (k, m), block in tableau.blocks.items():
        in_coordinates = multiply(_mapped(block, coefficient), back[tableau.colours[m].space])
        blocks[k, m] = multiply(into[k], in_coordinates)
    colours = []
    for colour in tableau.colours:
        b, c = _mapped((colour.b, colour.c), coefficient)
        k = colour.space
        colours.append(replace(colour, b=apply_left(b, back[k]), c=apply(into[k], c)))
    return Tableau(tuple(spaces), tuple(colours), blocks)


def _mapped(rows: Matrix, change: Callable[[Any], Any]) -> Matrix:
    return tuple(tuple(map(change, row)) for row in rows)


@doing("entries")
def numeric_entries(tableau: Tableau, digits: int = 17) -> Entries:
    """Returns enclosures of width below 10^(−digits)."""
    goal = int(digits * BITS_OF_A_DIGIT) + 8
    if is_gauss(tableau):
        with ctx.workprec(goal + 64):
            c, A, b = gauss_rows(tableau.spaces[0].stages)
        blocks: tuple[tuple[Block, ...], ...] = ((tuple(map(tuple, A)),),)
        return Entries((tuple(c),), blocks, (tuple(b),), False, digits, have_radicals=False)
    with ctx.workprec(goal + 64):
        while True:
            enclosed = _numeric(tableau, digits)
            if enclosed is not None:
                rows = [*enclosed.c, *enclosed.b]
                rows += (row for blocks in enclosed.A for block in blocks for row in block or ())
                bound = arb(10) ** -digits
                if all(x.rad() < bound for row in rows for x in row if isinstance(x, arb)):
                    return enclosed
            ctx.prec *= 2


def _numeric(tableau: Tableau, digits: int) -> Entries | None:
    """Returns enclosures; None if the precision is too low to invert a Vandermonde matrix."""
    try:
        frames = [_numeric_frame(space) for space in tableau.spaces]
    except ZeroDivisionError:
        return None
    c: list[Row] = []
    A: list[tuple[Block, ...]] = []
    b: list[Row] = []
    for l, colour in enumerate(tableau.colours):
        V, inverse = frames[colour.space]
        nodes = V * _to_arb([[x] for x in colour.c])
        weights = _to_arb([colour.b]) * inverse
        c.append(tuple(nodes.entries()))
        b.append(tuple(weights.entries()))
        blocks: list[Block] = []
        for m, other in enumerate(tableau.colours):
            exact = tableau.block(l, m)
            if exact is None:
                blocks.append(None)
                continue
            _, inverse_of_other = frames[other.space]
            values = V * _to_arb(exact) * inverse_of_other
            blocks.append(tuple(map(tuple, values.tolist())))
        A.append(tuple(blocks))
    return Entries(tuple(c), tuple(A), tuple(b), is_exact=False, digits=digits, have_radicals=False)


def _numeric_frame(space: StageSpace) -> tuple[arb_mat, arb_mat]:
    """The maps from coordinates to stage values and back."""
    if not isinstance(space, polynomial_space.PolynomialSpace):
        unit = _to_arb(identity(space.stages))
        return unit, unit
    return polynomial_space.powers_of_nodes(space), polynomial_space.coordinates_at_nodes(space)


def _to_arb(rows: Sequence[Sequence[Number]]) -> arb_mat:
    digits = int(ctx.prec / BITS_OF_A_DIGIT)
    return arb_mat([[to_ball(x, digits) for x in row] for row in rows])
