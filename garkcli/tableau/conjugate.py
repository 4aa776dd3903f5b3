"""The symplectic conjugate, eq. (wAhat), and symplecticity, in any stage space.

Â^{l,m} = (𝟙 − (B^l)⁻¹ (A^{m,l})ᵀ) B^m,      here   Â^{l,m} f = b_m(f)·𝟙 − (A^{m,l})* f.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import chain

from garkcli.errors import ZeroWeight
from garkcli.exact import matrix
from garkcli.exact.field import ONE, Number
from garkcli.frozen import replace
from garkcli.reason import Reason
from garkcli.tableau.stages import StageSpace
from garkcli.tableau.tableau import Colour, Edge, Tableau


def conjugate_block(
    block: matrix.Matrix,
    here: StageSpace,
    b: matrix.Vector,
    other: StageSpace,
    b_other: matrix.Vector,
) -> matrix.Matrix:
    """Returns Â^{l,m}, shape (s_l, s_m), from ``block`` A^{m,l}; ZeroWeight for a zero in b^{l}."""
    try:
        adjoint = other.adjoint(block, b_other, here, b)
    except matrix.SingularMatrixError:
        raise ZeroWeight(
            Reason("the symplectic conjugate divides by the weights b, {}", here.zero_weights(b)),
            "a conjugate exists for nonzero weights only",
        ) from None
    return matrix.subtract(matrix.outer(here.one, b_other), adjoint)


def conjugate(tableau: Tableau) -> Tableau:
    """Returns (Â^{l,m}, b, c), of which ``tableau`` is the conjugate again.

    For a partitioned one, (A, Â), momentum blocks come from position blocks and vice versa. Raises
    ZeroWeight, or MethodError for no GARK method.
    """
    tableau.demand_fields("the symplectic conjugate")
    if tableau.is_partitioned:
        exchanged: dict[
            Edge, matrix.Matrix
        ] = {}  # blocks of positions from those of momenta, and back
        for m, l in tableau.edges():
            here = tableau.colours[l]
            if are_opposite(here, tableau.colours[m]):
                exchanged[here.space, m] = conjugate_of(tableau, l, m)
        return replace(tableau, blocks=exchanged)
    spaces = []
    colours = []
    for l, colour in enumerate(tableau.colours):
        spaces.append(tableau.space(l))
        colours.append(replace(colour, space=l))
    blocks: dict[Edge, matrix.Matrix] = {
        (l, m): conjugate_of(tableau, l, m) for m, l in tableau.edges()
    }
    return Tableau(tuple(spaces), tuple(colours), blocks)


def conjugate_of(tableau: Tableau, l: int, m: int) -> matrix.Matrix:
    block = tableau.block(m, l)
    if block is None:
        raise KeyError((l, m))
    here = tableau.colours[l]
    other = tableau.colours[m]
    space = tableau.space(l)
    other_space = tableau.space(m)
    try:
        return conjugate_block(block, space, here.b, other_space, other.b)
    except ZeroWeight as error:
        if tableau.size == 1:
            raise
        raise ZeroWeight(Reason("colour {}: {}", here.name, error.reason), error.help) from None


def are_opposite(one: Colour, other: Colour) -> bool:
    """Whether the symplectic form pairs the parts that two vector fields drive."""
    return {one.part, other.part} in ({"q", "p"}, {"y"})


def symplectic_defects(tableau: Tableau) -> Iterator[Number]:
    """Yields numbers that vanish if the tableau is symplectic; 1 for a block without opposite."""
    for l, one in enumerate(tableau.colours):
        for m, other in enumerate(tableau.colours):
            if one.space == other.space and {one.part, other.part} == {"q", "p"}:
                yield from (x - y for x, y in zip(one.b, other.b, strict=True))
            if not are_opposite(one, other):
                continue
            if (tableau.block(l, m) is None) != (tableau.block(m, l) is None):
                yield ONE
            elif tableau.block(l, m) is not None:
                yield from chain.from_iterable(symplectic_defect(tableau, l, m))


def symplectic_defect(tableau: Tableau, l: int, m: int) -> matrix.Matrix:
    """B^l A^{l,m} + (A^{m,l})ᵀ B^m − b_l b_mᵀ as a bilinear form."""
    forth = tableau.block(l, m)
    back = tableau.block(m, l)
    if forth is None or back is None:
        raise KeyError((l, m))
    b_l = tableau.colours[l].b
    b_m = tableau.colours[m].b
    both = matrix.add(
        tableau.space(l).form(b_l, forth), matrix.transpose(tableau.space(m).form(b_m, back))
    )
    return matrix.subtract(both, matrix.outer(b_l, b_m))
