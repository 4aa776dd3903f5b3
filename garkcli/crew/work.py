"""The work, and the workers."""

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
    """A worker process or machine was ended from outside."""

    code = "worker-lost"


class Limit(Frozen, Generic[Item, Outcome]):
    """The time limit of an item, in processor time if the system tells that of other processes. Its
    process is ended in the middle of a call in C; ``late`` then makes the outcome.
    """

    seconds: Callable[[Item], float]
    late: Callable[[Item], Outcome]


class Workers(Protocol[Given, Made]):
    """Workers in this process, in several, or on a cluster; ``size`` items are done at a time."""

    @property
    def size(self) -> int: ...

    def as_they_come(self, items: Sequence[Given]) -> Iterator[tuple[int, Made]]:
        """Yields each outcome with the index of its item as soon as it is there."""


def in_order(workers: Workers[Item, Outcome], items: Sequence[Item]) -> Iterator[Outcome]:
    ready: dict[int, Outcome] = {}
    following = 0
    for number, outcome in workers.as_they_come(items):
        ready[number] = outcome
        while following in ready:
            yield ready.pop(following)
            following += 1


class Alone(Generic[Item, Outcome]):
    size = 1

    def __init__(self, work: Callable[[Item], Outcome]) -> None:
        self.work = work

    def as_they_come(self, items: Sequence[Item]) -> Iterator[tuple[int, Outcome]]:
        return enumerate(map(self.work, items))
