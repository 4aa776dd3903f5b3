"""Methods whose last stage is the new value."""

from garkcli.methodfile.shapes.layout import ZERO, Layout, Shape, refuse_shape


def _applied(layout: Layout) -> Layout:
    if layout.kind == "prk":
        raise refuse_shape("a partitioned shape is not stiffly accurate", "leave one of them out")
    last = layout.A[-1][-1]
    if last[-1] == ZERO:
        raise refuse_shape(
            "no explicit shape is stiffly accurate: its last weight would be zero",
            "take dirk, sdirk, esdirk or full before it",
        )
    bottom = layout.stages - 1
    # names of weights stay; what the shapes before it fixed in the last row fixes weights
    weights = []
    for a, b in zip(last, layout.b[0], strict=True):
        weights.append(b if a.startswith("a") else a)

    def entry(i: int, j: int, text: str) -> str:
        return weights[j] if i == bottom else text

    return layout.with_entries(entry).with_weights(weights)


SHAPE = Shape("stiffly-accurate", "the last row of A is b", _applied)
