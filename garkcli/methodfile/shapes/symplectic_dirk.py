"""Symplectic diagonally implicit methods: compositions of implicit midpoint rules."""

from garkcli.methodfile.shapes.layout import ZERO, Layout, Shape


def _applied(layout: Layout) -> Layout:
    weights = layout.b[0]

    def entry(i: int, j: int, _: str) -> str:
        if j > i:
            return ZERO
        return f"{weights[j]}/2" if i == j else weights[j]

    return layout.with_entries(entry)


SHAPE = Shape(
    "symplectic-dirk",
    "a_ij = b_j below the diagonal, b_i/2 on it: midpoint rules with steps b_i h",
    _applied,
)
"""J. M. Sanz-Serna, L. Abia, *Order conditions for canonical Runge-Kutta schemes*, 1991."""
