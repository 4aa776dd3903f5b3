"""The eigenvalues of A⁻¹ and the real matrix T with which T⁻¹ A⁻¹ T is block diagonal.

Newton's method for the stages of an implicit method then solves one real system for each real
eigenvalue γ and one complex system for each pair α ± iβ, whose block is [[α, −β], [β, α]].

E. Hairer, G. Wanner, *Solving Ordinary Differential Equations II*, IV.8. Columns of T are as in
their programs RADAU5 and RADAU: a column of a real eigenvalue has length 1 and a positive last
entry; the columns u and v of a pair, where u + iv belongs to α − iβ with β > 0, end in 1 and 0.
"""

from __future__ import annotations

from collections.abc import Sequence

from flint import acb, acb_mat, arb, arb_mat, ctx

from garkcli.errors import MethodError
from garkcli.exact.display import BITS_OF_A_DIGIT, to_ball
from garkcli.frozen import Frozen, replace
from garkcli.tableau.pointwise import Cell, numeric_entries
from garkcli.tableau.tableau import Tableau

MOST_STAGES = 50


class Transformation(Frozen):
    """A real block-diagonal form of A⁻¹.

    Attributes:
        real: the real eigenvalues γ, ascending.
        pairs: α and β > 0 of each pair α ± iβ, by ascending α.
        T: row by row; the columns of real eigenvalues come first.
    """

    real: tuple[arb, ...]
    pairs: tuple[tuple[arb, arb], ...]
    T: tuple[tuple[arb, ...], ...]
    inverse: tuple[tuple[arb, ...], ...]
    digits: int = 0


def transformation(tableau: Tableau, digits: int = 17) -> Transformation:
    """Returns balls of width below 10^(−digits) for a method of one colour. Raises MethodError for
    singular A, a multiple eigenvalue, several colours or too many stages.
    """
    stages = tableau.spaces[0].stages
    if tableau.size > 1 or tableau.block(0, 0) is None:
        message = "the transformation is for a method of one colour"
        raise MethodError(message, "leave --transformation out", code="cannot-construct")
    if stages > MOST_STAGES:
        message = f"the transformation of {stages} stages (limit {MOST_STAGES})"
        raise MethodError(message, "take fewer stages", code="too-many")
    bits = int(digits * BITS_OF_A_DIGIT) + 64 + 8 * stages
    for precision in (bits, 2 * bits, 4 * bits):
        block = numeric_entries(tableau, int(precision / BITS_OF_A_DIGIT)).A[0][0]
        with ctx.workprec(precision):
            result = _of_matrix(arb_mat([[_as_ball(x) for x in row] for row in block or ()]))
        if result is not None and _is_fine(result, digits):
            return replace(result, digits=digits)
    message = "A has no inverse, or a double eigenvalue, so no such transformation is found"
    raise MethodError(message, "leave --transformation out", code="cannot-construct")


def _of_matrix(A: arb_mat) -> Transformation | None:
    """Returns the form at the current precision; None if it does not exist, or was not found."""
    try:
        values, vectors = acb_mat(A.inv()).eig(right=True)
    except (ZeroDivisionError, ValueError):
        return None
    s = len(values)
    real: list[tuple[arb, list[arb]]] = []
    pairs: list[tuple[arb, arb, list[arb], list[arb]]] = []
    for k, value in enumerate(values):
        column = [vectors[i, k] for i in range(s)]
        conjugates = [j for j, x in enumerate(values) if x.overlaps(value.conjugate())]
        if conjugates == [k]:
            real.append((value.real, _of_length_one(column)))
        elif value.imag < 0:
            scaled = [*(x / column[-1] for x in column[:-1]), acb(1)]
            u, v = [x.real for x in scaled], [x.imag for x in scaled]
            pairs.append((value.real, -value.imag, u, v))
    if len(real) + 2 * len(pairs) != s:
        return None
    real.sort(key=lambda x: float(x[0].mid()))
    pairs.sort(key=lambda x: float(x[0].mid()))
    columns = [x for _, x in real]
    for _, _, u, v in pairs:
        columns += [u, v]
    T = arb_mat([[*row] for row in zip(*columns, strict=True)])
    try:
        inverse = T.inv()
    except ZeroDivisionError:
        return None
    return Transformation(
        tuple(x for x, _ in real),
        tuple((a, b) for a, b, _, _ in pairs),
        tuple(map(tuple, T.tolist())),
        tuple(map(tuple, inverse.tolist())),
    )


def _as_ball(x: Cell) -> arb:
    return x if isinstance(x, arb) else to_ball(x, int(ctx.prec / BITS_OF_A_DIGIT))


def _of_length_one(column: Sequence[acb]) -> list[arb]:
    """The real multiple of length 1 whose last entry is positive."""
    real = [(x / column[-1]).real for x in column]
    length = sum((x * x for x in real), arb(0)).sqrt()
    return [x / length for x in real]


def _is_fine(result: Transformation, digits: int) -> bool:
    bound = arb(10) ** -digits
    numbers = [*result.real, *(x for pair in result.pairs for x in pair)]
    numbers += [x for row in (*result.T, *result.inverse) for x in row]
    return all(x.rad() < bound for x in numbers)
