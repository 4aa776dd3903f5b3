"""Pictures of trees, the root at the bottom as Butcher draws them: terminal text, an SVG sheet,
TikZ.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from garkcli.trees.notation import written_order

if TYPE_CHECKING:
    from collections.abc import Sequence

    from garkcli.trees.tree import Tree

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
"""A fill for each colour, told apart by every kind of colour vision, and the ink legible on it.

Source: Okabe and Ito, *Color Universal Design* (2008). From the ninth colour on the fills repeat;
the numbers do not.
"""

DOT = "●"

# of the SVG drawings, in pixels
STEP_X = 30
STEP_Y = 36
RADIUS = 11
MARGIN = 16
ROW_GAP = 24  # between the captions of one row and the highest tree of the next
CAPTION_SIZE = 12  # type size of the captions, in pixels
CAPTION_STEP = 17  # from one line of a caption to the next
CHARACTER = 0.62 * CAPTION_SIZE  # width of a character of the captions, in pixels
FONTS = "DejaVu Sans, Helvetica, Arial, sans-serif"


class Vertex(NamedTuple):
    """A vertex placed: ``x`` in leaf widths from the left, ``y`` the distance from the root."""

    x: float
    y: int
    colour: int
    parent: int


def layout(tree: Tree) -> list[Vertex]:
    """Place every vertex, the root first, parents before branches; ``parent`` is an index, -1 for
    the root.

    Leaves are one unit apart; a vertex with branches is in the middle of the first and the last of
    them.

    >>> from garkcli.trees.tree import Tree
    >>> layout(Tree(0, [Tree(1), Tree(1)]))[0]
    Vertex(x=0.5, y=0, colour=0, parent=-1)
    """
    placed: list[Vertex] = []
    leaves = 0

    def place(u: Tree, y: int, parent: int) -> float:
        nonlocal leaves
        here = len(placed)
        placed.append(Vertex(0, y, u.root, parent))
        columns = [place(branch, y + 1, here) for branch in written_order(u)]
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
    r"""Lines of text, from top to bottom: upright where it fits into ``width``, else lying on its
    side.

    A vertex is a dot followed by its colour, from 1; ``colours=False`` leaves the number out.

    >>> from garkcli.trees.tree import Tree
    >>> print("\n".join(draw_text(Tree(0, [Tree(1), Tree(0, [Tree(1)])]))))
    ●2
    │
    ●1 ●2
    ╰┬─╯
     ●1
    """
    lines, _ = _upright(tree, colours)
    if _text_width(lines) <= width:
        return lines
    return _lying(tree, colours)


def _text_width(lines: Sequence[str]) -> int:
    """Characters in the longest of some lines."""
    return max(len(line) for line in lines)


def _label(tree: Tree, colours: bool) -> str:
    return f"{DOT}{tree.root + 1}" if colours else DOT


def _upright(tree: Tree, colours: bool) -> tuple[list[str], int]:
    """The lines, and the column of the root's dot."""
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
        top = height - len(lines)
        for i, line in enumerate(lines, top):
            rows[i] = rows[i].ljust(left) + line
        left += _text_width(lines) + 1
    root = (dots[0] + dots[-1]) // 2
    fork = _fork(dots, root)
    return [*rows, fork, " " * root + label], root


def _fork(dots: Sequence[int], root: int) -> str:
    """The line that joins branches, whose dots are at these columns, to the root below."""
    if len(dots) == 1:
        return " " * root + "│"
    signs = ["─"] * (dots[-1] + 1)
    for column in dots:
        signs[column] = "┴"
    signs[dots[0]], signs[dots[-1]] = "╰", "╯"
    signs[root] = {"─": "┬", "┴": "┼", "╰": "├"}[signs[root]]
    return " " * dots[0] + "".join(signs[dots[0] :])


def _lying(tree: Tree, colours: bool) -> list[str]:
    """The root at the top left, one vertex a line: as wide as the tree is deep."""
    lines = [_label(tree, colours)]
    branches = written_order(tree)
    for k, u in enumerate(branches):
        is_last = k == len(branches) - 1
        elbow, rail = ("╰─", "  ") if is_last else ("├─", "│ ")
        first, *rest = _lying(u, colours)
        lines.append(elbow + first)
        lines += [rail + line for line in rest]
    return lines


def draw_svg_sheet(
    trees: Sequence[Tree], captions: Sequence[str] | None = None, columns: int = 6
) -> str:
    """An SVG document with the trees in rows of ``columns``, beneath each its caption, σ and γ.

    The dots carry the colours' numbers, from 1, and fills of :data:`PALETTE`. ``captions``: a line
    of text for each tree. Raises ``ValueError`` when there are not as many captions as trees.
    """
    if captions is not None and len(captions) != len(trees):
        raise ValueError(
            f"{len(captions)} captions for {len(trees)} trees; give each tree one"
        )
    placed = [layout(u) for u in trees]
    lines = [[f"σ = {u.symmetry}, γ = {u.density}"] for u in trees]
    for k, caption in enumerate(captions or ()):
        lines[k].insert(0, caption)
    columns = max(1, min(columns, len(trees)))
    widths, heights = _grid(placed, lines, columns)
    captioned = CAPTION_STEP * max((len(text) for text in lines), default=0)
    foot = captioned + 2 * MARGIN + ROW_GAP
    body = []
    for k, vertices in enumerate(placed):
        row, column = divmod(k, columns)
        middle = sum(widths[:column]) + widths[column] / 2
        ground = MARGIN + sum(heights[: row + 1]) + row * foot - RADIUS
        body += _svg_tree(vertices, middle, ground)
        body += _svg_caption(lines[k], middle, ground + RADIUS)
    width = sum(widths)
    height = MARGIN + sum(heights) + len(heights) * foot - ROW_GAP
    head = _svg_head(width, height)
    return "\n".join([*head, *body, "</svg>", ""])


def _grid(
    placed: Sequence[Sequence[Vertex]], captions: Sequence[Sequence[str]], columns: int
) -> tuple[list[float], list[float]]:
    """The widths of the columns of a sheet and the heights of its rows, in pixels."""
    rows = -(-len(placed) // columns)
    widths = [0.0] * columns
    heights = [0.0] * rows
    for k, vertices in enumerate(placed):
        row, column = divmod(k, columns)
        drawn = max(v.x for v in vertices) * STEP_X + 2 * RADIUS
        written = _text_width(captions[k]) * CHARACTER
        high = max(v.y for v in vertices) * STEP_Y + 2 * RADIUS
        widths[column] = max(widths[column], drawn + 2 * MARGIN, written + 2 * MARGIN)
        heights[row] = max(heights[row], high)
    return widths, heights


def _svg_head(width: float, height: float) -> list[str]:
    size = f'width="{width:.0f}" height="{height:.0f}"'
    view = f'viewBox="0 0 {width:.0f} {height:.0f}"'
    font = f'font-family="{FONTS}" font-size="{CAPTION_SIZE}" text-anchor="middle"'
    return [
        f'<svg xmlns="http://www.w3.org/2000/svg" {size} {view} {font}>',
        '<rect width="100%" height="100%" fill="#ffffff"/>',
    ]


def _svg_tree(vertices: Sequence[Vertex], middle: float, ground: float) -> list[str]:
    """Edges first, so that the dots lie on them; the drawing is centred at ``middle``."""
    left = middle - max(v.x for v in vertices) * STEP_X / 2
    points = [(left + v.x * STEP_X, ground - v.y * STEP_Y) for v in vertices]
    lines = ['<g stroke="#333333" stroke-width="1.6">']
    for v, (x, y) in zip(vertices[1:], points[1:], strict=True):
        x0, y0 = points[v.parent]
        start = f'x1="{x0:.1f}" y1="{y0:.1f}"'
        end = f'x2="{x:.1f}" y2="{y:.1f}"'
        lines.append(f"<line {start} {end}/>")
    lines.append("</g>")
    for v, (x, y) in zip(vertices, points, strict=True):
        fill, ink = PALETTE[v.colour % len(PALETTE)]
        centre = f'cx="{x:.1f}" cy="{y:.1f}" r="{RADIUS}"'
        lines.append(f'<circle {centre} fill="{fill}" stroke="#333333"/>')
        # a digit is some 9 pixels high: its base lies half of that below the centre
        base = f'x="{x:.1f}" y="{y + 4.3:.1f}"'
        number = v.colour + 1
        lines.append(f'<text {base} font-weight="bold" fill="{ink}">{number}</text>')
    return lines


def _svg_caption(lines: Sequence[str], middle: float, top: float) -> list[str]:
    from html import escape  # brings a table of entities along

    written = []
    for i, line in enumerate(lines):
        base = top + CAPTION_STEP * (i + 1) + 2
        place = f'x="{middle:.1f}" y="{base:.1f}"'
        written.append(f'<text {place} fill="#222222">{escape(line)}</text>')
    return written


def tikz(tree: Tree, scale: float = 0.6, colours: bool = True) -> str:
    r"""A ``tikzpicture`` of plain nodes with coordinates in units of ``scale`` cm; needs ``tikz``
    only.

    Without ``colours`` the vertices are plain black dots, at half the scale.

    >>> from garkcli.trees.tree import Tree
    >>> print(tikz(Tree(0)).splitlines()[0])
    \begin{tikzpicture}[x=0.6cm,y=0.6cm,baseline=(v0.base)]
    """
    vertices = layout(tree)
    scale = scale if colours else scale / 2
    lines = [rf"\begin{{tikzpicture}}[x={scale:g}cm,y={scale:g}cm,baseline=(v0.base)]"]
    for k, v in enumerate(vertices):
        style = "circle,fill,inner sep=0pt,minimum size=1.2mm"
        label = ""
        if colours:
            style = _tikz_style(v.colour)
            label = str(v.colour + 1)
        lines.append(rf"  \node[{style}] (v{k}) at ({v.x:g},{v.y}) {{{label}}};")
    for k, v in enumerate(vertices):
        if v.parent >= 0:
            lines.append(rf"  \draw (v{v.parent}) -- (v{k});")
    return "\n".join([*lines, r"\end{tikzpicture}", ""])


def _tikz_style(colour: int) -> str:
    """How the node of a vertex with a number looks."""
    fill, ink = PALETTE[colour % len(PALETTE)]
    shape = "circle,draw,inner sep=0pt,minimum size=4mm"
    paint = f"fill={_tikz_colour(fill)},text={_tikz_colour(ink)}"
    return rf"{shape},font=\scriptsize,{paint}"


def _tikz_colour(value: str) -> str:
    red, green, blue = bytes.fromhex(value.removeprefix("#"))
    return f"{{rgb,255:red,{red};green,{green};blue,{blue}}}"
