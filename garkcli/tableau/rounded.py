"""Tableaus whose coefficients are rounded: each number may be off by a radius of its own; the
entries of any tableau in balls, which residuals are computed with.

The tolerance t of a file says that every coefficient is off by t at most; those that are 0 are
structure and stay 0. What is made of the coefficients is as uncertain as they make it: the entries
b_j − b_j a_ji / b_i of the conjugate, nodes that are row sums. A condition is met *within t* when
its residual is no larger than such changes can make it; it fails when every method within t misses
it.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import cached_property
from itertools import chain
from typing import Any, TypeAlias, cast

from flint import arb, arb_mat, ctx, fmpq

from garkcli.exact.display import to_ball, to_balls
from garkcli.exact.field import ZERO, Number
from garkcli.exact.matrix import apply
from garkcli.frozen import Frozen, replace
from garkcli.tableau.conjugate import are_opposite, conjugate
from garkcli.tableau.embedded import Weights, with_weights
from garkcli.tableau.forms import pair, with_time
from garkcli.tableau.pointwise import Cell, numeric_entries
from garkcli.tableau.stages import PointSpace
from garkcli.tableau.tableau import Edge, Tableau

MAX_DIGITS = 300
"""Digits to which entries of polynomial stage spaces are enclosed at most; the exponents of floats
end at 308.
"""
GUARD_OF_ENTRIES = 32
"""Bits that entries are enclosed more finely than the arithmetic that uses them."""


DIGITS_OF_A_BIT = 0.302
"""Decimal digits of a bit, log10(2) rounded up."""


class Enclosure(Frozen):
    """Balls around the entries of a tableau, one coordinate a stage whatever the stage spaces are.

    Attributes:
        bits: the precision of the arithmetic meant for them.
        stages: s of each stage space.
        A: the block of each pair (space, colour) as in ``Tableau.blocks``, shape (s_space,
            s_colour).
        b: the weights of each colour as a column, shape (s_colour, 1).
    """

    bits: int
    stages: tuple[int, ...]
    A: Mapping[Edge, arb_mat]
    b: tuple[arb_mat, ...]


def enclose_tableau(tableau: Tableau, bits: int) -> Enclosure:
    """The entries to ``bits`` bits.

    Where all coefficients are spelled out any number of bits is reached; the nodes of families are
    known to ``MAX_DIGITS`` digits at most.
    """
    digits = int((bits + GUARD_OF_ENTRIES) * DIGITS_OF_A_BIT)
    with ctx.workprec(bits + GUARD_OF_ENTRIES):
        if all(isinstance(space, PointSpace) for space in tableau.spaces):
            A = {key: _balls(block, digits) for key, block in tableau.blocks.items()}
            b = [_balls([colour.b], digits).transpose() for colour in tableau.colours]
        else:
            A, b = _at_nodes(tableau, min(digits, MAX_DIGITS))
    return Enclosure(bits, tuple(space.stages for space in tableau.spaces), A, tuple(b))


def enclose_nodes(tableau: Tableau, bits: int) -> list[list[arb]]:
    """The nodes to ``bits`` bits, a row per colour; those of families as ``enclose_tableau`` has
    them.
    """
    digits = int((bits + GUARD_OF_ENTRIES) * DIGITS_OF_A_BIT)
    with ctx.workprec(bits + GUARD_OF_ENTRIES):
        if all(isinstance(space, PointSpace) for space in tableau.spaces):
            return [_balls([colour.c], digits).entries() for colour in tableau.colours]
        entries = numeric_entries(tableau, min(digits, MAX_DIGITS))
        return [[cast("arb", x) for x in row] for row in entries.c]


def _at_nodes(tableau: Tableau, digits: int) -> tuple[dict[Edge, arb_mat], list[arb_mat]]:
    """A and b where stages of families are among them: coordinates become values at nodes."""
    entries = numeric_entries(tableau, digits)
    # Colours that share a stage space have the same rows, so any of them will do.
    colour_of: dict[int, int] = {colour.space: l for l, colour in enumerate(tableau.colours)}
    A: dict[Edge, arb_mat] = {}
    for k, m in tableau.blocks:
        row = entries.A[colour_of[k]]
        A[k, m] = _matrix(row[m] or ())
    return A, [_matrix([row]).transpose() for row in entries.b]


def _matrix(rows: Sequence[Sequence[Cell]]) -> arb_mat:
    return arb_mat([[cast("arb", x) for x in row] for row in rows])


def _balls(rows: Sequence[Sequence[Number]], digits: int) -> arb_mat:
    return arb_mat(len(rows), len(rows[0]), to_balls(chain.from_iterable(rows), digits))


GUARD = 96
"""Bits beyond those of the smallest radius with which residuals are computed."""

ZERO_WEIGHT = "a weight that the conjugate divides by may be 0"
Row: TypeAlias = list[arb]
Rows: TypeAlias = list[Row]


class RoundedTableau(Frozen, eq=False):
    """A tableau with the box of all tableaus that it may be a rounding of.

    Attributes:
        tableau: as it is printed.
        tolerance: t, the rounding of its coefficients, or of its parts.
        A: radii of the blocks, with the keys of ``Tableau.blocks``.
        b: radii of the weights, a row per colour.
        c: radii of the nodes, a row per colour.
        obstacle: why nothing is known of the radii, so that only what holds exactly holds; empty
            where they are known.
    """

    tableau: Tableau
    tolerance: fmpq
    A: Mapping[Edge, Rows]
    b: Rows
    c: Rows
    obstacle: str = ""

    @staticmethod
    def within(tableau: Tableau, tolerance: fmpq) -> RoundedTableau:
        """Every coefficient that is not 0 off by ``tolerance`` at most.

        Nodes that are row sums of a block are as uncertain as these; others are coefficients.
        """
        enclosure = enclose_tableau(tableau, GUARD)
        t = arb(tolerance).abs_upper()

        def radii(values: Sequence[arb]) -> Row:
            return [arb(0) if x.is_zero() else t for x in values]

        A = {key: [radii(row) for row in block.tolist()] for key, block in enclosure.A.items()}
        b = [radii(row.entries()) for row in enclosure.b]
        c = _node_radii(tableau, A, [radii(row) for row in enclose_nodes(tableau, GUARD)])
        return RoundedTableau(tableau, tolerance, A, b, c)

    @staticmethod
    def printed(tableau: Tableau, units: Mapping[Number, fmpq]) -> RoundedTableau:
        """Every coefficient off by what its last digits leave open.

        Args:
            tableau: with a coordinate a stage.
            units: by how much each value that is printed may be off; a value that is missing was
                made of printed ones, and may be off by the largest unit.
        """
        largest = max(units.values(), default=fmpq(0))

        def radii(row: Sequence[Number]) -> Row:
            return [arb(units.get(x, largest) if x else 0).abs_upper() for x in row]

        A = {key: [radii(row) for row in block] for key, block in tableau.blocks.items()}
        b = [radii(colour.b) for colour in tableau.colours]
        c = _node_radii(tableau, A, [radii(colour.c) for colour in tableau.colours])
        return RoundedTableau(tableau, largest, A, b, c)

    @cached_property
    def bits(self) -> int:
        """Bits of residuals, so that no radius that is not 0 is lost among them."""
        radii = [x for rows in (*self.A.values(), self.b, self.c) for row in rows for x in row]
        return GUARD + max([0, *(-_binary_exponent(x) for x in radii if not x.is_zero())])

    @cached_property
    def enclosure(self) -> Enclosure:
        """The entries as they are printed."""
        return enclose_tableau(self.tableau, self.bits)

    @cached_property
    def balls(self) -> Enclosure:
        """The entries as balls around those printed: all tableaus of the box."""
        printed = self.enclosure
        with ctx.workprec(self.bits):
            A = {key: arb_mat(_widened(x.tolist(), self.A[key])) for key, x in printed.A.items()}
            rows = _widened([x.entries() for x in printed.b], self.b)
        b = tuple(arb_mat([row]).transpose() for row in rows)
        return Enclosure(printed.bits, printed.stages, A, b)

    @cached_property
    def corner(self) -> Enclosure:
        """The tableau of the box whose coefficients are largest."""
        printed = self.enclosure
        with ctx.workprec(self.bits):
            A = {key: x + arb_mat(self.A[key]) for key, x in printed.A.items()}
            b = [x + arb_mat([off]).transpose() for x, off in zip(printed.b, self.b, strict=True)]
        return Enclosure(printed.bits, printed.stages, A, tuple(b))

    @cached_property
    def nodes(self) -> Rows:
        """The nodes as balls, a row per colour."""
        with ctx.workprec(self.bits):
            return _widened(enclose_nodes(self.tableau, self.bits), self.c)

    @cached_property
    def in_balls(self) -> Tableau:
        """The tableau with these balls in place of its numbers, a coordinate a stage."""
        A: Any = self.balls.A  # no numbers, and used like these
        b: Any = self.balls.b
        c: Any = self.nodes
        blocks = {key: tuple(map(tuple, block.tolist())) for key, block in A.items()}
        colours = tuple(
            replace(colour, b=tuple(weights.entries()), c=tuple(nodes))
            for colour, weights, nodes in zip(self.tableau.colours, b, c, strict=True)
        )
        return Tableau(tuple(PointSpace((ZERO,) * s) for s in self.balls.stages), colours, blocks)

    def conjugate(self) -> RoundedTableau:
        """The symplectic conjugate, with an obstacle where a weight that it divides by may be 0.

        Raises:
            ZeroWeight: that weight is 0.
        """
        conjugated = conjugate(self.tableau)
        if self._hats is None:
            return self._open(conjugated)
        A = {(self._row(l), m): radii for (l, m), radii in self._hats.items()}
        return RoundedTableau(conjugated, self.tolerance, A, self.b, self.c)

    def pair(self) -> RoundedTableau:
        """The symplectic pair (Q, P), whose position blocks are those of the method; likewise.

        Raises:
            ZeroWeight: a weight that a conjugate divides by is 0.
        """
        both = pair(self.tableau)
        if self.tableau.is_partitioned:
            if both.blocks == self.tableau.blocks:
                return self
            kept = {key: radii for key, radii in self.A.items() if both.colours[key[1]].part == "q"}
            shift = 0
        else:
            kept = {(l, m): self.A[self._space(l), m] for l, m in self.tableau.edges()}
            shift = self.tableau.size
        if self._hats is None:
            return self._open(both)
        made = {(self._row(l), shift + m): radii for (l, m), radii in self._hats.items()}
        copies = 2 if shift else 1
        return RoundedTableau(both, self.tolerance, made | kept, self.b * copies, self.c * copies)

    def with_time(self) -> RoundedTableau | None:
        """With time as its last colour, whose blocks are the nodes; None where it has no sense."""
        timed = with_time(self.tableau)
        if timed is None:
            return None
        A = dict(self.A)
        for l, colour in enumerate(self.tableau.colours):
            A[colour.space, self.tableau.size] = [[radius] for radius in self.c[l]]
        clock = [[arb(0)]]
        return RoundedTableau(timed, self.tolerance, A, self.b + clock, self.c + clock)

    def with_weights(self, weights: Weights, terms: Weights | None = None) -> RoundedTableau:
        """The same stages with other weights.

        Args:
            weights: a row per colour.
            terms: of how many coefficients each is the sum; None where each is one that is rounded
                like the others, or 0.
        """
        changed = with_weights(self.tableau, weights)
        counts = terms or [[fmpq(bool(x)) for x in row] for row in weights]
        t = arb(self.tolerance)
        b = [[(t * to_ball(n)).abs_upper() for n in row] for row in counts]
        return RoundedTableau(changed, self.tolerance, self.A, b, self.c)

    def _open(self, derived: Tableau) -> RoundedTableau:
        return RoundedTableau(derived, self.tolerance, {}, [], [], ZERO_WEIGHT)

    def _space(self, l: int) -> int:
        return self.tableau.colours[l].space

    def _row(self, l: int) -> int:
        """The stage space of colour l in the conjugate and in the pair: its own, unless the method
        is partitioned.
        """
        return self._space(l) if self.tableau.is_partitioned else l

    @cached_property
    def _hats(self) -> dict[Edge, Rows] | None:
        """The radii of every Â^{l,m}, shape (stages of l, stages of m); None where a weight that it
        divides by may be 0.
        """
        hats: dict[Edge, Rows] = {}
        with ctx.workprec(self.bits):
            for m, l in self.tableau.edges():
                if not are_opposite(self.tableau.colours[l], self.tableau.colours[m]):
                    continue
                printed, box = self._hat(self.enclosure, l, m), self._hat(self.balls, l, m)
                if printed is None or box is None:
                    return None
                hats[l, m] = [
                    [(y - x).abs_upper() for x, y in zip(row, balls, strict=True)]
                    for row, balls in zip(printed, box, strict=True)
                ]
        return hats

    def _hat(self, entries: Enclosure, l: int, m: int) -> Rows | None:
        """Â^{l,m}_ij = b_j (1 − a_ji / b_i), which is b_i − a_ii on the diagonal."""
        block = entries.A[self._space(m), l].tolist()
        divisors, weights = entries.b[l].entries(), entries.b[m].entries()
        if any(b_i.contains(0) for b_i in divisors):
            return None
        return [
            [
                b_j - block[j][i] if l == m and i == j else b_j * (1 - block[j][i] / b_i)
                for j, b_j in enumerate(weights)
            ]
            for i, b_i in enumerate(divisors)
        ]


def _binary_exponent(number: arb) -> int:
    """The least e with number < 2^e."""
    mantissa, exponent = number.man_exp()
    return int(mantissa.bit_length()) + int(exponent)


def _node_radii(tableau: Tableau, A: Mapping[Edge, Rows], printed: Rows) -> Rows:
    """The radii of the nodes: those of the row sums of a block whose row sums they are."""
    of_nodes = []
    for l, colour in enumerate(tableau.colours):
        radii = printed[l]
        for m in range(tableau.size):
            block = tableau.block(l, m)
            if block is not None and apply(block, tableau.space(m).one) == tuple(colour.c):
                radii = [sum(row, arb(0)).abs_upper() for row in A[colour.space, m]]
                break
        of_nodes.append(radii)
    return of_nodes


def _widened(rows: Sequence[Sequence[arb]], radii: Rows) -> Rows:
    return [
        [x + arb(0, radius) for x, radius in zip(row, radii_of_row, strict=True)]
        for row, radii_of_row in zip(rows, radii, strict=True)
    ]
