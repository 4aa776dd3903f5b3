"""Pictures of trees, the root at the bottom as Butcher draws them: terminal text, TikZ, SVG."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple, TypeAlias

from garkcli.errors import counted
from garkcli.ntrees.notation import written_order
from garkcli.ntrees.tree import Tree

PALETTE = (
    ("#0072b2", "#ffffff"),
    ("#e69f00", "#000000"),
    ("#009e73", "#000000"),
    ("#cc79a7", "#000000"),
    ("#56b4e9", "#000000"),
    ("#d55e00", "#000000"),
    ("#f0e442", "#000000"),
    ("#444444", "#ffffff"),
)
"""Fills and the ink legible on them, distinguishable with every kind of colour vision.

Source: Okabe and Ito, *Color Universal Design* (2008).
"""

DOT = "●"
_WITH_ROOT = {"─": "┬", "┴": "┼", "╰": "├"}
"""The signs of a fork with the root below them."""


class Vertex(NamedTuple):
    """A placed vertex: ``x`` in leaf widths from the left, ``y`` the distance from the root."""

    x: float
    y: int
    colour: int
    parent: int


Lines: TypeAlias = "Sequence[str]"


def layout(tree: Tree) -> list[Vertex]:
    """Places every vertex, the root first, parents before branches; the root has parent -1.

    Leaves are one unit apart; a vertex is halfway between its first and last branches.
    """
    placed: list[Vertex] = []
    leaves = 0

    def place(u: Tree, y: int, parent: int) -> float:
        nonlocal leaves
        here = len(placed)
        placed.append(Vertex(0, y, u.root, parent))
        above = y + 1
        columns = [place(branch, above, here) for branch in written_order(u)]
        # a leaf takes the next place; a vertex with branches the middle of theirs
        if columns:
            x = (columns[0] + columns[-1]) / 2
        else:
            x = float(leaves)
            leaves += 1
        placed[here] = Vertex(x, y, u.root, parent)
        return x

    place(tree, 0, -1)
    return placed


def draw_text(tree: Tree, colours: bool = True, width: int = 80) -> list[str]:
    """Lines from top to bottom: a chain is one line, another tree upright if ``width`` allows, or
    lying.
    """
    for lines in (_chain(tree, colours), _upright(tree, colours)[0]):
        if lines and text_width(lines) <= width:
            return lines
    return _lying(tree, colours)


def text_width(lines: Lines) -> int:
    return max(map(len, lines))


def _label(tree: Tree, colours: bool) -> str:
    if not colours:
        return DOT
    number = tree.root + 1
    return f"{DOT}{number}"


def _chain(tree: Tree, colours: bool) -> list[str]:
    """A tree without forks on one line; empty for other trees."""
    labels = [_label(tree, colours)]
    while tree.branches:
        if len(tree.branches) > 1:
            return []
        (tree,) = tree.branches
        labels.append(_label(tree, colours))
    return ["─".join(labels)]


def _upright(tree: Tree, colours: bool) -> tuple[list[str], int]:
    label = _label(tree, colours)
    if not tree.branches:
        return [label], 0
    parts = [_upright(u, colours) for u in written_order(tree)]
    height = max(len(lines) for lines, _ in parts)
    left = 0
    dots = []
    rows = [""] * height
    for lines, dot in parts:
        dots.append(left + dot)
        for i, line in enumerate(lines, height - len(lines)):
            rows[i] = rows[i].ljust(left) + line
        left += text_width(lines) + 1
    root = (dots[0] + dots[-1]) // 2
    indent = " " * root
    rows.append(_fork(dots, root))
    rows.append(indent + label)
    return rows, root


def _fork(dots: Sequence[int], root: int) -> str:
    first = dots[0]
    last = dots[-1]
    indent = " " * first
    if len(dots) == 1:
        return indent + "│"
    signs = ["─"] * (last + 1)
    for column in dots:
        signs[column] = "┴"
    signs[first] = "╰"
    signs[last] = "╯"
    signs[root] = _WITH_ROOT[signs[root]]
    return indent + "".join(signs[first:])


def _lying(tree: Tree, colours: bool) -> list[str]:
    """The tree with its root at the top left, one vertex per line: as wide as it is deep."""
    lines = [_label(tree, colours)]
    branches = written_order(tree)
    for k, u in enumerate(branches):
        is_last = k == len(branches) - 1
        elbow, rail = "├─", "│ "
        if is_last:
            elbow, rail = "╰─", "  "
        first, *rest = _lying(u, colours)
        lines.append(elbow + first)
        lines += [rail + line for line in rest]
    return lines


def paint(colour: int) -> tuple[str, str]:
    return PALETTE[colour % len(PALETTE)]


def tikz(tree: Tree, scale: float = 0.6, colours: bool = True) -> str:
    """A ``tikzpicture`` in units of ``scale`` cm, or half of that for dots without colours."""
    vertices = layout(tree)
    scale = scale if colours else scale / 2
    unit = f"{scale:g}cm"
    lines = [rf"\begin{{tikzpicture}}[x={unit},y={unit},baseline=(v0.base)]"]
    for k, v in enumerate(vertices):
        style = "circle,fill,inner sep=0pt,minimum size=1.2mm"
        label = ""
        if colours:
            style = _tikz_style(v.colour)
            label = str(v.colour + 1)
        node = rf"\node[{style}] (v{k})"
        place = f"({v.x:g},{v.y})"
        lines.append(f"  {node} at {place} {{{label}}};")
    for k, v in enumerate(vertices):
        if v.parent >= 0:
            lines.append(rf"  \draw (v{v.parent}) -- (v{k});")
    lines += [r"\end{tikzpicture}", ""]
    return "\n".join(lines)


def _tikz_style(colour: int) -> str:
    fill, ink = map(_tikz_colour, paint(colour))
    shape = "circle,draw,inner sep=0pt,minimum size=4mm"
    colours = f"fill={fill},text={ink}"
    return rf"{shape},font=\scriptsize,{colours}"


def _tikz_colour(value: str) -> str:
    digits = value.removeprefix("#")
    red, green, blue = bytes.fromhex(digits)
    return f"{{rgb,255:red,{red};green,{green};blue,{blue}}}"


# of the SVG drawings, in pixels
STEP_X = 30
STEP_Y = 36
RADIUS = 11
DIAMETER = 2 * RADIUS
MARGIN = 16
COLUMNS = 6  # of a sheet
FEW, FEW_COLUMNS = 9, 3  # up to so many trees, in so many columns
ROW_GAP = 24  # between the captions of one row and the highest tree of the next
CAPTION_SIZE = 12  # type size of the captions, in pixels
CAPTION_STEP = 17  # from one line of a caption to the next
CHARACTER = 0.62 * CAPTION_SIZE  # width of a character of the captions, in pixels
FONTS = "DejaVu Sans, Helvetica, Arial, sans-serif"
Vertices: TypeAlias = "Sequence[Vertex]"
Pixels: TypeAlias = list[float]


def draw_svg(tree: Tree) -> str:
    return draw_svg_sheet([tree])


def draw_svg_sheet(
    trees: Sequence[Tree], captions: Lines | None = None, columns: int = 0, title: str = ""
) -> str:
    """An SVG document with the trees in rows of ``columns``, by default six, or three for few.

    Each is above its caption, σ and γ; dots are plain if colour 1 is the only one. ``title`` is for
    screen readers. Raises ValueError unless each tree has a caption, if there are any.
    """
    from html import escape  # brings a table of entities along

    count = len(trees)
    if captions is not None and len(captions) != count:
        counts = f"{len(captions)} captions for {count} trees"
        raise ValueError(f"{counts}; give each tree one")
    placed = [layout(u) for u in trees]
    has_colours = any(v.colour for vertices in placed for v in vertices)
    lines = [[f"σ = {u.symmetry}, γ = {u.density}"] for u in trees]
    for k, caption in enumerate(captions or ()):
        lines[k].insert(0, caption)
    columns = columns or (FEW_COLUMNS if count <= FEW else COLUMNS)
    columns = max(1, min(columns, count))
    widths, heights = _grid(placed, lines, columns)
    foot = CAPTION_STEP * (2 if captions else 1) + 2 * MARGIN + ROW_GAP
    body: list[str] = []
    for k, vertices in enumerate(placed):
        row, column = divmod(k, columns)
        middle = sum(widths[:column]) + widths[column] / 2
        base = MARGIN + sum(heights[: row + 1]) + row * foot
        body += _svg_tree(vertices, middle, base - RADIUS, has_colours)
        body += _svg_caption(lines[k], middle, base)
    wide = f"{sum(widths):.0f}"
    high = f"{(MARGIN + sum(heights) + len(heights) * foot - ROW_GAP):.0f}"
    size = f'width="{wide}" height="{high}"'
    view = f'viewBox="0 0 {wide} {high}"'
    font = f'font-family="{FONTS}" font-size="{CAPTION_SIZE}" text-anchor="middle"'
    namespace = 'xmlns="http://www.w3.org/2000/svg"'
    head = [
        f'<svg {namespace} {size} {view} {font} role="img">',
        f"<title>{escape(title or _title(trees))}</title>",
        '<rect width="100%" height="100%" fill="#ffffff"/>',
    ]
    return "\n".join([*head, *body, "</svg>", ""])


def _title(trees: Sequence[Tree]) -> str:
    return str(trees[0]) if len(trees) == 1 else counted(len(trees), "tree")


def _grid(
    placed: Sequence[Vertices], captions: Sequence[Lines], columns: int
) -> tuple[Pixels, Pixels]:
    rows = -(-len(placed) // columns)
    widths = [0.0] * columns
    heights = [0.0] * rows
    for k, vertices in enumerate(placed):
        row, column = divmod(k, columns)
        right = max(v.x for v in vertices)
        top = max(v.y for v in vertices)
        wide = max(right * STEP_X + DIAMETER, text_width(captions[k]) * CHARACTER) + 2 * MARGIN
        high = top * STEP_Y + DIAMETER
        widths[column] = max(widths[column], wide)
        heights[row] = max(heights[row], high)
    return widths, heights


def _svg_tree(vertices: Vertices, middle: float, ground: float, has_colours: bool) -> list[str]:
    # edges first, so that the dots lie on them
    left = middle - max(v.x for v in vertices) * STEP_X / 2
    xs = [left + v.x * STEP_X for v in vertices]
    ys = [ground - v.y * STEP_Y for v in vertices]
    edges: list[str] = []
    dots: list[str] = []
    for v, x, y in zip(vertices, xs, ys, strict=True):
        dots += _svg_dot(v.colour, x, y, has_colours)
        if v.parent < 0:
            continue
        start = _pixels(x1=xs[v.parent], y1=ys[v.parent])
        end = _pixels(x2=x, y2=y)
        edges.append(f"<line {start} {end}/>")
    group = '<g stroke="#333333" stroke-width="1.6">'
    return [group, *edges, "</g>", *dots]


def _svg_dot(colour: int, x: float, y: float, has_number: bool) -> list[str]:
    if not has_number:
        return [f'<circle {_pixels(cx=x, cy=y)} r="{RADIUS / 2:g}" fill="#333333"/>']
    fill, ink = paint(colour)
    number = colour + 1
    centre = _pixels(cx=x, cy=y)
    # a digit is some 9 pixels high: its base lies half of that below the centre
    base = _pixels(x=x, y=y + 4.3)
    disc = f'r="{RADIUS}" fill="{fill}" stroke="#333333"'
    font = f'font-weight="bold" fill="{ink}"'
    return [f"<circle {centre} {disc}/>", f"<text {base} {font}>{number}</text>"]


def _svg_caption(lines: Lines, middle: float, top: float) -> list[str]:
    from html import escape  # brings a table of entities along

    written: list[str] = []
    base = top + 2
    for line in lines:
        base += CAPTION_STEP
        text = escape(line)
        place = _pixels(x=middle, y=base)
        written.append(f'<text {place} fill="#222222">{text}</text>')
    return written


def _pixels(**lengths: float) -> str:
    written = []
    for name, length in lengths.items():
        tenths = f"{length:.1f}"
        written.append(f'{name}="{tenths}"')
    return " ".join(written)
