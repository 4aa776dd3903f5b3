"""The picture of docs/found.md: the errors of its table over the least error of all transfers.

    python docs/figures/least_error.py [FILE.svg]

writes ``least-error.svg`` beside this file, or FILE; ``make figures`` does the former. It is drawn
for light and dark backgrounds.
"""

from __future__ import annotations

import re
import sys
from pathlib import Path

from garkcli.ntrees.drawing import FONTS
from garkcli.plots.scene import Axis, Curve, Mark, Panel, RuledLine
from garkcli.plots.svg import STYLE, svg

HERE = Path(__file__).resolve().parent
RULES = ("collocation", "interpolation", "symplectic-collocation", "symplectic-interpolation")
GROUND = (
    "svg.plot{background:#fff;color:#1b1b1b;font-family:FONTS}\n"
    "@media screen and (prefers-color-scheme:dark){svg.plot{background:#14171c;color:#e6e6e6}}"
).replace("FONTS", FONTS)


def table() -> dict[str, dict[str, float]]:
    """The errors of each pair whose least error is known, by column."""
    page = (HERE.parent / "found.md").read_text(encoding="utf-8")
    lines = [x.strip("|").split("|") for x in page.splitlines() if x.startswith("| ")]
    names, *rows = [[x.strip(" *ᴾ") for x in line] for line in lines if len(line) == 9]
    found = {}
    for pair, *cells in rows:
        values = zip(names[1:], cells, strict=True)
        found[pair] = {name: float(x) for name, x in values if re.fullmatch(r"\d+\.\d+", x)}
    return {pair: values for pair, values in found.items() if "least" in values}


def short(pair: str) -> str:
    """G2 × L4 for Gauss 2 × Lobatto IIIA 4."""
    return pair.replace("Gauss ", "G").replace("Lobatto IIIA ", "L")


def picture() -> str:
    """The SVG document."""
    rows = table()
    pairs = list(rows)
    shapes: list[Curve | RuledLine] = [RuledLine((-0.5, 1.0), (len(pairs) - 0.5, 1.0))]
    for style, rule in enumerate(RULES):
        places = [n + (style - 1.5) / 8 for n in range(len(rows))]  # none hides another
        both = zip(places, rows.values(), strict=True)
        points = [(at, x[rule] / x["least"]) for at, x in both if rule in x]
        shapes.append(Curve(style, points, rule, has_dots=True, has_line=False))
    panel = Panel(
        "Errors of four rules over the least error",
        "Five pairs; for the three whose second method is accurate enough symplectic collocation is"
        " on the line of the least error.",
        Axis(
            "pair", -0.5, len(pairs) - 0.5, given=[Mark(n, short(x)) for n, x in enumerate(pairs)]
        ),
        Axis.around(
            "error / least error",
            [1.0, *(y for x in shapes if isinstance(x, Curve) for _, y in x.points)],
        ),
        shapes,
    )
    head = '<svg xmlns="http://www.w3.org/2000/svg" width="540" '
    drawn = svg(panel).replace("<svg ", head, 1)
    return drawn.replace("<title>", f"<style>{STYLE}{GROUND}</style>\n<title>", 1) + "\n"


if __name__ == "__main__":
    file = Path(sys.argv[1]) if len(sys.argv) > 1 else HERE / "least-error.svg"
    file.write_text(picture(), encoding="utf-8")
