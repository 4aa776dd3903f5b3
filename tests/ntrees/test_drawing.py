"""Trees drawn in text, SVG and TikZ."""

import re
from itertools import pairwise
from xml.etree import ElementTree as ET

import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from garkcli.ntrees.drawing import PALETTE, draw_svg_sheet, draw_text, layout, tikz
from garkcli.ntrees.notation import MAX_DEPTH, MAX_VERTICES, parse_tree
from garkcli.ntrees.tree import Tree

trees = st.recursive(
    st.builds(Tree, st.integers(0, 11)),
    lambda inner: st.builds(Tree, st.integers(0, 11), st.lists(inner, max_size=4)),
    max_leaves=15,
)

PICTURES = [
    ("[]_3", ["●3"]),
    ("[[]_2]_1", ["●1─●2"]),
    ("[[[]_3]_2]_1", ["●1─●2─●3"]),
    ("[[[]_3]_2,[]_2]_1", ["●3", "│", "●2 ●2", "╰┬─╯", " ●1"]),
    ("[[]_2,[]_2]_1", ["●2 ●2", "╰┬─╯", " ●1"]),
    ("[[]_1,[]_2,[]_3]_1", ["●1 ●2 ●3", "╰──┼──╯", "   ●1"]),
    ("[[[]_3,[]_4]_5,[]_8]_12", ["●3 ●4", "╰┬─╯", " ●5   ●8", " ╰─┬──╯", "   ●12"]),
]


@pytest.mark.parametrize(("text", "picture"), PICTURES)
def test_where_there_is_room(text: str, picture: list[str]) -> None:
    """The root is at the bottom, larger branches on the left, lines lead from dot to dot; a chain
    has one line, its root first.
    """
    assert draw_text(parse_tree(text)) == picture


def test_lying_where_there_is_no_room() -> None:
    """Too wide a tree is drawn on its side, one vertex a line."""
    u = parse_tree("[[[]_3,[]_4]_5,[]_8]_2")
    assert draw_text(u, width=7) == ["●2", "├─●5", "│ ├─●3", "│ ╰─●4", "╰─●8"]
    assert draw_text(Tree(0, [Tree(0)] * 40), colours=False, width=80)[0] == " ".join(["●"] * 40)
    assert len(draw_text(Tree(0, [Tree(0)] * 41), colours=False, width=80)) == 42


@given(trees)
def test_every_vertex_is_drawn(tree: Tree) -> None:
    """Each form of the drawing has one dot a vertex with its colour, and stays within 80
    columns.
    """
    for width in (80, 1):
        lines = draw_text(tree, width=width)
        found = sorted(int(number) - 1 for number in re.findall(r"●(\d+)", "\n".join(lines)))
        assert found == sorted(u.root for u in tree.vertices())
        assert max(map(len, lines)) <= 80
    assert "\n".join(draw_text(tree, colours=False)).count("●") == tree.order


@given(trees)
def test_layout_keeps_vertices_apart(tree: Tree) -> None:
    """Vertices of one height are at least one unit apart, and each is one above its parent, which is
    halfway between its first and last branches.
    """
    vertices = layout(tree)
    assert len(vertices) == tree.order
    for v in vertices[1:]:
        assert v.y == vertices[v.parent].y + 1
    for height in {v.y for v in vertices}:
        row = [v.x for v in vertices if v.y == height]
        assert all(right - left >= 1 for left, right in pairwise(row))
    for k, v in enumerate(vertices):
        if above := [w.x for w in vertices if w.parent == k]:
            assert v.x == (above[0] + above[-1]) / 2


def test_large_trees_are_drawn() -> None:
    """The deepest and the widest tree that can be read can be drawn in every form."""
    for u in (
        parse_tree("[" * MAX_DEPTH + "]" * MAX_DEPTH),
        Tree(0, [Tree(0)] * (MAX_VERTICES - 1)),
    ):
        assert sum(line.count("●") for line in draw_text(u)) == u.order
        assert draw_svg_sheet([u]).count("<circle") == u.order
        assert tikz(u).count(r"\node") == u.order


def test_svg_sheet() -> None:
    """The sheet is well-formed XML that draws inside its frame, with σ, γ and escaped captions."""
    trees_of_sheet = [parse_tree(text) for text, _ in PICTURES]
    sheet = draw_svg_sheet(trees_of_sheet, ["a < b & c"] * len(PICTURES), columns=2)
    picture = ET.fromstring(sheet)
    space = "{http://www.w3.org/2000/svg}"
    width, height = (float(picture.attrib["width"]), float(picture.attrib["height"]))
    dots = picture.findall(f"{space}circle")
    assert len(dots) == sum(u.order for u in trees_of_sheet)
    for dot in dots:
        assert 11 <= float(dot.attrib["cx"]) <= width - 11
        assert 11 <= float(dot.attrib["cy"]) <= height - 11
    texts = [text.text for text in picture.iter(f"{space}text")]
    assert texts.count("a < b & c") == len(PICTURES)
    assert "σ = 2, γ = 3" in texts


SPACE = "{http://www.w3.org/2000/svg}"
PIXEL = 0.11
"""Lengths are written to a tenth of a pixel."""


def parts_of_sheet(picture: ET.Element, sheet: list[Tree], lines: int) -> list[list[ET.Element]]:
    """The elements of each tree: edges, dots with or without numbers, captions."""
    elements = [x for x in picture if x.tag != f"{SPACE}title"][1:]
    has_numbers = any(v.root for u in sheet for v in u.vertices())
    parts = []
    for u in sheet:
        count = 1 + u.order * (2 if has_numbers else 1) + lines
        parts.append(elements[:count])
        elements = elements[count:]
    assert not elements
    return parts


def number(element: ET.Element, key: str) -> float:
    """A length."""
    return float(element.attrib[key])


@example([Tree(0)] * 9, 0, True)
@example([Tree(0)] * 13, 0, False)
@given(st.lists(trees, min_size=1, max_size=11), st.integers(0, 5), st.booleans())
def test_a_sheet_is_a_grid_of_layouts(sheet: list[Tree], columns: int, has_captions: bool) -> None:
    """Each tree is its layout, 30 and 36 pixels a unit, centred above its captions; edges end at
    dots; the roots of a row are on one line, neighbours apart, and the frame encloses all.
    """
    captions = [f"tree {k}" for k in range(len(sheet))] if has_captions else None
    picture = ET.fromstring(draw_svg_sheet(sheet, captions, columns))
    lines = 2 if has_captions else 1
    in_row = min(columns or (3 if len(sheet) <= 9 else 6), len(sheet))
    width, height = number(picture, "width"), number(picture, "height")
    assert picture.attrib["viewBox"] == f"0 0 {width:.0f} {height:.0f}"
    boxes: list[tuple[float, float, float, float]] = []
    for k, (u, elements) in enumerate(
        zip(sheet, parts_of_sheet(picture, sheet, lines), strict=True)
    ):
        dots = [x for x in elements if x.tag == f"{SPACE}circle"]
        texts = [x for x in elements if x.tag == f"{SPACE}text"]
        told, labels = texts[-lines:], texts[:-lines]
        assert told[-1].text == f"σ = {u.symmetry}, γ = {u.density}"
        assert not captions or told[0].text == captions[k]
        placed = layout(u)
        root = dots[0]
        for v, dot in zip(placed, dots, strict=True):
            shift = number(dot, "cx") - number(root, "cx"), number(root, "cy") - number(dot, "cy")
            assert shift == pytest.approx((30 * (v.x - placed[0].x), 36 * v.y), abs=2 * PIXEL)
            if labels:
                assert dot.attrib["fill"] == PALETTE[v.colour % len(PALETTE)][0]
        assert [x.text for x in labels] == ([str(v.colour + 1) for v in placed] if labels else [])
        for label, dot in zip(labels, dots, strict=False):
            assert number(label, "x") == number(dot, "cx")
            assert 3 < number(label, "y") - number(dot, "cy") < 6
        ends = []
        for v, dot in zip(placed[1:], dots[1:], strict=True):
            start = dots[v.parent]
            ends.append(tuple(x.attrib[y] for x in (start, dot) for y in ("cx", "cy")))
        edges = [tuple(x.attrib[y] for y in ("x1", "y1", "x2", "y2")) for x in elements[0]]
        assert edges == ends
        # centred, captions below
        xs = [number(x, "cx") for x in dots]
        middle = (min(xs) + max(xs)) / 2
        assert all(number(x, "x") == pytest.approx(middle, abs=2 * PIXEL) for x in told)
        ys = [number(x, "y") for x in told]
        assert ys == pytest.approx([number(root, "cy") + 11 + 19 + 17 * i for i in range(lines)])
        half = max(max(map(len, (x.text or "" for x in told))) * 7, max(xs) - min(xs) + 22) / 2
        top = min(number(x, "cy") for x in dots) - 11
        boxes.append((middle - half, top, middle + half, ys[-1]))
    for k, (left, top, right, bottom) in enumerate(boxes):
        assert left >= 16 - PIXEL
        assert right <= width - 16 + 1
        assert top >= 16 - PIXEL
        assert bottom <= height - 10
        row, column = divmod(k, in_row)
        if column:
            assert left - boxes[k - 1][2] >= 30
            assert boxes[k - 1][3] == pytest.approx(bottom)
        if row:
            above = max(box[3] for box in boxes[(row - 1) * in_row : row * in_row])
            gap = min(box[1] for box in boxes[row * in_row : (row + 1) * in_row]) - above
            assert 24 <= gap <= 60
    assert min(box[1] for box in boxes[:in_row]) == pytest.approx(16, abs=PIXEL)
    assert height - boxes[-1][3] < 40


@given(trees, st.booleans())
def test_tikz_has_the_layout(tree: Tree, colours: bool) -> None:
    """Coordinates, colours, edges from parents, and half the scale for plain dots."""
    text = tikz(tree, 0.8, colours)
    unit = "0.8" if colours else "0.4"
    assert text.startswith(rf"\begin{{tikzpicture}}[x={unit}cm,y={unit}cm,baseline=(v0.base)]")
    nodes = re.findall(r"\(v(\d+)\) at \(([\d.]+),(\d+)\) \{(\d*)\};", text)
    placed = layout(tree)
    assert [(int(k), int(y)) for k, _, y, _ in nodes] == [(k, v.y) for k, v in enumerate(placed)]
    assert [float(x) for _, x, *_ in nodes] == pytest.approx([v.x for v in placed], abs=1e-4)
    assert [x for *_, x in nodes] == [str(v.colour + 1) if colours else "" for v in placed]
    edges = re.findall(r"\\draw \(v(\d+)\) -- \(v(\d+)\);", text)
    assert edges == [(str(v.parent), str(k)) for k, v in enumerate(placed) if k]
    for v, line in zip(placed, text.splitlines()[1:], strict=False):
        red = int(PALETTE[v.colour % len(PALETTE)][0][1:3], 16)
        assert (f"fill={{rgb,255:red,{red};" in line) == colours


def test_svg_sheet_of_nothing() -> None:
    """No trees make an empty sheet; captions must be as many as trees."""
    assert ET.fromstring(draw_svg_sheet([])).tag.endswith("svg")
    with pytest.raises(ValueError, match="1 captions for 0 trees"):
        draw_svg_sheet([], ["alone"])


def luminance(colour: str) -> float:
    """Relative luminance of the Web Content Accessibility Guidelines 2.1."""
    channels = [int(colour[i : i + 2], 16) / 255 for i in (1, 3, 5)]
    linear = [c / 12.92 if c <= 0.03928 else ((c + 0.055) / 1.055) ** 2.4 for c in channels]
    return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]


@pytest.mark.parametrize(("fill", "ink"), PALETTE)
def test_numbers_are_legible(fill: str, ink: str) -> None:
    """The number in a dot has a contrast of at least 4.5 to the dot's fill."""
    bright, dark = sorted((luminance(fill), luminance(ink)), reverse=True)
    assert (bright + 0.05) / (dark + 0.05) >= 4.5


def test_tikz() -> None:
    """One node a vertex, one line an edge, balanced braces, and nothing but TikZ."""
    picture = tikz(parse_tree("[[]_2,[[]_9]_1]_1"))
    assert picture.count(r"\node") == 4
    assert picture.count(r"\draw") == 3
    assert picture.count("{") == picture.count("}")
    assert set(re.findall(r"\\[a-z]+", picture)) == {
        r"\begin",
        r"\node",
        r"\draw",
        r"\scriptsize",
        r"\end",
    }
