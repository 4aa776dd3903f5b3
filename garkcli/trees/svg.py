"""Many trees as one sheet of SVG, the root at the bottom as Butcher draws them."""

from __future__ import annotations

from typing import TYPE_CHECKING, TypeAlias

from garkcli.trees.drawing import layout, paint, text_width

if TYPE_CHECKING:
    from collections.abc import Sequence

    from garkcli.trees.drawing import Lines, Vertex
    from garkcli.trees.tree import Tree

# of the SVG drawings, in pixels
STEP_X = 30
STEP_Y = 36
RADIUS = 11
DIAMETER = 2 * RADIUS
MARGIN = 16
ROW_GAP = 24  # between the captions of one row and the highest tree of the next
CAPTION_SIZE = 12  # type size of the captions, in pixels
CAPTION_STEP = 17  # from one line of a caption to the next
CHARACTER = 0.62 * CAPTION_SIZE  # width of a character of the captions, in pixels
FONTS = "DejaVu Sans, Helvetica, Arial, sans-serif"
Vertices: TypeAlias = "Sequence[Vertex]"
Pixels: TypeAlias = list[float]


def draw_svg(tree: Tree) -> str:
    """A picture of one tree, as notebooks show it; colours count from 1 there."""
    return draw_svg_sheet([tree])


def draw_svg_sheet(trees: Sequence[Tree], captions: Lines | None = None, columns: int = 6) -> str:
    """An SVG document with the trees in rows of ``columns``, beneath each its caption, σ and γ.

    The dots carry the colours' numbers, from 1, and fills of ``drawing.PALETTE``. ``captions``: a
    line of text for each tree. Raises ``ValueError`` when there are not as many captions as trees.
    """
    count = len(trees)
    if captions is not None and len(captions) != count:
        found = f"{len(captions)} captions for {count} trees"
        raise ValueError(f"{found}; give each tree one")
    placed = [layout(u) for u in trees]
    lines = [[_numbers(u)] for u in trees]
    for k, caption in enumerate(captions or ()):
        lines[k].insert(0, caption)
    columns = max(1, min(columns, count))
    widths, heights = _grid(placed, lines, columns)
    foot = CAPTION_STEP * max(map(len, lines), default=0) + 2 * MARGIN + ROW_GAP
    body: list[str] = []
    for k, vertices in enumerate(placed):
        row, column = divmod(k, columns)
        middle = sum(widths[:column]) + widths[column] / 2
        base = MARGIN + sum(heights[: row + 1]) + row * foot
        body += _svg_tree(vertices, middle, base - RADIUS)
        body += _svg_caption(lines[k], middle, base)
    head = _svg_head(sum(widths), MARGIN + sum(heights) + len(heights) * foot - ROW_GAP)
    return "\n".join([*head, *body, "</svg>", ""])


def _numbers(tree: Tree) -> str:
    """The last line of a caption."""
    return f"σ = {tree.symmetry}, γ = {tree.density}"


def _grid(
    placed: Sequence[Vertices], captions: Sequence[Lines], columns: int
) -> tuple[Pixels, Pixels]:
    """The widths of the columns of a sheet and the heights of its rows, in pixels."""
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


def _svg_head(width: float, height: float) -> list[str]:
    wide = f"{width:.0f}"
    high = f"{height:.0f}"
    size = f'width="{wide}" height="{high}"'
    view = f'viewBox="0 0 {wide} {high}"'
    font = f'font-family="{FONTS}" font-size="{CAPTION_SIZE}" text-anchor="middle"'
    namespace = 'xmlns="http://www.w3.org/2000/svg"'
    return [
        f"<svg {namespace} {size} {view} {font}>",
        '<rect width="100%" height="100%" fill="#ffffff"/>',
    ]


def _svg_tree(vertices: Vertices, middle: float, ground: float) -> list[str]:
    """Edges first, so that the dots lie on them; the drawing is centred at ``middle``."""
    left = middle - max(v.x for v in vertices) * STEP_X / 2
    xs = [left + v.x * STEP_X for v in vertices]
    ys = [ground - v.y * STEP_Y for v in vertices]
    edges: list[str] = []
    dots: list[str] = []
    for v, x, y in zip(vertices, xs, ys, strict=True):
        dots += _svg_dot(v.colour, x, y)
        if v.parent < 0:
            continue
        start = _pixels(x1=xs[v.parent], y1=ys[v.parent])
        end = _pixels(x2=x, y2=y)
        edges.append(f"<line {start} {end}/>")
    group = '<g stroke="#333333" stroke-width="1.6">'
    return [group, *edges, "</g>", *dots]


def _svg_dot(colour: int, x: float, y: float) -> list[str]:
    """A vertex, and the number of its colour on it."""
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
    """Attributes of an element, to a tenth of a pixel."""
    written = []
    for name, length in lengths.items():
        tenths = f"{length:.1f}"
        written.append(f'{name}="{tenths}"')
    return " ".join(written)
