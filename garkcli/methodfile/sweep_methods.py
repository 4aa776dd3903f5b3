"""Which methods a spec file names: families × stages × transfer rules, and method files."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from contextlib import suppress
from itertools import product
from pathlib import Path

from yaml.nodes import MappingNode, Node, ScalarNode

from garkcli.errors import ExpressionError, UnknownFamily
from garkcli.exact.expression import parse
from garkcli.exact.nodes import Expression, Name
from garkcli.exact.rewriting import substitute
from garkcli.families.registry import BY_STAGES, MAX_STAGES, recipe_of
from garkcli.methodfile.family import loads_family
from garkcli.methodfile.load import NO_SETTINGS, described
from garkcli.methodfile.naming import read_argument
from garkcli.methodfile.source import Source
from garkcli.methodfile.sweep_text import SweepText, TemplateText, one_or_more
from garkcli.methodfile.transfers import ALL_RULES
from garkcli.methodfile.words import shortened
from garkcli.transfer import RULES

_SPAN = re.compile(r"([0-9]{1,9})\.\.([0-9]{1,9})")
_NAME = re.compile(r"[A-Za-z_][A-Za-z_0-9]*")


class MethodsReader:
    """Makes method files out of ``methods``, ``transfer`` and ``files``.

    Args:
        source: the spec file.
        found: where they go; it has the values of the parameters already.
    """

    def __init__(self, source: Source, found: SweepText) -> None:
        self.source = source
        self.found = found

    @property
    def _names(self) -> set[str]:
        """Parameters that weights may use."""
        return {*self.found.grids, *self.found.free}

    def read(self, node: Node, transfer: Node | None) -> None:
        """The entries of ``methods`` with each rule of ``transfer``."""
        self._at = node
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
        self, methods: Sequence[tuple[str, int]], rule: str, shown: str, names: set[str]
    ) -> None:
        """One template out of families and a rule."""
        used = tuple(name for name in self.found.grids if name in names)
        free = [name for name in self.found.free if name in names]
        members = [f'{{family: "{family}", stages: {s}}}' for family, s in methods]
        lines = [f"methods: [{', '.join(members)}]"]
        if rule:
            lines.append(f"transfer: {rule}")
        if used or free:
            given = ", ".join(f"{name}: free" for name in (*used, *free))
            lines.insert(0, f"parameters: {{{given}}}")
        title = " + ".join(f"{family} {s}" for family, s in methods)
        name = f"{title}; {shown}" if shown else title
        order = self._order(self._at, name, free) if free else 0
        template = TemplateText(name, "\n".join(lines) + "\n", used, order)
        if template not in self.found.templates:
            self.found.templates.append(template)

    def _choices(self, node: Node) -> list[tuple[str, int]]:
        """The members of one entry of ``methods``: those there are of families × stages."""
        where = "methods"
        entries = self.source.mapping(
            node, where, ("family", "stages"), form="write {family: gauss, stages: 1..4}"
        )
        if "family" not in entries:
            self.source.fault(node, "methods: family missing", "name one, or a list")
            return []
        families = []
        for item in one_or_more(entries["family"]):
            name = self.source.choice(item, "methods, family", BY_STAGES)
            families += [name] if name else []
        stages = self._stages(entries.get("stages"))
        found: dict[tuple[str, int], None] = {}
        for family in families:
            if BY_STAGES[family].is_single:
                found[family, BY_STAGES[family].smallest] = None
                continue
            for s in stages:
                with suppress(UnknownFamily):
                    found[family, recipe_of(family, s).stages] = None
        if families and not found:
            message = f"methods: no member of {', '.join(families)} has these stages"
            self.source.fault(node, message, "write stages: 2, [1, 3] or 1..4")
        return list(found)

    def _stages(self, node: Node | None) -> list[int]:
        if node is None:
            return []
        found: list[int] = []
        for item in one_or_more(node):
            span = _SPAN.fullmatch(item.value) if isinstance(item, ScalarNode) else None
            if span:
                first, last = int(span[1]), int(span[2])
                if not 1 <= first <= last <= MAX_STAGES:
                    message = f"methods, stages: {span[0]} is no range of stages"
                    cure = f"write 1..4, up to {MAX_STAGES}"
                    self.source.fault(item, message, cure)
                found += range(first, min(last, MAX_STAGES) + 1)
                continue
            whole = self.source.whole(item, "methods, stages", 1)
            found += [whole] if whole else []
        return found

    def _rules(self, node: Node) -> Iterator[tuple[str, str, set[str]]]:
        """Each rule: as method files have it, as people read it, and the parameters in it."""
        for item in one_or_more(node):
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
                    names |= set(_NAME.findall(text)) & self._names
            rule = "{" + ", ".join(f'{rule}: "{text}"' for rule, text in terms) + "}"
            if terms:
                yield (rule, " + ".join(f"({x}) {rule}" for rule, x in terms), names)

    def _weight(self, node: Node, where: str) -> str | None:
        text = self.source.scalar(node, where)
        if text is None:
            return None
        known: dict[str, Expression] = {x: Name(x) for x in self._names}
        try:
            substitute(parse(text), known)
        except ExpressionError as error:
            self.source.expression_fault(node, where, error)
            return None
        return text

    def read_files(self, node: Node, folder: Path) -> None:
        """Method files, beside the spec file."""
        for item in one_or_more(node):
            name = self.source.scalar(item, "files")
            if name is None:
                continue
            path = str(folder / name)
            text, source = read_argument(name, path)
            if source != path:
                name = source  # of the catalogue, however it was typed
            reader, _ = described(text, source, NO_SETTINGS)
            has = {**reader.numbers.places, **reader.numbers.free}
            used = tuple(x for x in self.found.grids if x in has)
            missing = [x for x in reader.numbers.free if x not in used]
            order = 0
            if missing and self.found.search is None:
                message = f"files: {shortened(name)} has the free parameter {missing[0]}"
                cure = (
                    f"give it values: parameters: {{{missing[0]}: [1/4, 1/2]}}"
                    ", or search: {seeds: 1..100}"
                )
                self.source.fault(item, message, cure)
            elif missing and all(self.found.grids[x] for x in used):
                first = {x: self.found.grids[x][0] for x in used}
                family = loads_family(text, source, first)
                order = self._order(item, name, missing, family.order or 0)
            self.found.templates.append(TemplateText(name, text, used, order))

    def _order(self, node: Node, name: str, unknowns: Sequence[str], own: int = 0) -> int:
        """The order that is searched for: that of ``search``, or the file's own."""
        search = self.found.search
        if search is None:
            message = f"{shortened(name)} leaves {unknowns[0]} to a search"
            self.source.fault(node, message, "write search: {seeds: 1..100}")
        elif not (search.order or own):
            message = f"{shortened(name)}: a search is for an order"
            cure = "write search: {order: 4}, or in a file design: {order: 4}"
            self.source.fault(node, message, cure)
        return 0 if search is None else search.order or own
