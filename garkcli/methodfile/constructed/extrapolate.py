"""``extrapolate``: a method with several numbers of substeps, combined to a higher order."""

from __future__ import annotations

from collections.abc import Sequence

from flint import fmpq
from yaml.nodes import MappingNode, Node, ScalarNode

from garkcli.constructions.extrapolation import extrapolated
from garkcli.errors import MethodError
from garkcli.exact.field import ZERO
from garkcli.exact.matrix import Vector
from garkcli.families.extrapolated import SEQUENCES, sequence
from garkcli.methodfile.coefficient_schema import Schema, closed
from garkcli.methodfile.constructed.parts import METHOD, PartReader, tolerance_of
from garkcli.methodfile.description import ConstructionText, Structure
from garkcli.methodfile.source import Entries
from garkcli.order.deciding import order_of
from garkcli.properties.symmetry import symmetry
from garkcli.tableau.meant import meant
from garkcli.tableau.tableau import Tableau

_KEYS = ("of", "order", "sequence", "from", "symmetric")
_FORM = "write for instance {of: {family: gauss, stages: 1}, order: 6}"
MAX_ORDER = 40
"""Largest order that is extrapolated to."""
MAX_PARTS = 200
"""Most substeps of one row of the extrapolation table."""
_MOST_ROWS = 20


def read(parts: PartReader, node: Node, _: Structure) -> ConstructionText | None:
    """The method and the numbers of its substeps."""
    source = parts.source
    before = len(source.faults)
    entries = source.mapping(node, "extrapolate", _KEYS, form=_FORM)
    if not isinstance(node, MappingNode):
        return None
    part = None
    if "of" in entries:
        part = parts.method(entries["of"], "extrapolate, of")
    else:
        source.fault(node, "extrapolate: of missing", _FORM)
    plan = _Plan(parts, entries)
    if not plan.numbers and plan.wanted is None:
        cure = "give order: 6, or sequence: [1, 2, 3]"
        source.fault(node, "extrapolate: how far is missing", cure)
    if part is None or len(source.faults) > before:
        return None
    tolerance = tolerance_of([part], parts.tolerance)

    def make(tableaus: Sequence[Tableau], _: Vector) -> Tableau:
        (base,) = tableaus
        return plan.made(base, tolerance)

    return ConstructionText(node, (part,), (), make, tolerance_of([part]))


class _Plan:
    """How far a method is extrapolated.

    Attributes:
        word: the sequence by name.
        numbers: it, where it is given number by number.
        wanted: the order; None where the numbers say it.
        base: the order of the method; None where it is to be found.
        is_symmetric: whether its error has every second power only; None where that is to be found.
    """

    def __init__(self, parts: PartReader, entries: Entries) -> None:
        source = parts.source
        self.word = "harmonic"
        self.numbers: tuple[int, ...] = ()
        node = entries.get("sequence")
        if isinstance(node, ScalarNode):
            where = "extrapolate, sequence"
            self.word = source.choice(node, where, SEQUENCES) or self.word
        elif node is not None:
            self.numbers = _numbers(parts, node)
        self.wanted = _order(parts, entries, "order")
        self.base = _order(parts, entries, "from")
        place = entries.get("symmetric")
        self.is_symmetric = parts.truth(place, "extrapolate, symmetric")
        if self.numbers and self.wanted is not None:
            message = "extrapolate: the numbers of sequence say the order"
            source.fault(entries["order"], message, "keep one of them")

    def made(self, base: Tableau, tolerance: fmpq | None) -> Tableau:
        """The extrapolated method.

        Raises:
            MethodError: the order of the method is not known, or already high enough.
        """
        is_symmetric = self.is_symmetric
        if is_symmetric is None:
            if base.has_parameters:
                raise MethodError(_FREE, _SAY)
            is_symmetric = bool(symmetry(base, tolerance or ZERO).holds)
        order = self.base
        if order is None:
            order = _found_order(base, tolerance)
        numbers = self.numbers or self._sequence(order, is_symmetric)
        return extrapolated(base, numbers, order, is_symmetric)

    def _sequence(self, order: int, is_symmetric: bool) -> tuple[int, ...]:
        assert self.wanted is not None
        gap = 2 if is_symmetric else 1
        rows = 1 - (order - self.wanted) // gap
        if rows < 2:
            message = f"the method has order {order} already"
            raise MethodError(message, f"extrapolate to {order + gap} or more")
        numbers = sequence(self.word, rows)
        if max(numbers) > MAX_PARTS:
            message = f"{max(numbers)} substeps in one row (limit {MAX_PARTS})"
            raise MethodError(message, "take a lower order, or harmonic")
        return numbers


_FREE = "the order of a method with free parameters is not looked for"
_SAY = "say from: its order, and symmetric: true or false"


def _found_order(base: Tableau, tolerance: fmpq | None) -> int:
    """The order of the method.

    Raises:
        MethodError: it has free parameters, or no order.
    """
    if base.has_parameters:
        raise MethodError(_FREE, _SAY)
    order = order_of(meant(base, tolerance), MAX_ORDER).order
    if order < 1:
        message = "the method has order 0: its error does not go to 0 with h"
        raise MethodError(message, "extrapolate a consistent one")
    return order


def _order(parts: PartReader, entries: Entries, key: str) -> int | None:
    if key not in entries:
        return None
    where = f"extrapolate, {key}"
    return parts.source.whole(entries[key], where, 1, MAX_ORDER)


def _numbers(parts: PartReader, node: Node) -> tuple[int, ...]:
    """Numbers of substeps, all different."""
    source = parts.source
    items = source.items(node, "extrapolate, sequence")
    numbers: list[int] = []
    for item in items[:_MOST_ROWS]:
        where = "extrapolate, sequence"
        number = source.whole(item, where, 1, MAX_PARTS)
        if number in numbers:
            message = f"{where}: {number} stands there twice"
            source.fault(item, message, "take different numbers")
        elif number is not None:
            numbers.append(number)
    if len(items) > _MOST_ROWS:
        message = f"{len(items)} rows (limit {_MOST_ROWS})"
        source.fault(node, message, "take fewer numbers")
    elif len(items) < 2:
        message = "extrapolate, sequence: two numbers are needed"
        source.fault(node, message, "write for instance [1, 2]")
    return tuple(numbers)


def schema() -> Schema:
    """A method, and how far."""
    order = {"type": "integer", "minimum": 1, "maximum": MAX_ORDER}
    number = {"type": "integer", "minimum": 1, "maximum": MAX_PARTS}
    numbers = {
        "type": "array",
        "items": number,
        "minItems": 2,
        "maxItems": _MOST_ROWS,
        "uniqueItems": True,
    }
    sequences = {"anyOf": [{"enum": list(SEQUENCES)}, numbers]}
    return {
        **closed(
            {
                "of": METHOD,
                "order": order,
                "sequence": sequences,
                "from": order,
                "symmetric": {"type": "boolean"},
            },
            "of",
        ),
        "description": "Several numbers of substeps, combined to a higher order.",
    }
