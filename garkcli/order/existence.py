"""Proves that a box has a method of some order, by Brouwer's fixed point theorem.

Around the recovered method the conditions of all trees are F = c + G ε + ρ, |ε_k| ≤ 1, |ρ_i| ≤ r_i.
Let the shifts be ε = W η, |η_j| ≤ 1, where rows of W have Σ_j |W_kj| ≤ 1, and M = G W. The map

    T_i(η) = η_i − F_i(W η) / M_ii

is continuous. If |c_i| + Σ_{j≠i} |M_ij| + r_i ≤ |M_ii| for all i, it maps the cube into itself, so
it has a fixed point there, at which F = 0.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from flint import arb, arb_mat, ctx, fmpq

from garkcli import numpy_on_use as np
from garkcli.exact.display import to_float
from garkcli.frozen import Frozen
from garkcli.ntrees.count import counts_upto
from garkcli.order.admissible import admissible_trees, coupling_graph, elementary_weight
from garkcli.order.bounded import bounded_least_squares, exactly, excludes, scaled
from garkcli.order.certificate import required_of
from garkcli.order.rows import FormDefects, joined, of_tree, part
from garkcli.tableau.box import Box, FormTableau

if TYPE_CHECKING:
    from collections.abc import Sequence

    from garkcli.exact.affine import Floats, Forms
    from garkcli.ntrees.tree import Tree
    from garkcli.order.recovering import Recovery
    from garkcli.tableau.tableau import Tableau

SHARE = fmpq(1, 10**6)
"""The part of its radius by which each number moves in the proof."""
FEW = 50
"""Most conditions with which a proof is tried with fewer numbers too: some hold exactly."""
NOTHING = 1e-250
"""Bound on remainders that are zero apart from the rounding of floats."""
MOST_TREES = 2_000
DIGITS = (4, 7, 10, 14)
"""Decimal places of a written proof; the first that suffices is used."""


class Existence(Frozen):
    """A proof of a method near ``shifts``, off by ``widths`` at most, both in units of the radii.
    ``W``, of shape (numbers, trees), says how the numbers move together.
    """

    trees: tuple[Tree, ...]
    shifts: tuple[fmpq, ...]
    widths: tuple[fmpq, ...]
    W: tuple[tuple[fmpq, ...], ...]


class _Around:
    def __init__(self, search: Recovery, order: int, shifts: Sequence[fmpq]) -> None:
        box = search.box
        near = Box(box.numbers, tuple(t * SHARE for t in box.radii), box.make)
        made = search.targets["method"](near.around([x / SHARE for x in shifts]).made)
        # colours share conditions where their weights are the same forms
        self.trees = [u for n in range(1, order + 1) for u in admissible_trees(made, n)]
        # numbers at an end do not move
        self.is_free = np.array([abs(x) <= 1 - SHARE for x in shifts])
        self.open: list[int] = []
        self.is_small = len(self.trees) <= max(len(box.numbers), FEW)
        if not self.is_small:
            return
        defects = FormDefects(FormTableau(made, len(shifts)))
        rows = joined([defects.of(of_tree(u)) for u in self.trees])
        is_open = rows.slopes.any(axis=1) | (rows.remainders > NOTHING)
        self.open = [int(i) for i in np.flatnonzero(is_open)]
        self.rows = part(rows, self.open)
        # conditions that no rounded number is in
        rest = [u for u, x in zip(self.trees, is_open, strict=True) if not x]
        self.is_met = all(_is_met(search.origin.exact("method"), u) for u in rest)


def is_proved_to_exist(search: Recovery, order: int) -> bool:
    """Whether Brouwer's theorem proves that the box has a method of an order; False says nothing.
    Dependent conditions, as with simplifying conditions, have no proof.
    """
    place, box = search.settled, search.box
    tableau = place.exact("method")
    admissible = coupling_graph(tableau)
    if sum(map(sum, counts_upto(admissible, order))) > tableau.size * max(len(box.numbers), FEW):
        return False
    with ctx.workprec(search.bits):
        around = _Around(search, order, place.shifts)
        return around.is_small and around.is_met and has_zero(around.rows, around.is_free)


def prove_existence(search: Recovery, order: int) -> Existence | None:
    """Returns a proof in few digits, which others can check; None if there is none."""
    if not is_proved_to_exist(search, order):
        return None
    with ctx.workprec(search.bits):
        for digits in DIGITS:
            unit = fmpq(1, 10**digits)
            shifts = [_towards_zero(x, SHARE * unit) for x in search.settled.shifts]
            around = _Around(search, order, shifts)
            G = _free(around.rows, around.is_free)
            W = [[_towards_zero(exactly(float(x)), unit) for x in row] for row in _W(G)]
            if _is_proof(around.rows.centres, around.rows.remainders, G, W):
                widths = tuple(SHARE if x else fmpq(0) for x in around.is_free)
                place = {i: k for k, i in enumerate(around.open)}
                all_places = [place.get(i) for i in range(len(around.trees))]
                wide = ([fmpq(0) if k is None else row[k] for k in all_places] for row in W)
                return Existence(
                    tuple(around.trees), tuple(shifts), widths, tuple(map(tuple, wide))
                )
    return None


def _is_met(tableau: Tableau, tree: Tree) -> bool:
    weight = elementary_weight(tableau, tree)
    return isinstance(weight, fmpq) and weight == required_of(tree)


def has_zero(rows: Forms, is_free: np.typing.NDArray[np.bool_]) -> bool:
    G = _free(rows, is_free)
    if not np.linalg.norm(G, axis=1).all():
        return False
    return _is_proof(rows.centres, rows.remainders, G, _W(G))


def _free(rows: Forms, is_free: np.typing.NDArray[np.bool_]) -> Floats:
    return np.where(is_free, rows.slopes, 0.0)


def _W(G: Floats) -> Floats:  # noqa: N802 -- the letter of the proof
    """A scaled pseudo-inverse W of G, so that G W is nearly diagonal."""
    if not len(G):
        return np.zeros(G.shape[::-1])
    W: Floats = np.linalg.pinv(G / np.linalg.norm(G, axis=1)[:, None], rcond=1e-12)
    W /= np.abs(W).sum(axis=1).max() * (1 + 1e-12)
    return W


def _is_proof(centres: Sequence[arb], remainders: Floats, G: Floats, W: Any) -> bool:
    if not centres:
        return True
    exact = arb_mat([[_ball(x) for x in row] for row in W])
    if not all(sum((abs(x) for x in row), arb(0)) <= 1 for row in exact.tolist()):
        return False
    image = (arb_mat([[arb(float(x)) for x in row] for row in G]) * exact).tolist()
    for i, (centre, remainder) in enumerate(zip(centres, remainders, strict=True)):
        rest = sum((abs(x) for j, x in enumerate(image[i]) if j != i), arb(0))
        if not abs(centre) + arb(float(remainder)) + rest <= abs(image[i][i]):
            return False
    return True


def _ball(x: Any) -> arb:
    return arb(x) if isinstance(x, fmpq) else arb(float(x))


def _towards_zero(x: fmpq, unit: fmpq) -> fmpq:
    size = unit * (abs(x) / unit).floor()
    return size if x > 0 else -size


def exclusion(search: Recovery, order: int) -> tuple[tuple[Tree, fmpq], ...] | None:
    """Returns trees with factors of b·ψ(u) − 1/ρ(u) whose sum is not 0 in the box, or None."""
    place = search.origin
    tableau = place.exact("method")
    admissible = coupling_graph(tableau)
    if sum(map(sum, counts_upto(admissible, order))) > MOST_TREES:
        return None
    with ctx.workprec(search.bits):
        defects = place.defects("method")
        made = defects.tableau.made
        trees = [u for n in range(1, order + 1) for u in admissible_trees(made, n)]
        rows = joined([defects.of(of_tree(u)) for u in trees])
        c, G, scale = scaled(rows)
        y = (c + G @ bounded_least_squares(G, c)) / scale
        for digits in DIGITS:
            unit = fmpq(1, 10**digits)
            largest = np.abs(y).max()
            factors = [_towards_zero(exactly(float(x / largest)), unit) for x in y]
            if excludes(rows, np.array([to_float(x) for x in factors])):
                # rows are these factors times the conditions of normalised stage vectors
                found = zip(trees, factors, strict=True)
                return tuple((u, x * u.kind.integrated(u.order)) for u, x in found if x)
    return None
