"""Every entry unknown."""

from garkcli.methodfile.shapes.layout import Layout, Shape


def _applied(layout: Layout) -> Layout:
    return layout


SHAPE = Shape("full", "every entry unknown", _applied)
