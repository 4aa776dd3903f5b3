"""The coefficients of a file as numbers in a common exact domain."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from typing import TypeVar

from garkcli.errors import ExpressionError, LimitExceeded, UndefinedValue
from garkcli.exact.domain import Domain
from garkcli.exact.field import Number
from garkcli.exact.matrix import Matrix, Vector
from garkcli.exact.nodes import Expression, parts
from garkcli.exact.rewriting import roots_in
from garkcli.methodfile.numbers import Coefficient, Numbers, Row, Rows
from garkcli.tableau.forms import gark
from garkcli.tableau.tableau import Method, Tableau

T = TypeVar("T")


class Values:
    """The exact values of all coefficients; ``printed`` has each as written and its value."""

    def __init__(self, numbers: Numbers) -> None:
        self._values: dict[int, Number] = {}
        self.printed: tuple[tuple[Expression, Number], ...] = ()
        # equal texts of a file share one expression, which is evaluated once
        expressions = {id(entry.expression): entry.expression for entry in numbers.entries}
        try:
            domain = Domain(expressions.values())
        except (UndefinedValue, LimitExceeded) as error:
            self._find_culprits(numbers, error)
            return
        known = self._evaluate(numbers, domain)
        self.printed = tuple((expressions[key], number) for key, number in known.items())
        unused = (x for name, x in numbers.of_parameters.items() if name not in numbers.used)
        _note_faults(numbers, unused)

    def once(self, key: object, find: Callable[[], T]) -> T:
        """A decision that does not depend on changes of rounded numbers."""
        decided = self.__dict__.setdefault("decided", {})
        if key not in decided:
            decided[key] = find()
        decision: T = decided[key]
        return decision

    def decide_as(self, other: Values) -> None:
        """Uses the decisions of ``once`` from other numbers of the same file."""
        self.__dict__["decided"] = other.__dict__.setdefault("decided", {})

    def alone(self, method: Method) -> Tableau:
        return gark([method], {})

    def _evaluate(self, numbers: Numbers, domain: Domain) -> dict[int, Number]:
        known: dict[int, Number] = {}
        for entry in numbers.entries:
            key = id(entry.expression)
            try:
                if key not in known:
                    known[key] = domain.coefficient(entry.expression)
                self._values[id(entry)] = known[key]
            except ExpressionError as error:
                _note(numbers, entry, error)
        return known

    def _find_culprits(self, numbers: Numbers, error: ExpressionError) -> None:
        source = numbers.source
        before = len(source.faults)
        _note_faults(numbers, (*numbers.of_parameters.values(), *numbers.entries))
        if len(source.faults) > before:
            return
        with_roots = (x for x in numbers.entries if any(roots_in(x.expression)))
        source.fault(next(with_roots).node, error.message, error.help, code=error.code)

    def number(self, entry: Coefficient) -> Number:
        return self._values[id(entry)]

    def vector(self, row: Row) -> Vector:
        return tuple(self._values[id(entry)] for entry in row)

    def matrix(self, rows: Rows) -> Matrix:
        return tuple(self.vector(row) for row in rows)


def _note_faults(numbers: Numbers, entries: Iterable[Coefficient]) -> None:
    for entry in entries:
        error = _fault_of(entry)
        if error is not None:
            _note(numbers, entry, error)


def _fault_of(entry: Coefficient) -> ExpressionError | None:
    try:
        domain = Domain([entry.expression], only_check=True)
        if not any(roots_in(entry.expression)):
            domain.evaluate(entry.expression)
    except ExpressionError as error:
        return error
    return None


def _note(numbers: Numbers, entry: Coefficient, error: ExpressionError) -> None:
    """Reports why a coefficient has no value, at its parameter if that is the cause."""
    source = numbers.source
    within = set(_identities(entry.expression))
    for given in numbers.of_parameters.values():
        own = _fault_of(given) if id(given.expression) in within else None
        if own is not None and own.message == error.message:
            cause = f"{given.where}: {own.message}"
            source.expression_fault(given.node, given.where, own, cause)
            if entry is not given:
                again = entry.where, cause
                source.fault(entry.node, own.message, own.help, 0, *again, code=own.code)
            return
    source.expression_fault(entry.node, entry.where, error)


def _identities(expression: Expression) -> Iterator[int]:
    yield id(expression)
    for part in parts(expression):
        yield from _identities(part)
