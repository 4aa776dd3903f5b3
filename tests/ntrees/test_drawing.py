"""Trees drawn in text, SVG and TikZ."""

import re
from itertools import pairwise
from xml.etree import ElementTree as ET

import pytest
from hypothesis import given
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
    """Vertices of one height are at least one unit apart, and each is one above its parent."""
    vertices = layout(tree)
    assert len(vertices) == tree.order
    for v in vertices[1:]:
        assert v.y == vertices[v.parent].y + 1
    for height in {v.y for v in vertices}:
        row = [v.x for v in vertices if v.y == height]
        assert all(right - left >= 1 for left, right in pairwise(row))


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
