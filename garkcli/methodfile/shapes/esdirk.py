"""Singly diagonally implicit methods with an explicit first stage."""

from garkcli.methodfile.shapes.layout import ZERO, Layout, Shape


def _entry(i: int, j: int, text: str) -> str:
    if i == 0 or j > i:
        return ZERO
    return "gamma" if i == j else text


def _applied(layout: Layout) -> Layout:
    return layout.with_entries(_entry)


SHAPE = Shape("esdirk", "sdirk with a first row of zeros", _applied)
