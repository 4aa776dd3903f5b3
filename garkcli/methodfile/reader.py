"""YAML nodes to a ``Description``: every key, shape and word checked, faults collected as they are
met.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import TYPE_CHECKING

from flint import fmpq
from yaml.nodes import MappingNode, Node

from garkcli.methodfile.content import ContentReader
from garkcli.methodfile.description import FORMS, ConstructionText, Description
from garkcli.methodfile.file_keys import KEYS, elsewhere
from garkcli.methodfile.grammar import FILE, entries_in
from garkcli.methodfile.nodes import Extent, extent, key_of, keys_of
from garkcli.methodfile.numbers import Numbers
from garkcli.methodfile.parameters import refuse_unknown_settings
from garkcli.methodfile.source import Source

if TYPE_CHECKING:
    from garkcli.methodfile.constructed.parts import Opened
    from garkcli.methodfile.shaped import Shaped

_ABOUT = (
    *("gark", "name", "description", "aliases", "reference", "tolerance", "expect"),
    "parameters",
)
"""The keys beside the coefficients, which are read before these."""


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
        entries = entries_in(source, root, FILE, KEYS, elsewhere)
        self.keys = frozenset(entries)
        self.design = entries.get("design")
        self._root = root
        said = {
            key: KEYS[key].kind.read(self, entries[key], key) for key in _ABOUT if key in entries
        }
        tolerance: fmpq | None = said.get("tolerance")
        self.content.tolerance = tolerance
        found = self.content.read(root, entries)
        if found is None:
            return None
        refuse_unknown_settings(self.numbers)
        if tolerance is None and isinstance(found.content, ConstructionText):
            tolerance = found.content.tolerance
        reference, bibliography = said.get("reference", ("", None))
        return replace(
            found,
            name=said.get("name") or "",
            description=said.get("description") or "",
            tolerance=tolerance,
            claims=said.get("expect", ()),
            aliases=said.get("aliases", ()),
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
            source.fault(None, f"{found} is made from itself", code="made-from-itself")
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
        self.source.fault(root, message, cure, code="other-file")
        return True

    def design_place(self) -> Extent | None:
        """From where to where ``design: …`` stands; None where there is none."""
        if self.design is None or self._root is None:
            return None
        key = key_of(self._root, self.design)
        return extent(self.source.text, key, self.design)
