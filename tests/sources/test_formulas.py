"""Formulas of Mathematica, LaTeX and texts, against the numbers of method files."""

from __future__ import annotations

import pytest

from garkcli.bridges.readers import json_data, latex, mathematica
from garkcli.exact.domain import Domain
from garkcli.exact.expression import parse
from garkcli.sources.found import FoundTable

MATHEMATICA = {
    "-3^2/2 (1 + 2)": "-27/2",
    "2 Sqrt[3]/(1/3)": "6*sqrt(3)",
    "2^-1 - 1.5*^-1": "7/20",
    "Surd[-8, 3] + CubeRoot[27]": "1",
    "Root[#^3 - 2 # - 1 &, 3] (* the last *)": "1/2 + sqrt(5)/2",
    "Rational[1, 3] + Power[2, 1/2]": "1/3 + sqrt(2)",
    "N[1/4, 20] +\n 1/4": "1/2",
}
TEX = {
    r"-\frac12\sqrt{3}\left(1 + \frac{1}{\sqrt[3]{8}}\right)": "-3*sqrt(3)/4",
    r"1.5 \cdot 10^{-2}": "3/200",
    r"\tfrac{\sqrt{2}}{\dfrac{1}{3}}": "3*sqrt(2)",
    r"$2 \times 3^{2}$": "18",
}
TEXTS = {
    "root_of(x**2 - 2, 1.4142)/(1/3)": "3*sqrt(2)",
    "root(2, 3)**3 - 2**-1": "3/2",
    "-(1 - 2)": "1",
}


def _is_same(table: FoundTable, wanted: str) -> bool:
    assert table.trouble == ""
    matrix = table.A[0][0]
    assert matrix is not None
    texts = [parse(matrix[1][0]), parse(wanted)]
    found, other = map(Domain(texts).evaluate, texts)
    return bool(found == other)


@pytest.mark.parametrize("text", MATHEMATICA)
def test_mathematica(text: str) -> None:
    """Precedence, implicit products, roots and precisions."""
    source = f'm = <|"A" -> {{{{0, 0}}, {{{text}, 0}}}}, "b" -> {{1/2, 1/2}}|>'
    (table,) = mathematica.find(source, "x")
    assert _is_same(table, MATHEMATICA[text])


@pytest.mark.parametrize("text", TEX)
def test_latex(text: str) -> None:
    """Fractions of one sign, roots in fractions, powers of ten."""
    rows = rf"0 & & \\ 1 & {text} & \\ \hline & 1/2 & 1/2"
    (table,) = latex.READER.find(rf"\begin{{array}}{{c|cc}} {rows} \end{{array}}", "x")
    assert _is_same(table, TEX[text])


@pytest.mark.parametrize("text", TEXTS)
def test_texts(text: str) -> None:
    """What gark writes into JSON and CSV."""
    (table,) = json_data.READER.find(f'{{"A": [[0, 0], ["{text}", 0]], "b": ["1/2", 0.5]}}', "x")
    assert _is_same(table, TEXTS[text])


@pytest.mark.parametrize(
    "text", ["f[2]", "", "]", "1 2 +", "k", "{1, 2", "1/0", "Root[#^2 + 1 &, 1]"]
)
def test_what_has_no_value_is_not_known(text: str) -> None:
    """The table is told as unread, and no entry is a zero."""
    source = f"A = {{{{0, 0}}, {{{text}, 0}}}}; b = {{1/2, 1/2}}; c = {{0, 1}};"
    for table in mathematica.find(source, "x"):
        assert table.trouble
