"""``gark list``."""

from __future__ import annotations

import click

from garkcli.cli.options import CONTEXT, Output, common


@click.command("list", context_settings=CONTEXT)
@common(["text", "json"])
def command(output: Output) -> int:
    """Families of diagonal methods, transfer rules, problems."""
    from garkcli.families.registry import FAMILIES
    from garkcli.problems.oscillator import PROBLEMS
    from garkcli.report import listing
    from garkcli.transfer import SUMMARIES

    output.write(listing.render(FAMILIES, SUMMARIES, PROBLEMS, output.format, output.paint))
    return 0
