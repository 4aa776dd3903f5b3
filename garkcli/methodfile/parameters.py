"""``parameters`` of a method file: values, values given from outside, and those that are free."""

from __future__ import annotations

from yaml.nodes import MappingNode, Node, ScalarNode

from garkcli.errors import did_you_mean
from garkcli.exact.expression import FUNCTIONS
from garkcli.exact.field import ZERO
from garkcli.exact.nodes import Expression, Literal, Name
from garkcli.methodfile.nodes import key_nodes
from garkcli.methodfile.numbers import Entry, Free, Numbers
from garkcli.methodfile.words import shortened, unquoted


def read_parameters(numbers: Numbers, node: Node | None) -> None:
    """Read ``parameters`` into ``numbers``; each may use those before it.

    The values are kept apart from the coefficients: one that no coefficient uses has no part in
    their domain, but a faulty one is reported where it stands.
    """
    if node is None:
        return
    source = numbers.source
    keys = key_nodes(node)
    for name, value_node in source.mapping(node, "parameters", ()).items():
        key = keys[name]
        where = f"parameters: {unquoted(name)}"
        value: Expression = Literal(ZERO)
        if name in FUNCTIONS:
            message = f"{where} is a function already"
            source.fault(key, message, "choose another name")
        elif not name.isidentifier() or not name.isascii():
            message = f"{where} cannot be the name of a parameter"
            source.fault(key, message, "use letters, digits and _")
        elif name in numbers.settings:
            value = numbers.given(name, value_node, where)
        elif _is_free(value_node):
            value = Name(name)
            numbers.free[name] = _free(numbers, value_node, where)
        else:
            value = numbers.entry(value_node, where).expression
            numbers.of_parameters.append(numbers.entries.pop())
        numbers.define(name, value)
        numbers.places[name] = value_node


def _is_free(node: Node) -> bool:
    """Whether a parameter has no value: ``free``, or a mapping that says so."""
    if isinstance(node, ScalarNode):
        return bool(node.value == "free")
    return isinstance(node, MappingNode)


def _free(numbers: Numbers, node: Node, where: str) -> Free:
    """A free parameter: ``free``, or ``{free: true, range: [1/4, 1]}``."""
    if isinstance(node, ScalarNode):
        return Free(node)
    source = numbers.source
    entries = source.mapping(node, where, ("free", "range"))
    word = None
    if "free" in entries:
        word = source.scalar(entries["free"], where)
    if word != "true":
        message = f"{where} is a mapping that does not say free: true"
        cure = "write {free: true, range: [1/4, 1]}, or give it a value"
        source.fault(node, message, cure)
    if "range" not in entries:
        return Free(node)
    return Free(node, read_range(numbers, entries["range"], f"{where}, range"))


def read_range(numbers: Numbers, node: Node, where: str) -> tuple[tuple[Entry, Entry], ...]:
    """The two ends of a range, as the only one; none where it is faulty."""
    ends = numbers.source.items(node, where)
    if len(ends) != 2:
        message = f"{where}: a range has two ends"
        numbers.source.fault(node, message, "write [1/4, 1]")
        return ()
    smallest, largest = (numbers.entry(end, where) for end in ends)
    del numbers.entries[-2:]  # they are no coefficients
    return ((smallest, largest),)


def refuse_free(numbers: Numbers) -> None:
    """Note the unknowns without a value, those of entries as one: a method has a value for each."""
    family = "the file describes a family of methods"
    of_entries: list[str] = []
    for name, free in numbers.free.items():
        if free.where:
            of_entries.append(name)
            continue
        message = f"parameters: {name} is free: {family}"
        numbers.source.fault(free.node, message, _value_for(name))
    if not of_entries:
        return
    first, *others = of_entries
    free = numbers.free[first]
    more = f", and {len(others)} more" if others else ""
    message = f"{free.where} is unknown{more}: {family}"
    numbers.source.fault(free.node, message, _value_for(first))


def _value_for(name: str) -> str:
    """What to do about an unknown where a method is needed."""
    return f"gark design finds values; --set {name}=1/2 chooses one"


def refuse_unknown_settings(numbers: Numbers) -> None:
    """Note values that are given for parameters that the file does not have."""
    known = list(numbers.parameters)
    for name in numbers.settings:
        if name not in known:
            cure = "it has no parameters"
            if known:
                cure = did_you_mean(name, known)
            message = f"no parameter {shortened(name)} to be set"
            numbers.source.fault(None, message, cure)
