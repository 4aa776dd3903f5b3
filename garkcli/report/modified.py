"""``gark modified`` as text, JSON or LaTeX."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from itertools import groupby

from garkcli.backward.summary import Reached
from garkcli.exact.display import decimal, to_decimal, to_latex, to_text
from garkcli.exact.field import Number
from garkcli.page.latex import fragment, number
from garkcli.page.paint import Paint, counted, folded, indented
from garkcli.report.modified_data import ModifiedReport, TreeTerm, render_json
from garkcli.report.modified_formula import formula_latex, formula_lines
from garkcli.report.trees import picture
from garkcli.trees.notation import format_latex, format_tree

MOST_CHARACTERS = 24
"""Longer numbers are shown in decimals."""
_WIDTH = 80
_TREE = 30  # columns of a tree beside its numbers
_DIGITS = 10
_UNDECIDED = "not decided"
_FORMLESS = "no Hamiltonian problem has its form"


def render(
    report: ModifiedReport,
    format: str,
    paint: Paint,
    is_long: bool = True,
    is_document: bool = False,
) -> Iterator[str]:
    """The report as pieces of text.

    Args:
        report: what was found.
        format: text, json or latex.
        paint: colour or none.
        is_long: whether text has the coefficients too.
        is_document: whether LaTeX gets a preamble.
    """
    if format == "json":
        yield render_json(report)
    elif format == "latex":
        yield from fragment(_latex(report), is_document)
    else:
        for line in text_of(report, paint, is_long):
            yield line + "\n"


def text_of(report: ModifiedReport, paint: Paint, is_long: bool = True) -> list[str]:
    """The lines of the report."""
    lines = [paint("strong", report.name or report.file)]
    lines += indented(_head(report))
    lines.append("")
    for label, text in _orders(report):
        first, *rest = folded(text, _WIDTH - 21, "")
        lines.append(f"  {label:<19}{first}")
        lines += indented(rest, " " * 21)
    if not is_long:
        return lines
    if report.formula is not None:
        return [*lines, "", *formula_lines(report.formula, paint)]
    hamiltonian = report.hamiltonian
    if hamiltonian is not None:
        title = "modified Hamiltonian: Σ h^(ρ−1) b(u)/|Aut| H(u)"
        lines += ["", *_table(report, title, hamiltonian, "|Aut|", paint)]
    if hamiltonian is None or report.with_equation:
        title = "modified equation: Σ h^(ρ−1) b(u)/σ F(u)"
        lines += ["", *_table(report, title, report.equation, "σ", paint)]
    return lines


def _head(report: ModifiedReport) -> list[str]:
    """What the report is about."""
    vertices = counted_vertices(report.found.equation.max_order)
    lines = [f"{counted(len(report.names), 'colour')}; trees of up to {vertices}"]
    numbers = [str(l) for l, _ in enumerate(report.names, start=1)]
    if list(report.names) != numbers:
        pairs = map(" ".join, zip(numbers, report.names, strict=True))
        lines.append(f"colours: {', '.join(pairs)}")
    if report.found.tolerance is not None:
        near = decimal(report.found.tolerance)
        lines.append(f"rounded to {near}: coefficients of the digits as they are given")
    return lines


def counted_vertices(count: int) -> str:
    """A number of vertices in words."""
    return "1 vertex" if count == 1 else f"{count} vertices"


def _orders(report: ModifiedReport) -> Iterator[tuple[str, str]]:
    """Each order with its label."""
    found = report.found
    order = _order(found.order)
    formless = _FORMLESS
    if found.tolerance is not None:
        order += f", within {decimal(found.tolerance)}"
        formless = _UNDECIDED
    yield "order", order
    yield "symplectic", _symplectic(report)
    yield "energy order", _order(found.energy, formless)
    yield "effective order", _order(found.effective)


def _symplectic(report: ModifiedReport) -> str:
    found = report.found
    if found.is_symplectic and found.tolerance is not None:
        return f"within {decimal(found.tolerance)}"
    if found.is_symplectic:
        return "yes, by its coefficients"
    if found.tolerance is not None:
        return f"not within {decimal(found.tolerance)}"
    if found.symplectic is None:
        return _FORMLESS
    return f"to order {_order(found.symplectic)}"


def _order(reached: Reached | None, missing: str = _UNDECIDED) -> str:
    """An order in words, or what is said where there is none."""
    if reached is None:
        return missing
    if reached.is_lower_bound:
        return f"at least {reached.order}"
    return str(reached.order)


def _table(
    report: ModifiedReport, title: str, terms: Iterable[TreeTerm], symmetry: str, paint: Paint
) -> list[str]:
    """The terms below their powers of h."""
    heading = _row("u", symmetry, "b(u)", "factor")
    lines = [f"  {title}", heading.rstrip()]
    for order, group in groupby(terms, key=lambda term: term.tree.order):
        lines.append(paint("strong", f"  h^{order - 1}"))
        for term in group:
            lines += _entry(report, term)
    return lines


def _row(tree: str, symmetry: str, coefficient: str, factor: str) -> str:
    return f"    {tree:<{_TREE}} {symmetry:>6} {coefficient:>18} {factor:>18}"


def _entry(report: ModifiedReport, term: TreeTerm) -> list[str]:
    """One term: on a line, or a long tree above its numbers."""
    has_colours = len(report.names) > 1
    tree = format_tree(term.tree, has_colours)
    symmetry = str(term.symmetry)
    coefficient = _short(report, term.coefficient)
    factor = _short(report, term.factor)
    row = _row(tree, symmetry, coefficient, factor)
    if len(row) < _WIDTH:
        return [row]
    above = folded(tree, _WIDTH - 4, "  ")
    below = _row("", symmetry, coefficient, factor)
    if len(below) >= _WIDTH:
        numbers = f"{symmetry}   {coefficient}   {factor}"
        below = numbers.rjust(_WIDTH - 1)
    return [*indented(above, "    "), below]


def _short(report: ModifiedReport, value: Number) -> str:
    """A coefficient, in decimals where its exact form is long."""
    if report.digits is not None:
        return to_decimal(value, report.digits)
    text = to_text(value)
    if len(text) > MOST_CHARACTERS:
        return f"~ {to_decimal(value, _DIGITS)}"
    return text


def _latex(report: ModifiedReport) -> Iterator[str]:
    if report.formula is not None:
        yield formula_latex(report.formula)
        return
    hamiltonian = report.hamiltonian
    if hamiltonian is not None:
        yield from _latex_table(report, hamiltonian, r"|\mathrm{Aut}|")
    if hamiltonian is None or report.with_equation:
        yield from _latex_table(report, report.equation, r"\sigma(u)")


def _latex_table(report: ModifiedReport, terms: Iterable[TreeTerm], symmetry: str) -> Iterator[str]:
    head = ["", "$u$", r"$\rho(u)$", f"${symmetry}$", "$b(u)$", f"$b(u)/{symmetry}$"]
    yield "\\begin{longtable}{clcccc}\n  \\hline\n"
    yield f"  {' & '.join(head)} \\\\ \\hline\n"
    has_colours = len(report.names) > 1
    for term in terms:
        cells = [
            picture(term.tree, colours=has_colours),
            f"${format_latex(term.tree, has_colours)}$",
            str(term.tree.order),
            str(term.symmetry),
            f"${_latex_number(report, term.coefficient)}$",
            f"${_latex_number(report, term.factor)}$",
        ]
        yield f"  {' & '.join(cells)} \\\\[4pt]\n"
    yield "  \\hline\n\\end{longtable}\n"


def _latex_number(report: ModifiedReport, value: Number) -> str:
    if report.digits is None:
        return to_latex(value)
    return number(to_decimal(value, report.digits))
