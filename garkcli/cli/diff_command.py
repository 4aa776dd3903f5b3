"""``gark diff``."""

from __future__ import annotations

import click

from garkcli.cli.method_argument import two_files
from garkcli.cli.options import CONTEXT, Output, common

EXIT_CODES = {
    "identical": 0,
    "same": 0,
    "within-rounding": 0,
    "different": 1,
    "undecided": 3,
}
"""By what the methods are to each other."""


@click.command("diff", context_settings=CONTEXT)
@two_files("first", "second")
@click.option(
    "--strict",
    is_flag=True,
    help="Exit with 1 unless every entry is the same as it stands.",
)
@common(["text", "json", "markdown"])
def command(first: str, second: str, strict: bool, output: Output) -> int:
    """How two methods differ: in entries, orders, conditions and properties; and whether they are
    the same method with its stages numbered otherwise, or in another form.

    Exit code 0 where the steps and the further weights are the same: with stages or colours
    renumbered, stages without influence left out, or within the rounding that both files admit; 1
    where they are not; 3 where that is not decided.
    """
    from garkcli.comparison.comparison import compare
    from garkcli.methodfile.load import load
    from garkcli.methodfile.naming import called

    found = compare(load(first), load(second))
    files = (called(first), called(second))
    if output.format == "json":
        from garkcli.report import diff_json

        output.write(diff_json.render(found, files))
    elif output.format == "markdown":
        from garkcli.report import diff_markdown

        output.write(diff_markdown.render(found, files))
    else:
        from garkcli.report import diff_text

        output.write(diff_text.render(found, files, output.paint))
    if strict and found.relation == "same":
        return 1
    if strict and found.relation == "within-rounding":
        return 1
    return EXIT_CODES[found.relation]
