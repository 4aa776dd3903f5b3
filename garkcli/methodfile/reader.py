"""YAML nodes to a ``Description``: every key, shape and word checked, faults collected as they are
met.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import TYPE_CHECKING, Literal, cast

from flint import fmpq
from yaml.nodes import MappingNode, Node

from garkcli.errors import LimitExceeded
from garkcli.exact.expression import read_decimal
from garkcli.methodfile import expectations, further
from garkcli.methodfile.bibliography import read_aliases, read_reference
from garkcli.methodfile.description import (
    BESIDE,
    FORMS,
    PLAIN,
    STRUCTURES,
    ArkText,
    Description,
    Form,
    MethodsText,
    PrkText,
    Structure,
    TableauText,
    further_of,
)
from garkcli.methodfile.diagonal import DiagonalReader
from garkcli.methodfile.expectations import NUMBERS, TRUTHS
from garkcli.methodfile.nodes import Extent, extent, key_of, keys_of
from garkcli.methodfile.numbers import Numbers
from garkcli.methodfile.parameters import (
    read_parameters,
    refuse_unknown_settings,
)
from garkcli.methodfile.source import Entries, Source
from garkcli.methodfile.spelled_out import SpelledOutReader
from garkcli.methodfile.words import shortened
from garkcli.transfer import RULES

if TYPE_CHECKING:
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
_START = "give A and b, or one of the keys methods, tableau, ark, prk"
_HOMES = {
    "claims go under expect, for instance expect: {order: 4}": (
        *NUMBERS,
        *TRUTHS,
    ),
    "write methods: [{family: gauss, stages: 2}]": ("family", "stages"),
    "it goes under transfer": ("blocks", "default"),
    "it goes under prk: {q: {A, b}, p: {A, b}}": ("q", "p"),
    "write it under transfer": tuple(RULES),
}
_CURES = {key: cure for cure, keys in _HOMES.items() for key in keys}
_CURES |= further.CURES
"""Keys that are expected elsewhere than at the top of the file, and where."""
_DECIMAL = re.compile(
    r"([0-9]+(\.[0-9]*)?|\.[0-9]+)([eE][+-]?[0-9]+)?", re.ASCII
)


class Reader:
    """Reads one file.

    Attributes:
        source: the file, where faults are noted.
        numbers: its coefficients.
        shaped: the tableau of its ``unknown``; None without that.
        keys: at the top of the file.
        design: what stands under ``design``; None without that.
    """

    def __init__(self, source: Source, settings: Mapping[str, str]) -> None:
        self.source = source
        self.numbers = Numbers(source, settings=settings)
        self.spelled_out = SpelledOutReader(source, self.numbers)
        self.shaped: Shaped | None = None
        self.keys: frozenset[str] = frozenset()
        self.design: Node | None = None
        self._root: MappingNode | None = None

    def read(self) -> Description | None:
        """The description; None, with faults noted in the source, where there is none."""
        source = self.source
        root = source.compose()
        if root is None or self._is_problem_file(root):
            return None
        entries = source.mapping(root, "the file", KEYS, _CURES)
        self.keys = frozenset(entries)
        self.design = entries.get("design")
        self._root = root
        source.check_version(entries.get("gark"))
        text = {}
        for key in ("name", "description"):
            if key in entries:
                text[key] = source.scalar(entries[key], key) or ""
        aliases = read_aliases(source, entries.get("aliases"))
        reference, bibliography = read_reference(
            source, entries.get("reference")
        )
        tolerance = self._tolerance(entries.get("tolerance"))
        is_conjugate = self._is_conjugate(entries.get("conjugate"))
        claims = expectations.read(source, entries.get("expect"))
        read_parameters(self.numbers, entries.get("parameters"))
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
        refuse_unknown_settings(self.numbers)
        return Description(
            form=form,
            content=content,
            node=self._node_of(form, entries),
            structure=structure,
            is_conjugate=is_conjugate,
            tolerance=tolerance,
            claims=claims,
            aliases=aliases,
            reference=reference,
            bibliography=bibliography,
            **text,
        )

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
            self.source.fault(entries["parameters"], message, cure)
        content = entries["unknown"]
        # the key as it stands there, misspelt perhaps
        key = key_of(root, content)
        return ShapeReader(self.source, self.numbers).read(key, content)

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

    def _form(
        self, root: Node, entries: Entries
    ) -> Form | Literal["unknown"] | None:
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
            self.source.fault(entries[key], message, cure)
        if not present:
            # a key that belongs elsewhere was noted with its cure, which is where to begin
            if not keys_of(root) & set(_CURES):
                self.source.fault(root, "no coefficients", _START)
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
            self.source.fault(entries[plain[0]], message, cure)
            return None
        return "tableau"

    def _structure(self, form: Form, entries: Entries) -> Structure:
        """Which vector fields the problem has; noted where it does not go with the form."""
        node = entries.get("structure")
        if node is None:
            is_split = self.shaped is not None and form == "prk"
            return "separable" if is_split else "general"
        word = self.source.choice(node, "structure", STRUCTURES)
        if form in {"tableau", "ark"} and word != "general":
            cure = "use methods, tableau or prk"
            if form == "tableau":
                cure = "write absent blocks as null"
            self.source.fault(node, f"structure does not go with {form}", cure)
        if form == "prk" and word == "semi-separable":
            message = "a prk cannot be semi-separable: "
            message += "that takes two Hamiltonians"
            self.source.fault(node, message, "use methods")
        return cast("Structure", word or "general")

    def _is_conjugate(self, node: Node | None) -> bool:
        if node is None:
            return False
        word = self.source.choice(node, "conjugate", ("true", "false"))
        return word == "true"

    def _refuse_misplaced(self, form: Form, entries: Entries) -> None:
        for key, home in (("transfer", "methods"), ("linear", "tableau")):
            if key in entries and form != home:
                message = f"{key} goes with {home}, not with {form}"
                self.source.fault(entries[key], message, "leave it out")

        if form in entries or self.shaped is not None:
            self._refuse_apart_from_b(form, entries)

    def _refuse_apart_from_b(self, form: Form, entries: Entries) -> None:
        """Note further weights at the top of a file whose b stands elsewhere."""
        cure = f"write it inside of {form}, beside b"
        if form == "methods":
            cure = "write it in each of the methods"
        if self.shaped is not None:
            cure = 'spell A and b out, with "?" for the entries to be found'
        for key in BESIDE:
            if key in entries:
                message = f"{key} stands beside b, and here is none"
                self.source.fault(entries[key], message, cure)

    def _refuse_beside_conjugate(
        self, content: MethodsText | TableauText | ArkText | PrkText
    ) -> None:
        """Note further weights where the method is the conjugate of what has them."""
        for text in further_of(content):
            if text.node is not None:
                message = "conjugate: the symplectic conjugate has no "
                message += "embedded weights and no dense output"
                self.source.fault(text.node, message, "leave them out")
                return

    def _content(
        self, form: Form, structure: Structure, entries: Entries
    ) -> MethodsText | TableauText | ArkText | PrkText | None:
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
        from garkcli.methodfile.ark_prk import ArkReader, PrkReader

        if form == "ark":
            return ArkReader(self.source, self.numbers).read(node)
        return PrkReader(self.source, self.numbers).read(node, structure)
