"""Coefficients in files, and ``parameters``: with values, values from outside, or free."""

from __future__ import annotations

from typing import Any

from garkcli.errors import did_you_mean
from garkcli.exact.expression import FUNCTIONS
from garkcli.exact.nodes import Name
from garkcli.exact.rewriting import Expanded, roots_in
from garkcli.grammar import nodes as yaml_nodes
from garkcli.grammar.keys import Key, ReadMapping, Schema, ValueKind, defined, mapping
from garkcli.methodfile.numbers import NOTHING, UNKNOWN, Between, Free, Numbers

NUMBER = defined("number", lambda at, node, where: at.numbers.entry(node, where))
ROW = defined("row", lambda at, node, where: at.numbers.row(node, where))
"""A single value is a row of one."""
MATRIX = defined("matrix", lambda at, node, where: at.numbers.matrix(node, where))
"""Rows may still differ in length."""
SIGNS = r"^[-+*/^(),.\sA-Za-z0-9_]+$"
_NUMBER: Schema = {
    "description": "A coefficient: a number, or text such as 1/2 - sqrt(3)/6,"
    " read exactly as written.",
    "type": ["number", "string"],
    "pattern": SIGNS,
}
_ENTRY: Schema = {
    "anyOf": [_NUMBER, {"const": UNKNOWN, "description": "Unknown: gark design finds values."}]
}
DEFINITIONS: Schema = {
    "number": _NUMBER,
    "row": {"anyOf": [{"type": "array", "items": _ENTRY, "minItems": 1}, _ENTRY]},
    "matrix": {
        "description": "Row by row; the rows of a triangle may end at the diagonal or before it.",
        "type": "array",
        "items": {"anyOf": [{"$ref": "#/definitions/row"}, {"type": "array", "maxItems": 0}]},
        "minItems": 1,
    },
}


def _range(at: Any, node: yaml_nodes.Node, where: str) -> Between:
    numbers: Numbers = at.numbers
    ends = numbers.source.items(node, where)
    if len(ends) != 2:
        message = f"{where}: a range has two ends"
        numbers.source.fault(node, message, "write [1/4, 1]", code="list-expected")
        return Between()
    smallest, largest = (numbers.entry(end, where) for end in ends)
    del numbers.entries[-2:]  # they are no coefficients
    if any(any(roots_in(x.expression)) for x in (smallest, largest)):
        from garkcli.methodfile.ranges import between_roots  # few files have such ends

        return between_roots(numbers.source, (smallest, largest), node, where)
    return Between(((smallest, largest),))


RANGE = ValueKind(
    lambda: {"type": "array", "items": NUMBER.schema(), "minItems": 2, "maxItems": 2}, _range
)


_FREE_FORM = "write {free: true, range: [1/4, 1]}, or give it a value"


def _true(at: Any, node: yaml_nodes.Node, where: str) -> bool | None:
    return True if at.source.scalar(node, where) == "true" else None


_FREE = mapping(
    Key(
        "free: true",
        ValueKind(lambda: {"const": True}, _true),
        "States that the parameter has no value.",
        is_needed=True,
    ),
    Key("range: [1/4, 1]", RANGE, "The range of a free parameter, such as from 0 to sqrt(2)/2."),
    form=_FREE_FORM,
)


def _read(at: Any, node: yaml_nodes.Node, _: str) -> None:
    """Reads parameters; each may use those before it, and unused ones do not enlarge the domain."""
    numbers: Numbers = at.numbers
    source = numbers.source
    keys = yaml_nodes.key_nodes(node)
    names = _names_alone(node)
    shown = [x for x in names if len(x) < 20][:5] or ["tau"]
    form = f"write parameters: {{{', '.join(f'{x}: free' for x in shown)}}}"
    for name in names:  # so that no coefficient with such a name is a second fault
        numbers.define(name, NOTHING)
    for name, value_node in source.mapping(node, "parameters", (), form=form).items():
        key = keys[name]
        where = f"parameters: {yaml_nodes.unquoted(name)}"
        if name in FUNCTIONS:
            message = f"{where} is a function already"
            source.fault(key, message, "choose another name", code="name-taken")
        elif not name.isidentifier() or not name.isascii():
            message = f"{where} cannot be the name of a parameter"
            source.fault(key, message, "use letters, digits and _", code="name-taken")
        else:
            numbers.places[name] = value_node
            _define(at, name, value_node, where)
            continue
        numbers.define(name, NOTHING)


def _names_alone(node: yaml_nodes.Node) -> list[str]:
    nodes = node.value if isinstance(node, yaml_nodes.SequenceNode) else [node]
    words = [x.value for x in nodes if isinstance(x, yaml_nodes.ScalarNode)]
    return [x for x in words if x.isidentifier() and x.isascii() and x not in FUNCTIONS]


def _define(at: Any, name: str, node: yaml_nodes.Node, where: str) -> None:
    numbers: Numbers = at.numbers
    if name in numbers.settings:
        numbers.given(name, node, where)
    elif isinstance(node, yaml_nodes.MappingNode) or node.value == "free":
        numbers.free[name] = _free(at, node, where)
        numbers.define(name, Expanded(Name(name)))
    else:
        numbers.parameter(name, node, where)


def _free(at: Any, node: yaml_nodes.Node, where: str) -> Free:
    """Reads a free parameter: ``free``, or ``{free: true, range: [1/4, 1]}``."""
    if isinstance(node, yaml_nodes.ScalarNode):
        return Free(node=node)
    entries: ReadMapping = _FREE.read(at, node, where)
    if "free" in entries.nodes and "free" not in entries:
        message = f"{where} is a mapping without free: true"
        at.source.fault(node, message, _FREE_FORM, code="mapping-expected")
    return Free(node=node).within(entries.get("range", Between()))


PARAMETERS = ValueKind(
    lambda: {
        "type": "object",
        "additionalProperties": {"anyOf": [NUMBER.schema(), _FREE.schema()]},
    },
    _read,
    _FREE.inside,
)


def refuse_free(numbers: Numbers) -> None:
    """A method needs values for all unknowns."""
    family = "the file describes a family of methods"
    of_entries: list[str] = []
    for name, free in numbers.free.items():
        if free.where:
            of_entries.append(name)
            continue
        message = f"parameters: {name} is free: {family}"
        numbers.source.fault(free.node, message, _value_for(name), code="free-parameters")
    if not of_entries:
        return
    first, *others = of_entries
    free = numbers.free[first]
    more = f", and {len(others)} more" if others else ""
    message = f"{free.where} is unknown{more}: {family}"
    numbers.source.fault(free.node, message, _value_for(first), code="free-parameters")


def _value_for(name: str) -> str:
    return f"gark design finds values; --set {name}=1/2 chooses one"


def refuse_unknown_settings(numbers: Numbers) -> None:
    known = list(numbers.parameters)
    for name in (x for x in numbers.settings if x not in known):
        cure = did_you_mean(name, known) or "the file has none: leave out --set"
        message = f"no parameter {yaml_nodes.shortened(name)} to be set"
        numbers.source.fault(None, message, cure, code="unknown-word")
