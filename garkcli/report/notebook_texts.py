"""How a notebook shows what has a report in text: the report, as it is printed."""

from __future__ import annotations

from html import escape
from typing import TYPE_CHECKING

from garkcli.page.paint import Paint
from garkcli.page.plain import printable

if TYPE_CHECKING:
    from collections.abc import Iterable

    from garkcli.backward.formulas import ModifiedFormula
    from garkcli.backward.summary import BackwardAnalysis
    from garkcli.stability.linear import StabilityFunction
    from garkcli.stability.summary import Stability

_PLAIN = Paint()


def stability_latex(found: Stability) -> str:
    """R(z), and the step matrix on the oscillator, as formulas."""
    from garkcli.report.stability import formulas

    lines = " \\\\\n".join(f"{name} &= {value}" for name, value in formulas(found))
    return f"\\begin{{align*}}\n{lines}\n\\end{{align*}}\n"


def function_latex(R: StabilityFunction) -> str:
    """R(z) as a formula."""
    from garkcli.exact.polynomial_text import integral
    from garkcli.page.exactly import polynomial_latex

    over, under = (polynomial_latex(p, "z") for p in integral([R.numerator, R.denominator]))
    fraction = over if under == "1" else rf"\frac{{{over}}}{{{under}}}"
    return f"$R(z) = {fraction}$"


def backward_html(found: BackwardAnalysis) -> str:
    """What ``gark modified`` prints."""
    from garkcli.report.modified import text_of
    from garkcli.report.modified_data import ModifiedReport

    return preformatted(text_of(ModifiedReport("", "", found), _PLAIN))


def formula_latex(formula: ModifiedFormula) -> str:
    """The modified Hamiltonian or equation, multiplied out."""
    from garkcli.report.modified_formula import formula_latex as written

    return written(formula.expanded())


def preformatted(lines: Iterable[str]) -> str:
    """Lines as they stand, in letters of one width."""
    text = "\n".join(printable(line) for line in lines).strip("\n")
    style = "font-family:monospace;line-height:1.25"
    return f'<pre style="{style}">{escape(text)}</pre>'
