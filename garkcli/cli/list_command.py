"""``gark list``."""

from __future__ import annotations

from typing import Any

import click

from garkcli.cli.list_methods import filter_options, list_methods, refuse_filters
from garkcli.cli.options import Output, declared

WHAT = ("methods", "exports")
"""What is listed, besides what method files and problems can name."""


FORMATS = ("text", "json", "csv", "markdown")


@declared("list", FORMATS, WHAT={"type": click.Choice(WHAT)}, options=filter_options())
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
        from garkcli.report.exports import render

        output.write(render(output.format, output.paint))
        return 0
    from garkcli.constructions.schemes.flows import SPLITTINGS
    from garkcli.constructions.schemes.registry import SCHEMES
    from garkcli.families.registry import FAMILIES
    from garkcli.problems.builtin import PROBLEMS
    from garkcli.report import listing
    from garkcli.transfer import SUMMARIES

    problems = {entry.name: entry.summary for entry in PROBLEMS.values()}
    lists = listing.Lists(FAMILIES, SUMMARIES, SCHEMES, SPLITTINGS, problems)
    output.write(listing.render(lists, output.format, output.paint))
    return 0
