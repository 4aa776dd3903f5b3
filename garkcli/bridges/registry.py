"""The targets of ``gark export``, found in the files of ``garkcli.bridges.targets``."""

from __future__ import annotations

import pkgutil
from collections.abc import Callable, Mapping, Sequence
from functools import lru_cache
from importlib import import_module
from typing import TypeAlias

from garkcli.bridges import targets
from garkcli.bridges.cannot import CannotExport
from garkcli.bridges.numbers import DECIMALS, Style
from garkcli.bridges.payload import Kind, Payload
from garkcli.bridges.texts import Values, program_values, text_of
from garkcli.bridges.trials import trial_of
from garkcli.errors import UsageProblem, did_you_mean
from garkcli.frozen import Frozen


class Written(Frozen):
    """A file beside the table: a driver, or what is needed to build it.

    Attributes:
        ending: what is put after the stem of the table's name: ``_test.c``.
        text: of the file.
    """

    ending: str
    text: str


TestDriver: TypeAlias = Callable[[Payload, str], Sequence[Written]]
"""From a method and the name of the file with its table (no folder) to the files of a test."""


class Bridge(Frozen):
    """One target.

    Its template is ``templates/NAME.SUFFIX.jinja``, that of its program ``NAME_test.ENDING.jinja``.

    Attributes:
        name: on the command line.
        summary: half a line.
        kinds: the forms of methods that it can hold, some of them under conditions.
        suffix: of its files.
        style: of its numbers.
        values: what its template has beyond what all have; raises ``CannotExport`` with the reason
            and the cure.
        program: the same for the template of a program that runs the method in the target, from the
            method and the name of the file with its table (no folder); None where nothing runs it.
        reads_back: whether ``gark import`` reads what it writes.
        write: the file of a method, where no template writes it.
    """

    name: str
    summary: str
    kinds: tuple[Kind, ...]
    suffix: str
    style: Style = DECIMALS
    values: Callable[[Payload], Values] = lambda _: {}
    program: Callable[[Payload, str], Values] | None = None
    reads_back: bool = False
    write: Callable[[Payload], str] | None = None

    @property
    def test_driver(self) -> TestDriver | None:
        """What writes a program that runs the method; None where the target is data."""
        return None if self.program is None else self._tested

    def _tested(self, payload: Payload, file: str) -> Sequence[Written]:
        """The program and its problem."""
        assert self.program is not None
        own = self.program(payload, file)
        ending = _ENDINGS.get(self.suffix, self.suffix)
        values = {**program_values(payload, file, ending), **own}
        text = text_of(f"{self.name}_test{ending}", payload, self.style, values)
        return [Written(f"_test{ending}", text), Written("_problem.yaml", trial_of(payload).file)]

    def written(self, payload: Payload) -> str:
        """The file of a method.

        Raises:
            CannotExport: the target cannot hold it.
        """
        if payload.kind not in self.kinds:
            message = f"{self.name} has no {_KINDS[payload.kind]}"
            cure = f"these have: {', '.join(_holding(payload.kind))}"
            raise CannotExport(message, cure, code="unknown-word")
        if self.write is not None:
            return self.write(payload)
        return text_of(self.name + self.suffix, payload, self.style, self.values(payload))


_ENDINGS = {".hpp": ".cpp"}
"""Of programs that are no files of the same kind as the tables."""
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
        for bridge in import_module(f"{targets.__name__}.{module.name}").BRIDGES:
            found[bridge.name] = bridge
    return dict(sorted(found.items()))


def bridge_named(name: str) -> Bridge:
    """The target of that name.

    Raises:
        UsageProblem: there is none.
    """
    known = bridges()
    if name not in known:
        message = f"no target {name!r}"
        raise UsageProblem(message, did_you_mean(name, list(known)), code="unknown-word")
    return known[name]
