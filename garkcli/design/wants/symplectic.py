"""Symplectic methods."""

from itertools import chain

from garkcli.design.wants.want import Asked, Meaning, Want
from garkcli.errors import MethodError
from garkcli.tableau.conjugate import symplectic_defect


def _meaning(asked: Asked) -> Meaning:
    """b_i^l a_ij^{l,m} + b_j^m a_ji^{m,l} − b_i^l b_j^m = 0."""
    tableau = asked.tableau
    zeros: list[object] = []
    if tableau.is_partitioned:
        raise MethodError("design: symplectic is for methods without parts", "ask for the pair")
    for l in asked.colours:
        for m in asked.colours:
            asked.diagonal(l, "symplectic")
            asked.block(l, m, "symplectic")
            asked.block(m, l, "symplectic")
            zeros += chain.from_iterable(symplectic_defect(tableau, l, m))
    return Meaning(tuple(zeros))


WANT = Want("symplectic", "flag", "the method is symplectic", _meaning)
"""J. M. Sanz-Serna, BIT 28, 1988; for several colours A. Sandu, M. Günther, SINUM 53, 2015."""
