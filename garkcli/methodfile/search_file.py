"""The search of a file with unknowns, in a form that can be sent between processes."""

from __future__ import annotations

from functools import lru_cache

from garkcli.design.member import Whose
from garkcli.design.search.run import SearchTask, Timed, do
from garkcli.design.search.search import Search
from garkcli.errors import MethodError
from garkcli.frozen import Frozen
from garkcli.methodfile.family import FamilyFile, loads_family


class FileSearch(Frozen):
    """``order`` is that of the method, its conjugate or its pair."""

    text: str
    source: str
    settings: tuple[tuple[str, str], ...]
    order: int
    whose: Whose = "method"
    objective: str | None = None

    @classmethod
    def of(
        cls, family: FamilyFile, order: int, whose: Whose = "method", objective: str | None = None
    ) -> FileSearch:
        settings = tuple(family.settings.items())
        return cls(family.text, family.source, settings, order, whose, objective)

    @property
    def family(self) -> FamilyFile:
        """Read once in each process; MethodError for rounded coefficients."""
        return _family(self.text, self.source, self.settings)

    @property
    def search(self) -> Search:
        return _search(self)

    def do(self, task: SearchTask) -> Timed:
        return do(self.search, task)


@lru_cache(maxsize=4)
def _family(text: str, source: str, settings: tuple[tuple[str, str], ...]) -> FamilyFile:
    family = loads_family(text, source, dict(settings))
    if family.tolerance is not None:
        message = f"{source}: a search needs exact coefficients, and those of the file are rounded"
        raise MethodError(message, "write radicals and fractions", code="rounded")
    return family


@lru_cache(maxsize=4)
def _search(asked: FileSearch) -> Search:
    return Search(asked.family, asked.order, asked.whose, asked.objective)
