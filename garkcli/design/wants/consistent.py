"""Methods whose nodes are the row sums of every block."""

from garkcli.design.wants.want import Asked, Meaning, Want
from garkcli.order.defects import Defects


def _meaning(asked: Asked) -> Meaning:
    """A^{l,m} 𝟙 = c^l for every block of the colours l."""
    defects = Defects(asked.tableau)
    edges = [(l, m) for l, m in asked.tableau.edges() if l in asked.colours]
    return Meaning(tuple(x for l, m in edges for x in defects.C(l, m, 1)))


WANT = Want("consistent", "flag", "the nodes are the row sums of every block", _meaning)
"""A. Sandu, M. Günther, *A generalized-structure approach to additive Runge–Kutta methods*, SINUM
53, 2015.
"""
