"""``gark audit``."""

from __future__ import annotations

import os
from collections.abc import Sequence
from typing import TYPE_CHECKING

from garkcli.cli.options import Output, declared
from garkcli.doing import counting
from garkcli.errors import UsageProblem, counted
from garkcli.tell.report import FORMATS as TOLD

if TYPE_CHECKING:
    from garkcli.bridges.audit import Audited

FORMATS = (*TOLD, "github", "sarif")


@declared("audit", ["auto", *FORMATS])
def command(paths: tuple[str, ...], output: Output) -> int:
    """The tables of a solver's source tree against what they declare.

    PATH is a folder (all files in it of the formats that gark import reads), a file, or - for
    standard input. Of every table that is found: whether it has the order and the embedded order
    that the source declares, whether its nodes are its row sums and what it costs where they are
    not, whether its weights have the sum 1. Nothing in a source is executed. The format auto is
    github in GitHub Actions and text elsewhere.

    Exit code: 0 nothing is wrong, 1 a finding is an error, 2 there is no table, or none that can be
    read.
    """
    from garkcli.bridges.audit import audited
    from garkcli.bridges.sources import source_files
    from garkcli.report.audited import FORMATS as RENDERERS

    files = list(source_files(paths, output.note))
    found: list[Audited] = []
    for path in counting("files", files, len(files)):
        found += audited([path])
    if not found:
        raise _no_table(paths, files)
    chosen = _format(output)
    render = RENDERERS[chosen]
    output.write(render(found, output.paint, output.verbosity, output.width), chosen)
    if any(x.has_errors for x in found):
        return 1
    return 0 if any(x.is_read for x in found) else 2


def _no_table(paths: Sequence[str], files: Sequence[str]) -> UsageProblem:
    """What is told where there is nothing to judge: of arrays with the names of a method."""
    from garkcli.bridges.audit import unlike

    looked_at = counted(len(files), "file")
    message = f"no table is found in {', '.join(paths[:3])} ({looked_at})"
    first = next(unlike(files), "")
    if first:
        message += f"; {first}"
    return UsageProblem(message, "docs/import.md says what is read", code="cannot-import")


def _format(output: Output) -> str:
    """The format asked for; auto is what suits where the command runs."""
    if output.format != "auto":
        return output.format
    return "github" if os.environ.get("GITHUB_ACTIONS") == "true" else "text"
