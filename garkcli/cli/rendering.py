"""A tableau in the format asked for."""

from __future__ import annotations

from garkcli.cli.options import Output
from garkcli.report.plain import printable
from garkcli.tableau.pointwise import entries
from garkcli.tableau.tableau import Tableau


def write_tableau(
    tableau: Tableau, name: str, digits: int, output: Output, is_rounded: bool
) -> None:
    """Write a tableau as text, JSON or LaTeX; rounded coefficients as decimals where people read
    them.
    """
    found = entries(tableau, digits)
    if output.format == "json":
        from garkcli.report import tableau_json

        output.write(tableau_json.render(tableau, found, name))
        return
    if is_rounded:
        from garkcli.report.tableau_text import readable

        found = readable(found)
    if output.format == "latex":
        from garkcli.report import tableau_latex

        output.write(tableau_latex.render(tableau, found, printable(name)))
    else:
        from garkcli.report import tableau_text

        output.write(
            tableau_text.render(tableau, found, printable(name), output.paint, output.width)
        )
