"""Formulas of reports as MathML, as browsers and screen readers know it.

What comes in is LaTeX that the program writes itself, never the text of a file.
"""

from __future__ import annotations

import re
from functools import lru_cache

from flint import arb
from latex2mathml.converter import convert
from markupsafe import Markup

from garkcli.exact.display import to_decimal, to_latex, to_text
from garkcli.exact.field import Number
from garkcli.exact.parametric import Parametric
from garkcli.page.cells import cell_text
from garkcli.page.latex import number
from garkcli.tableau.pointwise import Cell
from garkcli.trees.notation import condition_latex
from garkcli.trees.tree import Tree

_OPENING = re.compile(r"<math[^>]*>")
_NEEDLESS = re.compile(r"<mrow>(<(m[ino])[^>]*>[^<]*</\2>)</mrow>")
"""A group of a single sign."""
_ONES = re.compile(r"\\mathbbm\{1\}")
_WEIGHTS = re.compile(r"\{b\^\{(\\\{[^{}]*\\\})\}\}\^T")
"""The transposed weights of a colour: both above, at the same height."""
_DOUBLE_ONE = "\U0001d7d9"
"""The vector of ones as the paper has it, which MathML has as a letter."""
_MARKUP = frozenset("<>&")
"""Signs that no formula of ours has."""
_MOST_KEPT = 1 << 12
_LONGEST = 60
"""Signs of an exact number; longer ones are shown in decimals beside which that is said."""
_DIGITS = 8


@lru_cache(maxsize=_MOST_KEPT)
def typeset(latex: str) -> Markup:
    r"""A formula within a line.

    >>> print(typeset(r"\frac{1}{2}"))
    <math><mfrac><mn>1</mn><mn>2</mn></mfrac></math>
    """
    if set(latex) & _MARKUP:  # which the converter would hand through
        return Markup("<math><mtext>{}</mtext></math>").format(latex)
    text = convert(_ONES.sub(_DOUBLE_ONE, latex))
    text = _OPENING.sub("<math>", text, count=1)
    text = text.replace("<math><mrow>", "<math>", 1)
    text = text.removesuffix("</mrow></math>") + "</math>"
    return Markup(_NEEDLESS.sub(r"\1", text))


def typeset_condition(tree: Tree, has_colours: bool) -> Markup:
    """The order condition of a tree in the paper's notation."""
    return typeset(_WEIGHTS.sub(r"b^{\1 T}", condition_latex(tree, colours=has_colours)))


def typeset_cell(cell: Cell, digits: int) -> Markup:
    """An entry of a tableau: exact, or as a decimal of so many digits."""
    if isinstance(cell, arb):
        return typeset(number(cell_text(cell, digits)))
    return typeset(to_latex(cell))


def typeset_number(value: Number | Parametric) -> Markup:
    """A weight or a residual: exact where it is short, else about how large it is."""
    if isinstance(value, Parametric) or len(to_text(value)) <= _LONGEST:
        return typeset(to_latex(value))
    about = number(to_decimal(value, _DIGITS))
    return typeset(rf"\approx {about}")
