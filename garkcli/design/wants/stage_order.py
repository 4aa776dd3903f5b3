"""The simplifying assumptions C(q)."""

from typing import cast

from flint import fmpq

from garkcli.design.wants.want import ZERO, Asked, Meaning, Want


def _meaning(asked: Asked) -> Meaning:
    """Σ_j a_ij^{l,m} (c_j^m)^{k−1} = (c_i^l)^k / k for k = 1, …, q, all blocks."""
    tableau = asked.tableau
    zeros = []
    for l in asked.colours:
        asked.diagonal(l, "stage-order")
        for m in asked.colours:
            block = asked.block(l, m, "stage-order")
            c, c_m = tableau.colours[l].c, tableau.colours[m].c
            for k in range(1, cast("int", asked.value) + 1):
                for row, node in zip(block, c, strict=True):
                    terms = (
                        a * x ** (k - 1) for a, x in zip(row, c_m, strict=True)
                    )
                    zeros.append(sum(terms, start=ZERO) - node**k / fmpq(k))
    return Meaning(tuple(zeros))


WANT = Want("stage-order", "count", "C(q): stages have that order", _meaning)
