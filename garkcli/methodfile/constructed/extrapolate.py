"""``extrapolate``: a method with several numbers of substeps, combined to a higher order."""

from __future__ import annotations

from collections.abc import Callable

from flint import fmpq

from garkcli.constructions.composition import extrapolated
from garkcli.errors import MethodError
from garkcli.exact.field import ZERO
from garkcli.families.extrapolated import SEQUENCES, sequence
from garkcli.frozen import Frozen
from garkcli.grammar import keys as g
from garkcli.grammar.nodes import Node, SequenceNode
from garkcli.methodfile.constructed.parts import METHOD, PartReader
from garkcli.methodfile.description import ConstructionText, PartText
from garkcli.methodfile.values import Values as Numbers
from garkcli.order.deciding import order_of
from garkcli.order.meant import meant
from garkcli.properties.symmetry import symmetry
from garkcli.tableau.tableau import Tableau

_FORM = "write for instance {of: {family: gauss, stages: 1}, order: 6}"
_HOW_FAR, _GIVE_ORDER = (
    "neither order nor sequence is given",
    "give order: 6, or sequence: [1, 2, 3]",
)
MAX_ORDER = 40
MAX_PARTS = 200
_MOST_ROWS = 20


def _numbers(at: PartReader, node: Node, where: str) -> tuple[int, ...]:
    source = at.source
    items = source.items(node, where)
    numbers: list[int] = []
    for item in items[:_MOST_ROWS]:
        number = source.whole(item, where, 1, MAX_PARTS)
        if number in numbers:
            message = f"{where}: {number} appears twice"
            source.fault(item, message, "take different numbers", code="doubled")
        elif number is not None:
            numbers.append(number)
    if len(items) > _MOST_ROWS:
        message = f"{len(items)} rows (limit {_MOST_ROWS})"
        source.fault(node, message, "take fewer numbers", code="too-many")
    elif len(items) < 2:
        message = f"{where}: two numbers are needed"
        source.fault(node, message, "write for instance [1, 2]", code="wrong-value")
    return tuple(numbers)


_NUMBERS = g.ValueKind(
    lambda: {
        "type": "array",
        "items": g.count(1, MAX_PARTS).schema(),
        "minItems": 2,
        "maxItems": _MOST_ROWS,
        "uniqueItems": True,
    },
    _numbers,
)
_KEYS = g.mapping(
    g.Key("of: explicit-euler", METHOD, "The method that is extrapolated.", is_needed=True),
    g.Key(
        "order: 6",
        g.count(1, MAX_ORDER),
        "The order of the result; not beside a sequence of numbers, which says it already.",
    ),
    g.Key(
        "sequence: [1, 2, 4]",
        g.either(g.word(lambda: SEQUENCES), at_list=_NUMBERS),
        "The numbers of substeps: a sequence by its name, or the numbers themselves.",
        "harmonic",
    ),
    g.Key(
        "from: 4",
        g.count(1, MAX_ORDER),
        "The order of the method; it is found where it is left out and no parameter is free.",
    ),
    g.Key(
        "symmetric: true",
        g.FLAG,
        "Whether the method is its own adjoint, so that only even powers of h have to cancel; it "
        "is found where it is left out and no parameter is free.",
    ),
    form=_FORM,
    rules=[
        g.Ways("", ("order", "sequence"), _HOW_FAR, _GIVE_ORDER, is_one=False),
        g.KeyRelation(
            "sequence",
            "the numbers of sequence determine the order",
            "keep one of them",
            bars=("order",),
            code="given-twice",
            values=g.KeyValues({"type": "array"}, lambda node: isinstance(node, SequenceNode)),
        ),
        g.KeyRelation(
            "sequence",
            _HOW_FAR,
            _GIVE_ORDER,
            needs=("order",),
            code="missing-key",
            values=g.KeyValues(
                {"not": {"type": "array"}}, lambda node: not isinstance(node, SequenceNode)
            ),
        ),
    ],
)


def _read(at: PartReader, entries: g.ReadMapping, _: str) -> ConstructionText:
    plan = _Plan(
        entries.get("sequence", "harmonic"),
        entries.get("order", 0),
        entries.get("from"),
        entries.get("symmetric"),
        at.rounding(at.tolerance),
    )

    def made(tableau_of: Callable[[PartText], Tableau], numbers: Numbers) -> Tableau:
        return plan.made(tableau_of(entries["of"]), numbers)

    return at.made(entries.node, made)


class _Plan(Frozen):
    """``wanted`` is 0 for a sequence of numbers; ``base`` order and symmetry may be open."""

    sequence: str | tuple[int, ...]
    wanted: int
    base: int | None
    is_symmetric: bool | None
    tolerance: fmpq | None

    def made(self, base: Tableau, numbers: Numbers) -> Tableau:
        """Raises MethodError if the order of the method is unknown, or high enough already."""
        order, is_symmetric = self.base, self.is_symmetric
        if base.has_parameters and (order is None or is_symmetric is None):
            message = "the order of a method with free parameters is not determined"
            raise MethodError(
                message,
                "give from: its order, and symmetric: true or false",
                code="free-parameters",
            )
        if is_symmetric is None:
            is_symmetric = numbers.once(
                ("symmetric", id(self)), lambda: bool(symmetry(base, self.tolerance or ZERO).holds)
            )
        if order is None:
            order = numbers.once(
                ("order", id(self)), lambda: order_of(meant(base, self.tolerance), MAX_ORDER).order
            )
        if order < 1:
            message = "the method has order 0: its error does not go to 0 with h"
            raise MethodError(message, "extrapolate a consistent one", code="not-consistent")
        sequence_of_steps = self.sequence
        if isinstance(sequence_of_steps, str):
            sequence_of_steps = self._by_name(sequence_of_steps, order, is_symmetric)
        return extrapolated(base, sequence_of_steps, order, is_symmetric)

    def _by_name(self, name: str, order: int, is_symmetric: bool) -> tuple[int, ...]:
        gap = 2 if is_symmetric else 1
        rows = 1 - (order - self.wanted) // gap
        if rows < 2:
            message = f"the method has order {order} already"
            raise MethodError(
                message, f"extrapolate to {order + gap} or more", code="cannot-construct"
            )
        numbers = sequence(name, rows)
        if max(numbers) > MAX_PARTS:
            message = f"{max(numbers)} substeps in one row (limit {MAX_PARTS})"
            raise MethodError(message, "take a lower order, or harmonic", code="too-many")
        return numbers


KIND = _KEYS.then(_read)
