"""The options of ``gark design``."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from time import monotonic
from typing import TYPE_CHECKING, Any, TypeVar

import click

from garkcli.cli.options import PATH, digits_option
from garkcli.design.minimise.registry import OBJECTIVES
from garkcli.errors import UsageProblem

if TYPE_CHECKING:
    from garkcli.design.design import Whose
    from garkcli.design.stable_values import Wanted as Stability

F = TypeVar("F", bound=Callable[..., Any])


def _finite(
    _context: click.Context, _parameter: click.Parameter, seconds: float | None
) -> float | None:
    """A number of seconds; nan, which no limit of a range holds off, is none."""
    if seconds is not None and seconds != seconds:
        raise click.BadParameter("nan is no number of seconds")
    return seconds


SECONDS = 60.0
"""The time where none is given."""


_OF_THE_ORDER = (
    click.option(
        "--order",
        type=click.IntRange(1, 60),
        metavar="P",
        help="The order wanted; by default as far as some value reaches.",
    ),
    click.option("--pair", "is_pair", is_flag=True, help="The order of the symplectic pair."),
    click.option("--conjugate", "is_conjugate", is_flag=True, help="The order of the conjugate."),
    click.option(
        "--seconds",
        type=click.FloatRange(min=0, min_open=True),
        callback=_finite,
        metavar="T",
        help="After so many what is not decided is left open, or a search ends; 60 by default,"
        " of a search none.",
    ),
    digits_option("Digits of numbers without simple radicals.", default=12),
    click.option(
        "--emit",
        type=PATH,
        metavar="FILE",
        help="Write the first method found as a method file with its claim.",
    ),
)
_OF_THE_BEST = (
    click.option(
        "--minimise",
        "objective",
        type=click.Choice(OBJECTIVES),
        metavar="WHAT",
        help=f"The best methods of the highest order: {', '.join(OBJECTIVES)}.",
    ),
)
_OF_STABILITY = (
    click.option(
        "--p-stable",
        "stability",
        flag_value="p-stable",
        help="The exact set of values of one parameter for which the method is P-stable.",
    ),
    click.option(
        "--a-stable", "stability", flag_value="a-stable", help="The same for A-stability."
    ),
    click.option(
        "--l-stable", "stability", flag_value="l-stable", help="The same for L-stability."
    ),
    click.option(
        "--colour",
        type=click.IntRange(min=1),
        metavar="N",
        help="With --a-stable or --l-stable: of colour N alone, in place of all with one λ.",
    ),
    click.option(
        "--slow",
        metavar="A",
        help="With --p-stable: a slow and a fast spring, the slow one of (hω)² = A.",
    ),
    click.option("--fast", metavar="COLOUR", help="With --slow: the colour of the fast spring."),
    click.option("--up-to", metavar="X", help="With --slow: fast springs of (hω)² up to X only."),
)
_OF_THE_SEARCH = (
    click.option(
        "--search",
        "starts",
        type=click.IntRange(1, 10_000_000),
        metavar="N",
        help="Search from N random starts instead, and prove what is found.",
    ),
    click.option(
        "--seed", type=int, metavar="S", help="With --search: of the starts; 0 by default."
    ),
    click.option(
        "--most",
        type=click.IntRange(1, 100_000),
        metavar="K",
        help="With --search: methods to find at most; 5 by default.",
    ),
    click.option(
        "-j", "--jobs", type=click.IntRange(1, 1000), metavar="N", help="With --search: processes."
    ),
    click.option(
        "--scheduler",
        metavar="ADDRESS",
        help="With --search: work on the Dask cluster there; needs garkcli[cluster].",
    ),
    click.option(
        "--emit-all", type=PATH, metavar="DIR", help="Write every method found into a folder."
    ),
)


def design_options(function: F) -> F:
    """All options of the command but ``--set``, ``--choose`` and those that every command has; they
    make one ``Wanted``.
    """
    of_orders = (*_OF_THE_ORDER, *_OF_THE_BEST)
    options = (*of_orders, *_OF_STABILITY, *_OF_THE_SEARCH)
    for option in reversed(options):
        function = option(function)
    return function


@dataclass(frozen=True)
class Wanted:
    """What is asked for, by the names of the options.

    Attributes:
        order: the order wanted, or None for as far as some value reaches.
        is_pair, is_conjugate: whose order it is; of the method where neither is given.
        seconds: after which what is not decided is left open, where they are given.
        digits: of numbers without simple radicals.
        emit: the file of the first method found, if any.
        objective: what is minimised over the methods of the highest order, if anything.
        stability: the kind of stability whose values are asked for instead of an order.
        colour: of which colour alone that is meant, counted from 1; None for all.
        slow, fast, up_to: of two springs, as they were written; None where they were not given.
        starts: of a search instead, or None where there is none.
        seed, most, jobs, scheduler: of the search; None where they were not given.
        emit_all: the folder of all methods found, if any.
        moment: the reading of ``time.monotonic`` at which the time is over; None for never.
    """

    order: int | None
    is_pair: bool
    is_conjugate: bool
    seconds: float | None
    digits: int
    emit: str | None
    objective: str | None
    stability: Stability | None
    colour: int | None
    slow: str | None
    fast: str | None
    up_to: str | None
    starts: int | None
    seed: int | None
    most: int | None
    jobs: int | None
    scheduler: str | None
    emit_all: str | None
    moment: float | None = None

    def started(self) -> Wanted:
        """The same, its time running from now on."""
        seconds = SECONDS if self.seconds is None and self.starts is None else self.seconds
        return replace(self, moment=None if seconds is None else monotonic() + seconds)

    @property
    def whose(self) -> Whose:
        """Which order is meant."""
        if self.is_pair:
            return "pair"
        return "conjugate" if self.is_conjugate else "method"

    def check(self) -> None:
        """Refuse options that do not go together, before anything is read.

        Raises:
            UsageProblem: two of them do not.
        """
        of_search = {
            "--seed": self.seed,
            "--most": self.most,
            "--jobs": self.jobs,
            "--scheduler": self.scheduler,
        }
        for option, value in of_search.items():
            if self.starts is None and value is not None:
                message = f"{option} goes with --search"
                raise UsageProblem(message, "add --search N")
        self._check_springs()
        if self.colour is not None and self.stability not in {"a-stable", "l-stable"}:
            message = "--colour goes with --a-stable and --l-stable"
            raise UsageProblem(message, "add one of them")
        if self.starts is not None and self.objective is not None:
            message = "--minimise compares all methods, --search finds some"
            raise UsageProblem(message, "leave one of them out")
        if self.emit_all is not None and self.objective is not None:
            message = "--minimise finds one method, --emit-all writes several"
            raise UsageProblem(message, "--emit FILE writes the one")
        if self.is_pair and self.is_conjugate:
            message = "--pair and --conjugate are two methods"
            raise UsageProblem(message, "ask for one")

    def _check_springs(self) -> None:
        if (self.slow is None) != (self.fast is None):
            raise UsageProblem("--slow and --fast belong together", "give both")
        if self.up_to is not None and self.slow is None:
            message = "--up-to is a bound for the fast one of two springs"
            raise UsageProblem(message, "give --slow and --fast too")
        if self.slow is not None and self.stability != "p-stable":
            message = "--slow and --fast say on which springs"
            raise UsageProblem(message, "add --p-stable")
        if self.slow is not None and self.order is not None:
            message = "two springs give a set of values, --order does not"
            raise UsageProblem(message, "ask for one")

    def check_one_by_one(self, stable: Sequence[str]) -> None:
        """Refuse what does not look at stability, where that is wanted too.

        Raises:
            UsageProblem: a search or a minimum is asked for.
        """
        options = {"--search": self.starts, "--minimise": self.objective}
        for option, value in options.items():
            if stable and value is not None:
                message = f"{stable[0]} is decided for exact solutions, {option} has others"
                cure = "leave it out, and ask gark check of what is found"
                raise UsageProblem(message, cure)

    def check_stability(self) -> None:
        """Refuse what a set of values does not have.

        Raises:
            UsageProblem: a file or a search is asked for too.
        """
        others = (self.emit, self.emit_all, self.starts, self.objective)
        if all(option is None for option in others):
            return
        message = f"--{self.stability} gives a set of values, "
        message += "--emit, --search, --minimise do not"
        cure = "ask for one; with --order solutions of that order are looked at"
        raise UsageProblem(message, cure)
