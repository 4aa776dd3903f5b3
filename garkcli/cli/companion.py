"""``--conjugate`` and ``--pair``: the symplectic conjugate of a method, or the pair of both."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any, TypeVar, overload

import click

from garkcli.cli.options import wrapping
from garkcli.errors import UsageProblem

if TYPE_CHECKING:
    from garkcli.tableau.garkmethod import GarkMethod
    from garkcli.tableau.tableau import Tableau

F = TypeVar("F", bound=Callable[..., Any])

_conjugate_option: Callable[[F], F] = click.option(
    "--conjugate",
    "is_conjugate",
    is_flag=True,
    help="Take the symplectic conjugate of FILE instead.",
)
pair_option: Callable[[F], F] = click.option(
    "--pair", "is_pair", is_flag=True, help="Take the symplectic pair of FILE instead, 2N colours."
)
"""``--pair`` alone; it arrives as ``is_pair``."""


def companion_options(function: F) -> F:
    """``--conjugate`` and ``--pair``; they arrive as ``which``, None for the method itself."""

    def run(is_conjugate: bool, is_pair: bool, **rest: Any) -> Any:
        if is_conjugate and is_pair:
            raise UsageProblem("--pair and --conjugate are two methods", "ask for one")
        which = "conjugate" if is_conjugate else "pair" if is_pair else None
        return function(which=which, **rest)

    return _conjugate_option(pair_option(wrapping(function, run)))


@overload
def companion(method: Tableau, which: str | None) -> Tableau: ...
@overload
def companion(method: GarkMethod, which: str | None) -> GarkMethod: ...
def companion(method: Tableau | GarkMethod, which: str | None) -> Tableau | GarkMethod:
    """The method that ``which`` asks for.

    Raises:
        ZeroWeight: a conjugate would divide by zero.
    """
    if which is None:
        return method
    from garkcli.api.methods import conjugate, pair

    return pair(method) if which == "pair" else conjugate(method)


def exact_companion(method: GarkMethod, which: str | None) -> GarkMethod:
    """The same, where what is said of it is proved.

    Raises:
        MethodError: the pair or the conjugate of rounded coefficients.
        ZeroWeight: a conjugate would divide by zero.
    """
    from garkcli.api.anymethod import refuse_rounded

    refuse_rounded(method, which or "")
    return companion(method, which)
