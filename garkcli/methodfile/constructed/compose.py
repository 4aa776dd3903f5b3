"""``compose``: substeps of methods, given one by one or by the name of a scheme."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import prod

from flint import fmpq
from yaml.nodes import MappingNode, Node

from garkcli.constructions.adjoint import adjoint
from garkcli.constructions.composition import Substep, composed
from garkcli.constructions.schemes.registry import OTHER_NAMES, SCHEMES
from garkcli.constructions.schemes.scheme import MAX_ORDER, Scheme
from garkcli.exact.domain import MAX_DEGREE
from garkcli.exact.expression import read_decimal
from garkcli.exact.matrix import Vector
from garkcli.exact.nodes import Literal
from garkcli.methodfile.coefficient_schema import Schema, closed
from garkcli.methodfile.constructed.parts import METHOD, PartReader, tolerance_of
from garkcli.methodfile.description import ConstructionText, PartText, Structure
from garkcli.methodfile.numbers import Entry
from garkcli.methodfile.source import Entries
from garkcli.tableau.tableau import Tableau

_KEYS = ("of", "steps", "scheme", "order", "from", "processor")
_FORM = "write for instance {of: {family: heun}, steps: [1/2, 1/2]}"
_FORM_OF_STEP = "write 1/2, or {step: 1/2, adjoint: true}"
_NO_METHOD = "the step of no method"
_NAME_IT = "give of: METHOD, here or for all of them"
MAX_SUBSTEPS = 400
"""Most substeps of a composition."""


@dataclass(frozen=True)
class _Step:
    """A substep: which method takes it, and which number is its fraction."""

    part: int
    number: int
    is_adjoint: bool = False


class _Composition:
    """One composition as it is read."""

    def __init__(self, reader: PartReader) -> None:
        self.reader = reader
        self.source = reader.source
        self.parts: list[PartText] = []
        self.numbers: list[Entry] = []
        self.steps: list[_Step] = []
        self.tolerance: fmpq | None = None

    def part(self, node: Node, where: str) -> int | None:
        """A method as a part, by its number."""
        found = self.reader.method(node, where)
        if found is None:
            return None
        self.parts.append(found)
        return len(self.parts) - 1

    def add(self, part: int, entry: Entry, is_adjoint: bool) -> None:
        """One substep more."""
        self.numbers.append(entry)
        step = _Step(part, len(self.numbers) - 1, is_adjoint)
        self.steps.append(step)

    def step(self, node: Node, where: str, whole: int | None) -> None:
        """One item of ``steps``; ``whole`` is the method of all."""
        if not isinstance(node, MappingNode):
            entry = self.reader.number(node, where)
            if whole is None:
                self.source.fault(node, f"{where}: {_NO_METHOD}", _NAME_IT)
            else:
                self.add(whole, entry, False)
            return
        keys = ("step", "of", "adjoint")
        entries = self.source.mapping(node, where, keys, form=_FORM_OF_STEP)
        part = whole
        if "of" in entries:
            part = self.part(entries["of"], f"{where}, of")
        if "step" not in entries:
            message = f"{where}: step missing"
            self.source.fault(node, message, _FORM_OF_STEP)
            return
        entry = self.reader.number(entries["step"], f"{where}, step")
        truth = self.reader.truth(entries.get("adjoint"), f"{where}, adjoint")
        if part is not None:
            self.add(part, entry, bool(truth))
        elif "of" not in entries:
            self.source.fault(node, f"{where}: {_NO_METHOD}", _NAME_IT)

    def scheme(self, entries: Entries, whole: int) -> None:
        """The substeps of a scheme."""
        node = entries["scheme"]
        name = self.source.scalar(node, "compose, scheme")
        found = SCHEMES.get(name or "")
        if found is None:
            other = OTHER_NAMES.get(name or "")
            if name is not None and other:
                message = f"compose, scheme: {name} is called {other} here"
                self.source.fault(node, message, "write it so")
            else:
                self.source.choice(node, "compose, scheme", SCHEMES)
            return
        before = len(self.source.faults)
        base, wanted = self._orders(entries, found)
        if len(self.source.faults) > before:
            return
        if found.tolerance:
            self.tolerance = read_decimal(found.tolerance)
        for text, is_adjoint in found.parts(base, wanted):
            entry = self.reader.numbers.written(text, node, found.name)
            self.add(whole, entry, is_adjoint)

    def _orders(self, entries: Entries, scheme: Scheme) -> tuple[int, int]:
        """From which order to which a scheme that is repeated goes."""
        if not scheme.has_orders:
            for key in ("order", "from"):
                if key in entries:
                    message = f"{scheme.name} has one order, {scheme.order}"
                    self.source.fault(entries[key], message, "leave it out")
            return 0, 0
        base = self._order(entries, "from", 2, 2)
        wanted = self._order(entries, "order", base + 2, base + 2)
        self._refuse_radicals(entries, scheme, base, wanted)
        return base, wanted

    def _refuse_radicals(self, entries: Entries, scheme: Scheme, base: int, wanted: int) -> None:
        """Note an order for which the roots of all repetitions are too much together.

        The substeps that take a symmetric method of order p further have a root of degree p + 1.
        """
        degree = prod(order + 1 for order in range(base, wanted, 2))
        if degree <= MAX_DEGREE:
            return
        message = f"{scheme.name} from order {base} to {wanted} has radicals of"
        message += f" degree {degree} together (limit {MAX_DEGREE})"
        cure = "take fewer repetitions, or a rounded scheme, such as yoshida-8"
        self.source.fault(entries["order"], message, cure)

    def _order(self, entries: Entries, key: str, default: int, smallest: int) -> int:
        if key not in entries:
            return default
        node, where = entries[key], f"compose, {key}"
        order = self.source.whole(node, where, smallest, MAX_ORDER)
        if order is not None and order % 2:
            message = f"{where}: a symmetric method has an even order"
            self.source.fault(node, message, f"for instance {order + 1}")
        return default if order is None else order

    def processor(self, node: Node, place: Node) -> None:
        """π after, and its inverse before: the adjoint with the step −1."""
        part = self.part(node, "compose, processor")
        if part is None:
            return
        numbers = self.reader.numbers
        there = Entry(Literal(fmpq(1)), place, "compose, processor")
        back = Entry(Literal(fmpq(-1)), place, "compose, processor")
        numbers.entries += [there, back]
        self.add(part, there, False)
        self.add(part, back, True)
        self.steps = [self.steps[-1], *self.steps[:-1]]

    def text(self, node: Node) -> ConstructionText:
        """The whole."""
        steps = tuple(self.steps)

        def make(tableaus: Sequence[Tableau], values: Vector) -> Tableau:
            return _made(steps, tableaus, values)

        tolerance = tolerance_of(self.parts, self.tolerance)
        parts, numbers = tuple(self.parts), tuple(self.numbers)
        return ConstructionText(node, parts, numbers, make, tolerance)


def read(parts: PartReader, node: Node, _: Structure) -> ConstructionText | None:
    """The methods and their substeps."""
    source = parts.source
    before = len(source.faults)
    entries = source.mapping(node, "compose", _KEYS, form=_FORM)
    if not isinstance(node, MappingNode):
        return None
    made = _Composition(parts)
    whole = None
    if "of" in entries:
        whole = made.part(entries["of"], "compose, of")
    _refuse_unclear(parts, node, entries)
    if len(source.faults) > before:
        return None
    if "scheme" in entries and whole is not None:
        made.scheme(entries, whole)
    if "steps" in entries:
        items = source.items(entries["steps"], "compose, steps", _FORM)
        if len(items) > MAX_SUBSTEPS:
            message = f"{len(items)} substeps (limit {MAX_SUBSTEPS})"
            source.fault(entries["steps"], message)
            return None
        for number, item in enumerate(items, start=1):
            made.step(item, f"compose, step {number}", whole)
    if "steps" not in entries and "scheme" not in entries and whole is not None:
        one = Entry(Literal(fmpq(1)), node, "compose")
        parts.numbers.entries.append(one)
        made.add(whole, one, False)
    if "processor" in entries:
        made.processor(entries["processor"], entries["processor"])
    if len(source.faults) > before:
        return None
    if not made.steps:
        source.fault(node, "compose: no substeps", _FORM)
        return None
    return made.text(node)


def _refuse_unclear(parts: PartReader, node: Node, entries: Entries) -> None:
    """Note keys that do not go together."""
    source = parts.source
    if "steps" in entries and "scheme" in entries:
        message = "compose: the substeps are given by scheme already"
        source.fault(entries["steps"], message, "keep one of steps, scheme")
    if "scheme" in entries and "of" not in entries:
        source.fault(node, "compose: of missing beside scheme", _FORM)
    has_substeps = entries.keys() & {"steps", "scheme", "processor"}
    if not has_substeps:
        cure = "give steps: [1/2, 1/2] or scheme: triple-jump"
        source.fault(node, "compose: no substeps", cure)
    for key in ("order", "from"):
        if key in entries and "scheme" not in entries:
            message = f"compose: {key} goes with scheme"
            source.fault(entries[key], message, "leave it out")


def _made(steps: Sequence[_Step], tableaus: Sequence[Tableau], values: Vector) -> Tableau:
    turned: dict[int, Tableau] = {}
    substeps = []
    for step in steps:
        tableau = tableaus[step.part]
        if step.is_adjoint:
            if step.part not in turned:
                turned[step.part] = adjoint(tableau)
            tableau = turned[step.part]
        substeps.append(Substep(tableau, values[step.number]))
    return composed(substeps)


def schema() -> Schema:
    """Methods and substeps."""
    number: Schema = {"$ref": "#/definitions/number"}
    step = {
        "anyOf": [
            number,
            closed({"step": number, "of": METHOD, "adjoint": {"type": "boolean"}}, "step"),
        ]
    }
    order = {"type": "integer", "minimum": 2, "maximum": MAX_ORDER}
    return {
        **closed(
            {
                "of": METHOD,
                "steps": {"type": "array", "items": step, "minItems": 1},
                "scheme": {
                    "enum": list(SCHEMES),
                    "description": "The substeps by name, see gark list.",
                },
                "order": order,
                "from": order,
                "processor": METHOD,
            }
        ),
        "description": "Substeps of methods, one after the other.",
    }
