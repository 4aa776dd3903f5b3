"""The targets of ``gark export``, found in the files of ``garkcli.bridges.targets``."""

from __future__ import annotations

import pkgutil
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache
from importlib import import_module
from typing import TypeAlias

from garkcli.bridges import targets
from garkcli.bridges.cannot import CannotExport
from garkcli.bridges.payload import Kind, Payload
from garkcli.errors import UsageProblem, did_you_mean


@dataclass(frozen=True)
class Written:
    """A file beside the table: a driver, or what is needed to build it.

    Attributes:
        ending: what is put after the stem of the table's name: ``_test.c``.
        text: of the file.
    """

    ending: str
    text: str


TestDriver: TypeAlias = Callable[[Payload, str], Sequence[Written]]
"""From a method and the name of the file with its table (no folder) to the files of a test."""


@dataclass(frozen=True)
class Bridge:
    """One target.

    Attributes:
        name: on the command line.
        summary: half a line.
        kinds: the forms of methods that it can hold, some of them under conditions.
        suffix: of its files.
        write: the file of a method; raises ``CannotExport`` with the reason and the cure.
        test_driver: a program that runs the method in the target; None where the target is data.
        reads_back: whether ``gark import`` reads what it writes.
    """

    name: str
    summary: str
    kinds: tuple[Kind, ...]
    suffix: str
    write: Callable[[Payload], str]
    test_driver: TestDriver | None = None
    reads_back: bool = False

    def written(self, payload: Payload) -> str:
        """The file of a method.

        Raises:
            CannotExport: the target cannot hold it.
        """
        if payload.kind not in self.kinds:
            raise CannotExport(
                f"{self.name} has no {_KINDS[payload.kind]}",
                f"these have: {', '.join(_holding(payload.kind))}",
            )
        return self.write(payload)


_KINDS = {
    "rk": "methods for one vector field",
    "ark": "methods for several vector fields that share their stages",
    "prk": "methods for a pair (q, p)",
    "gark": "methods whose vector fields have stages of their own",
}


def _holding(kind: Kind) -> list[str]:
    """The targets that have such methods."""
    return [x.name for x in bridges().values() if kind in x.kinds]


@lru_cache(maxsize=1)
def bridges() -> Mapping[str, Bridge]:
    """Every target by its name, in alphabetical order."""
    found: dict[str, Bridge] = {}
    for module in pkgutil.iter_modules(targets.__path__):
        place = f"{targets.__name__}.{module.name}"
        for bridge in import_module(place).BRIDGES:
            found[bridge.name] = bridge
    return dict(sorted(found.items()))


def bridge_named(name: str) -> Bridge:
    """The target of that name.

    Raises:
        UsageProblem: there is none.
    """
    known = bridges()
    if name not in known:
        raise UsageProblem(f"no target {name!r}", did_you_mean(name, list(known)))
    return known[name]
