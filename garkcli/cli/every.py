"""Files with free parameters in commands that show a method: what they say of every value."""

from __future__ import annotations

from collections.abc import Mapping

from garkcli.check.every_family import EveryFamily, every_family
from garkcli.cli.companion import companion
from garkcli.cli.options import Output
from garkcli.cli.rendering import refuse_partitioned, write_tableau
from garkcli.errors import HasFreeParameters, MethodError, UsageProblem
from garkcli.methodfile.family import FamilyFile, family_of
from garkcli.tableau.garkmethod import Derivation, derived_name
from garkcli.tableau.tableau import Tableau


def read_family(
    error: HasFreeParameters, settings: Mapping[str, str]
) -> tuple[FamilyFile, EveryFamily]:
    """The family of a file, from the refusal to read it as a method.

    Raises:
        UsageProblem: it is not said for every value.
    """
    file = family_of(error, settings)
    try:
        return file, every_family(file)
    except MethodError as refusal:
        raise UsageProblem(refusal.message, refusal.help, code=refusal.code) from None


def refuse_numbers(family: EveryFamily, options: Mapping[str, object]) -> None:
    """Refuse options that need numbers.

    Args:
        family: with free parameters.
        options: their values by their names; falsy ones were not given.

    Raises:
        UsageProblem: one of them was.
    """
    name = family.family.parameters[0]
    for option, value in options.items():
        if value:
            message = f"{option} needs numbers, and {name} is free"
            raise UsageProblem(message, f"choose a value: --set {name}=1/2", code="free-parameters")


def write_family(
    error: HasFreeParameters,
    settings: Mapping[str, str],
    which: Derivation | None,
    digits: int | None,
    output: Output,
    is_document: bool,
) -> None:
    """Write the tableau of a family, its entries rational functions of the parameters.

    Args:
        error: the refusal to read the file as a method.
        settings: values of other parameters.
        which: "conjugate" or "pair"; None for the method as it stands.
        digits: of decimals, which there are none of.
        output: where to, and in which format.
        is_document: whether LaTeX gets a preamble.

    Raises:
        UsageProblem: the nodes have no simple radicals, or numbers are asked for.
    """
    file, family = read_family(error, settings)
    refuse_numbers(family, {"--digits": digits})
    shown = family.printed(companion(family.tableau, which))
    if shown is None:
        raise UsageProblem(
            "the nodes have no simple radicals beside free parameters",
            f"choose a value: --set {file.parameters[0]}=1/2",
            code="no-radicals",
        )
    if file.further:
        name_of_one = file.parameters[0]
        output.note(
            "the embedded weights and the dense output are left out; with "
            f"values there are: --set {name_of_one}=1/2"
        )
    name = file.name if which is None else derived_name(which, file.name)
    if output.format != "yaml":
        write_tableau(shown, name, None, output, None, is_document, derivation=which or "")
        return
    output.write(_method_file(shown, name, family))


def _method_file(tableau: Tableau, name: str, family: EveryFamily) -> str:
    """A method file with the same free parameters."""
    from garkcli.methodfile.writer import write_tableau_file

    refuse_partitioned(tableau)

    def text(number: object) -> str:
        return str(number).replace("^", "**")

    free = []
    for parameter in family.family.parameters:
        ends = family.family.ranges[parameter]
        if None in ends:
            free.append(f"{parameter}: free")
        else:
            low, high = ends
            free.append(f"{parameter}: {{free: true, range: [{low}, {high}]}}")
    return write_tableau_file(tableau, name, text=text, parameters=free)
