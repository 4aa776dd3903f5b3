"""The options that ``gark trees`` and ``gark conditions`` share: colours, and free trees."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeVar, cast

import click

from garkcli.errors import UsageProblem
from garkcli.trees.symplectic import KINDS, Kind

F = TypeVar("F", bound=Callable[..., Any])


def colours_option(help: str) -> Callable[[F], F]:
    """``--colours``, with what it means to the command."""
    return click.option("--colours", "-N", type=click.IntRange(1, 1000), metavar="N", help=help)


def symplectic_options(function: F) -> F:
    """``--symplectic``, ``--kind`` and ``--members``."""
    options = [
        click.option(
            "--symplectic",
            is_flag=True,
            help="Independent conditions of symplectic methods: free trees.",
        ),
        click.option(
            "--kind",
            type=click.Choice(KINDS),
            help="With --symplectic: which methods, the pair (A, Â) unless given.",
        ),
        click.option(
            "--members", is_flag=True, help="With --symplectic: all rooted trees of each free tree."
        ),
    ]
    for option in reversed(options):
        function = option(function)
    return function


def kind_asked(symplectic: bool, kind: str | None, members: bool, format: str) -> Kind | None:
    """The kind of symplectic methods; None where all trees are meant.

    Raises:
        UsageProblem: options of ``--symplectic`` without it, or members in a LaTeX table.
    """
    if members and format == "latex":
        message = "--members do not fit into a LaTeX table"
        raise UsageProblem(message, "choose another --format")
    if symplectic:
        return cast("Kind", kind or "pair")
    if kind is not None or members:
        option = "--members" if kind is None else "--kind"
        raise UsageProblem(f"{option} is about free trees", "add --symplectic")
    return None
