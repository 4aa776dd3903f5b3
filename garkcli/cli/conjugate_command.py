"""``gark conjugate``."""

from __future__ import annotations

import click

from garkcli.cli.companion import companion
from garkcli.cli.method_argument import file_argument
from garkcli.cli.options import (
    CONTEXT,
    Output,
    common,
    digits_option,
    document_option,
    settings_option,
)
from garkcli.errors import HasFreeParameters, UsageProblem


@click.command("conjugate", context_settings=CONTEXT)
@file_argument()
@click.option("--pair", "is_pair", is_flag=True, help="The symplectic pair, 2N colours, instead.")
@digits_option("Decimals of N digits; by default exact, or 17 digits.")
@document_option
@settings_option
@common(["text", "yaml", "json", "latex"])
def command(
    file: str,
    is_pair: bool,
    digits: int | None,
    document: bool,
    settings: dict[str, str],
    output: Output,
) -> int:
    """The symplectic conjugate tableau of a method.

    With --format yaml it is a method file that loads again; conjugated again it gives the original
    blocks exactly. Where the nodes have no simple radicals that file says `conjugate: true` instead
    of entries. Entries of a file with free parameters are rational functions of these.
    """
    from garkcli.methodfile.load import load

    which = "pair" if is_pair else "conjugate"
    try:
        method = load(file, settings)
    except HasFreeParameters as error:
        from garkcli.cli.every import write_family

        write_family(error, settings, which, digits, output, document)
        return 0
    name = f"symplectic {which} of {method.name}"
    made = companion(method.tableau, which)
    from garkcli.cli.rendering import write_tableau

    if method.further:
        output.note(f"the embedded weights and the dense output are left out: the {which} has none")
    if output.format != "yaml" or digits is not None or document:
        write_tableau(made, name, digits, output, method.tolerance, document)
        return 0
    from garkcli.methodfile.conjugated import write_conjugate_of
    from garkcli.methodfile.writer import can_spell_out, write_tableau_file
    from garkcli.tableau.pointwise import in_points

    exact = in_points(made)
    if exact is not None and (is_pair or can_spell_out(exact)):
        output.write(write_tableau_file(exact, name, method.tolerance))
    elif is_pair:
        raise UsageProblem(
            "the nodes have no simple radicals, so the pair cannot be spelled out exactly",
            "gark check reports on the pair; --format json gives decimals",
        )
    else:
        output.note(
            "the conjugate is described by the key conjugate: true, exactly, not spelled out"
        )
        output.write(write_conjugate_of(method, name))
    return 0
