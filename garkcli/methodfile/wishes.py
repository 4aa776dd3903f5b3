"""``design`` of a method file: what is wanted of the methods of a family besides their order."""

from __future__ import annotations

from dataclasses import dataclass, fields
from itertools import chain
from typing import Any

from yaml.nodes import MappingNode, Node

from garkcli.deadline import until
from garkcli.design.wants.registry import WANTS, find_want
from garkcli.design.wants.want import Asked, Meaning, Want
from garkcli.errors import GarkError, NotDecided, counted, did_you_mean
from garkcli.exact.nodes import Name
from garkcli.exact.parametric import Parameters
from garkcli.methodfile.numbers import Entry, Free, Numbers
from garkcli.methodfile.parameters import read_range
from garkcli.methodfile.source import Source
from garkcli.methodfile.values import Values
from garkcli.tableau.tableau import Tableau

KEYS = ("order", "fix", "range", *WANTS)
"""The keys of ``design``."""
MOST = 60
"""The largest order that is looked at, as for ``--order``."""
FORM = "write design: {order: 3, stiffly-accurate: true}"


@dataclass(frozen=True)
class Wish:
    """One key of ``design``; a count, a coefficient, or True.

    Attributes:
        node: where it stands.
        want: what is wanted.
        value: as it was read.
        colour: the one it is about, counted from 0; None for all.
    """

    node: Node
    want: Want
    value: int | Entry | bool
    colour: int | None


@dataclass(frozen=True)
class Wishes:
    """All of ``design``.

    Attributes:
        order: that is wanted; None where the command says it.
        fixed: pairs of entries that are equal.
        wishes: everything else.
    """

    order: int | None = None
    fixed: tuple[tuple[Entry, Entry], ...] = ()
    wishes: tuple[Wish, ...] = ()


def read_wishes(source: Source, numbers: Numbers, node: Node | None) -> Wishes:
    """What a file wants; its unknowns are known already.

    Args:
        source: the file.
        numbers: its coefficients.
        node: the value of ``design``; None where there is none.
    """
    if node is None:
        return Wishes()
    entries = source.mapping(node, "design", KEYS, form=FORM)
    order = None
    if "order" in entries:
        order = _count(source, entries["order"], "design: order")
    fixed: list[tuple[Entry, Entry]] = []
    if "fix" in entries:
        fixed = _fixed(source, numbers, entries["fix"])
    if "range" in entries:
        _ranges(source, numbers, entries["range"])
    wishes = []
    for key, value in entries.items():
        if key not in {"order", "fix", "range"}:
            wishes += _wishes(source, numbers, find_want(key), value)
    return Wishes(order, tuple(fixed), tuple(wishes))


def _fixed(source: Source, numbers: Numbers, node: Node) -> list[tuple[Entry, Entry]]:
    """``fix: {c2: 2*gamma}``: unknowns with their values, which may have other unknowns."""
    fixed = []
    entries = source.mapping(node, "design: fix", (), form=FORM)
    for name, value in entries.items():
        where = f"design: fix: {name}"
        if name in numbers.settings:
            continue
        if name not in numbers.free:
            cure = did_you_mean(name, list(numbers.free))
            source.fault(value, f"{where} is no unknown of the file", cure)
            continue
        entry = numbers.entry(value, where)
        unknown = Entry(Name(name), value, where)
        numbers.entries.append(unknown)
        fixed.append((unknown, entry))
    return fixed


def _ranges(source: Source, numbers: Numbers, node: Node) -> None:
    """``range: {gamma: [1/4, 1]}``: where unknowns lie, besides the ranges that they have."""
    entries = source.mapping(node, "design: range", (), form=FORM)
    for name, value in entries.items():
        where = f"design: range: {name}"
        if name in numbers.free:
            known = numbers.free[name]
            ranges = (*known.ranges, *read_range(numbers, value, where))
            numbers.free[name] = Free(known.node, ranges, known.where)
        elif name not in numbers.settings:
            cure = did_you_mean(name, list(numbers.free))
            source.fault(value, f"{where} is no unknown of the file", cure)


def _wishes(source: Source, numbers: Numbers, want: Want, node: Node) -> list[Wish]:
    """One wish, or one for each colour that is named."""
    if not isinstance(node, MappingNode):
        found = _value(source, numbers, want, node)
        return [] if found is None else [Wish(node, want, found, None)]
    where = f"design: {want.key}"
    wishes = []
    for name, value in source.mapping(node, where, ()).items():
        if not name.isdigit() or int(name) < 1:
            message = f"{where}: {name} is no colour"
            source.fault(value, message, "colours count from 1: {2: true}")
            continue
        found = _value(source, numbers, want, value)
        if found is not None:
            colour = int(name) - 1
            wishes.append(Wish(value, want, found, colour))
    return wishes


def _value(source: Source, numbers: Numbers, want: Want, node: Node) -> int | Entry | bool | None:
    """The value of a wish; None where it is faulty, or says that nothing is wanted."""
    where = f"design: {want.key}"
    if want.kind == "count":
        return _count(source, node, where)
    if want.kind == "number":
        return numbers.entry(node, where)
    word = source.choice(node, where, ("true", "false"))
    return True if word == "true" else None


def _count(source: Source, node: Node, where: str) -> int | None:
    """An order; None where it is faulty."""
    return source.whole(node, where, smallest=1, largest=MOST)


def _colours_of(wish: Wish, size: int, source: Source) -> tuple[int, ...]:
    """The colours that a wish is about; none where the method lacks the one it names."""
    if wish.colour is None:
        return tuple(range(size))
    if wish.colour < size:
        return (wish.colour,)
    message = f"design: {wish.want.key}: no colour {wish.colour + 1}"
    cure = f"the method has {counted(size, 'colour')}"
    source.fault(wish.node, message, cure)
    return ()


def meaning_of(
    wishes: Wishes,
    tableau: Tableau,
    ring: Parameters,
    values: Values,
    source: Source,
    deadline: float | None = None,
) -> Meaning:
    """Everything that is wanted, as conditions on the parameters.

    Args:
        wishes: as they were read.
        tableau: of the family.
        ring: its parameters.
        values: the coefficients of the file.
        source: the file, where wishes that make no sense for it are noted.
        deadline: the reading of ``time.monotonic`` at which what is not worked out is left
            unsettled; None for never.
    """
    meanings = []
    for unknown, given in wishes.fixed:
        difference = values.number(unknown) - values.number(given)
        meanings.append(Meaning(zeros=(difference,)))
    for wish in wishes.wishes:
        colours = _colours_of(wish, tableau.size, source)
        if not colours:
            continue
        value = wish.value
        number = values.number(value) if isinstance(value, Entry) else value
        try:
            with until(deadline):
                meanings.append(wish.want.meaning(Asked(tableau, ring, number, colours)))
        except NotDecided:
            meanings.append(Meaning(unsettled=(wish.want.key,)))
        except GarkError as error:
            source.fault(wish.node, error.message, error.help)
    return _together(meanings)


def _together(meanings: list[Meaning]) -> Meaning:
    """What several wishes mean, together."""
    together: dict[str, Any] = {}
    for field in fields(Meaning):
        parts = [getattr(one, field.name) for one in meanings]
        together[field.name] = tuple(chain.from_iterable(parts))
    return Meaning(**together)
