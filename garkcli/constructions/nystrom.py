"""Nyström methods for q″ = g(q, q′), or g(q), as tableaus.

    g_i = g(q + c_i h q′ + h² Σ_j ā_ij g_j, q′ + h Σ_j a_ij g_j),
    q_1 = q + h q′ + h² Σ_i b̄_i g_i,        q′_1 = q′ + h Σ_i b_i g_i.

A vertex of g has branches of three kinds: on q it sees q′, a leaf with the column c, and g through
Ā, which counts two orders; on q′ it sees g through A, which counts one. The first two colours share
stages, with the weights b̄ of the step in q and b of that in q′. Proof of the conditions:
docs/exact-order.md, section 11.

E. Hairer, S. P. Nørsett, G. Wanner, *Solving Ordinary Differential Equations I*, II.14.
"""

from __future__ import annotations

from functools import partial
from typing import Literal, TypeAlias

from flint import fmpq

from garkcli.errors import MethodError, ShapeMismatch
from garkcli.exact.field import ONE, ZERO
from garkcli.exact.matrix import Matrix, Vector
from garkcli.frozen import Frozen, replace
from garkcli.ntrees.kind import ARGUMENT, LEAF, VertexKind
from garkcli.order.meant import AnyTableau, keep, meant, printed
from garkcli.tableau.embedded import DenseOutput, Weights
from garkcli.tableau.forms import with_linear
from garkcli.tableau.stages import PointSpace
from garkcli.tableau.tableau import Colour, Edge, Tableau

TWICE = VertexKind(weight=2, is_field=False)
KINDS = (TWICE, ARGUMENT, LEAF)
NAMES = ("q", "q'", "q'0")
POSITIONS, VELOCITIES, START = range(3)


class Nystrom(Frozen):
    """Attributes:
    Abar: ā_ij, through which positions see g; shape (s, s).
    A: a_ij, through which velocities see g; None if g depends on q only.
    c: the coefficients of h q′ in the positions, and of time.
    bbar: b̄_i, the weights of the step in q.
    b: the weights of the step in q′.
    """

    Abar: Matrix
    A: Matrix | None
    c: Vector
    bbar: Vector
    b: Vector

    @staticmethod
    def of(tableau: Tableau) -> Nystrom:
        """The inverse of ``tableau``: ``of(method.tableau) == method``."""
        blocks = tableau.blocks
        c = tuple(row[0] for row in blocks[0, START])
        bbar, b = (tableau.colours[l].b for l in (POSITIONS, VELOCITIES))
        return Nystrom(blocks[0, POSITIONS], blocks.get((0, VELOCITIES)), c, bbar, b)

    @property
    def tableau(self) -> Tableau:
        """The tableau with the colours g in q, g in q′, and q′ at the beginning of the step."""
        spaces = (PointSpace(self.c), PointSpace((ZERO,)))
        rows = ((0, self.bbar, self.c), (0, self.b, self.c), (1, (ONE,), (ZERO,)))
        colours = tuple(
            Colour(name, k, b, c, term=l, kind=kind)
            for l, (name, kind, (k, b, c)) in enumerate(zip(NAMES, KINDS, rows, strict=True))
        )
        blocks: dict[Edge, Matrix] = {(0, POSITIONS): self.Abar}
        if self.A is not None:
            blocks[0, VELOCITIES] = self.A
        blocks[0, START] = tuple((x,) for x in self.c)
        return Tableau(spaces, colours, blocks)

    @property
    def in_positions(self) -> Tableau:
        return _without(self.tableau, VELOCITIES)

    @property
    def in_velocities(self) -> Tableau:
        return _without(self.tableau, POSITIONS)

    @property
    def partitioned(self) -> Tableau:
        """The partitioned method for q̇ = p, ṗ = g(q).

        The velocities p are evaluated at the beginning, with each row of Ā, and with b̄:
        q + c_i h q′ + h² Σ_j ā_ij g_j = q + (c_i − 1) h p + h (p + h Σ_j ā_ij g_j).
        """
        s = len(self.b)
        zeros = (ZERO,) * s
        last = (*(ZERO for _ in range(s + 1)), ONE)
        of_positions = tuple(
            (x - 1, *(fmpq(int(i == j)) for j in range(s)), ZERO) for i, x in enumerate(self.c)
        )
        of_velocities = (zeros, *self.Abar, self.bbar)
        sums = tuple(sum(row, start=ZERO) for row in of_velocities)
        colours = (Colour("q", 0, last, sums, 0, "q"), Colour("p", 1, self.b, self.c, 1, "p"))
        spaces = (PointSpace(sums), PointSpace(self.c))
        blocks = {(0, 1): of_velocities, (1, 0): of_positions}
        return with_linear(Tableau(spaces, colours, blocks), ["q"])

    @property
    def split(self) -> Tableau:
        """The method for (q̇, ṗ) = (p, 0) + (0, g(q, p)), each colour with all unknowns."""
        made = self.partitioned
        nothing = tuple((ZERO,) * len(self.b) for _ in self.b)
        width = len(self.b) + 2
        blocks = {
            **made.blocks,
            (0, 0): tuple((ZERO,) * width for _ in range(width)),
            (1, 1): nothing if self.A is None else self.A,
        }
        colours = (
            Colour("q", 0, made.colours[0].b, (ZERO,) * width, 0),
            Colour("p", 1, self.b, self.c, 1),
        )
        return Tableau(made.spaces, colours, blocks)

    @property
    def arrays(self) -> tuple[Tableau, Tableau]:
        """The printed arrays: Ā with c and b̄, and A with b, where A is zero if there is none."""

        def array(name: str, A: Matrix, b: Vector) -> Tableau:
            colour = Colour(name, 0, b, self.c)
            return Tableau((PointSpace(self.c),), (colour,), {(0, 0): A})

        nothing = tuple((ZERO,) * len(self.b) for _ in self.b)
        A = nothing if self.A is None else self.A
        return array("Ā", self.Abar, self.bbar), array("A", A, self.b)


def _without(tableau: Tableau, l: int) -> Tableau:
    colours = list(tableau.colours)
    colours[l] = replace(colours[l], late=None)
    return replace(tableau, colours=tuple(colours))


def is_nystrom(tableau: Tableau) -> bool:
    return tuple(colour.kind for colour in tableau.colours) == KINDS


Which: TypeAlias = Literal["in_positions", "in_velocities", "partitioned", "split"]


def seen(method: AnyTableau, which: Which) -> AnyTableau:
    if isinstance(method, Tableau):
        return _seen(which, method)
    return method.derive(which.replace("_", " "), partial(_seen, which))


def _seen(which: Which, tableau: Tableau) -> Tableau:
    found: Tableau = getattr(Nystrom.of(tableau), which)
    return found


def partitioned(tableau: Tableau, tolerance: fmpq | None) -> Tableau:
    """The partitioned method for q̇ = p, ṗ = g(q), known to ``meant`` with its rounding."""
    found = seen(meant(tableau, tolerance), "partitioned")
    if not isinstance(found, Tableau):
        keep(found)
    return printed(found)


def weights_of(bbar: Vector, b: Vector) -> Weights:
    """Returns the weights by colours from those of the steps in q and q′, such as embedded ones."""
    return bbar, b, (ONE,)


def dense_of(bbar: Matrix, b: Matrix | None) -> DenseOutput:
    """Dense output q + θhq′ + h² Σ b̄_i(θ) g_i, q′ + h Σ b_i(θ) g_i, by coefficients of θ, θ², …

    ``b`` is None if q′ is the slope of q; MethodError if that does not begin with q′.
    """
    if b is None:
        if any(row[0] for row in bbar):
            message = "dense, b missing: the slope of q does not begin with q′"
            raise MethodError(message, "give b", code="missing-key")
        b = tuple((*(k * x for k, x in enumerate(row[1:], start=2)), ZERO) for row in bbar)
    degree = len(bbar[0])
    start = (ONE, *(ZERO,) * (degree - 1))
    return DenseOutput((bbar, b, (start,)))


def nystrom(Abar: Matrix, A: Matrix | None, c: Vector, bbar: Vector, b: Vector) -> Nystrom:
    """Returns a Nyström method; ``A`` is None if g depends on q only. Raises ShapeMismatch unless
    shapes are (s, s) and lengths s.
    """
    s = len(b)
    sizes = (("Abar", Abar, s), ("A", A or Abar, s), ("c", (c,), 1), ("bbar", (bbar,), 1))
    for letter, rows, count in sizes:
        if len(rows) != count or {*map(len, rows)} != {s}:
            message = f"{letter} is not {count} by {s}"
            raise ShapeMismatch(message, f"b has {s} entries", code="wrong-size")
    return Nystrom(Abar, A, c, bbar, b)
