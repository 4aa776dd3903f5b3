"""``splitting``: the parts of a problem flow in turn."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import TypeAlias

from garkcli.constructions.composition import drift_and_kick, split
from garkcli.constructions.schemes import SPLITTINGS
from garkcli.exact.expression import read_decimal
from garkcli.grammar import keys as g
from garkcli.grammar.nodes import MappingNode, Node, SequenceNode
from garkcli.methodfile.constructed.parts import METHOD, PartReader
from garkcli.methodfile.description import ConstructionText, PartText
from garkcli.methodfile.numbers import Coefficient
from garkcli.methodfile.parameters import NUMBER, ROW
from garkcli.methodfile.values import Values
from garkcli.tableau.forms import one_field
from garkcli.tableau.tableau import Tableau

_FORM = "write for instance {a: [1/2, 1/2], b: [1]} or {scheme: strang}"
_FORM_OF_FLOWS = "write for instance [{1: 1/2}, {2: 1}, {1: 1/2}]"
MAX_TERMS = 20
MAX_FLOWS = 400
_Flow: TypeAlias = tuple[int, Coefficient]
"""A part of the problem, from 0, and the fraction of the step for which it flows."""

_WAYS = g.Ways("the flows are", (g.Together(("a", "b")), "flows", "scheme"), "no flows", _FORM)
_FLOW = g.by_name(NUMBER, propertyNames={"pattern": "^[1-9][0-9]?$"}, minProperties=1)
_KEYS = g.mapping(
    g.Key(
        "of: {family: gauss, stages: 1}",
        g.one_or_more(METHOD, "methods", rules={"minItems": 2}),
        "The method that each part flows by, or one for each part; without it flows are exact.",
    ),
    g.Key(
        "a: [1/2, 1/2]",
        ROW,
        "The fractions of the step of the first part, before each of the second and at the end.",
    ),
    g.Key("b: [1]", ROW, "The fractions of the step of the second part."),
    g.Key(
        "flows: [{1: 1/2}, {2: 1}, {1: 1/2}]",
        g.list_of(_FLOW, "flows", MAX_FLOWS, "splitting, flow {}", _FORM_OF_FLOWS),
        "The flows in turn: each the number of a part with its fraction of the step.",
    ),
    g.Key(
        "scheme: strang",
        g.word(lambda: SPLITTINGS.keys()),
        "The flows by the name of a published scheme, as gark list shows them.",
    ),
    g.Key(
        "terms: 3", g.count(2, MAX_TERMS), "The number of parts, if nothing else determines it.", 2
    ),
    form=_FORM,
    rules=[_WAYS],
)


def _read(at: PartReader, node: Node, where: str) -> ConstructionText | None:
    source = at.source
    before = len(source.faults)
    entries: g.ReadMapping | None = _KEYS.read(at, node, where)
    if entries is None:
        return None
    terms = _terms(at, entries, where)
    if len(source.faults) > before:
        return None
    rounding = None
    if "scheme" in entries:
        flows = [*_by_scheme(at, entries, terms, where)]
        tolerance = SPLITTINGS[entries["scheme"]].tolerance
        rounding = read_decimal(tolerance) if tolerance else None
    elif "flows" in entries:
        flows = [*_one_by_one(at, entries["flows"], terms)]
    else:
        flows = [*_alternating(at, entries, where)]
    if len(source.faults) > before:
        return None
    idle = set(range(terms)) - {l for l, _ in flows}
    if idle:
        message = f"{where}: part {min(idle) + 1} never flows"
        source.fault(node, message, "give every part a flow", code="missing-key")
        return None

    def made(tableau_of: Callable[[PartText], Tableau], values: Values) -> Tableau:
        numbers = [(l, values.number(entry)) for l, entry in flows]
        if "of" not in entries:
            return drift_and_kick(numbers, at.structure == "nystrom")
        what = "a part of a splitting is one vector field, and the method has several"
        methods = [one_field(tableau_of(part), what) for part in entries["of"]]
        return split(methods * (terms if len(methods) == 1 else 1), numbers)

    return at.made(node, made, rounding)


def _terms(at: PartReader, entries: g.ReadMapping, where: str) -> int:
    of = entries.nodes.get("of")
    terms: int | None = entries.get("terms")
    if isinstance(of, SequenceNode):
        given = len(of.value)
        terms = terms or given
        if given < 2 or given != terms:
            message = f"{where}, of: {given} methods for {terms} parts"
            at.source.fault(of, message, "give one for each part", code="wrong-size")
        return terms
    terms = terms or _largest(entries.nodes.get("flows"))
    if of is None and terms > 2:
        message = f"{where}: exact flows of {terms} parts are not a Runge-Kutta method"
        cure = "give of: METHOD, which takes the steps of the parts"
        at.source.fault(entries.node, message, cure, code="wrong-size")
    return terms


def _largest(flows: Node | None) -> int:
    """The largest number of a part among the flows, at least 2."""
    numbers = [2]
    for item in flows.value if isinstance(flows, SequenceNode) else ():
        for key, _ in item.value if isinstance(item, MappingNode) else ():
            text = str(key.value)
            if text.isdigit() and len(text) < 3:
                numbers.append(int(text))
    return min(max(numbers), MAX_TERMS)


def _alternating(at: PartReader, entries: g.ReadMapping, where: str) -> Iterator[_Flow]:
    """Yields a_1 of part 1, b_1 of part 2, and so on."""
    a, b = entries["a"], entries["b"]
    if len(a) - len(b) not in {0, 1}:
        message = f"{where}: a has {len(a)} numbers and b has {len(b)}"
        cure = "give as many, or one more to a: part 1 flows first"
        at.source.fault(entries.nodes["b"], message, cure, code="wrong-size")
        return
    for i, entry in enumerate(a):
        yield 0, entry
        yield from [(1, x) for x in b[i : i + 1]]


def _one_by_one(at: PartReader, items: list[Node], terms: int) -> Iterator[_Flow]:
    names = [str(l) for l in range(1, terms + 1)]
    for number, item in enumerate(items, start=1):
        where = f"splitting, flow {number}"
        for name, value in at.source.mapping(item, where, names, form=_FORM_OF_FLOWS).items():
            yield int(name) - 1, at.numbers.entry(value, where)


def _by_scheme(at: PartReader, entries: g.ReadMapping, terms: int, where: str) -> Iterator[_Flow]:
    scheme, node = SPLITTINGS[entries["scheme"]], entries.nodes["scheme"]
    if scheme.terms and scheme.terms != terms:
        message = f"{where}, scheme: {scheme.name} is for {scheme.terms} parts"
        at.source.fault(node, message, "strang is for any number", code="not-together")
        return
    for l, text in scheme.flows(terms):
        yield l, at.numbers.written(text, node, scheme.name)


KIND = g.ValueKind(_KEYS.schema, _read, _KEYS.inside)
