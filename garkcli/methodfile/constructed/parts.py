"""The methods and numbers of constructions."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, TypeAlias

from flint import fmpq

from garkcli.errors import MethodFileError
from garkcli.families.registry import FAMILIES
from garkcli.frozen import Frozen
from garkcli.grammar.keys import defined
from garkcli.grammar.nodes import Node, ScalarNode, node_at
from garkcli.grammar.source import Source
from garkcli.methodfile.build import part_of
from garkcli.methodfile.description import ConstructionText, Description, Make, PartText, Structure
from garkcli.methodfile.numbers import Numbers, NumbersReader

if TYPE_CHECKING:
    from garkcli.methodfile.tolerance import Tolerance

_FORM = "write for instance rk4, {family: heun} or {A: …, b: …}"
_NO_FILE = "put it as NAME.gark.yaml in a folder of GARK_PATH, and write NAME"
AT_POINTS = "its substeps cannot be spelled out"
METHOD = defined("part", lambda at, node, where: at.method(node, where))


class Opened(Frozen):
    source: Source
    numbers: Numbers
    description: Description


Open: TypeAlias = Callable[[str], Opened]
"""Reads a method of the catalogue; MethodFileError for unknown names and cycles."""
Written: TypeAlias = Callable[[Node, str], Description | None]
"""Reads a method in this file; the text names it in messages."""


class PartReader(NumbersReader):
    """``written`` reads methods that are spelled out, ``opened`` those of the catalogue."""

    def __init__(
        self,
        numbers: Numbers,
        written: Written,
        opened: Open,
        tolerance: Tolerance | None,
        structure: Structure,
    ) -> None:
        super().__init__(numbers)
        self._tolerance = tolerance
        self.structure = structure
        self.parts: list[PartText] = []
        self._written = written
        self._open = opened

    @property
    def tolerance(self) -> fmpq | None:
        own = self._tolerance
        return None if own is None else own.largest(self.numbers.entries)

    def method(self, node: Node, where: str, why: str = AT_POINTS) -> PartText | None:
        """Reads a family, a form or a name; ``why`` says what needs point stages, or is empty."""
        if isinstance(node, ScalarNode):
            return self._named(node, where, why)
        description = self._written(node, where)
        if description is None:
            return None
        part = part_of(self.source, self.numbers, description, why)
        self.parts.append(part)
        return part

    def _named(self, node: ScalarNode, where: str, why: str) -> PartText | None:
        name = self.source.scalar(node, where)
        if name is None:
            return None
        if not name:
            self.source.fault(node, f"{where}: a method is missing", _FORM, code="missing-key")
            return None
        if name.endswith((".yaml", ".yml")) or {"/", "\\"} & set(name):
            message = f"{where}: a name is expected here, not a file"
            self.source.fault(node, message, _NO_FILE, code="value-expected")
            return None
        family = FAMILIES.get(name)
        if family is not None and family.is_single and not family.options:
            return self.method(node_at({"family": name}, node), where, why)
        try:
            part = self._of_catalogue(name, why)
        except MethodFileError as error:
            first = error.faults[0]
            message = f"{where}: {first.message}"
            if error.source != name:
                message = f"{where}: {name}: {first.message}"
            self.source.fault(node, message, first.help, code=first.code)
            return None
        self.parts.append(part)
        return part

    def _of_catalogue(self, name: str, why: str) -> PartText:
        """A method of the catalogue, its coefficients added to those of this file; no family."""
        opened = self._open(name)
        if opened.numbers.free:
            message = f"{name} is a family with free parameters"
            cure = "write its coefficients here, with parameters of this file"
            opened.source.fault(None, message, cure, code="free-parameters")
        opened.source.close()
        part = part_of(opened.source, opened.numbers, opened.description, why)
        opened.source.close()
        self.numbers.entries += opened.numbers.entries
        return part

    def made(self, node: Node, make: Make, rounding: fmpq | None = None) -> ConstructionText:
        return ConstructionText(node, tuple(self.parts), make, self.rounding(rounding))

    def rounding(self, *others: fmpq | None) -> fmpq | None:
        """The largest tolerance of the parts; None if all are exact."""
        tolerances = [
            x for x in (*(part.tolerance for part in self.parts), *others) if x is not None
        ]
        return max(tolerances, default=None)
