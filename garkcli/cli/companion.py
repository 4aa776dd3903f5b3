"""``--conjugate`` and ``--pair``: the symplectic conjugate of a method, the pair of both."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any, TypeVar

import click

if TYPE_CHECKING:
    from garkcli.tableau.tableau import Tableau

F = TypeVar("F", bound=Callable[..., Any])

_OPTIONS = (
    click.option(
        "--conjugate", "which", flag_value="conjugate", help="Of the symplectic conjugate of FILE."
    ),
    click.option("--pair", "which", flag_value="pair", help="Of the symplectic pair of FILE."),
)


def companion_options(function: F) -> F:
    """``--conjugate`` and ``--pair``; they arrive as ``which``, None for the method itself."""
    for option in reversed(_OPTIONS):
        function = option(function)
    return function


def companion(tableau: Tableau, which: str | None) -> Tableau:
    """The tableau that ``which`` asks for."""
    from garkcli.tableau.conjugate import conjugate
    from garkcli.tableau.forms import pair

    if which == "conjugate":
        return conjugate(tableau)
    return pair(tableau) if which == "pair" else tableau
