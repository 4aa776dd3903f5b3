"""The forms ``shu-osher`` and ``low-storage``: methods as in codes with few registers."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from flint import fmpq

from garkcli.constructions.registers import as_butcher
from garkcli.errors import counted
from garkcli.grammar import keys as g
from garkcli.grammar.nodes import Node, ScalarNode, SequenceNode
from garkcli.methodfile import spelled_out
from garkcli.methodfile.description import NOTHING_FURTHER, FurtherText, Made, OwnContent
from garkcli.methodfile.numbers import NumbersReader, Row, Rows
from garkcli.methodfile.parameters import MATRIX, ROW
from garkcli.methodfile.values import Values
from garkcli.tableau.forms import gark

KEYS_OF_FORMS: Mapping[str, tuple[str, ...]] = {
    "2N": ("A", "B"),
    "2C": ("A", "b"),
    "2R": ("A", "b"),
    "3R": ("A", "b"),
    "4R": ("A", "b"),
    "5R": ("A", "b"),
    "2S": ("gamma1", "gamma2", "delta", "beta"),
    "3S*": ("gamma1", "gamma2", "gamma3", "delta", "beta"),
}
_FORM_OF_SHU_OSHER = (
    "give {alpha: [[1], [3/4, 1/4]], beta: [[1], [0, 1/4]]}: a row for each value but the first"
)
_FORM = "give {form: 2N, A: [0, -5/9, -153/128], B: [1/3, 15/16, 8/15]}"
_DENSE = g.defined("dense")
_FURTHER = (
    g.Key(
        "c: [0, 1]",
        ROW,
        "The nodes, one per stage; the row sums of A where they are left out.",
        also=("nodes",),
    ),
    g.Key(
        "embedded: [1, 0]",
        ROW,
        "Embedded weights, one per stage, as of a Butcher tableau.",
        also=("bhat", "b_hat", "bh"),
    ),
    g.Key(
        "dense: {degree: 1, weights: [[1/2], [1/2]]}",
        _DENSE,
        "Dense output: weights polynomial in θ without constant terms.",
    ),
)
SHU_OSHER = g.mapping(
    g.Key(
        "alpha: [[1], [1/2, 1/2]]",
        MATRIX,
        "How much of each value is in the next ones: a row for each value but the first, the end "
        "of the step last. What is missing from 1 is the value at the beginning.",
        is_needed=True,
    ),
    g.Key(
        "beta: [[1], [0, 1/2]]",
        MATRIX,
        "How much of each slope times h is in them.",
        is_needed=True,
    ),
    *_FURTHER,
    form=_FORM_OF_SHU_OSHER,
)
_A = g.ValueKind(lambda: {"anyOf": [ROW.schema(), MATRIX.schema()]})
LOW_STORAGE = g.mapping(
    g.Key(
        "form: 2N",
        g.word(lambda: tuple(KEYS_OF_FORMS)),
        "The scheme: 2N of Williamson, 2R, 3R, … of van der Houwen, 2C, 2S and 3S* of Ketcheson.",
        is_needed=True,
    ),
    g.Key(
        "A: [0, -5/9, -153/128]",
        _A,
        "Of 2N the factors of the increment; of 2C and 2R the diagonal below the main one; of 3R "
        "and more a row for each diagonal.",
    ),
    g.Key("B: [1/3, 15/16, 8/15]", ROW, "Of 2N how much of the increment is added, per stage."),
    g.Key("b: [1/6, 2/3, 1/6]", ROW, "Of 2C, 2R, 3R, … the weights, one per stage."),
    g.Key("gamma1: [0, 1/2]", ROW, "Of 2S and 3S* the factors of the first register."),
    g.Key("gamma2: [1, 1/2]", ROW, "Of 2S and 3S* those of the second register."),
    g.Key("gamma3: [0, 0]", ROW, "Of 3S* those of the value at the beginning."),
    g.Key("delta: [1, 1]", ROW, "Of 2S and 3S* how much the second register takes of the first."),
    g.Key("beta: [1, 1/2]", ROW, "Of 2S and 3S* the factors of the slopes, one per stage."),
    *_FURTHER,
    form=_FORM,
)


class RegistersText(OwnContent):
    """``scheme`` is ``shu-osher``, or the form of ``low-storage``; ``numbers`` are in its order."""

    scheme: str
    numbers: tuple[Row | Rows, ...]
    c: Row | None = None
    beside: tuple[FurtherText, ...] = (NOTHING_FURTHER,)

    def made(self, values: Values, rounding: fmpq | None) -> Made:
        numbers = [
            values.matrix(x) if isinstance(x[0], tuple) else values.vector(x) for x in self.numbers
        ]
        c = None if self.c is None else values.vector(self.c)
        return Made(gark([as_butcher(self.scheme, numbers, c, rounding or 0)], {}))


def shu_osher(at: NumbersReader, node: Node) -> RegistersText | None:
    entries: g.ReadMapping | None = SHU_OSHER.read(at, node, "shu-osher")
    if entries is None or not entries.is_right:
        return None
    stages = len(entries["alpha"]) - _begins_with_zeros(entries.nodes)
    return _text(at, node, "shu-osher", entries, (entries["alpha"], entries["beta"]), stages)


def _begins_with_zeros(nodes: Mapping[str, Node]) -> bool:
    """Whether there is a first row for the initial value, which is empty or zero."""

    def is_zero(node: Node) -> bool:
        row = node.value[0] if isinstance(node, SequenceNode) and node.value else node
        return isinstance(row, SequenceNode) and all(
            isinstance(x, ScalarNode) and x.value.strip("0") in ("", ".") for x in row.value
        )

    return is_zero(nodes["alpha"]) and is_zero(nodes["beta"])


def low_storage(at: NumbersReader, node: Node) -> RegistersText | None:
    entries: g.ReadMapping | None = LOW_STORAGE.read(at, node, "low-storage")
    if entries is None or not entries.is_right:
        return None
    form = entries["form"]
    wanted = KEYS_OF_FORMS[form]
    known = {key for keys in KEYS_OF_FORMS.values() for key in keys}
    cure = f"{form} has {', '.join(wanted)}"
    for key in entries.nodes:
        if key in known and key not in wanted:
            message = f"low-storage: {form} has no {key}"
            at.source.fault(entries.nodes[key], message, cure, code="not-together")
            return None
    missing = [key for key in wanted if key not in entries.nodes]
    if missing:
        message = f"low-storage: {form} needs {' and '.join(missing)}"
        at.source.fault(node, message, cure, code="missing-key")
        return None
    numbers: list[Any] = [entries[key] for key in wanted]
    if "A" in wanted:
        place = entries.nodes["A"]
        if form in ("3R", "4R", "5R"):
            rows = at.numbers.matrix(place, "A")
            if len(rows) != int(form[0]) - 1:
                message = f"low-storage: A of {form} has {counted(len(rows), 'diagonal')}"
                at.source.fault(place, message, f"give {int(form[0]) - 1}", code="wrong-size")
                return None
            numbers[0] = rows
        else:
            numbers[0] = at.numbers.row(place, "A")
    return _text(at, node, form, entries, tuple(numbers), len(entries[wanted[-1]]))


def _text(
    at: NumbersReader,
    node: Node,
    scheme: str,
    entries: g.ReadMapping,
    numbers: tuple[Any, ...],
    stages: int,
) -> RegistersText | None:
    c = entries.get("c")
    if c is not None and not spelled_out.nodes_fit(at, entries.nodes["c"], "c", c, stages):
        return None
    further = spelled_out.further_of_method(at, entries.nodes, stages)
    return RegistersText(node, scheme, numbers, c, (further,))
