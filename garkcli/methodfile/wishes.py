"""``design`` of a method file: demands on the methods of a family besides their order."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from functools import partial
from itertools import chain
from typing import Any

from garkcli.deadline import until
from garkcli.design.want import Asked, Want, WantConditions
from garkcli.errors import GarkError, NotDecided, counted, did_you_mean
from garkcli.exact.nodes import Name
from garkcli.frozen import Frozen, fields
from garkcli.grammar.keys import FLAG, Key, ReadMapping, ValueKind, by_name, count, either, mapping
from garkcli.grammar.nodes import MappingNode, Node
from garkcli.grammar.source import Source
from garkcli.methodfile.build import Builder
from garkcli.methodfile.family_values import FamilyValues
from garkcli.methodfile.numbers import Coefficient, Free, Numbers
from garkcli.methodfile.parameters import NUMBER, RANGE

MOST = 60
FORM = "write design: {order: 3, stiffly-accurate: true}"


_COUNT = count(1, MOST)
_VALUES = {
    "flag": (
        ValueKind(FLAG.schema, lambda at, node, where: FLAG.read(at, node, where) or None),
        "true",
    ),
    "count": (_COUNT, "3"),
    "number": (NUMBER, "0"),
    "smoothness": (count(0, 1), "1"),
}


def _wanted() -> Iterator[Key]:
    from garkcli.constructions.wants import EVERY  # few files have them

    for name, want in EVERY.items():
        value, example = _VALUES[want.kind]
        colours = by_name(value, propertyNames={"pattern": "^[1-9][0-9]*$"})
        schema = either(value, at_mapping=colours).schema
        kind = ValueKind(schema, partial(_wishes, want))
        yield Key(f"{name}: {example}", kind, f"Wanted: {want.summary}.")


def _fixed(at: Any, node: Node, where: str) -> list[tuple[Coefficient, Coefficient]]:
    """Reads ``fix: {c2: 2*gamma}``: unknowns with values, which may contain other unknowns."""
    fixed = []
    for name, value, place in _unknowns(at, node, where):
        entry = at.numbers.entry(value, place)
        unknown = Coefficient(Name(name), value, place)
        at.numbers.entries.append(unknown)
        fixed.append((unknown, entry))
    return fixed


def _ranges(at: Any, node: Node, where: str) -> dict[str, Free]:
    """Reads ``range: {gamma: [1/4, 1]}``: ranges of unknowns, besides those they have."""
    return {
        name: at.numbers.free[name].within(RANGE.read(at, value, place))
        for name, value, place in _unknowns(at, node, where)
    }


def _unknowns(at: Any, node: Node, where: str) -> Iterator[tuple[str, Node, str]]:
    """The unknowns with their nodes and names in messages; reports those not in the file."""
    numbers: Numbers = at.numbers
    for name, value in numbers.source.mapping(node, where, (), form=FORM).items():
        place = f"{where}: {name}"
        if name in numbers.free:
            yield name, value, place
        elif name not in numbers.settings:
            cure = did_you_mean(name, list(numbers.free)) or "the file has no unknowns"
            message = f"{place} is not an unknown of the file"
            numbers.source.fault(value, message, cure, code="unknown-word")


DESIGN = mapping(
    Key(
        "order: 3",
        _COUNT,
        "The order wanted of the method, the conjugate or the pair; --order goes before it.",
    ),
    Key(
        "fix: {c2: 2*gamma}",
        ValueKind(by_name(NUMBER).schema, _fixed),
        "Unknowns with their values, which may have other unknowns in them.",
    ),
    Key(
        "range: {gamma: [1/4, 1]}",
        ValueKind(by_name(RANGE).schema, _ranges),
        "The range of the unknowns, whose ends may be algebraic, such as sqrt(2)/2; gark lists "
        "solutions outside but does not take them.",
    ),
    more=_wanted,
    form=FORM,
)
NO_RANGES: Mapping[str, Free] = {}


class Wish(Frozen):
    """A key of ``design``; ``colour``, counted from 0, is None for all colours."""

    node: Node
    want: Want
    value: int | Coefficient | bool
    colour: int | None


class Wishes(Frozen):
    """``order`` is None if the command has it; ``fixed`` are pairs of equal entries."""

    order: int | None = None
    fixed: tuple[tuple[Coefficient, Coefficient], ...] = ()
    wishes: tuple[Wish, ...] = ()
    ranges: Mapping[str, Free] = NO_RANGES
    entries: tuple[Coefficient, ...] = ()

    def count(self, key: str) -> int | None:
        values = [wish.value for wish in self.wishes if wish.want.key == key]
        return next((x for x in values if isinstance(x, int)), None)


def read_wishes(at: Any, node: Node) -> Wishes:
    numbers: Numbers = at.numbers
    before = len(numbers.entries)
    demands: ReadMapping | dict[str, Any] = DESIGN.read(at, node, "design") or {}
    entries = tuple(numbers.entries[before:])
    del numbers.entries[before:]
    order, fixed = demands.pop("order", None), demands.pop("fix", ())
    ranges = demands.pop("range", NO_RANGES)
    wishes = tuple(chain.from_iterable(demands.values()))
    return Wishes(order, tuple(fixed), wishes, ranges, entries)


def _wishes(want: Want, at: Any, node: Node, where: str) -> list[Wish]:
    kind, _ = _VALUES[want.kind]
    if not isinstance(node, MappingNode):
        value = kind.read(at, node, where)
        return [] if value is None else [Wish(node, want, value, None)]
    wishes = []
    for name, item in at.source.mapping(node, where, ()).items():
        if not name.isdigit() or int(name) < 1:
            message = f"{where}: {name} is not a colour"
            at.source.fault(item, message, "colours count from 1: {2: true}", code="wrong-value")
            continue
        value = kind.read(at, item, where)
        if value is not None:
            wishes.append(Wish(item, want, value, int(name) - 1))
    return wishes


def _colours_of(wish: Wish, size: int, source: Source) -> tuple[int, ...]:
    """The colours to which a demand applies; none if the method lacks the one it names."""
    if wish.colour is None:
        return tuple(range(size))
    if wish.colour < size:
        return (wish.colour,)
    message = f"design, {wish.want.key}: no colour {wish.colour + 1}"
    cure = f"the method has {counted(size, 'colour')}"
    source.fault(wish.node, message, cure, code="wrong-value")
    return ()


def meaning_of(
    wishes: Wishes, made: Builder[FamilyValues], source: Source, deadline: float | None = None
) -> WantConditions:
    """Demands that do not apply are reported; after ``deadline`` the rest stays undecided."""
    from garkcli.constructions.wants import meant_of

    values = made.values
    tableau, ring = made.tableau, values.domain.ring
    pairs = [(values.number(unknown), values.number(given)) for unknown, given in wishes.fixed]
    meanings = [WantConditions(zeros=(unknown - given,)) for unknown, given in pairs]
    for name, free in values.numbers.free.items():
        x: Any = ring.parameter(name)
        bounds = (enumerate(p.coefficients) for p in free.bounds)
        meanings.append(
            WantConditions(not_negative=tuple(sum(a * x**k for k, a in p) for p in bounds))
        )
    for wish in wishes.wishes:
        try:
            want, asked_of = meant_of(wish.want, tableau)
        except GarkError as error:
            source.fault(wish.node, error.message, error.help, code=error.code)
            continue
        colours = _colours_of(wish, asked_of.size, source)
        if not colours:
            continue
        value = wish.value
        number = values.number(value) if isinstance(value, Coefficient) else value
        try:
            with until(deadline):
                radicals = tuple(values.domain.radicals)
                asked = Asked(asked_of, ring, number, colours, made.further, radicals)
                meanings.append(want.meaning(asked))
        except NotDecided:
            meanings.append(WantConditions(unsettled=(wish.want.key,)))
        except GarkError as error:
            source.fault(wish.node, error.message, error.help, code=error.code)
    together: dict[str, Any] = {}
    for name in fields(WantConditions):
        together[name] = tuple(chain.from_iterable(getattr(one, name) for one in meanings))
    return WantConditions(**together)
