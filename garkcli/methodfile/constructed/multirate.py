"""``multirate``: small steps of a fast method within one step of a slow one."""

from __future__ import annotations

from collections.abc import Sequence

from flint import fmpq
from yaml.nodes import MappingNode, Node, ScalarNode, SequenceNode

from garkcli.errors import counted
from garkcli.exact.nodes import Expression, Literal
from garkcli.methodfile.coefficient_schema import Schema, closed
from garkcli.methodfile.constructed.multirate_makers import (
    COUPLINGS,
    SLOWEST_FIRST,
    Make,
    given,
    named,
    of_mis,
    of_mri,
)
from garkcli.methodfile.constructed.parts import METHOD, PartReader, tolerance_of
from garkcli.methodfile.description import ConstructionText, PartText, Structure
from garkcli.methodfile.numbers import Entry, Numbers, Row, Rows
from garkcli.methodfile.source import Entries

_KEYS = ("fast", "steps", "slow", "coupling", "mis", "mri")
_FORM = "write for instance {mis: kutta, fast: rk4, steps: 4}"
_FORM_OF_MRI = "write {c: [0, 1/2, 1], gamma: [[[1/2, 0], [0, 1/2]]]}"
_FORM_OF_COUPLING = "write slowest-first, collocation, or "
_FORM_OF_COUPLING += "{fast-slow: [[…]], slow-fast: [[…]]}"
MAX_STEPS = 400
"""Most small steps."""
MAX_POWERS = 12
"""Most matrices of one slow part, one for each power of τ."""
_BLOCKS = ("fast-slow", "slow-fast")
_NAMES = ("lambda", "M")
"""Which small step it is, from 1, and how many there are, in coupling matrices."""


def read(parts: PartReader, node: Node, _: Structure) -> ConstructionText | None:
    """The methods, and how they are coupled."""
    before = len(parts.source.faults)
    entries = parts.source.mapping(node, "multirate", _KEYS, form=_FORM)
    if not isinstance(node, MappingNode):
        return None
    made = _Multirate(parts, node).read(entries)
    return None if len(parts.source.faults) > before else made


class _Multirate:
    """One multirate method as it is read."""

    def __init__(self, reader: PartReader, node: Node) -> None:
        self.reader = reader
        self.source = reader.source
        self.numbers = reader.numbers
        self.node = node

    def read(self, entries: Entries) -> ConstructionText | None:
        """The whole; None where something is missing or faulty."""
        fast = self._part(entries, "fast")
        steps = self._steps(entries)
        ways = [key for key in ("slow", "mis", "mri") if key in entries]
        if len(ways) != 1:
            message = "multirate: the slow method is missing"
            if ways:
                message = f"multirate: the slow part is given by {ways[0]} already"
            self.source.fault(entries[ways[1]] if ways else self.node, message, _FORM)
            return None
        if "coupling" in entries and ways[0] != "slow":
            message = f"multirate: coupling does not go with {ways[0]}"
            self.source.fault(entries["coupling"], message, "leave it out")
        if ways[0] == "mri":
            return self._mri(entries["mri"], fast, steps)
        slow = self._part(entries, ways[0])
        if fast is None or slow is None or steps is None:
            return None
        if ways[0] == "mis":
            return self._text([fast, slow], (), of_mis(steps))
        return self._coupled(entries, fast, slow, steps)

    def _part(self, entries: Entries, key: str) -> PartText | None:
        if key in entries:
            return self.reader.method(entries[key], f"multirate, {key}")
        self.source.fault(self.node, f"multirate: {key} missing", _FORM)
        return None

    def _steps(self, entries: Entries) -> int | None:
        if "steps" in entries:
            where = "multirate, steps"
            return self.source.whole(entries["steps"], where, 1, MAX_STEPS)
        self.source.fault(self.node, "multirate: steps missing", _FORM)
        return None

    def _text(self, parts: Sequence[PartText], numbers: Row, make: Make) -> ConstructionText:
        tolerance = tolerance_of(parts)
        return ConstructionText(self.node, tuple(parts), numbers, make, tolerance)

    def _coupled(
        self, entries: Entries, fast: PartText, slow: PartText, steps: int
    ) -> ConstructionText | None:
        """Two methods with a coupling by name, or by matrices."""
        parts = [fast, slow]
        node = entries.get("coupling")
        if node is None:
            return self._text(parts, (), named(SLOWEST_FIRST, steps))
        if isinstance(node, ScalarNode):
            where = "multirate, coupling"
            word = self.source.choice(node, where, COUPLINGS)
            if word is None:
                return None
            return self._text(parts, (), named(word, steps))
        where = "multirate, coupling"
        found = self.source.mapping(node, where, _BLOCKS, form=_FORM_OF_COUPLING)
        for key in _BLOCKS:
            if key not in found and isinstance(node, MappingNode):
                self.source.fault(node, f"{where}: {key} missing", _FORM_OF_COUPLING)
                return None
        if not found:
            return None
        blocks = [self._small_steps(found[key], key, steps) for key in _BLOCKS]
        if not all(blocks):
            return None
        every = [x for block in blocks for rows in block for row in rows for x in row]
        return self._text(parts, tuple(every), given(blocks))

    def _small_steps(self, node: Node, key: str, steps: int) -> list[Rows]:
        """A coupling matrix for each small step; its entries may use their number."""
        before = len(self.source.faults)
        found: list[Rows] = []
        for step in range(1, steps + 1):
            with _Defined(self.numbers, (step, steps)):
                rows = self.numbers.matrix(node, key)
            if len(self.source.faults) > before or not rows:
                return []
            self.numbers.rectangular(rows, node, key)
            found.append(rows)
        return found

    def _mri(self, node: Node, fast: PartText | None, steps: int | None) -> ConstructionText | None:
        """Nodes, and matrices for the powers of τ."""
        where = "multirate, mri"
        keys = ("c", "gamma", "omega")
        entries = self.source.mapping(node, where, keys, form=_FORM_OF_MRI)
        has_matrices = entries.keys() & {"gamma", "omega"}
        if "c" not in entries or not has_matrices:
            if isinstance(node, MappingNode):
                message = f"{where}: c and gamma are needed"
                self.source.fault(node, message, _FORM_OF_MRI)
            return None
        c = self.numbers.row(entries["c"], "c")
        given_powers = [key for key in ("omega", "gamma") if key in entries]
        count = len(c)
        every = [self._powers(entries[x], x, count) for x in given_powers]
        if fast is None or steps is None or not c or not all(every):
            return None
        numbers = list(c)
        for matrices in every:
            for rows in matrices:
                numbers += [x for row in rows for x in row]
        shapes = [len(matrices) for matrices in every]
        return self._text([fast], tuple(numbers), of_mri(len(c), shapes, steps))

    def _powers(self, node: Node, key: str, count: int) -> list[Rows]:
        """A matrix for each power of τ, with a row from each node to the next and a column a
        node.
        """
        items = self.source.items(node, key, _FORM_OF_MRI)
        if len(items) > MAX_POWERS:
            message = f"{key}: {len(items)} matrices (limit {MAX_POWERS})"
            self.source.fault(node, message)
            return []
        if not items and isinstance(node, SequenceNode):
            message = f"{key}: no matrices"
            self.source.fault(node, message, _FORM_OF_MRI)
        found: list[Rows] = []
        for k, item in enumerate(items):
            name = f"{key}^{k}"
            rows = self.numbers.matrix(item, name)
            whole = self._whole(rows, item, name, count) if rows else ()
            if not whole:
                return []
            found.append(whole)
        return found

    def _whole(self, rows: Rows, node: Node, name: str, count: int) -> Rows:
        """The matrix with a row less than nodes; what is left out at the right is zero, and a first
        row of zeros, that of the beginning, may stand before the others.
        """
        if len(rows) == count and not any(map(_is_nonzero, rows[0])):
            rows = rows[1:]
        width = max(map(len, rows))
        if len(rows) != count - 1 or width > count:
            found = f"{len(rows)} by {width}"
            message = f"{name} is {found} for {counted(count, 'node')}"
            cure = "give a row from each node to the next, a column a node"
            self.source.fault(node, message, cure)
            return ()
        whole: list[Row] = []
        for i, row in enumerate(rows, start=1):
            missing = count - len(row)
            nothing = Literal(fmpq(0))
            zero = Entry(nothing, node, f"{name}, row {i}")
            self.numbers.entries += [zero] * bool(missing)
            whole.append(row + (zero,) * missing)
        return tuple(whole)


def _is_nonzero(entry: Entry) -> bool:
    expression = entry.expression
    return not (isinstance(expression, Literal) and not expression.value)


class _Defined:
    """While it is open, ``lambda`` and ``M`` are numbers."""

    def __init__(self, numbers: Numbers, values: tuple[int, int]) -> None:
        self.numbers = numbers
        self.values = values
        self.before: dict[str, Expression | None] = {}

    def __enter__(self) -> None:
        for name, value in zip(_NAMES, self.values, strict=True):
            self.before[name] = self.numbers.parameters.get(name)
            self.numbers.define(name, Literal(fmpq(value)))

    def __exit__(self, *_: object) -> None:
        for name, value in self.before.items():
            if value is None:
                self.numbers.forget(name)
            else:
                self.numbers.define(name, value)


def schema() -> Schema:
    """Methods and couplings."""
    row: Schema = {"$ref": "#/definitions/row"}
    matrix: Schema = {"$ref": "#/definitions/matrix"}
    powers = {"type": "array", "items": matrix, "minItems": 1}
    blocks = closed(dict.fromkeys(_BLOCKS, matrix), *_BLOCKS)
    infinitesimal = {
        **closed({"c": row, "gamma": powers, "omega": powers}, "c"),
        "anyOf": [{"required": ["gamma"]}, {"required": ["omega"]}],
    }
    ways = [{"required": [key]} for key in ("slow", "mis", "mri")]
    return {
        **closed(
            {
                "fast": METHOD,
                "steps": {"type": "integer", "minimum": 1, "maximum": MAX_STEPS},
                "slow": METHOD,
                "coupling": {"anyOf": [{"enum": list(COUPLINGS)}, blocks]},
                "mis": METHOD,
                "mri": infinitesimal,
            },
            "fast",
            "steps",
        ),
        "oneOf": ways,
        "description": "Small steps of a fast method within one step of a slow one.",
    }
