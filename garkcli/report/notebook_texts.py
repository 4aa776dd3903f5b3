"""How a notebook shows stability: formulas."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from garkcli.stability.linear import StabilityFunction
    from garkcli.stability.summary import Stability


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
