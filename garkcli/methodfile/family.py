"""Files with free parameters: families of methods, coefficients rational functions of them."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, cast

from flint import fmpq, fmpq_mpoly, fmpz_poly
from yaml.nodes import Node

from garkcli.design.wants.want import numerators, sign_polynomial
from garkcli.errors import ExpressionError, LimitExceeded, MethodError
from garkcli.exact.domain import Domain, perfect_root
from garkcli.exact.field import ZERO, Number
from garkcli.exact.nodes import AlgebraicRoot, Expression, Name, Root
from garkcli.exact.parametric import Parameters, Parametric, fraction
from garkcli.exact.rewriting import roots_in
from garkcli.exact.roots import RealRoot
from garkcli.methodfile.description import (
    ArkText,
    ButcherText,
    Description,
    MethodsText,
    PrkText,
    TableauText,
)
from garkcli.methodfile.load import (
    NO_SETTINGS,
    built,
    described,
    read_method_text,
)
from garkcli.methodfile.numbers import Free, Numbers, Values
from garkcli.methodfile.reader import Reader
from garkcli.methodfile.source import one_line
from garkcli.methodfile.wishes import meaning_of, read_wishes
from garkcli.tableau.family import Family, Radical
from garkcli.tableau.tableau import Tableau

MAX_DEGREE = 200
"""Largest degree of a coefficient in the parameters."""
ROOT = "_root"
"""What the names of unknowns begin with that stand for radicals."""


@dataclass(frozen=True, repr=False, kw_only=True)
class FamilyFile(Family):
    """One method file with free parameters, read.

    Attributes:
        source: the path as given.
        text: the file as it was read.
        settings: values that were given for other parameters.
        places: where in the text the value of each parameter stands, from and to.
        shape: where ``unknown: …`` stands, and the tableau that it means as keys of a method file;
            None where the file has no shape.
        wanted_at: where ``design: …`` stands; None where there is none.
    """

    source: str
    text: str
    settings: Mapping[str, str]
    places: Mapping[str, tuple[int, int]]
    shape: tuple[tuple[int, int], str] | None = None
    wanted_at: tuple[int, int] | None = None


def load_family(
    path: str, settings: Mapping[str, str] = NO_SETTINGS
) -> FamilyFile:
    """Read a method file with free parameters.

    Raises:
        MethodFileError: every fault of the file, with positions.
        MethodError: it has no free parameter.
    """
    return loads_family(*read_method_text(path), settings)


def loads_family(
    text: str,
    source: str = "<text>",
    settings: Mapping[str, str] = NO_SETTINGS,
) -> FamilyFile:
    r"""Read a method file with free parameters from its text.

    Args:
        text: of the file.
        source: what to call it.
        settings: values of parameters, by name, in place of those in the file.

    Raises:
        MethodFileError: every fault of the file, with positions.
        MethodError: it has no free parameter.

    >>> family = loads_family("parameters: {t: free}\nA: [[0, 0], [t, 0]]\nb: [0, 1]")
    >>> family.tableau.block(0, 0)
    ((0, 0), (t, 0))
    """
    reader, description = described(text, source, settings)
    numbers = reader.numbers
    if not numbers.free:
        reader.source.close()
        raise MethodError(
            f"{source} has no free parameter",
            'write parameters: {tau: free} in place of a value, or "?" for an entry',
        )
    wishes = read_wishes(reader.source, numbers, reader.design)
    tableau, values = built(reader, description, FamilyValues)
    ring = values.domain.ring
    meaning = meaning_of(wishes, tableau, ring, values, reader.source)
    ranges = {}
    for name, free in numbers.free.items():
        ranges[name] = _ends(free, values)
    reader.source.close()
    return FamilyFile(
        source=source,
        text=text,
        name=one_line(description.name) or source,
        tableau=tableau,
        ring=ring,
        parameters=tuple(numbers.free),
        ranges=ranges,
        radicals=tuple(values.domain.radicals),
        relations=(
            *_of_nodes(description, tableau),
            *numerators(meaning.zeros, ring),
        ),
        nonzero=meaning.nonzero,
        positive=tuple(sign_polynomial(x, ring) for x in meaning.positive),
        not_negative=tuple(
            sign_polynomial(x, ring) for x in meaning.not_negative
        ),
        order=wishes.order,
        wanted_at=reader.design_place(),
        settings=settings,
        places={
            name: _place(text, node) for name, node in numbers.places.items()
        },
        shape=_shape(reader),
    )


def _of_nodes(
    description: Description, tableau: Tableau
) -> Iterator[fmpq_mpoly]:
    """Where a node is given and it or its row is unknown: the node minus the sum of the row."""
    for l in _with_given_nodes(description):
        colour = tableau.colours[l]
        rows = colour.space
        block = tableau.blocks.get((rows, l)) or tableau.blocks.get(
            (rows, 1 - l)
        )
        if block is None:
            continue
        for node, row in zip(colour.c, block, strict=True):
            difference: object = node - sum(row, start=ZERO)
            if isinstance(difference, Parametric):
                yield difference.numerator


def _with_given_nodes(description: Description) -> list[int]:
    """The colours whose nodes stand in the file."""
    content = description.content
    given: Sequence[object]
    match content:
        case TableauText():
            given = list(content.c)
        case ArkText():
            given = [content.c] * len(content.A)
        case PrkText():
            # the rows of q.A are the stages of the forces
            parts = [content.q.c, content.p.c]
            given = (
                parts if description.structure == "general" else parts[::-1]
            )
        case MethodsText():
            methods = content.methods
            given = [
                x.c if isinstance(x, ButcherText) else None for x in methods
            ]
            if description.structure != "general":
                return []
    return [l for l, nodes in enumerate(given) if nodes is not None]


def _shape(reader: Reader) -> tuple[tuple[int, int], str] | None:
    """Where a shape stands in the file, and what it means."""
    if reader.shaped is None:
        return None
    from garkcli.methodfile.shaped import spelled

    text = spelled(reader.shaped.layout)
    if reader.shaped.form == "prk" and "structure" not in reader.keys:
        text += "\nstructure: separable"
    return reader.shaped.place, text


def _place(text: str, node: Node) -> tuple[int, int]:
    """From where to where a value stands in the text of its file."""
    start, end = node.start_mark.index, node.end_mark.index
    return start, start + len(text[start:end].rstrip())


def with_values(
    family: FamilyFile, values: Mapping[str, str], head: str, claim: str
) -> str:
    """The text of a family's file with values for its parameters: that of a method.

    Args:
        family: as it was read.
        values: of each free parameter, as text.
        head: a comment to begin with, how the values were found.
        claim: what the method is known to be, such as ``order: 4``; added where the file makes no
            claims of its own.
    """
    text = family.text
    given = {**family.settings, **values}
    changes = []
    for name, place in family.places.items():
        if name in given:
            changes.append((place, _scalar(given[name])))
    if family.shape is not None:
        place, tableau = family.shape
        lines = [
            f"  {name}: {_scalar(value)}" for name, value in given.items()
        ]
        changes.append((place, "\n".join(["parameters:", *lines, tableau])))
    if family.wanted_at is not None:
        # its names are those of unknowns, which the file has no more
        changes.append((family.wanted_at, ""))
    for (start, end), change in sorted(changes, reverse=True):
        text = text[:start] + change + text[end:]
    lines = [f"# {line}" for line in head.splitlines()]
    if "expect:" not in text:
        text = f"{text.rstrip()}\nexpect: {{{claim}}}"
    return "\n".join([*lines, text.rstrip()]) + "\n"


def _scalar(value: str) -> str:
    """A value as YAML has it in any place."""
    is_plain = value.replace("/", "").replace("-", "").isdigit()
    return value if is_plain else f'"{value}"'


def _ends(free: Free, values: FamilyValues) -> tuple[fmpq | None, fmpq | None]:
    ends = []
    for entry in (free.smallest, free.largest):
        value = None
        if entry is not None:
            value = values.plain(entry.expression)
            if value is None:
                message = f"{entry.where}: a rational number is expected"
                values.numbers.source.fault(
                    entry.node, message, "write [1/4, 1]"
                )
        ends.append(value)
    smallest, largest = ends
    return smallest, largest


class FamilyValues(Values):
    """The coefficients of a file as rational functions of its free parameters.

    Radicals are unknowns of their own, with the relation that they satisfy.
    """

    def __init__(self, numbers: Numbers) -> None:
        self.numbers = numbers
        self.printed = ()
        self._values: dict[int, Number] = {}
        names = list(numbers.free)
        self.domain = _FamilyDomain(
            names, [x.expression for x in numbers.entries]
        )
        known: dict[int, Number] = {}
        for entry in numbers.entries:
            key = id(entry.expression)
            try:
                if key not in known:
                    known[key] = self.domain.evaluate(entry.expression)
                self._values[id(entry)] = known[key]
            except ExpressionError as error:
                numbers.source.expression_fault(entry.node, entry.where, error)

    def plain(self, expression: Expression) -> fmpq | None:
        """The value of an expression where it is a rational number."""
        if any(roots_in(expression)):
            return None
        try:
            value = self.domain.evaluate(expression)
        except ExpressionError:
            return None
        return value if isinstance(value, fmpq) else None


class _FamilyDomain(Domain):
    """Evaluates expressions to rational functions of parameters."""

    def __init__(
        self, names: list[str], expressions: list[Expression]
    ) -> None:
        found: dict[Root | AlgebraicRoot, None] = {}
        for expression in expressions:
            found.update(dict.fromkeys(roots_in(expression)))
        self._names = {
            root: f"{ROOT}{i}" for i, root in enumerate(found, start=1)
        }
        self.ring = Parameters([*names, *self._names.values()])
        self.radicals: list[Radical] = []
        self._values = {}
        self._are_real = True
        self.field = None
        for root in found:  # the inner ones first
            self._values[root] = self._root(root)

    def _root(self, root: Root | AlgebraicRoot) -> Number:
        if isinstance(root, AlgebraicRoot):
            return self._root_of_polynomial(root)
        radicand = self.evaluate(root.radicand)
        if isinstance(radicand, fmpq):
            rational = perfect_root(root, radicand)
            if rational is not None:
                return rational
        name = self._names[root]
        unknown = self.ring.parameter(name)
        relation = cast(
            "Parametric", unknown**root.index - cast("Any", radicand)
        )
        is_even = root.index % 2 == 0
        self.radicals.append(
            Radical(name, relation.numerator, is_positive=is_even)
        )
        return cast("Number", unknown)

    def _root_of_polynomial(self, root: AlgebraicRoot) -> Number:
        name = self._names[root]
        unknown = self.ring.parameter(name).numerator
        relation = self.ring.constant(fmpq(0))
        for coefficient in reversed(root.coefficients):
            relation = relation * unknown + coefficient
        meant = RealRoot(fmpz_poly(list(root.coefficients)), root.number)
        self.radicals.append(Radical(name, relation, meant=meant))
        return cast("Number", self.ring.parameter(name))

    def evaluate(self, expression: Expression) -> Number:
        if isinstance(expression, Name):
            return cast("Number", self.ring.parameter(expression.name))
        return super().evaluate(expression)

    def _power(self, number: Number, exponent: int, at: Expression) -> Number:
        numerator, denominator = fraction(number, self.ring)
        degree = numerator.total_degree() + denominator.total_degree()
        if degree > 0 and degree * abs(exponent) > MAX_DEGREE:
            message = f"a degree of more than {MAX_DEGREE} in the parameters"
            raise LimitExceeded(message, "write it smaller", at.start, at.end)
        return super()._power(number, exponent, at)
