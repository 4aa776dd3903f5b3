"""The simplifying assumptions C(q)."""

from typing import cast

from flint import fmpq

from garkcli.design.wants.want import ZERO, Asked, Meaning, Want


def _meaning(asked: Asked) -> Meaning:
    """Σ_j a_ij^{l,m} (c_j^m)^{k−1} = (c_i^l)^k / k for k = 1, …, q, all blocks.

    With s stages C(s + 1) is C(q) for every q > s. Let M have the d ≤ s nodes of a colour as its
    simple zeros: by C(d + 1) of the colour's own block ∫_0^x M vanishes at each node, as M does.
    Double zeros are too many for the degree d + 1, but d = 1 and the node 0; then those of all
    colours are, and C(k) reads 0 = 0 for k > 1.
    """
    tableau = asked.tableau
    stages = max(len(tableau.colours[l].c) for l in asked.colours)
    highest = min(cast("int", asked.value), stages + 1)
    zeros = []
    for l in asked.colours:
        asked.diagonal(l, "stage-order")
        for m in asked.colours:
            block = asked.block(l, m, "stage-order")
            c, c_m = tableau.colours[l].c, tableau.colours[m].c
            for k in range(1, highest + 1):
                for row, node in zip(block, c, strict=True):
                    terms = (a * x ** (k - 1) for a, x in zip(row, c_m, strict=True))
                    zeros.append(sum(terms, start=ZERO) - node**k / fmpq(k))
    return Meaning(tuple(zeros))


WANT = Want("stage-order", "count", "C(q): stages have that order", _meaning)
