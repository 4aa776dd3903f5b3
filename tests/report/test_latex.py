"""LaTeX reports: balanced, and with the signs of the paper."""

import re
from collections.abc import Iterator
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from garkcli.exact.display import to_latex
from garkcli.exact.domain import Domain
from garkcli.exact.expression import parse
from garkcli.tell.latex import Latex
from tests.cli.harness import gark

RUNS = [
    ("tableau", "methods/collocation.gark.yaml"),
    ("tableau", "methods/stoermer-verlet.gark.yaml"),
    ("tableau", "methods/three-colours.gark.yaml"),
    ("tableau", "tests/examples/valid/conjugate.gark.yaml"),
    ("conjugate", "methods/collocation.gark.yaml", "--pair"),
    ("conditions", "-n", "5"),
    ("conditions", "-N", "2", "-n", "3", "--coloured"),
    ("conditions", "methods/collocation-conjugate.gark.yaml", "-n", "3"),
    ("conditions", "methods/ark-ars222.gark.yaml", "-n", "3", "--failing"),
    ("trees", "-N", "2", "-n", "4"),
]


def latex(*arguments: str) -> str:
    """A LaTeX report, its comments left out."""
    run = gark(*arguments, "--format", "latex")
    assert run.code == 0, run.err
    return "\n".join(line for line in run.out.splitlines() if not line.startswith("%"))


def test_each_sign_of_the_glossary_has_a_form_in_latex() -> None:
    """LaTeX stops at any other sign than letters with accents and dashes."""
    left = {
        sign: path.name
        for path in Path("garkcli/glossary/data").glob("*.toml")
        for sign in Latex().prose(path.read_text("utf-8").replace("\n", " "))
        if sign > "\u017f" and sign not in "–—"
    }
    assert not left
    assert Latex().prose("b̂ b̄ μ ∫ Störmer") == r"$\hat b$ $\bar b$ $\mu$ $\int$ Störmer"


def unbalanced(text: str) -> Iterator[str]:
    """What is opened and not closed, or closed and not opened."""
    depth = 0
    for sign in re.findall(r"(?<!\\)[{}]", text):
        depth += 1 if sign == "{" else -1
        if depth < 0:
            yield "}"
    yield from "{" * depth
    stack: list[str] = []
    for kind, name in re.findall(r"\\(begin|end)\{(\w+)\*?\}", text):
        if kind == "begin":
            stack.append(name)
        elif not stack or stack.pop() != name:
            yield name
    yield from stack
    if len(re.findall(r"(?<!\\)\$", text)) % 2:
        yield "$"
    if text.count(r"\[") - len(re.findall(r"\\\\\[", text)) != text.count(r"\]"):
        yield "["


@pytest.mark.parametrize("arguments", RUNS, ids=" ".join)
def test_latex_is_balanced(arguments: tuple[str, ...]) -> None:
    """Braces, environments, dollars and displays are closed, and no sign outside LaTeX's reach is
    left.
    """
    text = latex(*arguments)
    assert text.strip()
    assert list(unbalanced(text)) == []
    assert "**" not in text
    assert "sqrt(" not in text


def test_absolute_values_are_formulas() -> None:
    """A bar in text is a dash in the fonts of LaTeX."""
    text = gark("stability", "rk4", "--format", "latex").out
    assert r"$|y|$ $\le$" in text
    assert "|" not in re.sub(r"\$[^$]*\$", "", text)
    assert Latex().prose("|R(∞)| < 1, a | b") == r"$|R(\infty)|$ $<$ 1, a $|$ b"


def test_the_check_for_balance_can_fail() -> None:
    """The helper of these tests notices what is not closed."""
    for text in ("{", "}", r"\begin{array}", r"\begin{a}\end{b}", "$x", r"\[x"):
        assert list(unbalanced(text)), text


def test_every_row_of_a_tableau_has_every_column() -> None:
    """The array of the collocation example has a node and 2 + 3 entries in each of its 2 + 3 + 1
    rows.
    """
    text = latex("tableau", "methods/collocation.gark.yaml")
    rows = [line for line in text.splitlines() if "&" in line]
    assert [row.count("&") for row in rows] == [5] * 6
    assert r"\begin{array}{c|cc|ccc}" in text
    assert r"\frac{1}{2}-\frac{\sqrt{3}}{6}" in text
    assert text.count(r"\hline") == 2


def test_conditions_carry_the_signs_of_the_paper() -> None:
    """Table 1: A^{l,m}, b^{l}, the componentwise product and the quantifier stand in the table."""
    text = latex("conditions", "-n", "3")
    for fragment in (
        r"A^{\{l,m\}}",
        r"b^{\{l\}}",
        r"\odot",
        r"\forall",
        r"\mathbbm{1}",
        r"[\tau,\tau]",
    ):
        assert fragment in text


numbers = st.sampled_from(
    ["0", "-1", "1/3", "-7/12", "sqrt(3)/6", "-sqrt(3)", "1/2 - sqrt(3)/6", "-1/2 + 5*sqrt(3)/4"]
)


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("0", "0"),
        ("-3", "-3"),
        ("-7/12", r"-\frac{7}{12}"),
        ("sqrt(3)", r"\sqrt{3}"),
        ("-sqrt(3)/6", r"-\frac{\sqrt{3}}{6}"),
        ("1/2 - 5*sqrt(3)/4", r"\frac{1}{2}-\frac{5\sqrt{3}}{4}"),
        ("cbrt(2)", r"\sqrt[3]{2}"),
        ("cbrt(2)**2", r"\sqrt[3]{2}^{2}"),
    ],
)
def test_a_number_in_latex(text: str, expected: str) -> None:
    """Signs, fractions and roots of a number, as the paper would print them."""
    expression = parse(text)
    assert to_latex(Domain([expression]).evaluate(expression)) == expected


@given(numbers, numbers)
def test_the_latex_of_every_sum_is_balanced(one: str, other: str) -> None:
    """No sign is doubled and no brace left open, whatever cancels."""
    expression = parse(f"({one}) - ({other})")
    text = to_latex(Domain([expression]).evaluate(expression))
    assert list(unbalanced(text)) == []
    assert not re.search(r"\+-|--|\+\+|-\+|^\+", text)


FOLDED = re.compile(r"p\{([0-9.]+)\\linewidth\}")


@given(st.lists(st.lists(st.integers(1, 200), min_size=4, max_size=4), min_size=1, max_size=50))
def test_tables_are_as_wide_as_a_page(rows: list[list[int]]) -> None:
    """Columns that are not folded take about a hundredth of a line a letter; a table that has room
    has none that is.
    """
    lines = [*Latex().grid("abcd", [["x" * n for n in row] for row in rows])]
    begin = next(x for x in lines if "\\begin" in x)
    widest = [max(column) for column in zip(*rows, strict=True)]
    shares = [float(x) for x in FOLDED.findall(begin)]
    kept = sorted(widest)[: 4 - len(shares)]
    assert sum(kept) / 100 + sum(shares) < 1
    assert bool(shares) is (sum(widest) + 10 > 96)
    assert any("endhead" in x for x in lines) is (len(rows) > 30)


def test_a_list_of_methods_goes_on_over_pages_with_short_references() -> None:
    text = latex("list", "methods", "--kind", "rk")
    assert text.count(r"\begin{longtable}") == text.count(r"\endhead") == 1
    assert FOLDED.search(text)
    assert "& Kutta 1901 " in text
