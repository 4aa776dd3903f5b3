"""Implicit-explicit methods: an explicit and an ESDIRK matrix on the same stages."""

from garkcli.methodfile.shapes import esdirk, explicit
from garkcli.methodfile.shapes.layout import Layout, Shape


def _applied(layout: Layout) -> Layout:
    """Explicit entries are called e_ij; the nodes and the weights are shared."""
    implicit = esdirk.SHAPE.applied(layout)
    rows = explicit.SHAPE.applied(layout).A[0]
    named = [tuple(f"e{text[1:]}" if text != "0" else text for text in row) for row in rows]
    # the nodes of the implicit part are those of the explicit one: e_i1 = c_i − the others
    return Layout("ark", (tuple(named), implicit.A[0]), layout.b)


SHAPE = Shape(
    "imex", "an explicit and an esdirk part with the same nodes and weights", _applied, True
)
