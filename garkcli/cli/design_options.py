"""The options of ``gark design``."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from time import monotonic
from typing import TYPE_CHECKING

from garkcli.cli.table import SECONDS
from garkcli.errors import UsageProblem

if TYPE_CHECKING:
    from garkcli.design.design import Whose
    from garkcli.design.stable_values import Wanted as Stability


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
                raise UsageProblem(message, "add --search N", code="option-alone")
        self._check_springs()
        if self.colour is not None and self.stability not in {"a-stable", "l-stable"}:
            message = "--colour goes with --a-stable and --l-stable"
            raise UsageProblem(message, "add one of them", code="option-alone")
        if self.starts is not None and self.objective is not None:
            message = "--minimise compares all methods, --search finds some"
            raise UsageProblem(message, "leave one of them out", code="options-clash")
        if self.emit_all is not None and self.objective is not None:
            message = "--minimise finds one method, --emit-all writes several"
            raise UsageProblem(message, "--emit FILE writes the one", code="options-clash")
        if self.is_pair and self.is_conjugate:
            message = "--pair and --conjugate are two methods"
            raise UsageProblem(message, "ask for one", code="options-clash")

    def _check_springs(self) -> None:
        if (self.slow is None) != (self.fast is None):
            raise UsageProblem(
                "--slow and --fast belong together", "give both", code="option-alone"
            )
        if self.up_to is not None and self.slow is None:
            message = "--up-to is a bound for the fast one of two springs"
            raise UsageProblem(message, "give --slow and --fast too", code="option-alone")
        if self.slow is not None and self.stability != "p-stable":
            message = "--slow and --fast say on which springs"
            raise UsageProblem(message, "add --p-stable", code="option-alone")
        if self.slow is not None and self.order is not None:
            message = "two springs give a set of values, --order does not"
            raise UsageProblem(message, "ask for one", code="options-clash")

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
                raise UsageProblem(message, cure, code="wanted-without-meaning")

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
        raise UsageProblem(message, cure, code="options-clash")
