"""A proof that a method of some order is in a box, by L. E. J. Brouwer's fixed point theorem.

Around the recovered method the conditions of all trees are F = c + G ε + ρ, |ε_k| ≤ 1, |ρ_i| ≤ r_i.
Let the shifts be ε = W η, |η_j| ≤ 1, and S a diagonal matrix with positive entries. The map

    T(η) = η − S⁻¹ F(W η) = −S⁻¹ c + (I − S⁻¹ G W) η − S⁻¹ ρ

is continuous. Where |c_i|/S_i + Σ_j |I − S⁻¹ G W|_ij + r_i/S_i ≤ 1 for all i it maps the cube into
itself, so it has a fixed point there, at which F = 0.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from flint import arb, arb_mat, ctx, fmpq

from garkcli.ntrees.count import Admissible, counts_upto
from garkcli.order.conditions import admissible_trees, coupling_graph
from garkcli.order.rows import FormDefects, joined, of_tree
from garkcli.tableau.box import Box, FormTableau

if TYPE_CHECKING:
    from garkcli.exact.affine import Forms
    from garkcli.order.recovering import Recovery

SHARE = fmpq(1, 1 << 20)
"""The part of its radius by which each number moves in the proof."""


def is_proved_to_exist(search: Recovery, order: int) -> bool:
    """Whether a method of the box is proved to meet the conditions of all trees up to an order;
    False says nothing.

    Where conditions depend on each other, as where simplifying conditions hold, there is no proof.
    """
    place, box = search.settled, search.box
    tableau = place.exact("method")
    admissible = Admissible.of(tableau.size, *coupling_graph(tableau))
    if sum(map(sum, counts_upto(admissible, order))) > tableau.size * len(box.numbers):
        return False
    near = Box(box.numbers, tuple(t * SHARE for t in box.radii), box.make)
    shifts = [x / SHARE for x in place.shifts]
    with ctx.workprec(search.bits):
        made = search.targets["method"](near.around(shifts).made)
        # colours share conditions where their weights are the same forms
        trees = [u for n in range(1, order + 1) for u in admissible_trees(made, n)]
        if len(trees) > len(box.numbers):
            return False
        defects = FormDefects(FormTableau(made, len(shifts)))
        rows = joined([defects.of(of_tree(u)) for u in trees])
        # numbers at an end do not move
        most = 1 - SHARE * (1 + SHARE)
        return has_zero(rows, np.array([abs(x) <= most for x in place.shifts]))


def has_zero(rows: Forms, is_free: np.typing.NDArray[np.bool_]) -> bool:
    """Whether all forms are zero somewhere, as far as some of the numbers alone move."""
    G = np.where(is_free, rows.slopes, 0.0)
    norms = np.linalg.norm(G, axis=1)
    if not norms.all():
        return False
    W = np.linalg.pinv(G / norms[:, None], rcond=1e-12)
    most = np.abs(W).sum(axis=1).max() * (1 + 1e-12)
    W, S = W / most, norms / most  # S⁻¹ G W is nearly I
    exact = arb_mat([[arb(float(x)) for x in row] for row in W])
    if not all(sum((abs(x) for x in row), arb(0)) <= 1 for row in exact.tolist()):
        return False
    image = (arb_mat([[arb(float(x)) for x in row] for row in G]) * exact).tolist()
    for i, (centre, remainder, scale) in enumerate(
        zip(rows.centres, rows.remainders, map(float, S), strict=True)
    ):
        rest = [abs(int(i == j) - x / scale) for j, x in enumerate(image[i])]
        if not sum(rest, (abs(centre) + float(remainder)) / scale) <= 1:
            return False
    return True
