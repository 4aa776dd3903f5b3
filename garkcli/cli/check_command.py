"""``gark check``."""

from __future__ import annotations

import click

from garkcli.cli.options import CONTEXT, Output, common


@click.command("check", context_settings=CONTEXT)
@click.argument("files", nargs=-1, required=True, metavar="FILE...")
@click.option(
    "--max-order",
    type=click.IntRange(1, 400),
    default=60,
    show_default=True,
    metavar="N",
    help="Where the search for orders stops; then the order is a lower bound.",
)
@click.option(
    "--error-constants",
    is_flag=True,
    help="The norms of the principal error coefficients, over all trees of the first failing order.",
)
@common(["text", "json"])
def command(files: tuple[str, ...], max_order: int, error_constants: bool, output: Output) -> int:
    r"""Everything known about each method, and its claims.

    FILE is a method file, a directory (all *.gark.yaml below it), or - for standard input.

    The exact order of the tableau, of its symplectic conjugate and of their pair, each with a tree whose
    condition fails next; B, C and D of every block and the bound they give; consistency and symplecticity;
    the claims under `expect`.

    \b
    Exit code: 0 every claim holds, 1 a claim fails, 2 a file cannot be read as a method.
    """
    from garkcli.methodfile.check import check_file
    from garkcli.methodfile.load import find_files
    from garkcli.report.progress import tracked

    paths = list(find_files(files))
    bar = output.verbosity >= 0
    outcomes = [
        check_file(path, max_order, error_constants) for path in tracked(paths, len(paths), "checking", bar)
    ]
    if output.format == "json":
        from garkcli.report import check_json

        output.write(check_json.render(outcomes))
    else:
        from garkcli.report import check_text

        output.write(check_text.render(outcomes, output.paint, output.verbosity))
    return max(outcome.exit_code for outcome in outcomes)
