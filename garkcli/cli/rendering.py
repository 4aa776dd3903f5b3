"""A tableau in the format asked for."""

from __future__ import annotations

from flint import fmpq

from garkcli.cli.options import Output, check_document
from garkcli.errors import UsageProblem
from garkcli.page.plain import printable
from garkcli.tableau.embedded import NOTHING, Further
from garkcli.tableau.garkmethod import Derivation
from garkcli.tableau.pointwise import Entries, entries, in_points
from garkcli.tableau.tableau import Tableau

DEFAULT_DIGITS = 17
"""Digits of entries that have no simple radicals, where none are asked for."""


def write_tableau(
    tableau: Tableau,
    name: str,
    digits: int | None,
    output: Output,
    tolerance: fmpq | None,
    is_document: bool = False,
    further: Further = NOTHING,
    derivation: Derivation = "",
) -> None:
    """Write a tableau as text, YAML, JSON or LaTeX.

    Args:
        tableau: any.
        name: what it is called.
        digits: the digits of all entries; None for exact entries where the nodes have simple
            radicals.
        output: where to, and in which format.
        tolerance: the rounding that the file admits; its long fractions are decimals where people
            read them.
        is_document: whether LaTeX gets a preamble.
        further: its embedded weights and its dense output.
        derivation: whether it is the conjugate or the pair of what a file gives.

    Raises:
        UsageProblem: no preamble belongs to the format, or no method file says the tableau.
    """
    check_document(is_document, output.format)
    if output.format == "yaml":
        output.write(_method_file(tableau, name, digits, tolerance, further))
        return
    from garkcli.report.tableau import REPORT, Shown

    found = shown_entries(tableau, digits, further)
    shown = Shown(tableau, found, name, derivation, tolerance is not None)
    if output.format == "latex":
        from garkcli.page import tableau_latex

        text = tableau_latex.render(tableau, shown.readable, printable(name), is_document)
        output.write(text)
    else:
        output.tell(REPORT, [shown])


def shown_entries(tableau: Tableau, digits: int | None, further: Further = NOTHING) -> Entries:
    """The entries of a tableau and of what is beside it: exact ones, or of so many digits."""
    found = entries(tableau, digits or DEFAULT_DIGITS).beside(further)
    return found if digits is None else found.in_decimals(digits)


def refuse_partitioned(tableau: Tableau) -> None:
    """Refuse what a method file has no form for.

    Raises:
        UsageProblem: it is partitioned, and no pair (q, p).
    """
    from garkcli.methodfile.writer import can_spell_out

    if not can_spell_out(tableau):
        raise UsageProblem(
            "a method file spells out a GARK tableau or one pair (q, p), not this partitioned one",
            "--format json has all of its blocks",
            code="cannot-convert",
        )


def _method_file(
    tableau: Tableau, name: str, digits: int | None, tolerance: fmpq | None, further: Further
) -> str:
    from garkcli.methodfile.writer import write_rounded, write_tableau_file

    refuse_partitioned(tableau)
    if digits is not None:
        found = shown_entries(tableau, digits)
        return write_rounded(tableau, found, name, further)
    exact = in_points(tableau)
    if exact is None:
        raise UsageProblem(
            "the nodes have no simple radicals, so the tableau cannot be spelled out exactly",
            f"--digits {DEFAULT_DIGITS} writes decimals",
            code="no-radicals",
        )
    return write_tableau_file(exact, name, tolerance, further=further)
