"""``gark export``."""

from __future__ import annotations

from typing import TYPE_CHECKING

import click

from garkcli.cli.companion import companion_options, exact_companion
from garkcli.cli.method_argument import file_argument
from garkcli.cli.options import CONTEXT, PATH, Output, digits_option, help_option, settings_option
from garkcli.errors import UsageProblem

if TYPE_CHECKING:
    from collections.abc import Sequence

    from garkcli.bridges.registry import Bridge, Written


def _targets(
    context: click.Context,  # noqa: ARG001 -- what click gives
    option: click.Parameter,  # noqa: ARG001
    beginning: str,
) -> list[str]:
    """The targets that begin so, for completion in the shell."""
    from garkcli.bridges.registry import bridges

    return [name for name in bridges() if name.startswith(beginning)]


@click.command("export", context_settings=CONTEXT)
@file_argument()
@companion_options
@click.option(
    "--to",
    "target",
    required=True,
    metavar="TARGET",
    shell_complete=_targets,
    help="What to write for; gark list exports names the targets.",
)
@digits_option(
    "Every number as a decimal of N digits, correctly rounded; by default exact where TARGET has "
    "such numbers, and else as many digits as it reads."
)
@click.option(
    "--test",
    "has_test",
    is_flag=True,
    help="With -o: write beside it a program that runs the method in TARGET, and the problem file "
    "on which gark converge prints the same errors.",
)
@settings_option
@click.option("-o", "--output", type=PATH, metavar="FILE", help="Write to FILE.")
@help_option
def command(
    file: str,
    which: str | None,
    target: str,
    digits: int | None,
    has_test: bool,
    settings: dict[str, str],
    output: str | None,
) -> int:
    """A method as the codes that people run read it: SciPy, SUNDIALS, PETSc, C, JSON and others.

    The head of the file says which orders gark proved. Decimals are correctly rounded. What a
    target cannot hold is refused, with the reason.
    """
    from pathlib import Path

    from garkcli.bridges.preparing import prepared
    from garkcli.bridges.registry import bridge_named
    from garkcli.methodfile.load import load

    bridge = bridge_named(target)
    if has_test:
        _check_test(bridge, output)
    place = Output("text", output, 0, "never")
    payload = prepared(exact_companion(load(file, settings), which), digits)
    table = bridge.written(payload)
    beside: Sequence[Written] = ()
    if has_test and output is not None and bridge.test_driver is not None:
        beside = bridge.test_driver(payload, Path(output).name)
    place.write(table, format=bridge.name)
    for written in beside:
        path = Path(str(output))
        named = path.with_name(path.stem + written.ending)
        Output("text", str(named), 0, "never").write(written.text)
    return 0


def _check_test(bridge: Bridge, output: str | None) -> None:
    """Whether a test can be written, before any work is done.

    Raises:
        UsageProblem: the target runs nothing, or there is no place for it.
    """
    if bridge.test_driver is None:
        raise UsageProblem(f"{bridge.name} is data, which nothing runs", "leave out --test")
    if output is None:
        raise UsageProblem("--test writes further files beside the first", "name it: -o FILE")
