"""Diagonally implicit methods."""

from garkcli.methodfile.shapes.layout import ZERO, Layout, Shape


def _entry(i: int, j: int, text: str) -> str:
    return text if j <= i else ZERO


def _applied(layout: Layout) -> Layout:
    return layout.with_entries(_entry)


SHAPE = Shape("dirk", "zero above the diagonal", _applied)
