"""Trees and order conditions in text."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from garkcli.ntrees.notation import (
    MAX_DEPTH,
    MAX_LENGTH,
    MAX_VERTICES,
    NotationError,
    condition_latex,
    condition_text,
    format_latex,
    format_tree,
    parse_tree,
    vertex_letters,
)
from garkcli.ntrees.tree import Tree

trees = st.recursive(
    st.builds(Tree, st.integers(0, 11)),
    lambda inner: st.builds(Tree, st.integers(0, 11), st.lists(inner, max_size=4)),
    max_leaves=15,
)

# The paper's Table 1, "Order conditions for GARK methods up to order 4", its macros written out.
TABLE_1 = [
    ("[]", "b{l}ᵀ𝟙 = 1", r"{b^{\{l\}}}^T 1^{\{l\}} = 1"),
    ("[[]]", "b{l}ᵀA{l,m}𝟙 = 1/2", r"{b^{\{l\}}}^T A^{\{l,m\}} 1^{\{m\}} = \frac12"),
    (
        "[[],[]]",
        "b{l}ᵀ((A{l,m}𝟙) ⊙ (A{l,n}𝟙)) = 1/3",
        r"{b^{\{l\}}}^T ((A^{\{l,m\}} 1^{\{m\}}) \odot (A^{\{l,n\}} 1^{\{n\}})) = \frac13",
    ),
    (
        "[[[]]]",
        "b{l}ᵀA{l,m}A{m,n}𝟙 = 1/6",
        r"{b^{\{l\}}}^T A^{\{l,m\}} A^{\{m,n\}} 1^{\{n\}} = \frac16",
    ),
    (
        "[[],[],[]]",
        "b{l}ᵀ((A{l,m}𝟙) ⊙ (A{l,n}𝟙) ⊙ (A{l,u}𝟙)) = 1/4",
        r"{b^{\{l\}}}^T ((A^{\{l,m\}} 1^{\{m\}}) \odot (A^{\{l,n\}} 1^{\{n\}})"
        r" \odot (A^{\{l,u\}} 1^{\{u\}})) = \frac14",
    ),
    (
        "[[[]],[]]",
        "b{l}ᵀ((A{l,m}A{m,n}𝟙) ⊙ (A{l,u}𝟙)) = 1/8",
        r"{b^{\{l\}}}^T ((A^{\{l,m\}} A^{\{m,n\}} 1^{\{n\}}) \odot (A^{\{l,u\}} 1^{\{u\}})) = \frac18",
    ),
    (
        "[[[],[]]]",
        "b{l}ᵀA{l,m}((A{m,n}𝟙) ⊙ (A{m,u}𝟙)) = 1/12",
        r"{b^{\{l\}}}^T A^{\{l,m\}} ((A^{\{m,n\}} 1^{\{n\}}) \odot (A^{\{m,u\}} 1^{\{u\}})) = \frac1{12}",
    ),
    (
        "[[[[]]]]",
        "b{l}ᵀA{l,m}A{m,n}A{n,u}𝟙 = 1/24",
        r"{b^{\{l\}}}^T A^{\{l,m\}} A^{\{m,n\}} A^{\{n,u\}} 1^{\{u\}} = \frac1{24}",
    ),
]


@pytest.mark.parametrize(("tree", "text", "latex"), TABLE_1)
def test_table_1_of_the_paper(tree: str, text: str, latex: str) -> None:
    """The eight printed conditions come out in the printed form, with the printed letters."""
    u = parse_tree(tree)
    letters = vertex_letters(u)
    assert condition_text(u, letters) == text
    assert condition_latex(u, letters) == latex.replace(" 1^", r" \mathbbm{1}^")
    assert format_tree(u, colours=False) == tree


def test_a_coloured_condition_has_numbers() -> None:
    """Without letters the colours of the tree are written, from 1."""
    u = parse_tree("[[[]_3]_2,[]_1]_1")
    assert condition_text(u) == "b{1}ᵀ((A{1,2}A{2,3}𝟙) ⊙ (A{1,1}𝟙)) = 1/8"
    assert r"A^{\{2,3\}} \mathbbm{1}^{\{3\}}" in condition_latex(u)


def test_too_few_letters_are_refused() -> None:
    """A shape with three vertices needs three letters."""
    with pytest.raises(ValueError, match="each vertex needs a letter"):
        condition_text(parse_tree("[[],[]]"), ["l", "m"])


def test_letters_never_run_out() -> None:
    """The vertices of a large shape have letters of their own, different from each other."""
    letters = vertex_letters(Tree(0, [Tree(0)] * 99))
    assert letters[:6] == ("l", "m", "n", "u", "v", "w")
    assert len(set(letters)) == 100


@given(trees)
def test_text_round_trip(tree: Tree) -> None:
    """Reading what was written gives the tree back, with any blanks between the signs."""
    text = format_tree(tree)
    assert parse_tree(text) == tree
    blanks = "".join(f" {c} " if c in "[],_" else c for c in text)
    assert parse_tree(blanks) == tree


@given(trees)
def test_shapes_round_trip(tree: Tree) -> None:
    """Text without colours is a tree of one colour with the same shape."""
    shape = parse_tree(format_tree(tree, colours=False))
    assert shape.colours == {0}
    assert (shape.order, shape.density) == (tree.order, tree.density)
    assert format_tree(parse_tree(format_tree(shape)), colours=False) == format_tree(
        shape, colours=False
    )


def test_latex_of_the_paper() -> None:
    """A single vertex is τ with its colour; colours can be left out."""
    u = parse_tree("[[]_1,[]_2]_1")
    assert format_latex(u) == r"[\tau^{[1]},\tau^{[2]}]^{[1]}"
    assert format_latex(u, colours=False) == r"[\tau,\tau]"


@pytest.mark.parametrize(
    ("text", "offset", "message"),
    [
        ("", 0, "begins with"),
        ("1", 0, "begins with"),
        ("[", 1, "is missing"),
        ("[[]_1", 5, "is missing"),
        ("[[]_1 []_1]_1", 6, "is missing"),
        ("[[],]", 4, "a branch is missing"),
        ("[]_1 x", 5, "after the end"),
        ("[]]", 2, "after the end"),
        ("[]_", 3, "a colour is missing"),
        ("[]_x", 3, "a colour is missing"),
        ("[]_²", 3, "a colour is missing"),
        ("[]_0", 3, "no such colour"),
        ("[]_99999", 3, "no such colour"),
        ("[]_" + "9" * 5000, 3, "no such colour"),
        ("[[]_1,[]]_1", 8, "only some"),
        ("[[],[]_1]", 6, "only some"),
        ("[" * (MAX_DEPTH + 1), MAX_DEPTH, "too deep"),
        ("[" + "[]," * MAX_VERTICES, 3 * MAX_VERTICES - 2, "too large"),
        ("[" * (MAX_LENGTH + 1), MAX_LENGTH, "too long"),
    ],
)
def test_faults_are_placed(text: str, offset: int, message: str) -> None:
    """What is no tree is refused, with the offset of the fault and a cure."""
    with pytest.raises(NotationError, match=message) as caught:
        parse_tree(text)
    assert caught.value.offset == offset
    assert caught.value.help


@given(st.text(alphabet="[],_ 12x", max_size=30))
def test_any_text_is_read_or_refused(text: str) -> None:
    """No text raises anything but NotationError, and the offset lies in the text or at its end."""
    offset = 0
    try:
        parse_tree(text)
    except NotationError as fault:
        offset = fault.offset
    assert 0 <= offset <= len(text)


def test_the_largest_trees_within_the_limits() -> None:
    """The deepest and the widest tree that can be read can be measured, compared and written."""
    deepest = "[" * MAX_DEPTH + "]" * MAX_DEPTH
    widest = "[" + ",".join(["[]"] * (MAX_VERTICES - 1)) + "]"
    for text in (deepest, widest):
        u = parse_tree(text)
        assert u == parse_tree(text)
        assert u.density >= u.order
        assert len(str(u.symmetry * u.density)) > 2
        assert format_tree(u, colours=False) == text
        assert condition_text(u).startswith("b{1}ᵀ")
        assert format_latex(u).endswith("^{[1]}")
    assert parse_tree("[]".ljust(MAX_LENGTH)).order == 1
