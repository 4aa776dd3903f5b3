"""Rosenbrock–Wanner and W-methods as tableaus, one colour or several.

    k_i = h f(y + Σ_j α_ij k_j) + h J Σ_j γ_ij k_j,        y_1 = y + Σ_i b_i k_i.

With J = f'(y) the second term adds to the trees in which one branch is on a vertex of f, and to no
other: f is two colours, with no branch or several, through α, and with exactly one, through β = α +
γ. An arbitrary matrix J is a vector field of its own, with exactly one branch, that the exact
solution does not have; so is the error h E of J = f'(y) + h E, whose vertices count two orders. The
conditions are those of ``garkcli.order``; docs/exact-order.md proves it, section 9.

Sources: E. Hairer, G. Wanner, *Solving Ordinary Differential Equations II*, IV.7; T. Steihaug, A.
Wolfbrandt, "An attempt to avoid exact Jacobian and nonlinear equations in the numerical solution of
stiff differential equations", Math. Comp. 33 (1979) 521; A. Sandu, M. Günther, S. Roberts,
"Linearly implicit GARK schemes", Appl. Numer. Math. 161 (2021) 286, for several colours.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from operator import add as add_numbers
from typing import Any, TypeAlias

from flint import fmpq

from garkcli.errors import MethodError, ShapeMismatch
from garkcli.exact.field import ONE, ZERO, Number
from garkcli.exact.matrix import Matrix, Vector, add, apply, apply_left, identity, multiply, solve
from garkcli.frozen import Frozen
from garkcli.ntrees.kind import LEAF, PLAIN, SEVERAL, Kind
from garkcli.order.recovering import Recovery
from garkcli.order.rounded import RoundedTableau
from garkcli.tableau.box import Box
from garkcli.tableau.embedded import Weights
from garkcli.tableau.forms import TIME
from garkcli.tableau.stages import PointSpace
from garkcli.tableau.tableau import Colour, Edge, Tableau

Blocks: TypeAlias = tuple[tuple[Matrix, ...], ...]
NOT_ONE = Kind(frozenset({0, SEVERAL}))
ONE_BRANCH = Kind(frozenset({1}))
MATRIX = Kind(frozenset({1}), is_exact=False)
ERROR_OF_MATRIX = Kind(frozenset({1}), weight=2, is_exact=False)


class Rosenbrock(Frozen):
    """A linearly implicit method.

    Attributes:
        alpha: α^{l,m}, of the arguments of f^{l}; shape (stages of l, stages of m).
        gamma: γ^{l,m}, beside the Jacobian of f^{l}; the same shapes.
        b: its weights, one row per colour.
    """

    alpha: Blocks
    gamma: Blocks
    b: tuple[Vector, ...]

    @property
    def tableau(self) -> Tableau:
        """With the Jacobians of all f^{l} at the beginning of the step."""
        return self._tableau(("f", NOT_ONE, self.alpha), ("f'", ONE_BRANCH, self._beta))

    @property
    def with_any_matrix(self) -> Tableau:
        """The W-method: with an arbitrary matrix for each Jacobian."""
        return self._tableau(("f", PLAIN, self.alpha), ("W", MATRIX, self.gamma))

    @property
    def with_old_jacobian(self) -> Tableau:
        """With matrices that differ from the Jacobians by O(h), such as those of earlier steps."""
        return self._tableau(
            ("f", NOT_ONE, self.alpha),
            ("f'", ONE_BRANCH, self._beta),
            ("E", ERROR_OF_MATRIX, self.gamma),
        )

    def with_time(
        self, c: Sequence[Vector] | None = None, d: Sequence[Vector] | None = None
    ) -> Tableau:
        """Of f(t, y), with h d_i f_t added to the stages: time is a colour besides.

        Args:
            c: where f is evaluated, one row per colour; by default the sums of the rows of α^{l,l}.
            d: the weights of f_t; by default those of γ^{l,l}.
        """
        if c is None:
            c = [_sums(row[l]) for l, row in enumerate(self.alpha)]
        if d is None:
            d = [_sums(row[l]) for l, row in enumerate(self.gamma)]
        made = self.tableau
        time = made.size
        alone = [tuple(map(add_numbers, *rows)) for rows in zip(c, d, strict=True)]
        blocks = {(k, time): tuple((x,) for x in row) for k, row in enumerate([*c, *alone])}
        clock = Colour(TIME, len(made.spaces), (ONE,), (ZERO,), term=len(self.b), kind=LEAF)
        spaces = (*made.spaces, PointSpace((ZERO,)))
        return Tableau(spaces, (*made.colours, clock), {**made.blocks, **blocks})

    @property
    def _beta(self) -> Blocks:
        """β = α + γ."""
        return tuple(tuple(map(add, *rows)) for rows in zip(self.alpha, self.gamma, strict=True))

    def _tableau(self, *kinds: tuple[str, Kind, Blocks]) -> Tableau:
        """The colours of each kind see all others through blocks of their own.

        Args:
            kinds: a letter, what vertices are like, and the blocks.
        """
        N = len(self.b)
        spaces: list[PointSpace] = []
        colours: list[Colour] = []
        blocks: dict[Edge, Matrix] = {}
        for letter, kind, through in kinds:
            for l in range(N):
                k = len(spaces)
                name = letter if N == 1 else f"{letter[:1]}{l + 1}{letter[1:]}"
                nodes = _sums(through[l][l])
                spaces.append(PointSpace(nodes))
                colours.append(Colour(name, k, self.b[l], nodes, l, kind=kind))
                blocks |= {(k, m): through[l][m % N] for m in range(N * len(kinds))}
        return Tableau(tuple(spaces), tuple(colours), blocks)


def weights_for(tableau: Tableau, b: Sequence[Vector]) -> Weights:
    """A row for each colour of one of these tableaus, from one for each f^{l}, such as embedded
    weights; time keeps its own.
    """
    return tuple(b[colour.term] if colour.term < len(b) else colour.b for colour in tableau.colours)


def rosenbrock(alpha: Matrix, gamma: Matrix, b: Vector) -> Rosenbrock:
    """A method of one colour.

    Args:
        alpha: shape (s, s), lower triangular or any other.
        gamma: shape (s, s).
        b: length s.

    Raises:
        ShapeMismatch: they do not fit each other.

    >>> from flint import fmpq
    >>> from garkcli.order.certificate import find_order
    >>> half, one, zero = fmpq(1, 2), fmpq(1), fmpq(0)
    >>> ros2 = rosenbrock(((zero, zero), (one, zero)), ((half, zero), (-one, half)), (half, half))
    >>> find_order(ros2.tableau), find_order(ros2.with_any_matrix)
    (<Order 2>, <Order 2>)
    """
    s = len(b)
    for letter, matrix in (("alpha", alpha), ("gamma", gamma)):
        if len(matrix) != s or {*map(len, matrix)} != {s}:
            message = f"{letter} is not {s} by {s}"
            raise ShapeMismatch(message, f"b has {s} entries", code="wrong-size")
    return Rosenbrock(((alpha,),), ((gamma,),), (b,))


def transformed(A: Matrix, C: Matrix, gamma: Vector, m: Vector) -> Rosenbrock:
    """A method as programs store it: A = α Γ⁻¹, C = diag(1/γ_ii) − Γ⁻¹, m = b Γ⁻¹.

    Args:
        A: shape (s, s).
        C: shape (s, s); its lower triangle counts.
        gamma: γ_ii of each stage.
        m: length s.

    Raises:
        MethodError: a γ_ii is zero.
    """
    if not all(gamma):
        message = "a diagonal entry of gamma is 0, and the coefficients are divided by it"
        raise MethodError(message, "give alpha and gamma", code="cannot-construct")
    s = len(m)
    inverse = tuple(
        tuple((ONE / gamma[i] if i == j else ZERO) - (C[i][j] if j < i else ZERO) for j in range(s))
        for i in range(s)
    )
    full = solve(inverse, identity(s))
    return rosenbrock(multiply(A, full), full, apply_left(m, full))


def rounded(
    method: Rosenbrock, tolerance: fmpq, of: Callable[[Rosenbrock], Tableau]
) -> RoundedTableau:
    """One of the tableaus of a method whose numbers are rounded.

    Args:
        method: as it is printed.
        tolerance: how far every number that is not 0 may be off; equal γ_ii are one number.
        of: which tableau.
    """
    printed: dict[object, Number] = {}

    def changed(values: Mapping[object, Any]) -> Rosenbrock:
        """The method with values in place of the numbers, which are noted where they are new."""

        def entry(place: object, x: Number) -> Any:
            if not x:
                return x
            printed.setdefault(place, x)
            return values.get(place, x)

        def block(letter: str, l: int, m: int, rows: Matrix) -> Matrix:
            return tuple(
                tuple(
                    entry(("γ_ii", x) if letter == "γ" and i == j else (letter, l, m, i, j), x)
                    for j, x in enumerate(row)
                )
                for i, row in enumerate(rows)
            )

        def blocks(letter: str, given: Blocks) -> Blocks:
            return tuple(
                tuple(block(letter, l, m, rows) for m, rows in enumerate(row))
                for l, row in enumerate(given)
            )

        return Rosenbrock(
            blocks("α", method.alpha), blocks("γ", method.gamma), block("b", 0, 0, method.b)
        )

    changed({})
    numbers = tuple(printed.values())

    def make(values: Sequence[Any]) -> Tableau:
        return of(changed(dict(zip(printed, values, strict=True))))

    box = Box(numbers, (tolerance,) * len(numbers), make)
    return RoundedTableau(of(method), tolerance, Recovery(box))


def _sums(block: Matrix) -> Vector:
    return apply(block, PointSpace(block[0]).one)
