"""The rounded numbers of a file, and the method with other numbers in their place."""

from __future__ import annotations

from collections.abc import Callable, Container, Iterator, Mapping, Sequence
from typing import Any, TypeAlias

from flint import arb, ctx, fmpq

from garkcli.exact import nodes
from garkcli.exact.enclosing import OPERATIONS, enclose, midpoint, real_root
from garkcli.exact.field import ONE, Number
from garkcli.exact.parametric import Parametric
from garkcli.frozen import replace
from garkcli.grammar.source import Source
from garkcli.methodfile.build import Builder
from garkcli.methodfile.description import Content, PartText
from garkcli.methodfile.number_tolerances import NumberTolerances
from garkcli.methodfile.numbers import Coefficient, Numbers
from garkcli.methodfile.printed import is_long_fraction
from garkcli.methodfile.tolerance import Tolerance, same_for_all
from garkcli.methodfile.values import Values
from garkcli.order.meant import Radii
from garkcli.tableau.box import Box, rational_or_ball, to_points
from garkcli.tableau.embedded import as_colours

INDETERMINATE = "_number"
_Rounded: TypeAlias = tuple[Coefficient, nodes.Expression, Number]


def rounded_of(
    built: Builder[Values], numbers: Numbers, content: Content, tolerance: Tolerance
) -> Rounded:
    """The decimals and the long fractions; if there are none, but one tolerance for the whole file,
    every nonzero coefficient. Short fractions and roots of exact numbers are exact.
    """
    named = {id(x) for known in numbers.parameters.values() for x in _all_parts(known.expression)}
    tolerances = NumberTolerances(tolerance, content, numbers.entries)
    return Rounded(numbers.entries, built.values, tolerances, apart=named)


def box_of(built: Builder[Values], numbers: Numbers, content: Content, radii_of: Radii) -> Box:
    """All methods that a file may stand for; ``radii_of`` gives 0 for exact numbers."""
    rounded = rounded_of(built, numbers, content, same_for_all(ONE))
    radii = radii_of(list(zip(rounded.written, rounded.numbers, strict=True)))
    kept = [k for k, radius in enumerate(radii) if radius]
    make = rounded.maker(built.text)

    def make_with(moved: Sequence[Any]) -> Any:
        every = list(map(rational_or_ball, rounded.numbers))
        for k, x in zip(kept, moved, strict=True):
            every[k] = x
        return make(every)

    return Box(tuple(rounded.numbers[k] for k in kept), tuple(radii[k] for k in kept), make_with)


class Rounded:
    """A rounded number is a decimal, a long fraction, or a root of a polynomial with decimals."""

    def __init__(
        self,
        coefficients: Sequence[Coefficient],
        known: Values,
        tolerances: NumberTolerances,
        given: Container[int] = (),
        apart: Container[int] | None = None,
    ) -> None:
        self.known, self._coefficients, self._tolerances = known, coefficients, tolerances
        self.expressions = {
            id(x): x.expression if apart is None else _copied(x.expression, apart)
            for x in coefficients
        }
        rounded: list[_Rounded] = []
        mixed: list[_Rounded] = []
        printed: list[_Rounded] = []
        for entry in coefficients:
            expression = self.expressions[id(entry)]
            number: Any = known.number(entry)
            if is_of_unknowns(expression, given):
                # what has unknowns in it is no single number
                mixed += [(entry, *x) for x in _rounded_in(expression, fmpq(0))]
                continue
            if isinstance(number, Parametric):
                # roots are unknowns there: what they make may be 0
                number = _value(expression)
            if number:
                printed.append((entry, expression, number))
                rounded += [(entry, *x) for x in _rounded_in(expression, number)]
        is_bare = not rounded and all(id(x) in given for _, x, _ in mixed)
        if is_bare and tolerances.tolerance.is_single:
            rounded = printed
        rounded += mixed
        radii: dict[int, fmpq] = {}
        numbers: dict[int, Number] = {}
        written: dict[int, nodes.Expression] = {}
        self.keys: set[str] = set()
        self._largest: dict[str, fmpq] = {}
        for entry, part, value in rounded:
            t = tolerances.radius(entry, part)
            numbers.setdefault(id(part), value)
            written[id(part)] = part
            radii[id(part)] = min(t, radii.get(id(part), t))
            if t:
                self.keys.add(tolerances.key_of(entry))
        for entry, part, _ in rounded:
            kind, t = tolerances.kind_of(entry), radii[id(part)]
            self._largest[kind] = max(t, self._largest.get(kind, t))
        kept = [key for key, t in radii.items() if t or key in given]
        self.places = {key: number for number, key in enumerate(kept)}
        self.numbers = tuple(numbers[key] for key in kept)
        self.written = tuple(written[key] for key in kept)
        self.radii = tuple(radii[key] for key in kept)
        self.is_given = tuple(key in given for key in kept)

    def refuse_keys(self, source: Source) -> None:
        """Raises MethodFileError for keys of ``tolerance`` that apply to no number."""
        for node, message, cure, code in self._tolerances.refusals(self.keys):
            source.fault(node, message, cure, code=code)
        source.close()

    def largest(self, *kinds: str) -> fmpq:
        return max((self._largest.get(kind, fmpq(0)) for kind in kinds), default=fmpq(0))

    def box(self, text: PartText) -> Box:
        return Box(self.numbers, self.radii, self.maker(text))

    def maker(self, text: PartText) -> Callable[[Sequence[Any]], Any]:
        def make(numbers: Sequence[Any]) -> Any:
            with ctx.workprec(max(ctx.prec, 64)):
                return self.made(text, numbers)

        return make

    def literals(self, numbers: Sequence[fmpq]) -> Mapping[int, nodes.Expression]:
        """Other numbers by the identity of the expressions that they replace."""
        return {key: nodes.Literal(numbers[place]) for key, place in self.places.items()}

    def indeterminates(self) -> Mapping[int, nodes.Expression]:
        """Names for rounded numbers, also in sums printed as 0, and for roots of known numbers."""
        names: dict[int, nodes.Expression] = {}
        for entry in self._coefficients:
            expression = self.expressions[id(entry)]
            every = list(_all_parts(expression))
            named = [x for x in every if id(x) in self.places]
            named += [x for x, _ in _rounded_in(expression, self.known.number(entry))]
            roots = (x for x in every if isinstance(x, nodes.Root | nodes.AlgebraicRoot))
            named += [x for x in roots if not is_of_unknowns(x, ())]
            for x in named:
                names.setdefault(id(x), nodes.Name(f"{INDETERMINATE}{len(names)}"))
        return names

    @staticmethod
    def changer(
        instead: Mapping[int, nodes.Expression],
    ) -> Callable[[nodes.Expression], nodes.Expression]:
        """A root of a polynomial with decimals becomes a decimal of the precision."""
        known: dict[int, nodes.Expression] = {}

        def change(expression: nodes.Expression) -> nodes.Expression:
            key = id(expression)
            if key not in known:
                known[key] = changed(expression)
            return known[key]

        def changed(expression: nodes.Expression) -> nodes.Expression:
            if id(expression) in instead:
                return instead[id(expression)]
            match expression:
                case nodes.Chain(operands=operands):
                    return replace(expression, operands=tuple(map(change, operands)))
                case nodes.Power(base=base):
                    return replace(expression, base=change(base))
                case nodes.Root(radicand=radicand):
                    expression = replace(expression, radicand=change(radicand))
                    if is_of_unknowns(expression, ()):
                        return expression
                    return nodes.Literal(midpoint(enclose(expression)))
                case nodes.AlgebraicRoot():
                    return nodes.Literal(midpoint(enclose(expression)))
            return expression

        return change

    def made(self, text: PartText, numbers: Sequence[Any]) -> Any:
        builder = Builder(text, _Moved(self._coefficients, self, numbers))
        return to_points(as_colours(builder.tableau, builder.further))


def _all_parts(expression: nodes.Expression) -> Iterator[nodes.Expression]:
    yield expression
    for part in nodes.parts(expression):
        yield from _all_parts(part)


def _copied(expression: nodes.Expression, kept: Container[int]) -> nodes.Expression:
    if id(expression) in kept:
        return expression
    match expression:
        case nodes.Chain(operands=operands):
            return replace(expression, operands=tuple(_copied(x, kept) for x in operands))
        case nodes.Power(base=base):
            return replace(expression, base=_copied(base, kept))
        case nodes.Root(radicand=radicand):
            return replace(expression, radicand=_copied(radicand, kept))
    return replace(expression)


def is_of_unknowns(expression: nodes.Expression, given: Container[int]) -> bool:
    if isinstance(expression, nodes.Name) or id(expression) in given:
        return True
    return any(is_of_unknowns(x, given) for x in nodes.parts(expression))


def _rounded_in(
    expression: nodes.Expression, value: Number
) -> Iterator[tuple[nodes.Expression, Number]]:
    if is_long_fraction(expression, value):
        yield expression, value
        return
    if expression.decimals:
        own = _value(expression)
        if own:
            yield expression, own
        return
    if isinstance(expression, nodes.Literal) and expression.value and nodes.is_decimal(expression):
        yield expression, expression.value
    for part in nodes.parts(expression):
        yield from _rounded_in(part, part.value if isinstance(part, nodes.Literal) else fmpq(0))


class _Moved(Values):
    def __init__(
        self, coefficients: Sequence[Coefficient], rounded: Rounded, numbers: Sequence[Any]
    ) -> None:
        known, places = rounded.known, rounded.places
        self._values = {}
        self.decide_as(known)
        self.printed = ()
        self._places, self._numbers = places, numbers
        self._found: dict[int, Any] = {}
        for entry in coefficients:
            value = known.number(entry)
            moved = self._value(rounded.expressions[id(entry)]) if value else None
            self._values[id(entry)] = rational_or_ball(value) if moved is None else moved

    def _value(self, expression: nodes.Expression) -> Any:
        key = id(expression)
        if key not in self._found:
            self._found[key] = self._moved(expression)
        return self._found[key]

    def _moved(self, expression: nodes.Expression) -> Any:
        place = self._places.get(id(expression))
        if place is not None:
            return self._numbers[place]
        match expression:
            case nodes.Chain(signs=signs, operands=operands):
                moved = [self._value(x) for x in operands]
                if all(x is None for x in moved):
                    return None
                total: Any = fmpq(0) if signs[0] in "+-" else fmpq(1)
                for sign, operand, x in zip(signs, operands, moved, strict=True):
                    total = OPERATIONS[sign](total, _exact(operand) if x is None else x)
                return total
            case nodes.Power(base=base, exponent=exponent):
                inner = self._value(base)
                return None if inner is None else inner**exponent
            case nodes.Root(radicand=radicand, index=index):
                inner = self._value(radicand)
                if isinstance(inner, (fmpq, arb)):
                    return real_root(arb(inner), index)
                return None if inner is None else inner.root(index)
        return None


def _exact(expression: nodes.Expression) -> Any:
    return rational_or_ball(_value(expression))


def _value(expression: nodes.Expression) -> Number:
    from garkcli.exact.domain import Domain

    return Domain([expression]).coefficient(expression)
