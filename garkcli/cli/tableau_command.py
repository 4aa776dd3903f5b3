"""``gark tableau``."""

from __future__ import annotations

import click

from garkcli.cli.options import CONTEXT, Output, common


@click.command("tableau", context_settings=CONTEXT)
@click.argument("file", metavar="FILE")
@click.option(
    "--digits",
    type=click.IntRange(1, 1000),
    default=17,
    show_default=True,
    metavar="N",
    help="Digits of entries that have no simple radicals.",
)
@common(["text", "json", "latex"])
def command(file: str, digits: int, output: Output) -> int:
    """The assembled tableau, all blocks.

    Entries are exact where the nodes are rational or quadratic numbers, decimals otherwise.
    """
    from garkcli.cli.rendering import write_tableau
    from garkcli.methodfile.load import load

    method = load(file)
    write_tableau(method.tableau, method.name, digits, output, method.tolerance is not None)
    return 0
