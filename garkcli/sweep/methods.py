"""The methods of a sweep: families × stages × transfer rules, and method files."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from contextlib import suppress
from itertools import chain, product
from math import prod
from pathlib import Path
from typing import Any

from garkcli.deadline import checked
from garkcli.errors import ExpressionError, MethodFileError, UnknownFamily
from garkcli.exact.expression import parse
from garkcli.exact.nodes import Expression, Name
from garkcli.exact.rewriting import substitute
from garkcli.families.family import MAX_STAGES
from garkcli.families.registry import BY_STAGES, recipe_of
from garkcli.frozen import Frozen
from garkcli.grammar import keys as g
from garkcli.grammar.nodes import Node, ScalarNode, SequenceNode, keys_of, shortened
from garkcli.grammar.source import Source
from garkcli.methodfile.family import loads_family
from garkcli.methodfile.load import NO_SETTINGS, described
from garkcli.methodfile.naming import read_argument
from garkcli.methodfile.numbers import UNKNOWN
from garkcli.methodfile.parameters import SIGNS
from garkcli.methodfile.transfers import ALL_RULES, OF_DEGREE
from garkcli.transfer import RULES

STARTS = 20


class Template(Frozen):
    """A method file with parameters. A search for other unknowns has ``order``, 0 without;
    ``is_drawn``: the transfer is drawn from those whose pair has the order.
    """

    name: str
    text: str
    parameters: tuple[str, ...]
    order: int = 0
    seeds: range = range(0)
    starts: int = 0
    is_drawn: bool = False

    @property
    def is_searched(self) -> bool:
        return self.order > 0

    def count(self, grids: Mapping[str, tuple[str, ...]]) -> int:
        """Returns the number of methods with all values of the parameters and all seeds."""
        values = prod(len(grids[name]) for name in self.parameters)
        return values * len(self.seeds) if self.is_searched else values


_SPAN = re.compile(r"([0-9]{1,9})\.\.([0-9]{1,9})")
NAME = re.compile(r"[A-Za-z_][A-Za-z_0-9]*")


def span(least: int, digits: int, cure: str, most: int | None = None) -> g.ValueKind:
    """Reads a number, or a range such as 1..4, up to ``most``."""

    def read(at: Any, node: Node, where: str) -> range | None:
        text = node.value if isinstance(node, ScalarNode) else ""
        match = _SPAN.fullmatch(text)
        if match is None:
            whole = at.source.whole(node, where, least)
            return None if whole is None else range(whole, whole + 1)
        first, last = map(int, match.groups())
        if least <= first <= last and (most is None or last <= most or first == last):
            return range(first, last + 1)
        at.source.fault(
            node, f"{where}: {shortened(text)} is not a range", cure, code="wrong-value"
        )
        return None

    some = rf"[0-9]{{1,{digits}}}"
    text = {"type": "string", "pattern": rf"^{some}\.\.{some}$"}
    return g.ValueKind(lambda: {"anyOf": [{"type": "integer", "minimum": least}, text]}, read)


def rational(read: g.Read) -> g.ValueKind:
    text = "A rational number: 2, 0.1, 1/3."
    return g.ValueKind(
        lambda: {"description": text, "type": ["number", "string"], "pattern": SIGNS}, read
    )


_STAGES = span(1, 3, f"write 2, [1, 3] or 1..4, up to {MAX_STAGES}", MAX_STAGES)
_METHOD = g.mapping(
    g.Key(
        "family: [gauss, radau-iia]",
        g.one_or_more(g.word(BY_STAGES.keys)),
        "A family of methods, or a list of families, each tried.",
        is_needed=True,
    ),
    g.Key(
        "stages: 1..4", g.one_or_more(_STAGES), "A number of stages, a range, or a list of these."
    ),
    form="write {family: gauss, stages: 1..4}",
)
METHODS = g.list_of(_METHOD, "methods", each="methods", form="name at least one family")
"""Families × stages, one entry for each colour."""


def _weight(at: MethodsReader, node: Node, where: str) -> str | None:
    text = at.source.scalar(node, where)
    if text is None:
        return None
    known: dict[str, Expression] = {x: Name(x) for x in at.names}
    try:
        substitute(parse(text), known)
    except ExpressionError as error:
        at.source.expression_fault(node, where, error)
        return None
    return text


def _weights(at: MethodsReader, node: Node, where: str) -> dict[str, str] | g.ReadMapping | None:
    if keys_of(node) & {"rule", "degree"}:
        found_degree: g.ReadMapping | None = OF_DEGREE.read(at, node, where)
        return found_degree
    entries = at.source.mapping(node, where, RULES)
    weights = {rule: _weight(at, x, f"{where}, weight of {rule}") for rule, x in entries.items()}
    return {rule: text for rule, text in weights.items() if text is not None}


_RULES = g.by_name(rational(_weight), minProperties=1, propertyNames={"enum": list(RULES)})
_SCHEMAS = g.ValueKind(lambda: {"anyOf": [_RULES.schema(), OF_DEGREE.schema()]}, _weights)
TRANSFER = g.one_or_more(g.either(g.word(lambda: [*ALL_RULES, UNKNOWN]), at_mapping=_SCHEMAS))
"""Rules between methods, each of which is tried, or any transfer."""


class MethodsReader:
    """Makes method files; ``grids`` has values of parameters, ``free`` those left to ``search``."""

    def __init__(
        self,
        source: Source,
        grids: Mapping[str, tuple[str, ...]],
        free: Sequence[str],
        search: g.ReadMapping | None,
    ) -> None:
        self.source = source
        self.grids = grids
        self.free = free
        self.search = search
        self.templates: list[Template] = []
        self.names = {*grids, *free}
        """The parameters that weights may contain."""

    def read(self, node: Node, entries: Sequence[g.ReadMapping], transfer: Node | None) -> None:
        self._at = node
        choices = [self._choices(entry) for entry in entries]
        rules: list[tuple[str, str, set[str]]] = [("", "", set())]
        if len(choices) > 1:
            if transfer is None:
                cure = "write transfer: [collocation, interpolation]"
                self.source.fault(node, "several methods need transfer", cure, code="missing-key")
            else:
                rules = [
                    self._rule(x) for x in TRANSFER.read(self, transfer, "transfer") or () if x
                ]
        elif transfer is not None and choices:
            message = "one method has no transfer"
            self.source.fault(transfer, message, "leave it out", code="not-together")
        for methods in checked(product(*choices)):
            for rule, shown, names in rules:
                self._add(methods, rule, shown, names)

    def _rule(self, given: str | dict[str, str] | g.ReadMapping) -> tuple[str, str, set[str]]:
        """Returns a rule as in method files, as shown to users, and the parameters in it."""
        if given == UNKNOWN:
            return f'"{UNKNOWN}"', "any transfer", set()
        if isinstance(given, str):
            return given, given, set()
        if isinstance(given, g.ReadMapping):
            degree = given.get("degree")
            if degree is None:
                return "legendre", "legendre", set()
            return f"{{rule: legendre, degree: {degree}}}", f"legendre, degree {degree}", set()
        rule = "{" + ", ".join(f'{rule}: "{text}"' for rule, text in given.items()) + "}"
        shown = " + ".join(f"({text}) {rule}" for rule, text in given.items())
        return rule, shown, {name for x in given.values() for name in NAME.findall(x)} & self.names

    def _add(
        self, methods: Sequence[tuple[str, int]], rule: str, shown: str, names: set[str]
    ) -> None:
        used = tuple(name for name in self.grids if name in names)
        free = [name for name in self.free if name in names]
        members = [f'{{family: "{family}", stages: {s}}}' for family, s in methods]
        given = ", ".join(f"{name}: free" for name in (*used, *free))
        lines = [f"parameters: {{{given}}}"] if given else []
        lines.append(f"methods: [{', '.join(members)}]")
        lines += [f"transfer: {rule}"] if rule else []
        title = " + ".join(f"{family} {s}" for family, s in methods)
        name = f"{title}; {shown}" if shown else title
        is_drawn = UNKNOWN in rule
        free += ["the transfer"] if is_drawn else []
        order = self._order(self._at, name, free) if free else 0
        template = self._template(name, "\n".join(lines) + "\n", used, order, is_drawn)
        if template not in self.templates:
            self.templates.append(template)

    def _template(
        self, name: str, text: str, used: tuple[str, ...], order: int, is_drawn: bool = False
    ) -> Template:
        if not order or self.search is None:
            return Template(name, text, used)
        starts = self.search.get("starts", STARTS)
        return Template(name, text, used, order, self.search["seeds"], starts, is_drawn)

    def _choices(self, entry: g.ReadMapping) -> list[tuple[str, int]]:
        """Returns the existing members of families × stages for an entry of ``methods``."""
        families: list[str] = entry.get("family", [])
        members: dict[tuple[str, int], None] = {}
        for family in families:
            if BY_STAGES[family].is_single:
                members[family, BY_STAGES[family].smallest] = None
                continue
            for s in chain.from_iterable(entry.get("stages", ())):
                with suppress(UnknownFamily):
                    members[family, recipe_of(family, s).stages] = None
        if families and not members:
            message = f"methods: no member of {', '.join(families)} has these stages"
            self.source.fault(
                entry.node, message, "write stages: 2, [1, 3] or 1..4", code="wrong-value"
            )
        return list(members)

    def read_files(self, node: Node, folder: Path) -> None:
        for item in node.value if isinstance(node, SequenceNode) else [node]:
            name = self.source.scalar(item, "files")
            if name is None:
                continue
            path = str(folder / name)
            try:
                text, source = read_argument(name, path)
            except MethodFileError as error:
                if any(x.line for x in error.faults):
                    raise
                for x in error.faults:
                    self.source.fault(item, x.message, x.help, code=x.code)
                continue
            if source != path:
                name = source  # of the catalogue, however it was typed
            reader, _ = described(text, source, NO_SETTINGS)
            has = {**reader.numbers.places, **reader.numbers.free}
            used = tuple(x for x in self.grids if x in has)
            missing = [x for x in reader.numbers.free if x not in used]
            order = 0
            if missing and self.search is None:
                message = f"files: {shortened(name)} has the free parameter {missing[0]}"
                cure = (
                    f"give it values: parameters: {{{missing[0]}: [1/4, 1/2]}}"
                    ", or search: {seeds: 1..100}"
                )
                self.source.fault(item, message, cure, code="free-parameters")
            elif missing and all(self.grids[x] for x in used):
                family = loads_family(text, source, {x: self.grids[x][0] for x in used})
                order = self._order(item, name, missing, family.order or 0)
            self.templates.append(self._template(name, text, used, order))

    def _order(self, node: Node, name: str, unknowns: Sequence[str], own: int = 0) -> int:
        """Returns the order that is searched for: that of ``search``, or of the file."""
        if self.search is None:
            message = f"{shortened(name)} leaves {unknowns[0]} to a search"
            order = "" if own else "order: 4, "
            cure = f"write search: {{{order}seeds: 1..100}}"
            self.source.fault(node, message, cure, code="free-parameters")
            return 0
        wanted: int = self.search.get("order", own)
        if not wanted:
            message = f"{shortened(name)}: a search is for an order"
            cure = "write search: {order: 4, seeds: 1..100}, or in a file design: {order: 4}"
            self.source.fault(node, message, cure, code="option-alone")
        return wanted
