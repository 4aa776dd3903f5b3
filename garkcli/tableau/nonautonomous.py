"""Problems ẏ = f(t, y): the order of a method with its nodes as they are printed.

With ṫ = 1 the problem is autonomous, and time is one more colour. A method evaluates f at
t + c_i h, so the block of that colour is c, whatever the row sums of A are; its vector field is
constant, so its vertices have no branches: its stages see no colour. Where A^{l,m} 𝟙 = c^{l} for
every block a vertex of time has the same weight as any other leaf, and nothing changes.
"""

from __future__ import annotations

from garkcli.exact.field import ONE, ZERO
from garkcli.exact.matrix import Matrix, Vector
from garkcli.tableau.point_space import PointSpace
from garkcli.tableau.tableau import Colour, Tableau

TIME = "t"
"""The name of the colour of time."""


def with_time(tableau: Tableau) -> Tableau | None:
    """The tableau with time as its last colour.

    Returns:
        None where it has no meaning: a vector field that is linear has no time in it, and colours
        that share stages need the same nodes.

    >>> from flint import fmpq
    >>> from garkcli.tableau.forms import gark
    >>> from garkcli.tableau.method import butcher
    >>> from garkcli.order.certificate import find_order
    >>> midpoint = gark([butcher(((fmpq(1, 2),),), (fmpq(1),), (fmpq(0),))], {})
    >>> find_order(midpoint).order, find_order(with_time(midpoint)).order
    (2, 1)
    """
    nodes: dict[int, Vector] = {}
    for colour in tableau.colours:
        first = nodes.setdefault(colour.space, colour.c)
        if colour.is_linear or first != colour.c:
            return None
    space = len(tableau.spaces)
    time = tableau.size
    blocks = dict(tableau.blocks)
    for k, c in nodes.items():
        column: Matrix = tuple((c_i,) for c_i in c)
        blocks[k, time] = column
    clock = Colour(TIME, space, (ONE,), (ZERO,), term=time)
    spaces = (*tableau.spaces, PointSpace((ZERO,)))
    return Tableau(spaces, (*tableau.colours, clock), blocks)
