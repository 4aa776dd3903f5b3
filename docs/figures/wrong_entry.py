"""The picture of the README: a tableau with one wrong entry, beside the tree whose condition fails.

    python docs/figures/wrong_entry.py [FILE.svg]

writes ``wrong-entry.svg`` beside this file, or FILE; ``make figures`` does the former. Entry, tree
and numbers are what gark finds.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator
from pathlib import Path

from garkcli import find_order, loads
from garkcli.ntrees.drawing import FONTS, layout
from garkcli.ntrees.notation import format_tree
from garkcli.order.blame import MissedOrder, blame_of
from garkcli.order.repair import Repair

HERE = Path(__file__).resolve().parent
RK4 = """
A: [[0, 0, 0, 0], [1/2, 0, 0, 0], [0, 1/3, 0, 0], [0, 0, 1, 0]]
b: [1/6, 1/3, 1/3, 1/6]
c: [0, 1/2, 1/2, 1]
"""
CELL, ROW, LEFT, TOP = 62, 34, 76, 52
RED, INK, PALE = "#b00020", "#1b1b1b", "#fde7ea"


def text(x: float, y: float, words: str, more: str = "") -> str:
    return f'<text x="{x:.0f}" y="{y:.0f}" {more}>{words}</text>'


def tableau(repair: Repair, method: object) -> Iterator[str]:
    """Nodes, matrix and weights; the wrong entry in red, with what it should be."""
    colour = method.colours[0]  # type: ignore[attr-defined]
    rows = [[*map(str, row)] for row in method.blocks[0, 0]]  # type: ignore[attr-defined]
    for i, row in enumerate(rows):
        y = TOP + ROW * i
        for j, entry in enumerate(row[:i]):
            x = LEFT + CELL * (j + 0.5)
            if (i, j) == (repair.i, repair.j):
                yield (
                    f'<rect x="{x - 27:.0f}" y="{y - 22:.0f}" width="54" height="30" rx="6" '
                    f'fill="{PALE}" stroke="{RED}" stroke-width="2"/>'
                )
                yield text(x, y, entry, f'fill="{RED}" font-weight="bold"')
            else:
                yield text(x, y, entry)
    bottom = TOP + ROW * len(rows)
    ruled = LEFT + CELL * len(rows)
    rules = f"M{LEFT - 8} {TOP - 26}V{bottom + 10}M24 {bottom - 22}H{ruled}"
    yield f'<path d="{rules}" stroke="{INK}"/>'
    for i, node in enumerate(colour.c):
        yield text(LEFT - 32, TOP + ROW * i, str(node))
    for j, weight in enumerate(colour.b):
        yield text(LEFT + CELL * (j + 0.5), bottom + 2, str(weight))


def picture() -> str:
    """The SVG document."""
    method = loads(RK4).tableau
    found = find_order(method)
    missed = MissedOrder(order=found.order + 1, claimed=4)
    blame = blame_of(method, missed)
    assert blame is not None
    (repair,) = blame.repairs
    assert find_order(repair.carried_out(method)).order == 4
    failing = found.witness
    assert failing is not None
    tree = failing.tree
    right = 470
    lines = [
        '<svg xmlns="http://www.w3.org/2000/svg" width="720" height="270" viewBox="0 0 720 270" '
        f'font-family="{FONTS}" font-size="18" text-anchor="middle" fill="{INK}">',
        '<rect width="100%" height="100%" rx="10" fill="#ffffff"/>',
        *tableau(repair, method),
    ]
    places = layout(tree)
    points = [(right + 60 * v.x, 150 - 60 * v.y) for v in places]
    for v, (x, y) in zip(places, points, strict=True):
        if v.parent >= 0:
            a, b = points[v.parent]
            lines.append(f'<path d="M{x} {y}L{a} {b}" stroke="{RED}" stroke-width="4"/>')
    lines += [f'<circle cx="{x}" cy="{y}" r="11" fill="{RED}"/>' for x, y in points]
    name = format_tree(tree, False)
    start = 'text-anchor="start"'
    lines += [
        text(right + 40, 80, f"this tree fails: {name}", f'{start} fill="{RED}"'),
        text(right + 40, 108, f"Σ bᵢaᵢⱼ = {failing.value}", start),
        text(right + 40, 134, f"it should be {failing.required}", start),
        text(
            360,
            246,
            f"order {found.order}, proved: with {repair.new} in place of {repair.old} it is 4",
            'font-weight="bold"',
        ),
        "</svg>",
        "",
    ]
    return "\n".join(lines)


if __name__ == "__main__":
    place = Path(sys.argv[1]) if sys.argv[1:] else HERE / "wrong-entry.svg"
    place.write_text(picture(), encoding="utf-8")
