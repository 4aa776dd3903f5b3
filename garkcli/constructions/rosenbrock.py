"""Rosenbrock–Wanner and W-methods as tableaus, one colour or several.

    k_i = h f(y + Σ_j α_ij k_j) + h J Σ_j γ_ij k_j,        y_1 = y + Σ_i b_i k_i.

With J = f'(y) the second term adds to the trees in which one branch is on a vertex of f, and to no
other: f is two colours, with no branch or several, through α, and with exactly one, through β = α +
γ. An arbitrary matrix J is a vector field of its own, with exactly one branch, that the exact
solution does not have; so is the error h E of J = f'(y) + h E, whose vertices count two orders.
Proof: docs/exact-order.md, section 9.

E. Hairer, G. Wanner, *Solving Ordinary Differential Equations II*, IV.7; T. Steihaug, A.
Wolfbrandt, Math. Comp. 33 (1979) 521; A. Sandu, M. Günther, S. Roberts, "Linearly implicit GARK
schemes", Appl. Numer. Math. 161 (2021) 286, for several colours.
"""

from __future__ import annotations

from functools import partial
from itertools import permutations
from operator import add as add_numbers
from operator import sub as subtract_numbers
from typing import Literal, TypeAlias

from garkcli.errors import MethodError, ShapeMismatch
from garkcli.exact import matrix as matrices
from garkcli.exact.field import ZERO
from garkcli.frozen import Frozen, replace
from garkcli.ntrees import kind as nature
from garkcli.order.meant import AnyTableau
from garkcli.properties.registry import OF_TEST_EQUATION
from garkcli.reason import Reason
from garkcli.tableau.embedded import NOTHING, DenseOutput, Further
from garkcli.tableau.forms import beside_clock, gark
from garkcli.tableau.stages import PointSpace
from garkcli.tableau.tableau import Colour, Edge, Tableau, butcher

Blocks: TypeAlias = tuple[tuple[matrices.Matrix, ...], ...]
Rows: TypeAlias = tuple[matrices.Vector, ...]
CONSTRAINT = nature.VertexKind(frozenset({nature.SEVERAL}), weight=0)
"""The kind of g in 0 = g(y, z), which is solved for z."""


class Rosenbrock(Frozen):
    """A linearly implicit method.

    Attributes:
        alpha: α^{l,m}, of the arguments of f^{l}; shape (stages of l, stages of m).
        gamma: γ^{l,m}, beside the Jacobian of f^{l}; shaped like alpha.
        c: the nodes of f, one row per colour; None for the row sums of α^{l,l}.
        d: the weights of ∂f/∂t; None for the row sums of γ^{l,l}.
    """

    alpha: Blocks
    gamma: Blocks
    b: tuple[matrices.Vector, ...]
    c: Rows | None = None
    d: Rows | None = None

    @staticmethod
    def of(tableau: Tableau) -> Rosenbrock:
        """The inverse of ``tableau``: ``of(method.tableau) == method``, with its nodes."""
        N = tableau.size // 2

        def blocks(first: int) -> Blocks:
            return tuple(tuple(tableau.blocks[first + l, m] for m in range(N)) for l in range(N))

        alpha, beta = blocks(0), blocks(N)
        gamma = tuple(
            tuple(map(matrices.subtract, *rows)) for rows in zip(beta, alpha, strict=True)
        )
        nodes = tuple(colour.c for colour in tableau.colours)
        d = tuple(
            tuple(map(subtract_numbers, *rows)) for rows in zip(nodes[N:], nodes[:N], strict=True)
        )
        return Rosenbrock(alpha, gamma, tuple(x.b for x in tableau.colours[:N]), nodes[:N], d)

    @property
    def without_row_sums(self) -> Rosenbrock:
        plain = replace(self, c=None, d=None)
        c, d = plain.nodes
        return replace(self, c=None if self.c == c else self.c, d=None if self.d == d else self.d)

    @property
    def tableau(self) -> Tableau:
        """The tableau with the Jacobians of all f^{l} at the beginning of the step."""
        return self._tableau(
            ("f", nature.NOT_ONE, self.alpha), ("f'", nature.ONE_BRANCH, self._beta)
        )

    @property
    def with_any_matrix(self) -> Tableau:
        """The tableau of the W-method, with an arbitrary matrix for each Jacobian."""
        return self._tableau(("f", nature.PLAIN, self.alpha), ("W", nature.MATRIX, self.gamma))

    @property
    def with_old_jacobian(self) -> Tableau:
        """The tableau for matrices that differ from the Jacobians by O(h)."""
        return self._tableau(
            ("f", nature.NOT_ONE, self.alpha),
            ("f'", nature.ONE_BRANCH, self._beta),
            ("E", nature.ERROR_OF_MATRIX, self.gamma),
        )

    @property
    def with_time(self) -> Tableau:
        """The tableau for f(t, y), with h d_i f_t added to the stages, and time as a colour."""
        return beside_clock(self.tableau, len(self.b))

    @property
    def on_dae(self) -> Tableau:
        """The tableau on ẏ = f(y, z), 0 = g(y, z) of index 1: order p has the conditions of y up to
        p, and those of z up to p − 1. A vertex of g has several branches and counts no order.

        SingularMatrixError if β = α + γ has no inverse, so z is not determined.
        """
        return self._on_dae(late=1)

    @property
    def on_dae_in_y(self) -> Tableau:
        """The tableau on DAEs with the conditions of y only."""
        return self._on_dae(late=None)

    @property
    def on_dae_in_z(self) -> Tableau:
        """The tableau on DAEs with the conditions of z, which include those of y."""
        return self._on_dae(late=0)

    def _on_dae(self, late: int | None) -> Tableau:
        made = self.tableau
        if len(self.b) > 1:
            message = "orders on DAEs are for Rosenbrock methods of one colour"
            raise MethodError(message, "leave them out", code="cannot-construct")
        (((alpha,),), ((beta,),)), g = (self.alpha, self._beta), made.size
        stages, c = len(beta), made.colours[0].c
        inverse = matrices.solve(beta, matrices.identity(stages))
        seen_by_f = matrices.multiply(alpha, inverse)
        weights = matrices.apply_left(self.b[0], inverse)
        constraint = Colour("g", g, weights, c, term=1, kind=CONSTRAINT, late=late)
        blocks = {
            (0, g): seen_by_f,
            (1, g): matrices.identity(stages),
            (g, 0): alpha,
            (g, 1): alpha,
            (g, g): seen_by_f,
        }
        spaces = (*made.spaces, PointSpace(c))
        return Tableau(spaces, (*made.colours, constraint), {**made.blocks, **blocks})

    @property
    def diagonal(self) -> matrices.Vector:
        blocks = [row[l] for l, row in enumerate(self.gamma)]
        return tuple(row[i] for block in blocks for i, row in enumerate(block))

    @property
    def arrays(self) -> tuple[Tableau, Tableau]:
        """The printed arrays: α with c and b, and γ with d."""
        made = []
        for name, blocks, nodes in zip("αγ", (self.alpha, self.gamma), self.nodes, strict=True):
            spaces = tuple(map(PointSpace, nodes))
            names = [name] if len(self.b) == 1 else [f"{name}{l + 1}" for l in range(len(self.b))]
            rows = zip(names, self.b, nodes, strict=True)
            colours = tuple(Colour(x, l, b, c, l) for l, (x, b, c) in enumerate(rows))
            edges = {(l, m): x for l, row in enumerate(blocks) for m, x in enumerate(row)}
            made.append(Tableau(spaces, colours, edges))
        return made[0], made[1]

    @property
    def on_test_equation(self) -> Tableau:
        """The Runge–Kutta or GARK method with the same R(z): A = β."""
        return self._gark(self._beta, None)

    @property
    def without_jacobian(self) -> Tableau:
        """The Runge–Kutta or GARK method with A = α."""
        return self._gark(self.alpha, self.nodes[0])

    def _gark(self, blocks: Blocks, nodes: Rows | None) -> Tableau:
        methods = [
            butcher(blocks[l][l], b, None if nodes is None else nodes[l])
            for l, b in enumerate(self.b)
        ]
        pairs = permutations(range(len(methods)), 2)
        return gark(methods, {(l, m): blocks[l][m] for l, m in pairs})

    @property
    def nodes(self) -> tuple[Rows, Rows]:
        c, d = self.c, self.d
        if c is None:
            c = tuple(_sums(row[l]) for l, row in enumerate(self.alpha))
        if d is None:
            d = tuple(_sums(row[l]) for l, row in enumerate(self.gamma))
        return c, d

    @property
    def _beta(self) -> Blocks:
        return tuple(
            tuple(map(matrices.add, *rows)) for rows in zip(self.alpha, self.gamma, strict=True)
        )

    def _tableau(self, *kinds: tuple[str, nature.VertexKind, Blocks]) -> Tableau:
        N = len(self.b)
        c, d = self.nodes
        alone = tuple(tuple(map(add_numbers, *rows)) for rows in zip(c, d, strict=True))
        nodes_of = {"f": c, "f'": alone}
        spaces: list[PointSpace] = []
        colours: list[Colour] = []
        blocks: dict[Edge, matrices.Matrix] = {}
        for letter, kind, through in kinds:
            for l in range(N):
                k = len(spaces)
                name = letter if N == 1 else f"{letter[:1]}{l + 1}{letter[1:]}"
                nodes = nodes_of.get(letter, d)[l]
                spaces.append(PointSpace(nodes))
                colours.append(Colour(name, k, self.b[l], nodes, l, kind=kind))
                blocks |= {(k, m): through[l][m % N] for m in range(N * len(kinds))}
        return Tableau(tuple(spaces), tuple(colours), blocks)


def is_rosenbrock(tableau: Tableau) -> bool:
    kinds = [colour.kind for colour in tableau.colours]
    N = len(kinds) // 2
    return bool(kinds) and kinds == [nature.NOT_ONE] * N + [nature.ONE_BRANCH] * N


Which: TypeAlias = Literal[
    "with_any_matrix",
    "with_old_jacobian",
    "with_time",
    "on_test_equation",
    "on_dae",
    "on_dae_in_y",
    "on_dae_in_z",
]


VIEWS: dict[str, Which] = {
    "w-order": "with_any_matrix",
    "old-jacobian-order": "with_old_jacobian",
    "nonautonomous-order": "with_time",
}
"""Orders other than that with the Jacobian, by claim."""
DAE_VIEWS: dict[str, Which] = {
    "index-1-order": "on_dae",
    "index-1-y-order": "on_dae_in_y",
    "index-1-z-order": "on_dae_in_z",
}
"""Orders on differential-algebraic equations, which need an inverse of α + γ."""
OF_BETA = OF_TEST_EQUATION | {"gamma"}
NO_PROPERTY = Reason("a property of Runge–Kutta methods, which this Rosenbrock method is not")


def seen(method: AnyTableau, which: Which) -> AnyTableau:
    """Another view of the method; SingularMatrixError if the DAE does not determine z."""
    if isinstance(method, Tableau):
        return _seen(which, method)
    return method.derive(which.replace("_", " "), partial(_seen, which))


def _seen(which: Which, tableau: Tableau) -> Tableau:
    found: Tableau = getattr(Rosenbrock.of(tableau), which)
    return found


def transformed_weights(further: Further, gamma: matrices.Matrix) -> Further:
    """Returns embedded weights and dense output from their stored form m = b Γ⁻¹."""
    return _times(further, gamma)


def _times(further: Further, matrix: matrices.Matrix) -> Further:
    embedded, dense = further.embedded, further.dense
    if embedded is not None:
        embedded = tuple(matrices.apply_left(row, matrix) for row in embedded)
    if dense is not None:
        powers = [
            [matrices.apply_left(row, matrix) for row in zip(*block, strict=True)]
            for block in dense.weights
        ]
        dense = DenseOutput(tuple(tuple(zip(*rows, strict=True)) for rows in powers))
    return Further(embedded, dense)


def rosenbrock(alpha: matrices.Matrix, gamma: matrices.Matrix, b: matrices.Vector) -> Rosenbrock:
    """Returns a method of one colour; ShapeMismatch unless shapes are (s, s) and length is s."""
    s = len(b)
    for letter, matrix in (("alpha", alpha), ("gamma", gamma)):
        if len(matrix) != s or {*map(len, matrix)} != {s}:
            message = f"{letter} is not {s} by {s}"
            raise ShapeMismatch(message, f"b has {s} entries", code="wrong-size")
    return Rosenbrock(((alpha,),), ((gamma,),), (b,))


def transformed(
    A: matrices.Matrix, C: matrices.Matrix, gamma: matrices.Vector, m: matrices.Vector
) -> Rosenbrock:
    """Returns the method of the stored form A = α Γ⁻¹, C = diag(1/γ_ii) − Γ⁻¹, m = b Γ⁻¹.

    ``gamma`` has the γ_ii. Raises MethodError if one is zero, or C has a nonzero entry on or above
    the diagonal.
    """
    full = _full(C, gamma)
    return rosenbrock(matrices.multiply(A, full), full, matrices.apply_left(m, full))


class Stored(Frozen):
    """The stored form of ``transformed``; ``further`` weights are at its stages."""

    A: matrices.Matrix
    C: matrices.Matrix
    gamma: matrices.Vector
    m: matrices.Vector
    further: Further = NOTHING


def stored(method: Rosenbrock, further: Further = NOTHING) -> Stored:
    """Returns the stored form; MethodError if γ is not lower triangular, or a γ_ii is zero."""
    alpha, gamma, b = method.alpha[0][0], method.gamma[0][0], method.b[0]
    cure = "its coefficients are divided by the diagonal: write alpha, gamma and b"
    if any(any(row[i + 1 :]) for i, row in enumerate(gamma)):
        message = "gamma is not lower triangular, and programs solve for a stage at a time"
        raise MethodError(message, cure, code="cannot-construct")
    if not all(method.diagonal):
        message = "a diagonal entry of gamma is 0, and programs divide by it"
        raise MethodError(message, cure, code="cannot-construct")
    s = len(b)
    inverse = matrices.solve(gamma, matrices.identity(s))
    C = tuple(tuple(-x if j < i else ZERO for j, x in enumerate(inverse[i])) for i in range(s))
    m = matrices.apply_left(b, inverse)
    return Stored(
        matrices.multiply(alpha, inverse), C, method.diagonal, m, _times(further, inverse)
    )


def _full(C: matrices.Matrix, gamma: matrices.Vector) -> matrices.Matrix:
    if not all(gamma):
        message = "a diagonal entry of gamma is 0, and the coefficients are divided by it"
        raise MethodError(message, "give alpha and gamma", code="cannot-construct")
    if any(any(row[i:]) for i, row in enumerate(C)):
        message = "C is not zero on and above its diagonal, and diag(1/γ) − Γ⁻¹ is"
        raise MethodError(message, "give alpha and gamma", code="cannot-construct")
    # row after row: elimination takes ten times as long on affine forms
    rows: list[matrices.Vector] = []
    for i, (diagonal, row) in enumerate(zip(gamma, C, strict=True)):
        before = [matrices.dot(row[:i], column) for column in zip(*rows, strict=True)]
        rows.append((*(diagonal * x for x in before[:i]), diagonal, *(ZERO,) * (len(C) - i - 1)))
    return tuple(rows)


def _sums(block: matrices.Matrix) -> matrices.Vector:
    return matrices.apply(block, PointSpace(block[0]).one)
