"""``splitting``: the parts of a problem flow in turn."""

from __future__ import annotations

from collections.abc import Sequence

from flint import fmpq
from yaml.nodes import MappingNode, Node, SequenceNode

from garkcli.constructions.schemes.flows import SPLITTINGS, FlowText
from garkcli.constructions.splitting import drift_and_kick, split
from garkcli.errors import MethodError
from garkcli.exact.expression import read_decimal
from garkcli.exact.matrix import Vector
from garkcli.methodfile.coefficient_schema import Schema, closed
from garkcli.methodfile.constructed.parts import METHOD, PartReader, tolerance_of
from garkcli.methodfile.description import ConstructionText, PartText, Structure
from garkcli.methodfile.numbers import Entry
from garkcli.methodfile.source import Entries
from garkcli.tableau.method import Method
from garkcli.tableau.tableau import Tableau

_KEYS = ("of", "a", "b", "flows", "scheme", "terms")
_FORM = "write for instance {a: [1/2, 1/2], b: [1]} or {scheme: strang}"
_FORM_OF_FLOWS = "write for instance [{1: 1/2}, {2: 1}, {1: 1/2}]"
MAX_TERMS = 20
"""Most parts of a problem that is split."""
MAX_FLOWS = 400
"""Most flows of a splitting."""


class _Splitting:
    """One splitting as it is read."""

    def __init__(self, reader: PartReader, node: Node, structure: Structure) -> None:
        self.reader = reader
        self.source = reader.source
        self.node = node
        self.structure = structure
        self.parts: list[PartText] = []
        self.terms = 2
        self.numbers: list[Entry] = []
        self.fields: list[int] = []
        self.tolerance: fmpq | None = None

    def flow(self, l: int, entry: Entry) -> None:
        """One flow more, of part ``l``, counted from 0."""
        self.fields.append(l)
        self.numbers.append(entry)

    def methods(self, entries: Entries) -> None:
        """What takes the steps of the parts, and how many parts there are."""
        terms = None
        if "terms" in entries:
            where = "splitting, terms"
            terms = self.source.whole(entries["terms"], where, 2, MAX_TERMS)
        node = entries.get("of")
        items: list[Node] = [] if node is None else [node]
        if isinstance(node, SequenceNode):
            items = list(node.value)
        if isinstance(node, SequenceNode):
            terms = terms or len(items)
            if not 2 <= len(items) <= MAX_TERMS or len(items) != terms:
                message = f"splitting, of: {len(items)} methods for {terms} parts"
                self.source.fault(node, message, "give one for each part")
        for item in items:
            part = self.reader.method(item, "splitting, of")
            if part is not None:
                self.parts.append(part)
        self.terms = terms or self._largest(entries) or 2
        if node is None and self.terms > 2:
            message = f"splitting: exact flows of {self.terms} parts are no"
            message += " Runge-Kutta method"
            cure = "give of: METHOD, which takes the steps of the parts"
            self.source.fault(self.node, message, cure)

    def _largest(self, entries: Entries) -> int | None:
        """The largest number of a part among the flows."""
        node = entries.get("flows")
        numbers = []
        for item in node.value if isinstance(node, SequenceNode) else ():
            for key, _ in item.value if isinstance(item, MappingNode) else ():
                text = str(key.value)
                if text.isdigit() and len(text) < 3:
                    numbers.append(int(text))
        return min(max(numbers), MAX_TERMS) if max(numbers, default=0) > 1 else None

    def alternating(self, entries: Entries) -> None:
        """Part 1 for a_1, part 2 for b_1, and so on."""
        numbers = self.reader.numbers
        rows = []
        for key in ("a", "b"):
            if key not in entries:
                other = "b" if key == "a" else "a"
                message = f"splitting: {key} missing beside {other}"
                self.source.fault(self.node, message, _FORM)
                return
            rows.append(numbers.row(entries[key], f"splitting, {key}"))
        a, b = rows
        if len(a) - len(b) not in {0, 1}:
            message = f"splitting: a has {len(a)} numbers and b has {len(b)}"
            cure = "give as many, or one more to a: part 1 flows first"
            self.source.fault(entries["b"], message, cure)
            return
        for i, entry in enumerate(a):
            self.flow(0, entry)
            if i < len(b):
                self.flow(1, b[i])

    def one_by_one(self, node: Node) -> None:
        """A list of flows, each the part and its fraction."""
        items = self.source.items(node, "splitting, flows", _FORM_OF_FLOWS)
        if len(items) > MAX_FLOWS:
            message = f"{len(items)} flows (limit {MAX_FLOWS})"
            self.source.fault(node, message)
            return
        names = [str(l) for l in range(1, self.terms + 1)]
        for number, item in enumerate(items, start=1):
            where = f"splitting, flow {number}"
            found = self.source.mapping(item, where, names, form=_FORM_OF_FLOWS)
            for name, value in found.items():
                entry = self.reader.number(value, where)
                self.flow(int(name) - 1, entry)

    def named(self, node: Node) -> None:
        """The flows of a splitting by name."""
        where = "splitting, scheme"
        name = self.source.choice(node, where, SPLITTINGS)
        found = SPLITTINGS.get(name or "")
        if found is None:
            return
        if found.terms and found.terms != self.terms:
            message = f"{where}: {name} is for {found.terms} parts"
            self.source.fault(node, message, "strang is for any number")
            return
        if found.tolerance:
            self.tolerance = read_decimal(found.tolerance)
        flows: tuple[FlowText, ...] = found.flows(self.terms)
        for l, text in flows:
            self.flow(l, self.reader.numbers.written(text, node, found.name))

    def text(self) -> ConstructionText:
        """The whole."""
        fields, terms = tuple(self.fields), self.terms
        structure = self.structure

        def make(tableaus: Sequence[Tableau], values: Vector) -> Tableau:
            flows = tuple(zip(fields, values, strict=True))
            if not tableaus:
                return drift_and_kick(flows, structure == "nystrom")
            methods = [_diagonal(x) for x in tableaus]
            if len(methods) == 1:
                methods *= terms
            return split(methods, flows)

        tolerance = tolerance_of(self.parts, self.tolerance)
        parts, numbers = tuple(self.parts), tuple(self.numbers)
        return ConstructionText(self.node, parts, numbers, make, tolerance)


def _diagonal(tableau: Tableau) -> Method:
    """The one colour of a method.

    Raises:
        MethodError: it has several.
    """
    block = tableau.block(0, 0)
    if tableau.size != 1 or block is None:
        message = "a part of a splitting is one vector field, and the method has several"
        raise MethodError(message, "give methods of one colour")
    return Method("", tableau.space(0), block, tableau.colours[0].b)


def read(parts: PartReader, node: Node, structure: Structure) -> ConstructionText | None:
    """The parts and their flows."""
    source = parts.source
    before = len(source.faults)
    entries = source.mapping(node, "splitting", _KEYS, form=_FORM)
    if not isinstance(node, MappingNode):
        return None
    made = _Splitting(parts, node, structure)
    made.methods(entries)
    ways: list[str] = [key for key in ("a", "flows", "scheme") if key in entries]
    if "b" in entries and "a" not in entries:
        ways.append("b")
    if len(ways) != 1:
        if ways:
            message = f"splitting: the flows are given by {ways[0]} already"
            cure = f"keep one of {', '.join(ways)}"
            source.fault(entries[ways[1]], message, cure)
        else:
            source.fault(node, "splitting: no flows", _FORM)
    elif ways[0] in {"a", "b"}:
        made.alternating(entries)
    elif ways[0] == "flows":
        made.one_by_one(entries["flows"])
    else:
        made.named(entries["scheme"])
    if len(source.faults) > before:
        return None
    idle = set(range(made.terms)) - set(made.fields)
    if idle:
        message = f"splitting: part {min(idle) + 1} never flows"
        source.fault(node, message, "give every part a flow")
        return None
    return made.text()


def schema() -> Schema:
    """Flows, and what takes them."""
    number: Schema = {"$ref": "#/definitions/number"}
    row: Schema = {"$ref": "#/definitions/row"}
    flow = {
        "type": "object",
        "propertyNames": {"pattern": "^[1-9][0-9]?$"},
        "additionalProperties": number,
        "minProperties": 1,
    }
    methods = {"type": "array", "items": METHOD, "minItems": 2}
    return {
        **closed(
            {
                "of": {"anyOf": [METHOD, methods]},
                "a": row,
                "b": row,
                "flows": {"type": "array", "items": flow, "minItems": 1},
                "scheme": {"enum": list(SPLITTINGS)},
                "terms": {"type": "integer", "minimum": 2, "maximum": MAX_TERMS},
            }
        ),
        "description": "The parts of a problem flow in turn.",
    }
