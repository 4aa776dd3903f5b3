"""``gark list``."""

from __future__ import annotations

import click

from garkcli.cli.options import CONTEXT, Output, common


@click.command("list", context_settings=CONTEXT)
@click.argument(
    "what", required=False, type=click.Choice(["exports"]), metavar="[WHAT]"
)
@common(["text", "json"])
def command(what: str | None, output: Output) -> int:
    """Families of diagonal methods, transfer rules, problems; or WHAT: exports, the targets of
    gark export.
    """
    if what == "exports":
        from garkcli.report.exports import render

        output.write(render(output.format, output.paint))
        return 0
    from garkcli.families.registry import FAMILIES
    from garkcli.problems.builtin import PROBLEMS
    from garkcli.report import listing
    from garkcli.transfer import SUMMARIES

    problems = {entry.name: entry.summary for entry in PROBLEMS.values()}
    output.write(
        listing.render(
            FAMILIES, SUMMARIES, problems, output.format, output.paint
        )
    )
    return 0
