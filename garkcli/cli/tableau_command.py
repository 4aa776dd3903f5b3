"""``gark tableau``."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

from garkcli.cli.companion import companion
from garkcli.cli.options import Output, declared
from garkcli.errors import HasFreeParameters, UsageProblem
from garkcli.tell.report import FORMATS

if TYPE_CHECKING:
    from garkcli.methodfile.build import MethodFile
    from garkcli.tableau.garkmethod import Derivation, GarkMethod


@declared("tableau", (*FORMATS, "yaml"))
def command(
    file: str,
    which: Derivation | None,
    digits: int | None,
    document: bool,
    settings: dict[str, str],
    output: Output,
) -> int:
    """The assembled tableau, all blocks.

    Entries are exact where the nodes are rational or quadratic numbers, decimals otherwise. With
    --format yaml it is a method file that loads again. LaTeX shows a method for positions and
    momenta as two arrays, Q and P. Entries of a file with free parameters are rational functions of
    these.
    """
    show(file, which, digits, document, settings, output)
    return 0


def show(
    file: str,
    which: Derivation | None,
    digits: int | None,
    document: bool,
    settings: Mapping[str, str],
    output: Output,
) -> None:
    """Write the tableau of a method, or of its conjugate or pair, in the format asked for.

    Raises:
        UsageProblem: no method file spells it out, or numbers are asked of free parameters.
        ZeroWeight: a conjugate would divide by zero.
    """
    from garkcli.cli.rendering import write_tableau
    from garkcli.methodfile.load import load

    try:
        method = load(file, settings)
    except HasFreeParameters as error:
        from garkcli.cli.every import write_family

        write_family(error, settings, which, digits, output, document)
        return
    shown = companion(method, which)
    if which is not None and method.further:
        output.note(f"the embedded weights and the dense output are left out: the {which} has none")
    if which is not None and output.format == "yaml" and digits is None and not document:
        _write_derived(method, shown, output)
        return
    write_tableau(
        shown.tableau,
        shown.name,
        digits,
        output,
        shown.tolerance,
        document,
        shown.further,
        shown.derivation,
    )


def _write_derived(method: MethodFile, made: GarkMethod, output: Output) -> None:
    """Write the method file of a conjugate or a pair.

    Raises:
        UsageProblem: the nodes of a pair have no simple radicals.
    """
    from garkcli.methodfile.conjugated import write_conjugate_of
    from garkcli.methodfile.writer import can_spell_out, write_tableau_file
    from garkcli.tableau.pointwise import in_points

    is_pair = made.derivation == "pair"
    exact = in_points(made.tableau)
    if exact is not None and (is_pair or can_spell_out(exact)):
        output.write(write_tableau_file(exact, made.name, made.tolerance))
    elif is_pair:
        raise UsageProblem(
            "the nodes have no simple radicals, so the pair cannot be spelled out exactly",
            "gark check reports on the pair; --format json gives decimals",
            code="no-radicals",
        )
    else:
        output.note(
            "the conjugate is described by the key conjugate: true, exactly, not spelled out"
        )
        output.write(write_conjugate_of(method, made.name))
