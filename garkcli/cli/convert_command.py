"""``gark convert``."""

from __future__ import annotations

from typing import TYPE_CHECKING

from garkcli.cli.options import Output, declared
from garkcli.tell.report import FORMATS

if TYPE_CHECKING:
    from garkcli.conversion.convert import Converted


@declared("convert", ("yaml", *FORMATS))
def command(
    file: str, to: str, stages: int | None, settings: dict[str, str], output: Output
) -> int:
    """The same method in another form, as a method file.

    Name, reference, tolerance, embedded weights and dense output stay; so do the claims that hold
    of the result, and a note names those that do not. The pair is another method: its file claims
    of it what FILE claims of the pair.
    """
    from garkcli.conversion.convert import convert
    from garkcli.methodfile.load import load
    from garkcli.methodfile.naming import called

    made = convert(load(file, settings), to, stages)
    _say_what_is_lost(called(file), made, output)
    if output.format == "yaml":
        output.write(made.method.text)
        return 0
    from garkcli.cli.rendering import write_tableau

    method = made.method
    write_tableau(method.tableau, method.name, None, output, method.tolerance)
    return 0


def _say_what_is_lost(file: str, made: Converted, output: Output) -> None:
    if made.left_out:
        claims = ", ".join(made.left_out)
        output.note(f"{file}: claims that are left out: {claims}")
    if made.loses_further:
        output.note(f"{file}: embedded and dense weights are left out")
