"""``gark list``."""

from __future__ import annotations

from typing import Any

import click

from garkcli.cli.list_methods import filter_options, list_methods, refuse_filters
from garkcli.cli.options import Output, declared
from garkcli.tell.report import FORMATS

WHAT = ("methods", "exports")
"""What is listed, besides what method files and problems can name."""


@declared("list", (*FORMATS, "csv"), WHAT={"type": click.Choice(WHAT)}, options=filter_options())
def command(what: str | None, output: Output, **options: Any) -> int:
    """Families of diagonal methods, transfer rules, schemes of compositions, problems; or WHAT:
    methods, those of the catalogue, or exports, the targets of gark export.

    Methods are those that are as every option says and that have every WORD in their name, an
    alias, their title or their reference; --no-... those for which it is known not to hold.
    """
    if what == "methods":
        return list_methods(options, output)
    refuse_filters(options, output.format)
    if what == "exports":
        from garkcli.bridges.registry import bridges
        from garkcli.report.listing import EXPORTS

        output.tell(EXPORTS, [bridges()])
        return 0
    from garkcli.constructions.schemes import SCHEMES, SPLITTINGS
    from garkcli.families.registry import FAMILIES
    from garkcli.problems.builtin import PROBLEMS
    from garkcli.report.listing import REPORT, Lists
    from garkcli.transfer import SUMMARIES

    problems = {entry.name: entry.summary for entry in PROBLEMS.values()}
    output.tell(REPORT, [Lists(FAMILIES, SUMMARIES, SCHEMES, SPLITTINGS, problems)])
    return 0
