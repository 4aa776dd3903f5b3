"""YAML nodes to the methods and the numbers that constructions are made from."""

from __future__ import annotations

from collections.abc import Iterable

from flint import fmpq
from yaml.nodes import MappingNode, Node, ScalarNode

from garkcli.errors import MethodFileError
from garkcli.families.registry import FAMILIES
from garkcli.methodfile.build import families_of, nodes_to_spell_out
from garkcli.methodfile.coefficient_schema import Schema
from garkcli.methodfile.description import Description, PartText
from garkcli.methodfile.nodes import keys_of
from garkcli.methodfile.numbers import Entry, Numbers
from garkcli.methodfile.source import Entries, Source

EXAMPLE = (
    "write for instance {family: rk4}, {A: …, b: …} or a name of the catalogue"
)
AT_POINTS = "its substeps cannot be spelled out"
METHOD: Schema = {"$ref": "#/definitions/part"}
"""A method inside of a construction, in the JSON Schema."""
_opened: list[str] = []
"""The methods of the catalogue that are being read, one for the sake of another."""


class PartReader:
    """Reads what constructions of one file are made from.

    Attributes:
        source: the file, where faults are noted.
        numbers: its coefficients.
    """

    def __init__(self, source: Source, numbers: Numbers) -> None:
        self.source = source
        self.numbers = numbers

    def method(
        self, node: Node, where: str, why: str = AT_POINTS
    ) -> PartText | None:
        """A method: a family, coefficients of any form, or a name.

        Args:
            node: where it stands.
            where: what it is, for messages.
            why: what does not work where its stages cannot be given by points; empty where any
                stages will do.
        """
        if isinstance(node, ScalarNode):
            return self._named(node, where, why)
        description = self._written(node, where)
        if description is None:
            return None
        return _part(self.source, self.numbers, description, why)

    def _written(self, node: Node, where: str) -> Description | None:
        """A method that is spelled out here."""
        # a construction holds methods, and a method may be a construction
        from garkcli.methodfile.content import (
            CURES,
            KEYS_OF_METHOD,
            ContentReader,
        )

        reader = ContentReader(self.source, self.numbers)
        if isinstance(node, MappingNode) and "family" in keys_of(node):
            key = ScalarNode("tag:yaml.org,2002:str", "methods")
            family: Entries = {"methods": node}
            root = MappingNode("tag:yaml.org,2002:map", [(key, node)])
            root.start_mark = node.start_mark
            return reader.read(root, family)
        entries = self.source.mapping(
            node, where, KEYS_OF_METHOD, CURES, EXAMPLE
        )
        if not isinstance(node, MappingNode):
            return None
        return reader.read(node, entries)

    def _named(
        self, node: ScalarNode, where: str, why: str
    ) -> PartText | None:
        """A single method of a family, or one of the catalogue."""
        name = self.source.scalar(node, where)
        if name is None:
            return None
        family = FAMILIES.get(name)
        if family is not None and family.is_single and not family.options:
            word = ScalarNode("tag:yaml.org,2002:str", name)
            key = ScalarNode("tag:yaml.org,2002:str", "family")
            for made in (word, key):
                made.start_mark, made.end_mark = node.start_mark, node.end_mark
            mapping = MappingNode("tag:yaml.org,2002:map", [(key, word)])
            mapping.start_mark = node.start_mark
            return self.method(mapping, where, why)
        try:
            return self._of_catalogue(name, why)
        except MethodFileError as error:
            first = error.faults[0]
            message = f"{where}: {first.message}"
            if error.source != name:
                message = f"{where}: {name}: {first.message}"
            self.source.fault(node, message, first.help)
            return None

    def _of_catalogue(self, name: str, why: str) -> PartText:
        """A method of the catalogue, its coefficients among those of this file.

        Raises:
            MethodFileError: there is none, or it is no method on its own.
        """
        from garkcli.methodfile.load import described
        from garkcli.methodfile.naming import read_argument

        text, found = read_argument(f"catalogue:{name}")
        if found in _opened:
            circle = Source(found, text)
            circle.fault(None, f"{found} is made from itself")
            raise circle.error()
        _opened.append(found)
        try:
            reader, description = described(text, found, {})
            if reader.numbers.free:
                message = f"{found} is a family with free parameters"
                cure = (
                    "write its coefficients here, with parameters of this file"
                )
                reader.source.fault(None, message, cure)
            reader.source.close()
            part = _part(reader.source, reader.numbers, description, why)
            reader.source.close()
        finally:
            _opened.pop()
        self.numbers.entries += reader.numbers.entries
        return part

    def number(self, node: Node, where: str) -> Entry:
        """A coefficient of the construction."""
        return self.numbers.entry(node, where)

    def truth(self, node: Node | None, where: str) -> bool | None:
        """True or false; None where nothing stands there, or a fault was noted."""
        if node is None:
            return None
        word = self.source.choice(node, where, ("true", "false"))
        return None if word is None else word == "true"


def _part(
    source: Source, numbers: Numbers, description: Description, why: str
) -> PartText:
    families = families_of(description)
    nodes = nodes_to_spell_out(description, families, numbers, why)
    return PartText(source, description, families, nodes)


def tolerance_of(
    parts: Iterable[PartText | None], *others: fmpq | None
) -> fmpq | None:
    """The rounding of what is made from parts: the largest of theirs; None where all are exact."""
    known = [part.tolerance for part in parts if part is not None]
    found = [x for x in (*known, *others) if x is not None]
    return max(found, default=None)
