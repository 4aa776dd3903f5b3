"""Numbers of several methods, brought into one number field."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from itertools import chain

from garkcli.exact.domain import Domain
from garkcli.exact.field import Algebraic, Number, NumberField, with_radicals
from garkcli.exact.matrix import Matrix, Vector
from garkcli.exact.nodes import Expression


class OneField:
    """The smallest field that holds all of some numbers, and the map into it.

    Numbers can be added when they come from one ``NumberField`` object; those of two
    files never do, though both may be in ℚ(√3).

    Args:
        numbers: from any fields; None of them needs to be irrational.

    Raises:
        LimitExceeded: together they generate too large a field.

    >>> from garkcli.exact.expression import parse
    >>> c = [parse(text) for text in ("sqrt(12)", "2*sqrt(3)", "sqrt(5)")]
    >>> one, other, third = (Domain([x]).evaluate(x) for x in c)
    >>> into = OneField([one, other, third])
    >>> into.number(one) == into.number(other)
    True
    >>> into.number(one) * into.number(third)
    2*sqrt(3)*sqrt(5)
    """

    def __init__(self, numbers: Iterable[Number]) -> None:
        fields = _fields_of(numbers)
        self._images: dict[int, list[Number]] = {}
        self._fields = fields
        if len(fields) < 2:
            return
        radicals: list[Expression] = []
        for field in fields:
            radicals += [radical for radical, _ in field.radicals]
        domain = Domain(radicals)
        for field in fields:
            values = [domain.evaluate(x) for x, _ in field.radicals]
            self._images[id(field)] = values

    def number(self, number: Number) -> Number:
        """The same number in the common field."""
        if not isinstance(number, Algebraic) or not self._images:
            return number
        image: Number = with_radicals(number, self._images[id(number.field)])
        return image

    def vector(self, row: Sequence[Number]) -> Vector:
        """A row, number by number."""
        return tuple(map(self.number, row))

    def matrix(self, rows: Sequence[Sequence[Number]]) -> Matrix:
        """A block, number by number."""
        return tuple(map(self.vector, rows))


def _fields_of(numbers: Iterable[Number]) -> list[NumberField]:
    """The different field objects that numbers come from."""
    found: dict[int, NumberField] = {}
    for number in numbers:
        if isinstance(number, Algebraic):
            found.setdefault(id(number.field), number.field)
    return list(found.values())


def all_numbers(rows: Iterable[Sequence[Number]]) -> Iterable[Number]:
    """The numbers of several rows, one after the other."""
    return chain.from_iterable(rows)
