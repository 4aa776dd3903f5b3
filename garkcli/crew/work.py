"""The work, and who does it."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import Generic, Protocol, TypeVar

from garkcli.errors import UsageProblem
from garkcli.frozen import Frozen

Item = TypeVar("Item")
Outcome = TypeVar("Outcome")
Given = TypeVar("Given", contravariant=True)
Made = TypeVar("Made", covariant=True)


class WorkerLost(UsageProblem):
    """A process or machine that worked was ended from outside."""

    code = "worker-lost"


class Limit(Frozen, Generic[Item, Outcome]):
    """How long an item may take a process of its own, which is ended in the middle of a call in C.

    Attributes:
        seconds: of an item, of processor time where the system says that of another process.
        late: the outcome of an item that took longer.
    """

    seconds: Callable[[Item], float]
    late: Callable[[Item], Outcome]


class Workers(Protocol[Given, Made]):
    """Who does the work: this process, several, or a cluster.

    Attributes:
        size: how many items they do at a time.
    """

    @property
    def size(self) -> int: ...

    def as_they_come(self, items: Sequence[Given]) -> Iterator[tuple[int, Made]]:
        """Every outcome with the number of its item, as soon as it is there."""


def in_order(workers: Workers[Item, Outcome], items: Sequence[Item]) -> Iterator[Outcome]:
    """Every outcome, in the order of the items."""
    ready: dict[int, Outcome] = {}
    following = 0
    for number, outcome in workers.as_they_come(items):
        ready[number] = outcome
        while following in ready:
            yield ready.pop(following)
            following += 1


class Alone(Generic[Item, Outcome]):
    """The work done in this process, one thing after the other.

    Args:
        work: from an item to its outcome.
    """

    size = 1

    def __init__(self, work: Callable[[Item], Outcome]) -> None:
        self.work = work

    def as_they_come(self, items: Sequence[Item]) -> Iterator[tuple[int, Outcome]]:
        """Every outcome with the number of its item."""
        return enumerate(map(self.work, items))
