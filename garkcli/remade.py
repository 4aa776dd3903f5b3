"""Functions that can be pickled: another process rebuilds them from their arguments."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Generic, TypeVar

T = TypeVar("T")


class Remade(Generic[T]):
    """A picklable function, equal to ``make(*arguments)`` of a module-level one.

    >>> import pickle
    >>> from operator import itemgetter
    >>> first = Remade(lambda row: row[0], itemgetter, 0)
    >>> pickle.loads(pickle.dumps(first))("abc")
    'a'
    """

    def __init__(
        self, function: Callable[..., T], make: Callable[..., Callable[..., T]], *arguments: Any
    ) -> None:
        self._function: Callable[..., T] | None = function
        self._make, self._arguments = make, arguments

    def __call__(self, *given: Any) -> T:
        if self._function is None:
            self._function = self._make(*self._arguments)
        return self._function(*given)

    def __getstate__(self) -> tuple[Any, ...]:
        return self._make, self._arguments

    def __setstate__(self, state: tuple[Any, ...]) -> None:
        self._function = None
        self._make, self._arguments = state
