"""The numbers of a file that are rounded, and the method that others in their place make."""

from __future__ import annotations

from collections.abc import Callable, Container, Iterator, Sequence
from typing import TYPE_CHECKING, Any

from flint import ctx, fmpq

from garkcli.exact.enclosing import OPERATIONS, enclose
from garkcli.exact.field import Number
from garkcli.exact.nodes import AlgebraicRoot, Chain, Expression, Literal, Name, Power, Root
from garkcli.exact.rewriting import parts
from garkcli.frozen import replace
from garkcli.methodfile.build import Builder
from garkcli.methodfile.numbers import Entry, Numbers
from garkcli.methodfile.printed import is_long_fraction
from garkcli.methodfile.values import Values
from garkcli.tableau.box import Box, rational_or_ball, to_points
from garkcli.tableau.embedded import as_colours

if TYPE_CHECKING:
    from garkcli.methodfile.description import PartText


def box_of(built: Builder[Values], numbers: Numbers, tolerance: fmpq) -> Box:
    """All methods that a file may mean: each decimal in it may be off by the tolerance, and each
    fraction with a long denominator; short fractions and radicals are exact. Where there is none
    of these, each coefficient that is not 0 may be off.

    Args:
        built: the method, with the values of the file.
        numbers: the coefficients of the file.
        tolerance: by how much they may be off.
    """
    named = {id(x) for text in numbers.parameters.values() for x in _all_parts(text)}
    rounded = Rounded(numbers.entries, built.values, apart=named)
    radii = (tolerance,) * len(rounded.places)
    return Box(rounded.numbers, radii, rounded.maker(built.text))


class Rounded:
    """The rounded numbers of a file, each with its place: a literal, or an expression that is a
    long fraction or has a root of rounded numbers in it.

    Args:
        coefficients: of the file.
        known: their values, as they are printed.
        given: the literals, by their identity, that take the place of unknowns: they are rounded
            as they are written, and entries with them are not what the file prints.
        apart: where equal texts, which are read once, may be roundings of several numbers: the
            expressions, by their identity, that are one number wherever they are, those of
            parameters. None where equal texts are one number.

    Attributes:
        places: of each, by the identity of its expression.
        numbers: as they are printed.
        is_given: of each, whether it takes the place of an unknown.
    """

    def __init__(
        self,
        coefficients: Sequence[Entry],
        known: Values,
        given: Container[int] = (),
        apart: Container[int] | None = None,
    ) -> None:
        self.known, self._coefficients = known, coefficients
        self.expressions = {
            id(x): x.expression if apart is None else _copied(x.expression, apart)
            for x in coefficients
        }
        self.places: dict[int, int] = {}
        found: list[Number] = []
        entries = [(self.expressions[id(x)], known.number(x)) for x in coefficients]
        printed = [x for x in entries if x[1] and not is_of_unknowns(x[0], given)]
        rounded = [y for x in printed for y in _rounded_in(*x)]
        # what has unknowns in it is no single number
        mixed = [x for x, _ in entries if is_of_unknowns(x, given)]
        inside = [y for x in mixed for y in _rounded_in(x, fmpq(0))]
        own = [x for x in inside if id(x[0]) in given]
        if not rounded and len(inside) == len(own):
            rounded = printed
        for expression, number in (*rounded, *inside):
            if id(expression) not in self.places:
                self.places[id(expression)] = len(found)
                found.append(number)
        self.numbers = tuple(found)
        self.is_given = tuple(x in given for x in self.places)

    def maker(self, text: PartText) -> Callable[[Sequence[Any]], Any]:
        """What makes the method of other numbers."""

        def make(numbers: Sequence[Any]) -> Any:
            with ctx.workprec(max(ctx.prec, 64)):
                return self.made(text, numbers)

        return make

    def changer(self, numbers: Sequence[fmpq]) -> Callable[[Expression], Expression]:
        """What puts other numbers into expressions; a root of numbers becomes one of its digits
        too, as many as the bits of the context leave.
        """
        known: dict[int, Expression] = {}

        def change(expression: Expression) -> Expression:
            key = id(expression)
            if key not in known:
                known[key] = changed(expression)
            return known[key]

        def changed(expression: Expression) -> Expression:
            if id(expression) in self.places:
                return Literal(numbers[self.places[id(expression)]])
            match expression:
                case Chain(operands=operands):
                    return replace(expression, operands=tuple(map(change, operands)))
                case Power(base=base):
                    return replace(expression, base=change(base))
                case Root() | AlgebraicRoot() if not is_of_unknowns(expression, ()):
                    return Literal(enclose(expression).mid().fmpq())
            return expression

        return change

    def made(self, text: PartText, numbers: Sequence[Any]) -> Any:
        """The method with other numbers, further weights as colours."""
        builder = Builder(text, _Moved(self._coefficients, self, numbers))
        return to_points(as_colours(builder.tableau, builder.further))


def _all_parts(expression: Expression) -> Iterator[Expression]:
    """An expression and all that is in it."""
    yield expression
    for part in parts(expression):
        yield from _all_parts(part)


def _copied(expression: Expression, kept: Container[int]) -> Expression:
    """The same expression of new parts, but for those that are kept."""
    if id(expression) in kept:
        return expression
    match expression:
        case Chain(operands=operands):
            return replace(expression, operands=tuple(_copied(x, kept) for x in operands))
        case Power(base=base):
            return replace(expression, base=_copied(base, kept))
    return replace(expression)


def is_of_unknowns(expression: Expression, given: Container[int]) -> bool:
    """Whether unknowns are in an expression, or literals in their place."""
    if isinstance(expression, Name) or id(expression) in given:
        return True
    return any(is_of_unknowns(x, given) for x in parts(expression))


def _rounded_in(expression: Expression, value: Number) -> Iterator[tuple[Expression, Number]]:
    """The rounded numbers in an expression, with their values."""
    if is_long_fraction(expression, value):
        yield expression, value
        return
    match expression:
        case Literal(value=own, text=text):
            if own and ("." in text or "e" in text.lower()):
                yield expression, own
        case Chain(operands=operands):
            parts = [
                _rounded_in(x, x.value if isinstance(x, Literal) else fmpq(0)) for x in operands
            ]
            for part in parts:
                yield from part
        case Power(base=base):
            yield from _rounded_in(base, base.value if isinstance(base, Literal) else fmpq(0))


class _Moved(Values):
    """Values of the coefficients where the rounded numbers in them are others."""

    def __init__(
        self, coefficients: Sequence[Entry], rounded: Rounded, numbers: Sequence[Any]
    ) -> None:
        known, places = rounded.known, rounded.places
        self._values = {}
        self.__dict__["decided"] = known.__dict__.setdefault("decided", {})
        self.printed = ()
        self._places, self._numbers = places, numbers
        self._found: dict[int, Any] = {}
        for entry in coefficients:
            value = known.number(entry)
            moved = self._value(rounded.expressions[id(entry)]) if value else None
            self._values[id(entry)] = rational_or_ball(value) if moved is None else moved

    def _value(self, expression: Expression) -> Any:
        """The value of an expression with other numbers; None where none of them is in it."""
        key = id(expression)
        if key not in self._found:
            self._found[key] = self._moved(expression)
        return self._found[key]

    def _moved(self, expression: Expression) -> Any:
        place = self._places.get(id(expression))
        if place is not None:
            return self._numbers[place]
        match expression:
            case Chain(signs=signs, operands=operands):
                moved = [self._value(x) for x in operands]
                if all(x is None for x in moved):
                    return None
                total: Any = fmpq(0) if signs[0] in "+-" else fmpq(1)
                for sign, operand, x in zip(signs, operands, moved, strict=True):
                    total = OPERATIONS[sign](total, _exact(operand) if x is None else x)
                return total
            case Power(base=base, exponent=exponent):
                inner = self._value(base)
                return None if inner is None else inner**exponent
        return None


def _exact(expression: Expression) -> Any:
    """The value of an expression without rounded numbers."""
    from garkcli.exact.domain import Domain

    return rational_or_ball(Domain([expression]).coefficient(expression))
