"""The simplifying assumptions B(q) and C(q)."""

from typing import cast

from flint import fmpq

from garkcli.design.wants.want import ZERO, Asked, Meaning, Want


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
    zeros = []
    for l in asked.colours:
        b, c = tableau.colours[l].b, tableau.colours[l].c
        for k in range(1, min(wanted, 2 * stages + 1) + 1):
            moment = sum((w * x ** (k - 1) for w, x in zip(b, c, strict=True)), start=ZERO)
            zeros.append(moment - fmpq(1, k))
        asked.diagonal(l, "stage-order")
        for m in asked.colours:
            block = asked.block(l, m, "stage-order")
            c_m = tableau.colours[m].c
            for k in range(1, highest + 1):
                for row, node in zip(block, c, strict=True):
                    terms = (a * x ** (k - 1) for a, x in zip(row, c_m, strict=True))
                    zeros.append(sum(terms, start=ZERO) - node**k / fmpq(k))
    return Meaning(tuple(zeros))


WANT = Want("stage-order", "count", "B(q) and C(q)", _meaning)
