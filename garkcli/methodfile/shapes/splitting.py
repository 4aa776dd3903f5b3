"""Splitting methods: the maps of two parts in turn."""

from garkcli.methodfile.shapes.layout import ZERO, Layout, Shape, Texts


def _lower(weights: tuple[str, ...], reach: int) -> Texts:
    """Rows of weights up to the diagonal, or before it."""
    stages = range(len(weights))
    rows = []
    for i in stages:
        texts = [weights[j] if j < i + reach else ZERO for j in stages]
        rows.append(tuple(texts))
    return tuple(rows)


def _applied(layout: Layout) -> Layout:
    join = "" if layout.stages < 10 else "_"
    numbers = range(1, layout.stages + 1)
    drifts = tuple(f"a{join}{i}" for i in numbers)
    kicks = tuple(f"b{join}{i}" for i in numbers)
    return Layout(
        "prk", (_lower(drifts, 1), _lower(kicks, 0)), (drifts, kicks)
    )


SHAPE = Shape(
    "splitting",
    "a1 h of the first part, b1 h of the second, and so on",
    _applied,
    True,
)
