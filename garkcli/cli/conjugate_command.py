"""``gark conjugate``."""

from __future__ import annotations

from garkcli.cli.options import Output, declared
from garkcli.tell.report import FORMATS


@declared("conjugate", (*FORMATS, "yaml"))
def command(
    file: str,
    is_pair: bool,
    digits: int | None,
    document: bool,
    settings: dict[str, str],
    output: Output,
) -> int:
    """The symplectic conjugate tableau of a method: gark tableau --conjugate.

    With --format yaml it is a method file that loads again; conjugated again it gives the original
    blocks exactly. Where the nodes have no simple radicals that file says `conjugate: true` instead
    of entries. Entries of a file with free parameters are rational functions of these.
    """
    from garkcli.cli.tableau_command import show

    show(file, "pair" if is_pair else "conjugate", digits, document, settings, output)
    return 0
