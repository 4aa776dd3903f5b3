"""Spec files of sweeps: families × stages × transfer rules × values of parameters, and criteria.

Every fault of the text at once, with its position, as for method files.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from itertools import product
from math import prod
from pathlib import Path

from flint import fmpq
from yaml.nodes import MappingNode, Node, ScalarNode, SequenceNode

from garkcli.errors import ExpressionError, UnknownFamily
from garkcli.exact.domain import Domain
from garkcli.exact.expression import parse
from garkcli.exact.nodes import Expression, Name
from garkcli.exact.rewriting import roots_in, substitute
from garkcli.families.registry import FAMILIES, MAX_STAGES, require_member
from garkcli.methodfile.load import NO_SETTINGS, described, read_text
from garkcli.methodfile.source import FileKind, Source, one_line, shortened
from garkcli.methodfile.transfers import ALL_RULES
from garkcli.transfer import RULES

SWEEP_FILE = FileKind(
    "sweep file",
    "the smallest file has methods or files, and columns",
    "start with methods:",
    "docs/sweep.md",
)
KEYS = (
    "name",
    "methods",
    "transfer",
    "files",
    "parameters",
    "columns",
    "where",
    "best",
    "pareto",
)
"""The keys of a spec file."""
MOST_METHODS = 10_000_000
"""Largest sweep."""
MOST_VALUES = 1_000_000
"""Most values of a parameter."""
_SPAN = re.compile(r"([0-9]{1,3})\.\.([0-9]{1,3})")
_CONDITION = re.compile(r"(>=|<=|>|<|=)?\s*([-+0-9./eE]+)")
_NAME = re.compile(r"[A-Za-z_][A-Za-z_0-9]*")


@dataclass(frozen=True)
class TemplateText:
    """A method file of a sweep, made or read, and the parameters that are given values in it."""

    name: str
    text: str
    parameters: tuple[str, ...]


@dataclass
class SweepText:
    """What a spec file says.

    Attributes:
        name: of the sweep.
        templates: the method files.
        grids: the values of each parameter, as text.
        columns: the criteria.
        conditions: column, relation and bound.
        best: columns to sort by.
        pareto: columns of the front.
    """

    name: str = ""
    templates: list[TemplateText] = field(default_factory=list)
    grids: dict[str, tuple[str, ...]] = field(default_factory=dict)
    columns: list[str] = field(default_factory=list)
    conditions: list[tuple[str, str, bool | float]] = field(default_factory=list)
    best: list[str] = field(default_factory=list)
    pareto: list[str] = field(default_factory=list)


def read_sweep(path: str, kinds: Mapping[str, str]) -> SweepText:
    """Read a spec file.

    Args:
        path: of the file; method files of it are looked for beside it.
        kinds: the columns there are, and whether each is a ``truth``, ``count`` or ``number``.

    Raises:
        MethodFileError: every fault of the file, with positions; or of a method file of it.
    """
    text, source = read_text(path, SWEEP_FILE)
    return reads_sweep(text, source, kinds, Path(path).parent)


def reads_sweep(
    text: str, source: str, kinds: Mapping[str, str], folder: Path
) -> SweepText:
    """Read a spec file from its text; see ``read_sweep``."""
    reading = Source(source, text, SWEEP_FILE)
    root = reading.compose()
    if root is None:
        raise reading.error()
    found = _Reader(reading, kinds, folder).read(root)
    reading.close()
    return found


class _Reader:
    """Reads one spec file."""

    def __init__(self, source: Source, kinds: Mapping[str, str], folder: Path) -> None:
        self.source = source
        self.kinds = kinds
        self.folder = folder
        self.found = SweepText()

    def read(self, root: MappingNode) -> SweepText:
        source, found = self.source, self.found
        entries = source.mapping(root, "the file", KEYS)
        if "name" in entries:
            found.name = one_line(source.scalar(entries["name"], "name") or "")
        found.name = found.name or Path(source.name).stem
        if "parameters" in entries:
            self._grids(entries["parameters"])
        if "methods" in entries:
            self._methods(entries["methods"], entries.get("transfer"))
        elif "transfer" in entries:
            source.fault(entries["transfer"], "transfer without methods", "add methods")
        if "files" in entries:
            self._files(entries["files"])
        if not {"methods", "files"} & entries.keys():
            cure = "write methods: [{family: gauss, stages: 1..4}], or files"
            source.fault(root, "no methods and no files", cure)
        self._criteria(root, entries)
        self._refuse_unused(entries)
        self._refuse_large(root)
        return found

    def _criteria(self, root: Node, entries: Mapping[str, Node]) -> None:
        found = self.found
        if "columns" in entries:
            found.columns = self._columns(entries["columns"], "columns")
        else:
            cure = "write columns: [order, error]"
            self.source.fault(root, "columns missing", cure)
        if "where" in entries:
            self._conditions(entries["where"])
        for key in ("best", "pareto"):
            if key in entries:
                setattr(found, key, self._columns(entries[key], key))
        conditions = [name for name, _, _ in found.conditions]
        asked = [*conditions, *found.columns, *found.best, *found.pareto]
        found.columns = list(dict.fromkeys(asked))

    # what the methods are

    def _methods(self, node: Node, transfer: Node | None) -> None:
        choices = [self._choices(item) for item in self.source.items(node, "methods")]
        if not choices:
            self.source.fault(node, "methods is empty", "name at least one family")
        rules: list[tuple[str, str, set[str]]] = [("", "", set())]
        if len(choices) > 1:
            if transfer is None:
                cure = "write transfer: [collocation, interpolation]"
                self.source.fault(node, "several methods need transfer", cure)
            else:
                rules = list(self._rules(transfer))
        elif transfer is not None:
            self.source.fault(transfer, "one method has no transfer", "leave it out")
        for methods in product(*choices):
            for rule, shown, names in rules:
                self._add(methods, rule, shown, names)

    def _add(
        self,
        methods: Sequence[tuple[str, int]],
        rule: str,
        shown: str,
        names: set[str],
    ) -> None:
        """One template out of families and a rule."""
        used = tuple(name for name in self.found.grids if name in names)
        members = [f'{{family: "{family}", stages: {s}}}' for family, s in methods]
        lines = [f"methods: [{', '.join(members)}]"]
        if rule:
            lines.append(f"transfer: {rule}")
        if used:
            lines.insert(0, f"parameters: {{{', '.join(f'{x}: free' for x in used)}}}")
        title = " + ".join(f"{family} {s}" for family, s in methods)
        name = f"{title}; {shown}" if shown else title
        template = TemplateText(name, "\n".join(lines) + "\n", used)
        if template not in self.found.templates:
            self.found.templates.append(template)

    def _choices(self, node: Node) -> list[tuple[str, int]]:
        """The members of one entry of ``methods``: those there are of families × stages."""
        where = "methods"
        entries = self.source.mapping(
            node,
            where,
            ("family", "stages"),
            form="write {family: gauss, stages: 1..4}",
        )
        if "family" not in entries:
            self.source.fault(node, "methods: family missing", "name one, or a list")
            return []
        families = []
        for item in _one_or_more(entries["family"]):
            name = self.source.choice(item, "methods, family", FAMILIES)
            families += [name] if name else []
        stages = self._stages(entries.get("stages"))
        found: dict[tuple[str, int], None] = {}
        for family in families:
            is_single = FAMILIES[family].smallest == FAMILIES[family].largest
            if is_single:
                found[family, FAMILIES[family].smallest] = None
                continue
            for s in stages:
                with suppress(UnknownFamily):
                    found[family, require_member(family, s)] = None
        if families and not found:
            message = f"methods: no member of {', '.join(families)} has these stages"
            self.source.fault(node, message, "write stages: 2, [1, 3] or 1..4")
        return list(found)

    def _stages(self, node: Node | None) -> list[int]:
        if node is None:
            return []
        found: list[int] = []
        for item in _one_or_more(node):
            span = _SPAN.fullmatch(item.value) if isinstance(item, ScalarNode) else None
            if span:
                first, last = int(span[1]), int(span[2])
                if not 1 <= first <= last <= MAX_STAGES:
                    message = f"methods, stages: {span[0]} is no range of stages"
                    self.source.fault(item, message, "write 1..4")
                found += range(first, min(last, MAX_STAGES) + 1)
                continue
            whole = self.source.whole(item, "methods, stages", 1)
            found += [whole] if whole else []
        return found

    def _rules(self, node: Node) -> Iterator[tuple[str, str, set[str]]]:
        """Each rule: as method files have it, as people read it, and the parameters in it."""
        for item in _one_or_more(node):
            if not isinstance(item, MappingNode):
                rule = self.source.choice(item, "transfer", ALL_RULES)
                if rule:
                    yield rule, rule, set()
                continue
            terms, names = [], set()
            for rule, weight in self.source.mapping(item, "transfer", RULES).items():
                text = self._weight(weight, f"transfer, weight of {rule}")
                if text is not None:
                    terms.append((rule, text))
                    names |= set(_NAME.findall(text)) & self.found.grids.keys()
            rule = "{" + ", ".join(f'{rule}: "{text}"' for rule, text in terms) + "}"
            if terms:
                yield rule, " + ".join(f"({x}) {rule}" for rule, x in terms), names

    def _weight(self, node: Node, where: str) -> str | None:
        text = self.source.scalar(node, where)
        if text is None:
            return None
        known: dict[str, Expression] = {x: Name(x) for x in self.found.grids}
        try:
            substitute(parse(text), known)
        except ExpressionError as error:
            self.source.expression_fault(node, where, error)
            return None
        return text

    def _files(self, node: Node) -> None:
        for item in _one_or_more(node):
            name = self.source.scalar(item, "files")
            if name is None:
                continue
            text, source = read_text(str(self.folder / name), SWEEP_FILE)
            reader, _ = described(text, source, NO_SETTINGS)
            has = reader.numbers.places
            used = tuple(x for x in self.found.grids if x in has)
            missing = [x for x in reader.numbers.free if x not in used]
            if missing:
                message = (
                    f"files: {shortened(name)} has the free parameter {missing[0]}"
                )
                cure = f"give it values: parameters: {{{missing[0]}: [1/4, 1/2]}}"
                self.source.fault(item, message, cure)
            self.found.templates.append(TemplateText(name, text, used))

    # parameters

    def _grids(self, node: Node) -> None:
        for name, values in self.source.mapping(node, "parameters", ()).items():
            where = f"parameters: {name}"
            if not _NAME.fullmatch(name):
                message = f"{where} cannot be the name of a parameter"
                self.source.fault(values, message, "use letters, digits and _")
                continue
            if isinstance(values, MappingNode):
                found = self._steps(values, where)
            else:
                given = [self._rational(x, where) for x in _one_or_more(values)]
                found = [x for x in given if x is not None]
            self.found.grids[name] = tuple(str(x) for x in dict.fromkeys(found))

    def _steps(self, node: Node, where: str) -> list[fmpq]:
        """Equidistant values, both ends included."""
        keys = ("from", "to", "steps")
        form = "write {from: 0, to: 1, steps: 10}"
        entries = self.source.mapping(node, where, keys, form=form)
        if entries.keys() != set(keys):
            self.source.fault(node, f"{where}: from, to and steps are needed", form)
            return []
        first = self._rational(entries["from"], where)
        last = self._rational(entries["to"], where)
        steps = self.source.whole(entries["steps"], where, 1)
        if first is None or last is None or steps is None or steps > MOST_VALUES:
            return []
        return [first + (last - first) * fmpq(k, steps) for k in range(steps + 1)]

    def _rational(self, node: Node, where: str) -> fmpq | None:
        text = self.source.scalar(node, where)
        return None if text is None else self._value(node, text, where)

    def _value(self, node: Node, text: str, where: str) -> fmpq | None:
        """A rational number; everything else is a fault."""
        try:
            expression = parse(text)
            if any(roots_in(expression)):
                message = f"{where}: a rational number is expected"
                self.source.fault(node, message, "write 1/3 or 0.25")
                return None
            value = Domain([expression]).evaluate(expression)
        except ExpressionError as error:
            self.source.expression_fault(node, where, error)
            return None
        assert isinstance(value, fmpq)
        return value

    def _refuse_unused(self, entries: Mapping[str, Node]) -> None:
        used = {name for x in self.found.templates for name in x.parameters}
        for name in self.found.grids:
            if name not in used and self.found.templates:
                message = f"parameters: no method has {name}"
                self.source.fault(
                    entries["parameters"], message, "leave it out, or use it"
                )

    def _refuse_large(self, root: Node) -> None:
        total = 0
        for template in self.found.templates:
            total += prod(len(self.found.grids[x]) for x in template.parameters)
        if total > MOST_METHODS:
            message = f"{total} methods (limit {MOST_METHODS})"
            self.source.fault(root, message, "make several sweeps")

    # criteria

    def _columns(self, node: Node, where: str) -> list[str]:
        found = []
        for item in _one_or_more(node):
            name = self.source.choice(item, where, self.kinds)
            found += [name] if name else []
        return found

    def _conditions(self, node: Node) -> None:
        for name, value in self.source.mapping(node, "where", self.kinds).items():
            if name not in self.kinds:
                continue
            text = self.source.scalar(value, f"where, {name}")
            if text is None:
                continue
            if self.kinds[name] == "truth":
                if text in {"true", "false"}:
                    self.found.conditions.append((name, "=", text == "true"))
                else:
                    message = f"where, {name}: true or false is expected"
                    self.source.fault(value, message)
                continue
            parts = _CONDITION.fullmatch(text)
            bound = self._bound(value, parts[2], name) if parts else None
            if parts and bound is not None:
                self.found.conditions.append((name, parts[1] or "=", bound))
            elif not parts:
                message = f"where, {name}: {shortened(text)} is no condition"
                self.source.fault(value, message, 'write 4 or ">= 4"')

    def _bound(self, node: Node, text: str, name: str) -> float | None:
        value = self._value(node, text, f"where, {name}")
        return None if value is None else int(value.p) / int(value.q)


def _one_or_more(node: Node) -> list[Node]:
    """The items of a list, or the one value."""
    return list(node.value) if isinstance(node, SequenceNode) else [node]
