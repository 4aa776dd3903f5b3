"""Singly diagonally implicit methods."""

from garkcli.methodfile.shapes.layout import ZERO, Layout, Shape


def _entry(i: int, j: int, text: str) -> str:
    if j > i:
        return ZERO
    return "gamma" if i == j else text


def _applied(layout: Layout) -> Layout:
    return layout.with_entries(_entry)


SHAPE = Shape("sdirk", "zero above the diagonal, gamma on it", _applied)
