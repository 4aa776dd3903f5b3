"""YAML nodes to the coefficients of a method: which form they have, and what goes with it.

The same for a whole file and for a method inside of a construction.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Literal, cast

from flint import fmpq
from yaml.nodes import MappingNode, Node, ScalarNode

from garkcli.methodfile import further
from garkcli.methodfile.description import (
    BESIDE,
    CONSTRUCTIONS,
    FORMS,
    PLAIN,
    ConstructionText,
    Content,
    Description,
    Form,
    Structure,
    further_of,
)
from garkcli.methodfile.diagonal import DiagonalReader
from garkcli.methodfile.file_keys import KEYS, KEYS_OF_METHOD
from garkcli.methodfile.nodes import key_of, keys_of
from garkcli.methodfile.numbers import Numbers
from garkcli.methodfile.source import Entries, Source
from garkcli.methodfile.spelled_out import SpelledOutReader
from garkcli.properties.definitions import ORDERS
from garkcli.transfer import RULES

if TYPE_CHECKING:
    from garkcli.methodfile.constructed.parts import Open
    from garkcli.methodfile.shaped import Shaped

_EXAMPLE = "write for instance {family: rk4}, {A: …, b: …} or a name of the catalogue"
_START = "give A and b, or one of the keys methods, tableau, ark, prk"
_HOMES = {
    "claims go under expect, for instance expect: {order: 4}": [
        key for key in ORDERS if len(key) > 1
    ],
    "write methods: [{family: gauss, stages: 2}]": ("family", "stages"),
    "it goes under transfer": ("blocks", "default"),
    "it goes under prk: {q: {A, b}, p: {A, b}}": ("q", "p"),
    "write it under transfer": tuple(RULES),
    "it goes under compose: {of: …, steps: …}": ("of", "steps", "scheme"),
    "it goes under extrapolate: {of: …, sequence: …}": ("sequence",),
    "it goes under multirate: {slow: …, fast: …}": ("slow", "fast"),
}
CURES = {key: cure for cure, keys in _HOMES.items() for key in keys}
CURES |= further.CURES
"""Keys that are expected elsewhere than at the top of the file, and where."""


class ContentReader:
    """Reads the coefficients of one method of a file.

    Args:
        opened: what reads methods of the catalogue.

    Attributes:
        source: the file, where faults are noted.
        numbers: its coefficients.
        shaped: the tableau of its ``unknown``; None without that.
        tolerance: the rounding of its coefficients; None where they are meant exactly.
    """

    def __init__(self, source: Source, numbers: Numbers, opened: Open) -> None:
        self.source = source
        self.numbers = numbers
        self._open = opened
        self.spelled_out = SpelledOutReader(source, numbers)
        self.shaped: Shaped | None = None
        self.tolerance: fmpq | None = None

    def read(self, root: MappingNode, entries: Entries) -> Description | None:
        """What the keys of a method say; None, with faults noted, where they make none."""
        is_conjugate = bool(self._value("conjugate", entries))
        form = self._form(root, entries)
        if form is None:
            return None
        if form == "unknown":
            self.shaped = self._shaped(root, entries)
            if self.shaped is None:
                return None
            form = self.shaped.form
        self._refuse_misplaced(form, entries)
        structure = self._structure(form, entries)
        content = self._content(form, structure, entries)
        if content is None:
            return None
        if is_conjugate:
            self._refuse_beside_conjugate(content)
        node = self._node_of(form, entries)
        return Description(form, content, node, structure, is_conjugate)

    def _node_of(self, form: Form, entries: Entries) -> Node:
        """Where the coefficients stand."""
        for key in (form, "unknown"):
            if key in entries:
                return entries[key]
        return entries["b"]

    def _shaped(self, root: MappingNode, entries: Entries) -> Shaped | None:
        """``unknown`` of the file."""
        from garkcli.methodfile.shaped import ShapeReader  # few files have it

        if "parameters" in entries:
            message = "parameters do not go with unknown: its unknowns have their names"
            cure = "leave them out, or spell the tableau out with them"
            self.source.fault(entries["parameters"], message, cure, code="not-together")
        content = entries["unknown"]
        # the key as it stands there, misspelt perhaps
        key = key_of(root, content)
        return ShapeReader(self.source, self.numbers).read(key, content)

    def _form(self, root: Node, entries: Entries) -> Form | Literal["unknown"] | None:
        """Which form the coefficients have; A, b and c at the top are those of a tableau."""
        forms = (*FORMS, "unknown")
        present: list[str] = [key for key in forms if key in entries]
        plain = [key for key in PLAIN if key in entries]
        if plain:
            present.append(plain[0])
        cure = f"keep one of {', '.join(present)}"
        for key in present[1:]:
            message = f"{key}: the coefficients are given by "
            message += f"{present[0]} already"
            self.source.fault(entries[key], message, cure, code="given-twice")
        if not present:
            # a key that belongs elsewhere was noted with its cure, which is where to begin
            if not keys_of(root) & set(CURES):
                self.source.fault(root, "no coefficients", _START, code="missing-key")
            return None
        if len(present) > 1:
            return None
        if not plain:
            return cast("Form", present[0])  # or "unknown"
        missing = [key for key in ("A", "b") if key not in entries]
        if missing:
            lacking, given = " and ".join(missing), ", ".join(plain)
            message = f"{lacking} missing beside {given}"
            cure = "give A, b and perhaps c"
            self.source.fault(entries[plain[0]], message, cure, code="missing-key")
            return None
        return "tableau"

    def _structure(self, form: Form, entries: Entries) -> Structure:
        """Which vector fields the problem has; noted where it does not go with the form."""
        node = entries.get("structure")
        if node is None:
            is_split = self.shaped is not None and form == "prk"
            is_split = is_split or self._is_of_flows(form, entries)
            return "separable" if is_split else "general"
        word = self._value("structure", entries)
        if form in {"tableau", "ark"} and word != "general":
            cure = "use methods, tableau or prk"
            if form == "tableau":
                cure = "write absent blocks as null"
            self.source.fault(node, f"structure does not go with {form}", cure, code="not-together")
        is_split = self._is_of_flows(form, entries)
        is_split = is_split and word in {"separable", "nystrom"}
        if form in CONSTRUCTIONS and word != "general" and not is_split:
            cure = "give it beside the coefficients of the methods inside"
            if form == "splitting":
                cure = "a splitting without of is separable or nystrom"
            self.source.fault(node, f"structure does not go with {form}", cure, code="not-together")
        if form == "prk" and word == "semi-separable":
            message = "a prk cannot be semi-separable: "
            message += "that takes two Hamiltonians"
            self.source.fault(node, message, "use methods", code="not-together")
        return cast("Structure", word or "general")

    def _value(self, key: str, entries: Entries) -> Any:
        """What stands under a key; None where nothing does, or a fault was noted."""
        return KEYS[key].kind.read(self, entries[key], key) if key in entries else None

    def _is_of_flows(self, form: Form, entries: Entries) -> bool:
        """Whether it is a splitting whose flows are exact: of a separable problem."""
        return form == "splitting" and "of" not in keys_of(entries[form])

    def _constructed(self, form: Form, node: Node, structure: Structure) -> ConstructionText | None:
        """A method made from others."""
        from garkcli.methodfile.constructed.parts import PartReader

        beside = self.tolerance, structure
        parts = PartReader(self.source, self.numbers, self._inside, self._open, *beside)
        found: ConstructionText | None = KEYS[form].kind.read(parts, node, form)
        return found

    def _inside(self, node: Node, where: str) -> Description | None:
        """A method inside of a construction, which may be one itself."""
        reader = ContentReader(self.source, self.numbers, self._open)
        reader.tolerance = self.tolerance
        if isinstance(node, MappingNode) and "family" in keys_of(node):
            key = ScalarNode("tag:yaml.org,2002:str", "methods")
            family: Entries = {"methods": node}
            root = MappingNode("tag:yaml.org,2002:map", [(key, node)])
            root.start_mark = node.start_mark
            return reader.read(root, family)
        entries = self.source.mapping(node, where, KEYS_OF_METHOD, CURES, _EXAMPLE)
        if not isinstance(node, MappingNode):
            return None
        return reader.read(node, entries)

    def _refuse_misplaced(self, form: Form, entries: Entries) -> None:
        for key, home in (("transfer", "methods"), ("linear", "tableau")):
            if key in entries and form != home:
                message = f"{key} goes with {home}, not with {form}"
                self.source.fault(entries[key], message, "leave it out", code="not-together")

        if form in entries or self.shaped is not None:
            self._refuse_apart_from_b(form, entries)

    def _refuse_apart_from_b(self, form: Form, entries: Entries) -> None:
        """Note further weights at the top of a file whose b stands elsewhere."""
        cure = f"write it inside of {form}, beside b"
        if form == "methods":
            cure = "write it in each of the methods"
        if form in CONSTRUCTIONS:
            cure = "gark tableau --format yaml spells the method out, for them"
        if self.shaped is not None:
            cure = 'spell A and b out, with "?" for the entries to be found'
        for key in BESIDE:
            if key in entries:
                message = f"{key} stands beside b, and here is none"
                self.source.fault(entries[key], message, cure, code="missing-key")

    def _refuse_beside_conjugate(self, content: Content) -> None:
        """Note further weights where the method is the conjugate of what has them."""
        for text in further_of(content):
            if text.node is not None:
                message = "conjugate: the symplectic conjugate has no "
                message += "embedded weights and no dense output"
                self.source.fault(text.node, message, "leave them out", code="not-together")
                return

    def _content(self, form: Form, structure: Structure, entries: Entries) -> Content | None:
        if self.shaped is not None:
            return self.shaped.content
        if form not in entries:
            return self.spelled_out.tableau_of(entries, entries.get("linear"))
        node = entries[form]
        if form == "methods":
            reader = DiagonalReader(self.source, self.numbers)
            return reader.read(node, structure, entries.get("transfer"))
        if form == "tableau":
            return self.spelled_out.tableau(node, entries.get("linear"))
        # rare forms
        if form in CONSTRUCTIONS:
            return self._constructed(form, node, structure)
        from garkcli.methodfile.ark_prk import ArkReader, PrkReader

        if form == "ark":
            return ArkReader(self.source, self.numbers).read(node)
        return PrkReader(self.source, self.numbers).read(node, structure)
