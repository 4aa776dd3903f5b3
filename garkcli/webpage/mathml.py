"""Formulas of reports as MathML; the input is LaTeX from the program, never the text of a file."""

from __future__ import annotations

import re
from functools import lru_cache

from flint import arb
from latex2mathml.converter import convert
from markupsafe import Markup

from garkcli.exact.display import to_decimal, to_latex, to_text
from garkcli.exact.field import Number
from garkcli.exact.parametric import Parametric
from garkcli.exact.rewriting import decimal_latex
from garkcli.ntrees.notation import condition_latex
from garkcli.ntrees.tree import Tree
from garkcli.page.cells import cell_text
from garkcli.reason import Place
from garkcli.tableau.pointwise import Cell
from garkcli.tell.html import Html
from garkcli.tell.latex import place_latex

_OPENING = re.compile(r"<math[^>]*>")
_NEEDLESS = re.compile(r"<mrow>(<(m[ino])[^>]*>[^<]*</\2>)</mrow>")
"""A group of a single element."""
_ONES = re.compile(r"\\mathbbm\{1\}")
_WEIGHTS = re.compile(r"\{b\^\{(\\\{[^{}]*\\\})\}\}\^T")
"""The transposed weights of a colour: both superscripts at the same height."""
_DOUBLE_ONE = "\U0001d7d9"
"""The vector of ones as in the paper, which MathML has as a letter."""
_MARKUP = frozenset("<>&")
"""Characters that do not occur in the formulas."""
_MOST_KEPT = 1 << 12
_LONGEST = 60
"""Longer exact numbers are shown as approximate decimals."""
_DIGITS = 8


_IN_WORDS = {
    "4D² − N²": r"4D^2-N^2", "A(α)": r"A(\alpha)", "B(r)": "B(r)", "C(η)": r"C(\eta)",
    "D(ζ)": r"D(\zeta)", "R(z)": "R(z)", "R(∞)": r"R(\infty)", "cos α": r"\cos\alpha",
    "R̂(z)": r"\hat R(z)", "R̂(∞)": r"\hat R(\infty)",
    "|R(z)| ≤ 1": r"\lvert R(z)\rvert\le 1", "q̈ = −ω²q": r"\ddot{q}=-\omega^2q", "r ≤": r"r\le",
    "|R(iy)| > 1": r"\lvert R(iy)\rvert\gt 1", "E(y²)": "E(y^2)", "x = y²": "x=y^2", "y²": "y^2",
    "x = (hω)²": r"x=(h\omega)^2", "(hω)²": r"(h\omega)^2", "x = (hω_fast)²":
    r"x=(h\omega_{\mathrm{fast}})^2", "(ωq)²": r"(\omega q)^2", "ωq p": r"\omega q\,p", "p²": "p^2",
    "B A + Aᵀ B − b bᵀ": r"BA+A^TB-bb^T", "tr M = N/D": r"\operatorname{tr}M=N/D",
    "|y|": r"\lvert y\rvert", "−z": "-z", "α": r"\alpha", "θ": r"\theta", "γ": r"\gamma",
    "|R(z1, z2)| ≤ 1": r"\lvert R(z_1,z_2)\rvert\le 1",
    "|R(z2, z1)| ≤ 1": r"\lvert R(z_2,z_1)\rvert\le 1", "|R| ≤ 1": r"\lvert R\rvert\le 1",
    "Re ≤ 0": r"\operatorname{Re}\le 0", "z ≤ 0": r"z\le 0", "y = 0": "y=0", "z = 0": "z=0",
}  # fmt: skip
"""Formulas within sentences, as LaTeX."""
_ANY_IN_WORDS = re.compile("|".join(map(re.escape, sorted(_IN_WORDS, key=len, reverse=True))))


class Typeset(Html):
    def prose(self, text: str) -> str:
        parts = _ANY_IN_WORDS.split(text)
        formulas = [str(typeset(_IN_WORDS[x], x)) for x in _ANY_IN_WORDS.findall(text)]
        return "".join(
            super(Typeset, self).prose(x) + y for x, y in zip(parts, [*formulas, ""], strict=True)
        )

    def formula(self, latex: str, text: str) -> str:
        return str(typeset(latex, text))

    def place(self, place: Place) -> str:
        if not all(name.isalnum() for name in place.colours):
            return super().place(place)
        return self.formula(place_latex(place), str(place))


@lru_cache(maxsize=_MOST_KEPT)
def typeset(latex: str, text: str = "") -> Markup:
    r"""Returns an inline formula; ``text`` is read and copied in its place.

    >>> print(typeset(r"\frac{1}{2}", "1/2"))
    <math alttext="1/2"><mfrac><mn>1</mn><mn>2</mn></mfrac></math>
    """
    if set(latex) & _MARKUP:  # which the converter would hand through
        return Markup("<math><mtext>{}</mtext></math>").format(latex)
    found = convert(_ONES.sub(_DOUBLE_ONE, latex))
    found = _OPENING.sub("", found, count=1).removeprefix("<mrow>").removesuffix("</mrow></math>")
    inside = Markup(_NEEDLESS.sub(r"\1", found))
    if not text:
        return Markup("<math>{}</math>").format(inside)
    return Markup('<math alttext="{}">{}</math>').format(text, inside)


def typeset_condition(tree: Tree, has_colours: bool) -> Markup:
    return typeset(_WEIGHTS.sub(r"b^{\1 T}", condition_latex(tree, colours=has_colours)))


def typeset_cell(cell: Cell, digits: int) -> Markup:
    if isinstance(cell, arb):
        return typeset(decimal_latex(cell_text(cell, digits)))
    return typeset(to_latex(cell), to_text(cell))


def typeset_number(value: Number | Parametric) -> Markup:
    """Returns a weight or a residual, exact if short and approximate otherwise."""
    text = str(value) if isinstance(value, Parametric) else to_text(value)
    if isinstance(value, Parametric) or len(text) <= _LONGEST:
        return typeset(to_latex(value), text)
    return typeset(rf"\approx {decimal_latex(to_decimal(value, _DIGITS))}")
