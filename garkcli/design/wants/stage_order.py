"""The simplifying assumptions B(q) and C(q)."""

from typing import cast

from garkcli.design.wants.want import Asked, Meaning, Want
from garkcli.order.defects import Defects


def _meaning(asked: Asked) -> Meaning:
    """Σ_i b_i^l (c_i^l)^{k−1} = 1/k, Σ_j a_ij^{l,m} (c_j^m)^{k−1} = (c_i^l)^k / k for k = 1, …, q.

    With s stages C(s + 1) is C(q) for every q > s. Let M have the d ≤ s nodes of a colour as its
    simple zeros: by C(d + 1) of the colour's own block ∫_0^x M vanishes at each node, as M does.
    Double zeros are too many for the degree d + 1, but d = 1 and the node 0; then those of all
    colours are, and C(k) reads 0 = 0 for k > 1. B(2s + 1) has no solution: Hilbert's matrix has an
    inverse, and its entries would be sums of s powers.
    """
    tableau = asked.tableau
    stages = max(len(tableau.colours[l].c) for l in asked.colours)
    wanted = cast("int", asked.value)
    highest = min(wanted, stages + 1)
    defects = Defects(tableau)
    zeros: list[object] = []
    for l in asked.colours:
        for k in range(1, min(wanted, 2 * stages + 1) + 1):
            zeros += defects.B(l, k)
        asked.diagonal(l, "stage-order")
        for m in asked.colours:
            asked.block(l, m, "stage-order")
            for k in range(1, highest + 1):
                zeros += defects.C(l, m, k)
    return Meaning(tuple(zeros))


WANT = Want("stage-order", "count", "B(q) and C(q)", _meaning)
