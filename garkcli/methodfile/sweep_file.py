"""Spec files of sweeps: families × stages × transfer rules × values of parameters, and criteria.

Every fault of the text at once, with its position, as for method files.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from math import prod
from pathlib import Path

from flint import fmpq
from yaml.nodes import MappingNode, Node

from garkcli.errors import ExpressionError
from garkcli.exact.domain import Domain
from garkcli.exact.expression import parse
from garkcli.exact.rewriting import roots_in
from garkcli.methodfile.file_kind import FileKind
from garkcli.methodfile.reading import read_text
from garkcli.methodfile.source import Source
from garkcli.methodfile.sweep_methods import MethodsReader
from garkcli.methodfile.sweep_search import FREE, is_free, read_search
from garkcli.methodfile.sweep_text import SweepText, one_or_more
from garkcli.methodfile.words import one_line, shortened, unquoted

SWEEP_FILE = FileKind(
    "sweep file",
    ("columns", "methods"),
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
    "search",
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
_CONDITION = re.compile(r"(>=|<=|>|<|=)?\s*([-+0-9./eE]+)")
_NAME = re.compile(r"[A-Za-z_][A-Za-z_0-9]*")


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


def reads_sweep(text: str, source: str, kinds: Mapping[str, str], folder: Path) -> SweepText:
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
        if "search" in entries:
            found.search = read_search(source, entries["search"])
        methods = MethodsReader(source, found)
        if "methods" in entries:
            methods.read(entries["methods"], entries.get("transfer"))
        elif "transfer" in entries:
            source.fault(entries["transfer"], "transfer without methods", "add methods")
        if "files" in entries:
            methods.read_files(entries["files"], self.folder)
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

    def _grids(self, node: Node) -> None:
        for name, values in self.source.mapping(node, "parameters", ()).items():
            where = f"parameters: {unquoted(name)}"
            if not _NAME.fullmatch(name):
                message = f"{where} cannot be the name of a parameter"
                self.source.fault(values, message, "use letters, digits and _")
                continue
            if is_free(values):
                self.found.free += (name,)
                continue
            if not one_or_more(values):
                self.source.fault(values, f"{where} has no value", "name one")
            if isinstance(values, MappingNode):
                found = self._steps(values, where)
            else:
                given = [self._rational(x, where) for x in one_or_more(values)]
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
        if not self.found.templates:
            return
        used = {name for x in self.found.templates for name in x.parameters}
        for name in self.found.grids.keys() - used:
            message = f"parameters: no method has {name}"
            self.source.fault(entries["parameters"], message, "leave it out, or use it")
        is_searched = any(x.order for x in self.found.templates)
        # a parameter without a value is told already
        is_told = not all(self.found.grids.values())
        if "search" in entries and not is_searched and not is_told:
            message = "search: no method has an unknown that is left to it"
            cure = f"write parameters: {{tau: {FREE}}}, or a file with unknowns"
            self.source.fault(entries["search"], message, cure)

    def _refuse_large(self, root: Node) -> None:
        total = 0
        search = self.found.search
        seeds = 1 if search is None else len(search.seeds)
        for template in self.found.templates:
            count = prod(len(self.found.grids[x]) for x in template.parameters)
            total += count * (seeds if template.order else 1)
        if total > MOST_METHODS:
            message = f"{total} methods (limit {MOST_METHODS})"
            self.source.fault(root, message, "make several sweeps")

    def _columns(self, node: Node, where: str) -> list[str]:
        found = []
        for item in one_or_more(node):
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
        where = f"where, {name}"
        value = self._value(node, text, where)
        if value is None:
            return None
        bound = _as_float(value)
        if bound is None:
            message = f"{where}: {shortened(text)} is beyond the numbers of a column"
            self.source.fault(node, message, "write 0, or a number up to 1e308")
        return bound


def _as_float(value: fmpq) -> float | None:
    """The nearest float; None where it is infinite, or 0 and the number is not."""
    try:
        found = int(value.p) / int(value.q)
    except OverflowError:
        return None
    return found if found or not value else None
