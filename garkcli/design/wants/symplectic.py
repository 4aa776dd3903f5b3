"""Symplectic methods."""

from garkcli.design.wants.want import Asked, Meaning, Want
from garkcli.errors import MethodError


def _meaning(asked: Asked) -> Meaning:
    """b_i^l a_ij^{l,m} + b_j^m a_ji^{m,l} − b_i^l b_j^m = 0."""
    tableau = asked.tableau
    zeros = []
    if tableau.is_partitioned:
        raise MethodError("design: symplectic is for methods without parts", "ask for the pair")
    for l in asked.colours:
        for m in asked.colours:
            b, b_m = tableau.colours[l].b, tableau.colours[m].b
            asked.diagonal(l, "symplectic")
            A, other = (asked.block(l, m, "symplectic"), asked.block(m, l, "symplectic"))
            for i, u in enumerate(b):
                for j, v in enumerate(b_m):
                    zeros.append(u * A[i][j] + v * other[j][i] - u * v)
    return Meaning(tuple(zeros))


WANT = Want("symplectic", "flag", "the method is symplectic", _meaning)
"""J. M. Sanz-Serna, BIT 28, 1988; for several colours A. Sandu, M. Günther, SINUM 53, 2015."""
