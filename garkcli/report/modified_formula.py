"""The modified Hamiltonian or equation of a problem as text and LaTeX."""

from __future__ import annotations

from collections.abc import Sequence

from garkcli.backward.formulas import ModifiedFormula, PowerTerm
from garkcli.page.paint import Paint, folded, indented
from garkcli.report.modified_data import formula_text, unknowns_of
from garkcli.report.problem import describe

_WIDTH = 80
_LABEL = 8  # columns of what stands before a formula


def formula_lines(formula: ModifiedFormula, paint: Paint) -> list[str]:
    """The formula by powers of h."""
    is_hamiltonian = formula.of == "hamiltonian"
    noun = "Hamiltonian" if is_hamiltonian else "equation"
    highest = formula.max_order - 1
    problem = describe(formula.problem)
    about = folded(problem, _WIDTH - 4, "  ")
    lines = [f"  modified {noun}, up to h^{highest}, of"]
    lines += indented(about, "    ")
    if is_hamiltonian:
        return lines + _hamiltonian_lines(formula)
    return lines + _equation_lines(formula, paint)


def _hamiltonian_lines(formula: ModifiedFormula) -> list[str]:
    """H, and what is added to it with each power of h."""
    lines = []
    for term in formula.terms:
        label = f"h^{term.power}" if term.power else "H"
        text = formula_text(term.formulas[0])
        lines += _labelled(label, text)
    return lines


def _equation_lines(formula: ModifiedFormula, paint: Paint) -> list[str]:
    """Below each power of h its terms in the derivatives of the unknowns."""
    unknowns = unknowns_of(formula)
    lines = []
    for term in formula.terms:
        lines.append(paint("strong", f"  h^{term.power}"))
        for unknown, component in zip(unknowns, term.formulas, strict=True):
            text = formula_text(component)
            lines += _labelled(f"{unknown}'", text)
    return lines


def _labelled(label: str, text: str) -> list[str]:
    margin = 4 + _LABEL
    blanks = " " * margin
    first, *rest = folded(text, _WIDTH - margin, "")
    lines = [f"    {label:<{_LABEL}}{first}"]
    lines += indented(rest, blanks)
    return lines


def formula_latex(formula: ModifiedFormula) -> str:
    """The formula as an ``align*``."""
    left_sides = [r"\tilde H"]
    if formula.of != "hamiltonian":
        unknowns = unknowns_of(formula)
        left_sides = [rf"\dot{{{unknown}}}" for unknown in unknowns]
    rows = []
    for component, left in enumerate(left_sides):
        rows.append(_latex_row(left, formula.terms, component))
    body = " \\\\\n".join(rows)
    return f"\\begin{{align*}}\n{body}\n\\end{{align*}}\n"


def _latex_row(left: str, terms: Sequence[PowerTerm], component: int) -> str:
    import sympy

    parts = []
    for term in terms:
        written = sympy.latex(term.formulas[component])
        if written == "0":
            continue
        if term.power:
            written = rf"h^{{{term.power}}} \Bigl({written}\Bigr)"
        parts.append(written)
    joined = " \\\\\n    &\\quad + ".join(parts) or "0"
    return f"  {left} &= {joined}"
