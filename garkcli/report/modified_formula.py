"""The modified Hamiltonian or equation of a problem as text and LaTeX."""

from __future__ import annotations

from collections.abc import Sequence

from garkcli.backward.formulas import ModifiedFormula, PowerTerm
from garkcli.page.paint import Paint, folded, indented
from garkcli.report.modified_data import formula_text, unknowns_of
from garkcli.report.problem_text import describe

_WIDTH = 80
_LABEL = 8  # columns of what stands before a formula


def formula_lines(formula: ModifiedFormula, paint: Paint) -> list[str]:
    """The formula by powers of h."""
    noun = "Hamiltonian" if formula.of == "hamiltonian" else "equation"
    lines = [f"  modified {noun}, up to h^{formula.max_order - 1}, of"]
    about = folded(describe(formula.problem), _WIDTH - 4, "  ")
    lines += indented(about, "    ")
    if formula.of == "hamiltonian":
        for term in formula.terms:
            label = f"h^{term.power}" if term.power else "H"
            lines += _labelled(label, formula_text(term.formulas[0]))
        return lines
    unknowns = unknowns_of(formula)
    for term in formula.terms:
        lines.append(paint("strong", f"  h^{term.power}"))
        for unknown, component in zip(unknowns, term.formulas, strict=True):
            lines += _labelled(f"{unknown}'", formula_text(component))
    return lines


def _labelled(label: str, text: str) -> list[str]:
    margin = 4 + _LABEL
    first, *rest = folded(text, _WIDTH - margin, "")
    lines = [f"    {label:<{_LABEL}}{first}"]
    lines += indented(rest, " " * margin)
    return lines


def formula_latex(formula: ModifiedFormula) -> str:
    """The formula as an ``align*``."""
    if formula.of == "hamiltonian":
        rows = [_latex_row(r"\tilde H", formula.terms, 0)]
    else:
        rows = []
        for i, unknown in enumerate(unknowns_of(formula)):
            rows.append(_latex_row(rf"\dot{{{unknown}}}", formula.terms, i))
    return "\\begin{align*}\n" + " \\\\\n".join(rows) + "\n\\end{align*}\n"


def _latex_row(left: str, terms: Sequence[PowerTerm], component: int) -> str:
    import sympy

    parts = []
    for term in terms:
        written = sympy.latex(term.formulas[component])
        if written == "0":
            continue
        power = "" if term.power == 0 else f"h^{{{term.power}}} "
        parts.append(rf"{power}\Bigl({written}\Bigr)" if power else written)
    joined = " \\\\\n    &\\quad + ".join(parts) or "0"
    return f"  {left} &= {joined}"
