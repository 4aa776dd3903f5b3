"""YAML nodes to a ``Description``: every key, shape and word checked, faults collected as they are
met.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import replace
from typing import TYPE_CHECKING

from flint import fmpq
from yaml.nodes import MappingNode, Node

from garkcli.errors import LimitExceeded
from garkcli.exact.expression import read_decimal
from garkcli.methodfile import expectations
from garkcli.methodfile.bibliography import read_aliases, read_reference
from garkcli.methodfile.content import CURES, ContentReader
from garkcli.methodfile.description import BESIDE, FORMS, PLAIN, ConstructionText, Description
from garkcli.methodfile.nodes import Extent, extent, key_of, keys_of
from garkcli.methodfile.numbers import Numbers
from garkcli.methodfile.parameters import read_parameters, refuse_unknown_settings
from garkcli.methodfile.source import Source
from garkcli.methodfile.words import shortened

if TYPE_CHECKING:
    from garkcli.methodfile.constructed.parts import Opened
    from garkcli.methodfile.shaped import Shaped

KEYS = (
    "gark",
    "name",
    "aliases",
    "description",
    "reference",
    *FORMS,
    *PLAIN,
    *BESIDE,
    "unknown",
    "design",
    "transfer",
    "structure",
    "conjugate",
    "linear",
    "parameters",
    "tolerance",
    "expect",
)
"""The keys of a method file."""
_DECIMAL = re.compile(r"([0-9]+(\.[0-9]*)?|\.[0-9]+)([eE][+-]?[0-9]+)?", re.ASCII)


class Reader:
    """Reads one file.

    Args:
        settings: values of parameters that are given from outside of it.
        inside: the methods of the catalogue for the sake of which it is read.

    Attributes:
        source: the file, where faults are noted.
        numbers: its coefficients.
        content: what reads them.
        keys: at the top of the file.
        design: what stands under ``design``; None without that.
    """

    def __init__(
        self, source: Source, settings: Mapping[str, str], inside: tuple[str, ...] = ()
    ) -> None:
        self.source = source
        self.numbers = Numbers(source, settings=settings)
        self.content = ContentReader(source, self.numbers, self._opened)
        self._inside = inside
        self.keys: frozenset[str] = frozenset()
        self.design: Node | None = None
        self._root: MappingNode | None = None

    def read(self) -> Description | None:
        """The description; None, with faults noted in the source, where there is none."""
        source = self.source
        root = source.compose()
        if root is None or self._is_problem_file(root):
            return None
        entries = source.mapping(root, "the file", KEYS, CURES)
        self.keys = frozenset(entries)
        self.design = entries.get("design")
        self._root = root
        source.check_version(entries.get("gark"))
        text = {}
        for key in ("name", "description"):
            if key in entries:
                text[key] = source.scalar(entries[key], key) or ""
        aliases = read_aliases(source, entries.get("aliases"))
        reference, bibliography = read_reference(source, entries.get("reference"))
        tolerance = self._tolerance(entries.get("tolerance"))
        claims = expectations.read(source, entries.get("expect"))
        read_parameters(self.numbers, entries.get("parameters"))
        self.content.tolerance = tolerance
        found = self.content.read(root, entries)
        if found is None:
            return None
        refuse_unknown_settings(self.numbers)
        if tolerance is None and isinstance(found.content, ConstructionText):
            tolerance = found.content.tolerance
        return replace(
            found,
            name=text.get("name", ""),
            description=text.get("description", ""),
            tolerance=tolerance,
            claims=claims,
            aliases=aliases,
            reference=reference,
            bibliography=bibliography,
        )

    @property
    def shaped(self) -> Shaped | None:
        """The tableau of its ``unknown``; None without that."""
        return self.content.shaped

    def _opened(self, name: str) -> Opened:
        """A method of the catalogue that this one is made from.

        Raises:
            MethodFileError: there is none, or it is made from itself.
        """
        from garkcli.methodfile.constructed.parts import Opened
        from garkcli.methodfile.naming import read_argument

        text, found = read_argument(f"catalogue:{name}")
        source = Source(found, text)
        if found in self._inside:
            source.fault(None, f"{found} is made from itself")
            raise source.error()
        reader = Reader(source, {}, (*self._inside, found))
        description = reader.read()
        if description is None:
            raise source.error()
        return Opened(source, reader.numbers, description)

    def _is_problem_file(self, root: Node) -> bool:
        """Note a file of the other kind."""
        keys = keys_of(root)
        if not keys & {"hamiltonian", "lagrangian"} or keys & set(FORMS):
            return False
        message = "this is a problem file, not a method file"
        cure = "give it beside a method file: "
        cure += "gark converge METHOD --problem FILE"
        self.source.fault(root, message, cure)
        return True

    def design_place(self) -> Extent | None:
        """From where to where ``design: …`` stands; None where there is none."""
        if self.design is None or self._root is None:
            return None
        key = key_of(self._root, self.design)
        return extent(self.source.text, key, self.design)

    def _tolerance(self, node: Node | None) -> fmpq | None:
        """A rational number between 0 and 1; no parameters, as it is no coefficient."""
        if node is None:
            return None
        text = self.source.scalar(node, "tolerance")
        if text is None:
            return None
        try:
            value = read_decimal(text) if _DECIMAL.fullmatch(text) else None
        except LimitExceeded:
            value = None
        if value is None or not 0 < value < 1:
            wanted = "a decimal number between 0 and 1 is expected"
            message = f"tolerance: {wanted}, not {shortened(text)}"
            self.source.fault(node, message, "for instance 1e-13")
            return None
        return value
