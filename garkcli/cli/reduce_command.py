"""``gark reduce``."""

from __future__ import annotations

from typing import TYPE_CHECKING

from garkcli.cli.options import Output, declared
from garkcli.errors import UsageProblem
from garkcli.tell.report import FORMATS

if TYPE_CHECKING:
    from garkcli.methodfile.build import MethodFile
    from garkcli.tableau.embedded import Further
    from garkcli.tableau.tableau import Tableau


@declared("reduce", ("yaml", *FORMATS))
def command(file: str, settings: dict[str, str], output: Output) -> int:
    """The smallest method that does the same, as a method file.

    Stages that have no influence on the step are left out, and stages that are equal on every
    problem become one. Where nothing is to be reduced the file is written as it is, and a note
    says so. Claims are left behind: the orders stay, B, C and D may not.
    """
    from garkcli.methodfile.load import load
    from garkcli.methodfile.naming import called

    method = load(file, settings)
    file = called(file)
    smaller, further = smallest_of(file, method)
    if smaller is method.tableau:
        output.note(f"{file}: nothing to reduce")
    else:
        before, after = _stages(method.tableau), _stages(smaller)
        output.note(f"{file}: stages {before} become {after}")
    if output.format != "yaml":
        from garkcli.cli.rendering import write_tableau

        write_tableau(
            smaller, _name(method, smaller), None, output, method.tolerance, further=further
        )
        return 0
    output.write(_file(file, method, smaller, further))
    return 0


def smallest_of(file: str, method: MethodFile) -> tuple[Tableau, Further]:
    """The smallest method with its further weights; the same tableau where there is nothing to
    leave out.
    """
    from garkcli.properties.reduction import smallest

    found = smallest(method.tableau, method.further)
    if found is None:
        raise UsageProblem(
            f"{file}: the nodes have no simple radicals, so equal stages are not looked for",
            "spell the method out",
            code="no-radicals",
        )
    return found


def _file(file: str, method: MethodFile, smaller: Tableau, further: Further) -> str:
    """The method file of what is left."""
    from garkcli.methodfile.writer import can_spell_out, write_method

    if smaller is method.tableau:
        return method.text
    if not can_spell_out(smaller):
        raise UsageProblem(
            f"{file}: a method of this structure cannot be spelled out in a file",
            "--format json has the entries of the smaller method",
            code="cannot-convert",
        )
    name = _name(method, smaller)
    return write_method(smaller, name, method.tolerance, further)


def _name(method: MethodFile, smaller: Tableau) -> str:
    if smaller is method.tableau:
        return method.name
    is_named = method.name != method.source
    return f"{method.name}, reduced" if is_named else "a reduced method"


def _stages(tableau: Tableau) -> str:
    return ", ".join(str(space.stages) for space in tableau.spaces)
