"""Splitting methods: the maps of two parts in turn."""

from garkcli.methodfile.shapes.layout import ZERO, Layout, Shape, TextRow, Texts


def _lower(weights: tuple[str, ...], reach: int) -> Texts:
    """Rows of weights up to the diagonal, or before it."""
    stages = range(len(weights))
    rows: list[TextRow] = []
    for i in stages:
        end = i + reach
        zeros = (ZERO,) * (len(weights) - end)
        rows.append((*weights[:end], *zeros))
    return tuple(rows)


def _applied(layout: Layout) -> Layout:
    join = "" if layout.stages < 10 else "_"
    numbers = range(1, layout.stages + 1)
    drifts = tuple(f"a{join}{i}" for i in numbers)
    kicks = tuple(f"b{join}{i}" for i in numbers)
    A = _lower(drifts, 1), _lower(kicks, 0)
    return Layout("prk", A, (drifts, kicks))


SHAPE = Shape("splitting", "a1 h of the first part, b1 h of the second, and so on", _applied, True)
