"""Expressions of built-in problems, made by sympy on first use; files in ``known/``, written by
``make known``, answer most questions without sympy.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from contextvars import ContextVar
from functools import cache, cached_property
from pathlib import Path
from typing import Any, TypeAlias, TypeVar, overload

import msgspec.json

from garkcli.errors import UsageProblem
from garkcli.problems.expr import Expr, Exprs, Invariants, Vector

T = TypeVar("T")
Answer: TypeAlias = Any
Record: TypeAlias = dict["Deferred", dict[str, Answer]]
KNOWN = Path(__file__).resolve().parent / "known"
"""Answers by names of expressions and questions, a file for each problem."""
_record: ContextVar[Record | None] = ContextVar("record", default=None)


class Deferred(Sequence[Expr]):
    """Several sympy expressions, made on first use. Equal names mean equal expressions; a name
    begins with that of the problem and a blank. ``total`` is their sum, if it has a name.
    """

    def __init__(
        self,
        name: str,
        make: Callable[[], Vector],
        count: int | None = None,
        names: tuple[str, ...] = (),
        total: Deferred | None = None,
    ) -> None:
        self.name, self.names, self.total = name, names, total
        self._make, self._count = make, count

    @cached_property
    def made(self) -> Exprs:
        try:
            return tuple(self._make())
        except ImportError:
            message = "this needs sympy, which is not installed here"
            cure = "the problems of gark converge for up to three terms do without it"
            raise UsageProblem(message, cure, code="missing-package") from None

    def derived(self, what: str, make: Callable[[], Vector], count: int | None = None) -> Deferred:
        return Deferred(f"{self.name}, {what}", make, count)

    @overload
    def __getitem__(self, index: int) -> Expr: ...
    @overload
    def __getitem__(self, index: slice) -> Exprs: ...
    def __getitem__(self, index: int | slice) -> Expr:
        return self.made[index]

    def __iter__(self) -> Iterator[Expr]:
        return iter(self.made)

    def __len__(self) -> int:
        return len(self.made) if self._count is None else self._count

    def __bool__(self) -> bool:
        return True

    def __eq__(self, other: object) -> bool:
        if isinstance(other, Deferred):
            return self.name == other.name or self.made == other.made
        return self.made == other if isinstance(other, tuple) else NotImplemented

    # of equal expressions with different names caches keep two answers
    def __hash__(self) -> int:
        return hash(self.name)

    def __repr__(self) -> str:
        return repr(self.made)

    def __reduce__(self) -> tuple[type, tuple[Exprs]]:
        return tuple, (self.made,)


def ask(of: Vector, question: str, compute: Callable[[], T]) -> T:
    """Returns the answer to a question about expressions, known or computed."""
    if not isinstance(of, Deferred):
        return compute()
    record = _record.get()
    if record is not None:
        answer = compute()
        record.setdefault(of, {})[question] = answer
        return answer
    problem = of.name.split(" ", 1)[0]
    answers = known(problem).get(of.name, {})
    return answers[question] if question in answers else compute()


@cache
def known(problem: str) -> Mapping[str, Mapping[str, Answer]]:
    path = KNOWN / f"{problem}.json"
    if not path.exists():
        return {}
    answers: dict[str, dict[str, Answer]] = msgspec.json.decode(path.read_bytes())
    return answers


def recorded(work: Callable[[], object]) -> Record:
    record: Record = {}
    token = _record.set(record)
    try:
        work()
    finally:
        _record.reset(token)
    return record


def names_of(invariants: Invariants) -> tuple[str, ...]:
    if isinstance(invariants, Deferred):
        return invariants.names
    return tuple(name for name, _ in invariants)
