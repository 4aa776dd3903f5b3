"""``gark tableau``."""

from __future__ import annotations

import click

from garkcli.cli.method_argument import file_argument
from garkcli.cli.options import (
    CONTEXT,
    Output,
    common,
    digits_option,
    document_option,
    settings_option,
)
from garkcli.errors import HasFreeParameters


@click.command("tableau", context_settings=CONTEXT)
@file_argument()
@digits_option("Decimals of N digits; by default exact, or 17 digits.")
@document_option
@settings_option
@common(["text", "yaml", "json", "latex"])
def command(
    file: str, digits: int | None, document: bool, settings: dict[str, str], output: Output
) -> int:
    """The assembled tableau, all blocks.

    Entries are exact where the nodes are rational or quadratic numbers, decimals otherwise. With
    --format yaml it is a method file that loads again. LaTeX shows a method for positions and
    momenta as two arrays, Q and P. Entries of a file with free parameters are rational functions of
    these.
    """
    from garkcli.cli.rendering import write_tableau
    from garkcli.methodfile.load import load

    try:
        method = load(file, settings)
    except HasFreeParameters as error:
        from garkcli.cli.every import write_family

        write_family(error, settings, None, digits, output, document)
        return 0
    write_tableau(
        method.tableau, method.name, digits, output, method.tolerance, document, method.further
    )
    return 0
